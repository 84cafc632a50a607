"""A recipe for laws: which promises a network keeps, and how it is made to keep them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError
from acausal.networks.activations import RISING, checked
from acausal.networks.extrapolation import Continued
from acausal.networks.mlp import MLP, Key
from acausal.networks.monotone import Monotone
from acausal.networks.passive import Passive, SameSign
from acausal.networks.scaled import Scaled
from acausal.networks.slope import Steeper, start_at
from acausal.networks.spec import Net, Recipe, ZeroCrossing
from acausal.networks.symmetry import Even, Odd
from acausal.networks.zero import OffsetCorrected, ThroughZero

Shape = Callable[[Net], Net]

FREE: dict[tuple[bool, bool], Shape] = {
    (False, False): lambda net: net,
    (False, True): Odd,
    (True, False): Passive,
    (True, True): lambda net: Passive(Even(net)),
}
"""How (passive, odd) laws that need not be monotone are made."""

MONOTONE: dict[tuple[bool, bool], Shape] = {
    (False, False): lambda net: net,
    (False, True): Odd,
    (True, False): lambda net: SameSign(OffsetCorrected(net)),
    (True, True): lambda net: SameSign(Odd(net)),
}
"""How (passive, odd) monotone laws are made: one that rises through zero is passive."""

ZERO: dict[ZeroCrossing | None, Shape] = {
    None: lambda net: net,
    "regularizer": lambda net: net,
    "offset": OffsetCorrected,
    "exact": ThroughZero,
}
"""How laws without any other promise come to vanish at zero."""


@dataclass(frozen=True, kw_only=True)
class Law(Recipe):
    """A recipe for a law ``F(x, T, ...)`` of one input ``x`` and secondary inputs ``T``.

    ``ac.networks.Law(passive=True)(key)`` is a module that is called with scalars. Without any promise it is the
    paper's network, an `MLP`.

    Attributes:
        passive: ``F(x, T) x ≥ 0``.
        monotone: ``∂F/∂x ≥ 0``, at least ``floor``.

    The attributes of `Recipe` come on top. Every promise holds for all weights, and so before, during and after
    training.

    Raises:
        DeclarationError: in one sentence, for promises that do not go together.
    """

    passive: bool = False
    monotone: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("passive", "odd"):
            if getattr(self, name):
                self.refuse_regularizer(name)
        for name in ("floor", "start"):
            if getattr(self, name) and not self.monotone:
                raise DeclarationError(
                    f"{name}=... is a slope of a monotone law; say monotone=True, too"
                )

    @property
    def in_size(self) -> int:
        """Number of all inputs."""
        return 1 + self.secondary

    @property
    def rho(self) -> str:
        """The activation: by default ReLU, as in the paper."""
        if self.monotone:
            return checked(self.activation or "relu", RISING, "a monotone network")
        return checked(self.activation or "relu")

    @property
    def vanishes(self) -> bool:
        """Whether the law is zero at zero by construction."""
        return self.passive or self.odd or self.zero_crossing in ("offset", "exact")

    def __call__(self, key: Key) -> Any:
        """A network with fresh weights."""
        own: dict[str, Any] = {
            "width": self.width,
            "depth": self.depth,
            "activation": self.rho,
            "key": key,
        }
        if not (self.monotone or self.vanishes or self.extrapolation):
            scales: dict[str, Any] = {
                "input_scale": self.input_scale,
                "output_scale": self.output_scale,
            }
            return MLP(self.in_size, **own, **scales)
        net = self._monotone(own) if self.monotone else self._free(own)
        passive = self.passive or (self.monotone and self.zero_crossing == "exact")
        net = self.continued(net, Continued, rising=passive)
        return Scaled(net, self.input_scale, self.output_scale)

    def _free(self, own: dict[str, Any]) -> Net:
        net = MLP(self.in_size, **own)
        if self.passive or self.odd:
            return FREE[self.passive, self.odd](net)
        return ZERO[self.zero_crossing](net)

    def _monotone(self, own: dict[str, Any]) -> Net:
        net: Net = Monotone(self.secondary, **own)
        if self.floor or self.start:
            net = Steeper(net, self.floor, start_at(self.start))
        if self.zero_crossing == "offset":
            return OffsetCorrected(net)
        return MONOTONE[self.passive or self.zero_crossing == "exact", self.odd](net)
