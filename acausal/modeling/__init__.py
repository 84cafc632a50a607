"""What a user declares: components, connectors, parameters, variables and equations.

In: classes that a user writes. Out: a tree of `Component` with sympy equations over references.
It knows neither JAX nor files, nor any later stage.
"""

from sympy import pi as pi

from acausal.modeling.assertions import Assert as Assert
from acausal.modeling.budget import (
    PYTHON as PYTHON,
    Budget as Budget,
    BudgetError as BudgetError,
    charge as charge,
    check_nested as check_nested,
    check_size as check_size,
    native_file as native_file,
    spending as spending,
)
from acausal.modeling.component import Component as Component
from acausal.modeling.connector import Connector as Connector
from acausal.modeling.declarations import (
    KINDS as KINDS,
    STATE_SELECT as STATE_SELECT,
    TEAR_SELECT as TEAR_SELECT,
    Declaration as Declaration,
    Discrete as Discrete,
    DiscreteOutput as DiscreteOutput,
    Flow as Flow,
    InitialParameter as InitialParameter,
    Input as Input,
    Module as Module,
    Option as Option,
    Output as Output,
    Parameter as Parameter,
    Potential as Potential,
    Start as Start,
    Variable as Variable,
    element_name as element_name,
    element_names as element_names,
    in_tuples as in_tuples,
    is_of_kind as is_of_kind,
)
from acausal.modeling.documentation import (
    declarations_of as declarations_of,
    sections as sections,
    signature as signature,
    unit_and_doc as unit_and_doc,
)
from acausal.modeling.endpoints import (
    Endpoint as Endpoint,
    endpoint_label as endpoint_label,
    is_vector as is_vector,
    owner_and_name as owner_and_name,
)
from acausal.modeling.events import (
    HALF as HALF,
    INITIAL as INITIAL,
    Previous as Previous,
    Reinit as Reinit,
    Tick as Tick,
    Watched as Watched,
    When as When,
    change as change,
    condition as condition,
    edge as edge,
    initial as initial,
    literal as literal,
    number_or_truth as number_or_truth,
    pre as pre,
    sample as sample,
    where as where,
)
from acausal.modeling.functions import (
    COMPUTABLE as COMPUTABLE,
    Abs as Abs,
    Atan2 as Atan2,
    Floored as Floored,
    Prescribed as Prescribed,
    acos as acos,
    asin as asin,
    asinh as asinh,
    atan as atan,
    atan2 as atan2,
    cos as cos,
    cosh as cosh,
    dividend as dividend,
    exp as exp,
    floor as floor,
    log as log,
    maximum as maximum,
    minimum as minimum,
    prescribed as prescribed,
    sign as sign,
    sin as sin,
    sinh as sinh,
    sqrt as sqrt,
    tan as tan,
    tanh as tanh,
)
from acausal.modeling.icon import Icon as Icon, Placement as Placement, Shape as Shape, Side as Side
from acausal.modeling.names import (
    ByName as ByName,
    Name as Name,
    antiderivatives as antiderivatives,
    by_element as by_element,
    by_name as by_name,
    elements_of as elements_of,
    full_name as full_name,
    names_in as names_in,
    names_matching as names_matching,
    with_elements as with_elements,
)
from acausal.modeling.outer import inherit as inherit, inherited as inherited
from acausal.modeling.summary import value_text as value_text
from acausal.modeling.symbols import (
    Eq as Eq,
    GivenModule as GivenModule,
    ModuleCall as ModuleCall,
    ModuleReference as ModuleReference,
    Reference as Reference,
    der as der,
    each as each,
    primes as primes,
    references as references,
    time as time,
)
from acausal.modeling.written import as_written as as_written
