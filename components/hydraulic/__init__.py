"""Hydraulics of one incompressible liquid, without heat: tanks, orifices, weirs, pumps.

```python
import acausal as ac
from acausal.components import hydraulic

tank = hydraulic.OpenTank(crossArea=0.01, level=ac.Start(0.1, fixed=True))
```

Ports are those of `Modelica.Fluid` with pressure and mass flow alone, and names are taken from there. The liquid is
given by its density ``rho``, that of water by default. With ``p_ambient`` zero, pressures are relative to the air's.
Where a flow carries heat, take `acausal.components.fluid`.
"""

from acausal.components.modelica import export

from .components import *
from .interfaces import *
from .sensors import *
from .sources import *

export(__name__)
