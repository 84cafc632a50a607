"""The component made from a netlist, with a record of its file; and the lookup of names in it."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, cast

import sympy as sp

from acausal.errors import like, nearest
from acausal.modeling import Component, Connector, Eq, ModuleReference, When, is_vector

START_KEYS = {"start": "value", "fixed": "fixed", "nominal": "nominal", "stateSelect": "state"}
"""Attributes of a variable in a file -> field of `Start`."""

INDEX = r"\[(\d{1,6}(?:,\s*\d{1,6})*)\]"
NAME_OR_INDEX = re.compile(rf"([A-Za-z]\w*)|{INDEX}", re.ASCII)
PATH = re.compile(rf"[A-Za-z]\w*({INDEX})?(\.[A-Za-z]\w*({INDEX})?)*", re.ASCII)


@dataclass
class FileRecord:
    """The content of a file besides a model's parts and connections, so that it can be written again.

    Attributes:
        experiment: keys of the file that are not part of the model.
        initial: initial equations, as text and as equation.
        equations: equations and what happens at events, as text and as statement.
        variables: by name, a variable as the file declares it, and its state then.
        bindings: equations for variables that the file gives a value.
        texts: (part, modifier) -> the modifier in the file, and the state of the part that it led to; part "" holds
            the model's parameters.
        wires: pairs that are connected, and how many connections each pair made.
        arguments: by part, the arguments that it was made with.
        class_names: by part or connector, the name of its class in the file.
        placed: connectors that the file lists among the components.
    """

    experiment: dict[str, Any] = field(default_factory=dict[str, Any])
    initial: list[tuple[str, Eq]] = field(default_factory=list[tuple[str, Eq]])
    equations: list[tuple[str, Eq | When]] = field(default_factory=list)
    variables: dict[str, tuple[Any, Any]] = field(default_factory=dict[str, tuple[Any, Any]])
    bindings: list[Eq] = field(default_factory=list[Eq])
    texts: dict[tuple[str, str], tuple[Any, Any]] = field(
        default_factory=dict[tuple[str, str], tuple[Any, Any]]
    )
    wires: list[tuple[list[str], int]] = field(default_factory=list[tuple[list[str], int]])
    arguments: dict[str, dict[str, Any]] = field(default_factory=dict[str, dict[str, Any]])
    class_names: dict[str, str] = field(default_factory=dict[str, str])
    placed: list[str] = field(default_factory=list[str])


class Netlist(Component):
    """A model read from a file: a component whose equations are those of the file."""

    _file: FileRecord

    def __init__(self) -> None:
        super().__init__()
        self.__dict__["_file"] = FileRecord()

    @property
    def document(self) -> dict[str, Any]:
        """The keys of the file that are not part of the model: times of an experiment, notes."""
        return self._file.experiment

    def equations(self) -> Iterator[Any]:
        """The equations of the file, and those for variables that it gives a value."""
        yield from (statement for _, statement in self._file.equations)
        yield from self._file.bindings

    def initial_equations(self) -> Iterator[Eq]:
        """The initial equations of the file."""
        yield from (equation for _, equation in self._file.initial)

    def remember(self, part: str, key: str, raw: Any) -> None:
        """Keep a modifier of a part ("" for the model itself) as the file has it, and the state that it led to."""
        owner = attribute(self, part) if part else self
        self._file.texts[part, key] = raw, state(owner, key)

    def distinguish(self) -> None:
        """Make the equations of the file a constant, so that models with the same parts get forms of their own."""
        texts = tuple(text for text, _ in (*self._file.equations, *self._file.initial))
        self._node.constants["equations of the file"] = (*map(str, self._file.bindings), *texts)

    def remember_state(self) -> None:
        """Record the present state as that of the file, after an enclosing file has modified this model."""
        for (part, key), (raw, _) in list(self._file.texts.items()):
            self.remember(part, key, raw)
        for child in self._node.children.values():
            if isinstance(child, Netlist):
                child.remember_state()


def attribute(model: Component, path: str) -> Any:
    """The object of a dotted name with indices (counted from 1) in a model, or None.

    Raises:
        DeclarationError: for a connector or variable that exists only with an option.
    """
    if not PATH.fullmatch(path):
        return None
    value: Any = model
    for found in NAME_OR_INDEX.finditer(path):
        if found[2] is not None:
            for index in found[2].split(","):
                if not is_vector(value) or not 1 <= int(index) <= len(value):
                    return None
                value = value[int(index) - 1]
        else:
            value = member(value, found[1])
    return value


def member(value: Any, name: str) -> Any:
    """A member by its name; of a list of parts the list of their members, as in ``sine.y``."""
    match value:
        case Component():
            return _attribute(value, name)
        case Connector():
            return getattr(value, name) if name in value.declarations else None
        case list():
            members = [member(v, name) for v in cast(list[Any], value)]
            return members if members and all(m is not None for m in members) else None
        case _:
            return None


def state(part: Any, key: str) -> tuple[Any, ...]:
    """The state of a part that modifiers of that name set; the same objects as long as it is not changed."""
    if not isinstance(part, Component):
        return ()
    node = part._node
    if key in node.children:
        child = node.children[key]
        below = child._node
        names = (*below.class_declarations, *below.own_declarations, *below.children)
        return tuple(v for name in names for v in state(child, name))
    own = [node.modifiers.get(key), node.options.get(key), node.constants.get(key)]
    inner = [v for name, v in node.modifiers.items() if name.startswith(f"{key}.")]
    return (*own, *inner)


def _attribute(component: Component, name: str) -> Any:
    """A part, connector, declaration or plain value of a component, but nothing callable."""
    if (
        name not in component._node.children
        and name not in component._node.class_declarations
        and name not in component.__dict__
    ):
        return None
    value = getattr(component, name)
    known = isinstance(value, Component | Connector | sp.Expr | ModuleReference)
    return value if known or not callable(value) else None


def is_left_out(model: Component, path: str) -> bool:
    """Whether a name means a connector that an option has left out."""
    owner_path, _, name = path.rpartition(".")
    owner = attribute(model, owner_path) if owner_path else model
    if isinstance(owner, list) and owner:
        owner = cast(list[Any], owner)[0]
    if not isinstance(owner, Component):
        return False
    name = name.partition("[")[0]
    declared = owner._node.class_declarations.get(name)
    return declared is not None and not owner._node.has(declared)


def hint(model: Component, text: str) -> str:
    """A clause that names the nearest thing that can be connected."""
    head, _, tail = text.rpartition(".")
    owner = attribute(model, head) if head else model
    if isinstance(owner, Component):
        known = [*(n for n, _ in owner._node.declarations()), *owner._node.children]
        close = like(tail, known)
        return f"did you mean '{head}.{close}'?" if head and close else nearest(tail, known)
    return nearest(text.partition(".")[0], model._node.children)


def arguments_of(cls: Any) -> dict[str, Any]:
    """The arguments of a class that are not declarations, with their defaults."""
    found: dict[str, Any] = {}
    for function in (cls.__new__, cls.__init__):
        for name, parameter in inspect.signature(function).parameters.items():
            named = parameter.kind in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY)
            if named and name not in ("self", "cls") and name not in cls._declared:
                found[name] = parameter.default
    return found
