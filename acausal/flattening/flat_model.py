"""Flatten: the component tree becomes integer-numbered variables and instances of equation templates."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from acausal.flattening.attributes import VariableAttributes, element, variable_attributes
from acausal.flattening.bindings import parameter_aliases
from acausal.flattening.connections import (
    connection_groups,
    connection_sets,
    model_inputs,
    model_outputs,
)
from acausal.flattening.equation_group import (
    AssertionGroup,
    EquationGroup,
    EventEquations,
)
from acausal.flattening.instances import instantiate
from acausal.flattening.layout import Layout, declared, lay_out
from acausal.flattening.leaves_caches import LeavesCaches
from acausal.flattening.silent import Silent
from acausal.flattening.stated import Stated
from acausal.flattening.template import Integers
from acausal.flattening.values import ParameterValues, module_values, parameter_values
from acausal.modeling import PYTHON, Budget, Component, Discrete, Input, inherit, spending


@dataclass(frozen=True)
class FlatModel(VariableAttributes, ParameterValues, LeavesCaches):
    """A model without hierarchy: numbered variables, and equations as instances of templates.

    The constants, which are numbers in equations, follow the values of parameters.

    Attributes:
        name: of the model: its class, or the title in its file.
        layout: names of everything.
        groups: all equations, including those of connections; ``initial``: equations at the initial time.
        events: what holds at events. assertions: what must hold.
        inputs: indices of the variables that are the model's inputs.
        given: discrete variables that are not found at events: inputs, and conditions that nothing else needs.
        module_values: value or factory of every module; an int refers to another module.
        outputs: output signals that nothing in the model takes.
        silent: by dotted name, parameters that act through conditions alone that are not events, and how.
        unseen: by component, a condition that is no event, where values jump.
        said: what was said of the components when they were read (`Node.said`): they can be modified at any time.
    """

    name: str
    layout: Layout
    groups: tuple[EquationGroup, ...]
    initial: tuple[EquationGroup, ...]
    events: EventEquations
    assertions: tuple[AssertionGroup, ...]
    inputs: Integers
    module_values: tuple[Callable[..., Any] | int, ...]
    silent: Mapping[str, Silent]
    unseen: Mapping[str, Silent]
    said: Mapping[str, Any]
    given: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    outputs: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    @property
    def n_variables(self) -> int:
        """Number of variables."""
        return int(self.layout.variable_base[-1])

    @property
    def n_equations(self) -> int:
        """Number of equations, including those of connections."""
        return sum(len(g) for g in self.groups)

    @property
    def n_parameters(self) -> int:
        """Number of parameters; constants follow."""
        return int(self.layout.parameter_base[-1])

    @cached_property
    def discrete(self) -> Integers:
        """The variables that change at events only: first those of watched conditions, in order of the guards."""
        guards = [g.targets for g in self.events.guards]
        watched = np.concatenate([np.zeros(0, np.int64), *guards])
        return np.concatenate(
            [watched, np.setdiff1d(declared(self.layout, Discrete), [*watched, *self.given])]
        )

    @cached_property
    def remembered(self) -> Integers:
        """The discrete variables whose value before an event decides on that after it."""
        groups = self.events.all
        read = [g.group.variables[:, np.asarray(g.previous, bool)].ravel() for g in groups]
        known = np.concatenate([np.zeros(0, np.int64), *read])
        return np.intersect1d(np.unique(known), self.discrete)

    def equations(
        self, *, initial: bool = False, at_events: bool = True
    ) -> Iterator[EquationGroup]:
        """All equations: those that always hold, conditions, and what variables become at events.

        Those at the initial time are left out, unless they are asked for; those of changes at events may be.
        """
        yield from (*self.groups, *(self.initial if initial else ()))
        yield from (guard.group for guard in self.events.guards)
        for update in (*self.events.updates, *self.events.jumps) if at_events else ():
            name = self.layout.variable(int(update.targets[0])).rpartition(".")[2]
            yield update.as_equation(name)

    def stated_at(self, component: int, origin: object) -> str:
        """Where an equation is stated, and its text, for messages.

        The component of connections is -1 minus the number of a variable of a connector.
        """
        if component < 0:
            return f"{self.layout.variable(-1 - component).rpartition('.')[0]} ({origin})"
        path = self.layout.paths[component]
        return f"{path} ({origin})" if path else str(origin)

    @cached_property
    def input_defaults(self) -> dict[str, float]:
        """By name, what inputs of the model are where nothing is given for them."""
        names = map(self.layout.variable, self.inputs.tolist())
        declared = map(self.layout.variable_declaration, self.inputs.tolist())
        return {
            name: float(element(d.default, name, name.rpartition("[")[0] or name))
            for name, d in zip(names, declared, strict=True)
            if isinstance(d, Input) and d.default is not None
        }

    @cached_property
    def parameter_aliases(self) -> Integers:
        """(n_parameters,) for a parameter that is bound to nothing but another one: that one; else itself."""
        return parameter_aliases(self.bindings, len(self.value))


def flatten(model: Component, budget: Budget | None = None, *, watch: bool = False) -> FlatModel:
    """Number the variables of a component tree and instantiate its equations.

    Arguments:
        budget: how large the model may become; by default that of its file, or of models in Python.
        watch: whether conditions that are events in models with others are events in any case.

    Raises:
        DeclarationError: for a parameter without a value, an equation that refers to something outside of the model,
            or more than the budget allows.
        ConnectionError: for connections that cannot be made.
    """
    own = model._node.budget or PYTHON
    with spending(own if budget is None else budget):
        return _flat(model, watch)


def _flat(model: Component, watch: bool) -> FlatModel:
    inherit(model)
    layout, statements = lay_out(model, watch=watch)
    stated = instantiate(layout, statements)
    sets = connection_sets(layout)
    attributes, parameters = variable_attributes(layout), parameter_values(layout)
    return FlatModel(
        name=model._node.label,
        layout=layout,
        groups=(*stated.equations, *connection_groups(layout, sets)),
        initial=stated.initial,
        events=stated.events,
        assertions=stated.assertions,
        inputs=model_inputs(layout, sets),
        **vars(attributes),
        value=np.append(parameters.value, stated.constants),
        bindings=parameters.bindings,
        folded=np.append(parameters.folded, np.zeros(len(stated.constants), np.bool_)),
        module_values=module_values(layout),
        silent=_silent(layout, statements, of_parameters=True),
        unseen=_silent(layout, statements, of_parameters=False),
        said=model._node.said(),
        outputs=model_outputs(layout, sets),
    )


def _silent(
    layout: Layout, statements: Sequence[Stated], *, of_parameters: bool
) -> dict[str, Silent]:
    """The parameters that act through conditions alone, or these conditions by their components, by dotted name."""
    if not any(stated.silent for stated in statements):
        return {}
    return {
        f"{path}.{one.parameter}".strip("."): one
        for path, form in zip(layout.paths, layout.form_of, strict=True)
        for one in statements[form].silent
        if bool(one.parameter) == of_parameters
    }
