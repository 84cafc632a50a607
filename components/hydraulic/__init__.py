"""Hydraulics of one liquid, without heat: tanks, orifices, weirs, pipes, valves, pumps; volumes, tubes, cylinders.

```python
import acausal as ac
from acausal.components import hydraulic

tank = hydraulic.OpenTank(crossArea=0.01, level=ac.Start(0.1, fixed=True))
```

Ports are those of `Modelica.Fluid` with pressure and mass flow alone, and names are taken from there. The liquid is
given by its density ``rho``, that of water by default. With ``p_ambient`` zero, pressures are relative to the air's.
Components of `compressible` have a liquid that is compressed, with air in it: `liquid.Liquid` as the option ``fluid``.
Where a flow carries heat, take `acausal.components.fluid`.
"""

from acausal.components.modelica import export

from . import flow as flow, liquid as liquid
from .components import *
from .compressible import *
from .interfaces import *
from .pipes_and_pumps import *
from .sensors import *
from .sources import *

export(__name__, "flow", "liquid")
