"""Training in adaptive steps: several records in one loop, stiff models, and what is refused."""

import functools
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal._jax import Restarts
from acausal.codegen import Values
from acausal.simulation import Adaptive, Runs, Samples, Steps, integrate_in_steps
from acausal.simulation.solvers import BDF
from tests.support.parts import Equations

TIME = np.linspace(0, 2, 41)
TRUE = {"k": 14.0, "d": 0.8}


@functools.cache
def system() -> ac.System:
    """An oscillator, pushed through an actuator a thousand times as fast."""
    return ac.compile(
        Equations(
            "x v f",
            lambda s: [
                ac.Eq(ac.der(s.x), s.v),
                ac.Eq(ac.der(s.v), s.f - s.k * s.x - s.d * s.v),
                ac.Eq(ac.der(s.f), 4000 * (s.u - s.f)),
            ],
            inputs="u",
            k=10.0,
            d=0.5,
        )
    )


def push(seed: int, n: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=n) * 5


def record(seed: int, n: int) -> ac.Data:
    t, u = TIME[:n], push(seed, n)
    start = {"x": 0.1 * seed, "v": 0.0, "f": u[0]}
    found = ac.simulate(
        system(),
        (0, t[-1]),
        params=TRUE,
        x0=start,
        inputs={"u": ac.Signal(t, u)},
        saveat=t,
        rtol=1e-10,
        atol=1e-10,
    )
    return ac.Data(t, {"u": u, **{n: np.asarray(found[n]) for n in "xvf"}})


@pytest.fixture(scope="module")
def records() -> dict[str, ac.Data]:
    return {"long": record(1, 41), "short": record(2, 25)}


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("solver", ["bdf", "auto"])
def test_a_stiff_model_is_identified_from_several_records(records: dict[str, ac.Data], solver: str):
    """With fixed explicit steps, these would have to be a hundred times as short as the samples are apart."""
    fit = ac.fit(
        system(),
        records,
        "x",
        modifiers=["k", "d"],
        gamma=0.8,
        strategy="gauss_newton",
        epochs=12,
        solver=solver,
        progress=False,
    )
    assert float(fit.params["k"]) == pytest.approx(TRUE["k"], rel=1e-4)
    assert float(fit.params["d"]) == pytest.approx(TRUE["d"], rel=1e-3)
    assert fit.loss < 1e-4
    assert set(fit.records) == {"long", "short"}


@pytest.mark.machines
def test_sequences_take_adaptive_steps_side_by_side(records: dict[str, ac.Data]):
    fit = ac.fit(
        system(),
        records,
        "x",
        modifiers=["k", "d"],
        gamma=0.8,
        sequence_length=0.3,
        batch_size=4,
        epochs=20,
        solver="tsit5",
        rtol=1e-4,
        atol=1e-5,
        progress=False,
    )
    assert fit.loss < 0.9 * fit.loss_before


@pytest.mark.machines
def test_runs_of_one_loop_are_those_made_singly():
    """States, and their derivatives by parameters and by every run's first state."""
    t = np.concatenate([TIME[:6], TIME[:5]])
    u = np.concatenate([push(3, 6), push(4, 5)])
    begins = np.zeros(11, bool)
    begins[6] = True
    first = np.zeros((11, 3))
    starts = jnp.asarray([[0.1, 0.0, 1.0], [0.2, -0.1, 0.5]])
    steps = Steps(
        jnp.asarray(t),
        jnp.asarray(TIME[1]),
        Samples(jnp.asarray(u)[:, None], jnp.asarray(np.append(u[1:], u[-1]))[:, None], (None,)),
    )
    adaptive = Adaptive(BDF(), 1e-8, 1e-10)

    def together(k: Any, starts: Any) -> Any:
        own = system().pack({**TRUE, "k": k})
        runs = Runs(Restarts(jnp.asarray(begins), jnp.asarray(first).at[6].set(starts[1])))
        start = Values(steps.t[0], starts[0], steps.inputs.start[0], own)
        return integrate_in_steps(system(), start, steps, adaptive, outputs=("x",), runs=runs).y

    def singly(k: Any, starts: Any) -> Any:
        own, found = system().pack({**TRUE, "k": k}), []
        for rows, x in ((slice(0, 6), starts[0]), (slice(6, 11), starts[1])):
            part = jax.tree.map(lambda a, rows=rows: a[rows] if a.ndim else a, steps)
            start = Values(part.t[0], x, part.inputs.start[0], own)
            found.append(integrate_in_steps(system(), start, part, adaptive, outputs=("x",)).y)
        return jnp.concatenate(found)

    np.testing.assert_allclose(together(14.0, starts), singly(14.0, starts), atol=1e-9)
    by_both = jax.grad(lambda k, s: jnp.sum(together(k, s) ** 2), (0, 1))(14.0, starts)
    by_each = jax.grad(lambda k, s: jnp.sum(singly(k, s) ** 2), (0, 1))(14.0, starts)
    for a, b in zip(by_both, by_each, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-5, atol=1e-9)
    assert np.abs(by_both[1][1]).max() > 0.01


@pytest.mark.slow
def test_steps_that_are_both_fixed_and_adaptive_are_refused(records: dict[str, ac.Data]):
    for options in ({"solver": "bdf"}, {"rtol": 1e-5}):
        with pytest.raises(ac.TrainingError, match="is for fixed steps, but solver="):
            ac.fit(system(), records, "x", modifiers=["k"], dt=0.01, progress=False, **options)
    with pytest.raises(ac.DataError, match="Euler has no error estimate"):
        ac.fit(system(), records, "x", modifiers=["k"], solver="euler", rtol=1e-5, progress=False)
    with pytest.raises(ac.DataError, match=r"rtol=-1\.0 is not a tolerance"):
        ac.fit(system(), records, "x", modifiers=["k"], solver="bdf", rtol=-1.0, progress=False)
