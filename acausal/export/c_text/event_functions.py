"""What holds at events, traced: conditions, discrete variables, jumps of states."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import jax
import jax.numpy as jnp

from acausal.codegen import Events, Values, guards, jumped, updated
from acausal.export.c_text.statements import Buffer
from acausal.export.vector import ParameterVector

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

    def values(t: Any, x: Any, u: Any, p: Any, d: Any) -> Values:
        return Values(t, x, u, vector.packed(p), d)

    def conditions(t: Any, x: Any, u: Any, p: Any, d: Any, x_before: Any, d_before: Any) -> Any:
        now = values(t, x, u, p, d)
        return guards(events, now, now._replace(x=x_before, d=d_before))

    def condition_rates(t: Any, x: Any, u: Any, p: Any, d: Any, along_x: Any, along_u: Any) -> Any:
        def number(t: Any, x: Any, u: Any) -> Any:
            return guards(events, values(t, x, u, p, d))

        return jax.jvp(number, (t, x, u), (jnp.ones_like(t), along_x, along_u))[1]

    def next_d(
        t: Any,
        x: Any,
        u: Any,
        p: Any,
        d: Any,
        x_before: Any,
        d_before: Any,
        holds: Any,
        initial: Any,
    ) -> Any:
        now = values(t, x, u, p, d)
        return updated(events, now, now._replace(x=x_before, d=d_before), holds, initial)

    def next_x(t: Any, x: Any, u: Any, p: Any, d: Any, x_before: Any, d_before: Any) -> Any:
        now = values(t, x, u, p, d)
        return jumped(events, now, now._replace(x=x_before, d=d_before))

    return {
        "conditions": conditions,
        "condition_rates": condition_rates,
        "updated": next_d,
        "jumped": next_x,
    }


def event_buffers(events: Events, states: int, inputs: int) -> dict[str, Buffer]:
    """The arrays of `ARGUMENTS`, by name."""
    sizes = {
        "x_before": states,
        "d_before": len(events.exact),
        "along_x": states,
        "along_u": inputs,
        "holds": events.n_guards,
        "number": events.n_guards,
        "rate": events.n_guards,
        "next_d": len(events.exact),
        "next_x": states,
    }
    return {name: Buffer(name, "real", size) for name, size in sizes.items()} | {
        "initial": Buffer("initial", "real", None)
    }
