"""Rules of operations that repeat or choose other functions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from onnx import helper

from acausal._jax import scan_of
from acausal.errors import DataError
from acausal.export.onnx_text.builder import OnnxGraph, Rule, Site, Tensor, Value


def _linear_solve(site: Site) -> list[Value]:
    """The solution by the solver that the operation brings along."""
    jaxprs, lengths = site.params["jaxprs"], site.params["const_lengths"]
    counts = [lengths.matvec, lengths.vecmat, lengths.solve]
    start = sum(counts[:2])
    own = site.values[start : start + counts[2]]
    right = site.values[sum(lengths) :]
    return site.lower(site.graph, jaxprs.solve, [*own, *right])


def _while(site: Site) -> list[str]:
    """``Loop`` without a limit, until its condition is false."""
    p, g = site.params, site.graph
    n, m = int(p["cond_nconsts"]), int(p["body_nconsts"])
    tests, fixed, start = site.values[:n], site.values[n : n + m], site.values[n + m :]
    (first,) = site.lower(g, p["cond_jaxpr"], [*tests, *start])
    body = g.inner()
    carried = _carried(body, start)
    after = site.lower(body, p["body_jaxpr"], [*fixed, *carried])
    (again,) = site.lower(body, p["cond_jaxpr"], [*tests, *after])
    graph = _body(body, carried, [again, *after])
    return g.add_several(
        "Loop", "", g.read(first), *map(g.read, start), outputs=len(start), body=graph
    )


def _scan(site: Site) -> list[str]:
    """``Loop`` over the rows of arrays, which are gathered one by one."""
    g, scan = site.graph, scan_of(site.equation.params)
    n, end = scan.n_constants, scan.n_constants + scan.n_carry
    fixed, start, rows = site.values[:n], site.values[n:end], site.values[end:]
    length = int(site.params["length"])
    body = g.inner()
    carried = _carried(body, start)
    row = "i" + body.fresh()
    place = row
    if scan.options["reverse"]:
        place = body.add("Sub", body.constant(length - 1, np.int64), row)
    cut = [Tensor(body.add("Gather", g.read(r), place, axis=0), r.shape[1:], r.dtype) for r in rows]
    after = site.lower(body, scan.body, [*fixed, *carried, *cut])
    graph = _body(body, carried, [np.asarray(True), *after], row)
    found = g.add_several(
        "Loop",
        g.constant(length, np.int64),
        g.constant(True, bool),
        *map(g.read, start),
        outputs=len(after),
        body=graph,
    )
    if scan.options["reverse"]:
        vectors = [g.integers(v) for v in (-1, np.iinfo(np.int64).min, 0, -1)]
        found[scan.n_carry :] = [g.add("Slice", y, *vectors) for y in found[scan.n_carry :]]
    return found


def _cond(site: Site) -> list[str]:
    """``If``, nested for more than two branches."""
    which, *values = site.values
    g, index = site.graph, site.graph.cast(site.graph.read(which), np.int64)
    return _choose(site, g, index, site.params["branches"], values, 0)


def _choose(
    site: Site, g: OnnxGraph, index: str, branches: Sequence[Any], values: Sequence[Value], at: int
) -> list[str]:
    here, others = g.inner(), g.inner()
    first = site.lower(here, branches[at], values)
    rest: Sequence[str | Value]
    if at + 2 == len(branches):
        rest = site.lower(others, branches[at + 1], values)
    else:
        rest = _choose(site, others, index, branches, values, at + 1)
    names = [others.read(r) if not isinstance(r, str) else r for r in rest]
    avals: list[Any] = [var.aval for var in site.equation.outvars]
    return g.add_several(
        "If",
        g.add("LessOrEqual", index, g.constant(at, np.int64)),
        outputs=len(first),
        then_branch=_branch(here, [here.read(v) for v in first], avals),
        else_branch=_branch(others, names, avals),
    )


def _branch(graph: OnnxGraph, names: Sequence[str], avals: Sequence[Any]) -> Any:
    own = [graph.add("Identity", name) for name in names]
    infos = [
        helper.make_tensor_value_info(name, graph.kind(a.dtype), None)
        for name, a in zip(own, avals, strict=True)
    ]
    return helper.make_graph(graph.nodes, "branch", [], infos)


def _carried(body: OnnxGraph, start: Sequence[Value]) -> list[Tensor]:
    return [Tensor(body.fresh(), v.shape, v.dtype) for v in start]


def _body(
    body: OnnxGraph, carried: Sequence[Tensor], results: Sequence[Value], row: str | None = None
) -> Any:
    """The graph of a loop's body: (row, whether it goes on, what is carried) -> (the same, rows of results)."""
    info = helper.make_tensor_value_info
    inputs = [
        info(row or body.fresh(), body.kind(np.int64), []),
        info(body.fresh(), body.kind(bool), []),
    ]
    inputs += [info(t.name, body.kind(t.dtype), None) for t in carried]
    names = [body.add("Identity", body.read(r)) for r in results]
    outputs = [info(n, body.kind(r.dtype), None) for n, r in zip(names, results, strict=True)]
    return helper.make_graph(body.nodes, "body", inputs, outputs)


def _callback(site: Site) -> list[str]:
    raise DataError(
        "export.onnx: the network calls Python (a host callback), which no file can; write it in jax.numpy"
    )


RULES: dict[str, Rule] = {
    **dict.fromkeys(("pure_callback", "io_callback", "debug_callback"), _callback),
    "cond": _cond,
    "custom_linear_solve": _linear_solve,
    "scan": _scan,
    "while": _while,
}
"""By operation, how its nodes are made."""
