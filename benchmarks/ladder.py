"""An RLC ladder of n sections between a source and ground: 2 n states, and one node where 2 n + 2 pins meet."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import electrical as el
from benchmarks.case import Case, Values
from benchmarks.command import main


class Ladder(ac.Component):
    """Every section is ``r[i]`` and ``l[i]`` in series, then ``c[i]`` and ``g[i]`` to ground."""

    def __init__(self, n: int) -> None:
        super().__init__()
        p = values(n)
        self.ground, self.source = el.Ground(), el.ConstantVoltage(V=1.0)
        self.r = [el.Resistor(R=v) for v in p["R"].tolist()]
        self.l = [el.Inductor(L=v) for v in p["L"].tolist()]
        self.c = [el.Capacitor(C=v) for v in p["C"].tolist()]
        self.g = [el.Conductor(G=v) for v in p["G"].tolist()]
        self.connect(self.source.n, self.ground.p)
        end = self.source.p
        for r, l, c, g in zip(self.r, self.l, self.c, self.g, strict=True):
            self.connect(end, r.p)
            self.connect(r.n, l.p)
            self.connect(l.n, c.p, g.p)
            self.connect(c.n, g.n, self.ground.p)
            end = l.n


def values(n: int) -> Values:
    i = np.arange(n)
    return {
        "R": 1.0 + 0.1 * (i % 3),
        "L": 1e-3 * (1 + i % 5),
        "C": 1e-6 * (1 + i % 7),
        "G": 1e-4 * (1 + i % 2),
    }


def by_hand(x: Values, p: Values) -> Values:
    v, i = x["v"], x["i"]
    before, after = jnp.insert(v[:-1], 0, 1.0), jnp.append(i[1:], 0.0)
    return {"v": (i - after - p["G"] * v) / p["C"], "i": (before - v - p["R"] * i) / p["L"]}


CASE = Case(
    title="RLC ladder of n sections",
    model=Ladder,
    sizes=(10, 100, 1000, 10000),
    states=lambda n: {
        "v": [f"c[{k}].v" for k in range(1, n + 1)],
        "i": [f"l[{k}].i" for k in range(1, n + 1)],
    },
    values=values,
    by_hand=by_hand,
)

if __name__ == "__main__":
    main(CASE)
