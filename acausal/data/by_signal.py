"""What is said of the signals of a record by name: their units, and choices such as an interpolation."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, TypeAlias

from acausal.errors import DataError, known_name, listing, nearest, shown
from acausal.modeling import by_name

Choices: TypeAlias = str | Mapping[str, str] | None
"""A choice for all signals, or choices by name; where there is none, the default."""


def check_choices(
    what: str, given: Choices, known: tuple[str, ...], names: Collection[str]
) -> None:
    """Refuse an unknown choice, or one for a signal that is not among ``names``."""
    if given is None:
        return
    if not isinstance(given, str | Mapping):
        raise DataError(
            f"{what}={shown(given)}; choose one of {', '.join(known)}, for all or by name."
        )
    by_name = {"The record": given} if isinstance(given, str) else given
    for name, choice in by_name.items():
        check_choice(name, what, choice, known)
        if not isinstance(given, str):
            said = f"There is a choice of {what} for"
            known_name(name, names, said, then=" but no such signal:")


def check_choice(name: str, what: str, choice: object, known: tuple[str, ...]) -> None:
    """Refuse an unknown choice; ``name`` is whose it is."""
    if not isinstance(choice, str) or choice not in known:
        raise DataError(f"{name} has {what}={shown(choice)}; choose one of {', '.join(known)}.")


def chosen(given: Choices, name: str, default: str) -> Any:
    """The choice for one signal."""
    return (given if isinstance(given, str) else (given or {}).get(name)) or default


def kept(given: Choices, names: Collection[str]) -> Choices:
    """The choices that are for signals among ``names``."""
    if given is None or isinstance(given, str):
        return given
    return {name: choice for name, choice in given.items() if name in names}


def check_units(units: Any) -> dict[str, str]:
    """Units as given, none for None; refuse what has no names, and what is not text."""
    found = by_name(units, "units", "a unit by name: {'mass.s': 'm'}")
    for name, unit in found.items():
        if not isinstance(unit, str):
            raise DataError(f"units: '{name}' has {shown(unit)}; give a text such as 'N/m'.")
    return found


def check_unit_names(units: Mapping[str, str], names: Collection[str]) -> None:
    """Refuse units that some signals lack, or that belong to no signal."""
    without = [n for n in names if n not in units]
    if without:
        have = "has" if len(without) == 1 else "have"
        raise DataError(
            f"{listing(without)} {have} no unit while other signals have one; give units to all."
        )
    extra = [n for n in units if n not in names and n != "time"]
    if extra:
        raise DataError(
            f"There are units for {listing(extra)} but no such signal: {nearest(extra[0], names)}"
        )
