"""Budgets: how large a model may become. What would be larger is refused before it is allocated."""

from __future__ import annotations

import time
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, cast

from acausal.errors import DeclarationError, shown


@dataclass(frozen=True, kw_only=True)
class Budget:
    """How large a model may become; the defaults are those of a model in a file.

    Attributes:
        components: of the whole model.
        elements: variables and parameters of the whole model; in a file also the entries of lists.
        vector: elements of one vector or matrix.
        equations: of the whole model, with those of its connections.
        seconds: for reading a file, and again for flattening the model.

    Raises:
        DeclarationError: for a limit that is not a positive number.
    """

    components: int = 100_000
    elements: int = 500_000
    vector: int = 10_000
    equations: int = 500_000
    seconds: float = 60.0

    def __post_init__(self) -> None:
        for limit in fields(self):
            value = getattr(self, limit.name)
            if isinstance(value, bool) or not isinstance(value, int | float) or not value > 0:
                raise DeclarationError(
                    f"Budget({limit.name}={shown(value)}): a limit is a positive number"
                )


PYTHON = Budget(
    components=10_000_000,
    elements=100_000_000,
    vector=1_000_000,
    equations=100_000_000,
    seconds=3600.0,
)
"""The budget of models that are written in Python."""


class BudgetError(DeclarationError):
    """A model would become larger than its budget allows."""


@dataclass
class _Account:
    """What has been spent of a budget, and where native code may come from."""

    budget: Budget
    native: Path | None
    spent: dict[str, int] = field(default_factory=dict[str, int])
    began: float = field(default_factory=time.monotonic)


_ACTIVE: ContextVar[_Account | None] = ContextVar("budget", default=None)


@contextmanager
def spending(budget: Budget, native: Path | None = Path()) -> Generator[None]:
    """Charge what is made meanwhile to a budget.

    Arguments:
        native: the folder of relative paths to files with native code; None: a model in a file may not have any.

    Raises:
        DeclarationError: for what is not a budget.
    """
    if not isinstance(budget, Budget):
        raise DeclarationError(f"budget={shown(budget)} is not a budget; give ac.Budget(...).")
    token = _ACTIVE.set(_Account(budget, native))
    try:
        yield
    finally:
        _ACTIVE.reset(token)


def charge(kind: str, count: int, label: Any) -> None:
    """Charge a number of ``components``, ``elements`` or ``equations`` to the budget, where one is active.

    Arguments:
        label: what they belong to, for the message; an object with a ``label`` or a text.

    Raises:
        BudgetError: if they, or the time, are more than the budget allows.
    """
    account = _ACTIVE.get()
    if account is None:
        return
    allowed = account.budget
    spent = account.spent[kind] = account.spent.get(kind, 0) + count
    if spent > getattr(allowed, kind):
        what = f"with {_name(label)} the model has at least {spent:,} {kind}"
        raise _over(allowed, kind, what, 10 * getattr(allowed, kind))
    if time.monotonic() - account.began > allowed.seconds:
        what = f"at {_name(label)} the model has taken too many seconds"
        raise _over(allowed, "seconds", what, 10 * allowed.seconds)


def native_file(path: str | Path) -> str | Path:
    """The path to a file with native code, as seen from the model's file where one is being read.

    Raises:
        DeclarationError: in a file that is read without permission.
    """
    account = _ACTIVE.get()
    if account is None:
        return path
    if account.native is None:
        raise DeclarationError(
            f"{shown(str(path))} runs native code, which can do whatever you can do; if you trust it, load the model "
            "with allow_native=True."
        )
    return account.native / path


def check_size(count: int, label: str) -> None:
    """Refuse a vector or matrix that is too large.

    Raises:
        BudgetError: if it has more elements than the budget allows.
    """
    account = _ACTIVE.get()
    budget = PYTHON if account is None else account.budget
    if count > budget.vector:
        raise _over(budget, "vector", f"{label} would have {count:,} elements", count)


def check_nested(values: Any, label: str) -> None:
    """Refuse nested lists with too many entries, counted without making them.

    Raises:
        BudgetError: if they have more than the budget allows.
    """
    account = _ACTIVE.get()
    budget = PYTHON if account is None else account.budget
    left = budget.elements
    stack: list[Any] = [values]
    while stack:
        value = stack.pop()
        if isinstance(value, list | tuple):
            entries = cast(Sequence[Any], value)
            left -= len(entries)
            if left < 0:
                more = f"{label} would have over {budget.elements:,} entries"
                raise _over(budget, "elements", more, 10 * budget.elements)
            stack += entries
    charge("elements", budget.elements - left, label)


def _name(label: Any) -> str:
    return label if isinstance(label, str) else label.label


def _over(budget: Budget, kind: str, what: str, enough: float) -> BudgetError:
    return BudgetError(
        f"{what}, more than its budget of {getattr(budget, kind):,}; make it smaller, or raise the limit: "
        f"budget=ac.Budget({kind}={enough:_})"
    )
