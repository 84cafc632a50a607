"""Component library: one package per domain, with the names of the Modelica Standard Library 4.1.0.

| package | Modelica |
|---|---|
| `translational` | `Modelica.Mechanics.Translational` |
| `rotational` | `Modelica.Mechanics.Rotational` |
| `blocks` | `Modelica.Blocks` |
| `electrical` | `Modelica.Electrical.Analog` |
| `digital` | `Modelica.Electrical.Digital` |
| `magnetic` | `Modelica.Magnetic.FluxTubes` |
| `thermal` | `Modelica.Thermal.HeatTransfer` |
| `fluid` | `Modelica.Thermal.FluidHeatFlow` |
| `hydraulic` | after `Modelica.Fluid`, without heat |
| `planar` | `PlanarMechanics`, a library of its own |
| `neural` | none: two-ports of any domain whose law is a network |

The library is written as users write their own: it uses the rest of the package only through
``import acausal as ac``.
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any

import acausal as ac

from .modelica import ALSO_CALLED, ENUMERATIONS, MODELICA, NOT_COVERED, RENAMED

__all__ = [
    "ALSO_CALLED",
    "ENUMERATIONS",
    "FUNCTIONS",
    "MODELICA",
    "NOT_COVERED",
    "RECORDS",
    "RENAMED",
]

PACKAGES = (*dict.fromkeys(MODELICA.values()), "hydraulic", "neural")

RECORDS: dict[str, Any]
"""Media, materials and material constants, by the last word of their Modelica name."""

FUNCTIONS: dict[str, Callable[..., Any]]
"""Functions that expressions in files may call, by the last word of their Modelica name."""


def __dir__() -> list[str]:
    """A prompt completes the packages, also before they are imported, and nothing that is in between."""
    return sorted(PACKAGES)


def __getattr__(name: str) -> Any:
    """The packages are imported when they are asked for."""
    if name in PACKAGES:
        return import_module(f"{__name__}.{name}")
    if name == "FMU":  # for files, which name it as a class of the library
        return ac.FMU
    if name in ("FUNCTIONS", "RECORDS"):
        return getattr(import_module(f"{__name__}.records"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
