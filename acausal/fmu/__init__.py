"""FMUs that come in: a part that somebody else made, as a component.

In: an archive. Out: `FMU`, a component whose equations call the FMU's library, with derivatives.
It knows declarations, units and JAX; nothing of flattening, structure or simulation. To simulate an FMU runs native
code.
"""

from acausal.fmu.component import FMU as FMU, HISTORY as HISTORY
from acausal.fmu.description import Description as Description, FMUVariable as FMUVariable
