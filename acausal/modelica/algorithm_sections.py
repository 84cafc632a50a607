"""Algorithms of components: each variable equals the last value that it is assigned."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import islice
from types import MappingProxyType
from typing import Any

import numpy as np
import sympy as sp

from acausal.modelica.algorithms import Left
from acausal.modelica.operators import Frame
from acausal.modelica.sections import SectionReader, collect, is_discrete
from acausal.modelica.syntax import Branches, DottedName, EquationStatement, Statement
from acausal.modelica.values import as_array, as_record, each, elements, is_record
from acausal.modeling import Discrete, Parameter, Reference, Start, When, change, pre

LARGE = 1000
"""A value of so many parts, at least, is kept as a variable between two statements of an algorithm."""


class AlgorithmReader(SectionReader):
    """Reads one algorithm.

    Attributes:
        assigned: variables of the component that it assigns outside of ``when``, or in several.
        later: values of those that a ``when`` further down assigns.
    """

    assigned: Mapping[str, Any] = MappingProxyType({})
    later: Mapping[str, Any] = MappingProxyType({})

    def algorithm(self, stated: list[Statement]) -> Iterator[Any]:
        """The equations of an algorithm: each variable that it assigns equals its last value."""
        build = self.frame.build
        assert build is not None
        always, at_events = set[str](), set[str]()
        own = [s for s in stated if not self._is_of_part(s)]
        collect([s for s in own if not _is_when(s)], always, within=True)
        whens = [s for s in stated if _is_when(s)]
        collect(whens, at_events, within=True)
        if both := [w for w in sorted(always & at_events) if build.types.get(w) == "Real"]:
            raise self.wrong(
                f"'{both[0]}' is assigned within 'when' and outside of it, which is not supported"
            )
        variables = {w: build.member(w) for w in sorted(always | at_events) if w in build.names}
        for word, value in variables.items():
            first = elements(value)[0] if np.size(value) else None
            fixed = not isinstance(first, Reference) or isinstance(first.declaration, Parameter)
            if fixed and not is_record(as_record(value)):
                raise self.wrong(f"'{word}' is no variable that an algorithm assigns")
        always |= {w for w in at_events if sum(w in _assigned_by(s) for s in whens) > 1}
        local: dict[str, Any] = {
            w: self._before(w, variables[w]) if w in always else variables[w] for w in variables
        }
        frame = self.frame
        self.assigned, self.further = {w: v for w, v in variables.items() if w in always}, []
        self.later = {w: each(pre, variables[w]) for w in variables if w in at_events - always}
        for statement in stated:
            self.frame = Frame(frame.node, build, local, frame.events)
            self.at = statement.at
            if isinstance(statement, Branches) and _is_when(statement):
                yield self._event(statement, local, variables)
            elif isinstance(statement, EquationStatement) and statement not in own:
                yield from self._equation(statement)
            else:
                self._perform(statement, local)
        self.frame, self.assigned = frame, {}
        yield from self.further
        for word in sorted(always & set(variables), key=list(build.names).index):
            if any(v is None for v in elements(local[word])):
                raise self.wrong(
                    f"the algorithm does not assign '{word}' in every case; give it a start, or assign it first"
                )
            yield from self.pairs(variables[word], local[word])

    def _event(self, statement: Branches, local: dict[str, Any], variables: dict[str, Any]) -> When:
        """What happens at events; afterwards ``local`` holds what the variables are then."""
        assigned = _assigned_by(statement)
        versions = {
            w: self._version(w, variables[w]) for w in variables if w in assigned & {*self.assigned}
        }
        before = {**local, **self.later}
        found = self._when(
            statement, lambda body: self._assigned(body, before, variables, versions)
        )
        self.frame = replace(self.frame, events=False)  # these change at events only
        for w, (changed, value) in versions.items():
            local[w] = self.chosen(change(changed), value, local[w])
        self.later = {w: v for w, v in self.later.items() if w not in assigned}
        return found

    def _perform(self, statement: Statement, local: dict[str, Any]) -> None:
        try:
            self.execute([statement], local)
        except Left as error:
            raise self.wrong(f"'{error}' stands in loops and functions", len(str(error))) from None

    def _before(self, word: str, variable: Any) -> Any:
        """The value of a variable when an algorithm begins: its last one, or its start; None where none is given."""
        build: Any = self.frame.build
        known = build.component._node.modifiers.get(word)
        start = as_array(known.value) if isinstance(known, Start) else None

        def one(variable: Any, start: Any) -> Any:
            return pre(variable) if is_discrete(variable) else start

        return each(one, variable, start)

    def _is_of_part(self, statement: Statement) -> bool:
        """Whether an assignment gives a variable of a part or connector its value, once, as an equation does."""
        build: Any = self.frame.build
        target = statement.left if isinstance(statement, EquationStatement) else None
        if (
            not isinstance(target, DottedName)
            or len(target.words) == 1
            or target.words[0] not in build.names
        ):
            return False
        return not is_record(as_record(build.member(target.words[0])))

    def kept(self, word: str, value: Any) -> Any:
        """A large value of a discrete variable becomes a variable, so that what is made of it stays small."""

        def one(variable: Any, v: Any) -> Any:
            parts = sp.preorder_traversal(v) if isinstance(v, sp.Basic) else ()
            if len(list(islice(parts, LARGE))) < LARGE or not is_discrete(variable):
                return v
            kind = variable.declaration.kind
            return self.named(
                f"{variable.path}_{len(self.further) + 1}", Discrete(kind=kind), word, v
            )

        return each(one, self.assigned[word], value) if word in self.assigned else value

    def _version(self, word: str, variable: Any) -> tuple[Any, Any]:
        """For one of several ``when`` that assign a variable: what changes where it does, and what it assigns."""
        build: Any = self.frame.build
        name = f"{word}_at_{self.at}"
        like = elements(variable)[0]
        if not is_discrete(like):
            raise self.wrong(f"'{word}' is assigned by several 'when', which is not supported")
        declared = Discrete(kind=like.declaration.kind, shape=np.shape(variable) or None)
        return (
            self.declared(f"{name}_changes", Discrete(kind="bool"), "Boolean"),
            self.declared(name, declared, build.types[word]),
        )

    def _assigned(
        self,
        body: list[Statement],
        local: dict[str, Any],
        variables: dict[str, Any],
        versions: dict[str, tuple[Any, Any]],
    ) -> list[Any]:
        """What happens at an event of an algorithm."""
        frame, jumps = self.frame, self.jumps
        inner = dict(local)
        self.frame, self.jumps = Frame(frame.node, frame.build, inner, frame.events), []
        self.execute(body, inner)
        found: list[Any] = []
        for w in [w for w in inner if inner[w] is not local.get(w)]:
            target = variables[w]
            if w in versions:
                changed, target = versions[w]
                found += self.pairs(changed, self.logical(sp.Not, pre(changed)))
            found += [self._sampled(e) for e in self.pairs(target, inner[w])]
        found += self.jumps
        self.frame, self.jumps = frame, jumps
        return found


def _is_when(statement: Statement) -> bool:
    return isinstance(statement, Branches) and statement.word == "when"


def _assigned_by(statement: Statement) -> set[str]:
    """Names that a statement assigns."""
    found = set[str]()
    collect([statement], found, within=True)
    return found
