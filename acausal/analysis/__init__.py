"""Analyse: properties of a compiled model or a learned law.

In: a `System` or a network. Out: a linearization, a formula, names.
It knows nothing of simulation or training.
"""

from acausal.analysis.distillation import Distilled as Distilled, distill as distill
from acausal.analysis.formula import Formula as Formula
from acausal.analysis.linearization import Linearization as Linearization, linearize as linearize
from acausal.analysis.module_calls import (
    Calls as Calls,
    Labels as Labels,
    arguments as arguments,
    calls as calls,
    labels as labels,
    target as target,
)
from acausal.analysis.operating_point import (
    OperatingPoint as OperatingPoint,
    operating_point as operating_point,
)
from acausal.analysis.switches import in_switches as in_switches
