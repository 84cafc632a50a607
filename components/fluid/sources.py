"""Given pressures and flows, and pumps."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons
from acausal.components.mechanics.rotational import Flange

from .bases import PartialAdiabatic, PartialSinglePort

__modelica__ = "Modelica.Thermal.FluidHeatFlow.Sources"


class Ambient(PartialSinglePort):
    """An infinite reservoir: ``flowPort.p`` [Pa] and ``T`` [K] are given, as constants or signals.

    What flows in is lost; what flows out has temperature ``T``.
    """

    ICON = icons.AMBIENT

    usePressureInput = ac.Option(False, doc="whether the pressure is a signal")
    constantAmbientPressure = ac.Parameter(
        0.0, unit="Pa", when="not usePressureInput", doc="ambient pressure"
    )
    useTemperatureInput = ac.Option(False, doc="whether the temperature is a signal")
    constantAmbientTemperature = ac.Parameter(
        293.15, unit="K", when="not useTemperatureInput", doc="ambient temperature"
    )
    ambientPressure = ac.Input(unit="Pa", when="usePressureInput", doc="ambient pressure")
    ambientTemperature = ac.Input(unit="K", when="useTemperatureInput", doc="ambient temperature")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        p = self.ambientPressure if self.usePressureInput else self.constantAmbientPressure
        T = self.ambientTemperature if self.useTemperatureInput else self.constantAmbientTemperature
        yield ac.Eq(self.flowPort.p, p)
        yield ac.Eq(self.T, T)


class AbsolutePressure(PartialSinglePort):
    """Sets the pressure level of a closed circuit, without a flow: ``flowPort.p = p`` [Pa].

    ``flowPort.H_flow = 0``, and ``T`` is the temperature at the port. In an open circuit, where a mass
    flow could pass, use `Ambient`.
    """

    ICON = icons.marked(icons.AMBIENT, "=")

    Exchange = False

    p = ac.Parameter(0.0, unit="Pa", doc="pressure")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.flowPort.p, self.p)
        yield ac.Eq(self.flowPort.H_flow, 0)


class VolumeFlow(PartialAdiabatic):
    """A pump with a given volume flow from a to b, whatever the pressure: ``V_flow`` [m3/s].

    It is ``constantVolumeFlow``, or the signal ``volumeFlow`` with ``useVolumeFlowInput``.
    """

    ICON = icons.marked(icons.PUMP, "V")

    useVolumeFlowInput = ac.Option(False, doc="whether the volume flow is a signal")
    constantVolumeFlow = ac.Parameter(
        unit="m3/s", when="not useVolumeFlowInput", doc="volume flow rate"
    )
    volumeFlow = ac.Input(unit="m3/s", when="useVolumeFlowInput", doc="volume flow rate")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        given = self.volumeFlow if self.useVolumeFlowInput else self.constantVolumeFlow
        yield ac.Eq(self.V_flow, given)


class PressureIncrease(PartialAdiabatic):
    """A pump with a given pressure increase from a to b, whatever the flow: ``dp = -increase`` [Pa].

    It is ``constantPressureIncrease``, or the signal ``pressureIncrease`` with
    ``usePressureIncreaseInput``.
    """

    ICON = icons.marked(icons.PUMP, "Δp")

    usePressureIncreaseInput = ac.Option(False, doc="whether the pressure increase is a signal")
    constantPressureIncrease = ac.Parameter(
        unit="Pa", when="not usePressureIncreaseInput", doc="pressure increase"
    )
    pressureIncrease = ac.Input(unit="Pa", when="usePressureIncreaseInput", doc="pressure increase")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        if self.usePressureIncreaseInput:
            yield ac.Eq(self.dp, -self.pressureIncrease)
        else:
            yield ac.Eq(self.dp, -self.constantPressureIncrease)


class IdealPump(PartialAdiabatic):
    """A pump without losses that is driven at its shaft: ``flange_a.tau w = -dp V_flow``.

    Its characteristic is a straight line from ``dp0`` without flow to ``V_flow0`` without pressure, at the
    speed ``wNominal``; at another speed ``w = der(flange_a.phi)`` [rad/s], with ``r = w/wNominal``, the axis
    intercepts are ``dp1 = dp0 r |r|`` and ``V_flow1 = V_flow0 r``. So ``dp = -dp0 |r| (r - V_flow/V_flow0)``
    and ``flange_a.tau = dp0/wNominal sign(r) (r - V_flow/V_flow0) V_flow``, which hold at rest too.
    """

    ICON = icons.PUMP

    wNominal = ac.Parameter(unit="rad/s", min=0, doc="nominal speed")
    dp0 = ac.Parameter(unit="Pa", doc="pressure increase without flow, at nominal speed")
    V_flow0 = ac.Parameter(unit="m3/s", doc="volume flow without pressure, at nominal speed")
    w = ac.Variable(unit="rad/s", doc="speed")
    dp1 = ac.Variable(unit="Pa", doc="pressure increase without flow")
    V_flow1 = ac.Variable(unit="m3/s", doc="volume flow without pressure")
    flange_a = Flange()

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        r = self.w / self.wNominal
        left = r - self.V_flow / self.V_flow0
        yield ac.Eq(self.w, ac.der(self.flange_a.phi))
        yield ac.Eq(self.dp1, self.dp0 * r * ac.Abs(r))
        yield ac.Eq(self.V_flow1, self.V_flow0 * r)
        yield ac.Eq(self.dp, -self.dp0 * ac.Abs(r) * left)
        yield ac.Eq(self.flange_a.tau, self.dp0 / self.wNominal * ac.sign(r) * left * self.V_flow)
