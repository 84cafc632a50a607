"""One-dimensional rotational mechanics (`Modelica.Mechanics.Rotational`).

```python
from acausal.components import rotational as rot

inertia = rot.Inertia(J=1.0)
```
"""

from acausal.components.mechanics.rolling import *
from acausal.components.mechanics.rotational import *
from acausal.components.modelica import export

from . import utilities as utilities
from .adaptors import *
from .compliances import *
from .components import *
from .friction import *
from .gears import *
from .interfaces import *
from .sensors import *
from .sources import *
from .torques import *

export(__name__, "utilities")
