"""Regularizers: penalties that a training minimises besides the loss.

A regularizer is any callable ``(params, context) -> scalar`` that JAX can trace. Outputs of networks are
taken relative to their ``output_scale``, so that weights are pure numbers. For a network that is an energy, the law
counts: the energy's derivative.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy.typing import ArrayLike

from acausal._jax import is_real, traced
from acausal.errors import TrainingError, known_name, shown
from acausal.modeling import by_name, names_in
from acausal.networks import inputs_of, law_of, output_scale

if TYPE_CHECKING:
    from acausal.system import System


Network = Callable[..., Any]
"""A module that is called with scalars and returns a scalar."""


class Trajectory(eqx.Module):
    """The trajectory of a model over the record: as measured, else as simulated before training.

    Attributes:
        system: the model.
        t, x, u, d: samples of time, states, inputs and discrete variables.
    """

    system: System = eqx.field(static=True)
    t: Float[Array, " N"]
    x: Float[Array, "N n_states"]
    u: Float[Array, "N n_inputs"]
    d: Float[Array, "N n_discrete"] | None = None


class Context(eqx.Module):
    """The arguments of a regularizer besides the parameters.

    Attributes:
        networks: names of the networks that are trained.
        arguments: by network, the arguments it is called with over the record.
        trajectory: the model over the record.
    """

    networks: tuple[str, ...] = eqx.field(static=True)
    arguments: Mapping[str, Float[Array, "N n_arguments"]]
    trajectory: Trajectory | None = None


Regularizer = Callable[[Mapping[str, Any], Context], Float[Array, ""]]


class Weighted(eqx.Module):
    """Base of regularizers whose fields are numbers, and names that are static; others they check themselves.

    Raises:
        TrainingError: for what is no number.
    """

    def __check_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            if each.metadata.get("static") or isinstance(value, Mapping | None) or traced(value):
                continue
            if not (is_real(value) and np.ndim(value) == 0 and _fits(value)):
                raise TrainingError(
                    f"{type(self).__name__}: {each.name}={shown(value)}; give a number."
                )
            if each.name == "weight" and value < 0:
                raise TrainingError(
                    f"{type(self).__name__}: weight={shown(value)} rewards; give a positive number."
                )


def _fits(value: Any) -> bool:
    try:
        return not np.isnan(float(value))
    except OverflowError:
        return False


def chosen_names(given: Any) -> tuple[str, ...] | None:
    """Names of networks or states; ``None`` for all."""
    return None if given is None else names_in(given, "a regularizer")


class ZeroCrossing(Weighted):
    """Networks should vanish at zero: ``weight · Σ F(0)²``, the paper's (4).

    A network with secondary arguments T is held at zero for all of them: the mean over samples of
    ``F(0, T_i)²``, the paper's (6).

    Attributes:
        weight: the paper's λ, for outputs relative to their scale.
        networks: which; ``None`` means all that are trained.
        secondary: by network, samples of its secondary arguments, shape (N, number of them); by default
            those that occur over the record.
    """

    weight: float = 0.01
    networks: tuple[str, ...] | None = eqx.field(static=True, default=None, converter=chosen_names)
    secondary: Mapping[str, ArrayLike] | None = None

    def __call__(self, params: Mapping[str, Any], context: Context) -> Float[Array, ""]:
        """The penalty."""
        names = named("network", self.networks, context.networks)
        terms = [self._at_zero(name, params[name], context) for name in names]
        return self.weight * _sum(terms)

    def _at_zero(self, name: str, network: Network, context: Context) -> Float[Array, ""]:
        if name in by_name(self.secondary, "secondary", "samples by network"):
            assert self.secondary is not None
            if not is_real(self.secondary[name]):
                raise TrainingError(
                    f"ZeroCrossing: secondary of '{name}' is {shown(self.secondary[name])}; give samples."
                )
            given = jnp.asarray(self.secondary[name], float)
            others = given[:, None] if given.ndim == 1 else given
        else:
            others = context.arguments[name][:, inputs_of(network) :]
        if others.shape[1] == 0:
            others = others[:1]
        zeros = jnp.zeros((len(others), inputs_of(network)))
        return _mean_square(network, jnp.concatenate([zeros, others], axis=1))


class SmallCorrection(Weighted):
    """Networks should add as little as the data allow: ``weight · Σ mean F²`` over the record.

    This prior decides what the data leave open. In the quarter vehicle, for example, a common factor on all masses, the
    tyre and the suspension's force changes no acceleration; the smallest correction selects one.

    Attributes:
        weight: of the mean square output, relative to the output's scale.
        networks: which; ``None`` means all that are trained.
    """

    weight: float = 1e-3
    networks: tuple[str, ...] | None = eqx.field(static=True, default=None, converter=chosen_names)

    def __call__(self, params: Mapping[str, Any], context: Context) -> Float[Array, ""]:
        """The penalty."""
        names = named("network", self.networks, context.networks)
        return self.weight * _sum([_mean_square(params[n], context.arguments[n]) for n in names])


def _sum(terms: list[Float[Array, ""]]) -> Float[Array, ""]:
    return jnp.sum(jnp.stack(terms)) if terms else jnp.zeros(())


def _mean_square(network: Network, arguments: Float[Array, "N n_arguments"]) -> Float[Array, ""]:
    force = jax.vmap(lambda row: law_of(network)(*row))(arguments)
    return jnp.mean((force / output_scale(network)) ** 2)


def named(kind: str, chosen: tuple[str, ...] | None, known: tuple[str, ...]) -> tuple[str, ...]:
    """The networks or states that a regularizer names; by default all.

    Raises:
        TrainingError: for another name.
    """
    for name in chosen or ():
        known_name(name, known, f"A regularizer names the {kind}", TrainingError)
    return known if chosen is None else chosen


def label(regularizer: Regularizer) -> str:
    """The name of a regularizer in histories."""
    return getattr(regularizer, "__name__", type(regularizer).__name__)
