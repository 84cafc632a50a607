"""A chain of n mass-spring-dampers on a wall: 2 n states, every formula n times."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import translational as tl
from benchmarks.case import Case, Values
from benchmarks.command import main


class Chain(ac.Component):
    """``wall - leg[1] - mass[1] - leg[2] - mass[2] - ...``; the last mass is free."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.wall = tl.Fixed()
        values = by_hand_values(n)
        self.leg = [
            tl.SpringDamper(c=c, d=d)
            for c, d in zip(values["c"].tolist(), values["d"].tolist(), strict=True)
        ]
        self.mass = [tl.Mass(m=m) for m in values["m"].tolist()]
        below = self.wall.flange
        for leg, mass in zip(self.leg, self.mass, strict=True):
            self.connect(below, leg.flange_a)
            self.connect(leg.flange_b, mass.flange_a)
            below = mass.flange_b


def by_hand_values(n: int) -> Values:
    i = np.arange(n)
    return {"c": 100.0 + i % 7, "d": 1.0 + 0.1 * (i % 5), "m": 1.0 + 0.1 * (i % 3)}


def by_hand(x: Values, p: Values) -> Values:
    s, v = x["s"], x["v"]
    stretch, rate = jnp.diff(s, prepend=0.0), jnp.diff(v, prepend=0.0)
    f = p["c"] * stretch + p["d"] * rate
    return {"s": v, "v": (jnp.append(f[1:], 0.0) - f) / p["m"]}


CASE = Case(
    title="chain of n mass-spring-dampers",
    model=Chain,
    sizes=(10, 100, 1000, 10000, 100000),
    states=lambda n: {k: [f"mass[{i}].{k}" for i in range(1, n + 1)] for k in ("s", "v")},
    values=by_hand_values,
    by_hand=by_hand,
)

if __name__ == "__main__":
    main(CASE)
