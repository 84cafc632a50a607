"""Typical sizes of what a program seeks, so that its tolerances mean the same in any unit."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.linalg import expm

from acausal.control.goals import Goals

MANY = 300
"""Of models with more states, nothing but where they are tells their sizes."""

GROWN = 100.0
"""So far an unstable mode may grow in what is asked of the linearized model."""

ROUNDOFF = 1e-9
"""An input that moves a variable by less than this part of what another one does moves it by roundoff."""


class TypicalSizes(NamedTuple):
    """Typical sizes; 0 where nothing tells.

    Attributes:
        states, inputs: of the model's states, and of the decided inputs, in their units.
        cost: what is minimised costs about this much.
    """

    states: Float[np.ndarray, " n_states"]
    inputs: Float[np.ndarray, " m"]
    cost: Float[np.ndarray, ""]

    def with_earlier(self, earlier: TypicalSizes | None) -> TypicalSizes:
        """The larger of both: what has come to rest keeps its size."""
        return self if earlier is None else TypicalSizes(*map(np.maximum, self, earlier))

    def filled(self, nominal: Float[np.ndarray, " n_states"]) -> TypicalSizes:
        """All above zero."""
        usual = nominal, np.ones_like(self.inputs), np.ones(())
        pairs = zip(self, usual, strict=True)
        return TypicalSizes(*(np.where(own > 0, own, other) for own, other in pairs))

    @property
    def numbers(self) -> Float[np.ndarray, " n"]:
        """All in one, the weight of the cost last."""
        return np.concatenate([self.states, self.inputs, [1 / self.cost]])


def sizes(
    linearized: Any,
    goals: Goals,
    x: Float[np.ndarray, " n_states"],
    t: float,
    goal: Float[np.ndarray, "n_tracked n"],
    given: Float[np.ndarray, "n_given n"],
    dt: float,
) -> TypicalSizes:
    """Typical sizes from what the linearized model does over the horizon, freely and when its inputs jump.

    Arguments:
        linearized: a CasADi function from ``t, x``, decided and given inputs to ``der(x)``, the tracked variables,
            and the derivatives of both by states and by decided inputs.
        goals: of the controller.
        x, t: where the horizon starts. goal, given: over it. dt: its sample time.
    """
    limits = np.array([goals.ends(name) for name in goals.decided])
    still, spans = np.clip(0.0, *limits.T), limits[:, 1] - limits[:, 0]
    units = np.where(np.isfinite(spans), spans, 0.0)
    found, off, efforts = np.abs(x), goal, np.array([*goals.effort.values()])
    rows = given.T if len(x) <= MANY else given.T[:0]
    rows = rows if (rows != rows[:1]).any() else rows[:1]
    parts = [
        [np.asarray(part) for part in linearized(t + k * dt, x, still, row)]
        for k, row in enumerate(rows)
    ]
    if parts and all(np.isfinite(part).all() for own in parts for part in own):
        _, seen, a, b, c, d = parts[0]
        rates = np.hstack([own[0] for own in parts] + [parts[-1][0]] * (goal.shape[1] - len(parts)))
        free, forced = _responses(a, b, rates, dt)
        off = goal[:, : free.shape[1]] - seen - c @ free
        moves = np.abs(c @ forced + d.T[:, :, None]).max(axis=2)  # (m, n_tracked)
        moves = np.where(moves > ROUNDOFF * moves.max(axis=0, initial=0.0), moves, 0.0)
        far = np.abs(off).max(axis=1, initial=0.0)
        asked = (moves > 0) & (far > 0)
        needed = np.where(asked, far / np.where(asked, moves, 1.0), np.inf).min(axis=1)
        units = np.where(units > 0, units, np.where(np.isfinite(needed), needed, 0.0))
        reach = np.abs(forced).max(axis=2) * units[:, None]
        found = np.maximum(found, np.abs(x + free.T).max(axis=0))
        found = np.maximum(found, reach.max(axis=0, initial=0.0))
    cost = np.array([*goals.track.values()]) @ np.mean(off**2, axis=1)
    cost = goal.shape[1] * (cost if cost > 0 else efforts @ units**2)
    return TypicalSizes(*(np.where(np.isfinite(size), size, 0.0) for size in (found, units, cost)))


def _responses(
    a: Float[np.ndarray, "n n"],
    b: Float[np.ndarray, "n m"],
    rates: Float[np.ndarray, "n steps"],
    dt: float,
) -> tuple[Float[np.ndarray, "n k"], Float[np.ndarray, "m n k"]]:
    """How far a linear model moves from where it has these rates, and by a unit of each input more.

    Of an unstable one, over the first k samples, until its fastest mode has grown as `GROWN` says.
    """
    n, steps = rates.shape
    fastest = float(np.linalg.eigvals(a).real.max(initial=0.0))
    if fastest * dt * steps > np.log(GROWN):
        steps = max(1, int(np.log(GROWN) / (fastest * dt)))
    both = expm(dt * np.block([[a, np.eye(n)], [np.zeros((n, 2 * n))]]))
    over, held = both[:n, :n], both[:n, n:]
    path, state = [], np.zeros((n, 1 + b.shape[1]))
    for k in range(steps):
        state = over @ state + held @ np.hstack([rates[:, k : k + 1], b])
        path.append(state)
    whole = np.stack(path, axis=2)
    return whole[:, 0], whole[:, 1:].transpose(1, 0, 2)
