"""Coolant circuits (`Modelica.Thermal.FluidHeatFlow`): incompressible flow that carries heat.

```python
from acausal.components import fluid

pump = fluid.VolumeFlow(medium=fluid.Water(), constantVolumeFlow=1e-3)
```

A medium is a record of constants, one of the module `media`. Flows may split, mix and reverse.
"""

from . import media
from .bases import SimpleFriction, SinglePortBottom, SinglePortLeft, TwoPort
from .components import Cylinder, OneWayValve, OpenTank, Pipe, Valve
from .interfaces import FlowPort, FlowPort_a, FlowPort_b
from .media import (
    Air_30degC,
    Air_70degC,
    Gylcol20_20degC,
    Gylcol50_20degC,
    Medium,
    MineralOil,
    Water,
    Water_10degC,
    Water_90degC,
)
from .sensors import (
    AbsoluteSensor,
    EnthalpyFlowSensor,
    FlowSensor,
    MassFlowSensor,
    PressureSensor,
    RelativeSensor,
    RelPressureSensor,
    RelTemperatureSensor,
    TemperatureSensor,
    VolumeFlowSensor,
)
from .sources import AbsolutePressure, Ambient, IdealPump, PressureIncrease, VolumeFlow
from .utilities import DoubleRamp

__all__ = [
    "AbsolutePressure",
    "AbsoluteSensor",
    "Air_30degC",
    "Air_70degC",
    "Ambient",
    "Cylinder",
    "DoubleRamp",
    "EnthalpyFlowSensor",
    "FlowPort",
    "FlowPort_a",
    "FlowPort_b",
    "FlowSensor",
    "Gylcol20_20degC",
    "Gylcol50_20degC",
    "IdealPump",
    "MassFlowSensor",
    "Medium",
    "MineralOil",
    "OneWayValve",
    "OpenTank",
    "Pipe",
    "PressureIncrease",
    "PressureSensor",
    "RelPressureSensor",
    "RelTemperatureSensor",
    "RelativeSensor",
    "SimpleFriction",
    "SinglePortBottom",
    "SinglePortLeft",
    "TemperatureSensor",
    "TwoPort",
    "Valve",
    "VolumeFlow",
    "VolumeFlowSensor",
    "Water",
    "Water_10degC",
    "Water_90degC",
    "media",
]
