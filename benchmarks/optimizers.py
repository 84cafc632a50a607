"""Our L-BFGS and Levenberg-Marquardt beside those of optimistix and optax: ``python -m benchmarks.optimizers``.

On the quarter vehicle over 42 s with noise of 2 %: both networks, from measured states and from outputs alone, and
seven parameters from values up to 30 % off. Every optimizer starts at the same point and makes as many updates. Seconds
are those of updates; those of compilation are listed beside them. Processor seconds are those of all of a training.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
import optimistix as optx
from jax import Array
from jax.flatten_util import ravel_pytree

import acausal as ac
from acausal._jax import Descent, DescentMethod, levenberg_marquardt
from acausal.training import strategy
from acausal.training.optimizers.lbfgs import lbfgs
from benchmarks.strategies import NOISE, OFF, RECORD, UNKNOWN
from examples.qvm.model import truth, with_networks
from examples.qvm.record import INPUT, OUTPUTS, ride

TOLERANCE = 1e-9
"""Of optimistix, relative and absolute, at which a training ends."""
NEAR = 1.01
"""A loss below this times the lowest of all is near it."""


class OptimistixState(Descent):
    """A descent by optimistix.

    Attributes:
        arrays: of the state of its solver, whose other parts are the same at every update.
    """

    arrays: Any


def by_optimistix(solver: Any, function: Callable[..., Any]) -> DescentMethod:
    """A solver of optimistix as an optimizer of a trainer.

    A step of optimistix asks for the value and the derivative of its function at one point, where the trainer has
    computed both. So the function that it gets is the one linear in the point that has them.

    Arguments:
        solver: a minimiser, or a solver of least squares.
        function: (difference from the point, value, gradient, Hessian) -> what the solver takes.
    """

    def begin(point: Array) -> Any:
        zero, square = jnp.zeros((), point.dtype), jnp.zeros((point.size, point.size), point.dtype)

        def fn(y: Array, _: Any) -> Any:
            return function(y - point, zero, jnp.zeros_like(y), square), None

        shape = jax.eval_shape(lambda: fn(point, None)[0])
        return eqx.partition(
            solver.init(fn, point, None, {}, shape, None, frozenset()), eqx.is_array
        )

    def init(params: Any) -> Any:
        point, _ = ravel_pytree(params)
        no = jnp.zeros((), bool)
        value = jnp.asarray(jnp.inf, point.dtype)
        return OptimistixState(point, value, no, begin(point)[0])

    def update(updates: Any, state: Any, params: Any = None, **extra: Any) -> Any:
        point, unravel = ravel_pytree(params)
        gradient, _ = ravel_pytree(updates)

        def fn(y: Array, _: Any) -> Any:
            return function(y - point, extra["value"], gradient, extra.get("hessian")), None

        whole = eqx.combine(state.arrays, begin(point)[1])
        best, whole, _ = solver.step(fn, state.point, None, {}, whole, frozenset())
        converged, _ = solver.terminate(fn, best, None, {}, whole, frozenset())
        value = jnp.where((best == point).all(), extra["value"], state.value)
        arrays = eqx.filter(whole, eqx.is_array)
        return unravel(whole.y_eval - point), OptimistixState(best, value, converged, arrays)

    return DescentMethod(init, update)


def _line(step: Array, value: Array, gradient: Array, _: Array) -> Array:
    return value + gradient @ step


def _residuals(step: Array, value: Array, gradient: Array, hessian: Array) -> Array:
    """Residuals whose half sum of squares has this value, gradient and Hessian, as far as that is positive."""
    eigenvalues, axes = jnp.linalg.eigh(hessian)
    roots = jnp.sqrt(jnp.maximum(eigenvalues, 1e-14 * eigenvalues[-1]))
    roots = jnp.where(roots > 0, roots, 1.0)
    start = axes.T @ gradient / roots
    rest = jnp.sqrt(jnp.maximum(2 * value - start @ start, 0.0))
    return jnp.append(start + roots * (axes.T @ step), rest)


def _method(optimizer: optax.GradientTransformationExtraArgs) -> DescentMethod:
    return DescentMethod(*optimizer)


QUASI_NEWTON = {
    "acausal.lbfgs": lbfgs(),
    "optimistix.LBFGS": by_optimistix(optx.LBFGS(TOLERANCE, TOLERANCE, history_length=60), _line),
    "optimistix.BFGS": by_optimistix(optx.BFGS(TOLERANCE, TOLERANCE), _line),
    "optax.lbfgs": _method(optax.lbfgs(memory_size=60)),
}
GAUSS_NEWTON = {
    "acausal.levenberg_marquardt": levenberg_marquardt(),
    "optimistix.LevenbergMarquardt": by_optimistix(
        optx.LevenbergMarquardt(TOLERANCE, TOLERANCE), _residuals
    ),
}


class Task(NamedTuple):
    """A training.

    Attributes:
        optimizers: by name; the first is ours.
        updates: at most.
        begin: from a seed to the system and where its parameters start.
        strategy: of `acausal.fit`; ``others``: further arguments. measured: signals of the record, by default all.
    """

    optimizers: dict[str, DescentMethod]
    updates: int
    begin: Callable[[int], tuple[ac.System, dict[str, Any]]]
    strategy: str
    others: dict[str, Any] = RECORD
    measured: tuple[str, ...] | None = None


def random_networks(seed: int) -> tuple[ac.System, dict[str, Any]]:
    system = ac.compile(with_networks())
    return system, system.parameters(seed)


def trained_networks(seed: int) -> tuple[ac.System, dict[str, Any]]:
    """Networks as the equation error leaves them."""
    task = Task(QUASI_NEWTON, 150, random_networks, "equation_error")
    system, params = random_networks(seed)
    return system, dict(train(task, system, params, lbfgs()).params)


def wrong_parameters(seed: int) -> tuple[ac.System, dict[str, Any]]:
    system = ac.compile(truth())
    params, random = system.parameters(), np.random.default_rng(seed)
    return system, {**params, **{n: params[n] * (1 + random.uniform(-OFF, OFF)) for n in UNKNOWN}}


SEVEN = {**RECORD, "modifiers": UNKNOWN, "gamma": 2 * OFF}
TASKS = {
    "networks, equation error": Task(QUASI_NEWTON, 150, random_networks, "equation_error"),
    "networks, whole record": Task(QUASI_NEWTON, 150, trained_networks, "whole_record"),
    "networks, from outputs": Task(
        QUASI_NEWTON, 200, random_networks, "whole_record", {"x0": "fit"}, (INPUT, *OUTPUTS)
    ),
    "parameters, whole record": Task(QUASI_NEWTON, 100, wrong_parameters, "whole_record", SEVEN),
    "parameters, Gauss-Newton": Task(GAUSS_NEWTON, 50, wrong_parameters, "gauss_newton", SEVEN),
}


def main() -> None:
    """Train, print a row for each training, and one JSON line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2])
    parser.add_argument("--only", choices=TASKS, nargs="+", default=list(TASKS))
    parser.add_argument("--without", nargs="+", default=[], help="optimizers to leave out")
    asked = parser.parse_args()
    found: dict[str, Any] = {}
    for name in asked.only:
        task = TASKS[name]
        chosen = {n: method for n, method in task.optimizers.items() if n not in asked.without}
        found[name] = compare(name, task._replace(optimizers=chosen), asked.seeds)
    print(json.dumps(found))


def compare(title: str, task: Task, seeds: list[int]) -> dict[str, dict[str, float]]:
    """Medians over the seeds, by optimizer.

    ``loss`` is the lowest, ``loss_ratio`` its ratio to ours, ``near`` the updates until it was near the lowest of all
    (one more than were made if it never was).
    """
    rows: dict[str, list[dict[str, float]]] = {name: [] for name in task.optimizers}
    for seed in seeds:
        system, params = task.begin(seed)
        fits, processor = {}, {}
        for name, method in task.optimizers.items():
            began = time.process_time()
            fits[name] = train(task, system, params, method)
            processor[name] = time.process_time() - began
        losses = {n: np.fmin.accumulate(fit.history.loss) for n, fit in fits.items()}
        lowest = min(path[-1] for path in losses.values())
        first = next(iter(task.optimizers))
        for name, fit in fits.items():
            updates = fit.history.epochs
            near = np.flatnonzero(losses[name] <= NEAR * lowest)
            row = {
                "updates": updates,
                "seconds": updates * fit.seconds_per_epoch,
                "compile_seconds": fit.compile_seconds,
                "processor_seconds": processor[name],
                "loss": float(losses[name][-1]),
                "near": float(near[0] + 1) if len(near) else updates + 1.0,
            }
            row["loss_ratio"] = row["loss"] / float(losses[first][-1])
            rows[name].append(row)
            print(
                f"{title:<26} seed {seed}  {name:<29} {updates:4d} updates  {row['seconds']:6.2f} s  "
                f"compiled in {row['compile_seconds']:5.2f} s  processor {processor[name]:5.1f} s  "
                f"loss {row['loss']:.5f}  near the lowest after {row['near']:4.0f} updates",
                flush=True,
            )
    return {name: _medians(own) for name, own in rows.items()}


def train(task: Task, system: ac.System, params: Any, method: DescentMethod) -> ac.Fit:
    """A training with an optimizer in place of its strategy's own."""
    measured = ride(NOISE).measured
    with _replaced(task.strategy, method):
        return ac.fit(
            system,
            measured if task.measured is None else measured.select(task.measured),
            OUTPUTS,
            params=params,
            strategy=task.strategy,
            epochs=task.updates,
            evaluate_every=10_000,
            progress=False,
            **task.others,
        )


@contextmanager
def _replaced(name: str, method: DescentMethod) -> Iterator[None]:
    kinds = strategy.KINDS
    own = kinds[name]
    kinds[name] = own._replace(optimizer=lambda *_: method)
    try:
        yield
    finally:
        kinds[name] = own


def _medians(rows: list[dict[str, float]]) -> dict[str, float]:
    return {key: statistics.median(row[key] for row in rows) for key in rows[0]}


if __name__ == "__main__":
    main()
