"""A traced function as data: blocks of operations, with all calls written out.

What JAX traces is read here once; the writers of C and of other languages see operations on arrays only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import jax
import jax.numpy as jnp
import numpy as np
from jax.extend.core import ClosedJaxpr, Literal

from acausal._jax import BARRIER, CALLS, WRITTEN_OUT, bind, called, name_of

FOLDED = 100_000
"""Most elements of a constant that is computed when a function is exported."""

SAME = frozenset({"stop_gradient", "copy", "copy_p", "reduce_precision", BARRIER})
"""Operations whose results are their arguments."""

LOOPS = frozenset({"while", "scan", "cond"})


@dataclass(frozen=True, eq=False)
class Value:
    """An array that an operation gives, or an argument.

    Attributes:
        shape: its lengths. kind: "real", "int" or "bool".
    """

    shape: tuple[int, ...]
    kind: str

    @cached_property
    def size(self) -> int:
        """The number of its elements."""
        return int(np.prod(self.shape, dtype=np.int64))


@dataclass(frozen=True, eq=False)
class Constant:
    """An array that is known when a function is exported."""

    array: np.ndarray

    @property
    def shape(self) -> tuple[int, ...]:
        """Its lengths."""
        return self.array.shape

    @property
    def kind(self) -> str:
        """The kind of its numbers."""
        return kind_of(self.array.dtype)


Atom: TypeAlias = Value | Constant


@dataclass(frozen=True, eq=False)
class Operation:
    """One operation.

    Attributes:
        name: JAX's name of it. inputs: what it reads. outputs: what it gives.
        params: JAX's parameters of it. origin: the equation of the model from which it came, or "".
    """

    name: str
    inputs: tuple[Atom, ...]
    outputs: tuple[Value, ...]
    params: Mapping[str, Any]
    origin: str = ""


@dataclass(frozen=True, eq=False)
class Block:
    """Operations, one after the other.

    Attributes:
        inputs: arguments. operations: in an order in which they can be done. outputs: results.
    """

    inputs: tuple[Value, ...]
    operations: tuple[Operation, ...]
    outputs: tuple[Atom, ...]

    def part(self, outputs: Iterable[Atom]) -> Block:
        """The same with these results, and without operations that reach none of them."""
        results = tuple(outputs)
        wanted, kept = set(results), list[Operation]()
        for operation in reversed(self.operations):
            if not wanted.isdisjoint(operation.outputs):
                kept.append(operation)
                wanted.update(operation.inputs)
        return Block(self.inputs, tuple(reversed(kept)), results)


def kind_of(dtype: Any) -> str:
    """The kind of a number type: "real", "int" or "bool".

    Raises:
        TypeError: for complex numbers and keys.
    """
    code = np.dtype(dtype).kind
    kinds = {"f": "real", "i": "int", "u": "int", "b": "bool"}
    if code not in kinds:
        raise TypeError(f"{dtype} is no real number")
    return kinds[code]


def trace(function: Callable[..., Any], *arguments: Any) -> Block:
    """The operations of a function of arrays; what does not reach a result is left out."""
    return block_of(jax.make_jaxpr(function)(*arguments))


def block_of(closed: ClosedJaxpr) -> Block:
    """The operations of a closed jaxpr."""
    jaxpr = closed.jaxpr
    inputs = tuple(_value(v) for v in jaxpr.invars)
    operations: list[Operation] = []
    outputs = _inline(closed, inputs, operations, "")
    return Block(inputs, tuple(operations), ()).part(outputs)


def _value(variable: Any) -> Value:
    return Value(tuple(variable.aval.shape), kind_of(variable.aval.dtype))


def _inline(
    closed: ClosedJaxpr, inputs: Sequence[Atom], found: list[Operation], origin: str
) -> list[Atom]:
    """Append the operations of a jaxpr for these arguments; gives its results."""
    jaxpr = closed.jaxpr
    known: dict[Any, Atom] = dict(zip(jaxpr.invars, inputs, strict=True))
    known |= {
        v: Constant(np.asarray(c)) for v, c in zip(jaxpr.constvars, closed.consts, strict=True)
    }

    def atom(variable: Any) -> Atom:
        return (
            Constant(np.asarray(variable.val)) if isinstance(variable, Literal) else known[variable]
        )

    for equation in jaxpr.eqns:
        name, arguments = name_of(equation), tuple(atom(v) for v in equation.invars)
        where = str(equation.source_info.name_stack) or origin
        if name in CALLS | WRITTEN_OUT:
            results = _inline(called(equation), arguments, found, where)
        elif name in SAME:
            results = list(arguments)
        elif name not in LOOPS and _is_known(arguments, equation):
            with jax.ensure_compile_time_eval():
                arrays = [jnp.asarray(a.array) for a in arguments if isinstance(a, Constant)]
                results = [Constant(np.asarray(r)) for r in bind(equation, arrays)]
        else:
            outputs = tuple(_value(v) for v in equation.outvars)
            found.append(Operation(name, arguments, outputs, equation.params, where))
            results = list(outputs)
        known |= dict(zip(equation.outvars, results, strict=True))
    return [atom(v) for v in jaxpr.outvars]


def _is_known(arguments: Sequence[Atom], equation: Any) -> bool:
    sizes = [int(np.prod(v.aval.shape, dtype=np.int64)) for v in equation.outvars]
    return all(isinstance(a, Constant) for a in arguments) and max(sizes, default=0) <= FOLDED
