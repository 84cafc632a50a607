"""Models with events in which something is learned, and their truths: made from the library alone."""

from typing import Any

import acausal as ac
from acausal.components import blocks, electrical as el, neural, rotational as rot, thermal
from acausal.components.rotational.friction import PartialBearingFriction

AMBIENT = 283.15


class Convection(thermal.Element1D):
    """Natural convection: the coefficient grows with the difference of temperatures."""

    G = ac.Parameter(0.5)

    def equations(self) -> Any:
        yield from super().equations()
        yield ac.Eq(self.Q_flow, self.G * self.dT * (ac.Abs(self.dT) + 1e-9) ** 0.25)


class Zone(ac.Component):
    """A zone that an on-off controller heats, and that loses heat to the outside."""

    def __init__(self, losses: ac.Component) -> None:
        super().__init__()
        self.zone = thermal.HeatCapacitor(C=10.0, T=ac.Start(AMBIENT + 3, fixed=True))
        self.losses = losses
        self.outside = thermal.FixedTemperature(T=AMBIENT)
        self.heater = thermal.PrescribedHeatFlow()
        self.sensor = thermal.TemperatureSensor()
        self.setpoint = blocks.Constant(k=AMBIENT + 10)
        self.controller = blocks.OnOffController(bandwidth=2.0, pre_y_start=True)
        self.power = blocks.BooleanToReal(realTrue=30.0, realFalse=0.0)
        self.connect(self.zone.port, self.losses.port_a)
        self.connect(self.losses.port_b, self.outside.port)
        self.connect(self.zone.port, self.heater.port)
        self.connect(self.zone.port, self.sensor.port)
        self.connect(self.setpoint.y, self.controller.reference)
        self.connect(self.sensor.T, self.controller.u)
        self.connect(self.controller.y, self.power.u)
        self.connect(self.power.y, self.heater.Q_flow)


def learned_losses() -> ac.Component:
    """A heat flow that falls from hot to cold, for all weights."""
    return neural.Resistance(
        thermal.HeatPort,
        passive=True,
        monotone=True,
        activation="softplus",
        width=6,
        depth=1,
        input_scale=10.0,
        output_scale=10.0,
    )


class Stribeck(PartialBearingFriction):
    """Friction that falls from ``tau_s`` at rest towards ``tau_c``, and rises with the speed."""

    tau_s, tau_c = ac.Parameter(0.9), ac.Parameter(0.5)
    w_s, d = ac.Parameter(1.0), ac.Parameter(0.05)

    def _curve(self, speed: Any) -> Any:
        falls = (self.tau_s - self.tau_c) * ac.exp(-((speed / self.w_s) ** 2))
        return self.tau_c + falls + self.d * speed


class Motor(ac.Component):
    """A motor, its speed controlled by a sampled PI controller; its bearing sticks and slips."""

    def __init__(self, friction: ac.Component, period: float = 0.05) -> None:
        super().__init__()
        kp, ki = 1.0, 4.0
        self.reference = blocks.Sine(amplitude=3.0, f=0.25)
        self.sensor = rot.SpeedSensor()
        self.error = blocks.Feedback()
        self.controller = blocks.discrete.TransferFunction(
            b=[kp + ki * period, -kp], a=[1.0, -1.0], samplePeriod=period
        )
        self.source, self.ground = el.SignalVoltage(), el.Ground()
        self.resistor, self.emf = el.Resistor(R=0.5), el.RotationalEMF(k=0.5)
        self.rotor = rot.Inertia(J=0.1, phi=ac.Start(0.0, fixed=True), w=ac.Start(0.0, fixed=True))
        self.friction = friction
        self.connect(self.reference.y, self.error.u1)
        self.connect(self.sensor.w, self.error.u2)
        self.connect(self.error.y, self.controller.u)
        self.connect(self.controller.y, self.source.v)
        self.connect(self.source.p, self.resistor.p)
        self.connect(self.resistor.n, self.emf.p)
        self.connect(self.emf.n, self.source.n)
        self.connect(self.source.n, self.ground.p)
        self.connect(self.emf.flange, self.rotor.flange_a)
        self.connect(self.rotor.flange_b, self.friction.flange_a)
        self.connect(self.friction.flange_b, self.sensor.flange)


def learned_friction() -> ac.Component:
    """A friction curve that knows nothing but that it is positive."""
    return neural.BearingFriction(width=6, depth=1, input_scale=2.0, output_scale=0.8)


class Converter(ac.Component):
    """A step-down converter at 5 kHz, its switch and its diode ideal; its inductor saturates."""

    def __init__(self, inductor: ac.Component) -> None:
        super().__init__()
        self.supply, self.ground = el.ConstantVoltage(V=24.0), el.Ground()
        self.switch, self.diode = el.IdealClosingSwitch(), el.IdealDiode()
        self.pulse = blocks.BooleanPulse(width=45.0, period=2e-4)
        self.inductor = inductor
        self.capacitor = el.Capacitor(C=1e-3, v=ac.Start(0.0, fixed=True))
        self.load = el.Resistor(R=0.5)
        self.connect(self.pulse.y, self.switch.control)
        self.connect(self.supply.p, self.switch.p)
        self.connect(self.switch.n, self.inductor.p)
        self.connect(self.diode.n, self.inductor.p)
        self.connect(self.inductor.n, self.capacitor.p)
        self.connect(self.capacitor.p, self.load.p)
        for pin in (self.diode.p, self.capacitor.n, self.load.n, self.ground.p):
            self.connect(pin, self.supply.n)


def learned_inductor() -> ac.Component:
    """An inductor whose flux rises with the current, for all weights."""
    return neural.Inductance(
        el.Pin,
        odd=True,
        width=6,
        depth=1,
        input_scale=5.0,
        output_scale=4e-3,
        i=ac.Start(0.0, fixed=True),
    )
