"""Assertions: what must hold in a model, and what to say where it does not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError, shown
from acausal.modeling.arrays import is_array
from acausal.modeling.events import INITIAL, Previous, Tick, condition, literal, where
from acausal.modeling.symbols import ModuleCall, der
from acausal.modeling.written import as_written

LEVELS = ("error", "warning")
"""What becomes of an assertion that does not hold, as in Modelica."""


@dataclass(frozen=True)
class Assert:
    """``Assert(condition, text)`` among the equations of a component: what must hold, as Modelica's ``assert``.

    A condition of parameters is looked at whenever values are given for them, one that varies at the points of a
    simulation's result; nothing follows from it for the equations. While JAX traces, and in exports other than
    Modelica's, nothing is looked at.

    Attributes:
        condition: a comparison, ``&``, ``|``, ``~`` of some, or a variable that is 1 or 0; of arrays, each element.
            What Python knows already, as a comparison of options, may stand there, too.
        text: what it means that it does not hold, and what to do: a clause.
        level: ``"error"`` or ``"warning"``.

    Raises:
        DeclarationError: for what is no condition; for ``pre``, ``der``, ``sample``, ``initial`` or a network in it;
            and for an error that Python knows already.
    """

    condition: Any
    text: str
    level: str = "error"

    def __new__(cls, condition: Any = None, text: str = "", level: str = "error") -> Any:
        """One assertion; those of an array's elements; none where Python knows that it holds."""
        if is_array(condition):
            return tuple(cls(one, text, level) for one in np.asarray(condition, object).flat)
        if condition is sp.true or (isinstance(condition, bool | np.bool_) and condition):
            return ()
        return super().__new__(cls)

    def __post_init__(self) -> None:
        given = self.condition
        if not isinstance(self.text, str):
            raise DeclarationError(
                f"Assert(..., {shown(self.text)}): the second argument is a text"
            )
        if self.level not in LEVELS:
            raise DeclarationError(f"level={shown(self.level)} must be one of {', '.join(LEVELS)}")
        known = isinstance(given, bool | np.bool_) or given is sp.false
        if known and self.level == "error":
            raise DeclarationError(self.text)
        holds = sp.false if known else condition(given, "the condition of Assert(...)")
        object.__setattr__(self, "condition", holds)
        truth = self.truth
        if beyond := truth.atoms(Previous, Tick, ModuleCall, der) | (
            {INITIAL} & truth.free_symbols
        ):
            raise DeclarationError(
                f"Assert(...) reads {min(map(str, beyond))}; give that to a variable by ac.Eq(variable, ...), and "
                "compare that"
            )

    @property
    def truth(self) -> Any:
        """The condition as an expression: 1 where it holds, else 0."""
        return literal(where(self.condition, 1, 0))

    def __str__(self) -> str:
        return f"Assert({as_written(self.condition)}, {self.text!r})"
