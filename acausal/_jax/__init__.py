"""What knows JAX and no model.

In: JAX functions and arrays. Out: the same computed faster, and what JAX must be told before it starts.
It knows no model, no data and no training. Its names stand in `__init__.pyi` and are imported when first asked for.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
