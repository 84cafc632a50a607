"""Groups of equations: the instances of one template, and the integers that fill its slots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.flattening.sums import Statement
from acausal.flattening.template import Integers


@dataclass(frozen=True)
class EquationGroup:
    """The instances of one template: row ``i`` of each array fills the slots of instance ``i``.

    Attributes:
        variables: (n, slots) variable indices; ``parameters`` and ``modules`` likewise.
        components: (n,) index of the component that states each instance; for a connection, -1 minus the index of
            a variable that it joins.
    """

    template: Statement
    variables: Integers
    parameters: Integers
    modules: Integers
    components: Integers

    def __len__(self) -> int:
        return len(self.components)

    def rows(self, chosen: np.ndarray) -> EquationGroup:
        """The group restricted to some rows (a mask or indices)."""
        return EquationGroup(
            self.template,
            self.variables[chosen],
            self.parameters[chosen],
            self.modules[chosen],
            self.components[chosen],
        )


@dataclass(frozen=True)
class GuardGroup:
    """Conditions that are watched: ``target`` is 1 where the template's residual is positive, else 0.

    Attributes:
        group: the template and its instances. targets: (n,) the hidden variables.
        previous: for every slot of a variable whether it takes the value before an event.
        strict: whether zero counts as false. ticks: whether it is a clock's, false while initial values are found.
    """

    group: EquationGroup
    targets: Integers
    previous: tuple[bool, ...]
    strict: bool
    ticks: bool


@dataclass(frozen=True)
class UpdateGroup:
    """What variables become at an event: the value of the template's residual.

    Attributes:
        group, targets, previous: as in `GuardGroup`.
    """

    group: EquationGroup
    targets: Integers
    previous: tuple[bool, ...]


@dataclass(frozen=True)
class EventEquations:
    """What holds at events: conditions, discrete variables, and states that jump."""

    guards: tuple[GuardGroup, ...] = ()
    updates: tuple[UpdateGroup, ...] = ()
    jumps: tuple[UpdateGroup, ...] = ()
