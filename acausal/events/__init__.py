"""Events: zero-crossing functions, event iteration, consistent start, root bracketing, and edges at known times.

In: a `ReducedModel`, its `Program` and the layout of its parameters. Out: `Events` and `Edges` as data, and what JAX
computes of them. It knows no steps: `acausal.simulation.steps` makes them.
"""

from acausal.events.consistent_start import (
    STARTS as STARTS,
    before_events as before_events,
    non_converged as non_converged,
    start_of as start_of,
)
from acausal.events.edges import Ahead as Ahead, Edges as Edges
from acausal.events.event_formulas import Events as Events, generate_events as generate_events
from acausal.events.event_iteration import (
    ALL_AT_ONCE as ALL_AT_ONCE,
    DOUBTED as DOUBTED,
    FORCED as FORCED,
    ONE_BY_ONE as ONE_BY_ONE,
    PASSES as PASSES,
    After as After,
    Pass as Pass,
    Rates as Rates,
    after_pass as after_pass,
    coincide as coincide,
    fire as fire,
)
from acausal.events.lines import PART_OF_PERIOD as PART_OF_PERIOD
from acausal.events.root_bracketing import (
    BAND as BAND,
    CLOSE as CLOSE,
    POINTS as POINTS,
    TRIES as TRIES,
    Bracketing as Bracketing,
    look as look,
    no_bracketing as no_bracketing,
)
from acausal.events.zero_crossings import (
    Due as Due,
    due as due,
    guards as guards,
    guards_and_rates as guards_and_rates,
    jumped as jumped,
    updated as updated,
)
