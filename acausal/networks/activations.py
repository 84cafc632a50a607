"""Activations by name, and which of them keep what a network promises."""

from __future__ import annotations

from collections.abc import Callable

import jax
import jax.numpy as jnp
from jaxtyping import Array

from acausal.errors import DeclarationError, known_name

ACTIVATIONS: dict[str, Callable[[Array], Array]] = {
    "relu": jax.nn.relu,
    "tanh": jnp.tanh,
    "softplus": jax.nn.softplus,
    "silu": jax.nn.silu,
    "gelu": jax.nn.gelu,
    "elu": jax.nn.elu,
    "sin": jnp.sin,
    "identity": lambda x: x,
}
"""Activations by name."""

INCREASING = ("relu", "tanh", "softplus", "elu", "identity")
"""Those that never decrease, for monotone networks."""

SMOOTH = ("tanh", "softplus", "silu", "gelu", "elu", "sin")
"""Those with a continuous derivative, so that a force that is the derivative of an energy has no jumps."""

SMOOTH_AND_CONVEX = ("softplus", "elu")
"""Those that are also convex, for convex energies."""


def checked(name: str, allowed: tuple[str, ...] = tuple(ACTIVATIONS), use: str = "") -> str:
    """The name of an activation, if it is one of those allowed.

    Raises:
        DeclarationError: if it is not; ``use`` names the network in the message.
    """
    known_name(name, ACTIVATIONS, "no activation", DeclarationError)
    if name not in allowed:
        raise DeclarationError(
            f"activation '{name}' does not suit {use}; choose one of {', '.join(allowed)}"
        )
    return name
