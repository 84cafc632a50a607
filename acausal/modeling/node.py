"""The record of one component: its place in the tree, its declarations, modifiers and connections.

`Component` keeps all of its bookkeeping in one attribute, ``_node``, which the other rooms read.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar, cast

import numpy as np

from acausal.errors import DeclarationError, nearest, shown
from acausal.modeling.budget import Budget, check_size
from acausal.modeling.connector import Connector
from acausal.modeling.declarations import Declaration, Module, Option, Parameter
from acausal.modeling.icon import Placement
from acausal.modeling.symbols import Eq, ModuleReference, Owner, Reference, refer

Endpoint = Connector | Reference
"""One end of a connection: a connector, or a causal signal."""

C = TypeVar("C")


@dataclass(eq=False, slots=True)
class Node(Generic[C]):
    """The record of one component.

    Attributes:
        component: the component itself.
        class_declarations: declarations of its class, by name.
        own_declarations: declarations that were assigned to the instance, by name.
        parent: node of the component that it is a part of; None for the model.
        name: its name there, such as ``"mass[2]"``.
        budget: of a model that was read from a file.
        title: name of a model without parent in messages; its class if this is empty.
        children: its parts, by name.
        options: the options that were set.
        modifiers: values of parameters and modules, and starts of variables, that were set.
        constants: plain values that were assigned to attributes.
        early_modifiers: modifiers of parts that do not exist yet.
        connections: pairs of endpoints that it connects.
        placement: where it lies on the schematic of its parent, if that was said.
        inherited: which modifiers its class takes from the models around it (`Component.OUTER`).
        bindings: equations that hold because parameters depend on unknown initial parameters.
    """

    component: C
    class_declarations: Mapping[str, Declaration | Connector]
    own_declarations: dict[str, Declaration | Connector] = field(default_factory=dict)
    parent: Node[C] | None = None
    name: str = ""
    title: str = ""
    budget: Budget | None = None
    children: dict[str, C] = field(default_factory=dict)
    options: dict[str, Any] = field(default_factory=dict)
    modifiers: dict[str, Any] = field(default_factory=dict)
    constants: dict[str, Any] = field(default_factory=dict)
    early_modifiers: dict[str, Mapping[str, Any]] = field(default_factory=dict)
    connections: list[tuple[Endpoint, Endpoint]] = field(default_factory=list)
    inherited: dict[str, Any] = field(default_factory=dict)
    bindings: list[Eq] = field(default_factory=list)
    placement: Placement | None = None

    def said(self, path: str = "") -> dict[str, Any]:
        """What was said of the component and its parts, by dotted name: another object where it was said anew."""
        dot = f"{path}." if path else ""
        every = (self.options, self.modifiers, self.constants, self.early_modifiers, self.children)
        found = {f"{dot}{name}": value for one in every for name, value in one.items()}
        found[path or self.label] = len(self.connections)
        for name, part in self.children.items():
            node: Node[Any] = cast(Any, part)._node
            found |= node.said(f"{dot}{name}")
        return found

    # -- place in the tree -----------------------------------------------------------------------

    def ancestors(self) -> Iterator[Node[C]]:
        """The parent, its parent, and so on up to the model."""
        ancestor = self.parent
        while ancestor is not None:
            yield ancestor
            ancestor = ancestor.parent

    def route_from(self, ancestor: Owner) -> tuple[str, ...] | None:
        """Names of the parts on the way down from an ancestor; None if the component is not below it."""
        names: list[str] = []
        node: Node[C] | None = self
        while node is not None and node is not ancestor:
            names.append(node.name)
            node = node.parent
        return None if node is None else tuple(reversed(names))

    @property
    def path(self) -> str:
        """Dotted name in the model; empty for the model."""
        names = [self.name, *(a.name for a in self.ancestors())]
        return ".".join(reversed(names[:-1]))  # without the model's own name, which is empty

    @property
    def label(self) -> str:
        """The component's name in messages: its class and path."""
        path, kind = self.path, type(self.component).__name__
        return f"{kind} '{path}'" if path else self.title or kind

    # -- declarations ----------------------------------------------------------------------------

    def declaration(self, name: str) -> Declaration | Connector | None:
        """The declaration of that name, whether it exists with the present options or not."""
        return self.own_declarations.get(name) or self.class_declarations.get(name)

    def declarations(self) -> Iterator[tuple[str, Declaration | Connector]]:
        """Every declaration that exists with the present options."""
        for name, declared in {**self.class_declarations, **self.own_declarations}.items():
            if self.has(declared):
                yield name, declared

    def has(self, declared: Declaration | Connector) -> bool:
        """Whether a declaration exists with the present options."""
        when = _condition(declared)
        if when is None:
            return True
        if not isinstance(when, str):
            raise DeclarationError(f"{self.label}: when={when!r:.40} is not the name of an option")
        inverted, option = when.startswith("not "), when.removeprefix("not ")
        known = self.own_declarations.get(option, self.class_declarations.get(option))
        is_option = hasattr(self.component, option) if known is None else isinstance(known, Option)
        if not is_option:
            options = [n for n, d in self.class_declarations.items() if isinstance(d, Option)]
            raise DeclarationError(
                f"{self.label}: when='{when}' names no option; {nearest(option, options)}"
            )
        return bool(getattr(self.component, option)) is not inverted

    def declare(self, name: str, declared: Declaration | Connector) -> Any:
        """Add a declaration to the instance; returns what reading it gives."""
        self.own_declarations[name] = declared
        if isinstance(declared, Connector):
            return declared._bind(self, name)
        declared.name = name
        return self.read(declared)

    def read(self, declared: Declaration | Connector) -> Any:
        """What reading a declaration gives on this component: an option's value, a connector, or references.

        Raises:
            DeclarationError: for a declaration that does not exist with the present options.
        """
        name = declared._name if isinstance(declared, Connector) else declared.name
        if isinstance(declared, Option):
            return self.options.get(name, declared.default)
        if not self.has(declared):
            when = cast(str, _condition(declared))
            needed = f"{when.removeprefix('not ')}={not when.startswith('not ')}"
            raise DeclarationError(f"{self.label}.{name} exists only with {needed}")
        if isinstance(declared, Connector):
            value: Any = declared._bind(self, name)
        elif isinstance(declared, Module):
            value = ModuleReference(Reference(self, name, declared))
        else:
            value = refer(self, name, declared, self.shape(name, declared))
        vars(self.component)[name] = value
        return value

    def shape(self, name: str, declared: Declaration) -> tuple[int, ...] | None:
        """Sizes of a vector or matrix; None for a scalar.

        Raises:
            DeclarationError: where a size follows from a value that was not given, has other dimensions, or is more
                than the budget allows; where the default of a scalar is an array.
        """
        if declared.shape is None:
            self._refuse_array(name, declared)
            return None
        shape = self._sizes(name, declared)
        if shape and min(shape) < 0:
            raise DeclarationError(f"{self.label}.{name} cannot have {min(shape)} elements")
        check_size(math.prod(shape), f"{self.label}.{name}")
        return shape

    def _refuse_array(self, name: str, declared: Declaration) -> None:
        default = declared.default if isinstance(declared, Parameter) else None
        if isinstance(default, list | tuple | np.ndarray):
            shape = np.shape(np.asarray(cast(Any, default), dtype=object))
            raise DeclarationError(
                f"{self.label}.{name}: its default {shown(default)} is an array; declare shape={shape}"
            )

    def _sizes(self, name: str, declared: Declaration) -> tuple[int, ...]:
        declared_sizes = cast(tuple[int | str, ...], declared.shape)
        if any(isinstance(n, str) and n == ":" for n in declared_sizes):
            value = self.modifiers.get(name, cast(Parameter, declared).default)
            if value is None:
                raise DeclarationError(f"{self.label} has no value for '{name}'; give {name}=[...]")
            shape = np.shape(np.asarray(value, dtype=object))
            if len(shape) != len(declared_sizes):
                raise DeclarationError(
                    f"{self.label}.{name} needs {len(declared_sizes)} dimension(s), got {len(shape)}"
                )
            return shape
        return tuple(self._size(name, n) for n in declared_sizes)

    def _size(self, name: str, size: int | str) -> int:
        """One of the sizes; a text names an option or another attribute of the component, but no unknown."""
        declared = self.declaration(size) if isinstance(size, str) else None
        unknown = declared is not None and not isinstance(declared, Option)
        value: Any = size
        if isinstance(size, str) and not unknown:
            if not hasattr(self.component, size):
                raise DeclarationError(
                    f"{self.label}.{name}: its size '{size}' names nothing in the component"
                )
            value = getattr(self.component, size)
        try:
            found = operator.index(value)
            if abs(found) >= 2**63:
                raise TypeError
            return found
        except TypeError:
            given = f"'{size}', which is {type(declared).__name__}" if unknown else shown(value)
            raise DeclarationError(
                f"{self.label}.{name}: its size is a whole number, not {given}"
            ) from None


def _condition(declared: Declaration | Connector) -> str | None:
    """The option with which a declaration exists, perhaps after ``not``; None if it always exists."""
    return declared._when if isinstance(declared, Connector) else declared.when
