"""What an FMU computes, as modules that equations call, with derivatives in forward and reverse mode."""

from __future__ import annotations

from functools import partial
from typing import Any, ClassVar, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.fmu.handlers import FAILURES, called
from acausal.fmu.part import Part


class FMUFunction(eqx.Module):
    """One number of those that an FMU computes at once: ``function(which, *values)``.

    Programs call an FMU once for all numbers with the same arguments: the compiler merges equal calls.

    Attributes:
        part: the FMU. kind: what is computed, see `acausal.fmu.part.Computed`.
    """

    part: Part = eqx.field(static=True)
    kind: Literal["evaluate", "event", "begin"] = eqx.field(static=True)

    is_fixed: ClassVar[bool] = True
    """It is a part of the model and no parameter."""

    def __call__(self, which: Any, *values: Any) -> Float[Array, ""]:
        """The number at a place, counted from 0."""
        part = self.part
        rows = {"evaluate": part.n_values, "event": 2 + part.n, "begin": 1 + part.n}[self.kind]
        number = getattr(part.computed, self.kind)
        kind = jnp.result_type(*values, np.float32)
        found = _found(number, rows, jnp.stack([jnp.asarray(v, kind) for v in values]))
        return jnp.take(found, jnp.asarray(which).astype(int))

    def why_nonfinite(self) -> str | None:
        """Why the FMU last gave no finite numbers, if it said so."""
        found = [FAILURES.pop(n) for n in self.part.computed.numbers if n in FAILURES]
        return found[0] if found else None


@partial(jax.custom_jvp, nondiff_argnums=(0, 1))
def _found(number: int, rows: int, given: Float[Array, " n"]) -> Float[Array, " rows"]:
    return called(number, given, (rows,))


@_found.defjvp
def _(number: int, rows: int, at: tuple[Array], along: tuple[Array]) -> tuple[Array, Array]:
    return _found(number, rows, *at), _jacobian(number, rows, *at) @ along[0]


@partial(jax.custom_jvp, nondiff_argnums=(0, 1))
def _jacobian(number: int, rows: int, given: Float[Array, " n"]) -> Float[Array, "rows n"]:
    return called(number + 1, given, (rows, *given.shape))


@_jacobian.defjvp
def _(number: int, rows: int, at: tuple[Array], along: tuple[Array]) -> tuple[Array, Array]:
    second = called(number + 2, *at, (rows, *at[0].shape, *at[0].shape))
    return _jacobian(number, rows, *at), second @ along[0]
