"""What an FMU computes, as modules that equations call, with derivatives in forward and reverse mode."""

from __future__ import annotations

from functools import partial
from typing import Any, ClassVar, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.custom_derivatives import SymbolicZero
from jaxtyping import Array, Float

from acausal._jax import HOST_FAILURES, call_host
from acausal.errors import AcausalError, SimulationError
from acausal.fmu.cosimulation import Stepped
from acausal.fmu.description import CLOCK
from acausal.fmu.model_exchange import NEVER, Evaluated
from acausal.fmu.part import Part


class FMUFunction(eqx.Module):
    """One number of those that an FMU computes at once: ``function(which, *values)``.

    Programs call an FMU once for all numbers with the same arguments: the compiler merges equal calls.

    Attributes:
        part: the FMU. kind: what is computed: a function of `Evaluated` or `Stepped`.
    """

    part: Part = eqx.field(static=True)
    kind: Literal["evaluate", "event", "begin", "step", "take"] = eqx.field(static=True)

    is_fixed: ClassVar[bool] = True
    """It is a part of the model and no parameter."""

    def __call__(self, which: Any, *values: Any) -> Float[Array, ""]:
        """The number at a place, counted from 0."""
        part = self.part
        number, rows = computed(part).functions[self.kind]
        kind = jnp.result_type(*values, np.float32)
        given = [jnp.asarray(v, kind) for v in values]
        if self.kind in ("take", "event"):
            known = part.open_loop or part.memory  # by what the model remembers of them
            for place, is_real in part.sampled.items():
                free = known or not is_real
                held = jax.lax.stop_gradient if free else partial(_held, part)
                given[place] = held(given[place])
        old = given[-part.n_next :] if self.kind == "event" else []
        found = _found(number, rows, *given[: len(given) - len(old)])
        if old:  # an instant that stays has the derivative that it had
            times, kept = slice(1, 1 + len(old)), jnp.stack(old)
            found = found.at[times].set(jnp.where(found[times] == kept, kept, found[times]))
        return jnp.take(found, jnp.asarray(which).astype(int))

    def why_nonfinite(self) -> str | None:
        """Why the FMU last gave no finite numbers, if it said so."""
        found = [HOST_FAILURES.pop(n) for n in computed(self.part).numbers if n in HOST_FAILURES]
        return found[0] if found else None


@partial(jax.custom_jvp, nondiff_argnums=(0,))
def _held(part: Part, u: Float[Array, ""]) -> Float[Array, ""]:
    return u


def _refuse(part: Part, at: tuple[Array], along: tuple[Any]) -> tuple[Array, Array]:
    """How an FMU depends on inputs that it took earlier is inside of it."""
    if not isinstance(along[0], SymbolicZero):
        clocked = part.kind == "me" or any(part.behind)
        whose, remedy = "which it takes at events or ticks of its clocks", ""
        if not clocked:
            whose = "whose co-simulation depends on all earlier ones"
            remedy = (
                "use it by model exchange; or say over how many communication steps gradients may go, ac.FMU(..., "
                "memory=100); or, "
            )
        raise SimulationError(
            f"FMU: the gradient goes through the inputs of '{part.description.model}', {whose}: {remedy}if nothing "
            "that is trained acts on them, ac.FMU(..., open_loop=True)."
        )
    return at[0], jnp.zeros_like(at[0])


_held.defjvp(_refuse, symbolic_zeros=True)


@partial(jax.custom_jvp, nondiff_argnums=(0, 1))
def _found(number: int, rows: int, *given: Float[Array, ""]) -> Float[Array, " rows"]:
    return call_host(number, jnp.stack(given), (rows,))


def _along(number: int, rows: int, at: tuple[Array, ...], along: tuple[Any, ...]) -> Any:
    """Only arguments that move are differentiated: each that does costs the FMU an evaluation."""
    moves = [i for i, tangent in enumerate(along) if not isinstance(tangent, SymbolicZero)]
    found = _found(number, rows, *at)
    if not moves:
        return found, jnp.zeros_like(found)
    matrix = _jacobian(number, rows, tuple(moves), jnp.stack(at))
    return found, matrix[:, np.array(moves)] @ jnp.stack([along[i] for i in moves])


_found.defjvp(_along, symbolic_zeros=True)


@partial(jax.custom_jvp, nondiff_argnums=(0, 1, 2))
def _jacobian(
    number: int, rows: int, moves: tuple[int, ...], given: Float[Array, " n"]
) -> Float[Array, "rows n"]:
    return call_host(number + 1, _with_marks(moves, given), (rows, *given.shape))


@_jacobian.defjvp
def _(
    number: int, rows: int, moves: tuple[int, ...], at: tuple[Array], along: tuple[Array]
) -> tuple[Array, Array]:
    (given,) = at
    shape = (rows, *given.shape, *given.shape)
    second = call_host(number + 2, _with_marks(moves, given), shape)
    return _jacobian(number, rows, moves, given), second @ along[0]


def _with_marks(moves: tuple[int, ...], given: Array) -> Array:
    """The arguments behind one number for each: 1 for those with respect to which derivatives are wanted."""
    return jnp.concatenate([jnp.zeros_like(given).at[np.array(moves)].set(1.0), given])


_COMPUTED: dict[str, Evaluated | Stepped] = {}


def computed(part: Part) -> Evaluated | Stepped:
    """What computes a part."""
    found = _COMPUTED.get(part.key)
    if found is None:
        found = _COMPUTED[part.key] = (Evaluated if part.kind == "me" else Stepped)(part)
    return found


def evaluated(part: Part) -> Evaluated | None:
    """What computes a part by model exchange; None where it cannot be used here, but can be looked at."""
    try:
        found = computed(part)
    except AcausalError:
        return None
    assert isinstance(found, Evaluated)
    return found


def has_events(part: Part) -> bool:
    """Whether there are events: nobody but the FMU itself knows of its time events."""
    known = part.description.variables.values()
    changes = any(
        v.type == CLOCK or (v.variability == "discrete" and v.causality in ("local", "output"))
        for v in known
    ) or any(part.description.variables[n].is_discrete_input for n in part.inputs)
    found = evaluated(part)
    return found is not None and (
        changes or part.description.indicators > 0 or found.first_event < NEVER
    )
