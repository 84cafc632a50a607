"""Whether the networks of a model are used within the ranges in which they were trained."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.analysis import Calls, calls, target
from acausal.codegen import Values
from acausal.errors import DataError, known_name, shown
from acausal.system import System

Interval = tuple[float, float]
Ranges = Mapping[str, Interval | Sequence[Interval]]
"""By network the interval of its argument, or one for each of its arguments, in their units."""


@dataclass(frozen=True, eq=False)
class Watch:
    """The calls of networks whose arguments have ranges.

    Attributes:
        system: the model. calls: one for each equation that states some.
        low, high: by call, bounds of the arguments, shape (n, n_arguments), or (1, n_arguments) where all are equal.
    """

    system: System
    calls: tuple[Calls, ...]
    low: tuple[Float[np.ndarray, "n n_arguments"], ...]
    high: tuple[Float[np.ndarray, "n n_arguments"], ...]

    @property
    def nodes(self) -> np.ndarray:
        """What the arguments read."""
        arguments = [a.arguments for call in self.calls for a in call.arguments]
        read = [g for a in arguments for _, g in a.variables]
        return np.asarray([n for g in read for n in self.system.program.nodes_of(g)], np.int64)

    def excess(self, values: Values) -> Float[Array, ""]:
        """Positive where any argument lies outside of its range: the greatest distance, each in its own unit."""
        beyond: list[Array] = []
        for call, low, high in zip(self.calls, self.low, self.high, strict=True):
            found = call.values(self.system, values)
            beyond.append(jnp.max(jnp.maximum(low - found, found - high)))
        return jnp.max(jnp.stack(beyond))


def watched(system: System, ranges: Ranges | None, function: str) -> Watch | None:
    """The calls of the networks that have `Ranges`; None where there are none.

    Raises:
        DataError: for an unknown network, or what is no interval for each of its arguments; it names the ``function``.
    """
    if ranges is None:
        return None
    if not isinstance(ranges, Mapping):
        raise DataError(
            f"export.{function}: ranges={shown(ranges)} are no intervals by network; give some such as "
            "{'spring_nn.net': (-0.02, 0.02)}, or fit.ranges."
        )
    refusal = f"export.{function}: ranges: there is no network"
    for name in ranges:
        known_name(name, system.layout.module_names, refusal)
    found = calls(system, *ranges)
    bounds = {
        target(system, name): (name, _intervals(name, r, function)) for name, r in ranges.items()
    }
    low: list[np.ndarray] = []
    high: list[np.ndarray] = []
    for call in found:
        rows = np.stack(
            [_fitting(*bounds[t], len(call.arguments), function) for t in call.targets.tolist()]
        )
        rows = rows[:1] if (rows == rows[0]).all() else rows
        low.append(rows[:, :, 0])
        high.append(rows[:, :, 1])
    return Watch(system, found, tuple(low), tuple(high)) if found else None


def _intervals(name: str, given: Any, function: str) -> np.ndarray:
    """Bounds, shape (n_arguments, 2)."""
    try:
        bounds = np.atleast_2d(np.asarray(given, dtype=float))
    except (TypeError, ValueError):
        bounds = np.zeros((0, 0))
    if bounds.ndim != 2 or bounds.shape[1] != 2 or not (bounds[:, 0] <= bounds[:, 1]).all():
        raise DataError(
            f"export.{function}: ranges: {shown(given)} of '{name}' is no interval; give (low, high), or one for each "
            "argument."
        )
    return bounds


def _fitting(name: str, bounds: np.ndarray, count: int, function: str) -> np.ndarray:
    if len(bounds) != count:
        raise DataError(
            f"export.{function}: ranges: '{name}' takes {count} argument{'s' * (count != 1)}; give as many intervals, "
            f"not {len(bounds)}."
        )
    return bounds
