"""A plate of n x n heat capacities that conductances join: stiff, and sparse."""

from __future__ import annotations

import acausal as ac
from acausal.components import thermal


class Plate(ac.Component):
    """Capacity i, row by row, has 1 + i mod 7 J/K and starts at 300 + i mod 13 K; 50 W flow into the first.

    Neighbours are joined by 10^(((7919 i) mod 5) - 1) W/K, where i is the first of the pair.
    """

    def __init__(self, n: int) -> None:
        super().__init__()
        self.cells = [
            thermal.HeatCapacitor(C=1.0 + i % 7, T=ac.Start(300.0 + i % 13, fixed=True))
            for i in range(n * n)
        ]
        pairs = [
            (i, j)
            for i in range(n * n)
            for j in [i + 1] * (i % n < n - 1) + [i + n] * (i // n < n - 1)
        ]
        self.joints = [thermal.ThermalConductor(G=10.0 ** ((7919 * i) % 5 - 1)) for i, _ in pairs]
        for joint, (i, j) in zip(self.joints, pairs, strict=True):
            self.connect(self.cells[i].port, joint.port_a)
            self.connect(joint.port_b, self.cells[j].port)
        self.source = thermal.FixedHeatFlow(Q_flow=50.0)
        self.connect(self.source.port, self.cells[0].port)
