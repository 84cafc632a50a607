"""A vehicle on a road: its mass, its wheels, and what resists."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons, nature
from acausal.components.blocks import Atan, Constant, Gain, Sin
from acausal.components.mechanics import rotational, translational
from acausal.components.mechanics.rolling import IdealRollingWheel
from acausal.components.rotational.components import Inertia

from .components import Mass
from .forces import Force, QuadraticSpeedDependentForce
from .friction import RollingResistance
from .sources import Speed

__modelica__ = "Modelica.Mechanics.Translational.Components"


class Vehicle(ac.Component):
    """A vehicle of mass ``m`` on wheels of radius ``R``, driven at ``flangeR``, coupled at ``flangeT``.

    With the slope's angle ``alpha``, ``tan(alpha) = inclination``:
    ``(m + J/R**2) a = flangeR.tau/R + flangeT.f - Cd rho A/2 u |u| - Cr m g cos(alpha) sign(v) - m g sin(alpha)``
    with the speed ``u = v - vWind`` against the air. The sign is linear below ``vReg``. Wind, rolling
    resistance ``cr`` and inclination are parameters or input signals. The parts have Modelica's names.
    """

    ICON = icons.VEHICLE

    m = ac.Parameter(unit="kg", min=0, doc="total mass")
    g = ac.Parameter(nature.g_n, unit="m/s2", doc="acceleration of gravity")
    J = ac.Parameter(unit="kg.m2", min=0, doc="inertia of the drive train, seen at the wheels")
    R = ac.Parameter(unit="m", doc="radius of the wheels")
    A = ac.Parameter(unit="m2", doc="cross section")
    Cd = ac.Parameter(doc="drag coefficient")
    rho = ac.Parameter(1.2, unit="kg/m3", doc="density of air")
    useWindInput = ac.Option(False, doc="whether vWind is an input")
    vWindConstant = ac.Parameter(0.0, unit="m/s", doc="speed of the wind without input")
    useCrInput = ac.Option(False, doc="whether cr is an input")
    CrConstant = ac.Parameter(0.015, doc="coefficient of rolling resistance without input")
    vReg = ac.Parameter(1e-3, unit="m/s", min=0, doc="speed below which the sign is smoothed")
    useInclinationInput = ac.Option(False, doc="whether inclination is an input")
    inclinationConstant = ac.Parameter(0.0, doc="inclination without input, = tan(angle)")
    flangeR = rotational.Flange()
    flangeT = translational.Flange()
    inclination = ac.Input(when="useInclinationInput", doc="inclination, = tan(angle)")
    cr = ac.Input(when="useCrInput", doc="coefficient of rolling resistance")
    vWind = ac.Input(unit="m/s", when="useWindInput", doc="speed of the wind")
    s = ac.Variable(unit="m", doc="position")
    v = ac.Variable(unit="m/s", doc="speed")
    a = ac.Variable(unit="m/s2", doc="acceleration")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        drag = self.Cd * self.A * self.rho / 2
        self.inertia = Inertia(J=self.J)
        self.idealRollingWheel = IdealRollingWheel(radius=self.R)
        self.mass = Mass(m=self.m)
        self.fDrag = QuadraticSpeedDependentForce(
            f_nominal=-drag, v_nominal=1.0, ForceDirection=False, useSupport=True
        )
        self.fRoll = RollingResistance(
            fWeight=self.m * self.g,
            useCrInput=self.useCrInput,
            CrConstant=self.CrConstant,
            useInclinationInput=self.useInclinationInput,
            inclinationConstant=self.inclinationConstant,
            reg="Linear",
            v0=self.vReg,
        )
        self.fGrav = Force()
        self.gravForceGain = Gain(k=-self.m * self.g)
        self.atan, self.sin = Atan(), Sin()
        self.windSpeed = Speed(s=ac.Start(fixed=True))
        self.connect(self.flangeR, self.inertia.flange_a)
        self.connect(self.inertia.flange_b, self.idealRollingWheel.flangeR)
        self.connect(self.idealRollingWheel.flangeT, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.flangeT)
        for force in (self.fDrag, self.fRoll, self.fGrav):
            self.connect(self.mass.flange_b, force.flange)
        self.connect(self.windSpeed.flange, self.fDrag.support)
        self.connect(self._inclination(), self.atan.u)
        self.connect(self.atan.y, self.sin.u)
        self.connect(self.sin.y, self.gravForceGain.u)
        self.connect(self.gravForceGain.y, self.fGrav.f)
        self.connect(self._wind(), self.windSpeed.v_ref)
        if self.useCrInput:
            self.connect(self.cr, self.fRoll.cr)

    def _inclination(self) -> Any:
        if self.useInclinationInput:
            self.connect(self.inclination, self.fRoll.inclination)
            return self.inclination
        self.constInclination = Constant(k=self.inclinationConstant)
        return self.constInclination.y

    def _wind(self) -> Any:
        if self.useWindInput:
            return self.vWind
        self.constWindSpeed = Constant(k=self.vWindConstant)
        return self.constWindSpeed.y

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.s, self.mass.s)
        yield ac.Eq(self.v, self.mass.v)
        yield ac.Eq(self.a, self.mass.a)
