"""Generate: a reduced model becomes a program, which is data, and JAX runs it.

In: a `ReducedModel`. Out: a `Program` and the layout of its parameters.
It knows nothing of initial values, time integration or data.
"""

from acausal.codegen.explain_nonfinite import explain_breakdown as explain_breakdown
from acausal.codegen.generator import generate as generate
from acausal.codegen.instructions import chosen_module as chosen_module
from acausal.codegen.lower import ModuleValue as ModuleValue, evaluate as evaluate
from acausal.codegen.newton import Dense as Dense, root as root
from acausal.codegen.parameters import (
    Packed as Packed,
    ParameterLayout as ParameterLayout,
    lay_out_parameters as lay_out_parameters,
)
from acausal.codegen.program import Program as Program
from acausal.codegen.values import Values as Values
