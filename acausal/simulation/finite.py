"""What is not finite: found in the equations, and said when it is read in a result, with the time and the variable.

While JAX traces, values are not known, and nothing can be said; it is said when the result is read outside.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import traced
from acausal.codegen import Values, said_by_modules
from acausal.errors import warn

if TYPE_CHECKING:
    from acausal.system import System

LOOKS = 11
"""At so many points along a trajectory it is looked for why conditions are undefined."""

AHEAD = (0.0, *np.geomspace(1e-6, 1.0, 7))
"""Where to look for a value that is not finite, as fractions of the time ahead."""


def explain_ahead(
    system: System, at: Callable[[ArrayLike, Array], Values], point: Values, ahead: float
) -> str | None:
    """A sentence on an equation without a finite value at a point, or within some seconds along its derivatives.

    ``at`` gives the values of the model at a time and state.
    """
    derivative = jnp.zeros_like(point.x)
    for h in AHEAD:
        values = at(point.t + h * ahead, point.x + h * ahead * derivative)
        if reason := system.explain_nonfinite(values):
            return reason
        if h == 0.0:
            derivative = system.rates(values)
    return None


def warn_of_nonfinite(
    system: System, values: Values, read: Mapping[str, Float[Array, " n"]]
) -> None:
    """Warn if a variable that is read along a trajectory of n points is not finite everywhere."""
    if traced(values, read) or np.ndim(values.t) != 1:
        return
    bad = {n: ~np.isfinite(np.asarray(v)) for n, v in read.items()}
    first = {n: int(np.argmax(rows)) for n, rows in bad.items() if rows.any()}
    if not first:
        return
    name = min(first, key=lambda n: first[n])
    k, ts = first[name], np.asarray(values.t)
    others = f" (and {len(first) - 1} more)" if len(first) > 1 else ""
    where = f"'{name}'{others} is {float(read[name][k])} first at t = {ts[k]:g} s"
    warn(
        f"{where}, and at {int(bad[name].sum())} of {len(ts)} times. {_reason(system, values, name, k)}"
    )


def warn_of_undefined(system: System, values: Values, steps: int) -> None:
    """Warn that conditions of events had no value in some steps along a trajectory of n points."""
    ts = np.asarray(values.t)
    for k in dict.fromkeys(np.linspace(0, len(ts) - 1, LOOKS).astype(int).tolist()):
        if reason := system.explain_nonfinite(_at(values, k), conditions=True):
            reason = f" At t = {ts[k]:g} s, {reason}"
            break
    else:
        reason = ""
    warn(
        f"Conditions of events are undefined (nan) at the end of {steps} steps, and count as false there: events are "
        f"missed.{reason}"
    )


def _reason(system: System, values: Values, name: str, k: int) -> str:
    """Why a variable is not finite at the point k of a trajectory."""
    if name in system.inputs:
        return "It is an input: check what is given for it."
    if not np.isfinite(np.asarray(values.u[k])).all():
        return f"The input '{_first_nonfinite(system.inputs, values.u[k])}' is not finite there."
    broken = not np.isfinite(np.asarray(values.x[k])).all()
    if broken and k == 0:
        return (
            f"The initial value of '{_first_nonfinite(system.states, values.x[0])}' is not finite."
        )
    if broken:
        before, ts = _at(values, k - 1), np.asarray(values.t)
        reason = explain_ahead(
            system, lambda t, x: before._replace(t=t, x=x), before, float(ts[k] - ts[k - 1])
        )
    else:
        reason = system.explain_nonfinite(_at(values, k), name)
    if reason is None and (said := said_by_modules(values.packed.modules)):
        return said
    if reason is None:
        return "The model may diverge there: check its parameters, initial values and inputs, or take a smaller dt."
    return f"{'On the way there' if broken else 'There'} {reason}"


def _at(values: Values, k: int) -> Values:
    """One point of a trajectory."""
    d = None if values.d is None else values.d[k]
    return values._replace(t=np.asarray(values.t)[k], x=values.x[k], u=values.u[k], d=d)


def _first_nonfinite(names: tuple[str, ...], row: Float[Array, " n"]) -> str:
    return names[int(np.argmax(~np.isfinite(np.asarray(row))))]
