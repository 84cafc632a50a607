"""Parameters trained beside networks: ``p̃ = (1 + γ tanh δ) p``, the paper's (7) and (8)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jax import Array

from acausal.errors import TrainingError, nearest


class Modifiers(eqx.Module):
    """Which parameters may move and how far.

    Attributes:
        names: the parameters.
        gammas: the largest relative change of each.
    """

    names: tuple[str, ...] = eqx.field(static=True)
    gammas: tuple[float, ...] = eqx.field(static=True)

    def start(self) -> dict[str, Array]:
        """The free variables δ where training starts: zero, which changes nothing."""
        return {name: jnp.zeros(()) for name in self.names}

    def relative(self, deltas: Mapping[str, Array]) -> dict[str, Array]:
        """The relative changes ``γ tanh δ`` of the parameters."""
        return {
            n: gamma * jnp.tanh(deltas[n]) for n, gamma in zip(self.names, self.gammas, strict=True)
        }

    def apply(self, params: Mapping[str, Any], deltas: Mapping[str, Array]) -> dict[str, Any]:
        """The parameters with their changes applied."""
        changed = {n: (1 + change) * params[n] for n, change in self.relative(deltas).items()}
        return {**params, **changed}


def modifiers(
    given: Mapping[str, float] | Iterable[str] | None, gamma: float, params: Mapping[str, Any]
) -> Modifiers:
    """Check a user's choice: names with a γ each, or names that share ``gamma``.

    Raises:
        TrainingError: for a name that is no numeric parameter, a γ outside (0, 1), or a parameter that is zero.
    """
    chosen = (
        {}
        if given is None
        else dict(given)
        if isinstance(given, Mapping)
        else dict.fromkeys(given, gamma)
    )
    numbers = [n for n, leaf in params.items() if not callable(leaf)]
    for name, limit in chosen.items():
        if name not in numbers:
            raise TrainingError(
                f"There is no parameter '{name}' to train: {nearest(name, numbers)}"
            )
        if not 0 < limit < 1:
            raise TrainingError(
                f"The modifier of '{name}' has gamma={limit}; choose it between 0 and 1."
            )
        if float(params[name]) == 0.0:
            raise TrainingError(
                f"Parameter '{name}' is 0, and a modifier multiplies; give it a value to start from."
            )
    return Modifiers(tuple(chosen), tuple(float(g) for g in chosen.values()))
