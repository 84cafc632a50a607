"""A random network of n nodes joined by 2 n conductors: one large linear block between a few capacitors."""

from __future__ import annotations

import jax
import numpy as np
import scipy.linalg

import acausal as ac
from acausal.components import electrical as el
from benchmarks.case import Case, Values
from benchmarks.command import main

HELD = 4
"""Nodes with a capacitor."""


class Network(ac.Component):
    """``g`` joins every node to the next and n random pairs; the first nodes hold ``c``, the last a ``leak``."""

    def __init__(self, n: int) -> None:
        super().__init__()
        p = values(n)
        self.ground, self.leak = el.Ground(), el.Conductor(G=p["leak"])
        self.c = [el.Capacitor(C=v) for v in p["C"].tolist()]
        self.g = [el.Conductor(G=v) for v in p["G"].tolist()]
        node = [[] for _ in range(n)]
        for c, pins in zip(self.c, node, strict=False):
            pins.append(c.p)
        for g, (a, b) in zip(self.g, p["ends"].tolist(), strict=True):
            node[a].append(g.p)
            node[b].append(g.n)
        node[-1].append(self.leak.p)
        for pins in node:
            self.connect(*pins)
        self.connect(self.ground.p, self.leak.n, *(c.n for c in self.c))


def values(n: int) -> Values:
    generator = np.random.default_rng(0)
    ring = np.stack([np.arange(n), (np.arange(n) + 1) % n], axis=1)
    chords = np.stack([np.arange(n), (np.arange(n) + generator.integers(2, n - 1, n)) % n], axis=1)
    return {
        "C": 1e-3 * np.arange(1.0, HELD + 1),
        "G": generator.uniform(0.5, 1.5, 2 * n),
        "ends": np.concatenate([ring, chords]),
        "leak": 0.1,
    }


def by_hand_values(n: int) -> Values:
    """Nodal analysis with a dense matrix of conductances: its blocks, and LU factors for the nodes without capacitor.

    They are made once, as they depend on parameters alone; the model's right-hand side keeps its factors, too.
    """
    p = values(n)
    a, b = p["ends"].T
    matrix = np.zeros((n, n))
    for rows, columns, factor in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
        np.add.at(matrix, (rows, columns), factor * p["G"])
    matrix[-1, -1] += p["leak"]
    factors, pivots = scipy.linalg.lu_factor(matrix[HELD:, HELD:])
    held, across = matrix[:HELD, :HELD], matrix[:HELD, HELD:]
    return {"C": p["C"], "held": held, "across": across, "factors": factors, "pivots": pivots}


def by_hand(x: Values, p: Values) -> Values:
    free = -jax.scipy.linalg.lu_solve((p["factors"], p["pivots"]), p["across"].T @ x["v"])
    return {"v": -(p["held"] @ x["v"] + p["across"] @ free) / p["C"]}


CASE = Case(
    title="random network of n nodes",
    model=Network,
    sizes=(10, 100, 1000),
    states=lambda n: {"v": [f"c[{k}].v" for k in range(1, HELD + 1)]},
    values=by_hand_values,
    by_hand=by_hand,
)

if __name__ == "__main__":
    main(CASE)
