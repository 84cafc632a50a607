"""A network as a block of Modelica: weights as matrices, layer by layer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.extend.core import ClosedJaxpr, Literal

from acausal._jax import CALLS, Equation, called, name_of
from acausal.errors import DataError, shown
from acausal.export.modelica_text.elementwise import refuse
from acausal.export.modelica_text.lines import BlockTerm, Body, bare, known, named, sizes
from acausal.export.modelica_text.operations import RULES
from acausal.export.modelica_text.spelling import array, class_name, comment
from acausal.export.traced import walk

Value = BlockTerm | np.ndarray


def block_class(name: str, network: Callable[..., Any], orders: Sequence[int]) -> str:
    """The text of a block with inputs ``x1``, ``x2``, ... (``x`` if there is one) and the output ``y``.

    Arguments:
        name: of the block. network: called with scalars. orders: how often it is differentiated by each input.

    Raises:
        DataError: for a network that cannot be called so, or whose operations have no counterpart in Modelica.
    """
    arrays, static = eqx.partition(network, eqx.is_inexact_array)
    found, tree = jax.tree_util.tree_flatten_with_path(arrays)
    weights = {_weight(path): np.asarray(leaf, float) for path, leaf in found}
    if len(weights) < len(found):  # names that differ in punctuation only
        weights = {f"w{i}": np.asarray(leaf, float) for i, (_, leaf) in enumerate(found, start=1)}
    inputs = ["x"] if len(orders) == 1 else [f"x{i}" for i in range(1, len(orders) + 1)]

    def call(*values: Any) -> Any:
        own, rest = values[: len(inputs)], values[len(inputs) :]
        module = eqx.combine(jax.tree_util.tree_unflatten(tree, rest), static)
        function: Any = lambda *a: jnp.reshape(module(*a), ())  # noqa: E731
        for position, times in enumerate(orders):
            for _ in range(times):
                function = jax.grad(function, argnums=position)
        return function(*own)

    shapes = [jax.ShapeDtypeStruct((), float)] * len(inputs)
    shapes += [jax.ShapeDtypeStruct(w.shape, float) for w in weights.values()]
    try:
        closed = jax.make_jaxpr(call)(*shapes)
    except Exception as error:  # an exception of the user's own code
        reason = str(error).splitlines()[0]
        raise DataError(
            f"{shown(network, 40)} cannot be traced with {len(inputs)} inputs ({reason}); "
            "write it in jax.numpy"
        ) from None
    block = Body()
    values: list[Value] = [named(block, n, ()) for n in inputs]
    values += [named(block, n, w.shape) for n, w in weights.items()]
    (result,) = write(block, closed, values)
    result = known(block, result) if isinstance(result, np.ndarray) else result
    block.equations.append(f"y = {bare(result.at(()))};")
    primes = ", differentiated" if any(orders) else ""
    parameters = [f"parameter Real {n}{sizes(w.shape)} = {_rows(w)};" for n, w in weights.items()]
    lines = [f"block {name}{comment(description(network) + primes)}"]
    lines += [f"  input Real {n};" for n in inputs] + ["  output Real y;"]
    lines += [f"  {line}" for line in parameters]
    if block.declarations:
        lines += ["protected", *(f"  {line}" for line in block.declarations)]
    lines += ["equation", *(f"  {line}" for line in block.equations), f"end {name};"]
    return "\n".join(lines)


def write(block: Body, closed: ClosedJaxpr, values: Sequence[Value]) -> list[Value]:
    """Write the operations of a jaxpr; what is known already is computed now.

    Raises:
        DataError: for an operation that has no counterpart in Modelica.
    """
    read_often = _read_often(closed)

    def apply(equation: Equation, arguments: list[Value], _: str) -> Sequence[BlockTerm]:
        rule = RULES.get(name_of(equation))
        if rule is None:
            raise refuse(equation)
        terms = [known(block, a) if isinstance(a, np.ndarray) else a for a in arguments]
        results = rule(block, equation, terms)
        for var, result in zip(equation.outvars, results, strict=True):
            if var in read_often and not (result.is_plain or result.truth):
                result.name()
        return results

    return walk(closed, values, apply, kept=())


def _read_often(closed: ClosedJaxpr) -> set[Any]:
    """The results of operations, also of those that are called, that others read more than once."""
    counts = Counter(v for e in closed.jaxpr.eqns for v in e.invars if not isinstance(v, Literal))
    found = {v for v, count in counts.items() if count > 1}
    return found.union(*(_read_often(called(e)) for e in closed.jaxpr.eqns if name_of(e) in CALLS))


def description(network: Any) -> str:
    """The parts that a network is made of, from the outside in."""
    parts: list[str] = []
    while True:
        inner = getattr(network, "net", None)
        if inner is None:
            return " of ".join([*parts, shown(network, 200)])
        parts.append(type(network).__name__)
        network = inner


def _rows(value: np.ndarray) -> str:
    """An array; the rows of a matrix on lines of their own."""
    return array(value).replace("}, {", "},\n    {")


def _weight(path: Sequence[Any]) -> str:
    """The name of an array of weights, counted from 1 as in Modelica."""
    words: list[str] = []
    for key in path:
        match key:
            case jax.tree_util.SequenceKey():
                words.append(str(key.idx + 1))
            case _:
                words.append(str(key).strip(".[]'"))
    return class_name("_".join(w for w in words if w != "net")) or "w"
