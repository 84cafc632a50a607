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

from .components import LinearResistance, OpenTank, Orifice, StaticHead, Weir
from .interfaces import FluidPort, FluidPort_a, FluidPort_b, PartialTwoPortTransport
from .sensors import MassFlowRate, PartialFlowSensor, Pressure, RelativePressure, VolumeFlowRate
from .sources import Boundary, MassFlowSource

__all__ = [
    "Boundary",
    "FluidPort",
    "FluidPort_a",
    "FluidPort_b",
    "LinearResistance",
    "MassFlowRate",
    "MassFlowSource",
    "OpenTank",
    "Orifice",
    "PartialFlowSensor",
    "PartialTwoPortTransport",
    "Pressure",
    "RelativePressure",
    "StaticHead",
    "VolumeFlowRate",
    "Weir",
]
