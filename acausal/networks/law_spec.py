"""The specification of a law: the promises that a network keeps, and the parts that keep them."""

from __future__ import annotations

from dataclasses import dataclass

from acausal.errors import DeclarationError
from acausal.networks.activations import INCREASING
from acausal.networks.extrapolation import Continued
from acausal.networks.law_parts import (
    Even,
    Odd,
    OffsetCorrected,
    Passive,
    SameSign,
    ThroughZero,
    WithMinSlope,
    start_at,
)
from acausal.networks.mlp import MLP, Key
from acausal.networks.monotone_and_convex import Monotone
from acausal.networks.scaled import Scaled
from acausal.networks.spec import Layers, Net, NetworkSpec


@dataclass(frozen=True, kw_only=True)
class Law(NetworkSpec):
    """The specification of a law ``F(x, T, ...)`` of one input ``x`` and secondary inputs ``T``.

    ``ac.networks.Law(passive=True)(key)`` is a module that is called with scalars. Without any promise it is the
    paper's network, an `MLP`.

    Attributes:
        passive: ``F(x, T) x ≥ 0``.
        monotone: ``∂F/∂x ≥ 0``, at least ``floor``.

    It also has the attributes of `NetworkSpec`. Every promise holds for all weights: before, during and after training.

    Raises:
        DeclarationError: in one sentence, for promises that contradict each other.
    """

    monotone: bool = False

    def check_bound(self, name: str) -> None:
        """Only monotone laws can have a ``floor`` or ``start``."""
        if not self.monotone:
            raise DeclarationError(
                f"{name}=... is a derivative of a monotone law; also give monotone=True"
            )

    @property
    def in_size(self) -> int:
        """Number of all inputs."""
        return 1 + self.secondary

    @property
    def rho(self) -> str:
        """The activation: by default ReLU, as in the paper."""
        if self.monotone:
            return self.activation_of("relu", INCREASING, "a monotone network")
        return self.activation_of("relu")

    def __call__(self, key: Key) -> MLP | Scaled:
        """A network with fresh weights."""
        own = self.layers(key)
        if not (self.monotone or self.vanishes or self.extrapolation):
            return MLP(
                self.in_size,
                self.width,
                self.depth,
                self.activation,
                input_scale=self.input_scale,
                output_scale=self.output_scale,
                key=key,
            )
        passive = self.passive or (self.monotone and self.zero_crossing == "exact")
        net = self._monotone(own, passive) if self.monotone else self._free(own)
        net = self.continued(net, Continued, rising=passive)
        return Scaled(net, *self.scales, left_open=self.left_open)

    def _free(self, own: Layers) -> Net:
        net = MLP(self.in_size, **own)
        if self.passive:
            return Passive(Even(net) if self.odd else net)
        if self.odd:
            return Odd(net)
        part = {"offset": OffsetCorrected, "exact": ThroughZero}.get(self.zero_crossing or "")
        return net if part is None else part(net)

    def _monotone(self, own: Layers, passive: bool) -> Net:
        net: Net = Monotone(self.secondary, **own)
        if self.floor or self.start:
            net = WithMinSlope(net, self.floor, start_at(self.start))
        if self.zero_crossing == "offset":
            return OffsetCorrected(net)
        if self.odd:
            net = Odd(net)
        elif passive:  # one that increases through zero is
            net = OffsetCorrected(net)
        return SameSign(net) if passive else net
