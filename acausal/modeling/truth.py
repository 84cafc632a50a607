"""Expressions whose truth Python would decide by how they are written: while a model is read, that is refused.

Symbols refuse it themselves (`Compared`). Of their sums and products, ``n + 1 == 3`` is sympy's false, and ``if n + 1``
is true; within ``|`` or ``&`` nothing is left of it. Sympy's classes have no other place for this than their methods,
so these are exchanged for the time in which users' methods are read.
"""

from __future__ import annotations

import threading
from collections.abc import Generator
from contextlib import contextmanager
from typing import Any

import sympy as sp

from acausal.modeling.symbols import (
    COMPARED_WITH,
    Compared,
    is_within,
    refuse_equality,
    refuse_truth,
    time,
)

LOCK = threading.Lock()
SYMPYS = sp.Expr.__eq__
READERS = [0]
"""How many threads read models now."""


@contextmanager
def undecided() -> Generator[None]:
    """Let ``==``, ``!=`` and ``bool`` of expressions be refused, as of symbols, outside of sympy and this package.

    Raises:
        DeclarationError: within, for a comparison or a question that Python would answer.
    """
    with LOCK:
        READERS[0] += 1
        if READERS[0] == 1:
            sp.Expr.__eq__, sp.Expr.__ne__, sp.Expr.__bool__ = _equals, _differs, _is_true  # type: ignore[method-assign]
    try:
        yield
    finally:
        with LOCK:
            READERS[0] -= 1
            if not READERS[0]:
                sp.Expr.__eq__ = SYMPYS  # type: ignore[method-assign]
                del sp.Expr.__ne__, sp.Expr.__bool__  # type: ignore[attr-defined]


def _equals(self: sp.Expr, other: Any) -> Any:
    alike = SYMPYS(self, other)
    if alike is not True and isinstance(other, COMPARED_WITH) and not is_within():
        _check_known(self, other)
    return alike


def _differs(self: sp.Expr, other: Any) -> Any:
    alike = SYMPYS(self, other)
    if alike is not True and isinstance(other, COMPARED_WITH) and not is_within():
        _check_known(self, other)
    return alike if alike is NotImplemented else not alike


def _is_true(self: sp.Expr) -> bool:
    if not is_within() and _varies(self):
        refuse_truth(self)
    return True


def _check_known(*sides: Any) -> None:
    if any(isinstance(side, sp.Expr) and _varies(side) for side in sides):
        refuse_equality(*sides)


def _varies(expression: sp.Expr) -> bool:
    """Whether it has a value only in a simulation."""
    return any(isinstance(s, Compared) or s is time for s in expression.free_symbols)
