"""Parts of the examples (`Modelica.Mechanics.Rotational.Examples.Utilities`): elements with signals for flanges."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from . import compliances, components
from .adaptors import GeneralAngleToTorqueAdaptor, GeneralTorqueToAngleAdaptor
from .interfaces import PartialCompliant
from .torques import Torque

__modelica__ = "Modelica.Mechanics.Rotational.Examples.Utilities"


class DirectInertia(ac.Component):
    """An inertia driven by ``tauDrive`` that gives its motion and takes the torque ``tau`` of what it drives."""

    ICON = icons.boxed(icons.INERTIA, "τ → φ")

    J = ac.Parameter(1.0, unit="kg.m2", min=0, doc="moment of inertia")
    tauDrive = ac.Input(unit="N.m", doc="driving torque")
    tau = ac.Input(unit="N.m", doc="torque that the inertia gives on")
    phi = ac.Output(unit="rad", doc="angle")
    w = ac.Output(unit="rad/s", doc="speed")
    a = ac.Output(unit="rad/s2", doc="acceleration")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        at_rest = ac.Start(0.0, fixed=True)
        self.inertia = components.Inertia(J=self.J, phi=at_rest, w=at_rest)
        self.torqueSource = Torque()
        self.torqueToAngle = GeneralTorqueToAngleAdaptor()
        self.connect(self.tauDrive, self.torqueSource.tau)
        self.connect(self.torqueSource.flange, self.inertia.flange_a)
        self.connect(self.inertia.flange_b, self.torqueToAngle.flange)
        self.connect(self.tau, self.torqueToAngle.f)
        self.connect(self.torqueToAngle.p, self.phi)
        self.connect(self.torqueToAngle.pder, self.w)
        self.connect(self.torqueToAngle.pder2, self.a)


class InverseInertia(ac.Component):
    """An inertia moved as the signals say, and the torque ``tau`` that this takes."""

    ICON = icons.boxed(icons.INERTIA, "φ → τ")

    J = ac.Parameter(1.0, unit="kg.m2", min=0, doc="moment of inertia")
    phi = ac.Input(unit="rad", doc="angle")
    w = ac.Input(unit="rad/s", doc="speed, consistent with phi")
    a = ac.Input(unit="rad/s2", doc="acceleration, consistent with w")
    tau = ac.Output(unit="N.m", doc="torque that drives the inertia")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.inertia = components.Inertia(J=self.J)
        self.angleToTorque = GeneralAngleToTorqueAdaptor()
        self.connect(self.phi, self.angleToTorque.p)
        self.connect(self.w, self.angleToTorque.pder)
        self.connect(self.a, self.angleToTorque.pder2)
        self.connect(self.angleToTorque.flange, self.inertia.flange_a)
        self.connect(self.angleToTorque.f, self.tau)


class SpringDamperNoRelativeStates(PartialCompliant):
    """Spring and damper side by side, without states of their own: ``tau = c (phi_rel - phi_rel0) + d w_rel``."""

    ICON = icons.marked(icons.SPRING_DAMPER, "*")

    c = ac.Parameter(unit="N.m/rad", min=0, doc="spring constant")
    d = ac.Parameter(unit="N.m.s/rad", min=0, doc="damping constant")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="unstretched angle")
    w_rel = ac.Variable(unit="rad/s", doc="relative speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.tau, self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel)


class SpringDamper(ac.Component):
    """Spring and damper between two motions, and the torques that these take."""

    ICON = icons.boxed(icons.SPRING_DAMPER)

    c = ac.Parameter(1e4, unit="N.m/rad", min=0, doc="spring constant")
    d = ac.Parameter(1.0, unit="N.m.s/rad", min=0, doc="damping constant")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="unstretched angle")
    phi1 = ac.Input(unit="rad", doc="angle of the left end")
    w1 = ac.Input(unit="rad/s", doc="speed of the left end")
    tau1 = ac.Output(unit="N.m", doc="torque at the left end")
    phi2 = ac.Input(unit="rad", doc="angle of the right end")
    w2 = ac.Input(unit="rad/s", doc="speed of the right end")
    tau2 = ac.Output(unit="N.m", doc="torque at the right end")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.springDamper = SpringDamperNoRelativeStates(c=self.c, d=self.d, phi_rel0=self.phi_rel0)
        self.angleToTorque1 = GeneralAngleToTorqueAdaptor(use_pder2=False)
        self.angleToTorque2 = GeneralAngleToTorqueAdaptor(use_pder2=False)
        self.connect(self.angleToTorque1.flange, self.springDamper.flange_a)
        self.connect(self.springDamper.flange_b, self.angleToTorque2.flange)
        self.connect(self.phi1, self.angleToTorque1.p)
        self.connect(self.w1, self.angleToTorque1.pder)
        self.connect(self.angleToTorque1.f, self.tau1)
        self.connect(self.phi2, self.angleToTorque2.p)
        self.connect(self.w2, self.angleToTorque2.pder)
        self.connect(self.angleToTorque2.f, self.tau2)


class Spring(ac.Component):
    """A spring between two angles, and the torques that these take."""

    ICON = icons.boxed(icons.SPRING)

    c = ac.Parameter(1e4, unit="N.m/rad", min=0, doc="spring constant")
    phi_rel0 = ac.Parameter(0.0, unit="rad", doc="unstretched angle")
    phi1 = ac.Input(unit="rad", doc="angle of the left end")
    tau1 = ac.Output(unit="N.m", doc="torque at the left end")
    phi2 = ac.Input(unit="rad", doc="angle of the right end")
    tau2 = ac.Output(unit="N.m", doc="torque at the right end")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.spring = compliances.Spring(c=self.c, phi_rel0=self.phi_rel0)
        self.angleToTorque1 = GeneralAngleToTorqueAdaptor(use_pder=False, use_pder2=False)
        self.angleToTorque2 = GeneralAngleToTorqueAdaptor(use_pder=False, use_pder2=False)
        self.connect(self.angleToTorque1.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.angleToTorque2.flange)
        self.connect(self.phi1, self.angleToTorque1.p)
        self.connect(self.angleToTorque1.f, self.tau1)
        self.connect(self.phi2, self.angleToTorque2.p)
        self.connect(self.angleToTorque2.f, self.tau2)
