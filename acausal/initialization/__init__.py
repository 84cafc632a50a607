"""Initialize: consistent initial states from starts, initial equations and a user's values.

In: a `ReducedModel` and its `Program`. Out: initial states, and the story of where they come from.
It knows nothing of time integration or data.
"""

from acausal.initialization.initialize import (
    Initialization as Initialization,
    Initializer as Initializer,
    initializer as initializer,
)
