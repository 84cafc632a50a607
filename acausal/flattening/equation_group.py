"""Instances: the integers that fill a template's slots, and parameters bound to others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import sympy as sp

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
class Binding:
    """A parameter or a start value given by an expression of parameters: ``target = expression(arguments)``."""

    target: int
    expression: sp.Expr
    symbols: tuple[sp.Symbol, ...]
    arguments: tuple[int, ...]
