"""What a model consists of, as rows of a table: values, units, descriptions, starts, and where each comes from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp

from acausal.codegen import Packed, ParameterLayout, pack
from acausal.flattening import Binding, FlatModel, is_hidden
from acausal.initialization.initialize import Initializer
from acausal.modeling import Declaration, full_name

Row = dict[str, Any]


def overview(
    initial: Initializer, params: Mapping[str, Any] | Packed, outputs: Sequence[str]
) -> dict[str, Row]:
    """Rows by dotted name, with the columns kind, value, unit, doc, start and origin; ``outputs`` are signals."""
    conditions = initial.conditions
    layout, model = conditions.parameters, initial.reduced.model
    packed = pack(layout, params)
    return {
        **dict(_parameters(model, layout, packed)),
        **dict(_modules(model, layout, packed)),
        **dict(_states(initial, packed)),
        **dict(_discrete(initial, packed)),
        **{
            n: _signal(model, "input", n) for n in map(model.layout.variable, model.inputs.tolist())
        },
        **{n: _signal(model, "output", n) for n in outputs},
    }


def _row(
    kind: str, declared: Declaration, *, value: Any = None, start: Any = None, origin: str = ""
) -> Row:
    cells = {"kind": kind, "value": value, "unit": declared.unit, "doc": declared.doc}
    return {**cells, "start": start, "origin": origin}


def _parameters(
    model: FlatModel, layout: ParameterLayout, packed: Packed
) -> Iterator[tuple[str, Row]]:
    values = np.asarray(packed.values)
    bound = {b.target: b for b in model.bindings}
    for number, path in enumerate(model.layout.paths):
        given = model.layout.components[number]._node.modifiers
        first = int(model.layout.parameter_base[number])
        for index, (local, declared) in enumerate(model.layout.form(number).parameters, first):
            position = int(layout.position[index])
            value = float(values[position]) if position >= 0 else 0.0
            origin = "given" if declared.name in given else "default"
            if index in bound:
                origin = f"= {_expression(model, bound[index])}"
            elif model.folded[index]:
                origin = "default, folded"
            yield full_name(path, local), _row("parameter", declared, value=value, origin=origin)


def _expression(model: FlatModel, binding: Binding) -> str:
    """What a parameter is bound to, in the names of the model."""
    names = map(model.layout.parameter, binding.arguments)
    renamed = {s: sp.Symbol(n) for s, n in zip(binding.symbols, names, strict=True)}
    return str(binding.expression.xreplace(renamed))


def _modules(
    model: FlatModel, layout: ParameterLayout, packed: Packed
) -> Iterator[tuple[str, Row]]:
    for number, path in enumerate(model.layout.paths):
        component, first = model.layout.components[number], int(model.layout.module_base[number])
        for index, (local, declared) in enumerate(model.layout.form(number).modules, first):
            target = int(layout.module_of[index])
            origin = "given" if declared.name in component._node.modifiers else "default"
            if target != index:
                origin = f"= {model.layout.module(target)}"
            value = type(packed.modules[target]).__name__
            yield full_name(path, local), _row("network", declared, value=value, origin=origin)


def _states(initial: Initializer, packed: Packed) -> Iterator[tuple[str, Row]]:
    conditions = initial.conditions
    starts = np.asarray(conditions.starts(packed)).tolist()
    for name, (variable, _), fixed, start in zip(
        initial.names, conditions.start_of, conditions.fixed.tolist(), starts, strict=True
    ):
        row = _variable(initial.reduced.model, "state", name, variable)
        yield name, {**row, "start": start, "origin": "fixed" if fixed else "guess"}


def _discrete(initial: Initializer, packed: Packed) -> Iterator[tuple[str, Row]]:
    reduced = initial.reduced
    if not len(reduced.discrete):
        return
    starts = np.asarray(initial.conditions.discrete_start(packed)).tolist()
    for node, start in zip(reduced.discrete.tolist(), starts, strict=True):
        name = reduced.name(node)
        if not is_hidden(name):
            index = reduced.model.layout.find_variable(name)
            yield name, {**_variable(reduced.model, "discrete", name, index), "start": start}


def _signal(model: FlatModel, kind: str, name: str) -> Row:
    return _variable(model, kind, name, model.layout.find_variable(name))


def _variable(model: FlatModel, kind: str, name: str, index: int | None) -> Row:
    if index is None or index >= model.n_variables:  # a derivative
        return _row(kind, Declaration(doc=f"derivative of {name.removeprefix('der(')[:-1]}"))
    return _row(kind, model.layout.variable_declaration(index))
