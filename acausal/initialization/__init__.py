"""Initialize: consistent initial states from starts, initial equations and a user's values.

In: a `ReducedModel` and its `Program`. Out: initial states, and a report on how each was found.
It knows nothing of time integration or data.
"""

from acausal.initialization.initialize import (
    Initialization as Initialization,
    Initializer as Initializer,
    initializer as initializer,
)
from acausal.initialization.model_rows import overview as overview
