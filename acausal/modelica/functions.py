"""Functions: of the language, of libraries, a user's own, which are inlined; and the operators of records by them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import reduce
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import listing
from acausal.modelica.algorithms import REFUSED, Algorithms, Left
from acausal.modelica.classes import ClassNode
from acausal.modelica.language import SPECIAL
from acausal.modelica.meanings import Native, Predefined, Value
from acausal.modelica.operators import MAX_CALLS, Frame
from acausal.modelica.rules import check_function
from acausal.modelica.syntax import (
    ClassDefinition,
    DottedName,
    Expression,
    FunctionCall,
    LiteralConstant,
    Whole,
)
from acausal.modelica.tokens import PREDEFINED, ModelicaError, NumbersNeededError
from acausal.modelica.values import (
    FunctionValue,
    Record,
    array_of,
    as_record,
    each,
    elements,
    is_record,
    mapped,
    with_fields,
    without_index,
)
from acausal.modelica.views import Entry
from acausal.modeling import Component, check_size
from acausal.netlist import function as known_function

TEXTS: dict[str, Callable[..., Any]] = {
    "ModelicaStrings_length": len,
    "ModelicaStrings_substring": lambda text, first, last: text[first - 1 : last],
}
"""Functions of texts that are known when the model is built, by their name in C."""
REFUSED_PACKAGES = ("Connections.", "Modelica.Utilities.")


class Interpreter(Algorithms):
    """Evaluates expressions with calls."""

    # -- calls -----------------------------------------------------------------------------------------

    def _call(self, call: FunctionCall) -> Any:
        words = call.function.words
        name = words[1] if words[0] == "" and len(words) == 2 else call.function.text
        local = self.frame.local.get(name)
        if call.partial or isinstance(local, FunctionValue):
            return self._of_argument(self.function(call), call)
        special = SPECIAL.get(name)
        if name == "terminal":
            return self.at_the_end(call)
        if special is not None and name not in self.frame.local:
            return special(self, call)
        if name in REFUSED and name not in self.frame.local:
            raise self.wrong(f"{name}(...) is not supported; {REFUSED[name]}", len(name))
        found, rest = self.frame.find(words)
        if rest:
            found = None
        if found is None and len(words) > 1:
            found = self._of_part(words)
        if isinstance(found, ClassNode) and found.definition.short:
            base = found.base(found.extends[0])
            found = base if isinstance(base, Value) else found
        special = SPECIAL.get(found.full) if isinstance(found, ClassNode) else None
        if special is not None:
            return special(self, call)
        if isinstance(found, ClassNode) and found.definition.kind == "function":
            results = self.inlined(found, call)
            if not results:
                raise self.wrong(f"{found.definition.name} has no result", len(name))
            return results[0]
        given = [self.value(a) for a in call.arguments]
        named = {k: self.value(v) for k, v in call.named.items()}
        self.at = call.at
        if isinstance(found, ClassNode) and found.definition.kind == "record":
            return self.constructed(found, given, named)
        if isinstance(found, Value) and callable(found.value):
            return self._of_library(found.value, name, given, named)
        if isinstance(found, Value) and not given:
            return self._record_of_library(found.value, name, named)
        if found is None:
            plain = known_function(name) if "." not in name else None
            if plain is not None:
                return self._of_library(plain, name, given, named)
            for library in self.frame.node.tree.libraries:
                value = library.constant(f"{name}()")
                if callable(value):
                    return self._of_library(value, name, given, named)
                if value is not None:
                    return self._record_of_library(value, name, named)
        if name.startswith(REFUSED_PACKAGES):
            raise self.wrong(f"{name}(...) is not supported", len(name))
        if isinstance(found, Native | Predefined | ClassNode):
            kind = f"a {found.definition.kind}" if isinstance(found, ClassNode) else "a class"
            raise self.wrong(f"'{name}' is {kind}, not a function", len(name))
        self.at = call.function.at
        raise self.frame.node.unknown(call.function, "function")

    def function(self, expression: Expression) -> FunctionValue:
        """An argument that is a function: its name, or ``function f(a = 1)``."""
        name = expression.function if isinstance(expression, FunctionCall) else expression
        self.at = expression.at
        if isinstance(expression, LiteralConstant) and isinstance(expression.value, FunctionValue):
            return expression.value
        if not isinstance(name, DottedName):
            raise self.wrong("a function is needed here")
        found: Any = self.frame.local.get(name.text)
        if not isinstance(found, FunctionValue):
            node, rest = self.frame.find(name.words)
            if rest or not isinstance(node, ClassNode) or node.definition.kind != "function":
                raise self.wrong("a function of the text is needed here", len(name.text))
            found = FunctionValue(node, {})
        if not isinstance(expression, FunctionCall) or not expression.partial:
            return found
        if expression.arguments:
            raise self.wrong("the arguments of a function that is an argument itself have names")
        named = {k: self.value(v) for k, v in expression.named.items()}
        return FunctionValue(found.node, {**found.named, **named})

    def _of_argument(self, function: FunctionValue, call: FunctionCall) -> Any:
        """The result of a function that is an argument; itself where it is passed on."""
        if call.partial:
            return function
        inputs = function.node.view().of_causality("input")
        names = [n for n in inputs if n not in function.named]
        if len(call.arguments) > len(names):
            raise self.wrong(f"'{call.function.text}' takes {len(names)} arguments here")
        given = dict(zip(names, call.arguments, strict=False)) | call.named
        known = {k: LiteralConstant(v, call.at) for k, v in function.named.items()}
        return self.inlined(
            function.node, FunctionCall(call.function, [], {**known, **given}, call.at)
        )[0]

    def _of_part(self, words: tuple[str, ...]) -> Any:
        """A function of the class of a part, such as ``oil.density``."""
        build = self.frame.build
        if build is None or words[0] not in build.names:
            return None
        before, self.connecting = self.connecting, True
        part = self.name(DottedName(words[:-1], {}, self.at))
        self.connecting = before
        inner = part.__dict__.get("_build") if isinstance(part, Component) else None
        return None if inner is None else inner.node.member(words[-1])

    def _of_library(
        self, function: Callable[..., Any], name: str, given: list[Any], named: dict[str, Any]
    ) -> Any:
        self.count()
        try:
            if any(isinstance(v, np.ndarray) for v in given):
                return each(
                    lambda *v: self.finite(function(*(sp.sympify(self.number(x)) for x in v))),
                    *given,
                )
            numbers = [
                sp.sympify(self.number(v)) if not isinstance(v, str | bool) else v for v in given
            ]
            return self.finite(function(*numbers, **named))
        except TypeError:
            raise self.wrong(f"{name} does not take these arguments") from None

    def _record_of_library(self, value: Any, name: str, named: dict[str, Any]) -> Any:
        try:
            return with_fields(value, named)
        except KeyError as error:
            raise self.wrong(f"{name} has no '{error.args[0]}'") from None

    def record_of(self, node: ClassNode, given: list[Any], named: dict[str, Any]) -> Record:
        """The value of a record, made of values for its fields; the others have their defaults."""
        fields: dict[str, Any] = {}
        entries = node.view().entries
        if len(given) > len(entries):
            raise self.wrong(f"{node.definition.name} has {len(entries)} fields, not {len(given)}")
        stated = dict(zip(entries, given, strict=False)) | named
        for key in stated:
            if key not in entries:
                raise self.wrong(f"{node.definition.name} has no '{key}'")
        for name, entry in entries.items():
            if name in stated:
                fields[name] = stated[name]
                continue
            expression, owner = entry.started
            frame = Frame(owner, None, fields)
            fields[name] = None if expression is None else self.elsewhere(frame).value(expression)
        return Record(fields, node)

    def size(self, expression: Expression) -> int:
        """The size of an array: a number, or the number of values of a type."""
        value = self.value(expression)
        self.at = expression.at
        if isinstance(value, np.ndarray):
            return len(value)
        number = self.whole(value, "a size")
        if number < 0:
            raise self.wrong(f"a size is not negative; this is {number}")
        check_size(number, "the array")
        return number

    # -- functions of the user ---------------------------------------------------------------------------

    def inlined(self, node: ClassNode, call: FunctionCall) -> list[Any]:
        """The results of a function, as expressions of its arguments.

        Raises:
            ModelicaError: for a function that is written in another language, or a loop without a known end.
        """
        definition, view, at = node.definition, node.view(), call.at
        check_function(node)
        if self.frame.build is not None:
            self.frame.build.performs = True
        length = len(call.function.text)
        if self.frame.calls > MAX_CALLS:
            raise self.wrong(f"functions call each other more than {MAX_CALLS} deep", length)
        external = definition.external
        if external is not None:
            given = [self.value(a) for a in call.arguments]
            plain = known_function(external)
            if external in TEXTS and all(isinstance(v, str | int) for v in given):
                return [TEXTS[external](*given)]
            if plain is None:
                raise self.wrong(
                    f"'{call.function.text}' is written in another language; write it in Modelica",
                    length,
                )
            return [self._of_library(plain, external, given, {})]
        inputs = view.of_causality("input")
        if len(call.arguments) > len(inputs):
            raise self.wrong(
                f"{definition.name} takes {len(inputs)} arguments, not {len(call.arguments)}",
                length,
            )
        placed = dict(zip(inputs, call.arguments, strict=False))
        if twice := [n for n in call.named if n in placed]:
            raise self.wrong(f"{definition.name} is given '{twice[0]}' twice", length)
        stated = placed | call.named
        values: dict[str, Any] = {}
        for name, expression in stated.items():
            if name not in inputs:
                raise self.wrong(f"{definition.name} has no argument '{name}'", length)
            kind, _ = view.entries[name].node.lookup(view.entries[name].declared.type.words)
            is_function = isinstance(kind, ClassNode) and kind.definition.kind == "function"
            values[name] = self.function(expression) if is_function else self.value(expression)
        self.at = at
        if arrays := [n for n, v in values.items() if np.ndim(v) > _dimensions(view.entries[n])]:
            return self._for_each_element(node, call, values, arrays)
        before = self.operations, self.statements
        try:
            return self._performed(node, call, values)
        except NumbersNeededError:
            symbols = dict.fromkeys(s for v in values.values() for s in _symbols(v))
            if self.frame.build is None or any(map(self.varies, symbols)):
                raise
            self.at, (self.operations, self.statements) = at, before
            names = dict.fromkeys(without_index(str(s)) for s in symbols)
            reason = "has no expression that is small enough: it is a number, which does not follow"
            self.unwatched(call, f"{definition.name} {reason} {listing(names)}")
            numbers = {n: mapped(lambda v: self.known(v, "this"), v) for n, v in values.items()}
            return self._performed(node, call, numbers)

    def _performed(self, node: ClassNode, call: FunctionCall, values: dict[str, Any]) -> list[Any]:
        """The results of a function of given arguments."""
        definition, view, length = node.definition, node.view(), len(call.function.text)
        inputs, outputs = view.of_causality("input"), view.of_causality("output")
        local: dict[str, Any] = {}
        frame = Frame(node, None, local, self.frame.events, self.frame.calls + 1)
        inner = self.elsewhere(frame)
        inner.statements = self.statements
        for name, entry in view.entries.items():
            if name in values:
                local[name] = as_record(values[name])
                continue
            expression = entry.declared.modifier.value
            there = inner.elsewhere(replace(frame, node=entry.node))
            if expression is not None:
                local[name] = there.value(expression)
            elif name in inputs:
                raise self.wrong(f"{definition.name} needs '{name}'", length)
            else:
                local[name] = there.empty(entry)
        for name in values:
            self._need_argument(view.entries[name], local[name], inner)
        inner.inputs = frozenset(inputs)
        for kind, statements, owner in view.sections:
            if kind == "algorithms":
                inner.frame = replace(frame, node=owner)
                with suppress(Left):
                    inner.execute(statements, local)
        self.operations, self.statements = inner.operations, inner.statements
        for name in outputs:
            if local[name] is None or any(v is None for v in elements(local[name])):
                if definition.partial:
                    reason = f"'{call.function.text}' is partial; redeclare it, or its package"
                    raise self.wrong(reason, length)
                raise self.wrong(f"{definition.name} does not assign '{name}'", length)
        return [local[name] for name in outputs]

    def _need_argument(self, entry: Entry, value: Any, inner: Interpreter) -> None:
        """Refuse an argument of another type or size than its declaration has."""
        name, subscripts = entry.declared.name, entry.declared.subscripts
        kind = entry.declared.type.text
        if kind in PREDEFINED:
            for element in elements(value):
                self.need_type(kind, element)
        shape = np.shape(value)
        if not isinstance(value, np.ndarray) or len(shape) != len(subscripts):
            return
        for expression, size in zip(subscripts, shape, strict=True):
            with suppress(ModelicaError):  # of what is not known yet
                wanted = size if isinstance(expression, Whole) else inner.size(expression)
                if wanted != size:
                    reason = f"'{name}' has {wanted} elements there, not {size}"
                    break
        else:
            return
        raise self.wrong(reason)

    def _for_each_element(
        self, node: ClassNode, call: FunctionCall, values: dict[str, Any], arrays: list[str]
    ) -> list[Any]:
        """The results for arrays in the place of scalars: arrays, too (Modelica 3.6, section 12.4.6)."""

        def one(*elements: Any) -> list[Any]:
            given = {**values, **dict(zip(arrays, elements, strict=True))}
            named: dict[str, Expression] = {
                n: LiteralConstant(v, call.at) for n, v in given.items()
            }
            return self.inlined(node, FunctionCall(call.function, [], named, call.at))

        found = each(one, *(values[n] for n in arrays))
        return [
            array_of(list(r)).reshape((*found.shape, *np.shape(r[0])))
            for r in zip(*found.flat, strict=True)
        ]

    def empty(self, entry: Entry) -> Any:
        """A variable before it is assigned: None, or an array or record of None."""
        found, _ = Frame(entry.node).find(entry.declared.type.words)
        subscripts, stated = entry.declared.subscripts, entry.declared.modifier.arguments
        if isinstance(found, ClassNode) and found.definition.kind == "record" and not subscripts:
            given = {a.name: a.modifier.value for a in stated if a.name in found.view().entries}
            named = {k: self.value(v) for k, v in given.items() if v is not None}
            return self.record_of(found, [], named)
        shape = [self.size(s) for s in subscripts if not isinstance(s, Whole)]
        if not shape or len(shape) < len(subscripts):
            return None
        check_size(int(np.prod(shape)), "the array")
        return np.empty(shape, dtype=object)

    # -- operators of records (Modelica 3.6, chapter 14) -----------------------------------------------

    def overloaded(self, operator: str, *values: Any) -> Any:
        """An operator of which an operand is a record, or an array of records.

        Raises:
            ModelicaError: where the record's class has no such operator.
        """
        sign = operator.removeprefix(".")
        if operator == "*" and all(isinstance(v, np.ndarray) for v in values):
            return self._dot(*values)
        return each(lambda *scalars: self._operator(sign, scalars), *values)

    def constructed(self, node: ClassNode, given: list[Any], named: dict[str, Any]) -> Any:
        """A record of these arguments: by a constructor of its own that takes them, else by its fields."""
        function = self._of_class(node, "constructor", given, named)
        if function is None:
            return self.record_of(node, given, named)
        return self.called(function, given, named)

    def _operator(self, sign: str, values: Sequence[Any]) -> Any:
        node: ClassNode = next(v.node for v in values if isinstance(v, Record))
        for given in (list(values), [self._made(node, v) for v in values]):
            function = self._of_class(node, f"'{sign}'", given, {})
            if function is not None:
                return self.called(function, given, {})
        raise self.wrong(f"'{node.full}' has no operator '{sign}' for {len(values)} operand(s)")

    def _dot(self, left: Any, right: Any) -> Any:
        """The product of arrays; that of two vectors by the function that takes them, if there is one."""
        node: ClassNode = next(v.node for v in (*left.flat, *right.flat) if isinstance(v, Record))
        if left.ndim == right.ndim == 1:
            given = [each(lambda v: self._made(node, v), vector) for vector in (left, right)]
            function = self._of_class(node, "'*'", given, {})
            if function is not None:
                return self.called(function, given, {})
        self.need_factors(left, right)
        rows = left.reshape(-1, left.shape[-1])
        columns = right.reshape(right.shape[0], -1).T
        found = [
            self._sum([self._applied("*", a, b) for a, b in zip(row, column, strict=True)])
            for row in rows
            for column in columns
        ]
        shape = (*left.shape[:-1], *right.shape[1:])
        return array_of(found).reshape(shape) if shape else found[0]

    def _sum(self, values: Sequence[Any]) -> Any:
        return reduce(lambda a, b: self._applied("+", a, b), values)

    def _made(self, node: ClassNode, value: Any) -> Any:
        """A number as a record, where a constructor takes one; others as they are."""
        function = None if is_record(value) else self._of_class(node, "constructor", [value], {})
        return value if function is None else self.called(function, [value], {})

    def _of_class(
        self, node: ClassNode, word: str, given: Sequence[Any], named: dict[str, Any]
    ) -> ClassNode | None:
        """The function of a record's operator that takes these arguments."""
        found = node.member(word)
        if not isinstance(found, ClassNode):
            return None
        inner = [e.name for e in found.definition.elements if isinstance(e, ClassDefinition)]
        members = [found] if found.definition.kind == "function" else map(found.own, inner)
        for function in members:
            entries = function.view().entries
            inputs = {n: entries[n].declared for n in function.view().of_causality("input")}
            needed = [d for d in list(inputs.values())[len(given) :] if d.modifier.value is None]
            fits = len(given) + len(named) <= len(inputs) and named.keys() <= inputs.keys()
            shapes = all(
                len(d.subscripts) == np.ndim(v) and self._takes(function, d.type, v)
                for v, d in zip(given, inputs.values(), strict=False)
            )
            if fits and shapes and all(d.name in named for d in needed):
                return function
        return None

    def _takes(self, function: ClassNode, name: DottedName, value: Any) -> bool:
        """Whether an input of a type takes a value: a record for a record, a number for a number."""
        found, _ = Frame(function).find(name.words)
        return (isinstance(found, ClassNode) and found.definition.kind == "record") is is_record(
            value
        )

    def called(self, function: ClassNode, given: Sequence[Any], named: dict[str, Any]) -> Any:
        """The result of a function of values."""
        arguments: list[Expression] = [LiteralConstant(v, self.at) for v in given]
        more: dict[str, Expression] = {k: LiteralConstant(v, self.at) for k, v in named.items()}
        name = DottedName((function.definition.name,), {}, self.at)
        return self.inlined(function, FunctionCall(name, arguments, more, self.at))[0]


def _symbols(value: Any) -> Iterator[Any]:
    """The symbols of a value, an array or a record."""
    for one in value.fields.values() if isinstance(value, Record) else elements(value):
        if isinstance(one, Record | np.ndarray):
            yield from _symbols(one)
        elif isinstance(one, sp.Basic):
            yield from sorted(one.free_symbols, key=str)


def _dimensions(entry: Entry) -> float:
    """How many dimensions an argument has; more than any for a part whose class is not a record."""
    found, _ = entry.node.lookup(entry.declared.type.words)
    own = len(entry.declared.subscripts)
    if isinstance(found, ClassNode) and found.definition.kind in ("type", "record"):
        return own + len(found.view().subscripts)
    return own if isinstance(found, Predefined) else math.inf
