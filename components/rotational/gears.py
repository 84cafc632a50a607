"""Gears: ideal, with losses, planetary, and from rotation to translation."""

from collections.abc import Iterator
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import icons
from acausal.components.choices import STATE_SELECT
from acausal.components.laws import SMOOTHNESS, lookup
from acausal.components.mechanics.friction import BACKWARD, FORWARD, FREE, STUCK, Moded
from acausal.components.thermal import HeatPort
from acausal.components.thermal.interfaces import PartialElementaryConditionalHeatPortWithoutT

from .compliances import ElastoBacklash
from .interfaces import (
    Flange,
    PartialElementaryTwoFlangesAndSupport2,
    PartialTwoFlangesAndSupport,
)

__modelica__ = "Modelica.Mechanics.Rotational.Components"


_LOSSLESS = (0.0, 1.0, 1.0, 0.0, 0.0)
"""The only row of a loss table without losses."""

_EPS = 1e-15
"""An efficiency that is so near to 1 counts as 1."""


class IdealGear(PartialElementaryTwoFlangesAndSupport2):
    """Ideal gear: ``phi_a = ratio phi_b``, ``0 = ratio flange_a.tau + flange_b.tau``."""

    ICON = icons.GEAR

    ratio = ac.Parameter(doc="transmission ratio phi_a / phi_b")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_a, self.ratio * self.phi_b)
        yield ac.Eq(0, self.ratio * self.flange_a.tau + self.flange_b.tau)


class IdealPlanetary(ac.Component):
    """Ideal planetary gear of sun, carrier and ring.

    ``(1 + ratio) carrier.phi = sun.phi + ratio ring.phi``, ``ring.tau = ratio sun.tau``,
    ``carrier.tau = -(1 + ratio) sun.tau``.
    """

    ICON = icons.PLANETARY

    ratio = ac.Parameter(doc="teeth of the ring over teeth of the sun")
    sun = Flange()
    carrier = Flange()
    ring = Flange()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq((1 + self.ratio) * self.carrier.phi, self.sun.phi + self.ratio * self.ring.phi)
        yield ac.Eq(self.ring.tau, self.ratio * self.sun.tau)
        yield ac.Eq(self.carrier.tau, -(1 + self.ratio) * self.sun.tau)


class _Lossy(ac.Component):
    """A gear with a table of losses: rows of ``|w_a|, eta_mf1, eta_mf2, |tau_bf1|, |tau_bf2|``."""

    ratio = ac.Parameter(doc="transmission ratio flange_a.phi / flange_b.phi")
    lossTable = ac.Parameter(
        [_LOSSLESS], shape=(":", ":"), doc="rows of speed, two efficiencies, two bearing torques"
    )
    ideal = ac.Option(True, doc="whether there are no losses: no lossTable, or one without")

    def modify(self, **modifiers: Any) -> None:
        """Set parameters, options and starts by name; a ``lossTable`` decides on ``ideal``."""
        if "lossTable" in modifiers:
            table = np.asarray(modifiers["lossTable"], dtype=object)
            if table.ndim != 2 or table.shape[1] != len(_LOSSLESS):
                raise ac.DeclarationError(
                    f"{type(self).__name__}.lossTable needs rows of 5 numbers: |w_a|, eta_mf1, "
                    f"eta_mf2, |tau_bf1|, |tau_bf2|; its shape is {table.shape}"
                )
            modifiers = {"ideal": bool(np.array_equal(table, [_LOSSLESS])), **modifiers}
        super().modify(**modifiers)


class LossyGear(
    PartialElementaryTwoFlangesAndSupport2,
    Moded,
    PartialElementaryConditionalHeatPortWithoutT,
    _Lossy,
):
    """Gear with friction between the teeth and in the bearings.

    ``phi_a = ratio phi_b``, ``0 = flange_b.tau + ratio (flange_a.tau - tauLoss)``, ``w_a = der(phi_a)``,
    ``lossPower = tauLoss w_a``. The table gives, by ``|w_a|``, the efficiencies of the teeth
    ``eta_mf1`` (``flange_a`` drives) and ``eta_mf2`` (``flange_b`` drives) and the bearings' torques
    ``tau_bf1``, ``tau_bf2`` [N.m] in these two cases. With ``tau = flange_a.tau``, while it rolls

    - forward ``tauLoss = tauLossMax``, which is ``(1 - eta_mf1) tau + tau_bf1`` where ``flange_a`` drives, else
      ``(1 - 1/eta_mf2) tau + tau_bf2``;
    - backward ``tauLoss = tauLossMin``, which is ``(1 - eta_mf1) tau - tau_bf1`` where ``flange_a`` drives, else
      ``(1 - 1/eta_mf2) tau - tau_bf2``.

    At rest it locks (``mode``, see `PartialFriction`): ``tauLoss = sa`` is what holds it, up to these losses at
    ``w_a = 0``. With ``smooth``, the greater loss forward, and the smaller one backward, are multiplied by
    ``|tanh(w_a/w_small)|``: the gear creeps, and never gives power. ``eta_mf1`` to ``tauLossMin``, and ``mode``, exist
    only where there are losses.
    """

    ICON = icons.marked(icons.GEAR, "η")

    smoothness = ac.Option("LinearSegments", choices=SMOOTHNESS, doc="interpolation of the table")
    w_small = ac.Parameter(
        1e-4, unit="rad/s", min=0, doc="speed below which losses are smoothed, with smooth"
    )
    w_a = ac.Variable(unit="rad/s", doc="speed of flange_a relative to the support")
    a_a = ac.Variable(unit="rad/s2", doc="acceleration of flange_a relative to the support")
    eta_mf1 = ac.Variable(
        unit="1", when="not ideal", doc="efficiency of the teeth, flange_a drives"
    )
    eta_mf2 = ac.Variable(
        unit="1", when="not ideal", doc="efficiency of the teeth, flange_b drives"
    )
    tau_bf1 = ac.Variable(unit="N.m", when="not ideal", doc="bearing torque, flange_a drives")
    tau_bf2 = ac.Variable(unit="N.m", when="not ideal", doc="bearing torque, flange_b drives")
    tauLossMax = ac.Variable(unit="N.m", when="not ideal", doc="loss while rolling forward")
    tauLossMin = ac.Variable(unit="N.m", when="not ideal", doc="loss while rolling backward")
    tauLoss = ac.Variable(unit="N.m", doc="torque lost, at flange_a")
    tau_bf_a = ac.Variable(unit="N.m", when="_locks", doc="bearing torque at flange_a")
    tau_eta = ac.Variable(unit="N.m", when="_locks", doc="torque whose sign says which side drives")
    tauLossMax_p = ac.Variable(unit="N.m", when="_locks", doc="loss where it starts forward")
    tauLossMin_m = ac.Variable(unit="N.m", when="_locks", doc="loss where it starts backward")
    tau_etaPos = ac.Discrete(True, kind="bool", when="_locks", doc="1 where tau_eta >= 0")
    tau_aPos = ac.Discrete(True, kind="bool", when="_locks", doc="tau_etaPos")
    mode = ac.Discrete(
        FREE, kind="int", when="_locks", doc="-1 rolling backward, 0 stuck, 1 rolling forward"
    )

    @property
    def _locks(self) -> bool:
        return not (self.smooth or self.ideal)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.phi_a, self.ratio * self.phi_b)
        yield ac.Eq(0, self.flange_b.tau + self.ratio * (self.flange_a.tau - self.tauLoss))
        yield ac.Eq(self.w_a, ac.der(self.phi_a))
        yield ac.Eq(self.a_a, ac.der(self.w_a))
        yield ac.Eq(self.lossPower, self.tauLoss * self.w_a)
        if self.ideal:
            yield ac.Eq(self.tauLoss, 0)
            return
        found = self.eta_mf1, self.eta_mf2, self.tau_bf1, self.tau_bf2
        for variable, value in zip(found, self._table(ac.Abs(self.w_a)), strict=True):
            yield ac.Eq(variable, value)
        yield from self._smooth_losses() if self.smooth else self._losses()

    def _table(self, w: Any) -> Iterator[Any]:
        """The efficiencies of the teeth, and the bearings' torques, at a speed."""
        for column in range(1, len(_LOSSLESS)):
            points = [(row[0], row[column]) for row in self.lossTable]
            value = lookup(w, points, self.smoothness)
            yield value if column < 3 else ac.Abs(value)

    def _smooth_losses(self) -> Iterator[ac.Eq]:
        quadrants = self._quadrants(self.eta_mf1, self.eta_mf2, self.tau_bf1, self.tau_bf2)
        yield ac.Eq(self.tauLossMax, ac.maximum(quadrants[0], quadrants[1]))
        yield ac.Eq(self.tauLossMin, ac.minimum(quadrants[2], quadrants[3]))
        rolling = ac.tanh(self.w_a / self.w_small)
        forward, backward = rolling * self.tauLossMax, -rolling * self.tauLossMin
        yield ac.Eq(self.tauLoss, ac.where(self.w_a < 0, backward, forward))

    def _quadrants(self, eta1: Any, eta2: Any, bearing1: Any, bearing2: Any) -> tuple[Any, ...]:
        """Losses: forward with ``flange_a`` driving and not, backward with ``flange_a.tau`` negative and not."""
        tau = self.flange_a.tau
        by_a, by_b = (1 - eta1) * tau, (1 - 1 / eta2) * tau
        return by_a + bearing1, by_b + bearing2, by_a - bearing1, by_b - bearing2

    def _losses(self) -> Iterator[ac.Eq]:
        at_rest = tuple(self._table(0))
        found = self.eta_mf1, self.eta_mf2, self.tau_bf1, self.tau_bf2
        tau, starts_at = self.flange_a.tau, _at_flange_a(*at_rest)
        first = self._quadrants(*at_rest)
        forward = self.startForward | self._was(FORWARD)
        yield ac.Eq(self.tau_bf_a, _at_flange_a(*found))
        yield ac.Eq(self.tauLossMax_p, ac.where(tau - starts_at > 0, first[0], first[1]))
        yield ac.Eq(self.tauLossMin_m, ac.where(tau + starts_at > 0, first[3], first[2]))
        bearing = ac.where(self.locked, 0, ac.where(forward, -self.tau_bf_a, self.tau_bf_a))
        yield ac.Eq(self.tau_eta, tau + bearing)
        yield ac.Eq(self.tau_etaPos, (1 - self.locked) * self.tau_eta >= 0)
        yield ac.Eq(self.tau_aPos, self.tau_etaPos)
        losses = self._quadrants(*found)
        yield ac.Eq(self.tauLossMax, ac.where(self.tau_etaPos, losses[0], losses[1]))
        yield ac.Eq(self.tauLossMin, ac.where(self.tau_etaPos, losses[3], losses[2]))
        moves = 1 - self.locked
        yield ac.Eq(self.a_a, ac.where(self.locked, 0, self.sa) - moves * self.tauLoss)
        rolling = ac.where(forward, self.tauLossMax, self.tauLossMin)
        yield ac.Eq(self.tauLoss, ac.where(self.locked, self.sa, rolling))
        yield from self._rolls()

    def _rolls(self) -> Iterator[ac.Eq]:
        """When it rolls, and when it starts to."""
        ahead, back = self._goes_forward(self.w_a), self._goes_backward(self.w_a)
        starts_ahead = self._gives_way(self.startForward, self.sa, self.tauLossMax_p)
        starts_back = self._gives_way(self.startBackward, -self.sa, -self.tauLossMin_m)
        yield ac.Eq(self.startForward, starts_ahead | (ac.initial() & ahead))
        yield ac.Eq(self.startBackward, starts_back | (ac.initial() & back))
        yield ac.Eq(self.locked, ~self._slides)
        yield ac.Eq(self.mode, ac.where(ahead, FORWARD, ac.where(back, BACKWARD, STUCK)))


def _at_flange_a(eta1: Any, eta2: Any, bearing1: Any, bearing2: Any) -> Any:
    """The bearing torque at ``flange_a``; half of it all where the teeth have no losses that would tell."""
    lossless = (ac.Abs(eta1 - 1) < _EPS) & (ac.Abs(eta2 - 1) < _EPS)
    between = -ac.maximum(1 / eta2 - eta1, _EPS)
    return ac.where(lossless, bearing1 / 2, (bearing1 - bearing2) / between)


class Gearbox(PartialTwoFlangesAndSupport, _Lossy):
    """A gear with losses (`LossyGear`), then elasticity and backlash (`ElastoBacklash`).

    The parts are ``lossyGear`` at ``flange_a`` and ``elastoBacklash`` at ``flange_b``. ``phi_rel``
    [rad], ``w_rel = der(phi_rel)`` and ``a_rel = der(w_rel)`` are those of the elasticity;
    ``stateSelect`` is ``"default"`` here (Modelica: ``"prefer"``). The heat port, with
    ``useHeatPort``, takes the losses of both. Choose options where the gearbox is made.
    """

    ICON = icons.GEARBOX

    c = ac.Parameter(unit="N.m/rad", min=0, doc="elasticity of the gear")
    d = ac.Parameter(unit="N.m.s/rad", min=0, doc="damping of the gear")
    b = ac.Parameter(0.0, unit="rad", min=0, doc="total backlash")
    stateSelect = ac.Option(
        "default", choices=STATE_SELECT, doc="priority of phi_rel, w_rel as states"
    )
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    smooth = ac.Option(False, doc="whether the losses are smooth at rest, see LossyGear")
    heatPort = HeatPort(when="useHeatPort")
    phi_rel = ac.Variable(
        unit="rad", state="stateSelect", nominal=1e-4, doc="angle over the elasticity"
    )
    w_rel = ac.Variable(unit="rad/s", state="stateSelect", doc="speed over the elasticity")
    a_rel = ac.Variable(unit="rad/s2", doc="acceleration over the elasticity")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.lossyGear = LossyGear(
            ratio=self.ratio,
            lossTable=self.lossTable,
            ideal=self.ideal,
            useSupport=self.useSupport,
            useHeatPort=self.useHeatPort,
            smooth=self.smooth,
        )
        self.elastoBacklash = ElastoBacklash(
            c=self.c, d=self.d, b=self.b, useHeatPort=self.useHeatPort
        )
        self.connect(self.flange_a, self.lossyGear.flange_a)
        self.connect(self.lossyGear.flange_b, self.elastoBacklash.flange_a)
        self.connect(self.elastoBacklash.flange_b, self.flange_b)
        if self.useSupport:
            self.connect(self.support, self.lossyGear.support)
        if self.useHeatPort:
            self.connect(self.heatPort, self.lossyGear.heatPort, self.elastoBacklash.heatPort)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.phi_rel, self.flange_b.phi - self.lossyGear.flange_b.phi)
        yield ac.Eq(self.w_rel, ac.der(self.phi_rel))
        yield ac.Eq(self.a_rel, ac.der(self.w_rel))
