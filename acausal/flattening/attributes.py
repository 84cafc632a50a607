"""Attributes of variables: start, fixed, nominal, state and tear, as declared and as modified."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError, shown
from acausal.flattening.bindings import Binding, bind, is_bound, shifted
from acausal.flattening.layout import Flags, Form, Layout, Numbers, tiled
from acausal.flattening.template import Integers
from acausal.modeling import STATE_SELECT, TEAR_SELECT, Component, Start, Variable, in_tuples

T = TypeVar("T", bound=np.generic)


@dataclass(frozen=True)
class VariableAttributes:
    """Attributes of all variables.

    Attributes:
        start, fixed, nominal, state: (n_variables,); ``state`` counts from 0 "never" to 4 "always", plus 0.5 where the
            model's author, not the library, set it.
        tear: (n_variables,) how much they are preferred as tearing variables, from 0 "never" to 4 "always".
        start_given: (n_variables,) whether a modifier gave the start.
        starts: start values that are expressions of parameters.
    """

    start: Numbers
    fixed: Flags
    nominal: Numbers
    state: Numbers
    tear: Integers
    start_given: Flags
    starts: tuple[Binding, ...]


def variable_attributes(layout: Layout) -> VariableAttributes:
    """Start, fixed, nominal, state and tear attributes of all variables: declared ones, then those of modifiers.

    Raises:
        DeclarationError: for a start that has too few elements, or refers to something outside of the model.
    """
    declared = _declared_attributes(layout)
    bindings: list[Binding] = []
    named = [
        [
            (i, path, d)
            for i, (path, d) in enumerate(f.variables)
            if isinstance(d.start, str | tuple)
        ]
        for f in layout.forms
    ]
    start_of_form: dict[tuple[int, int], tuple[int, Binding]] = {}
    for number, component in enumerate(layout.components):
        form_number = int(layout.form_of[number])
        for index, path, d in named[form_number]:  # the start is a parameter, or an array
            modifiers = component._node.modifiers
            if modifiers.get(d.name, Start()).value is not None:
                continue
            variable = int(layout.variable_base[number]) + index
            declared.start_given[variable] = isinstance(d.start, str) and d.start in modifiers
            key = form_number, index
            if key not in start_of_form:
                start = getattr(component, d.start) if isinstance(d.start, str) else d.start
                shape = component._node.shape(d.name, d) or ()
                given = np.shape(np.asarray(d.start, dtype=object))
                many = any(n > most for n, most in zip(given, shape, strict=False))
                if shape and (many or len(given) > len(shape)):
                    raise DeclarationError(
                        f"the start of '{d.name}' has the shape {given}, the variable {shape}"
                    )
                value = element(start, path, d.name)
                if not is_bound(value):
                    declared.start[variable] = float(value)
                    continue
                start_of_form[key] = number, bind(layout, variable, value, layout.variable)
            bindings.append(shifted(layout, *start_of_form[key], number, variable))
        if component._node.modifiers:
            bindings += _modified_starts(layout, number, declared)
    _check(layout, declared)
    return replace(declared, starts=tuple(bindings))


def _check(layout: Layout, found: VariableAttributes) -> None:
    """Refuse starts and nominal values that are not numbers to compute with."""
    no_nominal = ~np.isfinite(found.nominal) | (found.nominal == 0)
    checks = (
        ("start", found.start, ~np.isfinite(found.start)),
        ("nominal", found.nominal, no_nominal),
    )
    for attribute, values, wrong in checks:
        for i in np.flatnonzero(wrong):
            needed = "a finite number" + ", not zero," * (attribute == "nominal")
            raise DeclarationError(
                f"'{layout.variable(int(i))}' has {attribute}={values[i]:g}; {needed} is needed"
            )


def _declared_attributes(layout: Layout) -> VariableAttributes:
    """The attributes as the classes declare them, without starts that are expressions."""
    base = layout.variable_base

    def spread(attribute: str, dtype: type[T]) -> np.ndarray[Any, np.dtype[T]]:
        local = [
            [_attribute(form.prototype, d, attribute) for _, d in form.variables]
            for form in layout.forms
        ]
        numbers = [[0.0 if isinstance(v, sp.Expr | tuple) else v for v in row] for row in local]
        return tiled(layout, base, numbers, dtype)

    rank = [[_state_rank(form.prototype, d) for _, d in form.variables] for form in layout.forms]
    tear = [[TEAR_SELECT.index(d.tear) for _, d in form.variables] for form in layout.forms]
    start = spread("start", np.float64)
    return VariableAttributes(
        start=start,
        fixed=spread("fixed", np.bool_),
        nominal=spread("nominal", np.float64),
        state=tiled(layout, base, rank, np.float64),
        tear=tiled(layout, base, tear, np.int64),
        start_given=np.zeros(len(start), dtype=np.bool_),
        starts=(),
    )


def _modified_starts(layout: Layout, number: int, found: VariableAttributes) -> Iterator[Binding]:
    """Write the attributes that a component's modifiers give; return the starts that are expressions."""
    form, base = layout.form(number), int(layout.variable_base[number])
    for name, modifier in layout.components[number]._node.modifiers.items():
        if not isinstance(modifier, Start):
            continue
        for index in _indices(form, name):
            variable = base + index
            if modifier.fixed is not None:
                found.fixed[variable] = modifier.fixed
            if modifier.nominal is not None:
                found.nominal[variable] = modifier.nominal
            if modifier.state is not None:
                found.state[variable] = STATE_SELECT.index(modifier.state) + 0.5
            if modifier.value is not None:
                found.start_given[variable] = True
                value = element(modifier.value, form.variables[index][0], name)
                if is_bound(value):
                    yield bind(layout, variable, value, layout.variable)
                else:
                    found.start[variable] = float(value)


def _attribute(component: Component, variable: Variable, attribute: str) -> Any:
    """A declared attribute of a variable; it may be the name of another attribute of the component."""
    value = getattr(variable, attribute)
    where = f"{component._node.label}.{variable.name}"
    if isinstance(value, str) and value not in STATE_SELECT:
        if not hasattr(component, value):
            raise DeclarationError(
                f"{where}: {attribute}='{value:.60}' names nothing in the component"
            )
        value = in_tuples(getattr(component, value))
    kinds: dict[str, tuple[type[Any], ...]] = {
        "start": (int, float, np.number, sp.Expr, tuple),
        "nominal": (int, float, np.number),
        "fixed": (bool, np.bool_),
        "state": (str,),
    }
    if not isinstance(value, kinds[attribute]) or isinstance(value, np.complexfloating):
        raise DeclarationError(f"{where}: {attribute}={shown(value)} is of the wrong kind")
    if isinstance(value, int) and abs(value) > sys.float_info.max:
        raise DeclarationError(f"{where}: {attribute}={shown(value)} is too large")
    if attribute == "state" and value not in STATE_SELECT:
        raise DeclarationError(
            f"{where}: state={shown(value)} must be one of {', '.join(STATE_SELECT)}"
        )
    return value


def _state_rank(prototype: Component, variable: Variable) -> float:
    """Rank of the variable's `StateSelect`; half a rank higher where the user set the option that it names."""
    by_hand = variable.state in prototype._node.options
    return STATE_SELECT.index(_attribute(prototype, variable, "state")) + 0.5 * by_hand


def _indices(form: Form, name: str) -> Iterator[int]:
    """Local indices of a variable; of a vector, those of all elements."""
    if name in form.variable_index:
        yield form.variable_index[name]
    else:
        yield from (i for path, i in form.variable_index.items() if path.startswith(f"{name}["))


def element(value: Any, path: str, name: str) -> Any:
    """The value of one element, ``name[1]``, of an array's, or the value of all of them.

    Raises:
        DeclarationError: where there is none.
    """
    if not isinstance(value, list | tuple | np.ndarray):
        return value
    if path == name:
        raise DeclarationError(
            f"'{name}' is one variable; its start is a number, not {shown(value)}"
        )
    found: Any = value
    try:
        for i in path[len(name) + 1 : -1].split(","):
            found = found[int(i) - 1]
    except (IndexError, TypeError):
        found = None
    if isinstance(found, str | list | tuple | np.ndarray | None):
        raise DeclarationError(f"the start of '{name}' has no number for {path}")
    return found
