"""What a singular model may suffer from, where a mistake leaves its mark in the components."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from acausal.errors import DeclarationError, listing
from acausal.flattening import FlatModel, Origin
from acausal.modeling import Component, Eq


def inputs_that_are_set(model: FlatModel, surplus: Sequence[tuple[Origin, int]]) -> str | None:
    """A sentence on inputs of the model in equations that are too many, or None.

    Arguments:
        model: the singular model.
        surplus: origin and component of every such equation.
    """
    inputs = set(model.inputs.tolist())
    found: dict[str, None] = {}
    for origin, component in surplus:
        for group in model.groups:
            if origin in group.origins:
                for row in group.variables[np.flatnonzero(group.components == component)].tolist():
                    found |= {model.layout.variable(v): None for v in row if v in inputs}
    if not found:
        return None
    what = "the Input" if len(found) == 1 else "the Inputs"
    return (
        f"Does an equation set {what} {listing(found)}, to which nothing is connected? "
        "Connect it, or make it an Output."
    )


def forgotten_equations(model: FlatModel) -> str | None:
    """A sentence on components that state none of the equations of one of their base classes, or None."""
    found = {
        f"'{c._node.path}' ({type(c).__name__})": base.__name__
        for c in (form.prototype for form in model.layout.forms)
        if (base := _base_without_effect(c)) is not None
    }
    if not found:
        return None
    component, base = next(iter(found.items()))
    also = f", and {len(found) - 1} more likewise" if len(found) > 1 else ""
    return (
        f"{component} states none of the equations of its base class {base}{also}: "
        "is 'yield from super().equations()' missing?"
    )


def _base_without_effect(component: Component) -> type[Component] | None:
    """The first base class whose equations its subclass neither states nor extends."""
    stating = [c for c in type(component).__mro__ if "equations" in vars(c) and c is not Component]
    if len(stating) < 2:
        return None
    own = list(component.equations())
    for base in stating[1:]:
        expected = list(_equations_of(base, component))
        if expected and not any(equation in own for equation in expected):
            return base
    return None


def _equations_of(base: type[Component], component: Component) -> Iterator[Eq]:
    try:
        yield from base.equations(component)
    except (NotImplementedError, AttributeError, DeclarationError):
        return  # the base class leaves them to its subclasses
