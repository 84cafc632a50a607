"""Analog electrical circuits (`Modelica.Electrical.Analog`).

```python
from acausal.components import electrical as el

resistor = el.Resistor(R=100.0)
```

The circuits of `op_amp_circuits` and `utilities` keep their modules, since blocks and elements have the same names.
"""

from acausal.components.modelica import export

from . import op_amp_circuits as op_amp_circuits, utilities as utilities
from .adaptors import *
from .amplifiers import *
from .arcs import *
from .basic import *
from .bipolar import *
from .converters import *
from .currents import *
from .diodes import *
from .emf import *
from .ideal import *
from .ideal_amplifiers import *
from .inductors import *
from .interfaces import *
from .lightning import *
from .lines import *
from .mosfets import *
from .sensors import *
from .switches import *
from .thyristors import *
from .triac import *
from .utilities import (
    Nand as Nand,
    NonlinearResistor as NonlinearResistor,
    Transistor as Transistor,
)
from .variable import *
from .voltages import *

export(__name__, "op_amp_circuits", "utilities")
