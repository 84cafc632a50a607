"""What a class consists of, with all that it inherits."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

from acausal.errors import ModelError
from acausal.modelica.meanings import Native, Predefined
from acausal.modelica.syntax import (
    ClassDefinition,
    Declared,
    Expression,
    ModificationArgument,
    Statement,
)
from acausal.modelica.tokens import ModelicaError

Place: TypeAlias = Any
"""A `acausal.modelica.classes.ClassNode`, which knows these views."""


@dataclass(eq=False)
class Entry:
    """A component of a class, with the modifiers that it gets on the way from there.

    Attributes:
        node: the class that declares it, where its expressions are looked up.
        modifiers: of `extends` and short classes, the outermost first, each with the class that states it.
    """

    declared: Declared
    node: Place
    modifiers: list[tuple[ModificationArgument, Place]]

    @property
    def stated(self) -> tuple[Expression | None, Place]:
        """The value that it is given, by the outermost modifier that has one, and the class that states it."""
        for argument, node in self.modifiers:
            if argument.name == self.declared.name and argument.modifier.value is not None:
                return argument.modifier.value, node
        return self.declared.modifier.value, self.node

    @property
    def started(self) -> tuple[Expression | None, Place]:
        """What it is given, or where it is given nothing its start."""
        if self.stated[0] is not None:
            return self.stated
        own = self.declared.modifier.arguments
        return next((a.modifier.value for a in own if a.name == "start"), None), self.node

    @contextmanager
    def place(self) -> Generator[None]:
        """Meanwhile an error about the model is one at its declaration."""
        try:
            yield
        except ModelicaError:
            raise
        except ModelError as error:
            raise self.wrong(str(error)) from None

    def wrong(self, reason: str) -> ModelicaError:
        """The error at its declaration."""
        return self.node.wrong(self.declared.at, reason, len(self.declared.name))


@dataclass(eq=False)
class ClassView:
    """A class together with what it inherits.

    Attributes:
        natives: bases of libraries, with modifiers.
        predefined: what a type is made of; ``attributes`` its modifiers, the outermost first.
        sections: kind (``equations``, ``algorithms``, ...), statements and the class that states them.
        classes: replaceable classes that are redeclared on the way.
        subscripts: of types that are arrays.
    """

    natives: list[tuple[Native, list[tuple[ModificationArgument, Place]]]] = field(
        default_factory=list
    )
    predefined: Predefined | None = None
    attributes: list[tuple[ModificationArgument, Place]] = field(default_factory=list)
    entries: dict[str, Entry] = field(default_factory=dict)
    sections: list[tuple[str, list[Statement], Place]] = field(default_factory=list)
    classes: dict[str, tuple[ModificationArgument | ClassDefinition, Place]] = field(
        default_factory=dict
    )
    subscripts: list[tuple[Any, Place]] = field(default_factory=list)
    causality: str = ""
    connection: str = ""

    def of_causality(self, word: str) -> list[str]:
        """Names of the inputs or outputs, in order."""
        return [n for n, e in self.entries.items() if e.declared.prefixes.causality == word]

    def within(self, scope: Callable[[Place], Place]) -> ClassView:
        """The same, with names looked up elsewhere."""

        def moved(pairs: list[Any]) -> list[Any]:
            return [(one, scope(node)) for one, node in pairs]

        entries = {
            n: Entry(e.declared, scope(e.node), moved(e.modifiers)) for n, e in self.entries.items()
        }
        return replace(
            self,
            natives=[(native, moved(given)) for native, given in self.natives],
            attributes=moved(self.attributes),
            entries=entries,
            sections=[(kind, stated, scope(node)) for kind, stated, node in self.sections],
            classes={n: (c, scope(node)) for n, (c, node) in self.classes.items()},
            subscripts=moved(self.subscripts),
        )
