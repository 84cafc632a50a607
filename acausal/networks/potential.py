"""A recipe for energies: a law that is the slope of one has no way to create any."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError
from acausal.networks.activations import SMOOTH, SMOOTH_AND_CONVEX, checked
from acausal.networks.convex import Convex
from acausal.networks.energy import Bowl, FromRest, Levelled
from acausal.networks.extrapolation import ContinuedEnergy
from acausal.networks.mlp import MLP, Key
from acausal.networks.scaled import Potential
from acausal.networks.slope import Rounder, start_at
from acausal.networks.spec import Net, Recipe
from acausal.networks.symmetry import Even

Shape = Callable[[Net, int], Net]

FREE: dict[tuple[bool, bool], Shape] = {
    (False, False): FromRest,
    (False, True): lambda net, n: FromRest(Even(net, n), n),
    (True, False): Bowl,
    (True, True): lambda net, n: Bowl(Even(net, n), n),
}
"""How energies of (passive, odd) laws are made that need not be convex."""

CONVEX: dict[tuple[bool, bool], Shape] = {
    (False, False): FromRest,
    (False, True): lambda net, n: FromRest(Even(net, n), n),
    (True, False): Levelled,
    (True, True): lambda net, n: FromRest(Even(net, n), n),
}
"""How convex energies are made: one that is level at zero is least there, and so is an even one."""


@dataclass(frozen=True, kw_only=True)
class Energy(Recipe):
    """A recipe for an energy ``W(x, T, ...)`` of one or several inputs ``x``, with ``W(0, T) = 0``.

    The law is its slope, ``∂W/∂x``: what is done along any closed path at constant ``T`` is zero. ``output_scale`` is
    the magnitude of the law of the first input, so that of the energy is ``output_scale · input_scale``.

    Attributes:
        inputs: number of inputs ``x``.
        passive: ``W ≥ 0``, and no force at ``x = 0``: the element never gives back more than it took.
        convex: ``W`` is convex in ``x``, its curvature at least ``floor``: the law is monotone, a rest position stable.

    The attributes of `Recipe` come on top. Every promise holds for all weights, and so before, during and after
    training.

    Raises:
        DeclarationError: in one sentence, for promises that do not go together.
    """

    inputs: int = 1
    passive: bool = False
    convex: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("passive", "odd"):
            if getattr(self, name):
                self.refuse_regularizer(name)
        for name in ("floor", "start"):
            if getattr(self, name) and not self.convex:
                raise DeclarationError(
                    f"{name}=... is a curvature of a convex energy; say convex=True, too"
                )
        if self.extrapolation and self.inputs > 1:
            raise DeclarationError("extrapolation=... is for energies of one input; leave it out")
        if self.extrapolation and self.passive and not self.convex:
            raise DeclarationError(
                "a passive energy may turn downwards at its limits; say convex=True, too, or leave out extrapolation"
            )

    @property
    def in_size(self) -> int:
        """Number of all inputs."""
        return self.inputs + self.secondary

    @property
    def rho(self) -> str:
        """The activation: by default tanh, and softplus for convex energies."""
        if self.convex:
            return checked(self.activation or "softplus", SMOOTH_AND_CONVEX, "a convex energy")
        return checked(self.activation or "tanh", SMOOTH, "an energy, whose slope is the law")

    @property
    def vanishes(self) -> bool:
        """Whether the law is zero at zero by construction."""
        return self.passive or self.odd or self.zero_crossing in ("offset", "exact")

    def __call__(self, key: Key) -> Potential:
        """An energy with fresh weights."""
        own: dict[str, Any] = {
            "width": self.width,
            "depth": self.depth,
            "activation": self.rho,
            "key": key,
        }
        net = self._convex(own) if self.convex else self._free(own)
        scale = self.input_scale[0] if isinstance(self.input_scale, tuple) else self.input_scale
        net = self.continued(net, ContinuedEnergy)
        return Potential(net, self.input_scale, scale * self.output_scale, self.inputs)

    def _free(self, own: dict[str, Any]) -> Net:
        net = MLP(self.in_size, **own)
        if self.vanishes and not (self.passive or self.odd):
            return Levelled(net, self.inputs)
        return FREE[self.passive, self.odd](net, self.inputs)

    def _convex(self, own: dict[str, Any]) -> Net:
        net: Net = Convex(self.inputs, self.secondary, **own)
        if self.floor or self.start:
            net = Rounder(net, self.floor, start_at(self.start), self.inputs)
        return CONVEX[self.vanishes, self.odd](net, self.inputs)
