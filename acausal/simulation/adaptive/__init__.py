"""Adaptive steps: one loop for every method; what it did is kept as rows, and derivatives make these steps again.

In: a `Run` and a solver. Out: a `Solution`.
"""

from acausal.simulation.adaptive.over_rows import (
    Adaptive as Adaptive,
    integrate_adaptively as integrate_adaptively,
)
from acausal.simulation.adaptive.simulate_adaptive import simulate_adaptive as simulate_adaptive
from acausal.simulation.adaptive.tolerances import (
    Tolerance as Tolerance,
    check_tolerances as check_tolerances,
)
