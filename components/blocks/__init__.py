"""Signal blocks (`Modelica.Blocks`): sources, mathematics, continuous and nonlinear blocks.

```python
from acausal.components import blocks

sine = blocks.Sine(f=50.0)
```
"""

from acausal.components.modelica import export

from . import discrete as discrete, math_boolean as math_boolean, math_integer as math_integer
from .averages import *
from .continuous import *
from .controllers import *
from .conversions import *
from .extrema import *
from .filters import *
from .integrators import *
from .interfaces import *
from .logical import *
from .lookup import *
from .math import *
from .memory import *
from .motions import *
from .noise import *
from .nonlinear import *
from .periodic import *
from .refused import *
from .routing import *
from .show import *
from .sources import *
from .statistics import *
from .tables import *
from .truth_sources import *
from .unit_conversions import *
from .waves import *

export(__name__, "discrete", "math_boolean", "math_integer")
