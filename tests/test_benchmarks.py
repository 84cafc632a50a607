"""The benchmarks' models: right, and compiled at a cost that does not depend on their size."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from benchmarks import (
    chain,
    export,
    fleet,
    gears,
    grid,
    ladder,
    measure,
    observer,
    optimizers,
    peers,
    sweep,
)
from benchmarks.command import growth_exponent
from benchmarks.measure import Stopwatch
from benchmarks.qvm import by_hand, c, framework, task
from examples.qvm.model import with_networks

SIZES = {"chain": (20, 200), "gears": (20, 200), "grid": (12, 20), "ladder": (20, 200)}
CASES = {"chain": chain.CASE, "gears": gears.CASE, "grid": grid.CASE, "ladder": ladder.CASE}


@pytest.fixture(scope="module", params=CASES)
def pair(request):
    """A case, and for two sizes of it the system and its compiled programs."""
    case = CASES[request.param]
    return case, {n: measure.build(case, n, Stopwatch()) for n in SIZES[request.param]}


@pytest.mark.cases(fast=1)
def test_the_generated_code_agrees_with_code_by_hand(pair):
    case, built = pair
    for n, (system, rhs, _) in built.items():
        _, _, difference = measure.beside_code_by_hand(case, n, system, rhs)
        assert difference < 1e-12


def test_programs_do_not_grow_with_the_model(pair):
    counts = [
        (measure.instructions(rhs), measure.instructions(gradient))
        for _, rhs, gradient in pair[1].values()
    ]
    assert counts[0] == counts[1]


COUNTS = """
import json
from benchmarks import measure
from tests.test_benchmarks import CASES, SIZES

found = {}
for name, case in CASES.items():
    small, large = SIZES[name]
    measure.calls(case, small)  # fills caches
    found[name] = [measure.calls(case, n) for n in (small, large)]
print(json.dumps(found))
"""


@pytest.fixture(scope="module")
def counts():
    """Calls by case and size, counted in a process of their own: those into sympy depend on what ran before."""
    run = subprocess.run(
        [sys.executable, "-c", COUNTS],
        cwd=Path(__file__).parents[1],
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(run.stdout.splitlines()[-1])


@pytest.mark.machines
def test_sympy_is_asked_as_often_whatever_the_size(pair, counts):
    case, built = pair
    called = counts[next(name for name, known in CASES.items() if known is case)]
    assert called[0]["sympy_calls"] == called[1]["sympy_calls"]
    unknowns = [system.flat.n_variables for system, *_ in built.values()]
    more = called[1]["calls"] - called[0]["calls"]
    assert more < 100 * (unknowns[1] - unknowns[0])


@pytest.mark.slow
def test_python_calls_grow_in_proportion_to_the_model():
    sizes = (50, 50, 100, 200)  # the first fills caches
    called = [measure.calls(chain.CASE, n)["calls"] for n in sizes]
    per_mass = np.diff(called[1:]) / np.diff(sizes[1:])
    assert per_mass[1] == pytest.approx(per_mass[0], rel=0.01)


def test_the_growth_exponent_compares_the_largest_size_with_a_hundredth_of_it():
    found = {10: {"total_seconds": 7.0}, 100: {"total_seconds": 1.0}, 10000: {"total_seconds": 10}}
    assert growth_exponent(found) == pytest.approx(0.5)


@pytest.fixture(scope="module")
def ride():
    """The measured ride, and parameters of the vehicle that drives it."""
    return task.record(), ac.compile(with_networks()).parameters(0)


@pytest.mark.slow
@pytest.mark.parametrize(("count", "length"), [(1, task.SAMPLES), (5, 40)])
def test_all_take_the_same_gradient_of_the_quarter_vehicle(ride, count, length):
    asked = task.task("", *ride, count, length)
    loss, expected = framework.gradient(asked)()
    for other in (c.gradient, by_hand.scan):
        with suppress(ImportError):
            other_loss, by = other(asked)()
            assert float(other_loss) == pytest.approx(float(loss), rel=1e-12)
            assert by == pytest.approx(expected, abs=1e-10 * abs(expected).max())


@pytest.mark.slow
def test_exported_steps_are_those_written_by_hand(ride, tmp_path):
    asked = task.task("", *ride, 1, 300)
    try:
        expected = c.forward(asked)()
    except ImportError as e:
        pytest.skip(str(e))
    exported = export.Exported(ac.compile(with_networks()), asked.params, tmp_path)
    assert exported.forward(asked)() == pytest.approx(expected, rel=1e-11)


@pytest.mark.slow
def test_an_observer_steps_in_python_and_in_c(tmp_path):
    seen = observer.observer(ac.compile(with_networks()), "ekf")
    with suppress(ImportError):
        observer.in_c(seen, tmp_path)()
    observer.in_python(seen)
    assert seen.t == pytest.approx(1e-3 * observer.CALLS)


@pytest.mark.slow
def test_a_sweep_finds_what_single_simulations_find():
    system, steps = ac.compile(with_networks()), 30
    many = sweep.variants(system, 11, steps)
    one = sweep.roughness(system, steps, jnp.float64)
    together = jax.jit(jax.vmap(one))(many)
    alone = [jax.jit(one)(jax.tree.map(lambda a, i=i: a[i], many)) for i in (0, 10)]
    assert together[jnp.asarray([0, 10])] == pytest.approx(np.asarray(alone), rel=1e-11)
    assert len(np.unique(together)) == 11


@pytest.mark.cases(fast=1, slow=5)
@pytest.mark.parametrize("name", [*optimizers.QUASI_NEWTON, *optimizers.GAUSS_NEWTON])
def test_all_optimizers_find_a_minimum(name):
    method = {**optimizers.QUASI_NEWTON, **optimizers.GAUSS_NEWTON}[name]

    def loss(x):
        return 1.0 + jnp.sum(jnp.array([1.0, 10.0, 100.0]) * (x - 1) ** 2)

    @jax.jit
    def one(x, state):
        extra = {"value": loss(x), "grad": jax.grad(loss)(x), "value_fn": loss}
        if name in optimizers.GAUSS_NEWTON:
            extra["hessian"] = jax.hessian(loss)(x)
        moves, state = method.update(extra["grad"], state, x, **extra)
        return x + moves, state

    x = jnp.zeros(3)
    state = method.init(x)
    for _ in range(40):
        x, state = one(x, state)
    np.testing.assert_allclose(x, 1.0, atol=1e-4)


@pytest.mark.machines
@pytest.mark.parametrize("name", peers.TASKS)
def test_peers_agree(name):
    task = peers.TASKS[name](3)
    ours, byhand = (peers.PEERS[peer](task) for peer in ("acausal", "diffrax"))
    assert ours.simulate() == pytest.approx(byhand.simulate(), abs=1e-8)
    np.testing.assert_allclose(ours.gradient(), byhand.gradient(), atol=1e-8)
    assert peers.measured("diffrax", task).keys() == {"first", "position", "again", "gradient"}


@pytest.mark.machines
def test_a_fleet_is_trained_and_swept_by_workers():
    run = subprocess.run(
        [sys.executable, "-m", "benchmarks.fleet", "--n", "4", "8", "--variants", "16"],
        cwd=Path(__file__).parents[1],
        capture_output=True,
        text=True,
        check=True,
    )
    found = json.loads(run.stdout.splitlines()[-1])
    assert set(found["records"]) == {"4", "8"}
    assert found["speedup"] == found["one_core"]["seconds"] / found["all_cores"]["seconds"]
    assert found["one_core"]["workers"] > 0


@pytest.mark.machines
def test_a_fleet_is_trained_on_from_files():
    run = subprocess.run(
        [sys.executable, "-m", "benchmarks.fleet", "--stream", "0.005"],
        cwd=Path(__file__).parents[1],
        capture_output=True,
        text=True,
        check=True,
    )
    found = json.loads(run.stdout.splitlines()[-1])
    assert found["records"] == 1000
    assert found["loss"] < found["loss_before"]
    assert found["peak_mb"] < 1000


def test_the_growth_of_a_figure_is_its_power():
    found = {10: {"a": 2.0, "b": 5.0}, 100: {"a": 20.0, "b": 5.0}}
    assert fleet.growth(found, "a") == pytest.approx(1)
    assert fleet.growth(found, "b") == pytest.approx(0)
    assert fleet.growth({10: found[10]}, "a") is None
