"""Totals: sums of so many variables that integers stand for them, not sympy.

Where thousands of flows meet in one node, an expression with a term for each would cost sympy and XLA as
much as thousands of formulas. A `Total` answers with integers what is asked of a `Template`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import sympy as sp

from acausal.flattening.template import Template, slot

FEW = 8
"""Up to so many terms a sum is a formula like any other."""


@dataclass(frozen=True)
class Total:
    """The equation ``sum(coefficients[i] * slot[i]) = 0``; no coefficient is zero.

    It is spelled out as a template's ``residual`` over ``variables`` where somebody wants to read it.
    """

    coefficients: tuple[int, ...]
    origin: str

    parameters = modules = ()

    @cached_property
    def _hash(self) -> int:
        return hash(self.coefficients)

    def __hash__(self) -> int:
        """Computed once, as a template's."""
        return self._hash

    @property
    def orders(self) -> tuple[int, ...]:
        """No slot is a derivative."""
        return (0,) * len(self.coefficients)

    @cached_property
    def variables(self) -> tuple[sp.Symbol, ...]:
        """Slot symbols."""
        return tuple(slot(f"f{i}") for i in range(1, len(self.coefficients) + 1))

    @cached_property
    def residual(self) -> sp.Expr:
        """The sum, spelled out."""
        terms = zip(self.coefficients, self.variables, strict=True)
        return sp.Add(*(factor * symbol for factor, symbol in terms))

    @cached_property
    def derivative(self) -> Total:
        """The same sum of derivatives."""
        return Total(self.coefficients, f"derivative of {self.origin}")

    def specialised(self, pattern: tuple[int, ...]) -> tuple[Template | Total, list[int]]:
        """The sum with slots merged (a code ``±(1 + j)``: plus or minus slot j) or zero (0), and the slots left."""
        merged: dict[int, int] = {}
        for factor, code in zip(self.coefficients, pattern, strict=True):
            if code:
                slot = abs(code) - 1
                merged[slot] = merged.get(slot, 0) + (factor if code > 0 else -factor)
        left = [slot for slot, factor in sorted(merged.items()) if factor]
        return balance(tuple(merged[slot] for slot in left), self.origin), left


@lru_cache(maxsize=256)
def balance(coefficients: tuple[int, ...], origin: str) -> Template | Total:
    """``sum(coefficients[i] * slot[i]) = 0``, as a template where the terms are few."""
    total = Total(coefficients, origin)
    if len(coefficients) > FEW:
        return total
    return Template(total.residual, total.variables, total.orders, (), (), origin)


Statement = Template | Total
"""What an equation says, whichever variables fill its slots."""
