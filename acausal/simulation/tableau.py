"""The coefficients of Runge–Kutta schemes: for fixed steps, adaptive steps, and C."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, cast

import diffrax as dfx
import numpy as np
from jaxtyping import Array, Float

from acausal.simulation.solvers import Scheme

State = Float[Array, " n_states"]


class Tableau(NamedTuple):
    """A scheme whose stages are computed one after the other.

    Attributes:
        rows: by stage, the weights of the stages before it.
        diagonal: by stage, its own weight; 0 where it is explicit.
        fractions: by stage, its place in the step.
        weights: of all stages in the result. errors: and in an estimate of its error; none where there is no estimate.
        guesses: by stage, the weights of those before it in a guess of its derivative.
        hands_on: whether the last stage is the first one of the next step.
    """

    rows: tuple[tuple[float, ...], ...]
    diagonal: tuple[float, ...]
    fractions: tuple[float, ...]
    weights: tuple[float, ...]
    errors: tuple[float, ...] = ()
    guesses: tuple[tuple[float, ...], ...] = ()
    hands_on: bool = False

    @property
    def is_implicit(self) -> bool:
        """Whether a stage is the solution of equations."""
        return any(self.diagonal)

    def without_estimate(self) -> Tableau:
        """Without the stages that serve only the estimate of the error."""
        needed = {i for i, b in enumerate(self.weights) if b}
        for i in reversed(range(len(self.rows))):
            needed |= {j for j, a in enumerate(self.rows[i]) if a and i in needed}

        def kept(row: Sequence[float]) -> tuple[float, ...]:
            return tuple(v for i, v in enumerate(row) if i in needed)

        rows, guesses = (
            tuple(kept(row) for i, row in enumerate(part) if i in needed)
            for part in (self.rows, self.guesses)
        )
        own = (kept(part) for part in (self.diagonal, self.fractions, self.weights))
        return Tableau(rows, *own, guesses=guesses)

    def square(self, rows: Sequence[Sequence[float]]) -> Float[np.ndarray, "n_stages n_stages"]:
        """Rows by stage as a matrix, with zeros where they end."""
        n = len(self.rows)
        return np.array([[*row, *np.zeros(n - len(row))] for row in rows])

    def stability_limit(self) -> float:
        """The rate of a damped mode, in units of 1/step, from which on an explicit scheme lets it grow."""
        rates = np.linspace(0.0, 10.0, 1001)[1:]
        stages: list[np.ndarray] = []  # slopes over the state, in dx/dt = -x
        for row in self.rows:
            inner = sum((a * k for a, k in zip(row, stages, strict=True)), np.zeros(len(rates)))
            stages.append(-(1 + rates * inner))
        grows = (
            np.abs(1 + rates * sum(b * k for b, k in zip(self.weights, stages, strict=True))) > 1
        )
        return float(rates[np.argmax(grows)]) if grows.any() else np.inf


def tableau_of(solver: Scheme) -> Tableau:
    """The coefficients of a Runge–Kutta scheme of diffrax; `solvers.for_fixed_steps` tells which these are."""
    if isinstance(solver, dfx.Euler):
        return Tableau(((),), (0.0,), (0.0,), (1.0,))
    if isinstance(solver, dfx.ImplicitEuler):
        heun = (-0.5, 0.5)  # diffrax takes the difference from Heun's method for the error
        return Tableau(((), (0.0,)), (0.0, 1.0), (0.0, 1.0), (0.0, 1.0), heun, hands_on=True)
    tableau = cast(dfx.ButcherTableau, cast(dfx.AbstractERK, solver).tableau)
    rows = ((), *map(_floats, tableau.a_lower))
    diagonal = np.zeros(len(rows)) if tableau.a_diagonal is None else tableau.a_diagonal
    return Tableau(
        rows,
        _floats(diagonal),
        _floats([tableau.c1, *tableau.c]),
        _floats(tableau.b_sol),
        _floats(tableau.b_error),
        () if tableau.a_predictor is None else ((), *map(_floats, tableau.a_predictor)),
        bool(tableau.fsal),
    )


def moved(x: State, h: Array, weights: Sequence[float], stages: Sequence[State]) -> State:
    """The state after a step of length h by a weighted sum of derivatives."""
    for weight, stage in zip(weights, stages, strict=False):
        x = x + (weight * h) * stage if weight else x
    return x


def _floats(numbers: Sequence[float] | np.ndarray) -> tuple[float, ...]:
    return tuple(float(v) for v in numbers)
