"""Whether JAX is tracing: then values cannot be looked at, and checks of them are left out."""

from typing import Any

import jax
from jax.core import Tracer


def traced(*trees: Any) -> bool:
    """Whether any leaf stands for a value that is not known yet."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(trees))
