"""What the recipes of laws and energies share: sizes, scales, and how they go on beyond the data."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, get_args

from acausal.errors import DeclarationError
from acausal.networks.extrapolation import Extrapolation, check_limits
from acausal.networks.mlp import Scale, check_sizes

ZeroCrossing = Literal["regularizer", "offset", "exact"]
Net = Callable[..., Any]

KNOWN = 3.0
"""So many input scales from zero the data are taken to reach, where no limits are given."""


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """How to make a network with promises; called with a key it makes one with fresh weights.

    Attributes:
        secondary: number of further inputs, after those that the promises are about.
        width, depth: neurons in each hidden layer, and hidden layers.
        activation: of the hidden layers, by name; ``None`` takes the default.
        input_scale: magnitude of the inputs: one number, or one for each.
        output_scale: magnitude of the law.
        odd: the law is odd, ``F(−x) = −F(x)``; its energy is even.
        zero_crossing: how the law comes to vanish at zero: by a ``"regularizer"`` in training, that is by itself not at
            all; by correction of its ``"offset"``, ``F(x) − F(0)``; or ``"exact"``, to the last bit. ``None`` is what
            the other promises imply.
        extrapolation: how the law goes on beyond the limits: ``"saturating"`` held, ``"linear"`` along its tangent,
            ``"cubic"`` along the ``F(0) + a x + b x³`` with its value and slope there, `Continued`.
        limits: of the first input, in its unit: a pair, or one number for both sides. The default is three input
            scales.
        floor: the least slope of a monotone law, relative to ``output_scale / input_scale``.
        start: a slope that a fresh monotone law has besides, likewise, and that is trained. A law that is divided by
            had better not start near zero.
    """

    secondary: int = 0
    width: int = 16
    depth: int = 2
    activation: str | None = None
    input_scale: Scale = 1.0
    output_scale: float = 1.0
    odd: bool = False
    zero_crossing: ZeroCrossing | None = None
    extrapolation: Extrapolation | None = None
    limits: tuple[float, float] | float | None = None
    floor: float = 0.0
    start: float = 0.0

    def __post_init__(self) -> None:
        for name, known in (("zero_crossing", ZeroCrossing), ("extrapolation", Extrapolation)):
            value, choices = getattr(self, name), get_args(known)
            if value is not None and value not in choices:
                raise DeclarationError(
                    f"{name}={value!r} is none of {', '.join(map(repr, choices))}"
                )
        check_sizes(self.in_size, self.width, self.depth, self.input_scale)
        scales = self.input_scale if isinstance(self.input_scale, tuple) else (self.input_scale,)
        if not all(0 < s < math.inf for s in (*scales, self.output_scale)):
            raise DeclarationError(
                "input_scale and output_scale are magnitudes; give positive numbers"
            )
        for name, slope in (("floor", self.floor), ("start", self.start)):
            if not 0 <= slope < math.inf:
                raise DeclarationError(f"{name}={slope} is a slope; give zero or more")
        if self.limits is not None and self.extrapolation is None:
            raise DeclarationError(
                "limits=... says where a law is continued; say how by extrapolation='linear' or another"
            )
        _ = self.rho, self.range

    @property
    def in_size(self) -> int:
        """Number of all inputs."""
        raise NotImplementedError

    @property
    def rho(self) -> str:
        """The activation.

        Raises:
            DeclarationError: for one that the promises do not allow.
        """
        raise NotImplementedError

    @property
    def range(self) -> tuple[float, float]:
        """Between which values of the first input, relative to its scale, the data lie.

        Raises:
            DeclarationError: for limits that are none, or that a promise does not allow.
        """
        scale = self.input_scale[0] if isinstance(self.input_scale, tuple) else self.input_scale
        limits = self.limits
        if limits is None:
            return -KNOWN, KNOWN
        low, high = (limits[0], limits[1]) if isinstance(limits, tuple) else (-limits, limits)
        if self.extrapolation:
            check_limits(low, high, self.extrapolation)
        if self.odd and low != -high:
            raise DeclarationError(
                f"limits={limits}: an odd law needs symmetric limits; give limits={max(-low, high):g}"
            )
        if self.vanishes and not low <= 0 <= high:
            raise DeclarationError(
                f"limits={limits}: a law that vanishes at zero needs zero between its limits"
            )
        return low / scale, high / scale

    @property
    def vanishes(self) -> bool:
        """Whether the law is zero at zero by construction."""
        raise NotImplementedError

    def continued(self, net: Net, beyond: Callable[..., Net], **more: Any) -> Net:
        """The network, continued beyond the limits by `Continued` or the like if that is wanted."""
        if self.extrapolation is None:
            return net
        return beyond(net, *self.range, self.extrapolation, **more)

    def refuse_regularizer(self, because: str) -> None:
        """A law that vanishes by construction leaves nothing to a regularizer or a correction.

        Raises:
            DeclarationError: if the zero crossing is to come from one of them.
        """
        if self.zero_crossing in ("regularizer", "offset"):
            raise DeclarationError(
                f"{because}=True makes the law vanish at zero already; leave out zero_crossing={self.zero_crossing!r}"
            )
