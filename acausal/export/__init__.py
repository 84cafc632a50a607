"""Export: networks and models for other people's tools.

In: compiled systems, components and networks. Out: files that need no Python.
It knows no training. `__init__.pyi` lists its names; they are imported on first use.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
