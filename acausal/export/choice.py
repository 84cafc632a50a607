"""What the user wants exported."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from acausal._jax import need_known
from acausal.errors import DataError, need_compiled, shown
from acausal.export.called_with import called_with
from acausal.export.given import all_parameters, need_exportable
from acausal.export.subject import Subject, network_of, of_network, of_system
from acausal.modeling import Component, names_in
from acausal.networks import law_of
from acausal.system import System


def chosen(
    model: System | Callable[..., Any],
    params: Mapping[str, Any] | None,
    network: str | None,
    inputs: Sequence[str] | None,
    outputs: Sequence[str],
    units: Mapping[str, str] | None,
    parameters: bool,
    function: str,
) -> Subject:
    """A right-hand side, a network of a system, or a network; arguments as of ``export.onnx``.

    Arguments:
        function: that was called, for messages.

    Raises:
        DataError: for an unknown name, or arguments that do not fit.
        ModelError: for a model that is not compiled.
    """
    need_known(f"export.{function}", model, params)
    units = {} if units is None else units
    if not isinstance(units, Mapping):
        raise DataError(
            f"export: units are texts by name, such as {{'s_rel': 'm'}}, not {shown(units)}"
        )
    if isinstance(model, System):
        given = all_parameters(model, params)
        if network is None:
            need_exportable(model, function)
            if inputs is not None:
                raise DataError(
                    "export: inputs=... names the arguments of a network; give network=..., too"
                )
            return of_system(model, given, outputs, parameters)
        law = network_of(model, given, network)
        found = called_with(model.model, network)
        names, output, known = found or (_arguments(law), "y", {})
        return _network(
            law, names if inputs is None else inputs, outputs, output, {**known, **units}
        )
    if isinstance(model, Component | type) or not callable(model):
        need_compiled(model, f"export.{function}")
        raise DataError(f"export.{function}: {shown(model, 40)} is no system and no network")
    if network is not None or params is not None or parameters:
        raise DataError(
            "export: params, network and parameters are of a system; of a network only inputs and outputs can be named"
        )
    names = _arguments(model) if inputs is None else inputs
    return _network(model, names, outputs, "y", units)


def _network(
    law: Callable[..., Any],
    inputs: Sequence[str],
    outputs: Sequence[str],
    output: str,
    units: Mapping[str, str],
) -> Subject:
    results = names_in(outputs, "export: outputs")
    if len(results) > 1:
        raise DataError(f"export: a network has one result, not {len(results)}; give one name")
    return of_network(law, names_in(inputs, "export: inputs"), *(results or (output,)), units)


def _arguments(network: Callable[..., Any]) -> tuple[str, ...]:
    """``x``, or ``x1``, ``x2`` and so on: as many as the network takes."""
    count = _count(network)
    return ("x",) if count == 1 else tuple(f"x{i}" for i in range(1, count + 1))


def _count(network: Any) -> int:
    """How many arguments a network takes.

    Raises:
        DataError: where it does not say so.
    """
    inner = network
    while inner is not None:
        size = getattr(inner, "in_size", None)
        if isinstance(size, int):
            return size
        inner = getattr(inner, "net", None)
    try:
        own = inspect.signature(law_of(network)).parameters.values()
    except (TypeError, ValueError):
        own = ()
    if own and all(p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) for p in own):
        return len(own)
    raise DataError(
        f"export: {shown(network, 40)} does not say how many arguments it takes; name them: inputs=('s_rel',)"
    )
