"""Analyse: properties of a compiled model or a learned law.

In: a `System`, a network or a record. Out: a linearization, a formula, estimated states.
It calls simulation for steps; it knows nothing of training.
"""

from acausal.analysis.distillation import (
    Distilled as Distilled,
    Formula as Formula,
    distill as distill,
)
from acausal.analysis.estimate import estimate as estimate
from acausal.analysis.estimation import Estimation as Estimation
from acausal.analysis.linearization import Linearization as Linearization, linearize as linearize
from acausal.analysis.module_calls import (
    Calls as Calls,
    Labels as Labels,
    arguments as arguments,
    calls as calls,
    labels as labels,
    target as target,
)
from acausal.analysis.observer import (
    Observer as Observer,
    ObserverMemory as ObserverMemory,
    observer as observer,
)
from acausal.analysis.opened_loops import OpenLoop as OpenLoop, open_loop as open_loop
from acausal.analysis.operating_point import (
    OperatingPoint as OperatingPoint,
    operating_point as operating_point,
)
from acausal.analysis.switches import in_switches as in_switches
from acausal.analysis.tracking import parts_of_steps as parts_of_steps
