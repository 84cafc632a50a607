"""Sums of many variables, stored as integers instead of sympy expressions.

Where thousands of flows meet in one node, an expression with a term for each would cost sympy and XLA as much as
thousands of formulas. A `Sum` has the interface of a `Template`, but computes with integers.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import sympy as sp

from acausal.flattening.leaves_caches import LeavesCaches
from acausal.flattening.template import KeptSlots, Template, interned, slot

FEW = 8
"""The most terms of a sum that is a template like any other equation."""


@dataclass(frozen=True)
class Sum(LeavesCaches):
    """The equation ``sum(coefficients[i] * slot[i]) = 0``; no coefficient is zero.

    It has the interface of a `Template`; ``residual`` over ``variables`` spells it out for people and messages.
    """

    factors: tuple[int, ...]

    parameters = modules = ()
    is_void = False

    @cached_property
    def _hash(self) -> int:
        return hash(self.factors)

    def __hash__(self) -> int:
        """Computed once, as a template's."""
        return self._hash

    @property
    def orders(self) -> tuple[int, ...]:
        """No slot is a derivative."""
        return (0,) * len(self.factors)

    @cached_property
    def variables(self) -> tuple[sp.Symbol, ...]:
        """Slot symbols."""
        return tuple(slot(f"f{i}") for i in range(1, len(self.factors) + 1))

    @cached_property
    def residual(self) -> sp.Expr:
        """The sum, spelled out."""
        terms = zip(self.factors, self.variables, strict=True)
        return sp.Add(*(factor * symbol for factor, symbol in terms))

    def specialised(self, pattern: tuple[int, ...]) -> tuple[Statement, KeptSlots]:
        """See `Template.specialised`."""
        merged: dict[int, int] = {}
        for factor, code in zip(self.factors, pattern, strict=True):
            if code:
                target = abs(code) - 1
                merged[target] = merged.get(target, 0) + (factor if code > 0 else -factor)
        left = [target for target, factor in sorted(merged.items()) if factor]
        return balance(tuple(merged[target] for target in left)), (left, [], [])

    def differentiated(self) -> tuple[Sum, tuple[tuple[int, bool], ...]]:
        """The same sum of derivatives; see `Template.differentiated`."""
        sources = tuple((i, True) for i in range(len(self.factors)))
        return self, sources

    def with_orders(self, orders: tuple[int, ...]) -> Sum:
        """The sum as it is: no slot is a derivative."""
        assert not any(orders)
        return self

    def has_prescribed(self) -> bool:
        """A sum contains no `Prescribed` signal."""
        return False

    def depends_on_time(self) -> bool:
        """A sum does not."""
        return False

    def with_signals(self) -> tuple[Sum, tuple[int, ...]]:
        """The sum as it is; see `Template.with_signals`."""
        return self, tuple(range(len(self.factors)))

    def coefficients(self) -> tuple[int, ...]:
        """The numbers that slots are multiplied by."""
        return self.factors

    def alias(self) -> None:
        """A sum has more than two terms."""

    def partial(self, column: int) -> sp.Expr:
        """A slot's coefficient."""
        return sp.Integer(self.factors[column])

    def solved(self, column: int) -> sp.Expr:
        """The slot as an explicit expression of the others."""
        rest: Any = self.residual.xreplace({self.variables[column]: sp.S.Zero})
        return -rest / self.partial(column)

    def is_solvable(self, column: int) -> bool:
        """Every slot can be computed from the others."""
        return True

    is_safely_solvable = is_solvable

    def is_linear(self, columns: tuple[int, ...]) -> bool:
        """A sum is linear in all slots."""
        return True

    def weights(self, column: int) -> tuple[float, ...]:
        """Weights whose sum over the other slots is this one."""
        return tuple(f / -self.factors[column] for i, f in enumerate(self.factors) if i != column)

    def split(self, inside: tuple[bool, ...]) -> Statement | None:
        """The sum over the slots ``inside`` of a loop and one more that holds the sum of the others.

        None if there are not two others.
        """
        kept = [f for f, is_inside in zip(self.factors, inside, strict=True) if is_inside]
        if len(self.factors) - len(kept) < 2:
            return None
        return balance((*kept, 1))


@lru_cache(maxsize=256)
def balance(coefficients: tuple[int, ...]) -> Template | Sum:
    """``sum(coefficients[i] * slot[i]) = 0``, as a template where the terms are few."""
    total = Sum(coefficients)
    if len(coefficients) > FEW:
        return total
    return interned(Template(total.residual, total.variables, total.orders, (), ()))


Statement = Template | Sum
"""An equation in slots, whatever variables fill them."""
