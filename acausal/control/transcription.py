"""From a model to a nonlinear program: states over a horizon that obey the differential equations."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from jaxtyping import Float

from acausal.control.goals import Goals
from acausal.control.sizes import TypicalSizes

DEGREE = 3
"""Collocation points of an interval: Radau's method of order five, for stiff models, too."""

SOFT = 1e4
"""Weight of what a variable leaves its limits by, relative to their distance, where all else costs about one: limits
are kept where they can be."""

Rates = Callable[[Any, Any, Any], Any]


def collocated(ca: Any, rates: Rates, dt: float, t: Any, x: Any, inner: Any, u: Any) -> list[Any]:
    """What is zero where polynomials have the model's derivatives at Radau's points, the last of which is the end.

    Source: L. Biegler, Nonlinear Programming, SIAM 2010, chapter 10.
    """
    places = ca.collocation_points(DEGREE, "radau")
    slopes = ca.horzcat(x, inner) @ ca.collocation_coeff(places)[0]
    return [slopes[:, j] - dt * rates(t + s * dt, inner[:, j], u) for j, s in enumerate(places)]


def stepped(
    ca: Any, rates: Rates, dt: float, t: Any, x: Any, inner: Any, u: Any, parts: int = 1
) -> list[Any]:
    """What is zero where the end follows from equal steps of classical Runge-Kutta: multiple shooting."""
    h = dt / parts
    for k in range(parts):
        start = t + k * h
        k1 = rates(start, x, u)
        k2 = rates(start + h / 2, x + h / 2 * k1, u)
        k3 = rates(start + h / 2, x + h / 2 * k2, u)
        k4 = rates(start + h, x + h * k3, u)
        x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return [inner[:, 0] - x]


METHODS = {"collocation": (collocated, DEGREE), "rk4": (stepped, 1)}
"""By name, what is zero, and how many columns of states in an interval are unknown."""


@dataclass(frozen=True, eq=False)
class NonlinearProgram:
    """A nonlinear program: its unknowns are the inputs, states and slacks of the horizon, each in its typical size.

    Attributes:
        solve: IPOPT.
        read: from unknowns and parameters to inputs, states at the samples, and observed variables.
        linearized: the model for `sizes`.
        goals: of the controller.
        widths: how many unknowns of each kind there are for a sample.
        steps: how many samples.
    """

    solve: Any
    read: Any
    linearized: Any
    goals: Goals
    widths: tuple[int, ...]
    steps: int

    def start(
        self, x: Float[np.ndarray, " n_states"], size: TypicalSizes
    ) -> Float[np.ndarray, " n"]:
        """Unknowns where the state stays as it is."""
        m, states, slacks = self.widths
        low, high = self._inputs(size).T
        inputs = np.tile(np.clip(np.zeros(m), low, high), self.steps)
        still = np.tile(x / size.states, self.steps * states // len(x))
        return np.concatenate([inputs, still, np.zeros(slacks * self.steps)])

    def bounds(self, size: TypicalSizes) -> dict[str, Float[np.ndarray, " n"]]:
        """Lowest and highest values of the unknowns, and of what is constrained."""
        goals, steps = self.goals, self.steps
        _, states, slacks = self.widths
        free, slack = np.full(states * steps, np.inf), np.zeros(slacks * steps)
        low, high = (np.tile(side, steps) for side in self._inputs(size).T)
        limits = [np.array(goals.ends(n)) / goals.size(n) for n in goals.bounded]
        least, most = (np.tile(side, steps) for side in np.array(limits).reshape(-1, 2).T)
        open_, zero = np.full(len(slack), np.inf), np.zeros(states * steps)
        return {
            "lbx": np.concatenate([low, -free, slack]),
            "ubx": np.concatenate([high, free, slack + np.inf]),
            "lbg": np.concatenate([zero, least, -open_]),
            "ubg": np.concatenate([zero, open_, most]),
        }

    def _inputs(self, size: TypicalSizes) -> Float[np.ndarray, "m 2"]:
        return np.array([self.goals.ends(n) for n in self.goals.decided]) / size.inputs[:, None]

    def shifted(
        self, unknowns: Float[np.ndarray, " n"], before: TypicalSizes, size: TypicalSizes
    ) -> Float[np.ndarray, " n"]:
        """One sample later, in other sizes; the last sample is repeated."""
        blocks = np.split(unknowns, np.cumsum(np.array(self.widths) * self.steps)[:-1])
        rows = [b.reshape(self.steps, w) for b, w in zip(blocks, self.widths, strict=True)]
        inputs, states, slack = (np.concatenate([r[1:], r[-1:]]) for r in rows)
        inputs = inputs * before.inputs / size.inputs
        ratio = np.tile(before.states / size.states, states.shape[1] // len(size.states))
        return np.concatenate([inputs.ravel(), (states * ratio).ravel(), slack.ravel()])


def program(
    model: Any,
    goals: Goals,
    order: list[int],
    n: int,
    dt: float,
    steps: int,
    method: str,
    parts: int,
    iterations: int,
) -> NonlinearProgram:
    """The program of a horizon; its parameters: state, time, last inputs, references, given inputs, and typical sizes.

    Arguments:
        model: a CasADi function from ``t, x, u`` to ``der(x)`` and the observed variables.
        order: of the decided inputs, followed by the given ones, in ``u``.
        n: how many states there are. dt: the sample time. steps: how many samples.
        method: one of `METHODS`. parts: steps of Runge-Kutta in a sample time. iterations: of IPOPT at most.
    """
    import casadi

    ca: Any = casadi
    m, bounded = len(goals.decided), goals.bounded
    size, unit, weight = ca.MX.sym("size", n), ca.MX.sym("unit", m), ca.MX.sym("weight")
    defects, points = METHODS[method]
    defects = partial(stepped, parts=parts) if defects is stepped else defects
    u, x = ca.MX.sym("u", m, steps), ca.MX.sym("x", n, steps * points)
    slack = ca.MX.sym("slack", len(bounded), steps)
    x0, t0, before = ca.MX.sym("x0", n), ca.MX.sym("t0"), ca.MX.sym("before", m)
    goal = ca.MX.sym("goal", len(goals.track), steps)
    given = ca.MX.sym("given", len(order) - m, steps)

    def rates(t: Any, state: Any, held: Any) -> Any:
        return model(t, state, held)[0]

    cost, equal, observed = 0.0, [], []
    state, last = x0, before
    for k in range(steps):
        own, t = u[:, k] * unit, t0 + k * dt
        held = ca.vertcat(own, given[:, k])[order]
        inner = x[:, k * points : (k + 1) * points] * ca.repmat(size, 1, points)
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
    rooms = np.array([goals.size(name) for name in bounded]).reshape(-1, 1)
    limited = seen[[goals.observed.index(name) for name in bounded], :] / np.tile(rooms, steps)
    rows = ca.veccat(*equal, limited + slack, limited - slack)
    unknowns = ca.veccat(u, x, slack)
    parameters = ca.veccat(x0, t0, before, goal, given, size, unit, weight)
    options = {
        "print_time": False,
        "error_on_fail": False,
        "ipopt": {"print_level": 0, "sb": "yes", "max_iter": iterations, "tol": 1e-7},
    }
    total = weight * cost + SOFT * ca.sumsqr(slack)
    nlp = {"x": unknowns, "f": total, "g": rows, "p": parameters}
    ends = ca.horzcat(x0, x[:, points - 1 :: points] * ca.repmat(size, 1, steps))
    return NonlinearProgram(
        ca.nlpsol("mpc", "ipopt", nlp, options),
        ca.Function("plan", [unknowns, parameters], [u * ca.repmat(unit, 1, steps), ends, seen]),
        _linearized(ca, model, goals, order, n),
        goals,
        (m, n * points, len(bounded)),
        steps,
    )


def _linearized(ca: Any, model: Any, goals: Goals, order: list[int], n: int) -> Any:
    t, x, m = ca.MX.sym("t"), ca.MX.sym("x", n), len(goals.decided)
    own, given = ca.MX.sym("own", m), ca.MX.sym("given", len(order) - m)
    rates, observed = model(t, x, ca.vertcat(own, given)[order])
    seen = observed[: len(goals.track)]
    by = [ca.jacobian(what, of) for what in (rates, seen) for of in (x, own)]
    return ca.Function("linearized", [t, x, own, given], [rates, seen, *by])


def _weighted(ca: Any, weights: Iterable[float], values: Any) -> Any:
    return ca.dot(ca.DM([float(w) for w in weights]), values**2)
