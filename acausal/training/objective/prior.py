"""The prior of a training: what an earlier one knew about laws and parameters.

It is a normal density about the earlier result, with the covariance of its confidence: of parameters, and of laws as
functions, whatever the networks behind them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.errors import TrainingError, known_name
from acausal.networks import law_at

if TYPE_CHECKING:
    from acausal.training.objective.regularizers import Network


class LawPrior(eqx.Module):
    """A law as it was, and the bumps by which it may change.

    Attributes:
        points: of its first argument; ``rest``: of the others.
        values: of the law there.
        heights: gives the heights of the bumps from changes at the points.
    """

    points: Float[Array, " points"]
    rest: Float[Array, "points n_rest"]
    values: Float[Array, " points"]
    heights: Float[Array, "n_bumps points"]

    def change(self, network: Network) -> Float[Array, " n_bumps"]:
        """How far a network's law is from what it was, in heights of bumps."""
        return self.heights @ (law_at(network, self.points, self.rest) - self.values)


class Prior(eqx.Module):
    """A normal density of laws and parameters.

    Attributes:
        laws: by network.
        names: of the parameters.
        centres: their expected values; ``scales``: what a change of one means, in their units.
        root: makes uncorrelated numbers with the standard deviation 1 of all changes: of laws, then of parameters.
        alike: how many neighbouring samples were worth one independent sample; those to come count likewise.
    """

    laws: dict[str, LawPrior]
    names: tuple[str, ...] = eqx.field(static=True)
    centres: Float[Array, " n_parameters"]
    scales: Float[Array, " n_parameters"]
    root: Float[Array, "n n"]
    alike: Float[Array, ""]

    def misfit(self, params: Mapping[str, Any]) -> Float[Array, " n"]:
        """How far parameters and laws are from what is expected, in independent standard deviations."""
        laws = [law.change(params[name]) for name, law in self.laws.items()]
        values = [jnp.asarray(params[name]) for name in self.names]
        moved = [(v - c) / s for v, c, s in zip(values, self.centres, self.scales, strict=True)]
        return self.root @ jnp.concatenate([*laws, *(m[None] for m in moved)])

    def log_prior(self, params: Mapping[str, Any]) -> Float[Array, ""]:
        """Minus the logarithm of the density, up to a constant, counted as the samples are."""
        return 0.5 * self.alike * jnp.sum(self.misfit(params) ** 2)


class _Knowing(Protocol):
    @property
    def prior(self) -> Prior: ...


class Earlier(Protocol):
    """An earlier training, such as a `Fit`."""

    @property
    def params(self) -> Mapping[str, Any]:
        """Its result."""
        ...

    def confidence(self) -> _Knowing:
        """What it knew."""
        ...


def entry(made: Mapping[str, Any], earlier: Earlier | None) -> dict[str, Any]:
    """The parameters where a training starts: as made for the model, or as an earlier one has left them."""
    known = {} if earlier is None else earlier.params
    return {name: known.get(name, value) for name, value in made.items()}


def prior_of(earlier: Earlier | None, params: Mapping[str, Any]) -> Prior | None:
    """What an earlier training knew.

    Raises:
        TrainingError: if the model has other parameters, or the earlier one diverges over its record.
    """
    if earlier is None:
        return None
    found = earlier.confidence().prior
    for name in (*found.laws, *found.names):
        known_name(name, params, "prior: it knows", TrainingError, ", which the model has not:")
    return found
