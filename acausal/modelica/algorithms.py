"""Algorithms: statements are executed on expressions, whose conditions may change with time."""

from __future__ import annotations

from contextlib import suppress
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import warn
from acausal.modelica.classes import ClassNode
from acausal.modelica.evaluate import Evaluator
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import (
    Branch,
    Branches,
    Connect,
    Do,
    DottedName,
    EquationStatement,
    Expression,
    FunctionCall,
    Loop,
    OperatorExpression,
    Several,
    Statement,
)
from acausal.modelica.tokens import ModelicaError
from acausal.modelica.values import Record, each, elements

MAX_STATEMENTS = 20_000
MAX_PARTS = 100_000
REFUSED = {
    "delay": "use the block Modelica.Blocks.Nonlinear.PadeDelay, an approximation",
    "spatialDistribution": "divide the pipe into volumes",
    "inStream": "use connectors without stream variables",
    "actualStream": "use connectors without stream variables",
    **dict.fromkeys(
        ("Clock", "previous", "hold", "interval", "subSample", "superSample", "noClock"),
        "write 'when sample(start, period) then', or use Modelica.Blocks.Discrete",
    ),
}


class Left(Exception):  # noqa: N818
    """``break`` or ``return``."""


class Algorithms(Evaluator):
    """Executes the statements of algorithms.

    Attributes:
        statements: how many were executed. inputs: of the function, which it cannot assign.
        path: under which condition that changes with time the present statements are executed.
        left: under which condition ``break`` or ``return`` has left them; ``returned``: ``return`` alone.
    """

    statements: int = 0
    inputs: frozenset[str] = frozenset()
    path: Any = True
    left: Any = False
    returned: Any = False

    def inlined(self, node: ClassNode, call: FunctionCall) -> list[Any]:
        """The results of a function."""
        raise NotImplementedError

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
                case EquationStatement():
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
                        raise Left(word)
                    self.perform(statement.call)
                case Branches() | Connect():
                    raise self.wrong("this does not stand in an algorithm of a function")

    def _assign(self, statement: EquationStatement, local: dict[str, Any]) -> None:
        left = statement.left
        if isinstance(left, Several):
            if not isinstance(statement.right, FunctionCall):
                raise self.wrong("several variables are assigned the results of a function")
            for target, value in zip(left.items, self.results(statement.right), strict=False):
                if target is not None:
                    self._set(target, value, local)
            return
        self._set(left, self.value(statement.right), local)

    def results(self, call: FunctionCall) -> list[Any]:
        """All results of a function."""
        self.at = call.at
        found, rest = self.frame.find(call.function.words)
        if not rest and isinstance(found, ClassNode) and found.definition.kind == "function":
            return self.inlined(found, call)
        return [self.value(call)]

    def _set(self, target: Expression, value: Any, local: dict[str, Any]) -> None:
        self.at = target.at
        if not isinstance(target, DottedName) or target.words[0] not in local:
            what = target.text if isinstance(target, DottedName) else "this"
            raise self.wrong(f"'{what}' cannot be assigned here")
        word = target.words[0]
        if word in self.inputs:
            raise self.wrong(f"'{word}' is an input; assign a protected variable", len(word))
        if any(isinstance(v, sp.Basic) and _parts(v) > MAX_PARTS for v in elements(value)):
            raise self.too_large(
                f"'{word}' becomes an expression of more than {MAX_PARTS} parts; make fewer steps, "
                "or state an equation for what they lead to",
                len(word),
            )
        if self.left is not True:
            changed = self._changed(local[word], target, 0, value)
            kept = self.left is not False
            local[word] = self._merged(self.left, local[word], changed) if kept else changed

    def _changed(self, old: Any, target: DottedName, i: int, value: Any) -> Any:
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

    def _branch(self, branches: list[Branch], local: dict[str, Any]) -> None:
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
            with suppress(Left):
                self.execute(body, local)
            first = dict(local)
            local.clear()
            local.update(before)
            self.path = self.logical(sp.And, path, self.logical(sp.Not, holds))
            with suppress(Left):
                self._branch(rest, local)
            self.path = path
            for name, value in first.items():
                local[name] = self.kept(name, self._merged(holds, value, local.get(name)))

    def kept(self, word: str, value: Any) -> Any:
        """The value of a variable behind an ``if``, as what comes then shall read it."""
        return value

    def _merged(self, holds: Any, value: Any, otherwise: Any) -> Any:
        if value is otherwise:
            return value
        if value is None or otherwise is None:
            if self.frame.build is not None:
                return None
            # nobody may read a variable of a function that a branch leaves undefined: any value will do there
            return otherwise if value is None else value
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
        except Left as error:
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
            raise self.too_large(
                "a loop whose end changes with time is not supported; use a loop over 1:n"
            )
        return holds

    def perform(self, call: FunctionCall) -> None:
        """A call that stands alone: an assertion, or a function that may have some.

        Raises:
            ModelicaError: for others.
        """
        word = call.function.text
        self.at = call.at
        if self.frame.build is not None:
            self.frame.build.performs = True
        found, rest = self.frame.find(call.function.words)
        if self.full_name(call) == "Modelica.Utilities.Streams.print":
            self.unwatched(call, "this text is not printed")
        elif word == "terminate":
            self.unwatched(call, "this does not end the simulation; give its end to simulate(...)")
        elif isinstance(found, ClassNode) and found.definition.kind == "function" and not rest:
            self.inlined(found, call)
        elif word != "assert":
            hint = f"; {REFUSED[word]}" if word in REFUSED else ""
            raise self.wrong(f"{word}(...) is not supported here{hint}", len(word))
        else:
            self.checked(call)

    def at_the_end(self, call: FunctionCall) -> bool:
        """``terminal()``, which is false while a model runs."""
        self.unwatched(
            call, "the end of a simulation is no event; what is to happen then is left out"
        )
        return False

    def full_name(self, call: FunctionCall) -> str:
        """The full name of a function, where its text is known."""
        found, rest = self.frame.find(call.function.words)
        return found.full if isinstance(found, ClassNode) and not rest else call.function.text

    def unwatched(self, call: FunctionCall, what: str) -> None:
        """Warn once of a statement that does nothing."""
        node = self.frame.node
        if call.at not in node.unwatched:
            node.unwatched.add(call.at)
            warn(str(node.wrong(call.at, what)).partition("\n")[0])

    def checked(self, call: FunctionCall) -> None:
        """An assertion: of parameters it is checked now, of others there is a warning that nothing watches it."""
        holds, text, level = self.asserted(call)
        if level == "warning":
            return
        if isinstance(holds, sp.Basic) and self.varies(holds):
            self.unwatched(call, "this assertion is not watched while the model runs")
        elif self.known(holds, "this assertion") is False:
            raise self.wrong(f"this assertion is violated: {text}")

    def asserted(self, call: FunctionCall) -> tuple[Any, str, str]:
        """Condition, text and level of an assertion."""
        if self.frame.build is not None:
            self.frame.build.performs = True
        given = dict(zip(("condition", "message", "level"), call.arguments, strict=False))
        given |= call.named
        if not {"condition", "message"} <= given.keys():
            raise self.wrong("assert takes a condition and a text")
        holds, level = self.truth(self.value(given["condition"])), given.get("level")
        is_warning = isinstance(level, DottedName) and level.words[-1] == "warning"
        return holds, self._shown(given["message"]), "warning" if is_warning else "error"

    def _shown(self, text: Expression) -> str:
        """A text; what changes with time is left out."""
        try:
            return str(self.value(text))
        except ModelicaError:
            if isinstance(text, OperatorExpression) and text.operator == "+":
                return "".join(map(self._shown, text.operands))
            return "..."


@lru_cache(maxsize=50_000)
def _parts(value: sp.Basic) -> int:
    """How many parts an expression has; one that it has several times counts as often."""
    return 1 + sum(map(_parts, value.args))


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
