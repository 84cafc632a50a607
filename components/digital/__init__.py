"""Digital circuits with nine-valued logic (`Modelica.Electrical.Digital`).

```python
from acausal.components import digital

clock = digital.Clock(period=1e-3)
```

A signal is one of the numbers 1 ... 9, the values of `acausal.components.digital.logic.LOGIC` in order.
"""

from acausal.components.modelica import export

from .adders import *
from .converters import *
from .delayed_gates import *
from .delays import *
from .gates import *
from .sources import *

export(__name__)
