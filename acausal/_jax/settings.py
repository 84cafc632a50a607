"""JAX's settings, made before its first use."""

from __future__ import annotations

import os

import jax
from jaxlib.version import __version__ as jaxlib_version

from acausal._jax import compilation_cache, xla


def configure() -> None:
    """Compute in double precision, compile small loops as a whole, keep compiled programs between processes."""
    jax.config.update("jax_enable_x64", True)
    xla.compile_small_loops(os.environ, jaxlib_version)
    compilation_cache.begin(os.environ)
