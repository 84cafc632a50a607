"""Neural elements of any domain: two-ports whose law is a small network, with promises that it keeps.

They connect like a spring, a damper and a mass, or a capacitor, a resistor and an inductor; only their law is
learned. A network has few inputs and one output, so that you can plot it and judge it as
physics. What it must never do, for any weights, is an option of the element, such as ``passive=True``.

J. Kamp, J. Ultsch, J. Brembeck: Closing the Sim-to-Real Gap with Physics-Enhanced Neural ODEs,
ICINCO 2023, doi 10.5220/0012160100003543.
"""

from acausal.components.modelica import export

from .characteristic import *
from .compliance import *
from .friction import *
from .hysteresis import *
from .inductance import *
from .interfaces import *
from .mechanisms import *
from .multiport import *
from .resistance import *
from .transformer import *

export(__name__)
