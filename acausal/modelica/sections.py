"""The statements of a section of equations or of an algorithm, read as those of a component."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError, warn
from acausal.modelica.connecting import Connecting, is_of_graph
from acausal.modelica.meanings import Literal
from acausal.modelica.syntax import (
    Branch,
    Branches,
    Connect,
    Do,
    DottedName,
    EquationStatement,
    FunctionCall,
    Loop,
    Several,
    Statement,
)
from acausal.modelica.values import (
    Absent,
    Record,
    as_array,
    elements,
    of,
    type_of,
)
from acausal.modeling import (
    Assert,
    Component,
    Discrete,
    Eq,
    Reference,
    Reinit,
    Variable,
    When,
    der,
    each,
    pre,
)


class SectionReader(Connecting):
    """Reads the statements of one section."""

    jumps: list[Reinit] | None = None
    further: list[Eq]
    """Of variables that it has added to the component."""

    # -- equations ---------------------------------------------------------------------------------------

    def stated(self, stated: Iterable[Statement]) -> Iterator[Any]:
        """The equations that statements make."""
        for statement in stated:
            self.at = statement.at
            self.operations = 0
            match statement:
                case EquationStatement():
                    yield from self._equation(statement)
                case Loop():
                    for _ in self.repeated(statement):
                        yield from self.stated(statement.body)
                case Branches() if statement.word == "if":
                    yield from self._cases(statement.branches)
                case Branches():
                    self.further = []
                    yield self._when(statement, lambda body: list(self._at_event(body)))
                    yield from self.further
                case Do() if statement.call.function.text == "assert":
                    yield from self._assertion(statement.call)
                case Do() if not is_of_graph(statement):
                    self.perform(statement.call)
                case Do() | Connect():
                    pass

    def _equation(self, statement: EquationStatement) -> Iterator[Eq]:
        left, right = statement.left, statement.right
        if isinstance(left, Several):
            if not isinstance(right, FunctionCall):
                raise self.wrong("several results are those of a function")
            for target, value in zip(left.items, self.results(right), strict=False):
                if target is not None:
                    yield from self.pairs(self.value(target), value)
            return
        a, b = self.value(left), self.value(right)
        self.at = statement.at
        yield from self.pairs(a, b)

    def pairs(self, left: Any, right: Any) -> Iterator[Eq]:
        """The equations ``left = right``: of arrays and records one for each element."""
        if isinstance(left, Absent) or isinstance(right, Absent):
            raise self.wrong("this is left out by its condition")
        if isinstance(left, Record | Component) or isinstance(right, Record | Component):
            yield from self._fields(left, right)
            return
        if np.shape(left) != np.shape(right):
            raise self.wrong(
                f"the sides have the sizes {list(np.shape(left))} and {list(np.shape(right))}"
            )
        for a, b in zip(elements(left), elements(right), strict=True):
            if isinstance(a, Record) or isinstance(b, Record):
                yield from self._fields(a, b)
            else:
                yield self._pair(a, b)

    def _fields(self, left: Any, right: Any) -> Iterator[Eq]:
        some = left if isinstance(left, Record) else right
        record = isinstance(some, Record)
        names = list(some.fields) if record else [n for n, _ in some._node.declarations()]
        for name in names:
            a, b = of(left, name), of(right, name)
            if a is None or b is None:
                raise self.wrong(f"only one side has '{name}'")
            yield from self.pairs(a, b)

    def _pair(self, left: Any, right: Any) -> Eq:
        truths = [kind == "Boolean" for kind in (type_of(left), type_of(right)) if kind]
        if len(truths) == 2 and truths[0] != truths[1]:
            raise self.wrong("one side is a Boolean, the other is not")
        if isinstance(left, Reference) and not isinstance(right, Reference):
            self.need_type(
                type_of(left), right
            )  # an Integer may give a Real its value, and stand on the left
        sides = [v.number if isinstance(v, Literal) else v for v in (left, right)]
        for side in sides:
            if isinstance(side, str):
                raise self.wrong("an equation of texts is not supported")
        if (
            isinstance(right, Reference)
            and not isinstance(left, Reference)
            and isinstance(right.declaration, Discrete)
        ):
            sides.reverse()
        try:
            return Eq(*(float(v) if isinstance(v, bool) else v for v in sides))
        except DeclarationError as error:
            raise self.wrong(str(error)) from None

    # -- if ------------------------------------------------------------------------------------------------

    def _cases(self, branches: Sequence[Branch]) -> Iterator[Any]:
        """The equations of ``if``; of conditions that are not known each equation chooses between branches."""
        if not branches:
            return
        (test, body), *rest = branches
        holds = self.holds(test)
        if isinstance(holds, sp.Basic) and not self.varies(holds):
            holds = self.known(holds, "this condition")
        if isinstance(holds, bool):
            yield from self.stated(body) if holds else self._cases(rest)
            return
        at = self.at
        first, second = list(self.stated(body)), list(self._cases(rest))
        self.at = at
        for some, applies in ((first, holds), (second, sp.Not(holds))):
            for one in [one for one in some if isinstance(one, Assert)]:
                some.remove(one)
                yield from self._asserting(
                    sp.Or(sp.Not(applies), one.condition), one.text, one.level
                )
        if len(first) != len(second):
            reason = (
                f"the branches have {len(first)} and {len(second)} equations; they need as many"
            )
            raise self.wrong(reason)
        for a, b in zip(first, second, strict=True):
            if not isinstance(a, Eq) or not isinstance(b, Eq):
                raise self.wrong("'when' within an 'if' whose condition changes is not supported")
            if a.lhs == b.lhs:
                yield Eq(a.lhs, self.chosen(holds, a.rhs, b.rhs))
            else:
                sides = [self.arithmetic("-", e.lhs, e.rhs) for e in (a, b)]
                yield Eq(0, self.chosen(holds, *sides))

    def _assertion(self, call: FunctionCall) -> Iterator[Assert]:
        """An assertion of what varies, which a simulation looks at; one of parameters is looked at now, too."""
        self.at = call.at
        holds, text, level = self.asserted(call)
        varies = isinstance(holds, sp.Basic) and self.varies(holds)
        if not varies:
            self.perform(call)
        if isinstance(holds, sp.Basic):
            place = self.frame.node.source.place(call.at)
            yield from self._asserting(holds, f"{text} ({place})" if place else text, level)

    def _asserting(self, holds: Any, text: str, level: str) -> Iterator[Assert]:
        """An assertion, if it does not hold in any case; with a warning none, where nothing can look at it."""
        try:
            made: Any = Assert(holds, text, level)
        except DeclarationError:
            warn(f"nothing watches this assertion while the model runs: {text}")
        else:
            yield from each([made])

    # -- when ----------------------------------------------------------------------------------------------

    def _when(self, statement: Branches, read: Any) -> When:
        """A chain of what happens at events."""
        links: list[tuple[list[Any], list[Any]]] = []
        for test, body in statement.branches:
            assert test is not None
            found = self.value(test)
            self.at = test.at
            conditions = [self.condition(c) for c in elements(found) if c is not False]
            links.append((conditions, read(body)))
        chain: When | None = None
        for conditions, found in reversed(links):
            try:
                chain = When(tuple(conditions), *found, otherwise=chain)
            except DeclarationError as error:
                self.at = statement.at
                raise self.wrong(str(error)) from None
        assert chain is not None
        return chain

    def condition(self, value: Any) -> Any:
        """A condition of an event."""
        value = self.truth(value)
        if isinstance(value, bool):
            raise self.wrong(f"this is {str(value).lower()} at all times, so that nothing happens")
        return value

    def _at_event(self, body: Sequence[Statement]) -> Iterator[Any]:
        """Discrete equations and jumps."""
        for statement in body:
            self.at = statement.at
            match statement:
                case EquationStatement():
                    for equation in self._equation(statement):
                        if not isinstance(equation.lhs, Reference):
                            raise self.wrong("an equation within 'when' is 'variable = value'")
                        yield self._sampled(equation)
                case Do() if statement.call.function.text == "reinit":
                    yield from self._reinit(statement.call)
                case Do():
                    self.perform(statement.call)
                case Loop():
                    for _ in self.repeated(statement):
                        yield from self._at_event(statement.body)
                case Branches() if statement.word == "if":
                    yield from self._if_at_event(statement.branches)
                case _:
                    raise self.wrong("this does not stand within 'when'")

    def _if_at_event(self, branches: Sequence[Branch]) -> Iterator[Any]:
        """``if`` within ``when``: a variable that a branch does not mention keeps its value."""
        if not branches:
            return
        (test, body), *rest = branches
        holds = self.holds(test)
        if isinstance(holds, bool):
            yield from self._at_event(body) if holds else self._if_at_event(rest)
            return
        sides = [
            {_target(s): s for s in found}
            for found in (self._at_event(body), self._if_at_event(rest))
        ]
        for target in dict.fromkeys([*sides[0], *sides[1]]):
            kind: Any = type(sides[0].get(target, sides[1].get(target)))
            values = [_value(side[target]) if target in side else pre(target) for side in sides]
            yield kind(target, self.chosen(holds, *values))

    def _reinit(self, call: FunctionCall) -> Iterator[Reinit]:
        state, value = self.arguments(call, 2)
        if np.shape(state) != np.shape(value):
            raise self.wrong("reinit takes a state and a value of the same size")
        for a, b in zip(elements(state), elements(value), strict=True):
            try:
                yield Reinit(a, self.number(b))
            except DeclarationError as error:
                raise self.wrong(str(error)) from None

    def perform(self, call: FunctionCall) -> None:
        """A call that stands alone: an assertion, or the jump of a state in an algorithm."""
        word = call.function.text
        if word == "reinit" and self.jumps is not None:
            self.jumps += self._reinit(call)
        elif word == "reinit":
            raise self.wrong("reinit stands within 'when' only", len(word))
        else:
            super().perform(call)

    # -- further variables ---------------------------------------------------------------------------------

    def declared(self, name: str, declared: Variable, kind: str) -> Any:
        """A further variable of the component."""
        build: Any = self.frame.build
        name = re.sub(r"\W+", "_", name)
        if name not in vars(build.component):
            setattr(build.component, name, declared)
            build.types[name] = kind
        return as_array(getattr(build.component, name))

    def named(self, name: str, declared: Variable, word: str, value: Any) -> Any:
        """A further variable for a value, of the type of another one."""
        build: Any = self.frame.build
        found = self.declared(name, declared, build.types.get(word, "Real"))
        self.further += self.pairs(found, value)
        return found

    def _sampled(self, equation: Eq) -> Eq:
        """An equation within ``when``; its derivatives become variables, which are there at all times."""
        target, value = cast(Reference, equation.lhs), equation.rhs
        for i, one in enumerate(sorted(value.atoms(der), key=str), start=1):
            variable = self.named(f"{target.path}_rate_{i}", Variable(), "", one)
            value = value.xreplace({one: variable})
        return Eq(target, value)


def is_discrete(variable: Any) -> bool:
    """Whether this is a variable that changes at events only."""
    return isinstance(variable, Reference) and isinstance(variable.declaration, Discrete)


def _target(statement: Eq | Reinit) -> Any:
    return statement.lhs if isinstance(statement, Eq) else statement.state


def _value(statement: Eq | Reinit) -> Any:
    return statement.rhs if isinstance(statement, Eq) else statement.value


def collect(stated: Sequence[Statement], found: set[str], within: bool) -> None:
    """Names that statements assign; unless already ``within``, those in ``when`` only."""
    for statement in stated:
        match statement:
            case EquationStatement() if within:
                named = isinstance(statement.left, DottedName | Several)
                left = statement.left if named else statement.right
                targets = left.items if isinstance(left, Several) else [left]
                found |= {t.words[0] for t in targets if isinstance(t, DottedName)}
            case Branches():
                for _, body in statement.branches:
                    collect(body, found, within or statement.word == "when")
            case Loop():
                collect(statement.body, found, within)
            case _:
                pass
