"""From a model to a nonlinear program: states over a horizon that obey the differential equations."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float

from acausal.control.goals import Goals

DEGREE = 3
"""Collocation points of an interval: Radau's method of order five, for stiff models, too."""

SOFT = 1e4
"""Weight of what a variable leaves its limits by, relative to their distance: they are kept where they can be."""

Rates = Callable[[Any, Any, Any], Any]


def collocated(ca: Any, rates: Rates, dt: float, t: Any, x: Any, inner: Any, u: Any) -> list[Any]:
    """What is zero where polynomials have the model's derivatives at Radau's points, the last of which is the end.

    Source: L. Biegler, Nonlinear Programming, SIAM 2010, chapter 10.
    """
    places = ca.collocation_points(DEGREE, "radau")
    slopes = ca.horzcat(x, inner) @ ca.collocation_coeff(places)[0]
    return [slopes[:, j] - dt * rates(t + s * dt, inner[:, j], u) for j, s in enumerate(places)]


def stepped(ca: Any, rates: Rates, dt: float, t: Any, x: Any, inner: Any, u: Any) -> list[Any]:
    """What is zero where the end follows from one step of classical Runge-Kutta: multiple shooting."""
    k1 = rates(t, x, u)
    k2 = rates(t + dt / 2, x + dt / 2 * k1, u)
    k3 = rates(t + dt / 2, x + dt / 2 * k2, u)
    k4 = rates(t + dt, x + dt * k3, u)
    return [inner[:, 0] - x - dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)]


METHODS = {"collocation": (collocated, DEGREE), "rk4": (stepped, 1)}
"""By name, what is zero, and how many columns of states in an interval are unknown."""


@dataclass(frozen=True, eq=False)
class NonlinearProgram:
    """A nonlinear program: its unknowns are the inputs, states and slacks of the horizon, each in its typical size.

    Attributes:
        solve: IPOPT, with the program's bounds.
        read: from unknowns and parameters to inputs, states at the samples, and observed variables.
        widths: how many unknowns of each kind there are for a sample.
        start: unknowns where the state stays as it is.
    """

    solve: Any
    read: Any
    bounds: dict[str, Float[np.ndarray, " n"]]
    widths: tuple[int, ...]
    start: Callable[[Float[np.ndarray, " n_states"]], Float[np.ndarray, " n"]]

    def shifted(self, unknowns: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """One sample later; the last sample is repeated."""
        steps = len(unknowns) // sum(self.widths)
        blocks = np.split(unknowns, np.cumsum(np.array(self.widths) * steps)[:-1])
        rows = [b.reshape(steps, w) for b, w in zip(blocks, self.widths, strict=True)]
        return np.concatenate([np.concatenate([r[1:], r[-1:]]).ravel() for r in rows])


def program(
    model: Any,
    goals: Goals,
    order: list[int],
    size: Float[np.ndarray, " n_states"],
    dt: float,
    steps: int,
    method: str,
    iterations: int,
) -> NonlinearProgram:
    """The program of a horizon; its parameters are state, time, last inputs, references and given inputs.

    Arguments:
        model: a CasADi function from ``t, x, u`` to ``der(x)`` and the observed variables.
        order: of the decided inputs, followed by the given ones, in ``u``.
        size: typical magnitudes of the states.
        method: one of `METHODS`. iterations: of IPOPT at most.
    """
    import casadi

    ca: Any = casadi
    n, m, bounded = len(size), len(goals.decided), goals.bounded
    unit = np.array([goals.size(name) for name in goals.decided])
    defects, points = METHODS[method]
    u, x = ca.MX.sym("u", m, steps), ca.MX.sym("x", n, steps * points)
    slack = ca.MX.sym("slack", len(bounded), steps)
    x0, t0, before = ca.MX.sym("x0", n), ca.MX.sym("t0"), ca.MX.sym("before", m)
    goal = ca.MX.sym("goal", len(goals.track), steps)
    given = ca.MX.sym("given", len(order) - m, steps)

    def rates(t: Any, state: Any, held: Any) -> Any:
        return model(t, state, held)[0]

    cost, equal, observed = SOFT * ca.sumsqr(slack), [], []
    state, last = x0, before
    for k in range(steps):
        own, t = u[:, k] * unit, t0 + k * dt
        held = ca.vertcat(own, given[:, k])[order]
        inner = x[:, k * points : (k + 1) * points] * size
        equal += [d / size for d in defects(ca, rates, dt, t, state, inner, held)]
        state = inner[:, points - 1]
        observed.append(model(t + dt, state, held)[1])
        off = observed[-1][: len(goals.track)] - goal[:, k]
        cost += (goals.terminal if k == steps - 1 else 1.0) * _weighted(
            ca, goals.track.values(), off
        )
        cost += _weighted(ca, goals.effort.values(), own)
        cost += _weighted(ca, [goals.change.get(n, 0.0) for n in goals.decided], own - last)
        last = own
    seen = ca.horzcat(*observed)
    limited = seen[[goals.observed.index(name) for name in bounded], :]
    room = slack * np.array([goals.size(name) for name in bounded]).reshape(-1, 1)
    rows = ca.veccat(*equal, limited + room, limited - room)
    unknowns, parameters = ca.veccat(u, x, slack), ca.veccat(x0, t0, before, goal, given)
    options = {
        "print_time": False,
        "error_on_fail": False,
        "ipopt": {"print_level": 0, "sb": "yes", "max_iter": iterations, "tol": 1e-7},
    }
    nlp = {"x": unknowns, "f": cost, "g": rows, "p": parameters}
    ends = ca.horzcat(x0, x[:, points - 1 :: points] * size)
    low, high = _bounds(goals, unit, n * points, steps)
    widths = m, n * points, len(bounded)
    still = np.clip(np.zeros(m * steps), low["x"][: m * steps], high["x"][: m * steps])

    def start(of: Float[np.ndarray, " n_states"]) -> Float[np.ndarray, " n"]:
        states = np.tile(of / size, steps * points)
        return np.concatenate([still, states, np.zeros(len(bounded) * steps)])

    return NonlinearProgram(
        ca.nlpsol("mpc", "ipopt", nlp, options),
        ca.Function("plan", [unknowns, parameters], [u * unit, ends, seen]),
        {"lbx": low["x"], "ubx": high["x"], "lbg": low["g"], "ubg": high["g"]},
        widths,
        start,
    )


def _weighted(ca: Any, weights: Iterable[float], values: Any) -> Any:
    return ca.dot(ca.DM([float(w) for w in weights]), values**2)


def _bounds(
    goals: Goals, unit: Float[np.ndarray, " m"], states: int, steps: int
) -> tuple[dict[str, Float[np.ndarray, " n"]], dict[str, Float[np.ndarray, " n"]]]:
    """Lowest and highest values of the unknowns, and of what is constrained."""
    free = np.full(states * steps, np.inf)
    slack, zero = np.zeros(len(goals.bounded) * steps), np.zeros(states * steps)
    inputs = np.array([goals.ends(n) for n in goals.decided]) / unit[:, None]
    variables = np.array([goals.ends(n) for n in goals.bounded]).reshape(-1, 2)
    low, high = (np.tile(side, steps) for side in inputs.T)
    least, most = (np.tile(side, steps) for side in variables.T)
    open_ = np.full(len(slack), np.inf)
    return (
        {"x": np.concatenate([low, -free, slack]), "g": np.concatenate([zero, least, -open_])},
        {
            "x": np.concatenate([high, free, slack + np.inf]),
            "g": np.concatenate([zero, open_, most]),
        },
    )
