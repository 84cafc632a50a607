"""Reduce: a flat model becomes assignments, sums and algebraic loops in solving order.

In: a `FlatModel`. Out: a frozen `ReducedModel`: states, inputs and steps.
It knows integers and templates; no JAX. Its graph algorithms know integers alone.
"""

from acausal.structure.algebraic_loops import BlockEquation as BlockEquation, TornLoop as TornLoop
from acausal.structure.blocks import (
    Accumulation as Accumulation,
    Assignment as Assignment,
    SolvingStep as SolvingStep,
)
from acausal.structure.coloring import color_columns as color_columns, long_rows as long_rows
from acausal.structure.elimination_order import (
    SETTINGS as SETTINGS,
    THRESHOLD as THRESHOLD,
    Pattern as Pattern,
    analyse_diagonal as analyse_diagonal,
)
from acausal.structure.jacobian import (
    numeric_function as numeric_function,
    parameter_values as parameter_values,
)
from acausal.structure.loop_guesses import with_loop_guesses as with_loop_guesses
from acausal.structure.reduced_model import ReducedModel as ReducedModel, reduce as reduce
from acausal.structure.sparse_loops import SparseGroup as SparseGroup, SparseLoop as SparseLoop
from acausal.structure.state_dependence import (
    dependence_pattern as dependence_pattern,
    jacobian_pattern as jacobian_pattern,
)
from acausal.structure.switched_loops import may_repeat_itself as may_repeat_itself
