"""Initialize: consistent initial states from starts, initial equations and a user's values.

In: a `ReducedModel` and its `Program`. Out: initial states, and a report on how each was found.
It knows nothing of time integration or data.
"""

from acausal.initialization.event import (
    COINCIDE as COINCIDE,
    DECREED as DECREED,
    ONE_BY_ONE as ONE_BY_ONE,
    PASSES as PASSES,
    ROUNDS as ROUNDS,
    After as After,
    Rates as Rates,
    Round as Round,
    after_round as after_round,
    before_events as before_events,
    happen as happen,
    restless as restless,
    rounds_of as rounds_of,
    start_of as start_of,
)
from acausal.initialization.initialize import (
    Initialization as Initialization,
    Initializer as Initializer,
    initializer as initializer,
)
from acausal.initialization.model_rows import overview as overview
