"""Magnetic circuits of flux tubes (`Modelica.Magnetic.FluxTubes`).

```python
from acausal.components import magnetic as mag

core = mag.Cuboid(material=mag.M350_50A(), l=0.26, a=0.025, b=0.025)
```

Tubes that pull at an armature are in the module `force`, leakage tubes in `leakage`, materials of magnets in
`hard_magnetic`, materials with hysteresis in `hysteresis_data`.
"""

from acausal.components.modelica import export

from . import (
    force as force,
    hard_magnetic as hard_magnetic,
    hysteresis_data as hysteresis_data,
    leakage as leakage,
    soft_magnetic as soft_magnetic,
)
from .basic import *
from .fixed_shape import *
from .hysteresis import *
from .interfaces import *
from .magnets import *
from .sensors import *
from .soft_magnetic import *
from .sources import *

export(__name__, "force", "hard_magnetic", "hysteresis_data", "leakage", "soft_magnetic")
