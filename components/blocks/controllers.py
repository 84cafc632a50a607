"""Controllers: PI, PID, and PID with limits and anti-windup, made of smaller blocks as in Modelica."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import INIT, LIMITER_HOMOTOPY
from .integrators import Derivative, Integrator
from .interfaces import SISO, PartialState, SVcontrol
from .math import Add, Add3, Gain
from .nonlinear import Limiter
from .sources import Constant

__modelica__ = "Modelica.Blocks.Continuous"


_CONTROLLER = ("P", "PI", "PD", "PID")


class PI(SISO, PartialState):
    """``k (1 + 1/(T s))``: ``der(x) = u/T``, ``y = k (x + u)``."""

    ICON = icons.PI

    k = ac.Parameter(1.0, doc="gain")
    T = ac.Parameter(unit="s", min=0, doc="time constant")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    x_start = ac.Parameter(0.0, doc="initial or guess value of the state")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    x = ac.Variable(start="x_start", doc="state: the integral part")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.x), self.u / self.T)
        yield ac.Eq(self.y, self.k * (self.x + self.u))


class PID(SISO):
    """``k (1 + 1/(Ti s) + Td s/(Td/Nd s + 1))``, of the blocks `P`, `I`, `D`, `Add` and `Gain`.

    The integrator starts at ``xi_start``, the state of the derivative at ``xd_start``; ``initType`` as
    in Modelica.
    """

    ICON = icons.PID

    k = ac.Parameter(1.0, doc="gain")
    Ti = ac.Parameter(unit="s", min=0, doc="time constant of the integrator")
    Td = ac.Parameter(unit="s", min=0, doc="time constant of the derivative")
    Nd = ac.Parameter(10.0, min=0, doc="the higher, the more ideal the derivative")
    initType = ac.Option("InitialState", choices=INIT, doc="type of initialization")
    xi_start = ac.Parameter(0.0, doc="initial or guess value of the integrator")
    xd_start = ac.Parameter(0.0, doc="initial or guess value of the derivative's state")
    y_start = ac.Parameter(0.0, doc="initial value of the output")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.P = Gain(k=1)
        self.I = _integral(self)
        self.D = _derivative(self, shortest=100 * 2.220446049250313e-16)
        self.Gain = Gain(k=self.k)
        self.Add = Add3()
        self.connect(self.u, self.P.u)
        self.connect(self.u, self.I.u)
        self.connect(self.u, self.D.u)
        self.connect(self.P.y, self.Add.u1)
        self.connect(self.I.y, self.Add.u2)
        self.connect(self.D.y, self.Add.u3)
        self.connect(self.Add.y, self.Gain.u)
        self.connect(self.Gain.y, self.y)

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.initType == "InitialOutput":
            yield ac.Eq(self.y, self.y_start)


class LimPID(SVcontrol):
    """PID controller with limited output, anti-windup, set-point weights and feed-forward.

    ``y = limiter(k (wp u_s - u_m + I + D) + kFF u_ff)`` between ``yMin`` (default ``-yMax``) and ``yMax``;
    ``I`` integrates ``(u_s - u_m + (y - unlimited)/(k Ni))/Ti``, ``D`` is the approximate derivative of
    ``Td (wd u_s - u_m)``. ``controllerType`` chooses ``"P"``, ``"PI"``, ``"PD"`` or ``"PID"``;
    ``withFeedForward`` adds the input ``u_ff``. The parts have Modelica's names: `addP`, `P`, `addI`, `I`,
    `addSat`, `gainTrack`, `addD`, `D`, `addPID`, `gainPID`, `addFF`, `limiter`. ``strict`` and
    ``homotopyType`` have no effect. Choose options where the controller is made.
    """

    ICON = icons.marked(icons.PID, "lim")

    controllerType = ac.Option("PID", choices=_CONTROLLER, doc="type of controller")
    k = ac.Parameter(1.0, min=0, doc="gain")
    Ti = ac.Parameter(0.5, unit="s", min=0, doc="time constant of the integrator")
    Td = ac.Parameter(0.1, unit="s", min=0, doc="time constant of the derivative")
    yMax = ac.Parameter(doc="upper limit of the output")
    yMin = ac.Parameter(lambda self: -self.yMax, doc="lower limit of the output")
    wp = ac.Parameter(1.0, min=0, doc="weight of the set point in the proportional part")
    wd = ac.Parameter(0.0, min=0, doc="weight of the set point in the derivative part")
    Ni = ac.Parameter(0.9, min=0, doc="Ni Ti is the time constant of the anti-windup")
    Nd = ac.Parameter(10.0, min=0, doc="the higher, the more ideal the derivative")
    withFeedForward = ac.Option(False, doc="whether there is the input u_ff")
    kFF = ac.Parameter(1.0, doc="gain of the feed-forward")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    xi_start = ac.Parameter(0.0, doc="initial or guess value of the integrator")
    xd_start = ac.Parameter(0.0, doc="initial or guess value of the derivative's state")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    strict = ac.Option(False, doc="without effect")
    homotopyType = ac.Option("Linear", choices=LIMITER_HOMOTOPY, doc="without effect")
    u_ff = ac.Input(when="withFeedForward", doc="feed-forward signal")
    controlError = ac.Variable(doc="set point minus measurement")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        with_I, with_D = "I" in self.controllerType, "D" in self.controllerType
        self.addP = Add(k1=self.wp, k2=-1)
        self.P = Gain(k=1)
        self.addPID = Add3()
        self.gainPID = Gain(k=self.k)
        self.addFF = Add(k2=self.kFF)
        self.limiter = Limiter(uMax=self.yMax, uMin=self.yMin)
        self.connect(self.u_s, self.addP.u1)
        self.connect(self.u_m, self.addP.u2)
        self.connect(self.addP.y, self.P.u)
        self.connect(self.P.y, self.addPID.u1)
        self.connect(self.addPID.y, self.gainPID.u)
        self.connect(self.gainPID.y, self.addFF.u1)
        self.connect(self.addFF.y, self.limiter.u)
        self.connect(self.limiter.y, self.y)
        if with_D:
            self._differentiate()
        else:
            self.Dzero = Constant(k=0)
            self.connect(self.Dzero.y, self.addPID.u2)
        if with_I:
            self._integrate()
        else:
            self.Izero = Constant(k=0)
            self.connect(self.Izero.y, self.addPID.u3)
        if self.withFeedForward:
            self.connect(self.u_ff, self.addFF.u2)
        else:
            self.FFzero = Constant(k=0)
            self.connect(self.FFzero.y, self.addFF.u2)

    def _differentiate(self) -> None:
        self.addD = Add(k1=self.wd, k2=-1)
        self.D = _derivative(self, shortest=1e-14)
        self.connect(self.u_s, self.addD.u1)
        self.connect(self.u_m, self.addD.u2)
        self.connect(self.addD.y, self.D.u)
        self.connect(self.D.y, self.addPID.u2)

    def _integrate(self) -> None:
        self.addI = Add3(k2=-1)
        self.I = _integral(self)
        self.addSat = Add(k2=-1)
        self.gainTrack = Gain(k=1 / (self.k * self.Ni))
        self.connect(self.u_s, self.addI.u1)
        self.connect(self.u_m, self.addI.u2)
        self.connect(self.limiter.y, self.addSat.u1)
        self.connect(self.addFF.y, self.addSat.u2)
        self.connect(self.addSat.y, self.gainTrack.u)
        self.connect(self.gainTrack.y, self.addI.u3)
        self.connect(self.addI.y, self.I.u)
        self.connect(self.I.y, self.addPID.u3)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.controlError, self.u_s - self.u_m)

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.initType == "InitialOutput":
            yield ac.Eq(self.gainPID.y, self.y_start)


def _integral(owner: PID | LimPID) -> Integrator:
    """The integral part of a controller."""
    kept = owner.initType in ("SteadyState", "InitialState")
    initType = owner.initType if kept else "NoInit"
    return Integrator(k=1 / owner.Ti, y_start=owner.xi_start, initType=initType)


def _derivative(owner: PID | LimPID, *, shortest: float) -> Derivative:
    """The derivative part of a controller."""
    steady = "SteadyState" if owner.initType == "InitialOutput" else owner.initType
    T = ac.maximum(owner.Td / owner.Nd, shortest)
    return Derivative(k=owner.Td, T=T, x_start=owner.xd_start, initType=steady)
