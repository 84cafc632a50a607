"""Groups of equations: the instances of one template, and the integers that fill its slots."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import sympy as sp

from acausal.errors import StructureError
from acausal.flattening.origin import Origin, Origins
from acausal.flattening.sums import Statement
from acausal.flattening.template import Integers, KeptSlots, Template
from acausal.modeling import Assert


@dataclass(frozen=True)
class EquationGroup:
    """The instances of one template: row ``i`` of each array fills the slots of instance ``i``.

    Attributes:
        variables: (n, slots) variable indices; ``parameters`` and ``modules`` likewise.
        components: (n,) index of the component that states each instance; for a connection, -1 minus the index of
            a variable that it joins.
        origins: (n,) where each instance is stated, as an `Origin`.
    """

    template: Statement
    variables: Integers
    parameters: Integers
    modules: Integers
    components: Integers
    origins: Origins

    def __len__(self) -> int:
        return len(self.components)

    @property
    def columns(self) -> tuple[np.ndarray, ...]:
        """All arrays, each with a row for every instance."""
        return self.variables, self.parameters, self.modules, self.components, self.origins

    def rows(self, chosen: np.ndarray) -> EquationGroup:
        """The group restricted to some rows (a mask or indices)."""
        return EquationGroup(self.template, *(column[chosen] for column in self.columns))

    def stated(self, rows: Iterable[int]) -> list[tuple[Origin, int]]:
        """Where some instances are stated: origin and component."""
        return [(self.origins[i], int(self.components[i])) for i in rows]

    def specialised(self, pattern: tuple[int, ...]) -> tuple[Statement, KeptSlots]:
        """The template of instances of one pattern; see `Template.specialised`."""
        return specialised(self.template, pattern, self.origins[0])


def join_groups(groups: Sequence[EquationGroup]) -> EquationGroup:
    """Groups of one template as one."""
    columns = zip(*(g.columns for g in groups), strict=True)
    return EquationGroup(groups[0].template, *map(np.concatenate, columns))


def specialised(
    template: Statement, pattern: tuple[int, ...], origin: Origin
) -> tuple[Statement, KeptSlots]:
    """A template specialised; an error names the origin of the equation.

    Raises:
        StructureError: see `Template.specialised`.
    """
    try:
        return template.specialised(pattern)
    except StructureError as error:
        raise StructureError(f"{origin}: {error}") from None


@dataclass(frozen=True)
class AssertionGroup:
    """What must hold: the template's residual is 1 where it does, else 0.

    Attributes:
        group: the template and its instances. stated: by their class.
    """

    group: EquationGroup
    stated: Assert


@dataclass(frozen=True)
class UpdateGroup:
    """What variables become at an event: the value of the template's residual.

    Attributes:
        group: the template and its instances. targets: (n,) the variables.
        previous: for every slot of a variable whether it takes the value before an event.
        always: whether it must hold between events, too.
    """

    group: EquationGroup
    targets: Integers
    previous: tuple[bool, ...]
    always: bool

    def as_equation(self, name: str) -> EquationGroup:
        """The equation ``new name - value = 0``, the target as its first variable."""
        own, template = self.group, self.group.template
        assert isinstance(template, Template)
        target = sp.Symbol(f"new {name}", real=True)  # no variable is called so
        equation = replace(
            template,
            residual=target - template.residual,
            variables=(target, *template.variables),
            orders=(0, *template.orders),
        )
        variables = np.concatenate([self.targets[:, None], own.variables], axis=1)
        return replace(own, template=equation, variables=variables)


@dataclass(frozen=True)
class GuardGroup(UpdateGroup):
    """Conditions that are watched: a hidden target is 1 where the template's residual is positive, else 0.

    Attributes:
        strict: whether zero counts as false. ticks: whether it is a clock's, false while initial values are found.
    """

    strict: bool
    ticks: bool


@dataclass(frozen=True)
class EventEquations:
    """What holds at events: conditions, discrete variables, and states that jump."""

    guards: tuple[GuardGroup, ...] = ()
    updates: tuple[UpdateGroup, ...] = ()
    jumps: tuple[UpdateGroup, ...] = ()

    @property
    def all(self) -> tuple[UpdateGroup, ...]:
        """All three."""
        return *self.guards, *self.updates, *self.jumps
