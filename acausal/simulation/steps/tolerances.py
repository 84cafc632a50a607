"""The tolerances of adaptive steps."""

from __future__ import annotations

import numpy as np
from jaxtyping import Array

from acausal._jax import is_real, traced
from acausal.errors import DataError, shown

Tolerance = float | Array


def check_tolerances(rtol: Tolerance, atol: Tolerance, n_states: int) -> None:
    """Refuse tolerances with which no step can be accepted.

    Raises:
        DataError: for one that is negative or not a finite number, nor one such number for each state; or if all
            are zero.
    """
    for name, given in {"rtol": rtol, "atol": atol}.items():
        if not _is_tolerance(given, n_states):
            raise DataError(
                f"{name}={shown(given)} is not a tolerance; give a positive number, such as {name}=1e-6, or an array "
                "of one for each state."
            )
    if traced(rtol, atol):
        return
    if not (np.any(rtol) or np.any(atol)):
        raise DataError("rtol and atol are both zero; give rtol=1e-6, say.")


def _is_tolerance(given: Tolerance, n_states: int) -> bool:
    """Whether this is a finite number, or an array of these, none below zero where they are known."""
    if not is_real(given) or isinstance(given, list | tuple):
        return False
    if np.shape(given) not in ((), (n_states,)):
        return False
    return traced(given) or bool((np.isfinite(given) & (np.asarray(given) >= 0)).all())
