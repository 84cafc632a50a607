"""Parts of the examples (`Modelica.Thermal.HeatTransfer.Examples.Utilities`): elements with signals for heat ports."""

from typing import Any

import acausal as ac
from acausal.components import icons

from .adaptors import GeneralHeatFlowToTemperatureAdaptor, GeneralTemperatureToHeatFlowAdaptor
from .components import HeatCapacitor, ThermalConductor
from .sources import PrescribedHeatFlow

__modelica__ = "Modelica.Thermal.HeatTransfer.Examples.Utilities"


class DirectCapacity(ac.Component):
    """A heat capacitor heated by ``Q_flowDrive`` that gives its temperature and takes the heat ``Q_flow``."""

    ICON = icons.boxed(icons.HEAT_CAPACITY, "Q → T")

    C = ac.Parameter(1.0, unit="J/K", min=0, doc="heat capacity")
    Q_flowDrive = ac.Input(unit="W", doc="driving heat flow rate")
    Q_flow = ac.Input(unit="W", doc="heat flow rate from what is connected")
    T = ac.Output(unit="K", doc="temperature")
    derT = ac.Output(unit="K/s", doc="rate of the temperature")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.heatCapacitor = HeatCapacitor(C=self.C, T=ac.Start(293.15, fixed=True))
        self.forceSource = PrescribedHeatFlow()
        self.heatFlowToTemperature = GeneralHeatFlowToTemperatureAdaptor()
        self.connect(self.Q_flowDrive, self.forceSource.Q_flow)
        self.connect(
            self.heatCapacitor.port, self.forceSource.port, self.heatFlowToTemperature.heatPort
        )
        self.connect(self.Q_flow, self.heatFlowToTemperature.f)
        self.connect(self.heatFlowToTemperature.p, self.T)
        self.connect(self.heatFlowToTemperature.pder, self.derT)


class InverseCapacity(ac.Component):
    """A heat capacitor at the temperature that the signals say, and the heat flow rate that this takes."""

    ICON = icons.boxed(icons.HEAT_CAPACITY, "T → Q")

    C = ac.Parameter(1.0, unit="J/K", min=0, doc="heat capacity")
    T = ac.Input(unit="K", doc="temperature")
    derT = ac.Input(unit="K/s", doc="rate of the temperature, consistent with T")
    Q_flow = ac.Output(unit="W", doc="heat flow rate that heats the capacitor")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.mass = HeatCapacitor(C=self.C)
        self.temperatureToHeatFlow = GeneralTemperatureToHeatFlowAdaptor()
        self.connect(self.T, self.temperatureToHeatFlow.p)
        self.connect(self.derT, self.temperatureToHeatFlow.pder)
        self.connect(self.temperatureToHeatFlow.heatPort, self.mass.port)
        self.connect(self.temperatureToHeatFlow.f, self.Q_flow)


class Conduction(ac.Component):
    """A thermal conductor between two temperatures, and the heat flow rates that these take."""

    ICON = icons.boxed(icons.CONDUCTION)

    G = ac.Parameter(1.0, unit="W/K", doc="thermal conductance")
    T1 = ac.Input(unit="K", doc="temperature of the left end")
    Q_flow1 = ac.Output(unit="W", doc="heat flow rate into the left end")
    T2 = ac.Input(unit="K", doc="temperature of the right end")
    Q_flow2 = ac.Output(unit="W", doc="heat flow rate into the right end")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.thermalConductor = ThermalConductor(G=self.G)
        self.temperatureToHeatFlow1 = GeneralTemperatureToHeatFlowAdaptor(use_pder=False)
        self.temperatureToHeatFlow2 = GeneralTemperatureToHeatFlowAdaptor(use_pder=False)
        self.connect(self.temperatureToHeatFlow1.heatPort, self.thermalConductor.port_a)
        self.connect(self.temperatureToHeatFlow2.heatPort, self.thermalConductor.port_b)
        self.connect(self.T1, self.temperatureToHeatFlow1.p)
        self.connect(self.temperatureToHeatFlow1.f, self.Q_flow1)
        self.connect(self.T2, self.temperatureToHeatFlow2.p)
        self.connect(self.temperatureToHeatFlow2.f, self.Q_flow2)
