"""Inputs that JAX cannot trace: any Python function of time, called back from the compiled steps."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from ctypes import c_double
from functools import cache
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array

from acausal._jax import HostError, call_host, is_real, register_host
from acausal.errors import DataError, shown

RELATIVE_STEP = 1e-5
"""Step of the difference quotient that gives such a function's derivative, in units of the time, at least of 1 s."""


class HostFunction(eqx.Module):
    """A function of time in plain Python, NumPy or SciPy, as an input.

    Every evaluation leaves the compiled program, for some microseconds besides its own time. It must be pure: the same
    time gives the same value. Its derivative by time is a difference quotient.
    """

    function: Callable[[float], Any]
    name: str = eqx.field(static=True)

    def __call__(self, t: ArrayLike) -> Array:
        """The function's value as a scalar array."""

        def called(t: np.ndarray) -> np.ndarray:
            return np.asarray(self.value(float(t)), t.dtype)

        @jax.custom_jvp
        def value(t: Array) -> Array:
            if jax.default_backend() == "cpu":
                return call_host(_number(self), t[None], (1,))[0]
            shape = jax.ShapeDtypeStruct((), t.dtype)
            return jax.pure_callback(called, shape, t, vmap_method="sequential")

        @value.defjvp
        def _(at: tuple[Array], along: tuple[Array]) -> tuple[Array, Array]:
            (t,), (dt,) = at, along
            h = RELATIVE_STEP * jnp.maximum(1.0, jnp.abs(t))
            return value(t), (value(t + h) - value(t - h)) / (2 * h) * dt

        at = jnp.asarray(t)
        return value(at if jnp.issubdtype(at.dtype, jnp.floating) else at.astype(float))

    def value(self, t: float) -> float:
        """The function's value at a time.

        Raises:
            DataError: for what is not a real number.
        """
        found = self.function(t)
        if not isinstance(found, float) and (not is_real(found) or np.ndim(found)):
            raise DataError(
                f"Input '{self.name}' is a function that returns {shown(found)} at {t:g} s, not a real number."
            )
        return float(found)


@cache
def _number(host: HostFunction) -> int:
    """The number by which compiled programs call it."""
    number = c_double.from_address

    def call(at: int, into: int) -> None:
        try:
            number(into).value = host.value(number(at).value)
        except Exception as error:  # of a user's code
            raise HostError(f"Input '{host.name}': {type(error).__name__}: {error}") from None

    return register_host(call)


def on_host(function: Callable[[Any], Any], name: str, start: float) -> HostFunction | None:
    """An input's function of time as one that Python calls, where JAX cannot trace it; None where it can.

    It is tried at a time, so that its errors come before the simulation.

    Raises:
        DataError: for one that does not give a real number.
    """
    try:
        jax.eval_shape(function, jax.ShapeDtypeStruct((), jnp.result_type(float)))
    except jax.errors.JAXTypeError:
        known = function if isinstance(function, Hashable) else lambda t: function(t)
        found = HostFunction(known, name)
        found.value(start)
        return found
    except Exception:  # it is raised where the input is evaluated, with a message that names it
        return None
    return None
