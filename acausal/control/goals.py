"""What a controller is asked for: references, what inputs cost, and limits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal._jax import is_number, is_real
from acausal.errors import DataError, known_name, shown

if TYPE_CHECKING:
    from acausal.system import System

Weights = Mapping[str, float]
Limits = Mapping[str, tuple[float | None, float | None]]


@dataclass(frozen=True, eq=False)
class Goals:
    """What is minimised, and within what.

    Attributes:
        track: weights of variables that have references. effort: of the inputs that are decided.
        change: of what these change from sample to sample.
        limits: lowest and highest values of decided inputs and of variables.
        terminal: how many times the last sample's errors count.
    """

    track: Weights
    effort: Weights
    change: Weights
    limits: Limits
    terminal: float

    @property
    def decided(self) -> tuple[str, ...]:
        """The inputs that the controller decides."""
        return tuple(self.effort)

    @property
    def bounded(self) -> tuple[str, ...]:
        """Variables with limits."""
        return tuple(n for n in self.limits if n not in self.effort)

    @property
    def observed(self) -> tuple[str, ...]:
        """Variables with references, then the others that have limits."""
        return tuple(dict.fromkeys([*self.track, *self.bounded]))

    def ends(self, name: str) -> tuple[float, float]:
        """The limits of an input or a variable, infinite where there is none."""
        low, high = self.limits.get(name, (None, None))
        return -np.inf if low is None else float(low), np.inf if high is None else float(high)

    def size(self, name: str) -> float:
        """What counts as large: the distance of the limits, or from zero of the only one, else 1."""
        low, high = self.ends(name)
        if np.isfinite(high - low):
            return high - low
        return abs(next((end for end in (low, high) if np.isfinite(end)), 0.0)) or 1.0

    def check(self, system: System) -> None:
        """Check names and numbers.

        Raises:
            DataError: for one that does not fit.
        """
        if not self.track or not self.effort:
            raise DataError(
                "control.mpc: name what should follow a reference, track={'body.s': 1.0}, and what the controller "
                "decides, effort={'force.f': 0.0}."
            )
        if not is_number(self.terminal) or not 0 <= float(self.terminal) < np.inf:
            raise DataError(
                f"control.mpc: terminal={shown(self.terminal)} is not a factor; give a number from 0 on."
            )
        for what in ("track", "effort", "change"):
            for name, weight in getattr(self, what).items():
                if not is_number(weight) or not 0 <= float(weight) < np.inf:
                    raise DataError(
                        f"control.mpc: {what}: {shown(weight)} of '{name}' is not a weight; give a number from 0 on."
                    )
        for what, names, known in (
            ("effort", self.effort, system.inputs),
            ("change", self.change, self.decided),
        ):
            for name in names:
                of = f"control.mpc: {what}:"
                known_name(name, known, of, then=" is no input that is decided;")
        pair: Any
        for name, pair in self.limits.items():
            if name in system.inputs and name not in self.effort:
                raise DataError(
                    f"control.mpc: limits: '{name}' is given, not decided; leave it out."
                )
            is_pair = np.shape(pair) == (2,) and all(e is None or is_real(e) for e in pair)
            if not is_pair or not np.less(*self.ends(name)):
                raise DataError(
                    f"control.mpc: limits of '{name}' are (lowest, highest), the one below the other, or None for one "
                    f"that there is not; not {shown(pair)}."
                )
