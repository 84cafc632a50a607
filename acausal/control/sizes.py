"""Typical sizes of what a program seeks, so that its tolerances mean the same in any unit."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.linalg import expm

from acausal.control.goals import Goals

MANY = 300
"""Of models with more states, nothing but what is given tells their sizes."""


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
    """TypicalSizes from what the linearized model does over the horizon, freely and when its inputs jump.

    Arguments:
        linearized: a CasADi function from ``t, x``, decided and given inputs to ``der(x)``, the tracked variables,
            and the derivatives of both by states and by decided inputs.
        goals: of the controller.
        x, t: where the horizon starts. goal, given: over it. dt: its sample time.
    """
    limits = np.array([goals.ends(name) for name in goals.decided])
    still, spans = np.clip(0.0, *limits.T), limits[:, 1] - limits[:, 0]
    units = np.where(np.isfinite(spans), spans, 0.0)
    found = np.abs(x)
    off = goal
    parts = linearized(t, x, still, given[:, 0]) if len(x) <= MANY else ()
    parts = [np.asarray(part) for part in parts]
    if parts and all(np.isfinite(part).all() for part in parts):
        rates, seen, a, b, c, d = parts
        with np.errstate(all="ignore"):  # what runs away tells nothing
            free, forced = _responses(a, b, rates.ravel(), dt, goal.shape[1])
            off = goal - seen - c @ free
            moves = np.abs(c @ forced + d[..., None].transpose(1, 0, 2)).max(
                axis=(1, 2), initial=0.0
            )
            needed = np.abs(off).max(initial=0.0) / np.where(moves > 0, moves, np.inf)
            units = np.where(units > 0, units, needed)
            reach = np.abs(forced).max(axis=2) * units[:, None]
            found = np.maximum(found, np.abs(x + free.T).max(axis=0))
            found = np.maximum(found, reach.max(axis=0, initial=0.0))
    cost = np.array([*goals.track.values()]) @ np.sum(off**2, axis=1)
    cost += goal.shape[1] * np.array([*goals.effort.values()]) @ units**2
    return TypicalSizes(*(np.where(np.isfinite(size), size, 0.0) for size in (found, units, cost)))


def _responses(
    a: Float[np.ndarray, "n n"],
    b: Float[np.ndarray, "n m"],
    rates: Float[np.ndarray, " n"],
    dt: float,
    steps: int,
) -> tuple[Float[np.ndarray, "n steps"], Float[np.ndarray, "m n steps"]]:
    """How far a linear model moves from where it has these rates, and by a unit of each input more."""
    n, held = len(rates), np.zeros((1 + b.shape[1], len(rates) + 1 + b.shape[1]))
    moves = expm(dt * np.block([[a, rates[:, None], b], [held]]))
    path, state = [], np.zeros((n, 1 + b.shape[1]))
    for _ in range(steps):
        state = moves[:n, :n] @ state + moves[:n, n:]
        path.append(state)
    whole = np.stack(path, axis=2)
    return whole[:, 0], whole[:, 1:].transpose(1, 0, 2)
