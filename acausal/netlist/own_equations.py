"""What a model of a file declares and states itself: variables, and equations with events."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, cast

from acausal.errors import listing, shortened
from acausal.modeling import KINDS, Discrete, Variable
from acausal.netlist.file import NetlistError, kind, need_keys, within
from acausal.netlist.model import START_KEYS, Netlist, state as state_of
from acausal.netlist.scope import Scope
from acausal.netlist.statements import parse_statement

NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)


def declare(scope: Scope, name: str, raw: Any, where: str) -> None:
    """Declare a variable: its attributes, and under ``discrete`` its kind if it changes at events only.

    Raises:
        NetlistError: in one sentence, with the place.
    """
    if not isinstance(raw, Mapping):
        raise NetlistError(
            f'{where}: a variable is an object of its attributes, such as {{"start": 0}}, not {kind(raw)}'
        )
    given = cast(Mapping[str, Any], raw)
    need_keys(given, (*START_KEYS, "unit", "discrete"), where, "attribute")
    unit, of_kind = given.get("unit", ""), given.get("discrete")
    if not isinstance(unit, str):
        raise NetlistError(f"{where}.unit: a text is needed, not {kind(unit)}")
    if of_kind is None:
        variable = Variable(unit=unit)
    elif of_kind in KINDS:
        variable = Discrete(kind=of_kind, unit=unit)
    else:
        raise NetlistError(
            f"{where}.discrete: one of {listing(KINDS)} is needed, not {kind(of_kind)}"
        )
    assign(scope.model, name, variable, where)
    start = scope.start({k: v for k, v in given.items() if k in START_KEYS}, where)
    within(where, lambda: scope.model.modify(**{name: start}))
    scope.model._file.variables[name] = raw, state_of(scope.model, name)


def state(scope: Scope, text: Any, where: str) -> None:
    """Add an equation to the model, or what happens at an event.

    Raises:
        NetlistError: in one sentence, with the place.
    """
    if not isinstance(text, str):
        raise NetlistError(
            f"{where}: an equation is a text, 'left = right' or 'when ... then ... end when', not {kind(text)}"
        )
    found = within(where, lambda: parse_statement(text, scope.lookup))
    scope.model._file.equations.append((text, found))


def assign(model: Netlist, name: str, value: Any, where: str) -> None:
    """Give the model a parameter, variable, connector, part or constant."""
    if not NAME.fullmatch(name):
        raise NetlistError(f"{where}: {no_name(name)}")
    within(where, lambda: model._claim(name))
    within(where, lambda: setattr(model, name, value))


def no_name(name: str) -> str:
    """What to say of a name that is none."""
    return f"'{shortened(name)}' is not a name; letters, digits and underscores, beginning with a letter"
