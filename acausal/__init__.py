"""Connect physical components in Python; get, simulate and train a physics-enhanced neural ODE in JAX."""

import jax as _jax

_jax.config.update("jax_enable_x64", True)

from acausal.component import Component, Connector  # noqa: E402
from acausal.errors import (  # noqa: E402
    AcausalError,
    ConnectionError,  # noqa: A004
    DataError,
    DeclarationError,
    InitializationError,
    ModelError,
    SimulationError,
    StructureError,
    TrainingError,
)
from acausal.functions import (  # noqa: E402
    Abs,
    acos,
    asin,
    atan,
    atan2,
    cos,
    cosh,
    exp,
    floor,
    log,
    maximum,
    minimum,
    pi,
    prescribed,
    sign,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
    where,
)
from acausal.symbols import (  # noqa: E402
    Eq,
    Flow,
    Input,
    Module,
    Option,
    Output,
    Parameter,
    Potential,
    Start,
    Variable,
    der,
    time,
)
from acausal.system import System, compile  # noqa: A004, E402

__version__ = "0.1.0"
