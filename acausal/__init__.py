"""Connect physical components in Python; get, simulate and train a physics-enhanced neural ODE in JAX."""

import os as _os

import jax as _jax
from jaxlib.version import __version__ as _jaxlib

from acausal import xla as _xla

_jax.config.update("jax_enable_x64", True)
_xla.compile_small_loops(_os.environ, _jaxlib)

from acausal import networks
from acausal.analyse import (
    Linearization,
    linearize,
)
from acausal.component import (
    Component,
)
from acausal.connector import (
    Connector,
)
from acausal.data import (
    Data,
)
from acausal.diagram import (
    diagram,
)
from acausal.errors import (
    AcausalError,
    ConnectionError,
    DataError,
    DeclarationError,
    InitializationError,
    ModelError,
    SimulationError,
    StructureError,
    TrainingError,
    UnitError,
)
from acausal.fit import (
    Fit,
    fit,
)
from acausal.functions import (
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
from acausal.initialize import Initialization
from acausal.netlist import (
    load,
    save,
)
from acausal.netlist_file import (
    NetlistError,
)
from acausal.networks.mlp import (
    MLP,
)
from acausal.networks.zero import (
    OffsetCorrected,
)
from acausal.neural import (
    remove_offset,
)
from acausal.signals import (
    Signal,
)
from acausal.simulate import (
    simulate,
)
from acausal.simulation.solution import (
    Solution,
)
from acausal.symbols import (
    Eq,
    Flow,
    InitialParameter,
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
from acausal.system import (
    System,
    compile,
)
from acausal.training.lbfgs import lbfgs
from acausal.training.regularizers import (
    SmallCorrection,
    ZeroCrossing,
)

__version__ = "0.1.0"

__all__ = [
    "MLP",
    "Abs",
    "AcausalError",
    "Component",
    "ConnectionError",
    "Connector",
    "Data",
    "DataError",
    "DeclarationError",
    "Eq",
    "Fit",
    "Flow",
    "InitialParameter",
    "Initialization",
    "InitializationError",
    "Input",
    "Linearization",
    "ModelError",
    "Module",
    "NetlistError",
    "OffsetCorrected",
    "Option",
    "Output",
    "Parameter",
    "Potential",
    "Signal",
    "SimulationError",
    "SmallCorrection",
    "Solution",
    "Start",
    "StructureError",
    "System",
    "TrainingError",
    "UnitError",
    "Variable",
    "ZeroCrossing",
    "acos",
    "asin",
    "atan",
    "atan2",
    "compile",
    "cos",
    "cosh",
    "der",
    "diagram",
    "exp",
    "fit",
    "floor",
    "lbfgs",
    "linearize",
    "load",
    "log",
    "maximum",
    "minimum",
    "networks",
    "pi",
    "prescribed",
    "remove_offset",
    "save",
    "sign",
    "simulate",
    "sin",
    "sinh",
    "sqrt",
    "tan",
    "tanh",
    "time",
    "where",
]
