"""One-dimensional translational mechanics (`Modelica.Mechanics.Translational`).

```python
from acausal.components import translational as tl

mass = tl.Mass(m=1.0)
```
"""

from acausal.components.mechanics.rolling import *
from acausal.components.mechanics.translational import *
from acausal.components.modelica import export

from . import utilities as utilities
from .adaptors import *
from .components import *
from .forces import *
from .friction import *
from .interfaces import *
from .sensors import *
from .sources import *
from .stop import *
from .vehicle import *

export(__name__, "utilities")
