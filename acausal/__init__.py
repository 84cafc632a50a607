"""Connect physical components in Python; get, simulate and train a physics-enhanced neural ODE in JAX.

A public name's module is imported when the name is first asked for: who builds a model and simulates it waits for no
optimizer and no plots.
"""

import os as _os
from importlib import import_module as _import_module
from typing import TYPE_CHECKING, Any

import jax as _jax
from jaxlib.version import __version__ as _jaxlib

from acausal import compilation_cache as _compilation_cache
from acausal import xla as _xla

_jax.config.update("jax_enable_x64", True)
_xla.compile_small_loops(_os.environ, _jaxlib)
_compilation_cache.begin(_os.environ)

if TYPE_CHECKING:
    from acausal import networks
    from acausal.analyse import Linearization, linearize
    from acausal.compilation_cache import use_compilation_cache
    from acausal.component import Component
    from acausal.connector import Connector
    from acausal.data import Data
    from acausal.distilled import Distilled, distill
    from acausal.draw import diagram
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
    from acausal.formula import Formula
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
    from acausal.netlist import load, save
    from acausal.netlist_file import NetlistError
    from acausal.networks.mlp import MLP
    from acausal.networks.zero import OffsetCorrected
    from acausal.neural import remove_offset
    from acausal.params_file import load_params, save_params
    from acausal.signals import Signal
    from acausal.simulation.simulate import simulate
    from acausal.simulation.solution import Solution
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
    from acausal.system import System, compile
    from acausal.training.ensemble import Ensemble, ensemble
    from acausal.training.fit import fit
    from acausal.training.lbfgs import lbfgs
    from acausal.training.logs import CsvLog, TensorBoardLog
    from acausal.training.modal import DampingRatio, FrequencyRange, Stability
    from acausal.training.modifiers import Bounded, Shift
    from acausal.training.regularizers import SmallCorrection, ZeroCrossing
    from acausal.training.result import Fit

__version__ = "0.1.0"

_HOMES = {
    "analyse": "Linearization linearize",
    "compilation_cache": "use_compilation_cache",
    "component": "Component",
    "connector": "Connector",
    "data": "Data",
    "distilled": "Distilled distill",
    "draw": "diagram",
    "errors": "AcausalError ConnectionError DataError DeclarationError InitializationError ModelError "
    "SimulationError StructureError TrainingError UnitError",
    "formula": "Formula",
    "functions": "Abs acos asin atan atan2 cos cosh exp floor log maximum minimum pi prescribed sign sin sinh "
    "sqrt tan tanh where",
    "initialize": "Initialization",
    "netlist": "load save",
    "netlist_file": "NetlistError",
    "networks.mlp": "MLP",
    "networks.zero": "OffsetCorrected",
    "neural": "remove_offset",
    "params_file": "load_params save_params",
    "signals": "Signal",
    "simulation.simulate": "simulate",
    "simulation.solution": "Solution",
    "symbols": "Eq Flow InitialParameter Input Module Option Output Parameter Potential Start Variable der time",
    "system": "System compile",
    "training.ensemble": "Ensemble ensemble",
    "training.fit": "fit",
    "training.lbfgs": "lbfgs",
    "training.logs": "CsvLog TensorBoardLog",
    "training.modal": "DampingRatio FrequencyRange Stability",
    "training.modifiers": "Bounded Shift",
    "training.regularizers": "SmallCorrection ZeroCrossing",
    "training.result": "Fit",
}
_HOME = {name: module for module, names in _HOMES.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    if name == "networks":
        return _import_module("acausal.networks")
    if name not in _HOME:
        raise AttributeError(f"module 'acausal' has no attribute {name!r}")
    value = getattr(_import_module(f"acausal.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]


__all__ = [
    "MLP",
    "Abs",
    "AcausalError",
    "Bounded",
    "Component",
    "ConnectionError",
    "Connector",
    "CsvLog",
    "DampingRatio",
    "Data",
    "DataError",
    "DeclarationError",
    "Distilled",
    "Ensemble",
    "Eq",
    "Fit",
    "Flow",
    "Formula",
    "FrequencyRange",
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
    "Shift",
    "Signal",
    "SimulationError",
    "SmallCorrection",
    "Solution",
    "Stability",
    "Start",
    "StructureError",
    "System",
    "TensorBoardLog",
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
    "distill",
    "ensemble",
    "exp",
    "fit",
    "floor",
    "lbfgs",
    "linearize",
    "load",
    "load_params",
    "log",
    "maximum",
    "minimum",
    "networks",
    "pi",
    "prescribed",
    "remove_offset",
    "save",
    "save_params",
    "sign",
    "simulate",
    "sin",
    "sinh",
    "sqrt",
    "tan",
    "tanh",
    "time",
    "use_compilation_cache",
    "where",
]
