"""The table of operations, and the walk through a jaxpr by it."""

from __future__ import annotations

from collections.abc import Sequence

from jax.extend.core import ClosedJaxpr

from acausal._jax import Equation, name_of
from acausal.export.onnx_text import arithmetic, arrays, control
from acausal.export.onnx_text.builder import OnnxGraph, Rule, Site, Value, results
from acausal.export.traced import walk

TABLE: dict[str, Rule] = {**arithmetic.RULES, **arrays.RULES, **control.RULES}
"""By operation of JAX, how its nodes are made."""


def lower(graph: OnnxGraph, closed: ClosedJaxpr, values: Sequence[Value]) -> list[Value]:
    """Add the nodes of a jaxpr; what is known already is computed now.

    Arguments:
        values: its arguments.

    Returns:
        Its results.

    Raises:
        DataError: for an operation that has no counterpart in ONNX.
    """

    def apply(equation: Equation, arguments: list[Value], _: str) -> list[Value]:
        site = Site(graph, equation, tuple(arguments), lower)
        rule = TABLE.get(name_of(equation))
        if rule is None:
            raise site.refuse()
        return results(equation, rule(site))

    return walk(closed, values, apply, kept=control.RULES)
