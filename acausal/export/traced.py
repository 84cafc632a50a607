"""A traced function, read operation by operation; and as data: blocks of operations, with all calls written out."""

from __future__ import annotations

import math
import string
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import jax
import jax.numpy as jnp
import numpy as np
from jax.extend.core import ClosedJaxpr, Literal

from acausal._jax import BARRIER, CALLS, WRITTEN_OUT, Equation, bind, called, name_of, shapes

FOLDED = 100_000
"""Most elements of a constant that is computed when a function is exported."""

SAME = frozenset({"stop_gradient", "copy", "copy_p", "reduce_precision", BARRIER})
"""Operations whose results are their arguments."""

LOOPS = frozenset({"while", "scan", "cond"})

Apply: TypeAlias = Callable[[Equation, list[Any], str], Sequence[Any]]
"""The results of an operation, from its arguments and the equation of the model from which it came (or "")."""


def walk(
    closed: ClosedJaxpr,
    values: Sequence[Any],
    apply: Apply,
    *,
    kept: Container[str] = LOOPS,
    origin: str = "",
) -> list[Any]:
    """The results of a jaxpr; calls are written out, `SAME` left out, and what is known already is computed now.

    Arguments:
        values: its arguments: arrays that are known, or anything else that `apply` knows and gives.
        kept: names of operations that are never computed now.
    """
    jaxpr = closed.jaxpr
    found: dict[Any, Any] = dict(zip(jaxpr.invars, values, strict=True))
    found |= {v: np.asarray(c) for v, c in zip(jaxpr.constvars, closed.consts, strict=True)}

    def value(atom: Any) -> Any:
        if not isinstance(atom, Literal):
            return found[atom]
        aval: Any = atom.aval
        return np.asarray(atom.val, aval.dtype)

    for equation in jaxpr.eqns:
        name, arguments = name_of(equation), [value(atom) for atom in equation.invars]
        where = str(equation.source_info.name_stack) or origin
        if name in CALLS | WRITTEN_OUT:
            results = walk(called(equation), arguments, apply, kept=kept, origin=where)
        elif name in SAME:
            results = arguments
        elif name not in kept and _is_known(equation, arguments):
            with jax.ensure_compile_time_eval():
                results = [np.asarray(r) for r in bind(equation, [*map(jnp.asarray, arguments)])]
        else:
            results = apply(equation, arguments, where)
        found.update(zip(equation.outvars, results, strict=True))
    return [value(atom) for atom in jaxpr.outvars]


def _is_known(equation: Equation, arguments: Sequence[Any]) -> bool:
    """Whether the results, of few elements, follow from arrays that are known."""
    sizes = shapes(equation.outvars)
    fixed = all(isinstance(n, int | np.integer) for shape in sizes for n in shape)
    few = fixed and max((math.prod(map(int, shape)) for shape in sizes), default=0) <= FOLDED
    return few and all(isinstance(a, np.ndarray) for a in arguments)


def places(equation: Equation, arguments: Sequence[Any], moved: Iterable[int]) -> list[np.ndarray]:
    """Which elements an operation gives that only moves them: it is applied to their numbers.

    Arguments:
        arguments: arrays; of those that are moved, only shapes count.
        moved: which arguments those are; their elements are numbered one argument after the other.
    """
    numbers, count = list(arguments), 0
    for k in moved:
        shape = arguments[k].shape
        numbers[k] = jnp.arange(count, count + math.prod(shape)).reshape(shape)
        count += math.prod(shape)
    with jax.ensure_compile_time_eval():
        return [np.asarray(found) for found in bind(equation, [*map(jnp.asarray, numbers)])]


def subscripts(numbers: Any, ranks: Iterable[int]) -> str:
    """What `jax.lax.dot_general` adds up, as `numpy.einsum` has it, from its "dimension_numbers"."""
    (left, right), (batch_left, batch_right) = numbers
    letters = iter(string.ascii_letters)
    one, two = ([next(letters) for _ in range(rank)] for rank in ranks)
    for i, j in zip((*left, *batch_left), (*right, *batch_right), strict=True):
        two[j] = one[i]
    result = [one[i] for i in batch_left]
    result += [c for i, c in enumerate(one) if i not in (*left, *batch_left)]
    result += [c for j, c in enumerate(two) if j not in (*right, *batch_right)]
    return f"{''.join(one)},{''.join(two)}->{''.join(result)}"


@dataclass(frozen=True, eq=False)
class TracedValue:
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
class TracedConstant:
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


Atom: TypeAlias = TracedValue | TracedConstant


@dataclass(frozen=True, eq=False)
class TracedOperation:
    """One operation.

    Attributes:
        name: JAX's name of it. inputs: what it reads. outputs: what it gives.
        params: JAX's parameters of it. origin: the equation of the model from which it came, or "".
    """

    name: str
    inputs: tuple[Atom, ...]
    outputs: tuple[TracedValue, ...]
    params: Mapping[str, Any]
    origin: str = ""


@dataclass(frozen=True, eq=False)
class TracedBlock:
    """Operations, one after the other.

    Attributes:
        inputs: arguments. operations: in an order in which they can be done. outputs: results.
    """

    inputs: tuple[TracedValue, ...]
    operations: tuple[TracedOperation, ...]
    outputs: tuple[Atom, ...]

    def part(self, outputs: Iterable[Atom]) -> TracedBlock:
        """The same with these results, and without operations that reach none of them."""
        results = tuple(outputs)
        wanted, kept = set(results), list[TracedOperation]()
        for operation in reversed(self.operations):
            if not wanted.isdisjoint(operation.outputs):
                kept.append(operation)
                wanted.update(operation.inputs)
        return TracedBlock(self.inputs, tuple(reversed(kept)), results)


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


def trace(function: Callable[..., Any], *arguments: Any) -> TracedBlock:
    """The operations of a function of arrays; what does not reach a result is left out."""
    return traced_block(jax.make_jaxpr(function)(*arguments))


def traced_block(closed: ClosedJaxpr) -> TracedBlock:
    """The operations of a closed jaxpr."""
    operations: list[TracedOperation] = []
    constants: dict[int, TracedConstant] = {}

    def atom(value: Any) -> Atom:
        known = isinstance(value, np.ndarray)
        return constants.setdefault(id(value), TracedConstant(value)) if known else value

    def apply(equation: Equation, arguments: list[Any], origin: str) -> Sequence[Any]:
        name = name_of(equation)
        inputs, outputs = tuple(map(atom, arguments)), tuple(map(_value, equation.outvars))
        operations.append(TracedOperation(name, inputs, outputs, equation.params, origin))
        return outputs

    inputs = tuple(map(_value, closed.jaxpr.invars))
    results = walk(closed, inputs, apply)
    return TracedBlock(inputs, tuple(operations), ()).part(map(atom, results))


def _value(variable: Any) -> TracedValue:
    return TracedValue(tuple(variable.aval.shape), kind_of(variable.aval.dtype))
