"""The arrays that an optimizer changes, and the result of simulating with them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, Protocol

import equinox as eqx
from jaxtyping import Array, Float

from acausal.training.objective.modifiers import Modifiers


class Trainable(eqx.Module):
    """The arrays that an optimizer changes: a pytree of floating-point arrays.

    Attributes:
        networks: the arrays of every network that is trained, by name.
        modifiers: the free variable δ of every parameter that is trained, by name.
        states: where sequences begin, in the units of `ShootingStates`; ``None`` where that is not trained.
    """

    networks: dict[str, Any]
    modifiers: dict[str, Float[Array, ""]]
    states: Float[Array, "n_parts n_states"] | None = None


class Simulated(NamedTuple):
    """One simulation of the whole record.

    Attributes:
        loss: over every point of it.
        x: the states at every sample.
        y: the targets at every sample.
    """

    loss: Float[Array, ""]
    x: Float[Array, "n_samples n_states"]
    y: Float[Array, "n_samples n_targets"]


class WithModifiers(Protocol):
    """An objective that trains parameters."""

    @property
    def modifiers(self) -> Modifiers:
        """The parameters that are trained."""
        ...


def changes_of(objective: WithModifiers, trainable: Trainable) -> Mapping[str, Float[Array, ""]]:
    """The changes of the trained parameters, each as its modifier counts them."""
    return objective.modifiers.changes(trainable.modifiers)
