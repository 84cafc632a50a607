"""What a user declares: components, connectors, parameters, variables and equations.

In: classes that a user writes. Out: a tree of `Component` with sympy equations over references.
It knows neither JAX nor files, and nothing of what is made of a model later.
"""

from acausal.modeling.component import Component as Component, endpoint_label as endpoint_label
from acausal.modeling.connector import Connector as Connector
from acausal.modeling.declarations import (
    STATE_SELECT as STATE_SELECT,
    Declaration as Declaration,
    Eq as Eq,
    Flow as Flow,
    InitialParameter as InitialParameter,
    Input as Input,
    Module as Module,
    ModuleCall as ModuleCall,
    ModuleReference as ModuleReference,
    Option as Option,
    Output as Output,
    Parameter as Parameter,
    Potential as Potential,
    Reference as Reference,
    Start as Start,
    Variable as Variable,
    der as der,
    element_names as element_names,
    primes as primes,
    references as references,
    time as time,
)
from acausal.modeling.functions import (
    COMPUTABLE as COMPUTABLE,
    Abs as Abs,
    Prescribed as Prescribed,
    acos as acos,
    asin as asin,
    atan as atan,
    atan2 as atan2,
    cos as cos,
    cosh as cosh,
    exp as exp,
    floor as floor,
    log as log,
    maximum as maximum,
    minimum as minimum,
    pi as pi,
    prescribed as prescribed,
    sign as sign,
    sin as sin,
    sinh as sinh,
    sqrt as sqrt,
    tan as tan,
    tanh as tanh,
    where as where,
)
