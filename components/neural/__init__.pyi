"""Neural elements of any domain: two-ports whose law is a small network, with promises that it keeps.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import (
    planar as _planar,
    rotational as _rotational,
    thermal as _thermal,
    translational as _translational,
)

__all__ = [
    "BearingFriction",
    "Bushing",
    "Characteristic",
    "Compliance",
    "CompliancePort",
    "Hysteresis",
    "Inductance",
    "LossyTransformer",
    "MultiportCompliance",
    "PartialFrictionCurve",
    "PartialLaw",
    "PartialNetwork",
    "PartialNeural",
    "PartialTwoPort",
    "Resistance",
    "SupportFriction",
    "Tyre",
]

class PartialNetwork(ac.Component):
    """An element with a network, and the options of it that all such elements have."""

    width: ClassVar[ac.Option]
    """neurons in each hidden layer"""
    depth: ClassVar[ac.Option]
    """hidden layers"""
    activation: ClassVar[ac.Option]
    """of the hidden layers, by name; None takes the default"""
    input_scale: ClassVar[ac.Option]
    """magnitude of the inputs, one number or one for each; None takes it from the data"""
    output_scale: ClassVar[ac.Option]
    """magnitude of the output; None takes it from the data"""
    net: ClassVar[ac.Module]
    """the law"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialTwoPort(ac.Component):
    """Two connectors and the variables between them, under the names of their domain."""
    def __init__(self, connector: type[ac.Connector] = ..., **modifiers: Any) -> None: ...

class CompliancePort(PartialTwoPort):
    """A port of a `MultiportCompliance`: two connectors of one domain, and its displacement ``x``."""
    def __init__(self, connector: type[ac.Connector] = ..., **modifiers: Any) -> None: ...

class MultiportCompliance(PartialNetwork):
    """A neural compliance of several ports: one energy, ``E = net(x_1, x_2, ...)``, and its gradient."""

    odd: ClassVar[ac.Option]
    """the same from both sides"""
    passive: ClassVar[ac.Option]
    """the energy is never negative, and zero at zero"""
    convex: ClassVar[ac.Option]
    """the energy is convex"""
    floor: ClassVar[ac.Option]
    """least curvature of a convex energy, relative to that of the scales"""
    ports: list[CompliancePort]
    def __init__(
        self,
        connectors: Sequence[type[ac.Connector]] = ...,
        *,
        secondary: Sequence[str] = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        passive: bool = ...,
        convex: bool = ...,
        floor: Any = ...,
        net: Callable[..., Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PartialFrictionCurve(PartialNetwork):
    """Base of friction whose curve is a network ``net`` of the speed, positive for all weights."""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialLaw(PartialNetwork):
    """Base of elements whose network is a law of one input, and of secondary inputs."""

    odd: ClassVar[ac.Option]
    """the law is odd: the same from both sides"""
    extrapolation: ClassVar[ac.Option]
    """how the law goes on beyond the limits"""
    limits: ClassVar[ac.Option]
    """of the first input, a pair or one number; by default three input scales"""
    def __init__(self, **modifiers: Any) -> None: ...

class Bushing(PartialNetwork, _planar.PartialTwoFrames):
    """A neural bushing: an elastic and damping joint between two frames, as of rubber."""

    odd: ClassVar[ac.Option]
    """the same from both sides"""
    passive: ClassVar[ac.Option]
    """the energy is never negative, and zero at zero"""
    convex: ClassVar[ac.Option]
    """the energy is convex"""
    floor: ClassVar[ac.Option]
    """least curvature of a convex energy, relative to that of the scales"""
    rate_scale: ClassVar[ac.Option]
    """magnitude of the rates, one number or one for each"""
    loss_scale: ClassVar[ac.Option]
    """magnitude of the first damping effort"""
    loss: ClassVar[ac.Module]
    """the dissipation, half of what is lost where it is quadratic"""
    u: ClassVar[ac.Variable]
    """displacements along x and y of frame_a, and angle"""
    v: ClassVar[ac.Variable]
    """their rates"""
    e: ClassVar[ac.Variable]
    """forces along x and y of frame_a, and torque, at frame_b"""
    E: ClassVar[ac.Variable]
    """stored energy [J]"""
    lossPower: ClassVar[ac.Variable]
    """power that is lost [W]"""
    def __init__(
        self,
        *,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        passive: bool = ...,
        convex: bool = ...,
        floor: Any = ...,
        rate_scale: Any = ...,
        loss_scale: Any = ...,
        net: Callable[..., Any] = ...,
        loss: Callable[..., Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        frame_b: Mapping[str, Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        e: ac.Start | Mapping[str, Any] = ...,
        E: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Characteristic(PartialLaw):
    """A learned characteristic between signals: ``y = net(u)``."""

    monotone: ClassVar[ac.Option]
    """the characteristic never falls"""
    zero_crossing: ClassVar[ac.Option]
    """how it comes to vanish at 0"""
    floor: ClassVar[ac.Option]
    """least derivative of a monotone characteristic, relative to that of the scales"""
    start: ClassVar[ac.Option]
    """derivative that a new monotone characteristic has in addition, relative likewise; it is trained"""
    u: ClassVar[ac.Input]
    """input signal"""
    y: ClassVar[ac.Output]
    """output signal"""
    def __init__(
        self,
        *,
        secondary: int | Sequence[str] = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        extrapolation: Literal[None, "saturating", "linear", "cubic"] = ...,
        limits: Any = ...,
        monotone: bool = ...,
        zero_crossing: Literal[None, "regularizer", "offset", "exact"] = ...,
        floor: Any = ...,
        start: Any = ...,
        net: Callable[..., Any] = ...,
        u: ac.Start | Mapping[str, Any] = ...,
        y: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Hysteresis(PartialTwoPort, PartialNetwork):
    """A neural hysteresis with an internal state ``z``, after Bouc and Wen; passive for all weights."""

    input_scale: ClassVar[ac.Option]
    """magnitude of the inputs, one number or one for each"""
    output_scale: ClassVar[ac.Option]
    """magnitude of the output"""
    odd: ClassVar[ac.Option]
    """the same in both directions"""
    memory: ClassVar[ac.Module]
    """how fast the memory fades"""
    z: ClassVar[ac.Variable]
    """what the element remembers"""
    def __init__(
        self,
        connector: type[ac.Connector] = ...,
        *,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        net: Callable[..., Any] = ...,
        memory: Callable[..., Any] = ...,
        z: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class LossyTransformer(PartialNetwork, _thermal.PartialElementaryConditionalHeatPortWithoutT):
    """A transformer with a learned efficiency map: a gear, a motor, a rack; what is lost leaves as heat."""

    input_scale: ClassVar[ac.Option]
    """magnitude of the inputs, one number or one for each"""
    output_scale: ClassVar[ac.Option]
    """magnitude of the output"""
    ratio: ClassVar[ac.Parameter]
    """rate at a over rate at b"""
    P_small: ClassVar[ac.Parameter]
    """power around which the direction changes [W]"""
    P_a: ClassVar[ac.Variable]
    """power into port a [W]"""
    def __init__(
        self,
        connector_a: type[ac.Connector] = ...,
        connector_b: type[ac.Connector] = ...,
        *,
        secondary: Sequence[str] = ...,
        ratio: SupportsFloat | ac.Start = ...,
        P_small: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        P_a: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PartialNeural(PartialTwoPort, PartialLaw):
    """Base of neural two-ports: two connectors, the variables between them, and a network ``net``."""
    def __init__(
        self,
        connector: type[ac.Connector] = ...,
        *,
        secondary: int | Sequence[str] = ...,
        **modifiers: Any,
    ) -> None: ...

class Compliance(PartialNeural):
    """A neural spring or capacitor."""

    passive: ClassVar[ac.Option]
    """it never gives back more energy than it took"""
    monotone: ClassVar[ac.Option]
    """the law never falls; of an energy say convex"""
    convex: ClassVar[ac.Option]
    """the energy is convex"""
    zero_crossing: ClassVar[ac.Option]
    """how the law comes to vanish at 0"""
    floor: ClassVar[ac.Option]
    """least derivative of the law, relative to that of the scales"""
    def __init__(
        self,
        connector: type[ac.Connector] = ...,
        *,
        energy: bool = ...,
        secondary: int | Sequence[str] = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        extrapolation: Literal[None, "saturating", "linear", "cubic"] = ...,
        limits: Any = ...,
        passive: bool = ...,
        monotone: bool = ...,
        convex: bool = ...,
        zero_crossing: Literal[None, "regularizer", "offset", "exact"] = ...,
        floor: Any = ...,
        net: Callable[..., Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Inductance(PartialNeural):
    """A neural mass, inductor or fluid inertance: momentum as a function of flow."""

    floor: ClassVar[ac.Option]
    """least derivative of the momentum, relative to that of the scales"""
    def __init__(
        self,
        connector: type[ac.Connector] = ...,
        *,
        secondary: int | Sequence[str] = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        extrapolation: Literal[None, "saturating", "linear", "cubic"] = ...,
        limits: Any = ...,
        floor: Any = ...,
        net: Callable[..., Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Resistance(PartialNeural):
    """A neural damper or resistor."""

    passive: ClassVar[ac.Option]
    """the law has the sign of its first input"""
    monotone: ClassVar[ac.Option]
    """the law never falls"""
    zero_crossing: ClassVar[ac.Option]
    """how the law comes to vanish at 0"""
    floor: ClassVar[ac.Option]
    """least derivative of a monotone law, relative to that of the scales"""
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    heatPort: _thermal.HeatPort
    lossPower: ClassVar[ac.Variable]
    """power that leaves as heat [W]"""
    def __init__(
        self,
        connector: type[ac.Connector] = ...,
        *,
        secondary: int | Sequence[str] = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        extrapolation: Literal[None, "saturating", "linear", "cubic"] = ...,
        limits: Any = ...,
        passive: bool = ...,
        monotone: bool = ...,
        zero_crossing: Literal[None, "regularizer", "offset", "exact"] = ...,
        floor: Any = ...,
        useHeatPort: bool = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Tyre(PartialLaw, _planar.PartialSlippingWheel):
    """A wheel whose friction is learned: ``f = fN net(slip)`` against the speed of the contact."""

    input_scale: ClassVar[ac.Option]
    """magnitude of the slip, and of the load where that is an input"""
    output_scale: ClassVar[ac.Option]
    """magnitude of the friction coefficient"""
    extrapolation: ClassVar[ac.Option]
    """how the law goes on beyond the limits"""
    passive: ClassVar[ac.Option]
    """the force is never along the slip"""
    loads: ClassVar[ac.Option]
    """whether the law depends on the load"""
    N: ClassVar[ac.Parameter]
    """normal force without dynamicLoad [N]"""
    v_small: ClassVar[ac.Parameter]
    """least speed of the rim that slip is over [m/s]"""
    dynamicLoad: ClassVar[ac.Input]
    """load in addition to N [N]"""
    fN: ClassVar[ac.Variable]
    """normal force [N]"""
    slip: ClassVar[ac.Variable]
    """speed of the contact over that of the rim"""
    def __init__(
        self,
        *,
        radius: SupportsFloat | ac.Start = ...,
        r: SupportsFloat | Iterable[Any] = ...,
        N: SupportsFloat | ac.Start = ...,
        v_small: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        stateSelect: Literal["never", "avoid", "default", "prefer", "always"] = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        odd: bool = ...,
        extrapolation: Literal[None, "saturating", "linear", "cubic"] = ...,
        limits: Any = ...,
        passive: bool = ...,
        loads: bool = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        frame_a: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        dynamicLoad: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        e0: ac.Start | Mapping[str, Any] = ...,
        phi_roll: ac.Start | Mapping[str, Any] = ...,
        w_roll: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        v_long: ac.Start | Mapping[str, Any] = ...,
        f_long: ac.Start | Mapping[str, Any] = ...,
        v_lat: ac.Start | Mapping[str, Any] = ...,
        v_slip_long: ac.Start | Mapping[str, Any] = ...,
        v_slip_lat: ac.Start | Mapping[str, Any] = ...,
        v_slip: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        f_lat: ac.Start | Mapping[str, Any] = ...,
        fN: ac.Start | Mapping[str, Any] = ...,
        slip: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SupportFriction(PartialFrictionCurve, _translational.PartialSupportFriction):
    """Friction on the support with a learned curve: ``f = net(|v|)`` with the sign of ``v`` while it slides."""
    def __init__(
        self,
        *,
        v_small: SupportsFloat | ac.Start = ...,
        peak: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        useSupport: bool = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        v_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        f0: ac.Start | Mapping[str, Any] = ...,
        f0_max: ac.Start | Mapping[str, Any] = ...,
        s_a: ac.Start | Mapping[str, Any] = ...,
        s_b: ac.Start | Mapping[str, Any] = ...,
        s: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BearingFriction(PartialFrictionCurve, _rotational.PartialBearingFriction):
    """Friction in the support with a learned curve: ``tau = net(|w|)`` with the sign of ``w`` while it slides."""
    def __init__(
        self,
        *,
        peak: SupportsFloat | ac.Start = ...,
        w_small: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        smooth: bool = ...,
        useSupport: bool = ...,
        width: SupportsIndex = ...,
        depth: SupportsIndex = ...,
        activation: Any = ...,
        input_scale: Any = ...,
        output_scale: Any = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        flange_a: Mapping[str, Any] = ...,
        flange_b: Mapping[str, Any] = ...,
        support: Mapping[str, Any] = ...,
        startForward: ac.Start | Mapping[str, Any] = ...,
        locked: ac.Start | Mapping[str, Any] = ...,
        startBackward: ac.Start | Mapping[str, Any] = ...,
        mode: ac.Start | Mapping[str, Any] = ...,
        free: ac.Start | Mapping[str, Any] = ...,
        lossPower: ac.Start | Mapping[str, Any] = ...,
        sa: ac.Start | Mapping[str, Any] = ...,
        w_relfric: ac.Start | Mapping[str, Any] = ...,
        a_relfric: ac.Start | Mapping[str, Any] = ...,
        tau0: ac.Start | Mapping[str, Any] = ...,
        tau0_max: ac.Start | Mapping[str, Any] = ...,
        phi_a: ac.Start | Mapping[str, Any] = ...,
        phi_b: ac.Start | Mapping[str, Any] = ...,
        phi: ac.Start | Mapping[str, Any] = ...,
        w: ac.Start | Mapping[str, Any] = ...,
        a: ac.Start | Mapping[str, Any] = ...,
        tau: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
