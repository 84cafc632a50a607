"""Tools for JAX that know no model.

In: JAX functions and arrays. Out: the same functions compiled to faster code, and JAX's settings.
It knows no model, no data and no training. `__init__.pyi` lists its names; they are imported on first use.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
