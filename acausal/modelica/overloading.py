"""Operators of records, such as those of complex numbers: functions of its class (Modelica 3.6, chapter 14)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any

import numpy as np

from acausal.modelica.classes import ClassNode
from acausal.modelica.evaluate import Evaluator
from acausal.modelica.operators import Frame
from acausal.modelica.syntax import (
    ClassDefinition,
    DottedName,
    Expression,
    FunctionCall,
    LiteralConstant,
)
from acausal.modelica.values import Record, array_of, each, is_record


class Overloading(Evaluator):
    """Applies operators to records, and makes records of their fields."""

    def inlined(self, node: ClassNode, call: FunctionCall) -> list[Any]:
        """The results of a function."""
        raise NotImplementedError

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
        return self._called(function, given, named)

    def _operator(self, sign: str, values: Sequence[Any]) -> Any:
        node: ClassNode = next(v.node for v in values if isinstance(v, Record))
        for given in (list(values), [self._made(node, v) for v in values]):
            function = self._of_class(node, f"'{sign}'", given, {})
            if function is not None:
                return self._called(function, given, {})
        raise self.wrong(f"'{node.full}' has no operator '{sign}' for {len(values)} operand(s)")

    def _dot(self, left: Any, right: Any) -> Any:
        """The product of arrays; that of two vectors by the function that takes them, if there is one."""
        node: ClassNode = next(v.node for v in (*left.flat, *right.flat) if isinstance(v, Record))
        if left.ndim == right.ndim == 1:
            given = [each(lambda v: self._made(node, v), vector) for vector in (left, right)]
            function = self._of_class(node, "'*'", given, {})
            if function is not None:
                return self._called(function, given, {})
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
        return value if function is None else self._called(function, [value], {})

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

    def _called(self, function: ClassNode, given: Sequence[Any], named: dict[str, Any]) -> Any:
        arguments: list[Expression] = [LiteralConstant(v, self.at) for v in given]
        more: dict[str, Expression] = {k: LiteralConstant(v, self.at) for k, v in named.items()}
        name = DottedName((function.definition.name,), {}, self.at)
        return self.inlined(function, FunctionCall(name, arguments, more, self.at))[0]
