"""Models with events, of the library and of users, to compare their gradients with differences."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import acausal as ac
from acausal.components import (
    blocks,
    electrical as el,
    neural,
    rotational as rot,
    thermal,
    translational as tl,
)
from acausal.components.blocks import discrete
from tests.gradients.models import Built, at
from tests.support.hybrid import Ball, Thermostat

E, der, pre = ac.Eq, ac.der, ac.pre
REST = at(0.0)


@dataclass(frozen=True)
class Hybrid:
    """A model and how it is run.

    Attributes:
        make: makes it. end: of the simulation, in seconds.
        moved: parameters by which the result is differentiated; the ends of their names are enough.
        x0, inputs: initial values and constant inputs; by all of them it is differentiated, too.
        held: by input, times and interpolation of a signal, whose samples are moved, too.
        events: so many events happen at least.
        saved: times of results, as fractions of the simulation. steps: how many it takes on the fixed path.
        kinds: of steps; large programs take one.
    """

    make: Callable[[], ac.Component]
    end: float
    moved: tuple[str, ...] = ()
    x0: dict[str, float] = field(default_factory=dict)
    inputs: dict[str, float] = field(default_factory=dict)
    held: dict[str, tuple[tuple[float, ...], str]] = field(default_factory=dict)
    events: int = 2
    saved: tuple[float, ...] = (0.53, 1.0)
    steps: int = 43
    kinds: tuple[str, ...] = ("fixed", "adaptive")


class Table(ac.Component):
    """A ball over a table that moves, slowed down by the air, between walls."""

    e, drag, f, height = ac.Parameter(0.8), ac.Parameter(0.1), ac.Parameter(3.0), ac.Parameter(0.05)
    left, right = ac.Parameter(-0.05), ac.Parameter(1.0)
    x = ac.Variable(start=0.5, fixed=True)
    y = ac.Variable(start=0.6, fixed=True)
    v = ac.Variable(start=1.7, state="always", fixed=True)
    w = ac.Variable(start=0.0, state="always", fixed=True)

    def equations(self) -> Iterator[Any]:
        phase = self.f * ac.time
        table, speed = self.height * ac.sin(phase), self.height * self.f * ac.cos(phase)
        yield E(der(self.x), self.v)
        yield E(der(self.y), self.w)
        yield E(der(self.v), -self.drag * self.v * ac.Abs(self.v))
        yield E(der(self.w), -9.81 - self.drag * self.w * ac.Abs(self.w))
        yield ac.When(self.y < table, ac.Reinit(self.w, speed - self.e * (pre(self.w) - speed)))
        yield ac.When(
            (self.x < self.left, self.x > self.right), ac.Reinit(self.v, -self.e * pre(self.v))
        )


class Twins(ac.Component):
    """Two balls that bounce at the same instants."""

    e, h = ac.Parameter(0.8), ac.Parameter(1.0)

    def __init__(self) -> None:
        super().__init__()
        self.ball = [Ball(e=self.e, h=ac.Start(self.h, fixed=True)) for _ in range(2)]


class SampledPI(ac.Component):
    """A plant of second order under a controller that is sampled, with a limit."""

    period, kp, ki = ac.Parameter(0.1), ac.Parameter(3.0), ac.Parameter(2.0)
    limit = ac.Parameter(1.1)
    x, v = ac.Variable(fixed=True), ac.Variable(fixed=True)
    u, total = ac.Discrete(), ac.Discrete()

    def equations(self) -> Iterator[Any]:
        error = 1 - self.x
        wanted = self.kp * error + self.total
        yield E(der(self.x), self.v)
        yield E(der(self.v), self.u - self.x - 0.7 * self.v)
        yield ac.When(
            ac.sample(0.02, self.period),
            E(self.total, pre(self.total) + self.ki * self.period * error),
            E(self.u, ac.where(wanted > self.limit, self.limit, wanted)),
        )


class Oscillator(ac.Component):
    """A capacitor that a Schmitt trigger charges and discharges."""

    low, high, tau = ac.Parameter(-0.4), ac.Parameter(0.5), ac.Parameter(0.2)
    v = ac.Variable(start=0.1, fixed=True)
    up = ac.Discrete(1, kind="bool")

    def equations(self) -> Iterator[Any]:
        yield E(self.tau * der(self.v), ac.where(self.up > 0.5, 1, -0.9) - self.v)
        yield E(self.up, (self.v < self.low) | ((pre(self.up) > 0.5) & (self.v < self.high)))


class Counter(ac.Component):
    """Counts the crossings of a wave; the count drives a lag, and a reset comes first."""

    f, level, gain, most = (
        ac.Parameter(7.0),
        ac.Parameter(0.3),
        ac.Parameter(0.4),
        ac.Parameter(0.9),
    )
    x = ac.Variable(fixed=True, state="always")
    n = ac.Discrete(0, kind="int")

    def equations(self) -> Iterator[Any]:
        yield E(der(self.x), self.gain * self.n - 0.2 * self.x)
        yield ac.When(
            self.x > self.most,
            E(self.n, 0),
            ac.Reinit(self.x, pre(self.x) / 3),
            otherwise=ac.When(ac.sin(self.f * ac.time) > self.level, E(self.n, pre(self.n) + 1)),
        )


class Chain(ac.Component):
    """One event causes the next at the same instant; two states jump together."""

    a, b, k = ac.Parameter(0.4), ac.Parameter(0.25), ac.Parameter(1.3)
    x = ac.Variable(fixed=True, state="always")
    y = ac.Variable(start=0.2, fixed=True, state="always")
    first, second = ac.Discrete(0, kind="int"), ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield E(der(self.x), 1 + self.second - 0.3 * self.x)
        yield E(der(self.y), self.k * self.x - self.y)
        yield ac.When(
            self.x > self.a,
            ac.Reinit(self.x, self.b * pre(self.y)),
            E(self.first, pre(self.first) + 1),
        )
        yield ac.When(
            ac.change(self.first),
            ac.Reinit(self.y, self.k * pre(self.y) + pre(self.x)),
            E(self.second, self.k * pre(self.y)),
        )


class Held(ac.Component):
    """Inputs of several interpolations, a condition on one of them, and events between their samples."""

    tw, level, k = ac.Parameter(0.31), ac.Parameter(0.35), ac.Parameter(0.7)
    u, w, smooth = ac.Input(), ac.Input(), ac.Input()
    x, y = ac.Variable(fixed=True), ac.Variable(start=0.2, fixed=True, state="always")
    d, e = ac.Discrete(0.0), ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield E(der(self.x), self.u + self.d * self.w - self.k * self.x)
        yield E(der(self.y), self.x + self.smooth * self.e - self.y)
        yield ac.When(ac.time >= self.tw, E(self.d, 1.3))
        yield ac.When(self.y > self.level, ac.Reinit(self.y, self.k * pre(self.y)))
        yield ac.When(self.u > 1.6, E(self.e, self.x))


class TurnsStiff(ac.Component):
    """An event makes a state fast; an input jumps behind it."""

    tw, rate = ac.Parameter(0.3), ac.Parameter(1e4)
    u = ac.Input()
    x, z = ac.Variable(start=1.0, fixed=True), ac.Variable(fixed=True)
    d = ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield E(der(self.x), -self.x + self.u * self.d * ac.cos(3 * ac.time) + self.z)
        yield E(der(self.z), (1 + self.rate * self.d) * (self.x - self.z))
        yield ac.When(ac.time >= self.tw, E(self.d, 1.0))


def learned() -> ac.Component:
    """A zone that a controller heats, and a network for its losses."""
    return Built(
        "zone.port loss.port_a heater.port",
        "loss.port_b outside.port",
        "zone.port sensor.port",
        "sensor.T control.u",
        "set.y control.reference",
        "control.y power.u",
        "power.y heater.Q_flow",
        zone=thermal.HeatCapacitor(C=10.0, T=at(292.0)),
        loss=neural.Resistance(
            thermal.HeatPort, width=4, depth=1, passive=True, input_scale=10.0, output_scale=10.0
        ),
        outside=thermal.FixedTemperature(T=283.0),
        sensor=thermal.TemperatureSensor(),
        set=blocks.Constant(k=294.0),
        control=blocks.OnOffController(bandwidth=1.5, pre_y_start=True),
        power=blocks.Gain(k=30.0),
        heater=thermal.PrescribedHeatFlow(),
    )


def pulsed(block: ac.Component, *nets: str, **more: Any) -> ac.Component:
    """A signal, and a lag behind it."""
    lag = blocks.FirstOrder(T=0.3, initType="InitialState", y_start=0.1)
    clock = discrete.Sampler(samplePeriod=0.27)
    return Built("s.y lag.u clock.u", *nets, s=block, lag=lag, clock=clock, **more)


def rectifier() -> ac.Component:
    return Built(
        "source.p d1.p d2.n",
        "source.n d3.p d4.n",
        "d1.n d3.n load.p c.p",
        "d2.p d4.p load.n c.n ground.p",
        source=el.SineVoltage(V=10, f=50, phase=0.3),
        load=el.Resistor(R=10),
        c=el.Capacitor(C=1e-3, v=at(2.0)),
        ground=el.Ground(),
        **{f"d{k}": el.IdealDiode(Ron=0.1, Goff=1e-4, Vknee=0.6) for k in range(1, 5)},
    )


def buck() -> ac.Component:
    return Built(
        "source.p switch.p",
        "switch.n diode.n inductor.p",
        "inductor.n c.p load.p",
        "source.n diode.p c.n load.n ground.p",
        "pulse.y switch.control",
        source=el.ConstantVoltage(V=20),
        switch=el.IdealClosingSwitch(Ron=0.01),
        diode=el.IdealDiode(Ron=0.02, Vknee=0.4),
        inductor=el.Inductor(L=1e-2, i=at(0.6)),
        c=el.Capacitor(C=1e-4, v=at(4.0)),
        load=el.Resistor(R=10),
        pulse=blocks.BooleanPulse(period=1e-3, width=30),
        ground=el.Ground(),
    )


def thyristor() -> ac.Component:
    return Built(
        "source.p thyristor.p",
        "thyristor.n load.p",
        "load.n coil.p",
        "source.n coil.n ground.p",
        "gate.y thyristor.fire",
        source=el.SineVoltage(V=10, f=1),
        load=el.Resistor(R=1),
        coil=el.Inductor(L=0.1, i=at(0.1)),
        thyristor=el.IdealThyristor(Ron=0.01, Goff=0.2, Vknee=0.5),
        gate=blocks.BooleanPulse(width=5, period=1.0, startTime=0.12),
        ground=el.Ground(),
    )


def arc() -> ac.Component:
    switch = el.CloserWithArc(
        Ron=1e-3, Goff=0.05, V0=30, dVdt=1e4, Vmax=60, off=ac.Start(1.0, fixed=True)
    )
    return Built(
        "source.p switch.p",
        "switch.n inductor.p",
        "inductor.n resistor.p",
        "resistor.n source.n ground.p",
        "pulse.y switch.control",
        source=el.ConstantVoltage(V=50),
        inductor=el.Inductor(L=0.1, i=REST),
        resistor=el.Resistor(R=2),
        pulse=blocks.BooleanPulse(period=0.3, width=40),
        switch=switch,
        ground=el.Ground(),
    )


def clutch() -> ac.Component:
    return Built(
        "torque.flange a.flange_a",
        "a.flange_b clutch.flange_a",
        "clutch.flange_b b.flange_a",
        "b.flange_b spring.flange_a",
        "spring.flange_b wall.flange",
        torque=rot.Torque(),
        a=rot.Inertia(J=0.5, phi=REST, w=at(3.0)),
        b=rot.Inertia(J=0.8, phi=at(0.1), w=REST),
        clutch=rot.Clutch(fn_max=4.0, mu_pos=[[0, 0.6], [5, 0.4]], peak=1.1),
        spring=rot.SpringDamper(c=1.0, d=0.3),
        wall=rot.Fixed(),
    )


def brake() -> ac.Component:
    return Built(
        "torque.flange a.flange_a",
        "a.flange_b brake.flange_a",
        torque=rot.Torque(),
        a=rot.Inertia(J=0.5, phi=REST, w=at(1.0)),
        brake=rot.Brake(fn_max=2.0, mu_pos=[[0, 0.6], [5, 0.5]]),
    )


def free_wheel() -> ac.Component:
    return Built(
        "wave.y torque.tau",
        "torque.flange a.flange_a",
        "a.flange_b wheel.flange_a",
        "wheel.flange_b b.flange_a",
        wave=blocks.Sine(f=0.5, amplitude=2.0, phase=0.2),
        torque=rot.Torque(),
        a=rot.Inertia(J=0.5, phi=REST, w=REST),
        b=rot.Inertia(J=0.8, phi=REST, w=at(0.3)),
        wheel=rot.OneWayClutch(fn_max=0.4, mu_pos=[[0, 0.6], [5, 0.5]]),
    )


def stick_slip() -> ac.Component:
    return Built(
        "pull.flange spring.flange_a",
        "spring.flange_b block.flange_a",
        "block.flange_b friction.flange_a",
        pull=tl.ConstantSpeed(v_fixed=0.2),
        spring=tl.Spring(c=50.0),
        block=tl.Mass(m=1.0, s=REST, v=REST),
        friction=tl.SupportFriction(f_pos=[[0.0, 4.0], [1.0, 4.5]], peak=1.5),
    )


def gap() -> ac.Component:
    """A mass meets an elastic stop; a clock makes the contact an event."""
    return Built(
        "force.flange mass.flange_a",
        "mass.flange_b gap.flange_a",
        "gap.flange_b wall.flange",
        "speed.flange mass.flange_b",
        "speed.v clock.u",
        force=tl.Force(),
        mass=tl.Mass(m=1.0, s=REST, v=at(1.0)),
        gap=tl.ElastoGap(c=200.0, d=0.0, s_rel0=0.05, n=1.0),
        wall=tl.Fixed(s0=0.4),
        speed=tl.SpeedSensor(),
        clock=discrete.Sampler(samplePeriod=0.27),
    )


def stop() -> ac.Component:
    slider = tl.MassWithStopAndFriction(
        m=1, L=0.2, smax=1, smin=-1, F_prop=0.1, F_Coulomb=0.5, F_Stribeck=0.3, fexp=2,
        s=REST, v=at(1.7),
    )  # fmt: skip
    return Built(
        "spring.flange_a slider.flange_b",
        "spring.flange_b wall.flange",
        slider=slider,
        spring=tl.Spring(c=4.0, s_rel0=0.1),
        wall=tl.Fixed(s0=0.0),
    )


def integrator() -> ac.Component:
    """An integrator that a hysteresis sets back to another signal."""
    return Built(
        "wave.y i.u set.u",
        "set.y i.set",
        "i.y h.u",
        "h.y i.reset",
        wave=blocks.Sine(f=0.8, amplitude=1.0, offset=1.4),
        set=blocks.Gain(k=-0.3),
        i=blocks.Integrator(k=1.2, use_reset=True, use_set=True, y_start=0.1),
        h=blocks.Hysteresis(uLow=0.05, uHigh=0.6),
    )


def averages() -> ac.Component:
    return Built(
        "wave.y mean.u rms.u",
        "mean.y lag.u",
        "rms.y other.u",
        wave=blocks.Sine(f=2.0, amplitude=2.0, phase=0.4, offset=0.5),
        mean=blocks.Mean(f=3.0),
        rms=blocks.RootMeanSquare(f=2.3),
        lag=blocks.FirstOrder(T=0.3, initType="InitialState"),
        other=blocks.FirstOrder(T=0.2, initType="InitialState"),
    )


HYBRIDS: dict[str, Hybrid] = {
    "ball": Hybrid(Ball, 2.0, ("e",), {"h": 1.0, "v": 0.1}),
    "ball between walls": Hybrid(
        Table, 1.6, ("e", "drag", "f", "height", "left", "right"), {"x": 0.5, "w": 0.1}, events=4
    ),
    "twins": Hybrid(Twins, 1.5, ("e", "h")),
    "thermostat": Hybrid(
        Thermostat, 6.0, ("C", "G", "P", "low", "high"), {"T": 15.0}, events=3
    ),
    "sampled controller": Hybrid(
        SampledPI, 1.0, ("period", "kp", "ki", "limit"), {"x": 0.1, "v": 0.2}, events=9
    ),
    "Schmitt trigger": Hybrid(Oscillator, 1.0, ("low", "high", "tau"), {"v": 0.1}, events=3, saved=(0.7, 1.0)),
    "counter": Hybrid(Counter, 3.0, ("f", "level", "gain", "most"), {"x": 0.1}, events=4),
    "chain": Hybrid(Chain, 1.5, ("a", "b", "k"), {"x": 0.03, "y": 0.2}),
    "event at a saved time": Hybrid(
        SampledPI, 0.8, ("kp", "ki", "limit"), {"v": 0.2}, events=7, saved=(0.15, 0.65, 1.0)
    ),
    "held inputs": Hybrid(
        Held, 1.2, ("tw", "level", "k"), {"x": 0.1},
        held={
            "u": ((0.0, 0.4, 0.7, 1.2), "previous"),
            "w": ((0.0, 0.5, 0.9, 1.2), "linear"),
            "smooth": ((0.0, 0.45, 0.8, 1.2), "cubic"),
        },
        events=5, saved=(0.7 / 1.2, 1.0), kinds=("fixed", "adaptive", "kvaerno5"),
    ),
    "turns stiff": Hybrid(
        TurnsStiff, 1.0, ("tw",), {"x": 1.0}, held={"u": ((0.0, 0.55, 1.0), "previous")},
        events=1, kinds=("auto",),
    ),
    "network": Hybrid(learned, 6.0, ("zone.C", "power.k", "bandwidth"), {"zone.T": 292.0}),
    "step": Hybrid(
        lambda: pulsed(blocks.Step(startTime=0.31, height=1.4)), 1.0, ("startTime", "height", "T")
    ),
    "pulses": Hybrid(
        lambda: pulsed(blocks.Pulse(period=0.3, width=30, startTime=0.05)),
        1.0,
        ("period", "width", "s.startTime", "amplitude"),
        events=6,
    ),
    "trapezoid": Hybrid(
        lambda: pulsed(
            blocks.TriggeredTrapezoid(rising=0.1, falling=0.2, amplitude=1.3),
            "trigger.y s.u",
            trigger=blocks.BooleanPulse(period=0.4, width=40, startTime=0.05),
        ),
        1.0,
        ("rising", "falling", "amplitude", "trigger.period", "width"),
        events=6,
    ),
    "rectifier": Hybrid(rectifier, 0.025, ("R", "c.C", "V", "f", "d1.Vknee", "d3.Ron"), {"c.v": 2.0}, steps=257),
    "buck converter": Hybrid(
        buck, 3e-3, ("V", "L", "c.C", "R", "width", "Vknee"), {"c.v": 4.0, "inductor.i": 0.6}, events=6
    ),
    "thyristor": Hybrid(
        thyristor, 1.4, ("V", "R", "L", "startTime", "Vknee"), {"coil.i": 0.1}, events=3, steps=143
    ),
    "arc": Hybrid(arc, 0.35, ("V0", "dVdt", "Vmax", "L", "R", "pulse.width"), events=3, steps=163),
    "clutch": Hybrid(
        clutch, 1.5, ("a.J", "b.J", "fn_max", "spring.c", "peak"),
        {"a.w": 3.0, "b.phi": 0.1}, {"torque.tau": 0.4, "clutch.f_normalized": 1.0}, events=1, kinds=("adaptive",),
    ),
    "brake": Hybrid(
        brake, 1.2, ("J", "fn_max"), {"a.w": 1.0}, {"torque.tau": 0.4, "brake.f_normalized": 0.9},
        events=1, kinds=("fixed",),
    ),
    "free wheel": Hybrid(
        free_wheel, 2.5, ("a.J", "b.J", "fn_max", "f", "amplitude"),
        {"b.w": 0.3}, {"wheel.f_normalized": 1.0}, kinds=("adaptive",),
    ),
    "stick-slip": Hybrid(
        stick_slip, 2.0, ("v_fixed", "c", "m", "peak"), {"block.s": 0.01}, events=3, steps=203, kinds=("fixed",)
    ),
    "elastic gap": Hybrid(
        gap, 1.5, ("m", "c", "s_rel0"), {"mass.v": 1.0}, {"force.f": 0.5}
    ),
    "stop": Hybrid(stop, 2.0, ("m", "c", "smax", "F_Coulomb"), {"slider.v": 1.7}, kinds=("fixed",)),
    "resettable integrator": Hybrid(
        integrator, 1.6, ("wave.f", "uHigh", "uLow", "i.k", "set.k"), {"i.y": 0.1}, events=3
    ),
    "averages": Hybrid(averages, 1.2, ("wave.f", "mean.f", "rms.f", "amplitude", "phase"), events=5),
}  # fmt: skip
"""By name; orders of events do not change where a number is moved by a thousandth."""
