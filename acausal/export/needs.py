"""What an export needs: a model that can be written, its parameters, and packages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal.errors import DataError, ExportError, ModelError, need_compiled, shown
from acausal.system import System


def need_exportable(system: System, function: str) -> None:
    """Refuse what is no compiled model, and a model that calls code of others.

    Raises:
        ModelError: for a model that is not compiled. ExportError: for one with an FMU in it.
    """
    need_compiled(system, f"export.{function}")
    if fixed := system.layout.fixed_modules:
        path = system.layout.model.layout.module(next(iter(fixed))).rpartition(".")[0]
        raise ExportError(
            f"export.{function}: '{path or system.flat.name}' is an FMU, whose equations nobody knows; export the rest "
            "of the model, with inputs and outputs in its place, and connect both in a tool that imports FMUs."
        )


def need_unchanged(system: System, function: str) -> None:
    """Refuse a system whose model was modified after it was compiled, where the model itself is written.

    Raises:
        ModelError: that names what has changed.
    """
    then, now = system.flat.said, system.model._node.said()
    kept = {n for n in then if n in now and (then[n] is now[n] or _equal(then[n], now[n]))}
    if changed := sorted({*then, *now} - kept):
        raise ModelError(
            f"export.{function}: '{changed[0]}' was changed after the model was compiled, so the system is another "
            "model; compile it again: system = ac.compile(model)"
        )


def _equal(a: Any, b: Any) -> bool:
    """Whether two numbers or texts are the same, such as those of a copy."""
    return type(a) is type(b) and isinstance(a, int | float | str) and a == b


def all_parameters(system: System, params: Mapping[str, Any] | None) -> dict[str, Any]:
    """What is given, and the model's own numbers for the rest; without anything given, the model's own.

    Raises:
        DataError: for an unknown name, a value that does not fit, or a missing network.
    """
    own = system.parameters()
    if params is None:
        return own
    if not isinstance(params, Mapping):
        raise DataError(f"params are numbers and networks by name, not {shown(params)}")
    system.pack(params)
    system.layout.need_modules(params)
    return {**{name: own[name] for name in system.layout.names}, **params}
