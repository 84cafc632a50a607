"""Flux tubes with hysteresis by Tellinen's model (1998, doi:10.1109/20.704378), and eddy currents."""

from collections.abc import Iterator
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import icons, nature
from acausal.components.blocks.interpolation import interpolant
from acausal.components.electrical.interfaces import ConditionalHeatPort

from . import hysteresis_data
from .interfaces import TwoPort

__modelica__ = "Modelica.Magnetic.FluxTubes.Shapes.HysteresisAndMagnets"

_LEAST = 0.01
"""Least part of the limiting branch's slope that a point beyond the loop has."""


class GenericHysteresis(TwoPort, ConditionalHeatPort):
    """A prismatic tube whose flux density depends on the past: ``H = V_m/l = Hstat + Heddy``, ``B = Phi/A``.

    With ``includeEddyCurrents`` the field of eddy currents in sheets is ``Heddy = sigma d**2/12 der(B)``. Heat is
    ``LossPower = V (Hstat + Heddy) der(B)``. ``MagRel`` is the magnetization at the start, -1 to 1, and constant.
    """

    __modelica__ = "Modelica.Magnetic.FluxTubes.BaseClasses"

    ICON = icons.HYSTERETIC

    l = ac.Parameter(0.1, unit="m", doc="length in the direction of flux")
    A = ac.Parameter(1e-4, unit="m2", doc="cross-section")
    includeEddyCurrents = ac.Option(False, doc="whether there are eddy currents")
    sigma = ac.Parameter(10e6, unit="S/m", doc="conductivity of the material")
    d = ac.Parameter(0.5e-3, unit="m", doc="thickness of the sheets")
    H = ac.Variable(unit="A/m", nominal=1e3, doc="magnetic field strength")
    Hstat = ac.Variable(unit="A/m", nominal=1e3, doc="field strength without eddy currents")
    Heddy = ac.Variable(unit="A/m", nominal=1e3, doc="field strength of eddy currents")
    derHstat = ac.Variable(unit="A/(m.s)", doc="derivative of Hstat")
    B = ac.Variable(unit="T", doc="magnetic flux density")
    MagRel = ac.Variable(unit="1", doc="relative magnetization at the start")
    LossPowerStat = ac.Variable(unit="W", doc="losses by hysteresis")
    LossPowerEddy = ac.Variable(unit="W", doc="losses by eddy currents")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        rate, volume = ac.der(self.B), self.A * self.l
        eddy = self.sigma * self.d**2 / 12 * rate if self.includeEddyCurrents else 0
        yield ac.Eq(ac.der(self.MagRel), 0)
        yield ac.Eq(self.H, self.Hstat + self.Heddy)
        yield ac.Eq(self.V_m, self.H * self.l)
        yield ac.Eq(self.Phi, self.B * self.A)
        yield ac.Eq(self.Heddy, eddy)
        yield ac.Eq(self.derHstat, ac.der(self.Hstat))
        yield ac.Eq(self.LossPowerStat, self.Hstat * rate * volume)
        yield ac.Eq(self.LossPowerEddy, self.Heddy * rate * volume)
        yield ac.Eq(self.LossPower, self.LossPowerStat + self.LossPowerEddy)


class GenericHysteresisTellinen(GenericHysteresis):
    """Tellinen's model: between the branches ``hystR`` and ``hystF`` of the limiting loop, ``B`` follows their slopes.

    ``der(B) = k (der(branch) - mu0 der(Hstat)) + mu0 der(Hstat)``: while ``Hstat`` rises (``asc``) with the rising
    branch and ``k = (hystF - B)/(hystF - hystR)``, else with the falling one and ``k = (B - hystR)/(hystF - hystR)``.
    A subclass states both branches over ``Hstat``, and the slope ``mu0`` in saturation.
    """

    ICON = icons.marked(icons.HYSTERETIC, "T")

    __modelica__ = "Modelica.Magnetic.FluxTubes.BaseClasses"

    asc = ac.Discrete(True, kind="bool", doc="1 while Hstat rises")
    hystR = ac.Variable(unit="T", doc="rising branch of the limiting loop")
    hystF = ac.Variable(unit="T", doc="falling branch of the limiting loop")
    diffHyst = ac.Variable(unit="T", doc="distance of the branches")
    dHyst = ac.Variable(unit="T/s", doc="derivative of the branch's polarization")
    k = ac.Variable(unit="1", doc="part of it that the flux density follows")

    @property
    def _slope(self) -> Any:
        """``mu0`` over the magnetic constant."""
        return 1

    def _branches(self) -> tuple[Any, Any, Any]:
        """Polarization on the rising and on the falling branch, and how far both are moved apart."""
        raise NotImplementedError

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        rising, falling, apart = self._branches()
        mu0 = self._slope * nature.mu_0
        yield ac.Eq(self.hystR, rising + mu0 * self.Hstat - apart)
        yield ac.Eq(self.hystF, falling + mu0 * self.Hstat + apart)
        yield ac.Eq(self.diffHyst, self.hystF - self.hystR)
        yield ac.Eq(self.asc, self.derHstat > 0)
        branch = ac.where(self.asc > 0.5, ac.der(self.hystR), ac.der(self.hystF))
        left = ac.where(self.asc > 0.5, self.hystF - self.B, self.B - self.hystR)
        yield ac.Eq(self.dHyst, branch - mu0 * self.derHstat)
        yield ac.Eq(self.k, ac.maximum(left / self.diffHyst, _LEAST))
        yield ac.Eq(ac.der(self.B), self.k * self.dHyst + mu0 * self.derHstat)

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield from super().initial_equations()
        yield ac.Eq(2 * self.B, self.hystR + self.hystF + self.MagRel * self.diffHyst)


class GenericHystTellinenSoft(GenericHysteresisTellinen):
    """Soft magnetic: the branches are ``Js tanh((Hstat -+ Hc) H0/Hc)`` with ``tanh(H0) = Br/Js``."""

    ICON = icons.marked(icons.HYSTERETIC, "S")

    Js = ac.Parameter(1.8, unit="T", doc="saturation polarization")
    Br = ac.Parameter(0.9, unit="T", doc="remanence")
    Hc = ac.Parameter(120.0, unit="A/m", doc="coercivity")
    K = ac.Parameter(1.0, unit="1", doc="slope in saturation over mu_0")

    @property
    def _slope(self) -> Any:
        return self.K

    def _branches(self) -> tuple[Any, Any, Any]:
        half = _atanh(self.Br / self.Js)
        at = self.Hstat * half / self.Hc
        return self.Js * ac.tanh(at - half), self.Js * ac.tanh(at + half), self.Js / 2000


class GenericHystTellinenHard(GenericHysteresisTellinen):
    """Hard magnetic: the branches are ``Br tanh(M H -+ H0)``, such that ``B = 0`` at ``H = +-Hc``."""

    ICON = icons.marked(icons.HYSTERETIC, "H")

    Br = ac.Parameter(1.2, unit="T", doc="remanence")
    Hc = ac.Parameter(5e5, unit="A/m", doc="coercivity")
    M = ac.Parameter(lambda self: 10 / self.Hc, unit="m/A", doc="slope of the branches")
    K = ac.Parameter(1.0, unit="1", doc="slope in saturation over mu_0")

    @property
    def _slope(self) -> Any:
        return self.K

    def _branches(self) -> tuple[Any, Any, Any]:
        half = _atanh(self.K * nature.mu_0 * self.Hc / self.Br) + self.M * self.Hc
        at = self.M * self.H
        return self.Br * ac.tanh(at - half), self.Br * ac.tanh(at + half), self.Br / 2000


class GenericHystTellinenPermanentMagnet(GenericHystTellinenHard):
    """A permanent magnet that can lose its magnetization: it starts with ``MagRel = -1``."""

    ICON = icons.marked(icons.MAGNET, "T")

    MagRel = ac.Variable(
        unit="1", start=-1.0, fixed=True, doc="relative magnetization at the start"
    )


class GenericHystTellinenTable(GenericHysteresisTellinen):
    """The limiting loop by tables, `hysteresis_data.LoopTable`, interpolated by Akima's splines."""

    ICON = icons.marked(icons.HYSTERETIC, "#")

    mat = ac.Option(None, doc="material, a hysteresis_data.LoopTable")
    K = ac.Parameter(1.0, unit="1", doc="slope in saturation over mu_0")
    sigma = ac.Parameter(lambda self: self.mat.sigma, unit="S/m", doc="conductivity")
    tabris = ac.Module("_rising", data=True)
    tabfal = ac.Module("_falling", data=True)

    def _loop(self) -> hysteresis_data.LoopTable:
        if isinstance(self.mat, hysteresis_data.LoopTable):
            return self.mat
        raise ac.DeclarationError(
            f"{type(self).__name__} needs mat=hysteresis_data.LoopTable(...), got {self.mat!r}"
        )

    def _rising(self, _key: Any) -> ac.Signal:
        return interpolant(self._loop().tabris, "ContinuousDerivative", "LastTwoPoints", "tabris")

    def _falling(self, _key: Any) -> ac.Signal:
        return interpolant(self._loop().tabfal, "ContinuousDerivative", "LastTwoPoints", "tabfal")

    @property
    def _slope(self) -> Any:
        return self.K

    def _branches(self) -> tuple[Any, Any, Any]:
        apart = self._loop().tabris[-1][1] / 1000
        return self.tabris(self.Hstat), self.tabfal(self.Hstat), apart


class GenericHystTellinenEverett(GenericHysteresisTellinen):
    """The limiting loop by the Everett function of a material, see `hysteresis_data.Everett`."""

    ICON = icons.marked(icons.HYSTERETIC, "E")

    mat = ac.Option(hysteresis_data.Everett(), doc="material, a hysteresis_data.Everett")
    sigma = ac.Parameter(lambda self: self.mat.sigma, unit="S/m", doc="conductivity")

    @property
    def _slope(self) -> Any:
        return self.mat.K

    def _branches(self) -> tuple[Any, Any, Any]:
        p = self.mat
        h = ac.maximum(ac.minimum(self.Hstat, p.Hsat), -p.Hsat)
        high, low = _everett(p, p.Hsat), _everett(p, -p.Hsat)
        up, down = _everett(p, h), _everett(p, -h)
        saturation = (high**2 - low**2) / 2
        rising, falling = high * up - down * low, low * up - down * high
        return rising - saturation, falling + saturation, p.M / 2000


def _everett(p: hysteresis_data.Everett, h: Any) -> Any:
    """The factor of Everett's function at a field strength."""
    x = h - p.Hc
    steep = p.M * p.r * (2 / np.pi * ac.atan(p.q * x) + 1)
    flat = sum(ac.exp(ac.minimum(-sharpness * x, 300)) for sharpness in (p.p1, p.p2))
    return steep + 2 * p.M * (1 - p.r) / (1 + flat / 2)


def _atanh(x: Any) -> Any:
    return ac.log((1 + x) / (1 - x)) / 2
