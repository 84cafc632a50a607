"""The parameters that are exported."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal.errors import DataError, shown
from acausal.system import System


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
    return {**{name: own[name] for name in system.layout.names}, **params}
