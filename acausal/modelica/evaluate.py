"""Expressions: what their syntax trees mean in a component, a package or a function; text is read in `expressions`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import Any, Self

import numpy as np
import sympy as sp

from acausal.errors import nearest, shortened
from acausal.modelica.classes import ClassNode
from acausal.modelica.meanings import Imported, Literal, Native, Predefined, Prefix, Value
from acausal.modelica.operators import Frame, Operators
from acausal.modelica.outer import inwards
from acausal.modelica.syntax import (
    ArrayConstructor,
    Choice,
    Comprehension,
    DottedName,
    EndSubscript,
    Expression,
    FunctionCall,
    LiteralConstant,
    MatrixConstructor,
    OperatorExpression,
    RangeExpression,
    Several,
    Whole,
)
from acausal.modelica.values import (
    Absent,
    BusMember,
    Record,
    Redundant,
    array_of,
    as_array,
    as_record,
    elements,
    is_array,
    mapped,
    of,
    shape_of,
)
from acausal.modeling import check_size, floor, time


class Evaluator(Operators):
    """Evaluates the expressions of one statement, which may be the ends of a connection."""

    connecting = False

    def value(self, expression: Expression) -> Any:
        """The value of an expression: a number, truth value, text, sympy expression, array, part or record.

        Raises:
            ModelicaError: with the place, for what is wrong or not supported.
        """
        before = self.at
        self.at = expression.at
        try:
            return self._value(expression)
        except (ValueError, RecursionError) as error:
            self.at = expression.at
            deep = "this leads to conditions within conditions that are too deep"
            raise self.wrong(deep if isinstance(error, RecursionError) else str(error)) from None
        finally:
            self.at = before

    def _value(self, expression: Expression) -> Any:
        match expression:
            case LiteralConstant():
                return expression.value
            case DottedName():
                return self.name(expression)
            case OperatorExpression():
                return self._operation(expression)
            case FunctionCall():
                return self._call(expression)
            case Choice():
                return self._choice(expression)
            case ArrayConstructor():
                return as_array([self.value(item) for item in expression.items])
            case MatrixConstructor():
                return self._matrix(expression)
            case RangeExpression():
                return self._range(expression)
            case Comprehension():
                return self.comprehension(expression)
            case EndSubscript():
                if not self.ends:
                    raise self.wrong("'end' stands for a size in a subscript only")
                return self.ends[-1]
            case Several():
                raise self.wrong("several results can only be assigned to as many variables")
            case Whole():
                raise self.wrong("':' is a subscript only")

    # -- arrays ----------------------------------------------------------------------------------------

    def _matrix(self, expression: MatrixConstructor) -> Any:
        rows = [[self._two(self.value(v)) for v in row] for row in expression.rows]
        try:
            return np.concatenate([np.concatenate(row, axis=1) for row in rows], axis=0)
        except ValueError:
            shapes = "; ".join(", ".join(str(list(v.shape)) for v in row) for row in rows)
            raise self.wrong(f"these do not fit into one matrix: [{shapes}]") from None

    def _two(self, value: Any) -> Any:
        found = value if isinstance(value, np.ndarray) else array_of([value])
        return found.reshape(-1, 1) if found.ndim == 1 else found

    def _range(self, expression: RangeExpression) -> Any:
        first, last = self.value(expression.first), self.value(expression.last)
        step = 1 if expression.step is None else self.value(expression.step)
        if isinstance(first, Literal) and isinstance(last, Literal):
            return array_of(first.among[first.number - 1 : last.number])
        numbers = [self.known(v, "a range") for v in (first, step, last)]
        begin, by, end = (self.number(v) for v in numbers)
        if by == 0:
            raise self.wrong("the step of a range is zero")
        count = max(0, math.floor((end - begin) / by + 1e-12) + 1)
        check_size(count, "the range")
        return array_of([begin + i * by for i in range(count)])

    def iterated(self, iterators: list[tuple[str, Expression | None]]) -> Iterator[dict[str, Any]]:
        """The values of loop variables, which expressions see meanwhile; later ones run faster."""
        if not iterators:
            yield {}
            return
        (name, expression), *rest = iterators
        if expression is None:
            raise self.wrong(f"give the range of '{name}': for {name} in 1:n")
        found = self.value(expression)
        items = range(1, int(found) + 1) if isinstance(found, int) else found
        if not is_array(items) and not isinstance(items, range):
            raise self.wrong("a loop runs over an array such as 1:n")
        for item in items:
            frame = self.frame
            self.frame = frame.with_local(**{name: item})
            try:
                for values in self.iterated(rest):
                    yield {name: item, **values}
            finally:
                self.frame = frame

    def comprehension(self, expression: Comprehension) -> Any:
        """The array of values; of several iterators the last runs over the rows."""
        iterators = expression.iterators
        if len(iterators) > 1:
            *outer, last = iterators
            expression = Comprehension(
                Comprehension(expression.value, outer, expression.at), [last], expression.at
            )
            return self.comprehension(expression)
        return as_array([self.value(expression.value) for _ in self.iterated(iterators)])

    def subscripted(self, value: Any, subscripts: list[Expression]) -> Any:
        """Some elements of an array, or of a list of parts."""
        value = value.value if isinstance(value, Redundant) else value
        if isinstance(value, Absent):
            return value
        if isinstance(value, BusMember):
            index = [self.whole(self.value(s), "a subscript here") for s in subscripts]
            return value.element(index)
        if not is_array(value):
            raise self.wrong("this is not an array; it takes no subscripts")
        shape = shape_of(value)
        return self._selected(value, shape, self.places(shape, subscripts, changing=True))

    def _selected(self, value: Any, shape: tuple[int, ...], places: list[Any]) -> Any:
        """The elements in some places, among which a subscript that changes with time chooses while the model runs."""
        k = next((k for k, place in enumerate(places) if isinstance(place, sp.Basic)), None)
        if k is None:
            return _pick(value, places)
        found: Any = None
        for number in range(shape[k], 0, -1):
            one = self._selected(value, shape, [*places[:k], number - 1, *places[k + 1 :]])
            below = self.relation("<", places[k], number + 0.5)
            found = one if found is None else self.chosen(below, one, found)
        return found

    def places(
        self, shape: tuple[int, ...], subscripts: list[Expression], *, changing: bool = False
    ) -> list[Any]:
        """Positions from 0 for each dimension: a number, or a list of them.

        Where subscripts may change with time (``changing``), such a one is given as it is, from 1.
        """
        if len(subscripts) > len(shape):
            raise self.wrong(
                f"an array of {len(shape)} dimension(s) has {len(subscripts)} subscripts"
            )
        found: list[Any] = []
        for size, subscript in zip(shape, subscripts, strict=False):
            if isinstance(subscript, Whole):
                found.append(list(range(size)))
                continue
            self.ends.append(size)
            index = self.value(subscript)
            self.ends.pop()
            if changing and isinstance(index, sp.Basic) and self.varies(index):
                found.append(index)
                continue
            many = isinstance(index, np.ndarray)
            numbers = [
                self.whole(i, "a subscript") if not isinstance(i, bool) else 1 + i
                for i in elements(index)
            ]
            for number in numbers:
                if not 1 <= number <= size:
                    self.at = subscript.at
                    raise self.wrong(f"subscript {number} is outside of 1 to {size}")
            found.append([n - 1 for n in numbers] if many else numbers[0] - 1)
        return found

    # -- names -----------------------------------------------------------------------------------------

    def name(self, name: DottedName) -> Any:
        """The value of a name."""
        value, i = self._first(name)
        if i - 1 in name.subscripts:
            value = self.subscripted(value, name.subscripts[i - 1])
        while i < len(name.words):
            inner = of(value, name.words[i])
            if inner is None or (isinstance(inner, BusMember) and not self.connecting):
                raise self.unknown(name, i, value)
            subscripts = name.subscripts.get(i)
            if subscripts is not None:
                inner = self._elements_of(inner, len(shape_of(value)), subscripts)
            value = inner
            i += 1
        build, word = self.frame.build, name.words[0]
        known = None if build is None or self.connecting else build.entries.get(word)
        outer = known is not None and known.declared.prefixes.outer
        value = value if self.connecting else as_record(value)
        return mapped(partial(inwards, build), value) if build and outer else value

    def _elements_of(self, value: Any, above: int, subscripts: list[Expression]) -> Any:
        """Elements of a member; of the members of an array of parts, of ``above`` dimensions, of each."""
        if not above:
            return self.subscripted(value, subscripts)
        return as_array([self._elements_of(v, above - 1, subscripts) for v in value])

    def _first(self, name: DottedName) -> tuple[Any, int]:
        """The value of the first words, and how many they are."""
        word, frame = name.words[0], self.frame
        if word in frame.local:
            value = frame.local[word]
            if value is None:
                raise self.wrong(
                    f"'{word}' is used before it is assigned; assign it first", len(word)
                )
            return value, 1
        if frame.build is not None and word in frame.build.names:
            value = frame.build.member(word)
            if value is None:
                raise self.wrong(f"'{word}' has no value; give one", len(word))
            return value, 1
        if word == "time" and len(name.words) == 1:
            if frame.calls and frame.build is None:
                raise self.wrong("a function knows no time; give it as an argument", len(word))
            return time, 1
        found, rest = frame.find(name.words)
        i = len(name.words) - len(rest)
        match found:
            case Value():
                return found.value, i
            case Imported():
                return self.constant(found.node, found.name), i
            case ClassNode() if not rest and found.literals:
                return array_of(literals(found)), i
            case Predefined("Boolean"):
                return array_of([False, True]), i
            case ClassNode() if rest:
                if found.has_value(rest[0]):
                    return self.constant(found, rest[0]), i + 1
            case None:
                node: Any = frame.node
                while isinstance(node, ClassNode):
                    if word in node.view().entries and (
                        frame.build is None or node is not frame.node
                    ):
                        return self.constant(node, word), 1
                    node = None if node.definition.encapsulated else node.parent
            case _:
                pass
        for library in (
            frame.node.tree.libraries if found is None or isinstance(found, Prefix) else ()
        ):
            value = library.constant(name.text)
            if value is not None:
                return value, len(name.words)
        raise self.unknown(name, 0 if found is None else i, found)

    def unknown(self, name: DottedName, i: int, value: Any) -> Exception:
        """The error for a name of which a word means nothing."""
        self.at = name.at
        if isinstance(value, ClassNode | Native | Predefined) and i >= len(name.words):
            return self.wrong(f"'{name.text}' is a class, not a value", len(name.text))
        if i == 0:
            known = [*self.frame.local, *(self.frame.build.names if self.frame.build else ())]
            return self.wrong(
                f"there is no '{shortened(name.words[0])}'; {nearest(name.words[0], known)}",
                len(name.text),
            )
        node = getattr(value, "_node", None)
        known = [*(n for n, _ in node.declarations()), *node.children] if node is not None else []
        if isinstance(value, ClassNode | Prefix | Native):
            what = f"'{'.'.join(name.words[:i])}' has no '{name.words[i] if i < len(name.words) else ''}'"
            return self.wrong(
                f"{what}; give the folder that has it by path=[...] or in MODELICAPATH",
                len(name.text),
            )
        return self.wrong(
            f"'{'.'.join(name.words[:i])}' has no '{shortened(name.words[i])}'; {nearest(name.words[i], known)}",
            len(name.text),
        )

    def constant(self, node: ClassNode, name: str) -> Any:
        """A constant of a package, or a value of an enumeration."""
        if name in node.literals:
            return literal(node, name)
        known: dict[str, Any] = node.__dict__.setdefault("constants", {})
        if name not in known:
            entry = node.view().entries[name]
            if entry.declared.prefixes.variability not in ("constant", "parameter"):
                raise self.wrong(f"'{name}' is not a constant of {node.full}", len(name))
            known[name] = None
            expression, owner = entry.stated
            frame = Frame(owner)
            if expression is None:
                found, _ = frame.find(entry.declared.type.words)
                if not isinstance(found, ClassNode) or found.definition.kind != "record":
                    raise self.wrong(f"'{name}' of {node.full} has no value", len(name))
                given = {
                    a.name: self.elsewhere(frame).value(a.modifier.value)
                    for a in entry.declared.modifier.arguments
                    if a.modifier.value
                }
                known[name] = self.record_of(found, [], given)
            else:
                known[name] = self.elsewhere(frame).value(expression)
        if known[name] is None:
            raise self.wrong(f"'{name}' of {node.full} depends on itself", len(name))
        return known[name]

    # -- calls -----------------------------------------------------------------------------------------

    def arguments(self, call: FunctionCall, least: int, most: int | None = None) -> list[Any]:
        """The values of arguments, of which there have to be so many."""
        given = [*call.arguments, *call.named.values()]
        if not least <= len(given) <= (most or least):
            name = call.function.text
            raise self.wrong(
                f"{name}(...) takes {least} argument{'s' * (least != 1)}, not {len(given)}",
                len(name),
            )
        found = [self.value(a) for a in given]
        self.at = call.at
        return found

    def floored(self, value: Any) -> Any:
        """The greatest integer not above a number."""
        value = self.number(value)
        if not isinstance(value, sp.Expr):
            return int(np.floor(value))
        return self.finite(floor(value, events=self.frame.events and self.varies(value)))

    def _call(self, call: FunctionCall) -> Any:
        raise NotImplementedError

    def elsewhere(self, frame: Frame) -> Self:
        """An evaluator for another frame, with the operations that are left."""
        found = type(self)(frame)
        found.operations, found.build = self.operations, self.build
        return found

    def record_of(self, node: ClassNode, given: list[Any], named: dict[str, Any]) -> Record:
        """The value of a record, made of values for its fields."""
        raise NotImplementedError


def literal(node: ClassNode, word: str) -> Literal:
    """The value of an enumeration."""
    return literals(node)[list(node.literals).index(word)]


def literals(node: ClassNode) -> list[Literal]:
    """All values of an enumeration."""
    found = [Literal(text) for text in node.literals.values()]
    for number, one in enumerate(found, start=1):
        one.number, one.among = number, found
    return found


def _pick(value: Any, places: list[Any]) -> Any:
    if isinstance(value, np.ndarray):
        axes = [[p] if isinstance(p, int) else p for p in places]
        rest = [list(range(n)) for n in value.shape[len(places) :]]
        found = (
            value[np.ix_(*axes, *rest)]
            if all(len(a) for a in axes)
            else np.empty([len(a) for a in (*axes, *rest)], dtype=object)
        )
        kept = [len(p) for p in places if not isinstance(p, int)] + [len(r) for r in rest]
        return found.reshape(kept) if kept else found.reshape(-1)[0]
    if not places:
        return value
    first, *rest = places
    if isinstance(first, int):
        return _pick(value[first], rest)
    return [_pick(value[i], rest) for i in first]
