"""A pack: groups of parallel cells in series, each cell with its charge, its relaxation and its temperature."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

import acausal as ac
from acausal.components import battery, electrical as el, thermal

CURRENT, COOLANT = "source.i", "coolant.T"
"""The inputs: the current into the pack in A, and the temperature of the coolant in K."""

LAW = "rows[1].cells[1].resistance.net"
"""The network of all resistances."""


class OpenCircuit(eqx.Module):
    """A curve as of a lithium-ion cell with a nickel-rich cathode: its voltage above the nominal one."""

    def __call__(self, soc: Float[Array, ""]) -> Float[Array, ""]:
        return -0.45 + 0.9 * soc - 0.25 * jnp.exp(-20 * soc) + 0.02 * jnp.sin(9 * soc)


class Entropy(eqx.Module):
    """The derivative of the curve by temperature, in V/K."""

    def __call__(self, soc: Float[Array, ""]) -> Float[Array, ""]:
        return 2e-4 * jnp.tanh(6 * (soc - 0.4))


class Resistance(el.OnePort, battery.PartialDepending):
    """`battery.SeriesResistance`, written for the current: ``i = v/R_actual``.

    Cells in parallel share a voltage. With their currents given by it, the one voltage is all that a row has to
    solve for; ``v = R_actual i`` could be solved for a current only where no resistance is zero, which nobody knows.
    """

    R = ac.Parameter(unit="Ohm", min=0, doc="resistance at T_ref")
    G_actual = ac.Variable(unit="S", start=50.0, nominal=50.0, doc="actual conductance")

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.G_actual, 1 / (self.R * self._slowing))
        yield ac.Eq(self.i, self.G_actual * self.v)
        yield ac.Eq(self.LossPower, self.v * self.i)


class Cell(ac.Component):
    """A cell of 5 A.h: a voltage over charge, a learned resistance over charge and temperature, a relaxation, a heat.

    Arguments:
        like: a cell whose laws this one shares; ``None`` makes new ones.
        spread: how far capacity and resistance are from nominal, relative.
        soc: state of charge at the start.
    """

    def __init__(self, like: Cell | None = None, spread: float = 0.0, soc: float = 0.9) -> None:
        super().__init__()
        curve, entropy, law = (
            (like.ocv.net, like.ocv.entropy, {"net": like.resistance.net})
            if like
            else (lambda _: OpenCircuit(), lambda _: Entropy(), {})
        )
        self.p, self.n = el.PositivePin(), el.NegativePin()
        self.ocv = battery.OpenCircuitVoltage(net=curve, entropy=entropy, useHeatPort=True)
        self.charge = battery.ChargeStorage(
            Q=18e3 * (1 - spread), soc=ac.Start(soc - spread / 5, fixed=True)
        )
        self.resistance = Resistance(R=0.02 * (1 + spread), E_a=15e3, useHeatPort=True, **law)
        self.relaxation = battery.Relaxation(
            R=0.01,
            tau=20.0,
            E_a=20e3,
            v=ac.Start(0.0, fixed=True),
            learned=False,
            useHeatPort=True,
            **law,
        )
        self.body = thermal.HeatCapacitor(C=70.0, T=ac.Start(298.15, fixed=True))
        self.connect(self.p, self.resistance.p)
        self.connect(self.resistance.n, self.relaxation.p)
        self.connect(self.relaxation.n, self.ocv.p)
        self.connect(self.ocv.n, self.n)
        self.connect(self.ocv.surface, self.charge.port)
        self.connect(self.ocv.soc_surface, self.ocv.soc, self.resistance.soc)
        for heated in (self.ocv, self.resistance, self.relaxation):
            self.connect(heated.heatPort, self.body.port)


class Row(ac.Component):
    """Cells in parallel, side by side; the first touches the cooling plate.

    An ideal transformer, 1 to 1, stands between the row's pins and its cells, which have a ground of their own. It
    changes no voltage and no current. But it says that the row needs no potential of another row: its currents are
    a small algebraic loop, where otherwise the equations of all rows would be one.
    """

    def __init__(self, cells: list[Cell]) -> None:
        super().__init__()
        self.p, self.n, self.plate = el.PositivePin(), el.NegativePin(), thermal.HeatPort_a()
        self.cells, self.link, self.ground = cells, el.IdealTransformer(n=1.0), el.Ground()
        self.contact = thermal.ThermalConductor(G=1.0)
        self.between = [thermal.ThermalConductor(G=2.0) for _ in cells[1:]]
        self.connect(self.p, self.link.p1)
        self.connect(self.link.n1, self.n)
        self.connect(self.link.p2, *(cell.p for cell in cells))
        self.connect(self.link.n2, self.ground.p, *(cell.n for cell in cells))
        self.connect(self.plate, self.contact.port_a)
        self.connect(self.contact.port_b, cells[0].body.port)
        for joint, (one, other) in zip(self.between, pairwise(cells), strict=True):
            self.connect(one.body.port, joint.port_a)
            self.connect(joint.port_b, other.body.port)


class Pack(ac.Component):
    """Rows of parallel cells in series on a cooling plate, charged by a given current.

    Arguments:
        rows: in series.
        cells: in parallel, each.
    """

    def __init__(self, rows: int = 100, cells: int = 10) -> None:
        super().__init__()
        first = Cell()
        count = rows * cells
        others = [Cell(first, 0.06 * ((7919 * i) % 101 / 100 - 0.5)) for i in range(1, count)]
        all_cells = [first, *others]
        self.rows = [Row(all_cells[i : i + cells]) for i in range(0, count, cells)]
        self.source, self.ground = el.SignalCurrent(), el.Ground()
        self.voltmeter, self.coolant = el.VoltageSensor(), thermal.PrescribedTemperature()
        self.connect(self.source.p, self.rows[-1].n, self.voltmeter.n, self.ground.p)
        self.connect(self.source.n, self.rows[0].p, self.voltmeter.p)
        for upper, lower in pairwise(self.rows):
            self.connect(upper.n, lower.p)
        for row in self.rows:
            self.connect(row.plate, self.coolant.port)
