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
