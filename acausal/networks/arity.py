"""How many inputs a network takes: broadcasting would make something of any other number, without a word."""

from __future__ import annotations

from collections.abc import Sequence

import jax.numpy as jnp
from jax.typing import ArrayLike

from acausal._jax import is_real
from acausal.errors import DeclarationError, shown


def check_inputs(network: object, inputs: Sequence[ArrayLike], expected: int) -> None:
    """Check that a network is called with as many scalars as it has inputs.

    Raises:
        DeclarationError: if it is not.
    """
    name, wanted = type(network).__name__, f"{expected} input{'s' * (expected != 1)}"
    if len(inputs) != expected:
        mend = "give the others, too" if len(inputs) < expected else "leave out the others"
        raise DeclarationError(
            f"{name}: a network of {wanted} is called with {len(inputs)}; {mend}"
        )
    for x in inputs:
        if not is_real(x):
            raise DeclarationError(f"{name}: a network takes real numbers, not {shown(x)}.")
    shapes = [shape for x in inputs if (shape := jnp.shape(x))]
    if shapes:
        raise DeclarationError(
            f"{name}: a network takes scalars, not an array of shape {shapes[0]}; use jax.vmap(network)"
        )
