"""Functions: those of the language, those of libraries, and a user's own, which are inlined."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import sympy as sp

from acausal.modelica.classes import ClassNode, Entry
from acausal.modelica.language import SPECIAL
from acausal.modelica.meanings import Native, Predefined, Value
from acausal.modelica.operators import MAX_CALLS, Frame
from acausal.modelica.overloading import Overloading
from acausal.modelica.syntax import (
    Branches,
    Call,
    Connect,
    Constant,
    Do,
    Equation,
    Expression,
    Loop,
    Name,
    Several,
    Statement,
    Whole,
)
from acausal.modelica.values import (
    Record,
    array_of,
    as_record,
    each,
    elements,
    with_fields,
)
from acausal.modeling import check_size
from acausal.netlist import function as known_function

MAX_STATEMENTS = 20_000
REFUSED = {
    "delay": "use the block Modelica.Blocks.Nonlinear.FixedDelay",
    "spatialDistribution": "divide the pipe into volumes",
    "terminal": "use an equation of time",
    "inStream": "use connectors without stream variables",
    "actualStream": "use connectors without stream variables",
    "getInstanceName": "write the name as a text",
    "terminate": "give the end of the simulation",
}
TEXTS: dict[str, Callable[..., Any]] = {
    "ModelicaStrings_length": len,
    "ModelicaStrings_substring": lambda text, first, last: text[first - 1 : last],
}
"""Functions of texts that are known when the model is built, by their name in C."""
REFUSED_PACKAGES = ("Connections.", "Modelica.Utilities.", "Clock", "previous", "hold", "interval")


class _Left(Exception):  # noqa: N818
    """``break`` or ``return``."""


class Interpreter(Overloading):
    """Evaluates expressions with calls, and executes statements of algorithms.

    Attributes:
        statements: how many were executed.
        path: under which condition that changes with time the present statements are executed.
        left: under which condition ``break`` or ``return`` has left them; ``returned``: ``return`` alone.
    """

    statements: int = 0
    path: Any = True
    left: Any = False
    returned: Any = False

    # -- calls -----------------------------------------------------------------------------------------

    def _call(self, call: Call) -> Any:
        words = call.function.words
        name = words[1] if words[0] == "" and len(words) == 2 else call.function.text
        special = SPECIAL.get(name)
        if special is not None and name not in self.frame.local:
            return special(self, call)
        if name in REFUSED and name not in self.frame.local:
            raise self.wrong(f"{name}(...) is not supported; {REFUSED[name]}", len(name))
        found, rest = self.frame.find(call.function.words)
        if rest:
            found = None
        if isinstance(found, ClassNode) and found.definition.kind == "function":
            results = self.inlined(found, call)
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
            raise self.wrong(f"'{name}' is not a function", len(name))
        self.at = call.function.at
        raise self.frame.node.unknown(call.function, "function")

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

    # -- functions of the user ---------------------------------------------------------------------------

    def inlined(self, node: ClassNode, call: Call) -> list[Any]:
        """The results of a function, as expressions of its arguments.

        Raises:
            ModelicaError: for a function that is written in another language, or a loop without a known end.
        """
        definition, view, at = node.definition, node.view(), call.at
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
        inputs = [n for n, e in view.entries.items() if e.declared.prefixes.causality == "input"]
        outputs = [n for n, e in view.entries.items() if e.declared.prefixes.causality == "output"]
        if len(call.arguments) > len(inputs):
            raise self.wrong(
                f"{definition.name} takes {len(inputs)} arguments, not {len(call.arguments)}",
                length,
            )
        values = {n: self.value(a) for n, a in zip(inputs, call.arguments, strict=False)}
        for name, expression in call.named.items():
            if name not in inputs:
                raise self.wrong(f"{definition.name} has no argument '{name}'", length)
            values[name] = self.value(expression)
        self.at = at
        if arrays := [n for n, v in values.items() if np.ndim(v) > view.entries[n].dimensions]:
            return self._for_each_element(node, call, values, arrays)
        local: dict[str, Any] = {}
        frame = Frame(node, None, local, self.frame.events, self.frame.calls + 1)
        inner = self.elsewhere(frame)
        inner.statements = self.statements
        for name, entry in view.entries.items():
            if name in values:
                local[name] = as_record(values[name])
                continue
            expression = entry.declared.modifier.value
            if expression is not None:
                local[name] = inner.elsewhere(
                    Frame(entry.node, None, local, frame.events, frame.calls)
                ).value(expression)
            elif name in inputs:
                raise self.wrong(f"{definition.name} needs '{name}'", length)
            else:
                local[name] = inner.empty(entry)
        for kind, statements, owner in view.sections:
            if kind == "algorithms":
                inner.frame = Frame(owner, None, local, frame.events, frame.calls)
                with suppress(_Left):
                    inner.execute(statements, local)
        self.operations, self.statements = inner.operations, inner.statements
        for name in outputs:
            if local[name] is None or any(v is None for v in elements(local[name])):
                raise self.wrong(f"{definition.name} does not assign '{name}'", length)
        if not outputs:
            raise self.wrong(f"{definition.name} has no result", length)
        return [local[name] for name in outputs]

    def _for_each_element(
        self, node: ClassNode, call: Call, values: dict[str, Any], arrays: list[str]
    ) -> list[Any]:
        """The results for arrays in the place of scalars: arrays, too (Modelica 3.6, section 12.4.6)."""
        shapes = {np.shape(values[n]) for n in arrays}
        if len(shapes) > 1:
            sizes = " and ".join(str(list(s)) for s in sorted(shapes))
            raise self.wrong(f"arrays of sizes {sizes} do not fit")
        (shape,) = shapes
        found: list[list[Any]] = []
        for place in np.ndindex(*shape):
            named: dict[str, Expression] = {
                n: Constant(v[place] if n in arrays else v, call.at) for n, v in values.items()
            }
            found.append(self.inlined(node, Call(call.function, [], named, call.at)))
        return [
            array_of(list(r)).reshape((*shape, *np.shape(r[0]))) for r in zip(*found, strict=True)
        ]

    def empty(self, entry: Entry) -> Any:
        """A variable before it is assigned: None, or an array or record of None."""
        found, _ = Frame(entry.node).find(entry.declared.type.words)
        subscripts, stated = entry.declared.subscripts, entry.declared.modifier.arguments
        if isinstance(found, ClassNode) and found.definition.kind == "record" and not subscripts:
            given = {a.name: a.modifier.value for a in stated if a.name in found.view().entries}
            named = {k: self.value(v) for k, v in given.items() if v is not None}
            return self.record_of(found, [], named)
        sizes = [self.value(s) for s in subscripts if not isinstance(s, Whole)]
        if not sizes or len(sizes) < len(subscripts):
            return None
        shape = [self.whole(n, "a size") for n in sizes]
        check_size(int(np.prod(shape)), "the array")
        return np.empty(shape, dtype=object)

    # -- algorithms ----------------------------------------------------------------------------------------

    def execute(self, statements: list[Statement], local: dict[str, Any]) -> None:
        """Execute statements; ``local`` holds the variables that they assign.

        Raises:
            ModelicaError: for what cannot become expressions.
        """
        for statement in statements:
            self.statements += 1
            self.at = statement.at
            if self.statements > MAX_STATEMENTS:
                raise self.wrong(
                    f"more than {MAX_STATEMENTS} statements are executed; does the loop end?"
                )
            match statement:
                case Equation():
                    self._assign(statement, local)
                case Branches() if statement.word == "if":
                    self._branch(statement.branches, local)
                case Loop():
                    self._loop(statement, local)
                case Do():
                    word = statement.call.function.text
                    if word in ("break", "return"):
                        self.left = self.logical(sp.Or, self.left, self.path)
                        if word == "return":
                            self.returned = self.logical(sp.Or, self.returned, self.path)
                        raise _Left(word)
                    self.perform(statement.call)
                case Branches() | Connect():
                    raise self.wrong("this does not stand in an algorithm of a function")

    def _assign(self, statement: Equation, local: dict[str, Any]) -> None:
        left = statement.left
        if isinstance(left, Several):
            if not isinstance(statement.right, Call):
                raise self.wrong("several variables are assigned the results of a function")
            for target, value in zip(left.items, self.results(statement.right), strict=False):
                if target is not None:
                    self._set(target, value, local)
            return
        self._set(left, self.value(statement.right), local)

    def results(self, call: Call) -> list[Any]:
        """All results of a function."""
        self.at = call.at
        found, rest = self.frame.find(call.function.words)
        if not rest and isinstance(found, ClassNode) and found.definition.kind == "function":
            return self.inlined(found, call)
        return [self.value(call)]

    def _set(self, target: Expression, value: Any, local: dict[str, Any]) -> None:
        self.at = target.at
        if not isinstance(target, Name) or target.words[0] not in local:
            what = target.text if isinstance(target, Name) else "this"
            raise self.wrong(f"'{what}' cannot be assigned here")
        word = target.words[0]
        if self.left is not True:
            changed = self._changed(local[word], target, 0, value)
            kept = self.left is not False
            local[word] = self._merged(self.left, local[word], changed) if kept else changed

    def _changed(self, old: Any, target: Name, i: int, value: Any) -> Any:
        """The value of a variable after one of its elements or fields has changed."""
        subscripts = target.subscripts.get(i)
        if subscripts is None:
            if i + 1 == len(target.words):
                if isinstance(old, np.ndarray) and not isinstance(value, np.ndarray):
                    raise self.wrong("an array is assigned, not a number")
                return value
            if not isinstance(old, Record):
                raise self.wrong(f"'{target.words[i]}' is no record")
            word = target.words[i + 1]
            inner = self._changed(old.fields.get(word), target, i + 1, value)
            return Record({**old.fields, word: inner}, old.node)
        if not isinstance(old, np.ndarray) or i + 1 < len(target.words):
            raise self.wrong(f"'{target.words[i]}' is not an array")
        places = self.places(old.shape, subscripts)
        changed = old.copy()
        if all(isinstance(p, int) for p in places) and len(places) == old.ndim:
            changed[tuple(places)] = value
        else:
            axes = [[p] if isinstance(p, int) else p for p in places]
            axes += [list(range(n)) for n in old.shape[len(places) :]]
            where_ = np.ix_(*axes)
            changed[where_] = (
                np.reshape(value, changed[where_].shape) if isinstance(value, np.ndarray) else value
            )
        return changed

    def _branch(
        self, branches: list[tuple[Expression | None, list[Statement]]], local: dict[str, Any]
    ) -> None:
        if not branches:
            return
        (test, body), *rest = branches
        holds = self.holds(test)
        if holds is True:
            self.execute(body, local)
        elif holds is False:
            self._branch(rest, local)
        else:
            before, path = dict(local), self.path
            self.path = self.logical(sp.And, path, holds)
            with suppress(_Left):
                self.execute(body, local)
            first = dict(local)
            local.clear()
            local.update(before)
            self.path = self.logical(sp.And, path, self.logical(sp.Not, holds))
            with suppress(_Left):
                self._branch(rest, local)
            self.path = path
            for name, value in first.items():
                local[name] = self._merged(holds, value, local.get(name))

    def _merged(self, holds: Any, value: Any, otherwise: Any) -> Any:
        if value is otherwise:
            return value
        if value is None or otherwise is None:
            return None
        if isinstance(value, np.ndarray) and isinstance(otherwise, np.ndarray):
            return each(lambda a, b: self._merged(holds, a, b), value, otherwise)
        if isinstance(value, Record) and isinstance(otherwise, Record):
            fields = otherwise.fields
            merged = {k: self._merged(holds, v, fields[k]) for k, v in value.fields.items()}
            return Record(merged, value.node)
        return self.chosen(holds, value, otherwise)

    def _loop(self, loop: Loop, local: dict[str, Any]) -> None:
        frame, left = self.frame, self.left
        try:
            if loop.condition is not None:
                while self._goes_on(loop):
                    self.execute(loop.body, local)
                return
            for values in self.iterated(loop.iterators):
                self.frame = Frame(
                    frame.node, frame.build, _Layered(local, values), frame.events, frame.calls
                )
                self.execute(loop.body, self.frame.local)
                self.frame = frame
        except _Left as error:
            if str(error) == "return":
                raise
        finally:
            self.frame = frame
            self.left = self.logical(sp.Or, left, self.returned)

    def _goes_on(self, loop: Loop) -> bool:
        assert loop.condition is not None
        holds = self.truth(self.value(loop.condition))
        self.statements += 1
        if not isinstance(holds, bool):
            self.at = loop.condition.at
            raise self.wrong(
                "a loop whose end changes with time is not supported; use a loop over 1:n"
            )
        return holds

    def perform(self, call: Call) -> None:
        """A call that stands alone: an assertion.

        Raises:
            ModelicaError: for others.
        """
        word = call.function.text
        self.at = call.at
        if word != "assert":
            hint = f"; {REFUSED[word]}" if word in REFUSED else ""
            raise self.wrong(f"{word}(...) is not supported here{hint}", len(word))
        self.checked(call)

    def checked(self, call: Call) -> None:
        """An assertion: of parameters it is checked now, of others there is a warning that nothing watches it."""
        arguments = [*call.arguments, *call.named.values()]
        if len(arguments) < 2:
            raise self.wrong("assert takes a condition and a text")
        holds, node = self.truth(self.value(arguments[0])), self.frame.node
        level = arguments[2] if len(arguments) > 2 else None
        if isinstance(level, Name) and level.words[-1] == "warning":
            return
        if isinstance(holds, sp.Basic) and self.varies(holds):
            if call.at not in node.unwatched:
                node.unwatched.add(call.at)
                found = node.wrong(call.at, "this assertion is not watched while the model runs")
                warnings.warn(str(found).partition("\n")[0], stacklevel=2)
            return
        if self.known(holds, "this assertion") is False:
            text = arguments[1].value if isinstance(arguments[1], Constant) else "it is false"
            raise self.wrong(f"this assertion is violated: {text}")


class _Layered(dict[str, Any]):
    """Local names with loop variables on top; the others are assigned where they belong."""

    def __init__(self, below: dict[str, Any], top: dict[str, Any]) -> None:
        super().__init__({**below, **top})
        self.below, self.top = below, top

    def __setitem__(self, name: str, value: Any) -> None:
        super().__setitem__(name, value)
        if name not in self.top:
            self.below[name] = value

    def clear(self) -> None:
        pass

    def update(self, *others: Any, **more: Any) -> None:  # pyright: ignore[reportIncompatibleMethodOverride]
        for name, value in dict(*others, **more).items():
            self[name] = value
