"""Battery cells: open-circuit voltage, resistances and diffusion, whose laws over charge and temperature are learned.

```python
import acausal as ac
from acausal.components import battery

source = battery.OpenCircuitVoltage()
particle = battery.Particle(Q=31 * 3600, tau=600, soc_start=0.9)
```

A cell's voltage follows the charge at the *surface* of its electrodes' particles, which diffusion holds apart from
the mean while current flows. So charge has a connector of its own, `ChargePort`: its potential is the state of charge
there, its flow a current. An `OpenCircuitVoltage` joins it to the electrical circuit; `ChargeStorage` and `Diffusion`
behind it are for charge what capacitors and resistors are for electricity. Currents into the positive pin charge the
cell.

Laws are networks that keep what physics promises for all weights: the open-circuit voltage rises with the charge;
resistances, exchange currents and time constants are positive; what is lost heats. The temperature enters by
Arrhenius' law, and by the network as ``T_ref/T - 1``.
"""

from acausal.components.modelica import export

from .charge import *
from .interfaces import *
from .resistances import *
from .voltages import *

export(__name__)
