"""Heat transfer (`Modelica.Thermal.HeatTransfer`): lumped storage, conduction, convection and radiation.

```python
import acausal as ac
from acausal.components import thermal

mass = thermal.HeatCapacitor(C=15.0, T=ac.Start(373.15, fixed=True))
```

Temperatures are in kelvin. The modules `celsius`, `fahrenheit` and `rankine` hold sources, sensors and
conversions with other scales.
"""

from acausal.components.modelica import export

from . import celsius as celsius, fahrenheit as fahrenheit, rankine as rankine
from .adaptors import *
from .components import *
from .conditional import *
from .interfaces import *
from .sensors import *
from .sources import *
from .utilities import *

export(__name__, "celsius", "fahrenheit", "rankine")
