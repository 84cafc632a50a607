"""Planar mechanics: mechanisms, wheels and vehicles in a plane (after the Modelica library `PlanarMechanics` 1.6.0).

```python
from acausal.components import planar

joint, rod = planar.Revolute(), planar.FixedTranslation(r=(1.0, 0.0))
```

The few parts of spatial mechanics that a planar world meets are in the module `multibody`, signal blocks in
`utilities`.
"""

from acausal.components.modelica import export

from . import multibody as multibody, utilities as utilities
from .gears import *
from .interfaces import *
from .joints import *
from .parts import *
from .sensors import *
from .sources import *
from .vehicle import *
from .world import *

export(__name__, "multibody", "utilities")
