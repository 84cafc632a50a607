"""Networks for use inside equations, and promises that they keep for all weights.

A network is a module that is called with scalars and returns a scalar. `MLP` is the paper's; `Law` and `Energy` are
recipes for networks with promises. Such a network is put together from small parts, each of which keeps one promise
whatever is inside it, a user's own module, too: ``ac.networks.Passive(my_network)``.
"""

from acausal.networks.activations import (
    ACTIVATIONS,
)
from acausal.networks.beyond import (
    Continued,
    ContinuedEnergy,
)
from acausal.networks.bounded import (
    Between,
    Positive,
)
from acausal.networks.convex import (
    Convex,
)
from acausal.networks.energy import (
    Bowl,
    FromRest,
    Levelled,
)
from acausal.networks.fourier import (
    Fourier,
)
from acausal.networks.law import (
    Law,
)
from acausal.networks.mlp import (
    MLP,
)
from acausal.networks.monotone import (
    Monotone,
)
from acausal.networks.passage import (
    Passage,
)
from acausal.networks.passive import (
    Passive,
    SameSign,
)
from acausal.networks.potential import (
    Energy,
)
from acausal.networks.scaled import (
    Potential,
    Scaled,
    law_of,
)
from acausal.networks.slope import (
    Rounder,
    Steeper,
)
from acausal.networks.symmetry import (
    Even,
    Odd,
)
from acausal.networks.zero import (
    OffsetCorrected,
    ThroughZero,
)

__all__ = [
    "ACTIVATIONS",
    "MLP",
    "Between",
    "Bowl",
    "Continued",
    "ContinuedEnergy",
    "Convex",
    "Energy",
    "Even",
    "Fourier",
    "FromRest",
    "Law",
    "Levelled",
    "Monotone",
    "Odd",
    "OffsetCorrected",
    "Passage",
    "Passive",
    "Positive",
    "Potential",
    "Rounder",
    "SameSign",
    "Scaled",
    "Steeper",
    "ThroughZero",
    "law_of",
]
