"""Connect physical components in Python; get, simulate and train a physics-enhanced neural ODE in JAX.

`__init__.pyi` lists the public names, each with the room that it comes from. A room is imported when one of its
names is first used: JAX, optimizers and plots are imported lazily.
"""

import logging as _logging

import lazy_loader as _lazy

from acausal._jax import configure_with_jax as _configure_with_jax

_logging.getLogger(__name__).addHandler(_logging.NullHandler())
_configure_with_jax()
__version__ = "0.1.0"
__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
