"""Flatten: a component tree becomes equation templates and the integers that fill their slots.

In: a `Component`. Out: a frozen `FlatModel`.
It knows declarations; neither JAX nor any later stage.
"""

from acausal.flattening.analysis_points import opened as opened
from acausal.flattening.bindings import Binding as Binding, binding_levels as binding_levels
from acausal.flattening.connections import unconnected as unconnected
from acausal.flattening.equation_group import (
    AssertionGroup as AssertionGroup,
    EquationGroup as EquationGroup,
    GuardGroup as GuardGroup,
    UpdateGroup as UpdateGroup,
    join_groups as join_groups,
    specialised as specialised,
)
from acausal.flattening.flat_model import FlatModel as FlatModel, flatten as flatten
from acausal.flattening.foreseen import (
    BENT as BENT,
    CHOOSING as CHOOSING,
    EXTREMES as EXTREMES,
    SIGNS as SIGNS,
    STEPS as STEPS,
    WAVES as WAVES,
    compared as compared,
    is_foreseen as is_foreseen,
    is_straight as is_straight,
)
from acausal.flattening.given import with_inputs as with_inputs
from acausal.flattening.layout import Layout as Layout, tiled as tiled
from acausal.flattening.leaves_caches import LeavesCaches as LeavesCaches
from acausal.flattening.origin import (
    HIDDEN as HIDDEN,
    Origin as Origin,
    dotted as dotted,
    is_hidden as is_hidden,
)
from acausal.flattening.reading import (
    equations_of as equations_of,
    read_statements as read_statements,
)
from acausal.flattening.silent import discrete_side as discrete_side
from acausal.flattening.sums import Statement as Statement
from acausal.flattening.template import (
    Integers as Integers,
    Template as Template,
    interned as interned,
)
from acausal.flattening.templates import FEW_VARIANTS as FEW_VARIANTS
