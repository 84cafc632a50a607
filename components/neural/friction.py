"""Neural friction: a learned curve over the speed, in a contact that locks."""

from collections.abc import Callable
from functools import partial
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.rotational.friction import PartialBearingFriction
from acausal.components.translational.friction import PartialSupportFriction

from .interfaces import PartialNetwork

_LEAST = 1e-3
"""Friction, at least, relative to the output scale: what holds nothing would never lock."""


class PartialFrictionCurve(PartialNetwork):
    """Base of friction whose curve is a network ``net`` of the speed, positive for all weights.

    It is asked for speeds ``>= 0``, so a curve that falls from rest on (Stribeck) is no harder than any other. What
    holds at rest is ``peak net(0)``: with the default ``peak=1`` all of it is learned. ``input_scale`` is a magnitude
    of the speed, ``output_scale`` of the friction, from which training starts; both are taken from the data by default.
    """

    def _spec(self) -> Callable[[Any], Any]:
        return partial(_positive, **self._sizes)

    def _curve(self, speed: Any) -> Any:
        return self.net(speed)


class SupportFriction(PartialFrictionCurve, PartialSupportFriction):
    """Friction on the support with a learned curve: ``f = net(|v|)`` with the sign of ``v`` while it slides.

    At rest it locks, up to ``f0_max = peak net(0)``, as `translational.SupportFriction` does; with ``smooth`` it
    creeps.
    """

    ICON = icons.network("fric")


class BearingFriction(PartialFrictionCurve, PartialBearingFriction):
    """Friction in the support with a learned curve: ``tau = net(|w|)`` with the sign of ``w`` while it slides.

    At rest it locks, up to ``tau0_max = peak net(0)``, as `rotational.BearingFriction` does; with ``smooth`` it creeps.
    """

    ICON = icons.network("bear")


def _positive(
    key: Any,
    *,
    width: int,
    depth: int,
    activation: str | None,
    input_scale: float | None,
    output_scale: float | None,
) -> Any:
    """A positive network that starts near the output scale."""
    net = ac.MLP(1, width, depth, activation or "tanh", key=key)
    scales = {"input_scale": input_scale, "output_scale": output_scale}
    given = {name: 1.0 if scale is None else scale for name, scale in scales.items()}
    left_open = tuple(name for name, scale in scales.items() if scale is None)
    return ac.networks.Scaled(ac.networks.Positive(net, _LEAST), **given, left_open=left_open)
