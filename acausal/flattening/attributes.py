"""Attributes of a laid out model: starts of variables, values of parameters, modules."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError
from acausal.flattening.layout import Form, Layout, members_of_forms
from acausal.flattening.template import Binding, Integers
from acausal.modeling import (
    STATE_SELECT,
    Component,
    Declaration,
    ModuleReference,
    Parameter,
    Reference,
    Start,
    Variable,
    element_names,
    references,
)

ALONE = sp.Symbol("p0", real=True)
"""The parameter in the expression that is nothing but a parameter."""


def tiled(layout: Layout, base: Integers, local: Iterable[Sequence[Any]], dtype: Any) -> np.ndarray:
    """Spread per-form local values over all instances."""
    flat = np.empty(int(base[-1]), dtype=dtype)
    for members, values in zip(members_of_forms(layout), local, strict=True):
        if len(values):
            flat[base[members][:, None] + np.arange(len(values))] = np.asarray(values, dtype=dtype)
    return flat


def variable_attributes(layout: Layout) -> tuple[Any, ...]:
    """Start, fixed, nominal and state attributes of all variables, and starts that are expressions."""
    base = layout.variable_base

    def declared(attribute: str, dtype: Any) -> np.ndarray:
        local = [
            [_attribute(form.prototype, d, attribute) for _, d in form.variables]
            for form in layout.forms
        ]
        return tiled(
            layout,
            base,
            [[0.0 if isinstance(v, sp.Expr | tuple) else v for v in row] for row in local],
            dtype,
        )

    start, fixed, nominal = (
        declared("start", float),
        declared("fixed", bool),
        declared("nominal", float),
    )
    rank = [[_rank(form.prototype, d) for _, d in form.variables] for form in layout.forms]
    state = tiled(layout, base, rank, float)
    given = np.zeros(len(start), dtype=bool)
    starts: list[Binding] = []
    start_of_form: dict[Any, tuple[int, Binding]] = {}
    named = [
        [(i, path, d) for i, (path, d) in enumerate(f.variables) if isinstance(d.start, str)]
        for f in layout.forms
    ]
    for number, component in enumerate(layout.components):
        for index, path, d in named[layout.form_of[number]]:
            if component._node.modifiers.get(d.name, Start()).value is not None:
                continue
            variable = int(base[number]) + index
            given[variable] = d.start in component._node.modifiers
            form = layout.form_of[number], index
            if form not in start_of_form:
                value = _start_element(getattr(component, d.start), path, d.name)
                start_of_form[form] = number, _binding(layout, variable, value, layout.variable)
            starts.append(_moved(layout, *start_of_form[form], number, variable))
        if not component._node.modifiers:
            continue
        form = layout.form(number)
        for name, modifier in component._node.modifiers.items():
            if not isinstance(modifier, Start):
                continue
            for index in _indices(form, name):
                variable = int(base[number]) + index
                if modifier.fixed is not None:
                    fixed[variable] = modifier.fixed
                if modifier.nominal is not None:
                    nominal[variable] = modifier.nominal
                if modifier.state is not None:
                    state[variable] = STATE_SELECT.index(modifier.state) + 0.5
                if modifier.value is not None:
                    given[variable] = True
                    value = _start_element(modifier.value, form.variables[index][0], name)
                    if _is_bound(value):
                        starts.append(_binding(layout, variable, value, layout.variable))
                    else:
                        start[variable] = float(value)
    return start, fixed, nominal, state, given, tuple(starts)


def _attribute(component: Component, variable: Variable, attribute: str) -> Any:
    """A declared attribute of a variable; it may be the name of another attribute of the component."""
    value = getattr(variable, attribute)
    if isinstance(value, str) and value not in STATE_SELECT:
        return getattr(component, value)
    return value


def _rank(prototype: Component, variable: Variable) -> float:
    """How much a variable is wanted as a state; half a rank more where its option was set by hand."""
    by_hand = variable.state in prototype._node.options
    return STATE_SELECT.index(_attribute(prototype, variable, "state")) + 0.5 * by_hand


def _indices(form: Form, name: str) -> Iterator[int]:
    """Local indices of a variable, all elements of a vector among them."""
    if name in form.variable_index:
        yield form.variable_index[name]
    else:
        yield from (i for path, i in form.variable_index.items() if path.startswith(f"{name}["))


def _start_element(value: Any, path: str, name: str) -> Any:
    if path == name or not isinstance(value, list | tuple | np.ndarray):
        return value
    element: Any = value
    try:
        for i in path[len(name) + 1 : -1].split(","):
            element = element[int(i) - 1]
    except (IndexError, TypeError):
        raise DeclarationError(f"the start of '{name}' has no element for {path}") from None
    return element


def parameter_values(layout: Layout) -> tuple[np.ndarray, tuple[Binding, ...], np.ndarray]:
    """Values of all parameters, the bound ones, and which are folded to zero."""
    base = layout.parameter_base
    local = [[_default(form, path, d) for path, d in form.parameters] for form in layout.forms]
    value = tiled(layout, base, local, float)
    folded = value == 0.0
    bindings: list[Binding] = []
    for number, component in enumerate(layout.components):
        form = layout.form(number)
        for name, given in component._node.modifiers.items():
            if isinstance(given, Start) or name in form.module_index:
                continue
            declared = cast(Declaration, component._node.declaration(name))
            shape = component._node.shape(name, declared)
            values = np.asarray(given, dtype=object)
            if values.shape not in ((), shape):
                raise DeclarationError(
                    f"{component._node.label}.{name} needs {_sizes(shape)} values, got {_sizes(values.shape)}"
                )
            elements = np.broadcast_to(values, shape or ()).flat
            for path, element in zip(element_names(name, shape), elements, strict=True):
                if path not in form.parameter_index:
                    continue  # the options left no use for it
                index = int(base[number]) + form.parameter_index[path]
                folded[index] = False
                if _is_bound(element):
                    value[index] = np.nan
                    bindings.append(_binding(layout, index, element, layout.parameter))
                else:
                    value[index] = float(element)
    bindings += _default_bindings(layout, value, {b.target for b in bindings})
    _fold_through(bindings, value, folded)
    bound = {b.target for b in bindings}
    missing = [int(i) for i in np.flatnonzero(np.isnan(value)) if int(i) not in bound]
    if missing:
        names = [layout.parameter(i) for i in missing[:12]]
        local_name = names[0].rpartition(".")[2]
        raise DeclarationError(
            f"parameter without a value: {', '.join(repr(n) for n in names)}; "
            f"give it where the component is made ({local_name}=...)"
        )
    return value, tuple(bindings), folded


def _fold_through(bindings: list[Binding], value: np.ndarray, folded: np.ndarray) -> None:
    """Fold what folded parameters make zero to zero as well."""
    left = bindings
    while zero := [b.target for b in left if folded[list(b.arguments)].all() and _is_zero(b)]:
        value[zero], folded[zero] = 0.0, True
        left = [b for b in left if not folded[b.target]]


def _is_zero(binding: Binding) -> bool:
    """Whether the expression is zero where all its arguments are."""
    zeros = dict.fromkeys(binding.symbols, sp.S.Zero)
    return bool(zeros) and binding.expression.xreplace(zeros) == 0


def _sizes(shape: tuple[int, ...] | None) -> str:
    return " by ".join(str(n) for n in shape or (1,))


def _default(form: Form, path: str, declaration: Parameter) -> float:
    default = declaration.default
    if default is None or callable(default) or isinstance(default, str):
        return np.nan
    if declaration.shape is not None and declaration.name in form.prototype._node.modifiers:
        return np.nan  # all instances of the form have such an array of their own
    if declaration.shape is not None:
        index = tuple(int(i) - 1 for i in path[path.rindex("[") + 1 : -1].split(","))
        default = np.broadcast_to(
            np.asarray(default, dtype=float),
            form.prototype._node.shape(declaration.name, declaration) or (),
        )[index]
    return float(default)


def _default_bindings(layout: Layout, value: np.ndarray, bound: set[int]) -> list[Binding]:
    """Defaults that are functions of the component: ``Parameter(lambda self: 2 * self.m)``.

    A component's form decides what the function says; it is asked once.
    """
    bindings: list[Binding] = []
    for form, members in zip(layout.forms, members_of_forms(layout), strict=True):
        for i, (_, declaration) in enumerate(form.parameters):
            if not callable(declaration.default):
                continue
            indices = layout.parameter_base[members] + i
            left = [
                (m, k)
                for m, k in zip(members.tolist(), indices.tolist(), strict=True)
                if np.isnan(value[k]) and k not in bound
            ]
            if not left:
                continue
            first, index = left[0]
            default: Any = declaration.default(layout.components[first])
            if _is_bound(default):
                binding = _binding(layout, index, default, layout.parameter)
                bindings += [_moved(layout, first, binding, m, k) for m, k in left]
            else:
                value[[k for _, k in left]] = float(default)
    return bindings


def _is_bound(value: Any) -> bool:
    """Whether a value depends on parameters."""
    return isinstance(value, Reference) or (isinstance(value, sp.Expr) and not value.is_number)


def _moved(layout: Layout, owner: int, binding: Binding, member: int, target: int) -> Binding:
    """What a component binds to its own parameters, for another component of the same form."""
    by = int(layout.parameter_base[member] - layout.parameter_base[owner])
    arguments = tuple(a + by for a in binding.arguments)
    return Binding(target, binding.expression, binding.symbols, arguments)


def _binding(
    layout: Layout, target: int, expression: sp.Expr, name: Callable[[int], str]
) -> Binding:
    """A value given by parameters; ``name`` tells the target's name for a message."""
    symbols: list[sp.Symbol] = []
    arguments: list[int] = []
    names: dict[sp.Symbol, sp.Symbol] = {}
    alone = isinstance(expression, Reference)
    for reference in (expression,) if alone else references(expression):
        number = layout.position.get(id(reference.owner))
        if number is None:
            raise DeclarationError(
                f"'{name(target)}' refers to '{reference.path}' of {reference.owner.label}, which is not "
                "part of the model; assign that component to an attribute, or give a number"
            )
        names[reference] = ALONE if alone else sp.Symbol(f"p{len(symbols)}", real=True)
        symbols.append(names[reference])
        index = layout.form(number).parameter_index[reference.path]
        arguments.append(int(layout.parameter_base[number]) + index)
    named: Any = ALONE if alone else expression.xreplace(names)
    return Binding(target, named, tuple(symbols), tuple(arguments))


def module_values(layout: Layout) -> tuple[Any, ...]:
    """Value or factory of every module; an int refers to another module."""
    values: list[Any] = []
    for number, component in enumerate(layout.components):
        for name, declaration in layout.form(number).modules:
            value = component._node.modifiers.get(name, declaration.default)
            if value is None:
                raise DeclarationError(
                    f"{component._node.label} has no module '{name}'; give {name}=..."
                )
            if isinstance(value, str):
                value = getattr(component, value)
            if isinstance(value, ModuleReference):  # a module of an enclosing component
                owner = layout.position[id(value.symbol.owner)]
                value = (
                    int(layout.module_base[owner])
                    + layout.form(owner).module_index[value.symbol.path]
                )
            values.append(value)
    return tuple(values)
