"""What has changed in a model since it was flattened: components can be modified at any time."""

from __future__ import annotations

import numpy as np

from acausal.flattening.bindings import Binding
from acausal.flattening.equation_group import EquationGroup
from acausal.flattening.flat_model import FlatModel, flatten
from acausal.flattening.given import with_inputs
from acausal.flattening.layout import Layout
from acausal.flattening.origin import is_hidden
from acausal.modeling import PYTHON, Component


def changed(model: Component, then: FlatModel) -> str | None:
    """The name of something in a model that differs from its flat form; None if nothing does."""
    now = flatten(model, PYTHON)
    if now.n_variables != then.n_variables:
        now = flatten(model, PYTHON, watch=True)
    given = map(then.layout.variable, then.given.tolist())
    return _difference(then, with_inputs(now, [name for name in given if not is_hidden(name)]))


def _difference(then: FlatModel, now: FlatModel) -> str | None:
    old, new = then.layout, now.layout
    if parts := sorted({*old.paths} ^ {*new.paths}):
        return parts[0]
    sizes = [(flat.n_variables, len(flat.value), len(flat.inputs)) for flat in (then, now)]
    if sizes[0] != sizes[1]:
        return then.name
    parameters = [*_unequal(then.value, now.value), *_bound_anew(then.bindings, now.bindings)]
    if named := [p for p in parameters if p < then.n_parameters]:
        return old.parameter(named[0])
    variables = [
        *_unequal(then.start, now.start),
        *_unequal(then.fixed, now.fixed),
        *_unequal(then.nominal, now.nominal),
        *_bound_anew(then.starts, now.starts),
    ]
    if variables:
        return old.variable(variables[0])
    return _of_equations(then, now, old)


def _of_equations(then: FlatModel, now: FlatModel, layout: Layout) -> str | None:
    """The component of an equation or connection that differs."""
    old, new = (
        [*flat.equations(initial=True), *(asserted.group for asserted in flat.assertions)]
        for flat in (then, now)
    )
    for before, after in zip(old, new, strict=False):
        if not _same(before, after):
            component = int(before.components[0])
            return layout.paths[component] if component > 0 else then.name
    return None if len(old) == len(new) else then.name


def _same(a: EquationGroup, b: EquationGroup) -> bool:
    """Whether two groups state the same; their slots may be in another order."""
    stated = [getattr(group.template, "residual", group.template) for group in (a, b)]
    slots = zip(a.columns[:4], b.columns[:4], strict=True)
    return stated[0] == stated[1] and all(np.array_equal(np.sort(x), np.sort(y)) for x, y in slots)


def _unequal(a: np.ndarray, b: np.ndarray) -> list[int]:
    """Where two arrays differ; nan equals nan."""
    return np.flatnonzero((a != b) & ((a == a) | (b == b))).tolist()


def _bound_anew(a: tuple[Binding, ...], b: tuple[Binding, ...]) -> list[int]:
    """Targets of bindings that are not the same."""
    return sorted({binding.target for binding in {*a} ^ {*b}})
