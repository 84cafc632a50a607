"""What Python's own help says of components and connectors: signatures, and tables of what their classes declare.

Both are descriptors that read the declarations when somebody asks, so that importing a library costs nothing more.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from acausal.errors import DeclarationError, shortened, shown
from acausal.modeling.declarations import (
    Declaration,
    Discrete,
    Flow,
    Input,
    Module,
    Option,
    Output,
    Parameter,
    Potential,
    Start,
    Variable,
)
from acausal.modeling.written import default_text


class Plug(Protocol):
    """A connector of a component, for all that is said of it here."""

    _when: str | None


Declared = Declaration | Plug

CONNECTORS = "Connectors"

SECTIONS: tuple[tuple[str, type | None], ...] = (
    ("Parameters", Parameter),
    ("Options", Option),
    ("Networks", Module),
    (CONNECTORS, None),
    ("Potentials", Potential),
    ("Flows", Flow),
    ("Inputs", Input),
    ("Outputs", Output),
    ("Discrete variables", Discrete),
    ("Variables", Variable),
)
"""The kinds of declarations in the order in which they are shown; the first that fits counts.

None stands for connectors, which are no declarations themselves."""

NOTHING = ("0", "0.0")
"""Starts that need no mention."""

DEFAULT_WIDTH = 24
"""Longer defaults are cut in tables."""


@dataclass(frozen=True)
class Shown:
    """A default that is no value of its own, as a signature shows it: an expression of other parameters."""

    text: str

    def __repr__(self) -> str:
        return self.text


class SignatureOf:
    """``Class.__signature__``, which `inspect.signature`, `help` and notebooks read."""

    def __get__(self, instance: object, owner: type) -> inspect.Signature:
        return signature(owner)


@dataclass(frozen=True)
class DocumentationOf:
    """``Class.__doc__``: the author's docstring, followed by a table of the declarations."""

    text: str

    def __get__(self, instance: object, owner: type) -> str:
        return "\n\n".join([inspect.cleandoc(self.text), *table(declarations_of(owner))])


def signature(cls: type) -> inspect.Signature:
    """What can be given where a component is made: arguments of its ``__init__``, then what it declares.

    A declaration is listed where ``__init__`` takes any keyword, as that of `Component` does. One without a default
    has to be given.
    """
    _, *arguments = inspect.signature(cls.__init__).parameters.values()
    others = [p for p in arguments if p.kind is p.VAR_KEYWORD]
    if not others:
        return inspect.Signature(arguments)
    explicit = [p for p in arguments if p.kind is not p.VAR_KEYWORD]
    known = {p.name for p in explicit}
    stated = [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=_default(declared))
        for _, members in sections(declarations_of(cls))
        for name, declared in members.items()
        if name not in known
    ]
    has_parts = cls.__init__.__module__ != _KERNEL
    return inspect.Signature([*explicit, *stated, *(others if has_parts else ())])


def check_positional(cls: type, args: Sequence[Any]) -> None:
    """Refuse values without a name, unless the class's ``__init__`` takes them.

    Raises:
        DeclarationError: with the name of the first value that the class can be given.
    """
    parameters = signature(cls).parameters.values() if args else ()
    by_place = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return
    if len(args) > sum(p.kind in by_place for p in parameters):
        name = next((p.name for p in parameters if p.kind is p.KEYWORD_ONLY), "...")
        value = shown(args[-1])
        raise DeclarationError(
            f"{cls.__name__} takes values by name, not {value} alone; write {cls.__name__}({name}={value})"
        )


_KERNEL = "acausal.modeling.component"
"""The module of the ``__init__`` that takes declarations only."""


def sections(declared: Mapping[str, Declared]) -> Iterator[tuple[str, dict[str, Declared]]]:
    """The declarations by kind, those that have to be given first; names with an underscore are left out."""
    kind_of = {name: kind(d) for name, d in declared.items() if not name.startswith("_")}
    for title, _ in SECTIONS:
        members = [(name, declared[name]) for name, found in kind_of.items() if found == title]
        if members:
            yield title, dict(sorted(members, key=lambda item: _is_optional(item[1])))


def kind(declared: Declared) -> str:
    """The section that a declaration belongs to; empty for one of no kind."""
    if not isinstance(declared, Declaration):
        return CONNECTORS
    return next((title for title, one in SECTIONS if one and isinstance(declared, one)), "")


def _is_optional(declared: Declared) -> bool:
    return not isinstance(declared, Parameter | Module) or declared.default is not None


def declarations_of(cls: type) -> Mapping[str, Declared]:
    """What a class of components or connectors declares, by name; bases first."""
    own: Any = cls
    return own._declared if hasattr(own, "_declared") else own.declarations


def _default(declared: Declared) -> Any:
    """The default of an argument that gives a declaration its value."""
    match declared:
        case Parameter() | Module() if declared.default is None:
            return inspect.Parameter.empty
        case Parameter() | Option() | Module():
            return Shown(default_text(declared.default))
        case Declaration():
            return Start()
        case _:
            return {}


def table(declared: Mapping[str, Declared]) -> Iterator[str]:
    """One paragraph for each kind of declaration: names, defaults, units and descriptions in columns."""
    for title, members in sections(declared):
        rows = [(name, *_cells(d), _remark(d)) for name, d in members.items()]
        widths = [max(len(row[i]) for row in rows) for i in range(3)]
        lines = [
            "  ".join(
                [cell.ljust(width) for cell, width in zip(row, widths, strict=False) if width]
                + [row[3]]
            ).rstrip()
            for row in rows
        ]
        yield "\n".join([f"{title}:", *(f"    {line}" for line in lines)])


def _cells(declared: Declared) -> tuple[str, str]:
    """Default and unit."""
    match declared:
        case Parameter() | Option():
            text = default_text(declared.default)
        case Variable():
            text = default_text(declared.start)
        case Declaration():
            text = ""
        case _:
            return type(declared).__name__, ""
    plain = text in NOTHING and not isinstance(declared, Parameter | Option)
    return "" if plain or text == "None" else shortened(text, DEFAULT_WIDTH), declared.unit


def _remark(declared: Declared) -> str:
    """Description, choices, and the option with which it exists."""
    if isinstance(declared, Declaration):
        when, parts = declared.when, [declared.doc] if declared.doc else []
    else:
        when, parts = declared._when, list[str]()
    if isinstance(declared, Option) and declared.choices:
        parts.append(f"one of {', '.join(map(repr, declared.choices))}")
    if isinstance(declared, Option) and declared.min is not None:
        parts.append(f"at least {declared.min}")
    if when and not when.removeprefix("not ").startswith("_"):
        parts.append(f"only with {when}")
    return "; ".join(parts)


def unit_and_doc(declared: Declared) -> tuple[str, str]:
    """Unit and description; of a connector there are none."""
    return (declared.unit, declared.doc) if isinstance(declared, Declaration) else ("", "")
