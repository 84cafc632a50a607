"""Signal blocks (`Modelica.Blocks`): sources, mathematics, continuous and nonlinear blocks.

```python
from acausal.components import blocks

sine = blocks.Sine(f=50.0)
```
"""

from acausal.components.modelica import export

from . import discrete as discrete
from .continuous import *
from .controllers import *
from .conversions import *
from .filters import *
from .integrators import *
from .interfaces import *
from .logical import *
from .lookup import *
from .math import *
from .motions import *
from .nonlinear import *
from .periodic import *
from .refused import *
from .refused_math import *
from .routing import *
from .sources import *
from .statistics import *
from .tables import *
from .truth_sources import *
from .unit_conversions import *
from .waves import *

export(__name__, "discrete")
