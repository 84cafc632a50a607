"""A traced function as a model of ONNX."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from jax.extend.core import ClosedJaxpr
from onnx import ModelProto, NodeProto, checker, helper, numpy_helper

from acausal._jax import Equation, name_of
from acausal.export.onnx_text import arithmetic, arrays, control
from acausal.export.onnx_text.builder import OnnxGraph, Rule, Site, Tensor, Value, results
from acausal.export.traced import walk

OPSET, IR = 18, 9
"""Versions of the operators and of the format: of 2023, so that older run times read the files."""


def model_of(
    closed: ClosedJaxpr,
    names: tuple[Sequence[str], Sequence[str]],
    defaults: Mapping[str, np.ndarray],
    real: np.dtype[Any],
    title: str,
    notes: Mapping[str, str],
) -> ModelProto:
    """The model of a traced function.

    Arguments:
        closed: its jaxpr; the leading size of arguments may be symbolic.
        names: of its arguments and of its results. defaults: values of arguments that need not be given.
        real: the type of floating-point numbers. title, notes: for readers.

    Raises:
        DataError: for an operation that has no counterpart in ONNX.
    """
    graph, (arguments, targets) = OnnxGraph(real), names
    avals: list[Any] = [v.aval for v in closed.jaxpr.invars]
    values: list[Value] = []
    for name, aval in zip(arguments, avals, strict=True):
        values.append(Tensor(name, aval.shape, np.dtype(aval.dtype)))
        if aval.shape and not isinstance(aval.shape[0], int | np.integer):
            graph.batch = name
    found = lower(graph, closed, values)
    for name, value in zip(targets, found, strict=True):
        graph.nodes.append(helper.make_node("Identity", [graph.read(value)], [name]))
    outputs = [
        helper.make_tensor_value_info(n, graph.kind(a.dtype), _sizes(a.shape))
        for n, a in zip(targets, closed.out_avals, strict=True)
    ]
    inputs = [
        helper.make_tensor_value_info(n, graph.kind(a.dtype), _sizes(a.shape))
        for n, a in zip(arguments, avals, strict=True)
    ]
    nodes = _needed(graph.nodes, set(targets))
    used = {name for node in nodes for name in _reads(node)}
    constants = [c for c in graph.constants if c.name in used]
    constants += [
        numpy_helper.from_array(np.asarray(v, real, order="C"), n) for n, v in defaults.items()
    ]
    message = helper.make_graph(nodes, title, inputs, outputs, constants)
    opsets = [helper.make_opsetid("", OPSET)]
    model = helper.make_model(message, opset_imports=opsets, ir_version=IR, producer_name="acausal")
    helper.set_model_props(model, dict(notes))
    checker.check_model(model, full_check=True)
    return model


def _sizes(shape: Sequence[Any]) -> list[int | str]:
    return [int(n) if isinstance(n, int | np.integer) else str(n) for n in shape]


def _needed(nodes: Sequence[NodeProto], wanted: set[str]) -> list[NodeProto]:
    """The nodes that some results depend on."""
    kept: list[NodeProto] = []
    for node in reversed(nodes):
        if wanted.intersection(node.output):
            kept.append(node)
            wanted.update(_reads(node))
    return kept[::-1]


def _reads(node: NodeProto) -> set[str]:
    """The names that a node reads, also inside of its loops."""
    names = set(node.input)
    for attribute in node.attribute:
        if attribute.HasField("g"):
            names |= {name for inner in attribute.g.node for name in _reads(inner)}
            names |= {output.name for output in attribute.g.output}
    return names


TABLE: dict[str, Rule] = {**arithmetic.RULES, **arrays.RULES, **control.RULES}
"""By operation of JAX, how its nodes are made."""


def lower(graph: OnnxGraph, closed: ClosedJaxpr, values: Sequence[Value]) -> list[Value]:
    """The results of a jaxpr of some values, whose nodes are added; what is known already is computed now.

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
