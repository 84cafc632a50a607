"""Values of parameters and modules: given ones, defaults, and those that follow from others."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError, shown
from acausal.flattening.bindings import Binding, bind, is_bound, shifted
from acausal.flattening.layout import Flags, Form, Layout, Numbers, members_of_forms, tiled
from acausal.modeling import (
    Component,
    Declaration,
    ModuleReference,
    Parameter,
    Start,
    element_names,
)


@dataclass(frozen=True)
class ParameterValues:
    """Values of all parameters.

    Attributes:
        value: (n_parameters,), nan where bound.
        bindings: the bound ones.
        folded: (n_parameters,) whether a parameter is left at a default of zero, or bound to such parameters only.
    """

    value: Numbers
    bindings: tuple[Binding, ...]
    folded: Flags


def parameter_values(layout: Layout) -> ParameterValues:
    """Values of all parameters, which of them are bound to others, and which are folded to zero.

    Raises:
        DeclarationError: for a parameter without a value, or a vector of the wrong size.
    """
    base = layout.parameter_base
    local = [[_default(form, path, d) for path, d in form.parameters] for form in layout.forms]
    value = tiled(layout, base, local, np.float64)
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
                if is_bound(element):
                    value[index] = np.nan
                    bindings.append(bind(layout, index, element, layout.parameter))
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
    return ParameterValues(value, tuple(bindings), folded)


def _fold_through(bindings: list[Binding], value: Numbers, folded: Flags) -> None:
    """Also fold parameters that are zero because folded ones are, whatever the others are."""
    known: dict[int, Any] = {int(i): sp.S.Zero for i in np.flatnonzero(folded)}
    """What follows from folded ones alone; not all of it is zero."""
    before = -1
    while before < (before := len(known)):
        for b in bindings:
            if b.target not in known and (rest := _rest(b, known)).is_finite and rest.is_Number:
                known[b.target] = rest
    zero = [b.target for b in bindings if known.get(b.target) == 0]
    value[zero], folded[zero] = 0.0, True


def _rest(binding: Binding, known: dict[int, Any]) -> Any:
    """The expression with what is known of its arguments."""
    pairs = zip(binding.symbols, binding.arguments, strict=True)
    given = {s: known[a] for s, a in pairs if a in known}
    try:
        return binding.expression.xreplace(given) if given else sp.S.NaN
    except TypeError:  # compares what is not finite
        return sp.S.NaN


def _sizes(shape: tuple[int, ...] | None) -> str:
    return " by ".join(str(n) for n in shape or (1,))


def _default(form: Form, path: str, declaration: Parameter) -> float:
    default = declaration.default
    if default is None or callable(default) or isinstance(default, str):
        return np.nan
    if declaration.shape is not None and declaration.name in form.prototype._node.modifiers:
        return np.nan  # all instances of the form have such an array of their own
    where = f"{form.prototype._node.label}.{declaration.name}"
    try:
        if declaration.shape is not None:
            index = tuple(int(i) - 1 for i in path[path.rindex("[") + 1 : -1].split(","))
            default = np.broadcast_to(
                np.asarray(default, dtype=float),
                form.prototype._node.shape(declaration.name, declaration) or (),
            )[index]
        number = float(default)
        low, high = float(_or(declaration.min, -np.inf)), float(_or(declaration.max, np.inf))
    except (TypeError, ValueError, OverflowError):
        given = f"its default {shown(default)}, min={declaration.min!r:.40}, max={declaration.max!r:.40}"
        raise DeclarationError(f"{where}: {given}: numbers are needed") from None
    if not (np.isfinite(number) and low <= number <= high):
        raise DeclarationError(
            f"{where}: its default {number:g} is not within {low:g} and {high:g}"
        )
    return number


def _or(value: float | None, otherwise: float) -> float:
    return otherwise if value is None else value


def _default_bindings(layout: Layout, value: Numbers, bound: set[int]) -> list[Binding]:
    """Defaults that are functions of the component: ``Parameter(lambda self: 2 * self.m)``.

    Such a function is called once per form: instances of one form have the same result.
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
            default = _computed_default(layout.components[first], declaration)
            if is_bound(default):
                binding = bind(layout, index, default, layout.parameter)
                bindings += [shifted(layout, first, binding, m, k) for m, k in left]
            else:
                value[[k for _, k in left]] = default
    return bindings


def _computed_default(component: Component, declaration: Parameter) -> Any:
    """What a default that is a function comes to: a number, or an expression."""
    try:
        default: Any = declaration.default(component)
        return default if is_bound(default) else float(default)
    except (TypeError, ValueError, OverflowError) as error:
        where = f"{component._node.label}.{declaration.name}"
        raise DeclarationError(f"{where}: its default cannot be computed ({error})") from None


def module_values(layout: Layout) -> tuple[Callable[..., Any] | int, ...]:
    """Value or factory of every module; an int refers to another module."""
    values: list[Callable[..., Any] | int] = []
    for number, component in enumerate(layout.components):
        for name, declaration in layout.form(number).modules:
            value = component._node.modifiers.get(name, declaration.default)
            if value is None:
                raise DeclarationError(
                    f"{component._node.label} has no module '{name}'; give {name}=..."
                )
            if isinstance(value, str):
                if not hasattr(component, value):
                    raise DeclarationError(
                        f"{component._node.label}: the module '{name}' is '{value}', which names nothing in it"
                    )
                value = getattr(component, value)
            if isinstance(value, ModuleReference):  # a module of an enclosing component
                owner = layout.position[id(value.symbol.owner)]
                value = (
                    int(layout.module_base[owner])
                    + layout.form(owner).module_index[value.symbol.path]
                )
            elif not callable(value):
                raise DeclarationError(
                    f"{component._node.label}.{name} is {shown(value)}; "
                    "a module or a function key -> module is needed"
                )
            values.append(value)
    return tuple(values)
