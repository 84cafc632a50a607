"""Parameters that have a value for each record: an offset of a sensor, the friction of a day."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import array, is_number
from acausal.codegen import Packed
from acausal.errors import TrainingError, nearest, shown
from acausal.modeling import names_in

if TYPE_CHECKING:
    from acausal.system import System


class PerRecord(eqx.Module):
    """Parameters with a value for each of R records: their common value and a deviation of each record.

    Attributes:
        names: the parameters.
        scale: the deviation that one unit of what is trained means.
        tied: 1 where ``scale`` is the prior standard deviation of the deviations, 0 where they are free.
        places: where the parameters, and all that depend on them, lie in `Packed.values`.
        trained: of every record 1 where the training sees it, else 0.
    """

    names: tuple[str, ...] = eqx.field(static=True)
    scale: Float[Array, " n_own"]
    tied: Float[Array, " n_own"]
    places: tuple[int, ...] = eqx.field(static=True)
    trained: Float[Array, " R"]

    def start(self, records: int) -> dict[str, Float[Array, " R"]]:
        """What is trained, where training starts."""
        return {n: jnp.zeros(records) for n in self.names}

    def values(
        self, params: Mapping[str, Any], moves: Mapping[str, Float[Array, " R"]]
    ) -> dict[str, Float[Array, " R"]]:
        """The value of every record, by parameter."""
        rows = zip(self.names, self.scale, strict=True)
        return {n: params[n] + scale * moves[n] for n, scale in rows}

    def packed(
        self, system: System, params: Mapping[str, Any], moves: Mapping[str, Float[Array, " R"]]
    ) -> Float[Array, "R n_places"] | None:
        """The numbers in ``places`` for every record; ``None`` without such parameters."""
        if not self.names:
            return None

        def one(own: dict[str, Float[Array, ""]]) -> Float[Array, " n_places"]:
            return system.pack({**params, **own}).values[np.asarray(self.places)]

        return jax.vmap(one)(self.values(params, moves))

    def expected(
        self, moves: Mapping[str, Float[Array, " R"]], records: int
    ) -> dict[str, Float[Array, " records"]]:
        """What to expect of other records: the mean of those that the training has found."""
        return {
            n: jnp.full(records, jnp.average(moves[n], weights=self.trained)) for n in self.names
        }

    def log_prior(self, moves: Mapping[str, Float[Array, " R"]]) -> Float[Array, ""]:
        """Minus the logarithm of the deviations' prior density, up to a constant."""
        terms = [
            0.5 * t * jnp.sum(moves[n] ** 2) for n, t in zip(self.names, self.tied, strict=True)
        ]
        return sum(terms, jnp.zeros(()))


def for_records(
    packed: Packed,
    places: tuple[int, ...],
    own: Float[Array, "R n_places"] | None,
    records: int,
) -> Packed:
    """Parameters with values of shape (R, n_parameters)."""
    values = jnp.broadcast_to(packed.values, (records, *packed.values.shape))
    if own is not None:
        values = values.at[:, np.asarray(places)].set(own)
    return Packed(values, packed.modules)


def per_record(
    system: System,
    given: Mapping[str, float | None] | None,
    params: Mapping[str, Any],
    records: int,
) -> PerRecord:
    """Check a user's choice: by parameter the standard deviation between records, or ``None`` for free values.

    Raises:
        TrainingError: for a name that is not a numeric parameter, or what is not a deviation.
    """
    chosen = {name: (given or {})[name] for name in names_in(given or {}, "per_record")}
    numbers = [n for n, leaf in params.items() if not callable(leaf)]
    for name, spread in chosen.items():
        if name not in numbers:
            reason = system.layout.why_not_free(name)
            raise TrainingError(
                f"per_record: {reason or f'no parameter {name!r}: {nearest(name, numbers)}'}"
            )
        if spread is not None and not (is_number(spread) and spread > 0):
            raise TrainingError(
                f"per_record: '{name}' has the spread {shown(spread)}; give its standard deviation from record to "
                "record in its unit, or None for free values."
            )
    names = tuple(chosen)
    free = [s is None or math.isinf(s) for s in chosen.values()]
    sizes = [abs(float(params[n])) or 1.0 for n in names]
    scale = [
        size if is_free else float(s or 0.0)
        for s, size, is_free in zip(chosen.values(), sizes, free, strict=True)
    ]
    return PerRecord(
        names,
        array(scale),
        array(1.0 - np.asarray(free, float)),
        system.layout.depending(names),
        array(np.ones(records)),
    )
