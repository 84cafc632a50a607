"""Elements without a law: choice of states, initialization, and signals instead of flanges."""

from collections.abc import Iterator

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT

from .interfaces import Flange, PartialTwoFlanges

__modelica__ = "Modelica.Mechanics.Translational.Components"


class InitializeFlange(ac.Component):
    """Starts a flange from signals: at the initial time ``s = s_start``, ``v = v_start``, ``a = a_start``.

    Each of the three holds only with its option ``use_s_start``, ``use_v_start``, ``use_a_start``.
    The flange carries no force.
    """

    ICON = icons.block("t = 0")

    use_s_start = ac.Option(True, doc="whether the initial position is given")
    use_v_start = ac.Option(True, doc="whether the initial speed is given")
    use_a_start = ac.Option(True, doc="whether the initial acceleration is given")
    stateSelect = ac.Option("default", choices=STATE_SELECT, doc="priority of the flange's states")
    s_start = ac.Input(unit="m", when="use_s_start", doc="initial position of the flange")
    v_start = ac.Input(unit="m/s", when="use_v_start", doc="initial speed of the flange")
    a_start = ac.Input(unit="m/s2", when="use_a_start", doc="initial acceleration of the flange")
    flange = Flange()
    s_flange = ac.Variable(unit="m", state="stateSelect", doc="position of the flange")
    v_flange = ac.Variable(unit="m/s", state="stateSelect", doc="speed of the flange")
    a_flange = ac.Variable(unit="m/s2", when="use_a_start", doc="acceleration of the flange")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.s_flange, self.flange.s)
        yield ac.Eq(self.v_flange, ac.der(self.s_flange))
        yield ac.Eq(self.flange.f, 0)
        if self.use_a_start:
            yield ac.Eq(self.a_flange, ac.der(self.v_flange))

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.use_s_start:
            yield ac.Eq(self.s_flange, self.s_start)
        if self.use_v_start:
            yield ac.Eq(self.v_flange, self.v_start)
        if self.use_a_start:
            yield ac.Eq(self.a_flange, self.a_start)


class RelativeStates(PartialTwoFlanges):
    """Makes the distance ``s_rel`` and the relative speed ``v_rel`` of two flanges states.

    ``s_rel = flange_b.s - flange_a.s``, ``v_rel = der(s_rel)``, ``a_rel = der(v_rel)``; no force acts.
    With the default ``stateSelect`` they are preferred over the states of masses.
    """

    ICON = icons.block("Δs, Δv")

    stateSelect = ac.Option(
        "always", choices=STATE_SELECT, doc="priority of s_rel, v_rel as states"
    )
    s_rel = ac.Variable(unit="m", state="stateSelect", doc="distance, used as a state")
    v_rel = ac.Variable(unit="m/s", state="stateSelect", doc="relative speed, used as a state")
    a_rel = ac.Variable(unit="m/s2", doc="relative acceleration")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.s_rel, self.flange_b.s - self.flange_a.s)
        yield ac.Eq(self.v_rel, ac.der(self.s_rel))
        yield ac.Eq(self.a_rel, ac.der(self.v_rel))
        yield ac.Eq(self.flange_a.f, 0)
        yield ac.Eq(self.flange_b.f, 0)


class GeneralForceToPositionAdaptor(ac.Component):
    """A flange as signals, force in, motion out: ``f = flange.f``, ``p = flange.s``.

    ``pder = der(p)`` and ``pder2 = der(pder)`` exist with ``use_pder`` and ``use_pder2``.
    """

    ICON = icons.block("f → s")

    use_pder = ac.Option(True, doc="whether the speed is an output")
    use_pder2 = ac.Option(True, doc="whether the acceleration is an output (needs use_pder)")
    flange = Flange()
    f = ac.Input(unit="N", doc="force")
    p = ac.Output(unit="m", doc="position")
    pder = ac.Output(unit="m/s", when="use_pder", doc="speed")
    pder2 = ac.Output(unit="m/s2", when="_with_pder2", doc="acceleration")

    @property
    def _with_pder2(self) -> bool:
        return self.use_pder and self.use_pder2

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.p, self.flange.s)
        yield ac.Eq(self.f, self.flange.f)
        if self.use_pder:
            yield ac.Eq(self.pder, ac.der(self.p))
        if self._with_pder2:
            yield ac.Eq(self.pder2, ac.der(self.pder))


class GeneralPositionToForceAdaptor(ac.Component):
    """A flange as signals, motion in, force out: ``flange.s = p``, ``f = -flange.f``.

    ``f`` [N] drives what is connected to the flange. With ``use_pder`` and ``use_pder2`` the inputs
    ``pder`` and ``pder2`` serve as the derivatives of ``p`` where the model needs them;
    without them, ``p`` is differentiated.
    """

    ICON = icons.block("s → f")

    use_pder = ac.Option(True, doc="whether the speed is an input")
    use_pder2 = ac.Option(True, doc="whether the acceleration is an input (needs use_pder)")
    flange = Flange()
    p = ac.Input(unit="m", doc="position")
    pder = ac.Input(unit="m/s", when="use_pder", doc="speed, consistent with p")
    pder2 = ac.Input(unit="m/s2", when="_with_pder2", doc="acceleration, consistent with pder")
    f = ac.Output(unit="N", doc="force that drives what is connected, = -flange.f")

    @property
    def _with_pder2(self) -> bool:
        return self.use_pder and self.use_pder2

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.f, -self.flange.f)
        rates = [self.pder] if self.use_pder else []
        rates += [self.pder2] if self._with_pder2 else []
        yield ac.Eq(self.flange.s, ac.prescribed(self.p, *rates))
