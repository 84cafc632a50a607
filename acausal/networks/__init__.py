"""Networks for use inside equations, and promises that they keep for all weights.

A network is a module that is called with scalars and returns a scalar. `MLP` is the paper's; `Law` and `Energy`
put networks with promises together from small parts, each of which keeps one promise whatever is inside it, a
user's own module, too: ``ac.networks.Passive(my_network)``.

In: scales and promises. Out: equinox modules.
It knows no model.
"""

from acausal.networks.activations import ACTIVATIONS as ACTIVATIONS
from acausal.networks.bounded import Between as Between, Positive as Positive
from acausal.networks.convex import Convex as Convex
from acausal.networks.dry_friction_factor import Passage as Passage
from acausal.networks.energy import Bowl as Bowl, FromRest as FromRest, Levelled as Levelled
from acausal.networks.extrapolation import (
    Continued as Continued,
    ContinuedEnergy as ContinuedEnergy,
)
from acausal.networks.fourier import Fourier as Fourier
from acausal.networks.law import Law as Law
from acausal.networks.mlp import MLP as MLP
from acausal.networks.monotone import Monotone as Monotone
from acausal.networks.passive import Passive as Passive, SameSign as SameSign
from acausal.networks.potential import Energy as Energy
from acausal.networks.scaled import (
    Potential as Potential,
    Scaled as Scaled,
    inputs_of as inputs_of,
    law_of as law_of,
)
from acausal.networks.slope import Rounder as Rounder, Steeper as Steeper
from acausal.networks.symmetry import Even as Even, Odd as Odd
from acausal.networks.trainable import (
    networks as networks,
    output_scale as output_scale,
    remove_offset as remove_offset,
)
from acausal.networks.zero import OffsetCorrected as OffsetCorrected, ThroughZero as ThroughZero
