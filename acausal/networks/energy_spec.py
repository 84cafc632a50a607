"""The specification of an energy: a law that is its derivative cannot create energy."""

from __future__ import annotations

from dataclasses import dataclass

from acausal.errors import DeclarationError, need_whole
from acausal.networks.activations import SMOOTH, SMOOTH_AND_CONVEX
from acausal.networks.energy_parts import Bowl, Levelled, WithMinCurvature
from acausal.networks.extrapolation import ContinuedEnergy
from acausal.networks.law_parts import Even, OffsetCorrected, start_at
from acausal.networks.mlp import MLP, Key
from acausal.networks.monotone_and_convex import Convex
from acausal.networks.scaled import EnergyLaw
from acausal.networks.spec import Layers, Net, NetworkSpec


@dataclass(frozen=True, kw_only=True)
class Energy(NetworkSpec):
    """The specification of an energy ``W(x, T, ...)`` of one or several inputs ``x``, with ``W(0, T) = 0``.

    The law is its derivative, ``∂W/∂x``: the work along any closed path at constant ``T`` is zero. ``output_scale`` is
    the magnitude of the law of the first input, so that of the energy is ``output_scale · input_scale``.

    Attributes:
        inputs: number of inputs ``x``.
        passive: ``W ≥ 0``, and no force at ``x = 0``: the element never gives back more than it took.
        convex: ``W`` is convex in ``x``, its curvature at least ``floor``: the law is monotone, a rest position stable.

    It also has the attributes of `NetworkSpec`. Every promise holds for all weights: before, during and after training.

    Raises:
        DeclarationError: in one sentence, for promises that contradict each other.
    """

    inputs: int = 1
    convex: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.extrapolation and self.inputs > 1:
            raise DeclarationError("extrapolation=... is for energies of one input; leave it out")
        if self.extrapolation and self.passive and not self.convex:
            raise DeclarationError(
                "a passive energy may decrease beyond its limits; also give convex=True, or leave out extrapolation"
            )

    def check_bound(self, name: str) -> None:
        """Only convex energies can have a ``floor`` or ``start``."""
        if not self.convex:
            raise DeclarationError(
                f"{name}=... is a curvature of a convex energy; also give convex=True"
            )

    @property
    def in_size(self) -> int:
        """Number of all inputs."""
        return need_whole(self.inputs, "inputs", DeclarationError, 1) + self.secondary

    @property
    def rho(self) -> str:
        """The activation: by default tanh, and softplus for convex energies."""
        if self.convex:
            return self.activation_of("softplus", SMOOTH_AND_CONVEX, "a convex energy")
        return self.activation_of("tanh", SMOOTH, "an energy, whose derivative is the law")

    def __call__(self, key: Key) -> EnergyLaw:
        """An energy with fresh weights."""
        own = self.layers(key)
        net = self._convex(own) if self.convex else self._free(own)
        inner, outer = self.scales
        scale = inner[0] if isinstance(inner, tuple) else inner
        net = self.continued(net, ContinuedEnergy)
        return EnergyLaw(net, inner, scale * outer, self.inputs, self.left_open)

    def _free(self, own: Layers) -> Net:
        net: Net = MLP(self.in_size, **own)
        if self.vanishes and not (self.passive or self.odd):
            return Levelled(net, self.inputs)
        net = Even(net, self.inputs) if self.odd else net
        return (Bowl if self.passive else OffsetCorrected)(net, self.inputs)

    def _convex(self, own: Layers) -> Net:
        net: Net = Convex(self.inputs, self.secondary, **own)
        if self.floor or self.start:
            net = WithMinCurvature(net, self.floor, start_at(self.start), self.inputs)
        if self.odd:  # its minimum is where its derivative is zero: at zero
            return OffsetCorrected(Even(net, self.inputs), self.inputs)
        return (Levelled if self.vanishes else OffsetCorrected)(net, self.inputs)
