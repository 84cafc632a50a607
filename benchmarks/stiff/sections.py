"""A ladder of resistors and capacitors whose time constants lie far apart."""

from __future__ import annotations

from typing import Any

import numpy as np

import acausal as ac
from acausal.components import electrical as el
from benchmarks.stiff.compare import Task, against_cvode

SECTIONS = 10_000


class Ladder(ac.Component):
    """Section i has 10^(((7919 i) mod 5) - 2) Ohm, then 1 + i mod 7 mF to ground; 1 V drives the first."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.source, self.ground = el.ConstantVoltage(V=1.0), el.Ground()
        self.r = [el.Resistor(R=10.0 ** ((7919 * i) % 5 - 2)) for i in range(n)]
        self.c = [
            el.Capacitor(C=1e-3 * (1 + i % 7), v=ac.Start(0.1 * (i % 3), fixed=True))
            for i in range(n)
        ]
        self.connect(self.source.n, self.ground.p, *(c.n for c in self.c))
        for here, r, c in zip([self.source, *self.c], self.r, self.c, strict=False):
            self.connect(here.p, r.p)
            self.connect(r.n, c.p)


def ladder(n: int = SECTIONS) -> dict[str, Any]:
    """The simulation over ten seconds, beside CVODE's."""
    return against_cvode(Task(f"ladder_{n}", ac.compile(Ladder(n)), np.linspace(0.0, 10.0, 11)))
