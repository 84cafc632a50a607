"""The table of operations, and the walk through a jaxpr by it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from jax.extend.core import ClosedJaxpr, Literal

from acausal._jax import name_of
from acausal.export.graph import arithmetic, arrays, control, products
from acausal.export.graph.builder import Graph, Rule, Site, Value, results

TABLE: dict[str, Rule] = {**arithmetic.RULES, **arrays.RULES, **products.RULES, **control.RULES}
"""By operation of JAX, how its nodes are made."""


def lower(graph: Graph, closed: ClosedJaxpr, values: Sequence[Value]) -> list[Value]:
    """Add the nodes of a jaxpr; what is known already is computed now.

    Arguments:
        values: its arguments.

    Returns:
        Its results.

    Raises:
        DataError: for an operation that has no counterpart in ONNX.
    """
    jaxpr = closed.jaxpr
    found: dict[Any, Value] = dict(zip(jaxpr.invars, values, strict=True))
    found |= {v: np.asarray(c) for v, c in zip(jaxpr.constvars, closed.consts, strict=True)}

    def value(atom: Any) -> Value:
        if not isinstance(atom, Literal):
            return found[atom]
        aval: Any = atom.aval
        return np.asarray(atom.val, aval.dtype)

    for equation in jaxpr.eqns:
        site = Site(graph, equation, tuple(map(value, equation.invars)), lower)
        rule = TABLE.get(name_of(equation))
        if rule is None:
            raise site.refuse()
        computed = None if name_of(equation) in control.RULES else arrays.fold(site)
        made = results(graph, equation, rule(site)) if computed is None else computed
        found.update(zip(equation.outvars, made, strict=True))
    return [value(atom) for atom in jaxpr.outvars]
