"""The state at which a record starts, as the user gives it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import is_real
from acausal.data import Data
from acausal.errors import DataError, listing, nearest, shown

if TYPE_CHECKING:
    from acausal.system import System

InitialState = Literal["data", "model", "fit"] | Mapping[str, float]
"""As measured, as the model starts, found by the training, or values by name that replace the measured ones."""


def first_state(system: System, data: Data, x0: InitialState) -> Float[Array, " n_states"] | None:
    """The state at a record's start as ``x0`` says; ``None`` as the model starts.

    Raises:
        DataError: for another word, a name that is not a state, a value that is not a number, or a state that is
            neither in the data nor in ``x0``.
    """
    if x0 == "model":
        return None
    if isinstance(x0, str) and x0 != "data":
        raise DataError(f"x0='{x0}' is not an initial state: {nearest(x0, ('data', 'model'))}")
    given: Mapping[str, float] = {} if isinstance(x0, str) else x0
    for name, value in given.items():
        if name not in system.states:
            raise DataError(
                f"x0: '{name}' is not a state of the model: {nearest(name, system.states)}"
            )
        if not is_real(value) or not np.isfinite(value).all():
            raise DataError(f"x0: '{name}' is {shown(value)}; give a finite number.")
    unknown = [n for n in system.states if n not in data.signals and n not in given]
    if unknown:
        raise DataError(
            f"The data lack {listing(unknown)}, with which the record starts: "
            f"give x0={{'{unknown[0]}': ...}}, or x0='model' for the model's start values."
        )
    return jnp.asarray([given[n] if n in given else data[n][0] for n in system.states], float)
