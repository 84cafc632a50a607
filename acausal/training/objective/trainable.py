"""The arrays that an optimizer changes, and the result of simulating with them."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from acausal.simulation import Log


class Trainable(eqx.Module):
    """The arrays that an optimizer changes: a pytree of floating-point arrays.

    Attributes:
        networks: the arrays of every network that is trained, by name.
        modifiers: the free variable δ of every parameter that is trained, by name.
        per_record: by parameter, the deviation of every record, in the units of `PerRecord`.
        states: where sequences begin, in the units of `ShootingStates`; ``None`` where that is not trained.
        starts: where records start, in the units of `StartPrior`; ``None`` where that is known.
    """

    networks: dict[str, Any]
    modifiers: dict[str, Float[Array, ""]]
    per_record: dict[str, Float[Array, " R"]] = eqx.field(default_factory=dict)
    states: Float[Array, "n_parts n_states"] | None = None
    starts: Float[Array, "R n_states"] | None = None


class Simulated(NamedTuple):
    """One simulation of every record.

    Attributes:
        loss: over every sample of them.
        x: the states at every row.
        y: the targets at every row.
        log: what has happened, in a model with events.
        d: the discrete variables at every row of such a model.
    """

    loss: Float[Array, ""]
    x: Float[Array, "N n_states"]
    y: Float[Array, "N n_targets"]
    log: Log | None = None
    d: Float[Array, "N n_discrete"] | None = None
