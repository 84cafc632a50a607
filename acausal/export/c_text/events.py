"""Events in C: what holds there, traced, and what `events.c` needs to know of a model."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from acausal.codegen import Values
from acausal.events import (
    ALL_AT_ONCE,
    BAND,
    CLOSE,
    DOUBTED,
    FORCED,
    ONE_BY_ONE,
    PASSES,
    STARTS,
    TRIES,
    Events,
    coincide,
    guards,
    jumped,
    updated,
)
from acausal.export.vector import ParameterVector
from acausal.simulation import BY_RATES, CHATTERING, DEADBAND_GROWTH, NEAR

ARGUMENTS: Mapping[str, tuple[tuple[str, ...], str]] = {
    "conditions": (("x_before", "d_before"), "number"),
    "condition_rates": (("along_x", "along_u"), "rate"),
    "updated": (("x_before", "d_before", "holds", "initial"), "next_d"),
    "jumped": (("x_before", "d_before"), "next_x"),
}
"""By function, what it reads besides time, states, inputs, parameters and discrete variables; and what it gives."""


def event_functions(events: Events, vector: ParameterVector) -> dict[str, Callable[..., Any]]:
    """The functions of `ARGUMENTS`.

    Each takes time, states, inputs, parameters, discrete variables, and its own arguments.
    """

    def sides(
        t: Any, x: Any, u: Any, p: Any, d: Any, x_before: Any, d_before: Any
    ) -> tuple[Values, Values]:
        """What holds now, and what held before the event."""
        now = Values(t, x, u, vector.packed(p), d)
        return now, now._replace(x=x_before, d=d_before)

    def condition_rates(t: Any, x: Any, u: Any, p: Any, d: Any, along_x: Any, along_u: Any) -> Any:
        def number(t: Any, x: Any, u: Any) -> Any:
            return guards(events, Values(t, x, u, vector.packed(p), d))

        return jax.jvp(number, (t, x, u), (jnp.ones_like(t), along_x, along_u))[1]

    return {
        "conditions": lambda *given: guards(events, *sides(*given)),
        "condition_rates": condition_rates,
        "updated": lambda *given: updated(events, *sides(*given[:-2]), *given[-2:]),
        "jumped": lambda *given: jumped(events, *sides(*given)),
    }


def constants(precision: str) -> Iterator[str]:
    """The limits of event iteration and search, those of `acausal.simulate` in this precision."""
    reals = {
        "CLOSE": CLOSE,
        "BAND": BAND,
        "NEAR": NEAR,
        "DEADBAND_GROWTH": DEADBAND_GROWTH,
        "COINCIDE": coincide(precision),
    }
    counts = {
        "TRIES": TRIES,
        "CHATTERING": CHATTERING,
        "BY_RATES": BY_RATES,
        "PASSES": PASSES,
        "ALL_AT_ONCE": ALL_AT_ONCE,
        "DOUBTED": DOUBTED,
        "FORCED": FORCED,
        "ONE_BY_ONE": ONE_BY_ONE,
        "STARTS_IN_TURN": STARTS,
    }
    yield from (f"#define {name} R({value!r})" for name, value in reals.items())
    yield f"enum {{ {', '.join(f'{name} = {count}' for name, count in counts.items())} }};"


def tables(events: Events) -> Iterator[str]:
    """What is known of the conditions."""
    yield f"enum {{ GUARDS = {events.n_guards}, DISCRETE = {len(events.exact)}, POINTS = 5 }};"
    yield f"enum {{ ANY_TIMED = {int(events.timed.any())} }};"
    yield f"enum {{ RESETS = {len(events.resets)} }};"
    pairs = [f"{{{condition}, {edge}}}" for condition, edge in events.resets.tolist()] or ["{0}"]
    yield f"static const int resets[][2] = {{{', '.join(pairs)}}};"
    for name in ("strict", "timed", "ticks"):
        flags: np.ndarray = getattr(events, name)
        written = [str(int(flag)) for flag in flags.tolist()] or ["0"]
        rows = [", ".join(written[i : i + 30]) for i in range(0, len(written), 30)]
        yield f"static const unsigned char {name}[] = {{"
        yield from (f"    {row}," for row in rows)
        yield "};"
