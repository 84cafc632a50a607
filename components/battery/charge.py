"""Where charge is stored, and how it spreads."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.thermal.interfaces import HeatPort_a

from .interfaces import ChargePort, PartialDiffusion

__modelica__ = None


class ChargeStorage(ac.Component):
    """Charge at one state of charge: ``Q der(soc) = port.i``, ``soc = port.soc``."""

    ICON = icons.CHARGE

    Q = ac.Parameter(unit="C", min=0, doc="capacity")
    soc = ac.Variable(unit="1", start=0.5, state="prefer", doc="state of charge")
    port = ChargePort()

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.soc, self.port.soc)
        yield ac.Eq(self.Q * ac.der(self.soc), self.port.i)


class Diffusion(PartialDiffusion):
    """Charge flows to where there is less: ``i = Q dsoc / tau_actual``, faster when warm.

    ``tau_actual = tau exp(E_a/R (1/T - 1/T_ref) + net(soc, T_ref/T - 1))`` with the mean ``soc`` of both ends, and
    without ``net`` where not ``learned``: then the time constant depends on the temperature alone.
    """

    ICON = icons.CONDUCTION

    Q = ac.Parameter(unit="C", min=0, doc="charge that flows in one time constant")
    tau = ac.Parameter(unit="s", min=0, doc="time constant at T_ref")
    tau_actual = ac.Variable(unit="s", nominal=100.0, doc="actual time constant")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        mean = (self.port_a.soc + self.port_b.soc) / 2
        yield ac.Eq(self.tau_actual, self.tau * self._factor(mean))
        yield ac.Eq(self.i * self.tau_actual, self.Q * self.dsoc)


class Particle(ac.Component):
    """A sphere that charge diffuses into from its ``surface``, in ``n`` shells: the active material of an electrode.

    Finite volumes of Fick's second law: ``n`` storages at the radii ``1/n``, ``2/n`` ... 1, the last one at the
    surface, and ``n - 1`` elements of `Diffusion` between them that share one network. ``tau = r**2/D`` is the time in
    which charge diffuses through the sphere of radius ``r``. ``soc`` is the mean state of charge.

    With ``fixed_start`` all shells start at ``soc_start``; else that is a guess, and the model says where they start.
    """

    ICON = icons.PARTICLE

    surface = ChargePort()
    heatPort = HeatPort_a(when="useHeatPort")
    useHeatPort = ac.Option(False, doc="whether there is a heat port")
    fixed_start = ac.Option(True, doc="whether all shells start at soc_start")
    n = ac.Option(3, min=2, doc="number of shells")
    learned = ac.Option(True, doc="whether the time constant depends on charge by a network")
    Q = ac.Parameter(unit="C", min=0, doc="capacity")
    tau = ac.Parameter(unit="s", min=0, doc="time of diffusion at T_ref")
    E_a = ac.Parameter(0.0, unit="J/mol", doc="activation energy of diffusion")
    T_ref = ac.Parameter(298.15, unit="K", min=0, doc="temperature at which tau holds")
    soc_start = ac.Parameter(0.5, unit="1", doc="state of charge at the start")
    soc = ac.Output(unit="1", doc="mean state of charge")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        n = self.n
        edges = [0.0, *((k + 0.5) / n for k in range(1, n)), 1.0]
        self._shares = [b**3 - a**3 for a, b in pairwise(edges)]
        start = ac.Start(self.soc_start, fixed=self.fixed_start)
        self.shell = [ChargeStorage(Q=self.Q * share, soc=start) for share in self._shares]
        common: dict[str, Any] = {
            "tau": self.tau,
            "E_a": self.E_a,
            "T_ref": self.T_ref,
            "useHeatPort": self.useHeatPort,
            "learned": self.learned,
        }
        first = Diffusion(Q=self.Q * _conductance(1, n), **common)
        others = [
            Diffusion(Q=self.Q * _conductance(k, n), net=first.net, **common) for k in range(2, n)
        ]
        self.diffusion = [first, *others]
        for inner, between, outer in zip(self.shell, self.diffusion, self.shell[1:], strict=False):
            self.connect(inner.port, between.port_b)
            self.connect(between.port_a, outer.port)
        self.connect(self.shell[-1].port, self.surface)
        if self.useHeatPort:
            self.connect(self.heatPort, *(between.heatPort for between in self.diffusion))

    def equations(self) -> Iterator[ac.Eq]:
        shells = zip(self._shares, self.shell, strict=True)
        yield ac.Eq(self.soc, sum(share * shell.soc for share, shell in shells))


def _conductance(k: int, n: int) -> float:
    """What flows between the radii k/n and (k + 1)/n, of a sphere's capacity in its time of diffusion."""
    return 3 * ((k + 0.5) / n) ** 2 * n
