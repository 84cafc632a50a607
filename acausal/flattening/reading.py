"""Read what a user's methods state; an error in them becomes a sentence with the line."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable, Iterator
from inspect import isgenerator
from pathlib import Path
from typing import Any

from acausal.errors import DeclarationError
from acausal.modeling import Component, Eq, InitialParameter, charge, der, each


def equations_of(component: Component) -> Iterable[Any]:
    """A component's equations, those that its modifiers add, and ``der(p) = 0`` for its initial parameters."""
    yield from component.equations()
    yield from component._node.bindings
    for name, declared in component._node.declarations():
        if isinstance(declared, InitialParameter):
            yield Eq(der(getattr(component, name)), 0)


def read_statements(
    component: Component, equations: Callable[[], Iterable[Any]], instances: int
) -> list[Any]:
    """The equations of a user's method, charged for so many instances.

    Raises:
        DeclarationError: for an error in it, with the line.
    """
    found: list[Any] = []
    try:
        stated = iter(equations())
        for equation in each(stated):
            charge("equations", instances, component._node)
            known = not isinstance(equation, Eq) or equation.place
            found.append(equation if known else equation.stated_in(_yielded_at(stated)))
        return found
    except (TypeError, ValueError, ArithmeticError, AttributeError) as error:
        if isinstance(error, AttributeError) and not _is_sympys(error):
            raise  # an unknown name in the user's own line
        reason, line = str(error).partition("\n")[0], _line(error)
        raise DeclarationError(
            f"{component._node.label}: its equations cannot be read ({reason}){line}. Yield ac.Eq(left, right) from "
            "the method, and use ac.sin, ac.where, ac.maximum, ... for what depends on variables, not math, numpy, "
            "if or max"
        ) from None
    except DeclarationError as error:
        if component._node.label in str(error):
            raise
        raise DeclarationError(f"{component._node.label}{_line(error)}: {error}") from None


def _yielded_at(stated: Iterator[Any]) -> str:
    """The line of the user's file that has just yielded; empty where it is one of acausal's, or not known."""
    while isgenerator(stated) and isgenerator(stated.gi_yieldfrom):
        stated = stated.gi_yieldfrom
    frame = stated.gi_frame if isgenerator(stated) else None
    if frame is None or str(frame.f_globals.get("__name__")).startswith("acausal."):
        return ""
    return _place(frame.f_code.co_filename, frame.f_lineno)


def _is_sympys(error: Exception) -> bool:
    """Whether sympy raised an error, which then is about what it was given."""
    return "sympy" in Path(traceback.extract_tb(error.__traceback__)[-1].filename).parts


def _line(error: Exception) -> str:
    """The line of the user's file that raised an error."""
    frames = traceback.extract_tb(error.__traceback__)
    inner = ("site-packages", "<string>", __file__, str(Path("acausal", "modeling")))
    own = [f for f in frames if not any(part in f.filename for part in inner)]
    return f", {_place(own[-1].filename, own[-1].lineno)}" if own else ""


def _place(file: str, line: int | None) -> str:
    return f"line {line} of {Path(file).name}"
