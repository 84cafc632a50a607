"""Names of the Modelica Standard Library for parts of the library."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from acausal.export.modelica_text.declared import Flat
from acausal.export.modelica_text.spelling import array, number
from acausal.modeling import Component, Option, Variable
from acausal.netlist import BARE_CONSTANTS, Writer, installed

TYPES: dict[str, tuple[str, ...]] = {
    kind: tuple(values.split())
    for kind, values in {
        "StateSelect": "never avoid default prefer always",
        "AssertionLevel": "error warning",
        "Modelica.Blocks.Types.Init": "NoInit SteadyState InitialState InitialOutput",
        "Modelica.Blocks.Types.SimpleController": "P PI PD PID",
        "Modelica.Blocks.Types.Smoothness": "LinearSegments ContinuousDerivative ConstantSegments "
        "MonotoneContinuousDerivative1 MonotoneContinuousDerivative2 ModifiedContinuousDerivative",
        "Modelica.Blocks.Types.Extrapolation": "HoldLastPoint LastTwoPoints Periodic NoExtrapolation",
        "Modelica.Blocks.Types.AnalogFilter": "CriticalDamping Bessel Butterworth ChebyshevI",
        "Modelica.Blocks.Types.FilterType": "LowPass HighPass BandPass BandStop",
        "Modelica.Blocks.Types.Regularization": "Exp Sine Linear CoSine",
        "Modelica.Blocks.Types.TimeEvents": "Always AtDiscontinuities NoTimeEvents",
        "Modelica.Blocks.Types.LimiterHomotopy": "NoHomotopy Linear UpperLimit LowerLimit",
        "Modelica.Blocks.Types.VariableLimiterHomotopy": "NoHomotopy Linear Fixed",
        "Modelica.Electrical.Digital.Interfaces.Logic": "'U' 'X' '0' '1' 'Z' 'W' 'L' 'H' '-'",
    }.items()
}
"""Modelica's enumerations, with their values."""


def enumeration(declared: Option, value: str) -> str | None:
    """Modelica's type of an option with this value: the one with most of its choices."""
    kinds = [kind for kind, values in TYPES.items() if value in values]
    choices = {*(declared.choices or ())}
    return max(kinds, key=lambda kind: len(choices & {*TYPES[kind]}), default=None)


def standard_part(model: Component, name: str) -> tuple[str, Flat] | None:
    """Modelica's name and the modifiers of a part that the standard library has, else None."""
    part = model._node.children[name]
    if not any((n := b.name_of(type(part))) and n.startswith("Modelica.") for b in installed()):
        return None
    entry = Writer(installed()).part(model, name)
    flat = _flat(entry.get("with", {}), part)
    texts = {path: _without_names_of_records(text, model) for path, text in flat.items()}
    return entry["class"], {path: _with_constants(text, model) for path, text in texts.items()}


def standard_connector(kind: type, name: str) -> str | None:
    """Modelica's name of a connector or signal; of several, that which fits the name of the connector."""
    known = [n for b in installed() for n in b.modelica_names if b.find(n) is kind]
    names = [n for n in known if n.startswith("Modelica.")]
    ending = {"p": "PositivePin", "n": "NegativePin"}.get(name, name[-2:])
    fitting = [n for n in names if n.endswith(ending)] if name else []
    return next(iter([*fitting, *names]), None)


def _without_names_of_records(text: str, model: Component) -> str:
    """A record itself in the place of its name, as the text declares none."""
    value = model._node.constants.get(text)
    return next((n for b in installed() if (n := b.constant_name(value))), text)


def _with_constants(text: str, model: Component) -> str:
    """An expression with the full names of constants, which files may write without their package."""

    def full(found: re.Match[str]) -> str:
        own = found[0] not in BARE_CONSTANTS or hasattr(model, found[0])
        return found[0] if own else f"Modelica.Constants.{found[0]}"

    return re.sub(r"(?<![\w.\"])[A-Za-z]\w*(?![\w.\"(])", full, text)


def _flat(given: Mapping[str, Any], part: Component | None) -> Flat:
    found: Flat = {}
    for key, value in given.items():
        declared = part._node.declaration(key) if part is not None else None
        if key in ("unit", "displayUnit", "quantity"):
            continue
        if isinstance(declared, Variable) and not isinstance(value, Mapping):
            continue  # an equation of the model
        if isinstance(value, Mapping) and "=" in value:
            found[key,] = _text(value["="], declared)
        elif isinstance(value, Mapping):
            inner = part._node.children.get(key) if part is not None else None
            found |= {(key, *path): text for path, text in _flat(value, inner).items()}
        else:
            found[key,] = _text(value, declared)
    return found


def _text(value: Any, declared: Any) -> str:
    match value:
        case bool():
            return "true" if value else "false"
        case int() | float():
            return number(value)
        case list():
            return array(value, lambda v: _text(v, declared))
        case str() if isinstance(declared, Option) and (kind := enumeration(declared, value)):
            return f"{kind}.{value}"
        case _:
            return str(value)
