"""Coolant circuits (`Modelica.Thermal.FluidHeatFlow`): incompressible flow that carries heat.

```python
from acausal.components import fluid

pump = fluid.VolumeFlow(medium=fluid.Water(), constantVolumeFlow=1e-3)
```

A medium is a record of constants, one of the module `media`. Flows may split, mix and reverse.
"""

from acausal.components.modelica import export

from . import media as media
from .bases import *
from .components import *
from .interfaces import *
from .media import *
from .sensors import *
from .sources import *
from .utilities import *

export(__name__, "media")
