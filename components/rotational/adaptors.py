"""Elements without a law: choice of states, initialization, and signals instead of flanges."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT

from .interfaces import Flange, PartialTwoFlanges

__modelica__ = "Modelica.Mechanics.Rotational.Components"


class InitializeFlange(ac.Component):
    """Starts a flange from signals: at the initial time ``phi = phi_start``, ``w = w_start``, ``a = a_start``.

    Each of the three holds only with its option ``use_phi_start``, ``use_w_start``, ``use_a_start``.
    The flange carries no torque.
    """

    ICON = icons.block("t = 0")

    use_phi_start = ac.Option(True, doc="whether the initial angle is given")
    use_w_start = ac.Option(True, doc="whether the initial speed is given")
    use_a_start = ac.Option(True, doc="whether the initial acceleration is given")
    stateSelect = ac.Option("default", choices=STATE_SELECT, doc="priority of the flange's states")
    phi_start = ac.Input(unit="rad", when="use_phi_start", doc="initial angle of the flange")
    w_start = ac.Input(unit="rad/s", when="use_w_start", doc="initial speed of the flange")
    a_start = ac.Input(unit="rad/s2", when="use_a_start", doc="initial acceleration of the flange")
    flange = Flange()
    phi_flange = ac.Variable(unit="rad", state="stateSelect", doc="angle of the flange")
    w_flange = ac.Variable(unit="rad/s", state="stateSelect", doc="speed of the flange")
    a_flange = ac.Variable(unit="rad/s2", when="use_a_start", doc="acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.phi_flange, self.flange.phi)
        yield ac.Eq(self.w_flange, ac.der(self.phi_flange))
        yield ac.Eq(self.flange.tau, 0)
        if self.use_a_start:
            yield ac.Eq(self.a_flange, ac.der(self.w_flange))

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.use_phi_start:
            yield ac.Eq(self.phi_flange, self.phi_start)
        if self.use_w_start:
            yield ac.Eq(self.w_flange, self.w_start)
        if self.use_a_start:
            yield ac.Eq(self.a_flange, self.a_start)


class RelativeStates(PartialTwoFlanges):
    """Makes the relative angle ``phi_rel`` and the relative speed ``w_rel`` of two flanges states.

    ``phi_rel = flange_b.phi - flange_a.phi``, ``w_rel = der(phi_rel)``, ``a_rel = der(w_rel)``; no
    torque acts. ``stateSelect`` is ``"always"`` here (Modelica: ``"prefer"``), so that they come
    before the states of inertias. ``phi_nominal`` [rad] is the magnitude of ``phi_rel``.
    """

    ICON = icons.block("Δφ, Δω")

    stateSelect = ac.Option(
        "always", choices=STATE_SELECT, doc="priority of phi_rel, w_rel as states"
    )
    phi_nominal = ac.Option(1.0, doc="nominal value of phi_rel")
    phi_rel = ac.Variable(
        unit="rad",
        state="stateSelect",
        nominal="phi_nominal",
        doc="relative angle, used as a state",
    )
    w_rel = ac.Variable(unit="rad/s", state="stateSelect", doc="relative speed, used as a state")
    a_rel = ac.Variable(unit="rad/s2", doc="relative acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.phi_rel, self.flange_b.phi - self.flange_a.phi)
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.a_rel, ac.der(self.w_rel))
        yield ac.Eq(self.flange_a.tau, 0)
        yield ac.Eq(self.flange_b.tau, 0)


class TorqueToAngleAdaptor(ac.Component):
    """A flange as signals, torque in, motion out: ``flange.tau = tau``, ``phi = flange.phi``.

    ``w = der(phi)`` exists with ``use_w``, ``a = der(w)`` with ``use_a``; as in Modelica ``a`` is 0
    without ``use_w``.
    """

    ICON = icons.block("τ → φ")

    use_w = ac.Option(True, doc="whether the speed is an output")
    use_a = ac.Option(True, doc="whether the acceleration is an output")
    flange = Flange()
    phi = ac.Output(unit="rad", doc="angle of the flange")
    w = ac.Output(unit="rad/s", when="use_w", doc="speed of the flange")
    a = ac.Output(unit="rad/s2", when="use_a", doc="acceleration of the flange")
    tau = ac.Input(unit="N.m", doc="torque into the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.phi, self.flange.phi)
        yield ac.Eq(self.flange.tau, self.tau)
        if self.use_w:
            yield ac.Eq(self.w, ac.der(self.phi))
        if self.use_a:
            yield ac.Eq(self.a, ac.der(self.w) if self.use_w else 0)


class AngleToTorqueAdaptor(ac.Component):
    """A flange as signals, motion in, torque out: ``flange.phi = phi``, ``tau = -flange.tau``.

    ``tau`` [N.m] drives what is connected to the flange. The inputs ``w`` (with ``use_w`` or
    ``use_a``) and ``a`` (with ``use_a``) are taken for the derivatives of ``phi`` wherever the model
    needs them; without, ``phi`` is differentiated.
    """

    ICON = icons.block("φ → τ")

    use_w = ac.Option(True, doc="whether the speed is an input")
    use_a = ac.Option(True, doc="whether the acceleration is an input")
    flange = Flange()
    phi = ac.Input(unit="rad", doc="angle of the flange")
    w = ac.Input(unit="rad/s", when="_with_w", doc="speed of the flange, consistent with phi")
    a = ac.Input(unit="rad/s2", when="use_a", doc="acceleration of the flange, consistent with w")
    tau = ac.Output(unit="N.m", doc="torque that drives what is connected, = -flange.tau")

    @property
    def _with_w(self) -> bool:
        return self.use_w or self.use_a

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.tau, -self.flange.tau)
        rates = [self.w] if self._with_w else []
        rates += [self.a] if self.use_a else []
        yield ac.Eq(self.flange.phi, ac.prescribed(self.phi, *rates))


class GeneralTorqueToAngleAdaptor(ac.Component):
    """A flange as signals, torque in, motion out: ``flange.tau = f``, ``p = flange.phi``.

    ``pder = der(p)`` and ``pder2 = der(pder)`` exist with ``use_pder`` and ``use_pder2``.
    """

    ICON = icons.marked(icons.block("τ → φ"), "*")

    use_pder = ac.Option(True, doc="whether the speed is an output")
    use_pder2 = ac.Option(True, doc="whether the acceleration is an output (needs use_pder)")
    flange = Flange()
    f = ac.Input(unit="N.m", doc="torque into the flange")
    p = ac.Output(unit="rad", doc="angle")
    pder = ac.Output(unit="rad/s", when="use_pder", doc="speed")
    pder2 = ac.Output(unit="rad/s2", when="_with_pder2", doc="acceleration")

    @property
    def _with_pder2(self) -> bool:
        return self.use_pder and self.use_pder2

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p, self.flange.phi)
        yield ac.Eq(self.flange.tau, self.f)
        if self.use_pder:
            yield ac.Eq(self.pder, ac.der(self.p))
        if self._with_pder2:
            yield ac.Eq(self.pder2, ac.der(self.pder))


class GeneralAngleToTorqueAdaptor(ac.Component):
    """A flange as signals, motion in, torque out: ``flange.phi = p``, ``f = -flange.tau``.

    ``f`` [N.m] drives what is connected to the flange. With ``use_pder`` and ``use_pder2`` the inputs
    ``pder`` and ``pder2`` serve as the derivatives of ``p`` where the model needs them;
    without them, ``p`` is differentiated.
    """

    ICON = icons.marked(icons.block("φ → τ"), "*")

    use_pder = ac.Option(True, doc="whether the speed is an input")
    use_pder2 = ac.Option(True, doc="whether the acceleration is an input (needs use_pder)")
    flange = Flange()
    p = ac.Input(unit="rad", doc="angle")
    pder = ac.Input(unit="rad/s", when="use_pder", doc="speed, consistent with p")
    pder2 = ac.Input(unit="rad/s2", when="_with_pder2", doc="acceleration, consistent with pder")
    f = ac.Output(unit="N.m", doc="torque that drives what is connected, = -flange.tau")

    @property
    def _with_pder2(self) -> bool:
        return self.use_pder and self.use_pder2

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.f, -self.flange.tau)
        rates = [self.pder] if self.use_pder else []
        rates += [self.pder2] if self._with_pder2 else []
        yield ac.Eq(self.flange.phi, ac.prescribed(self.p, *rates))
