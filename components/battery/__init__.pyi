"""Battery cells: open-circuit voltage, resistances and diffusion, whose laws over charge and temperature are learned.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, SupportsFloat, SupportsIndex

import acausal as ac
from acausal.components import electrical as _electrical, thermal as _thermal

__all__ = [
    "ChargePort",
    "ChargeStorage",
    "ChargeTransfer",
    "Diffusion",
    "OpenCircuitVoltage",
    "PartialDepending",
    "PartialDiffusion",
    "PartialLearned",
    "PartialThermal",
    "Particle",
    "Relaxation",
    "SeriesResistance",
]

class ChargePort(ac.Connector):
    """State of charge ``soc`` (0 empty, 1 full) and the current ``i`` [A] that brings charge into the component."""

    soc: ClassVar[ac.Potential]
    """state of charge at the port"""
    i: ClassVar[ac.Flow]
    """charging current into the port [A]"""

class ChargeStorage(ac.Component):
    """Charge at one state of charge: ``Q der(soc) = port.i``, ``soc = port.soc``."""

    Q: ClassVar[ac.Parameter]
    """capacity [C]"""
    soc: ClassVar[ac.Variable]
    """state of charge"""
    port: ChargePort
    def __init__(
        self,
        *,
        Q: SupportsFloat | ac.Start = ...,
        port: Mapping[str, Any] = ...,
        soc: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Particle(ac.Component):
    """A sphere that charge diffuses into from its ``surface``, in ``n`` shells: the active material of an electrode."""

    surface: ChargePort
    heatPort: _thermal.HeatPort
    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    fixed_start: ClassVar[ac.Option]
    """whether all shells start at soc_start"""
    n: ClassVar[ac.Option]
    """number of shells"""
    learned: ClassVar[ac.Option]
    """whether the time constant depends on charge by a network"""
    Q: ClassVar[ac.Parameter]
    """capacity [C]"""
    tau: ClassVar[ac.Parameter]
    """time of diffusion at T_ref [s]"""
    E_a: ClassVar[ac.Parameter]
    """activation energy of diffusion [J/mol]"""
    T_ref: ClassVar[ac.Parameter]
    """temperature at which tau holds [K]"""
    soc_start: ClassVar[ac.Parameter]
    """state of charge at the start"""
    soc: ClassVar[ac.Output]
    """mean state of charge"""
    shell: list[ChargeStorage]
    diffusion: list[Diffusion]
    def __init__(
        self,
        *,
        Q: SupportsFloat | ac.Start = ...,
        tau: SupportsFloat | ac.Start = ...,
        E_a: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        soc_start: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        fixed_start: bool = ...,
        n: SupportsIndex = ...,
        learned: bool = ...,
        surface: Mapping[str, Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        soc: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PartialThermal(_electrical.ConditionalHeatPort):
    """Base of elements that depend on the temperature by Arrhenius' law, with the activation energy ``E_a``."""

    T: ClassVar[ac.Parameter]
    """temperature without heat port [K]"""
    E_a: ClassVar[ac.Parameter]
    """activation energy [J/mol]"""
    T_ref: ClassVar[ac.Parameter]
    """temperature at which parameters hold [K]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialLearned(PartialThermal):
    """Base of elements with a positive factor: ``exp(net(soc, T_ref/T - 1))`` if it is ``learned``, else 1."""

    learned: ClassVar[ac.Option]
    """whether a network says how the element depends on charge"""
    width: ClassVar[ac.Option]
    """neurons of the network's hidden layer"""
    net: ClassVar[ac.Module]
    """logarithm of the factor"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialDepending(PartialLearned):
    """The same, where the state of charge is a signal ``soc``, if the factor is ``learned``."""

    soc: ClassVar[ac.Input]
    """state of charge"""
    def __init__(self, **modifiers: Any) -> None: ...

class PartialDiffusion(PartialLearned):
    """Base of elements between two charge ports: ``dsoc = port_a.soc - port_b.soc``, ``i`` flows from a to b."""

    port_a: ChargePort
    port_b: ChargePort
    dsoc: ClassVar[ac.Variable]
    """difference of the states of charge"""
    i: ClassVar[ac.Variable]
    """current from port_a to port_b [A]"""
    def __init__(self, **modifiers: Any) -> None: ...

class Diffusion(PartialDiffusion):
    """Charge flows to where there is less: ``i = Q dsoc / tau_actual``, faster when warm."""

    Q: ClassVar[ac.Parameter]
    """charge that flows in one time constant [C]"""
    tau: ClassVar[ac.Parameter]
    """time constant at T_ref [s]"""
    tau_actual: ClassVar[ac.Variable]
    """actual time constant [s]"""
    def __init__(
        self,
        *,
        Q: SupportsFloat | ac.Start = ...,
        tau: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        E_a: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        learned: bool = ...,
        width: SupportsIndex = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        dsoc: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        tau_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class OpenCircuitVoltage(_electrical.OnePort, PartialThermal):
    """A voltage that rises with the charge at the surface: ``v = U(surface.soc, T)``, for all weights."""

    width: ClassVar[ac.Option]
    """neurons of the networks' hidden layers"""
    U_nominal: ClassVar[ac.Parameter]
    """voltage that the curve is added to [V]"""
    net: ClassVar[ac.Module]
    """voltage at T_ref above U_nominal [V]"""
    entropy: ClassVar[ac.Module]
    """derivative by temperature [V/K]"""
    surface: ChargePort
    soc: ClassVar[ac.Input]
    """mean state of charge"""
    soc_surface: ClassVar[ac.Output]
    """state of charge at the surface"""
    U_mean: ClassVar[ac.Variable]
    """open-circuit voltage at the mean [V]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        E_a: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        U_nominal: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        width: SupportsIndex = ...,
        net: Callable[..., Any] = ...,
        entropy: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        surface: Mapping[str, Any] = ...,
        soc: ac.Start | Mapping[str, Any] = ...,
        soc_surface: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        U_mean: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ChargeTransfer(_electrical.OnePort, PartialDepending):
    """The reaction at the surfaces (Butler and Volmer, symmetric): ``v = 2 R_gas T/F asinh(i/(2 I_actual))``."""

    I_0: ClassVar[ac.Parameter]
    """exchange current at T_ref [A]"""
    I_actual: ClassVar[ac.Variable]
    """actual exchange current [A]"""
    def __init__(
        self,
        *,
        I_0: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        E_a: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        learned: bool = ...,
        width: SupportsIndex = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        soc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        I_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Relaxation(_electrical.OnePort, PartialDepending):
    """A resistance and a capacitance in parallel: ``tau der(v) = R_actual i - v``, ``LossPower = v**2/R_actual``."""

    v: ClassVar[ac.Variable]
    """voltage from p to n [V]"""
    R: ClassVar[ac.Parameter]
    """resistance at T_ref [Ohm]"""
    tau: ClassVar[ac.Parameter]
    """time constant [s]"""
    R_actual: ClassVar[ac.Variable]
    """actual resistance [Ohm]"""
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        tau: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        E_a: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        learned: bool = ...,
        width: SupportsIndex = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        soc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        R_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class SeriesResistance(_electrical.OnePort, PartialDepending):
    """A positive resistance that depends on charge and temperature: ``v = R_actual i``, ``LossPower = v i``."""

    R: ClassVar[ac.Parameter]
    """resistance at T_ref [Ohm]"""
    R_actual: ClassVar[ac.Variable]
    """actual resistance [Ohm]"""
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        T: SupportsFloat | ac.Start = ...,
        E_a: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        useHeatPort: bool = ...,
        learned: bool = ...,
        width: SupportsIndex = ...,
        net: Callable[..., Any] = ...,
        heatPort: Mapping[str, Any] = ...,
        p: Mapping[str, Any] = ...,
        n: Mapping[str, Any] = ...,
        soc: ac.Start | Mapping[str, Any] = ...,
        LossPower: ac.Start | Mapping[str, Any] = ...,
        T_heatPort: ac.Start | Mapping[str, Any] = ...,
        v: ac.Start | Mapping[str, Any] = ...,
        i: ac.Start | Mapping[str, Any] = ...,
        R_actual: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...
