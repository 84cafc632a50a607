"""Generate: a reduced model becomes a program, which is data, and JAX runs it.

In: a `ReducedModel`. Out: a `Program` and the layout of its parameters.
It knows nothing of initial values, time integration or data.
"""

from acausal.codegen.assertions import (
    asserted as asserted,
    check_assertions as check_assertions,
    failures as failures,
)
from acausal.codegen.equation_formula import formula_of as formula_of
from acausal.codegen.equations import explicit_equations as explicit_equations
from acausal.codegen.gather import Gather as Gather
from acausal.codegen.generator import generate as generate
from acausal.codegen.instructions import (
    Accumulate as Accumulate,
    Arguments as Arguments,
    ArrayFormula as ArrayFormula,
    Instruction as Instruction,
    SolveTornLoop as SolveTornLoop,
    UnlikeFormulas as UnlikeFormulas,
)
from acausal.codegen.interpreter import (
    INSTRUCTION as INSTRUCTION,
    execute as execute,
    rates as rates,
    rates_and_read as rates_and_read,
    rates_from as rates_from,
    read as read,
    read_and_keep as read_and_keep,
    run as run,
)
from acausal.codegen.iteration_matrix import (
    DenseIterationMatrix as DenseIterationMatrix,
    SparseIterationMatrix as SparseIterationMatrix,
)
from acausal.codegen.jumping import explain_jump as explain_jump
from acausal.codegen.lower import ModuleValue as ModuleValue, evaluate as evaluate
from acausal.codegen.newton import Dense as Dense, root as root
from acausal.codegen.nonfinite import (
    explain_nonfinite as explain_nonfinite,
    said_by_modules as said_by_modules,
)
from acausal.codegen.packing import (
    bind as bind,
    default_parameters as default_parameters,
    pack as pack,
)
from acausal.codegen.parameters import (
    ParameterLayout as ParameterLayout,
    lay_out_parameters as lay_out_parameters,
)
from acausal.codegen.program import (
    DISCRETE as DISCRETE,
    ZERO as ZERO,
    Program as Program,
    described as described,
)
from acausal.codegen.reading import (
    Arrays as Arrays,
    add_up as add_up,
    compute as compute,
    fill as fill,
    read_elements as read_elements,
    read_parameters as read_parameters,
)
from acausal.codegen.state_jacobian import Field as Field, StateJacobian as StateJacobian
from acausal.codegen.unlike_formulas import join_formulas as join_formulas
from acausal.codegen.values import Packed as Packed, Values as Values
