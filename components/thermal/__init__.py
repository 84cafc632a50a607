"""Heat transfer (`Modelica.Thermal.HeatTransfer`): lumped storage, conduction, convection and radiation.

```python
import acausal as ac
from acausal.components import thermal

mass = thermal.HeatCapacitor(C=15.0, T=ac.Start(373.15, fixed=True))
```

Temperatures are in kelvin. The modules `celsius`, `fahrenheit` and `rankine` hold sources, sensors and
conversions with other scales.
"""

from . import celsius, fahrenheit, rankine
from .components import (
    BodyRadiation,
    Convection,
    ConvectiveResistor,
    GeneralHeatFlowToTemperatureAdaptor,
    GeneralTemperatureToHeatFlowAdaptor,
    HeatCapacitor,
    ThermalCollector,
    ThermalCollectorMatrix,
    ThermalConductor,
    ThermalResistor,
)
from .conditional import PartialConditionalHeatPort
from .interfaces import (
    Element1D,
    HeatPort,
    HeatPort_a,
    HeatPort_b,
    PartialElementaryConditionalHeatPort,
    PartialElementaryConditionalHeatPortWithoutT,
)
from .sensors import (
    ConditionalFixedHeatFlowSensor,
    HeatFlowSensor,
    RelTemperatureSensor,
    TemperatureSensor,
)
from .sources import (
    FixedHeatFlow,
    FixedTemperature,
    PrescribedHeatFlow,
    PrescribedTemperature,
)
from .utilities import Conduction, DirectCapacity, InverseCapacity

__all__ = [
    "BodyRadiation",
    "ConditionalFixedHeatFlowSensor",
    "Conduction",
    "Convection",
    "ConvectiveResistor",
    "DirectCapacity",
    "Element1D",
    "FixedHeatFlow",
    "FixedTemperature",
    "GeneralHeatFlowToTemperatureAdaptor",
    "GeneralTemperatureToHeatFlowAdaptor",
    "HeatCapacitor",
    "HeatFlowSensor",
    "HeatPort",
    "HeatPort_a",
    "HeatPort_b",
    "InverseCapacity",
    "PartialConditionalHeatPort",
    "PartialElementaryConditionalHeatPort",
    "PartialElementaryConditionalHeatPortWithoutT",
    "PrescribedHeatFlow",
    "PrescribedTemperature",
    "RelTemperatureSensor",
    "TemperatureSensor",
    "ThermalCollector",
    "ThermalCollectorMatrix",
    "ThermalConductor",
    "ThermalResistor",
    "celsius",
    "fahrenheit",
    "rankine",
]
