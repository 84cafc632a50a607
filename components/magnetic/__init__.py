"""Magnetic circuits of flux tubes (`Modelica.Magnetic.FluxTubes`).

```python
from acausal.components import magnetic as mag

core = mag.Cuboid(material=mag.M350_50A(), l=0.26, a=0.025, b=0.025)
```

Tubes that pull at an armature are in the module `force`, leakage tubes in `leakage`, materials of magnets in
`hard_magnetic`.
"""

from . import force, hard_magnetic, leakage, soft_magnetic
from .basic import (
    ConstantPermeance,
    ConstantReluctance,
    Crossing,
    EddyCurrent,
    ElectroMagneticConverter,
    ElectroMagneticConverterWithLeakageInductance,
    Ground,
    Idle,
    LeakageWithCoefficient,
    Short,
    VariablePermeance,
    VariableReluctance,
)
from .fixed_shape import (
    Cuboid,
    FixedShape,
    GenericFluxTube,
    HollowCylinderAxialFlux,
    HollowCylinderCircumferentialFlux,
    HollowCylinderRadialFlux,
    Toroid,
)
from .interfaces import (
    MagneticPort,
    NegativeMagneticPort,
    PositiveMagneticPort,
    Reluctance,
    TwoPort,
    TwoPortElementary,
    TwoPortExtended,
)
from .magnets import (
    GenericLinearPermanentMagnet,
)
from .sensors import (
    MagneticFluxSensor,
    MagneticPotentialDifferenceSensor,
)
from .soft_magnetic import (
    AISI_12L14,
    AISI_1008,
    DC01,
    DC03,
    M330_50A,
    M350_50A,
    M530_50A,
    M700_100A,
    M940_100A,
    MuMetall,
    Permenorm3601K3,
    RFe80,
    Steel_9SMn28K,
    Steel_9SMnPb28,
    VacoferS2,
    Vacoflux50,
    X6Cr17,
)
from .sources import (
    ConstantMagneticFlux,
    ConstantMagneticPotentialDifference,
    SignalMagneticFlux,
    SignalMagneticPotentialDifference,
)

__all__ = [
    "AISI_12L14",
    "AISI_1008",
    "DC01",
    "DC03",
    "M330_50A",
    "M350_50A",
    "M530_50A",
    "M700_100A",
    "M940_100A",
    "ConstantMagneticFlux",
    "ConstantMagneticPotentialDifference",
    "ConstantPermeance",
    "ConstantReluctance",
    "Crossing",
    "Cuboid",
    "EddyCurrent",
    "ElectroMagneticConverter",
    "ElectroMagneticConverterWithLeakageInductance",
    "FixedShape",
    "GenericFluxTube",
    "GenericLinearPermanentMagnet",
    "Ground",
    "HollowCylinderAxialFlux",
    "HollowCylinderCircumferentialFlux",
    "HollowCylinderRadialFlux",
    "Idle",
    "LeakageWithCoefficient",
    "MagneticFluxSensor",
    "MagneticPort",
    "MagneticPotentialDifferenceSensor",
    "MuMetall",
    "NegativeMagneticPort",
    "Permenorm3601K3",
    "PositiveMagneticPort",
    "RFe80",
    "Reluctance",
    "Short",
    "SignalMagneticFlux",
    "SignalMagneticPotentialDifference",
    "Steel_9SMn28K",
    "Steel_9SMnPb28",
    "Toroid",
    "TwoPort",
    "TwoPortElementary",
    "TwoPortExtended",
    "VacoferS2",
    "Vacoflux50",
    "VariablePermeance",
    "VariableReluctance",
    "X6Cr17",
    "force",
    "hard_magnetic",
    "leakage",
    "soft_magnetic",
]
