"""Media, materials, constants and functions that a netlist may name, by the last word of their Modelica name."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

from . import constants
from .arrays import ARRAYS
from .fluid import media
from .magnetic import hard_magnetic, soft_magnetic
from .magnetic.hysteresis_data import EVERETT
from .translational.utilities import GenerateStribeckFrictionTable


def _records(module: ModuleType) -> dict[str, Any]:
    """An instance of every class that a module of records declares, by the name of the class."""
    classes = (v for v in vars(module).values() if isinstance(v, type))
    return {cls.__name__: cls() for cls in classes if cls.__module__ == module.__name__}


RECORDS: dict[str, Any] = {
    **{name: value for name, value in vars(constants).items() if name.startswith("alpha20")},
    **_records(media),
    **_records(hard_magnetic),
    **_records(soft_magnetic),
    **{f"HysteresisEverettParameter.{name}": material for name, material in EVERETT.items()},
}
"""Name -> record or number; `BaseData` is that of soft magnetic materials. Two words where one would be two records."""

FUNCTIONS: dict[str, Callable[..., Any]] = {
    **ARRAYS,
    "GenerateStribeckFrictionTable": GenerateStribeckFrictionTable,
}
"""Name -> function of numbers or arrays."""
