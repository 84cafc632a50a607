"""Networks for use inside equations, and promises that they keep for all weights.

A network is a module that is called with scalars and returns a scalar. `MLP` is the paper's; `Law` and `Energy`
build networks that keep promises out of small parts. Each part keeps one promise, whatever network is inside it, even
a user's own module: ``ac.networks.Passive(my_network)``.

In: scales and promises. Out: equinox modules.
It knows no model.
"""

from acausal.networks.energy_parts import BesideQuadratic as BesideQuadratic
from acausal.networks.energy_spec import Energy as Energy
from acausal.networks.extrapolation import (
    Continued as Continued,
    ContinuedEnergy as ContinuedEnergy,
)
from acausal.networks.fourier import Fourier as Fourier
from acausal.networks.from_data import (
    Affine as Affine,
    LawShape as LawShape,
    Scales as Scales,
    lacks_scales as lacks_scales,
    linear_shape as linear_shape,
    with_scales as with_scales,
)
from acausal.networks.in_params import (
    networks as networks,
    output_scale as output_scale,
    remove_offset as remove_offset,
)
from acausal.networks.law_parts import (
    BesideLinear as BesideLinear,
    Between as Between,
    Even as Even,
    OffsetCorrected as OffsetCorrected,
    Passive as Passive,
    Positive as Positive,
)
from acausal.networks.law_spec import Law as Law
from acausal.networks.mlp import MLP as MLP, check_inputs as check_inputs
from acausal.networks.promises import (
    bounds_of as bounds_of,
    kept_promises as kept_promises,
    promises_of as promises_of,
)
from acausal.networks.scaled import (
    EnergyLaw as EnergyLaw,
    Scaled as Scaled,
    WithLaw as WithLaw,
    inputs_of as inputs_of,
    law_at as law_at,
    law_of as law_of,
    over_points as over_points,
    rise_of as rise_of,
)
