"""Neural elements of any domain: two-ports whose law is a small network, with promises that it keeps.

They connect like their conventional fellows, a spring, a damper and a mass, a capacitor, a resistor and an inductor;
only their law is learned. A network has few inputs and one output, so that it can be looked at and judged as
physics. What it must never do, whatever its weights, is an option of the element, such as ``passive=True``.

J. Kamp, J. Ultsch, J. Brembeck: Closing the Sim-to-Real Gap with Physics-Enhanced Neural ODEs,
ICINCO 2023, doi 10.5220/0012160100003543.
"""

from .characteristic import Characteristic
from .compliance import Compliance
from .hysteresis import Hysteresis
from .inductance import Inductance
from .interfaces import PartialLaw, PartialNetwork, PartialNeural, PartialTwoPort
from .multiport import CompliancePort, MultiportCompliance
from .resistance import Resistance
from .transformer import LossyTransformer

__all__ = [
    "Characteristic",
    "Compliance",
    "CompliancePort",
    "Hysteresis",
    "Inductance",
    "LossyTransformer",
    "MultiportCompliance",
    "PartialLaw",
    "PartialNetwork",
    "PartialNeural",
    "PartialTwoPort",
    "Resistance",
]
