"""Modifiers on their way to what they modify, from the outermost class inwards, each with its place."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from typing import Any

from acausal.modelica.classes import ClassNode
from acausal.modelica.functions import Interpreter
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import (
    ClassDefinition,
    Declared,
    Expression,
    LiteralConstant,
    ModificationArgument,
    ModificationSyntax,
)
from acausal.modelica.tokens import ModelicaError
from acausal.modelica.values import is_array, of

Index = tuple[tuple[int, int], ...]
"""Of an element of an array of parts: for each dimension its position from 0, and the size."""


@dataclass(frozen=True, eq=False)
class Given:
    """An argument of a modifier.

    Attributes:
        name: what it modifies here.
        modifier: what it gives to that.
        frame: where its expressions are looked up.
        at: its place in the file of the frame.
        index: of the element of an array that it goes to; without ``each`` its value is an array.
        final: whether nothing further out may change it.
        redeclared: the declaration that replaces one.
        each: whether every element of an array gets the same.
    """

    name: str
    modifier: ModificationSyntax
    frame: Frame
    at: int
    index: Index = ()
    final: bool = False
    redeclared: Any = None
    each: bool = False

    def element(self, index: Index) -> Given:
        """What one element of an array of parts gets of it."""
        return self if self.each else replace(self, index=(*self.index, *index))

    def wrong(self, reason: str) -> ModelicaError:
        """The error at its place."""
        return self.frame.node.wrong(self.at, reason, len(self.name))


@dataclass(frozen=True, eq=False)
class Bound:
    """An expression with the place where it is looked up, and the element of its value that is meant."""

    expression: Expression
    frame: Frame
    index: Index = ()

    def __deepcopy__(self, memo: Any) -> Bound:
        """The same text, or a copy of a value, in a copy of the model."""
        expression = self.expression
        if isinstance(expression, LiteralConstant):
            expression = LiteralConstant(deepcopy(expression.value, memo), expression.at)
        return Bound(expression, deepcopy(self.frame, memo), self.index)

    def value(self) -> Any:
        """Its value."""
        found = self._whole()
        for i, size in self.index:
            if not is_array(found):
                return found
            if len(found) != size:
                raise self.wrong(f"{size} elements are needed here, not {len(found)}")
            found = found[i]
        return found

    def _whole(self) -> Any:
        """The value of the expression; that of an array is found once for all of its elements."""
        build, source = self.frame.build, self.expression
        if not self.index or build is None:
            return Interpreter(self.frame).value(source)
        return build.kept.of(id(source), source, lambda: Interpreter(self.frame).value(source))

    def element(self, index: Index) -> Bound:
        """What is meant for one element of an array."""
        return replace(self, index=(*self.index, *index))

    def wrong(self, reason: str) -> ModelicaError:
        """The error at its place."""
        return self.frame.node.wrong(self.expression.at, reason)


@dataclass(eq=False)
class Modification:
    """All that one component is given.

    Attributes:
        value: the outermost value.
        inner: arguments for its members, the outermost first.
        redeclared: the outermost declaration that replaces its own.
    """

    value: Bound | None = None
    inner: list[Given] = field(default_factory=list[Given])
    redeclared: Given | None = None

    def add(self, modifier: ModificationSyntax, frame: Frame, index: Index = ()) -> None:
        """Add a modifier that stands further in."""
        if modifier.value is not None:
            self.value = self.value or Bound(modifier.value, frame, index)
        self.inner += given_by(modifier.arguments, frame, index)


def given_by(
    arguments: Iterable[ModificationArgument], frame: Frame, index: Index = ()
) -> list[Given]:
    """The arguments of a modifier; those of a dotted name are nested."""
    found: list[Given] = []
    for argument in arguments:
        name, _, rest = argument.name.partition(".")
        modifier = argument.modifier
        if rest:
            inner = ModificationArgument(rest, modifier, argument.at, argument.each, argument.final)
            modifier = ModificationSyntax([inner])
        own = () if argument.each else index
        redeclared = argument.redeclared
        found.append(
            Given(
                name, modifier, frame, argument.at, own, argument.final, redeclared, argument.each
            )
        )
    return found


def given_in(
    modifiers: Iterable[tuple[ModificationArgument, ClassNode]],
    frame: Callable[[ClassNode], Frame],
) -> list[Given]:
    """The same of modifiers with the class in which each stands."""
    return [given for argument, node in modifiers for given in given_by([argument], frame(node))]


def modification(declared: Declared, given: Sequence[Given], frame: Frame) -> Modification:
    """What a component gets: from outside, the outermost first, and by its own declaration in a frame.

    Raises:
        ModelicaError: for a modifier of what is final, or a replacement of what is not replaceable.
    """
    found, name = Modification(), declared.name
    outer: Given | None = None
    for one in (g for g in given if g.name == name):
        modifier, element = one.modifier, one.redeclared
        if element is not None:
            if not isinstance(element, Declared):
                raise one.wrong(f"'{name}' is a component; it is not redeclared by a class")
            if not declared.prefixes.replaceable:
                raise one.wrong(f"'{name}' is not replaceable")
            if found.redeclared is not None:
                continue  # what replaces this has modifiers of its own
            found.redeclared, modifier = one, element.modifier
        if one.final and outer is not None:
            raise outer.wrong(f"'{name}' is final")
        if declared.prefixes.protected and one.frame.build is not frame.build:
            raise one.wrong(f"'{name}' is protected; it cannot be modified from outside")
        outer = outer or one
        found.add(modifier, one.frame, one.index)
    if declared.prefixes.final and outer is not None:
        raise outer.wrong(f"'{name}' is final")
    constrained = found.redeclared is not None and declared.constraint is not None
    found.add(declared.constraint.modifier if constrained else declared.modifier, frame)  # pyright: ignore[reportOptionalMemberAccess]
    return found


def fields_of(node: ClassNode, value: Bound) -> list[Given]:
    """The fields of a record as modifiers."""
    record = value.value()
    found: list[Given] = []
    for name, entry in node.view().entries.items():
        if entry.declared.prefixes.final:
            continue
        given = of(record, name)
        if given is None:
            raise value.wrong(f"this is not a record with '{name}'")
        found.append(
            Given(
                name,
                ModificationSyntax([], LiteralConstant(given, value.expression.at)),
                value.frame,
                value.expression.at,
            )
        )
    return found


def redeclared_class(definition: ClassDefinition, frame: Frame) -> Any:
    """The class that a redeclaration states; the same for the same text."""
    key = f"redeclared at {definition.at} as {definition.name}"
    known = frame.node.children
    if key not in known:
        short = definition.short
        if short is not None and not short.modifier.arguments and not short.subscripts:
            found, rest = frame.find(short.base.words)
            if found is None or rest:
                raise frame.node.unknown(short.base)
            known[key] = found
        else:
            known[key] = ClassNode(definition, frame.node, frame.node.tree)
    return known[key]
