"""What is known of the states at which records start: measured ones within their noise, others within their size."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.data import Data, noise_level
from acausal.training.objective.initial_state import InitialState, by_record

if TYPE_CHECKING:
    from acausal.system import System

EXACT = 1e-5
"""A start is taken as it is measured where the noise is less than this part of the state's deviation."""


class StartPrior(eqx.Module):
    """Independent normal distributions of the states at which R records start, around those of `FirstStates`.

    Attributes:
        scale: standard deviations, in the states' units; 0 where a start is not found by the training.
    """

    scale: Float[Array, "R n_states"]

    def moved(
        self, states: Float[Array, "R n_states"], moves: Float[Array, "R n_states"] | None
    ) -> Float[Array, "R n_states"]:
        """The states after moves in standard deviations; as they are where nothing is known of moves."""
        return states if moves is None else states + self.scale * moves

    def log_prior(self, moves: Float[Array, "R n_states"] | None) -> Float[Array, ""]:
        """Minus the logarithm of the density, up to a constant."""
        return jnp.zeros(()) if moves is None else 0.5 * jnp.sum(moves**2)


def start_prior(system: System, data: Mapping[str, Data], x0: InitialState) -> StartPrior | None:
    """What is known of the starts of records; NaN for states that are not measured; ``None`` where all are exact.

    ``x0="auto"`` takes what is measured within its noise, and starts that the model fixes, of states that no record
    measures, as exact in records that begin where a simulation does, at time 0. Values by name are exact, and so is
    what is measured beside them.
    """
    states = system.states
    fixed = {n for n, own in zip(states, system.initializer.conditions.fixed, strict=False) if own}
    fixed = fixed.difference(*(record.signals for record in data.values()))

    def scale(record: Data, name: str, given: Mapping[str, float] | None) -> float:
        signal = record.signals.get(name)
        if given is not None and name in given:
            return 0.0
        if signal is None:
            return 0.0 if name in fixed and record.time[0] == 0 else np.nan
        if np.isnan(signal[0]):
            return np.nan if np.isnan(signal).all() else float(np.nanstd(signal))
        with np.errstate(over="ignore"):
            noise = noise_level([np.asarray(signal)], [np.asarray(record.time)])
            deviation = np.nanstd(signal)
        return noise if given is None and EXACT * deviation < noise < np.inf else 0.0

    rows: list[list[float]] = []
    for record, of in zip(data.values(), by_record(data, x0), strict=True):
        if isinstance(of, str) and of != "auto":
            rows.append([0.0] * len(states))
        else:
            rows.append([scale(record, n, None if isinstance(of, str) else of) for n in states])
    found = np.asarray(rows, float)
    return StartPrior(jnp.asarray(found)) if found.any() else None
