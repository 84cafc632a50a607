"""Work and precision on the stiff test problems: errors of several solvers over their seconds and right-hand sides."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import jax
import numpy as np
from jaxtyping import Float
from scipy.integrate import solve_ivp

import acausal as ac
from benchmarks.stiff.compare import in_turns
from benchmarks.stiff.cvode import Cvode, right_hand_side
from benchmarks.stiff.stiff_problems import PROBLEMS, StiffProblem

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
REFERENCE = 1e-10
POINTS, ROUNDS = 9, 3
PICTURE = Path(__file__).parents[2] / "docs" / "images" / "stiff-problems.png"

Outcome = tuple[Float[np.ndarray, "n_ts n"], int]
"""The states at the times, and the number of right-hand sides."""


@dataclass(frozen=True)
class Point:
    """What a solver did at one tolerance.

    Attributes:
        rtol: the tolerance.
        error: relative; see `error`.
        seconds: median.
        rates: evaluations of the right-hand side; those for Jacobians count.
    """

    rtol: float
    error: float
    seconds: float
    rates: int


Curves = dict[str, list[Point]]
"""Points by solver; there is none for a tolerance at which a solver gave up."""


def error(
    x: Float[np.ndarray, "n_ts n"], exact: Float[np.ndarray, "n_ts n"], scale: float
) -> float:
    """The root mean square of relative errors at the end, where values below ``scale`` count as that."""
    off = (x[-1] - exact[-1]) / (np.abs(exact[-1]) + scale)
    return float(np.sqrt(np.mean(off**2)))


def problems(
    chosen: tuple[type[StiffProblem], ...] = PROBLEMS, picture: Path | None = PICTURE
) -> dict[str, Any]:
    """Measure all problems with all solvers, and draw the picture."""
    curves = {problem.__name__: measure(problem) for problem in chosen}
    for name, solvers in curves.items():
        for solver, points in solvers.items():
            told = ", ".join(f"{p.error:.0e} in {1e3 * p.seconds:.2f} ms" for p in points)
            print(f"{name:10} {solver:12} {told}", flush=True)
    if picture is not None:
        from benchmarks.stiff.figure import draw  # matplotlib is needed here alone

        draw(curves).savefig(picture, dpi=130)
    return {
        f"{name}_{solver}": [[p.rtol, p.error, p.seconds, p.rates] for p in points]
        for name, solvers in curves.items()
        for solver, points in solvers.items()
    }


def measure(problem: type[StiffProblem], tolerances: tuple[float, ...] = TOLERANCES) -> Curves:
    """The curves of all solvers for a problem."""
    system = ac.compile(problem())
    ts = np.linspace(0.0, problem.end, POINTS)
    x0 = np.asarray(system.initial_state(system.parameters()))
    rates = right_hand_side(system, {})
    field: Callable[[float, Any], Any] = lambda t, x: np.asarray(rates(t, x))  # noqa: E731
    jacobian = jax.jit(jax.jacfwd(rates, 1))
    exact = _radau(field, jacobian, ts, x0, REFERENCE, problem.scale)[0]
    solvers: dict[str, Callable[[float], Outcome]] = {
        "auto": lambda rtol: _own(system, ts, "auto", rtol, problem.scale),
        "bdf": lambda rtol: _own(system, ts, "bdf", rtol, problem.scale),
        "CVODE": lambda rtol: Cvode(field, rtol=rtol, atol=rtol * problem.scale)(ts, x0),
        "Radau": lambda rtol: _radau(field, jacobian, ts, x0, rtol, problem.scale),
    }
    curves: Curves = {name: [] for name in solvers}
    for rtol in tolerances:
        found = {name: x for name, solve in solvers.items() if (x := _reached(solve, rtol))}
        taken = in_turns({name: partial(solvers[name], rtol) for name in found}, ROUNDS)
        for name, (x, count) in found.items():
            median = statistics.median(taken[name])
            curves[name].append(Point(rtol, error(x, exact, problem.scale), median, count))
    return curves


def _reached(solve: Callable[[float], Outcome], rtol: float) -> Outcome | None:
    """What a solver found, if it reached the end."""
    try:
        return solve(rtol)
    except RuntimeError as failure:
        print(f"at rtol = {rtol:g}: {failure}", flush=True)
        return None


def _own(system: ac.System, ts: Any, solver: str, rtol: float, scale: float) -> Outcome:
    span = float(ts[0]), float(ts[-1])
    sol = ac.simulate(system, span, saveat=ts, solver=solver, rtol=rtol, atol=rtol * scale)
    n = len(system.states)
    assert sol.statistics is not None
    count = int(sol.statistics.rates) + n * int(sol.statistics.factorizations)
    return np.asarray(sol.x), count


def _radau(
    field: Callable[[float, Any], Any], jacobian: Any, ts: Any, x0: Any, rtol: float, scale: float
) -> Outcome:
    found = solve_ivp(
        field,
        (ts[0], ts[-1]),
        x0,
        method="Radau",
        t_eval=ts,
        jac=lambda t, x: np.asarray(jacobian(t, x)),
        rtol=rtol,
        atol=rtol * scale,
    )
    if not found.success:
        raise RuntimeError(f"Radau failed: {found.message}")
    return found.y.T, int(found.nfev) + len(x0) * int(found.njev)
