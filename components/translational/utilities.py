"""Parts of the examples (`Modelica.Mechanics.Translational.Examples.Utilities`): elements with signals for flanges."""

from collections.abc import Iterator
from math import exp
from typing import Any

import acausal as ac
from acausal.components import icons

from . import components
from .adaptors import GeneralForceToPositionAdaptor, GeneralPositionToForceAdaptor
from .forces import Force
from .interfaces import PartialCompliant

__modelica__ = "Modelica.Mechanics.Translational.Examples.Utilities"


class DirectMass(ac.Component):
    """A mass driven by ``fDrive`` that gives its motion and takes the force ``f`` of what it drives."""

    ICON = icons.boxed(icons.MASS, "f → s")

    m = ac.Parameter(1.0, unit="kg", min=0, doc="mass")
    fDrive = ac.Input(unit="N", doc="driving force")
    f = ac.Input(unit="N", doc="force that the mass gives on")
    s = ac.Output(unit="m", doc="position")
    v = ac.Output(unit="m/s", doc="speed")
    a = ac.Output(unit="m/s2", doc="acceleration")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        at_rest = ac.Start(0.0, fixed=True)
        self.mass = components.Mass(m=self.m, s=at_rest, v=at_rest)
        self.forceSource = Force()
        self.forceToPosition = GeneralForceToPositionAdaptor()
        self.connect(self.fDrive, self.forceSource.f)
        self.connect(self.forceSource.flange, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.forceToPosition.flange)
        self.connect(self.f, self.forceToPosition.f)
        self.connect(self.forceToPosition.p, self.s)
        self.connect(self.forceToPosition.pder, self.v)
        self.connect(self.forceToPosition.pder2, self.a)


class InverseMass(ac.Component):
    """A mass moved as the signals say, and the force ``f`` that this takes."""

    ICON = icons.boxed(icons.MASS, "s → f")

    m = ac.Parameter(1.0, unit="kg", min=0, doc="mass")
    s = ac.Input(unit="m", doc="position")
    v = ac.Input(unit="m/s", doc="speed, consistent with s")
    a = ac.Input(unit="m/s2", doc="acceleration, consistent with v")
    f = ac.Output(unit="N", doc="force that drives the mass")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.mass = components.Mass(m=self.m)
        self.positionToForce = GeneralPositionToForceAdaptor()
        self.connect(self.s, self.positionToForce.p)
        self.connect(self.v, self.positionToForce.pder)
        self.connect(self.a, self.positionToForce.pder2)
        self.connect(self.positionToForce.flange, self.mass.flange_a)
        self.connect(self.positionToForce.f, self.f)


class SpringDamperNoRelativeStates(PartialCompliant):
    """Spring and damper side by side, without states of their own: ``f = c (s_rel - s_rel0) + d v_rel``."""

    ICON = icons.marked(icons.SPRING_DAMPER, "*")

    c = ac.Parameter(unit="N/m", min=0, doc="spring constant")
    d = ac.Parameter(unit="N.s/m", min=0, doc="damping constant")
    s_rel0 = ac.Parameter(0.0, unit="m", doc="unstretched length")
    v_rel = ac.Variable(unit="m/s", doc="relative speed")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.v_rel, ac.der(self.s_rel))
        yield ac.Eq(self.f, self.c * (self.s_rel - self.s_rel0) + self.d * self.v_rel)


class SpringDamper(ac.Component):
    """Spring and damper between two motions, and the forces that these take."""

    ICON = icons.boxed(icons.SPRING_DAMPER)

    c = ac.Parameter(1e4, unit="N/m", min=0, doc="spring constant")
    d = ac.Parameter(1.0, unit="N.s/m", min=0, doc="damping constant")
    s_rel0 = ac.Parameter(0.0, unit="m", doc="unstretched length")
    s1 = ac.Input(unit="m", doc="position of the left end")
    v1 = ac.Input(unit="m/s", doc="speed of the left end")
    f1 = ac.Output(unit="N", doc="force at the left end")
    s2 = ac.Input(unit="m", doc="position of the right end")
    v2 = ac.Input(unit="m/s", doc="speed of the right end")
    f2 = ac.Output(unit="N", doc="force at the right end")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.springDamper = SpringDamperNoRelativeStates(c=self.c, d=self.d, s_rel0=self.s_rel0)
        self.positionToForce1 = GeneralPositionToForceAdaptor(use_pder2=False)
        self.positionToForce2 = GeneralPositionToForceAdaptor(use_pder2=False)
        self.connect(self.positionToForce1.flange, self.springDamper.flange_a)
        self.connect(self.springDamper.flange_b, self.positionToForce2.flange)
        self.connect(self.s1, self.positionToForce1.p)
        self.connect(self.v1, self.positionToForce1.pder)
        self.connect(self.positionToForce1.f, self.f1)
        self.connect(self.s2, self.positionToForce2.p)
        self.connect(self.v2, self.positionToForce2.pder)
        self.connect(self.positionToForce2.f, self.f2)


class Spring(ac.Component):
    """A spring between two positions, and the forces that these take."""

    ICON = icons.boxed(icons.SPRING)

    c = ac.Parameter(1e4, unit="N/m", min=0, doc="spring constant")
    s_rel0 = ac.Parameter(0.0, unit="m", doc="unstretched length")
    s1 = ac.Input(unit="m", doc="position of the left end")
    f1 = ac.Output(unit="N", doc="force at the left end")
    s2 = ac.Input(unit="m", doc="position of the right end")
    f2 = ac.Output(unit="N", doc="force at the right end")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.spring = components.Spring(c=self.c, s_rel0=self.s_rel0)
        self.positionToForce1 = GeneralPositionToForceAdaptor(use_pder=False, use_pder2=False)
        self.positionToForce2 = GeneralPositionToForceAdaptor(use_pder=False, use_pder2=False)
        self.connect(self.positionToForce1.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.positionToForce2.flange)
        self.connect(self.s1, self.positionToForce1.p)
        self.connect(self.positionToForce1.f, self.f1)
        self.connect(self.s2, self.positionToForce2.p)
        self.connect(self.positionToForce2.f, self.f2)


def GenerateStribeckFrictionTable(
    F_prop: float,
    F_Coulomb: float,
    F_Stribeck: float,
    fexp: float,
    v_max: float,
    nTable: float = 100,
) -> list[list[float]]:
    """Rows ``[v, F_Coulomb + F_prop v + F_Stribeck exp(-fexp v)]`` for ``nTable`` speeds from 0 to ``v_max``."""
    speeds = [v_max * i / (int(nTable) - 1) for i in range(int(nTable))]
    return [[v, F_Coulomb + F_prop * v + F_Stribeck * exp(-fexp * v)] for v in speeds]
