"""A random network of n nodes joined by 2 n conductors: one large linear block between a few capacitors."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np

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


def by_hand(x: Values, p: Values) -> Values:
    """Nodal analysis with a dense matrix of conductances."""
    n = len(p["G"]) // 2
    a, b = p["ends"].T
    matrix = jnp.zeros((n, n)).at[a, a].add(p["G"]).at[b, b].add(p["G"])
    matrix = matrix.at[a, b].add(-p["G"]).at[b, a].add(-p["G"]).at[-1, -1].add(p["leak"])
    free = jnp.linalg.solve(matrix[HELD:, HELD:], -matrix[HELD:, :HELD] @ x["v"])
    current = matrix[:HELD, :HELD] @ x["v"] + matrix[:HELD, HELD:] @ free
    return {"v": -current / p["C"]}


CASE = Case(
    title="random network of n nodes",
    model=Network,
    sizes=(10, 100, 1000),
    states=lambda n: {"v": [f"c[{k}].v" for k in range(1, HELD + 1)]},
    values=values,
    by_hand=by_hand,
)

if __name__ == "__main__":
    main(CASE)
