"""JAX's settings, made before its first use.

They are made while JAX is being imported, see `at_import`: what they need imports JAX only when it is called.
"""

from __future__ import annotations

import os
from importlib.util import find_spec

from acausal.errors import AcausalError


def configure() -> None:
    """Compute in double precision, compile small loops as a whole, keep compiled programs between processes.

    A ``JAX_ENABLE_X64`` of the user's stays as it is: `need_double_precision` says what needs it.
    """
    import jax
    from jaxlib.version import __version__ as jaxlib_version

    from acausal._jax import compilation_cache, xla

    if "JAX_ENABLE_X64" not in os.environ:
        jax.config.update("jax_enable_x64", True)
    xla.choose_options(
        os.environ, jaxlib_version, other_devices=find_spec("jax_plugins") is not None
    )
    compilation_cache.begin(os.environ)


def need_double_precision() -> None:
    """Refuse to compute after double precision was switched off.

    Raises:
        AcausalError: with what to do instead.
    """
    import jax

    if not jax.config.jax_enable_x64:  # pyright: ignore[reportAttributeAccessIssue]
        raise AcausalError(
            "JAX's double precision is switched off, by JAX_ENABLE_X64 or after the import of acausal, which needs it "
            "to find initial values: jax.config.update('jax_enable_x64', True); to simulate or fit in single "
            "precision, give dtype='float32'."
        )
