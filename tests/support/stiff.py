"""Models of any size whose Jacobian is sparse: a plate, a ladder, a chain, and some with algebraic loops."""

from __future__ import annotations

from itertools import pairwise

import acausal as ac
from acausal.components import (
    electrical as el,
    neural,
    rotational as rot,
    thermal as th,
    translational as tl,
)


class Plate(ac.Component):
    """n × n heat capacities, neighbours joined by conductances; heat flows into the first."""

    def __init__(self, n):
        super().__init__()
        self.capacity = [
            th.HeatCapacitor(C=1.0 + i % 7, T=ac.Start(300.0 + i % 13, fixed=True))
            for i in range(n * n)
        ]
        right = [(i, i + 1) for i in range(n * n) if (i + 1) % n]
        below = [(i, i + n) for i in range(n * (n - 1))]
        pairs = sorted(right + below)
        self.conductor = [th.ThermalConductor(G=10.0 ** ((7919 * i) % 5 - 1)) for i, _ in pairs]
        self.source = th.FixedHeatFlow(Q_flow=50.0)
        self.connect(self.source.port, self.capacity[0].port)
        for (i, j), conductor in zip(pairs, self.conductor, strict=True):
            self.connect(self.capacity[i].port, conductor.port_a)
            self.connect(conductor.port_b, self.capacity[j].port)


class Ladder(ac.Component):
    """n sections of a resistor and a capacitor; ``shunt`` makes what lies beside each capacitor, if anything."""

    def __init__(self, n, shunt=None):
        super().__init__()
        self.source, self.ground = el.ConstantVoltage(V=1.0), el.Ground()
        self.r = [el.Resistor(R=1.0 + i % 3) for i in range(n)]
        self.c = [el.Capacitor(C=1.0 + i % 5, v=ac.Start(0.0, fixed=True)) for i in range(n)]
        self.shunt = [shunt() for _ in range(n)] if shunt else []
        self.connect(self.ground.p, self.source.n, *(c.n for c in self.c))
        for here, r, c in zip([self.source, *self.c], self.r, self.c, strict=False):
            self.connect(here.p, r.p)
            self.connect(r.n, c.p)
        for shunt, c in zip(self.shunt, self.c, strict=False):
            self.connect(shunt.p, c.p)
            self.connect(shunt.n, c.n)


class DiodeAndResistor(ac.Component):
    """In series: the voltage between them solves an equation that is not linear."""

    def __init__(self):
        super().__init__()
        self.p, self.n = el.PositivePin(), el.NegativePin()
        self.diode, self.r = el.Diode(), el.Resistor(R=2.0)
        self.connect(self.p, self.diode.p)
        self.connect(self.diode.n, self.r.p)
        self.connect(self.r.n, self.n)


class Bridge(ac.Component):
    """Resistors that meet where no capacitor is: a loop of linear equations."""

    def __init__(self):
        super().__init__()
        self.p, self.n = el.PositivePin(), el.NegativePin()
        self.r = [el.Resistor(R=1.0 + i) for i in range(5)]
        a, b, c, d, e = self.r
        self.connect(self.p, a.p, b.p)
        self.connect(a.n, c.p, e.p)
        self.connect(b.n, d.p, e.n)
        self.connect(c.n, d.n, self.n)


class Chain(ac.Component):
    """n masses behind a wall, joined by springs and dampers; ``neural_spring`` puts a network beside each."""

    def __init__(self, n, neural_spring=False):
        super().__init__()
        self.wall = tl.Fixed()
        self.mass = [tl.Mass(m=1.0 + i % 3) for i in range(n)]
        self.spring = [tl.SpringDamper(c=100.0, d=1.0) for _ in range(n)]
        self.network = [neural.Compliance() for _ in range(n if neural_spring else 0)]
        flanges = [self.wall.flange, *(m.flange_b for m in self.mass)]
        for elements in (self.spring, self.network):
            for element, here, mass in zip(elements, flanges, self.mass, strict=False):
                self.connect(here, element.flange_a)
                self.connect(element.flange_b, mass.flange_a)


class Pack(ac.Component):
    """Cells in ``series`` groups of ``parallel``: capacitors behind what ``resistor(k)`` makes.

    Potentials join all cells to one loop of algebraic equations.
    """

    def __init__(self, series, parallel, resistor):
        super().__init__()
        n = series * parallel
        self.load, self.ground = el.ConstantCurrent(I=2.0), el.Ground()
        self.r = [resistor(k) for k in range(n)]
        self.c = [el.Capacitor(C=10.0 + k % 3, v=ac.Start(1.0, fixed=True)) for k in range(n)]
        for r, c in zip(self.r, self.c, strict=True):
            self.connect(r.n, c.p)
        ends = [
            [
                member
                for r, c in zip(self.r[k : k + parallel], self.c[k:], strict=False)
                for member in (r.p, c.n)
            ]
            for k in range(0, n, parallel)
        ]
        for upper, lower in pairwise(ends):
            self.connect(*upper[1::2], *lower[::2])
        self.connect(self.load.p, *ends[0][::2])
        self.connect(self.load.n, self.ground.p, *ends[-1][1::2])


class Trains(ac.Component):
    """Shafts of geared inertias, each held by a spring: rigidly joined, so that torques follow from a loop."""

    def __init__(self, n_trains, n_inertias):
        super().__init__()
        self.fixed = rot.Fixed()
        self.spring = [rot.SpringDamper(c=10.0, d=0.1) for _ in range(n_trains)]
        self.inertia = [rot.Inertia(J=1.0 + i) for i in range(n_trains * n_inertias)]
        self.gear = [rot.IdealGear(ratio=2.0) for _ in range(n_trains * (n_inertias - 1))]
        gears = iter(self.gear)
        for k, spring in enumerate(self.spring):
            own = self.inertia[k * n_inertias : (k + 1) * n_inertias]
            self.connect(self.fixed.flange, spring.flange_a)
            self.connect(spring.flange_b, own[0].flange_a)
            for (a, b), gear in zip(pairwise(own), gears, strict=False):
                self.connect(a.flange_b, gear.flange_a)
                self.connect(gear.flange_b, b.flange_a)
