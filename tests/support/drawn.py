"""Models to draw."""

from __future__ import annotations

import acausal as ac
from acausal.components import blocks, electrical as el, rotational as rot, translational as tl


class Controller(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.reference, self.speed, self.voltage = ac.Input(), ac.Input(), ac.Output()
        self.error, self.pi, self.limit = blocks.Feedback(), blocks.PI(), blocks.Limiter(uMax=24)
        self.connect(self.reference, self.error.u1)
        self.connect(self.speed, self.error.u2)
        self.connect(self.error.y, self.pi.u)
        self.connect(self.pi.y, self.limit.u)
        self.connect(self.limit.y, self.voltage)


class Drive(ac.Component):
    """A controlled motor: electrical, rotational and signals, with a sub-model and a loop."""

    def __init__(self) -> None:
        super().__init__()
        self.step, self.controller = blocks.Step(height=100), Controller()
        self.supply, self.ground = el.SignalVoltage(), el.Ground()
        self.r, self.l = el.Resistor(R=0.5), el.Inductor(L=1e-3)
        self.motor, self.rotor = el.RotationalEMF(k=0.1), rot.Inertia(J=1e-3)
        self.gear, self.load = rot.IdealGear(ratio=5), rot.Inertia(J=0.1)
        self.sensor = rot.SpeedSensor()
        self.connect(self.step.y, self.controller.reference)
        self.connect(self.controller.voltage, self.supply.v)
        self.connect(self.supply.p, self.r.p)
        self.connect(self.r.n, self.l.p)
        self.connect(self.l.n, self.motor.p)
        self.connect(self.motor.n, self.supply.n, self.ground.p)
        self.connect(self.motor.flange, self.rotor.flange_a)
        self.connect(self.rotor.flange_b, self.gear.flange_a, self.sensor.flange)
        self.connect(self.gear.flange_b, self.load.flange_a)
        self.connect(self.sensor.w, self.controller.speed)


class Bridge(ac.Component):
    """A rectifier whose source is not grounded."""

    def __init__(self) -> None:
        super().__init__()
        self.source, self.ground = el.SineVoltage(V=1, f=50), el.Ground()
        self.capacitor, self.load = el.Capacitor(C=1e-3), el.Resistor(R=10)
        self.d1, self.d2, self.d3, self.d4 = (el.IdealDiode() for _ in range(4))
        self.connect(self.source.p, self.d1.p, self.d3.n)
        self.connect(self.source.n, self.d2.p, self.d4.n)
        self.connect(self.d1.n, self.d2.n, self.capacitor.p, self.load.p)
        self.connect(self.d3.p, self.d4.p, self.capacitor.n, self.load.n, self.ground.p)


class Chain(ac.Component):
    """Masses and springs from a wall to a force."""

    def __init__(self, length: int) -> None:
        super().__init__()
        self.wall, self.push = tl.Fixed(), tl.Force()
        self.mass = [tl.Mass(m=1) for _ in range(length)]
        self.spring = [tl.SpringDamper(c=1, d=1) for _ in range(length)]
        self.connect(self.wall.flange, self.spring[0].flange_a)
        for i in range(length):
            self.connect(self.spring[i].flange_b, self.mass[i].flange_a)
            if i + 1 < length:
                self.connect(self.mass[i].flange_b, self.spring[i + 1].flange_a)
        self.connect(self.mass[-1].flange_b, self.push.flange)


class Tree(ac.Component):
    """As many masses as asked for, under names of their own, each on a spring from an earlier one."""

    def __init__(self, masses: int) -> None:
        super().__init__()
        self.mass_0 = tl.Mass(m=1)
        for i in range(1, masses):
            mass, spring = tl.Mass(m=1), tl.Spring(c=1)
            setattr(self, f"mass_{i}", mass)
            setattr(self, f"spring_{i}", spring)
            self.connect(getattr(self, f"mass_{i * 7919 % i // 2}").flange_b, spring.flange_a)
            self.connect(spring.flange_b, mass.flange_a)


class Cascade(ac.Component):
    """Speed control of a drive in two loops, one around the other."""

    def __init__(self) -> None:
        super().__init__()
        self.ref = blocks.Step()
        self.outer, self.inner = blocks.Feedback(), blocks.Feedback()
        self.pi, self.gain = blocks.PI(k=2.0, T=0.5), blocks.Gain(k=5.0)
        self.torque = rot.Torque()
        self.motor, self.load = rot.Inertia(J=0.3), rot.Inertia(J=0.6)
        self.shaft = rot.SpringDamper(c=40.0, d=0.4)
        self.near, self.far = rot.SpeedSensor(), rot.SpeedSensor()
        self.connect(self.ref.y, self.outer.u1)
        self.connect(self.far.w, self.outer.u2)
        self.connect(self.outer.y, self.pi.u)
        self.connect(self.pi.y, self.inner.u1)
        self.connect(self.near.w, self.inner.u2)
        self.connect(self.inner.y, self.gain.u)
        self.connect(self.gain.y, self.torque.tau)
        self.connect(self.torque.flange, self.motor.flange_a, self.near.flange)
        self.connect(self.motor.flange_b, self.shaft.flange_a)
        self.connect(self.shaft.flange_b, self.load.flange_a)
        self.connect(self.load.flange_b, self.far.flange)
