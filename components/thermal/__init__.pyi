"""Heat transfer (`Modelica.Thermal.HeatTransfer`): lumped storage, conduction, convection and radiation.

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, SupportsFloat, SupportsIndex

import acausal as ac

from . import celsius as celsius, fahrenheit as fahrenheit, rankine as rankine

__all__ = [
    "BodyRadiation",
    "ConditionalFixedHeatFlowSensor",
    "Conduction",
    "Convection",
    "ConvectiveResistor",
    "DirectCapacity",
    "Element1D",
    "FixedHeatFlow",
    "FixedTemperature",
    "GeneralHeatFlowToTemperatureAdaptor",
    "GeneralTemperatureToHeatFlowAdaptor",
    "HeatCapacitor",
    "HeatFlowSensor",
    "HeatPort",
    "HeatPort_a",
    "HeatPort_b",
    "InverseCapacity",
    "PartialConditionalHeatPort",
    "PartialElementaryConditionalHeatPort",
    "PartialElementaryConditionalHeatPortWithoutT",
    "PrescribedHeatFlow",
    "PrescribedTemperature",
    "RelTemperatureSensor",
    "TemperatureSensor",
    "ThermalCollector",
    "ThermalCollectorMatrix",
    "ThermalConductor",
    "ThermalResistor",
    "celsius",
    "fahrenheit",
    "rankine",
]

class ConditionalFixedHeatFlowSensor(ac.Component):
    """A heat flow sensor for ports that may be absent."""

    useFixedTemperature: ClassVar[ac.Option]
    """whether the temperature of the ports is fixed"""
    T: ClassVar[ac.Parameter]
    """fixed temperature [K]"""
    port_a: HeatPort
    port_b: HeatPort
    Q_flow: ClassVar[ac.Output]
    """heat flow rate from port_a to port_b [W]"""
    def __init__(
        self,
        *,
        T: SupportsFloat | ac.Start = ...,
        useFixedTemperature: bool = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Conduction(ac.Component):
    """A thermal conductor between two temperatures, and the heat flow rates that these take."""

    G: ClassVar[ac.Parameter]
    """thermal conductance [W/K]"""
    T1: ClassVar[ac.Input]
    """temperature of the left end [K]"""
    Q_flow1: ClassVar[ac.Output]
    """heat flow rate into the left end [W]"""
    T2: ClassVar[ac.Input]
    """temperature of the right end [K]"""
    Q_flow2: ClassVar[ac.Output]
    """heat flow rate into the right end [W]"""
    thermalConductor: ThermalConductor
    temperatureToHeatFlow1: GeneralTemperatureToHeatFlowAdaptor
    temperatureToHeatFlow2: GeneralTemperatureToHeatFlowAdaptor
    def __init__(
        self,
        *,
        G: SupportsFloat | ac.Start = ...,
        T1: ac.Start | Mapping[str, Any] = ...,
        T2: ac.Start | Mapping[str, Any] = ...,
        Q_flow1: ac.Start | Mapping[str, Any] = ...,
        Q_flow2: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class DirectCapacity(ac.Component):
    """A heat capacitor heated by ``Q_flowDrive`` that gives its temperature and takes the heat ``Q_flow``."""

    C: ClassVar[ac.Parameter]
    """heat capacity [J/K]"""
    Q_flowDrive: ClassVar[ac.Input]
    """driving heat flow rate [W]"""
    Q_flow: ClassVar[ac.Input]
    """heat flow rate from what is connected [W]"""
    T: ClassVar[ac.Output]
    """temperature [K]"""
    derT: ClassVar[ac.Output]
    """rate of the temperature [K/s]"""
    heatCapacitor: HeatCapacitor
    forceSource: PrescribedHeatFlow
    heatFlowToTemperature: GeneralHeatFlowToTemperatureAdaptor
    def __init__(
        self,
        *,
        C: SupportsFloat | ac.Start = ...,
        Q_flowDrive: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        derT: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class Element1D(ac.Component):
    """Two heat ports with a heat flow between them, and no storage."""

    port_a: HeatPort
    port_b: HeatPort
    Q_flow: ClassVar[ac.Variable]
    """heat flow rate from port_a to port_b [W]"""
    dT: ClassVar[ac.Variable]
    """port_a.T - port_b.T [K]"""
    def __init__(self, **modifiers: Any) -> None: ...

class GeneralHeatFlowToTemperatureAdaptor(ac.Component):
    """A heat port as signals, heat flow in, temperature out: ``f = heatPort.Q_flow``, ``p = heatPort.T``."""

    use_pder: ClassVar[ac.Option]
    """whether the rate of the temperature is an output"""
    heatPort: HeatPort
    f: ClassVar[ac.Input]
    """heat flow rate into the port [W]"""
    p: ClassVar[ac.Output]
    """temperature [K]"""
    pder: ClassVar[ac.Output]
    """rate of the temperature [K/s]"""
    def __init__(
        self,
        *,
        use_pder: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        pder: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class GeneralTemperatureToHeatFlowAdaptor(ac.Component):
    """A heat port as signals, temperature in, heat flow out: ``heatPort.T = p``, ``f = -heatPort.Q_flow``."""

    use_pder: ClassVar[ac.Option]
    """whether the rate of the temperature is an input"""
    heatPort: HeatPort
    p: ClassVar[ac.Input]
    """temperature [K]"""
    pder: ClassVar[ac.Input]
    """rate of the temperature, consistent with p [K/s]"""
    f: ClassVar[ac.Output]
    """heat flow rate to what is connected, = -heatPort.Q_flow [W]"""
    def __init__(
        self,
        *,
        use_pder: bool = ...,
        heatPort: Mapping[str, Any] = ...,
        p: ac.Start | Mapping[str, Any] = ...,
        pder: ac.Start | Mapping[str, Any] = ...,
        f: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HeatCapacitor(ac.Component):
    """Heat storage at one temperature: ``C der(T) = port.Q_flow``, ``T = port.T``, ``der_T = der(T)``."""

    C: ClassVar[ac.Parameter]
    """heat capacity [J/K]"""
    T: ClassVar[ac.Variable]
    """temperature [K]"""
    der_T: ClassVar[ac.Variable]
    """rate of the temperature [K/s]"""
    port: HeatPort
    def __init__(
        self,
        *,
        C: SupportsFloat | ac.Start = ...,
        port: Mapping[str, Any] = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        der_T: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HeatFlowSensor(ac.Component):
    """Heat flow rate: ``Q_flow = port_a.Q_flow`` [W] from ``port_a`` to ``port_b``, which are equally warm."""

    port_a: HeatPort
    port_b: HeatPort
    Q_flow: ClassVar[ac.Output]
    """heat flow rate from port_a to port_b [W]"""
    def __init__(
        self,
        *,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class HeatPort(ac.Connector):
    """Temperature ``T`` [K] and heat flow rate ``Q_flow`` [W], positive into the component."""

    T: ClassVar[ac.Potential]
    """ [K]"""
    Q_flow: ClassVar[ac.Flow]
    """ [W]"""

class InverseCapacity(ac.Component):
    """A heat capacitor at the temperature that the signals say, and the heat flow rate that this takes."""

    C: ClassVar[ac.Parameter]
    """heat capacity [J/K]"""
    T: ClassVar[ac.Input]
    """temperature [K]"""
    derT: ClassVar[ac.Input]
    """rate of the temperature, consistent with T [K/s]"""
    Q_flow: ClassVar[ac.Output]
    """heat flow rate that heats the capacitor [W]"""
    mass: HeatCapacitor
    temperatureToHeatFlow: GeneralTemperatureToHeatFlowAdaptor
    def __init__(
        self,
        *,
        C: SupportsFloat | ac.Start = ...,
        T: ac.Start | Mapping[str, Any] = ...,
        derT: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class PartialConditionalHeatPort(ac.Component):
    """Base of a composite component that may have a heat port."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    heatPort: HeatPort
    internalHeatPort: HeatPort
    fixedTemperature: FixedTemperature
    def __init__(self, **modifiers: Any) -> None: ...

class PartialElementaryConditionalHeatPortWithoutT(ac.Component):
    """Base of a component that dissipates ``lossPower`` and may hand it to a heat port."""

    useHeatPort: ClassVar[ac.Option]
    """whether there is a heat port"""
    heatPort: HeatPort
    lossPower: ClassVar[ac.Variable]
    """power that leaves as heat [W]"""
    def __init__(self, **modifiers: Any) -> None: ...

class RelTemperatureSensor(ac.Component):
    """Temperature difference: ``T_rel = port_a.T - port_b.T`` [K]."""

    port_a: HeatPort
    port_b: HeatPort
    T_rel: ClassVar[ac.Output]
    """temperature of port_a relative to port_b [K]"""
    def __init__(
        self,
        *,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        T_rel: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class BodyRadiation(Element1D):
    """Heat radiation between two bodies: ``Q_flow = Gr sigma (port_a.T**4 - port_b.T**4)``."""

    Gr: ClassVar[ac.Parameter]
    """net radiation conductance [m2]"""
    sigma: ClassVar[ac.Parameter]
    """Stefan-Boltzmann constant [W/(m2.K4)]"""
    def __init__(
        self,
        *,
        Gr: SupportsFloat | ac.Start = ...,
        sigma: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class Convection(ac.Component):
    """Heat convection with a conductance that is a signal: ``Q_flow = Gc dT``."""

    solid: HeatPort
    fluid: HeatPort
    Q_flow: ClassVar[ac.Variable]
    """heat flow rate from solid to fluid [W]"""
    dT: ClassVar[ac.Variable]
    """solid.T - fluid.T [K]"""
    Gc: ClassVar[ac.Input]
    """convective thermal conductance [W/K]"""
    def __init__(
        self,
        *,
        solid: Mapping[str, Any] = ...,
        fluid: Mapping[str, Any] = ...,
        Gc: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ConvectiveResistor(ac.Component):
    """Heat convection with a resistance that is a signal, and may be zero: ``dT = Rc Q_flow``."""

    solid: HeatPort
    fluid: HeatPort
    Q_flow: ClassVar[ac.Variable]
    """heat flow rate from solid to fluid [W]"""
    dT: ClassVar[ac.Variable]
    """solid.T - fluid.T [K]"""
    Rc: ClassVar[ac.Input]
    """convective thermal resistance [K/W]"""
    def __init__(
        self,
        *,
        solid: Mapping[str, Any] = ...,
        fluid: Mapping[str, Any] = ...,
        Rc: ac.Start | Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class FixedHeatFlow(ac.Component):
    """A constant heat flow rate into what is connected."""

    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the heat flow rate [1/K]"""
    port: HeatPort
    Q_flow: ClassVar[ac.Parameter]
    """heat flow rate at the reference temperature [W]"""
    def __init__(
        self,
        *,
        Q_flow: SupportsFloat | ac.Start = ...,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        port: Mapping[str, Any] = ...,
    ) -> None: ...

class FixedTemperature(ac.Component):
    """A constant temperature, whatever the heat flow: ``port.T = T`` [K]."""

    T: ClassVar[ac.Parameter]
    """temperature at the port [K]"""
    port: HeatPort
    def __init__(
        self, *, T: SupportsFloat | ac.Start = ..., port: Mapping[str, Any] = ...
    ) -> None: ...

class PartialElementaryConditionalHeatPort(PartialElementaryConditionalHeatPortWithoutT):
    """The same for a component that depends on its temperature."""

    T: ClassVar[ac.Parameter]
    """temperature of the device without heat port [K]"""
    TheatPort: ClassVar[ac.Variable]
    """temperature of the device [K]"""
    def __init__(self, **modifiers: Any) -> None: ...

class PrescribedHeatFlow(ac.Component):
    """A heat flow signal ``Q_flow`` [W] into what is connected."""

    T_ref: ClassVar[ac.Parameter]
    """reference temperature [K]"""
    alpha: ClassVar[ac.Parameter]
    """temperature coefficient of the heat flow rate [1/K]"""
    port: HeatPort
    Q_flow: ClassVar[ac.Input]
    """heat flow rate at the reference temperature [W]"""
    def __init__(
        self,
        *,
        T_ref: SupportsFloat | ac.Start = ...,
        alpha: SupportsFloat | ac.Start = ...,
        port: Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class PrescribedTemperature(ac.Component):
    """A temperature signal ``T`` [K], whatever the heat flow: ``port.T = T``."""

    T: ClassVar[ac.Input]
    """temperature at the port [K]"""
    port: HeatPort
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class TemperatureSensor(ac.Component):
    """Absolute temperature: ``T = port.T`` [K]."""

    T: ClassVar[ac.Output]
    """absolute temperature of the port [K]"""
    port: HeatPort
    def __init__(
        self, *, port: Mapping[str, Any] = ..., T: ac.Start | Mapping[str, Any] = ...
    ) -> None: ...

class ThermalCollector(ac.Component):
    """Joins ``m`` heat ports ``port_a[1]`` to ``port_a[m]`` with ``port_b``."""

    port_b: HeatPort
    m: ClassVar[ac.Option]
    """number of heat ports that are collected"""
    def __init__(
        self,
        *,
        m: SupportsIndex = ...,
        port_b: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ThermalCollectorMatrix(ac.Component):
    """Joins ``Ns`` rows of ``Np`` heat ports with ``port_b``, as `ThermalCollector` does."""

    port_b: HeatPort
    Ns: ClassVar[ac.Option]
    """number of rows"""
    Np: ClassVar[ac.Option]
    """number of columns"""
    def __init__(
        self,
        *,
        Ns: Any = ...,
        Np: Any = ...,
        port_b: Mapping[str, Any] = ...,
        **modifiers: Mapping[str, Any],
    ) -> None: ...

class ThermalConductor(Element1D):
    """Heat conduction: ``Q_flow = G dT``."""

    G: ClassVar[ac.Parameter]
    """thermal conductance [W/K]"""
    def __init__(
        self,
        *,
        G: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

class ThermalResistor(Element1D):
    """Heat conduction by a resistance, which may be zero: ``dT = R Q_flow``."""

    R: ClassVar[ac.Parameter]
    """thermal resistance [K/W]"""
    def __init__(
        self,
        *,
        R: SupportsFloat | ac.Start = ...,
        port_a: Mapping[str, Any] = ...,
        port_b: Mapping[str, Any] = ...,
        Q_flow: ac.Start | Mapping[str, Any] = ...,
        dT: ac.Start | Mapping[str, Any] = ...,
    ) -> None: ...

HeatPort_a = HeatPort
HeatPort_b = HeatPort
