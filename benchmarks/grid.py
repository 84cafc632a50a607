"""An n by n grid of heat capacitors and conductors, warm at one corner: n² states and many loops."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import thermal
from benchmarks.case import Case, Values
from benchmarks.command import main


class Grid(ac.Component):
    """``node[i,j]`` between ``right[i,j]`` and ``down[i,j]``; ``source`` holds the first node's corner."""

    def __init__(self, n: int) -> None:
        super().__init__()
        p = values(n)
        self.source, self.inlet = thermal.FixedTemperature(T=400.0), thermal.ThermalConductor(G=3.0)
        self.node = [[thermal.HeatCapacitor(C=c) for c in row] for row in p["C"].tolist()]
        self.right = [[thermal.ThermalConductor(G=g) for g in row] for row in p["right"].tolist()]
        self.down = [[thermal.ThermalConductor(G=g) for g in row] for row in p["down"].tolist()]
        self.connect(self.source.port, self.inlet.port_a)
        self.connect(self.inlet.port_b, self.node[0][0].port)
        for i in range(n):
            for j in range(n - 1):
                self.connect(self.node[i][j].port, self.right[i][j].port_a)
                self.connect(self.right[i][j].port_b, self.node[i][j + 1].port)
                self.connect(self.node[j][i].port, self.down[j][i].port_a)
                self.connect(self.down[j][i].port_b, self.node[j + 1][i].port)


def values(n: int) -> Values:
    i, j = np.indices((n, n))
    return {
        "C": 10.0 + (i + 2 * j) % 5,
        "right": (1.0 + 0.1 * ((i + j) % 7))[:, :-1],
        "down": (2.0 + 0.1 * ((2 * i + j) % 3))[:-1],
    }


def by_hand(x: Values, p: Values) -> Values:
    T = x["T"].reshape(p["C"].shape)
    right, down = p["right"] * -jnp.diff(T, axis=1), p["down"] * -jnp.diff(T, axis=0)
    into = jnp.pad(right, ((0, 0), (1, 0))) - jnp.pad(right, ((0, 0), (0, 1)))
    into += jnp.pad(down, ((1, 0), (0, 0))) - jnp.pad(down, ((0, 1), (0, 0)))
    return {"T": ((into.at[0, 0].add(3.0 * (400.0 - T[0, 0]))) / p["C"]).ravel()}


CASE = Case(
    title="n by n grid of heat capacitors",
    model=Grid,
    sizes=(3, 10, 32, 100),
    states=lambda n: {"T": [f"node[{i},{j}].T" for i in range(1, n + 1) for j in range(1, n + 1)]},
    values=values,
    by_hand=by_hand,
)

if __name__ == "__main__":
    main(CASE)
