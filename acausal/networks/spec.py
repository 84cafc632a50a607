"""What the specifications of laws and energies share: sizes, scales, zero crossing and extrapolation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, Literal, TypedDict, get_args

from acausal._jax import is_number
from acausal.errors import DeclarationError, need_flag, need_whole, shown
from acausal.networks.activations import ACTIVATIONS, checked
from acausal.networks.extrapolation import Extrapolation, check_limits
from acausal.networks.mlp import Key, Scale, check_sizes

ZeroCrossing = Literal["regularizer", "offset", "exact"]
Net = Callable[..., Any]


class Layers(TypedDict):
    """Arguments that all networks of layers take."""

    width: int
    depth: int
    activation: str
    key: Key


KNOWN = 3.0
"""Without limits, the data are assumed to reach this many input scales from zero."""


@dataclass(frozen=True, kw_only=True)
class NetworkSpec:
    """The specification of a network and of the promises that it keeps; called with a key it makes a fresh network.

    Attributes:
        passive: the element never gives back more energy than it took, see `Law` and `Energy`.
        secondary: number of further inputs, after those that the promises apply to.
        width, depth: neurons in each hidden layer, and hidden layers.
        activation: of the hidden layers, by name; ``None`` takes the default.
        input_scale: magnitude of the inputs: one number, or one for each. By default `acausal.fit` takes it from the
            data; until then it is 1.
        output_scale: magnitude of the law, likewise.
        odd: the law is odd, ``F(−x) = −F(x)``; its energy is even.
        zero_crossing: why the law vanishes at zero: a ``"regularizer"`` penalizes its offset in training, and the
            network itself does nothing; its ``"offset"`` is subtracted, ``F(x) − F(0)``; or it is ``"exact"``, zero by
            construction. ``None`` leaves it to the other promises.
        extrapolation: of the law beyond the limits: ``"saturating"`` is constant, ``"linear"`` follows its tangent,
            ``"cubic"`` the ``F(0) + a x + b x³`` with its value and derivative there, `Continued`.
        limits: of the first input, in its unit: a pair, or one number for both sides. The default is three input
            scales.
        floor: the minimum derivative of a monotone law, relative to ``output_scale / input_scale``.
        start: added to the derivative of a fresh monotone law, in the same unit, and trained. If a model divides by
            the law's derivative, it should not start near zero.
    """

    passive: bool = False
    secondary: int = 0
    width: int = 16
    depth: int = 2
    activation: str | None = None
    input_scale: Scale | None = None
    output_scale: float | None = None
    odd: bool = False
    zero_crossing: ZeroCrossing | None = None
    extrapolation: Extrapolation | None = None
    limits: tuple[float, float] | float | None = None
    floor: float = 0.0
    start: float = 0.0

    def __post_init__(self) -> None:
        for name, known in (("zero_crossing", ZeroCrossing), ("extrapolation", Extrapolation)):
            value, choices = getattr(self, name), get_args(known)
            if value is not None and not (isinstance(value, str) and value in choices):
                raise DeclarationError(
                    f"{name}={shown(value)} must be one of {', '.join(map(repr, choices))}"
                )
        need_whole(self.secondary, "secondary", DeclarationError, 0)
        for each in fields(self):
            if isinstance(each.default, bool):
                need_flag(getattr(self, each.name), each.name, DeclarationError)
        inner, outer = self.scales
        check_sizes(self.in_size, self.width, self.depth, inner, outer)
        for name, value in (("floor", self.floor), ("start", self.start)):
            if not (is_number(value) and value >= 0):
                raise DeclarationError(
                    f"{name}={shown(value)} is a derivative of an increasing law; give zero or more"
                )
        limits = self.limits if isinstance(self.limits, tuple) else (self.limits,) * 2
        if self.limits is not None and not (len(limits) == 2 and all(map(is_number, limits))):
            raise DeclarationError(
                f"limits={shown(self.limits)}; give a number for both sides, or a pair of numbers"
            )
        if self.limits is not None and self.extrapolation is None:
            raise DeclarationError(
                "limits=... is where extrapolation begins; choose its kind, too, such as extrapolation='linear'"
            )
        _ = self.rho, self.range
        for name in ("passive", "odd"):
            if getattr(self, name) and self.zero_crossing in ("regularizer", "offset"):
                raise DeclarationError(
                    f"{name}=True makes the law vanish at zero already; leave out "
                    f"zero_crossing={shown(self.zero_crossing)}"
                )
        for name in ("floor", "start"):
            if getattr(self, name):
                self.check_bound(name)

    def activation_of(
        self, default: str, allowed: tuple[str, ...] = tuple(ACTIVATIONS), use: str = ""
    ) -> str:
        """The activation that was given, or the default, if it is one of those allowed."""
        return checked(default if self.activation is None else self.activation, allowed, use)

    @property
    def scales(self) -> tuple[Scale, float]:
        """Magnitudes of inputs and law; 1 where none is given."""
        inner, outer = self.input_scale, self.output_scale
        return 1.0 if inner is None else inner, 1.0 if outer is None else outer

    @property
    def left_open(self) -> tuple[str, ...]:
        """The arguments that were not given, and that a training may choose."""
        names = ("activation", "input_scale", "output_scale", "limits")
        return tuple(name for name in names if getattr(self, name) is None)

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
        """The range of the first input in the data, relative to its scale.

        Raises:
            DeclarationError: for limits that do not enclose an interval, or that a promise does not allow.
        """
        inner, _ = self.scales
        scale = inner[0] if isinstance(inner, tuple) else inner
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
        return self.passive or self.odd or self.zero_crossing in ("offset", "exact")

    def check_bound(self, name: str) -> None:
        """Check that the law or energy can have a ``floor`` or ``start``.

        Raises:
            DeclarationError: if it cannot.
        """
        raise NotImplementedError

    def layers(self, key: Key) -> Layers:
        """Arguments for all networks of layers."""
        return {"width": self.width, "depth": self.depth, "activation": self.rho, "key": key}

    def continued(self, net: Net, continuation: Callable[..., Net], **more: bool) -> Net:
        """The network, extrapolated beyond the limits by `Continued` or `ContinuedEnergy` if the user chose that."""
        if self.extrapolation is None:
            return net
        return continuation(net, *self.range, self.extrapolation, **more)
