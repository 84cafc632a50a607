"""Steps in one loop, for every method, with events or without; what it did is kept, and derivatives make it again.

In: a `Run` and a solver, or rows of samples. Out: a `Solution`, or an `Integrated`. `fixed_steps` makes fixed steps
of models without events.
"""

from acausal.simulation.steps.between_events import (
    BY_RATES as BY_RATES,
    CHATTERING as CHATTERING,
    DEADBAND_GROWTH as DEADBAND_GROWTH,
    NEAR as NEAR,
)
from acausal.simulation.steps.in_steps import (
    InSteps as InSteps,
    Tolerance as Tolerance,
    check_tolerances as check_tolerances,
)
from acausal.simulation.steps.over_rows import (
    Adaptive as Adaptive,
    integrate_in_steps as integrate_in_steps,
)
