"""Flatten: the component tree becomes integer-numbered variables and instances of equation templates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.flattening.attributes import module_values, parameter_values, variable_attributes
from acausal.flattening.connections import connection_groups, connection_sets, model_inputs
from acausal.flattening.instances import instantiate
from acausal.flattening.layout import Layout, lay_out
from acausal.flattening.template import Binding, EquationGroup, Integers
from acausal.modeling import Component


@dataclass(frozen=True)
class FlatModel:
    """A model without hierarchy: numbered variables, and equations as instances of templates.

    Attributes:
        name: of the model: its class, or what its file says.
        layout: names of everything.
        groups: all equations, those of connections among them; ``initial``: equations at the initial time.
        inputs: indices of the variables that are the model's inputs.
        start, fixed, nominal, state: (n_variables,) attributes; ``state`` counts from 0 "never" to 4 "always",
            plus 0.5 where the model's author, not the library, asked for it.
        start_given: (n_variables,) whether somebody gave the start as a modifier.
        starts: start values that are expressions of parameters.
        value: (n_parameters,) values (nan where bound); ``bindings``: the bound ones.
        folded: (n_parameters,) parameters left at a default of zero, or bound to nothing but such.
        module_values: value or factory of every module; an int refers to another module.
    """

    name: str
    layout: Layout
    groups: tuple[EquationGroup, ...]
    initial: tuple[EquationGroup, ...]
    inputs: Integers
    start: np.ndarray
    fixed: np.ndarray
    nominal: np.ndarray
    state: np.ndarray
    start_given: np.ndarray
    starts: tuple[Binding, ...]
    value: np.ndarray
    bindings: tuple[Binding, ...]
    folded: np.ndarray
    module_values: tuple[Any, ...]

    @property
    def n_variables(self) -> int:
        """Number of variables."""
        return int(self.layout.variable_base[-1])

    @property
    def n_equations(self) -> int:
        """Number of equations, those of connections among them."""
        return sum(len(g) for g in self.groups)


def flatten(model: Component) -> FlatModel:
    """Number the variables of a component tree and instantiate its equations.

    Raises:
        DeclarationError: for a parameter without a value, or an equation that uses what is not in the model.
        ConnectionError: for connections that cannot be made.
    """
    layout = lay_out(model)
    equations, initial = instantiate(layout)
    sets = connection_sets(layout)
    start, fixed, nominal, state, given, starts = variable_attributes(layout)
    value, bindings, folded = parameter_values(layout)
    return FlatModel(
        name=model._node.label,
        layout=layout,
        groups=(*equations, *connection_groups(layout, sets)),
        initial=initial,
        inputs=model_inputs(layout, sets),
        start=start,
        fixed=fixed,
        nominal=nominal,
        state=state,
        start_given=given,
        starts=starts,
        value=value,
        bindings=bindings,
        folded=folded,
        module_values=module_values(layout),
    )
