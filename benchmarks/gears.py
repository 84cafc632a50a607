"""A drive train of n gear stages on elastic shafts: at every gear two inertias are one, by index reduction."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import rotational as rot
from benchmarks.case import Case, Values
from benchmarks.command import main


class Gears(ac.Component):
    """``wall - shaft[1] - wheel[1] - gear[1] - pinion[1] - shaft[2] - ...``."""

    def __init__(self, n: int) -> None:
        super().__init__()
        p = values(n)
        self.wall = rot.Fixed()
        self.shaft = [
            rot.SpringDamper(c=c, d=d)
            for c, d in zip(p["c"].tolist(), p["d"].tolist(), strict=True)
        ]
        self.wheel = [rot.Inertia(J=J) for J in p["wheel"].tolist()]
        self.gear = [rot.IdealGear(ratio=r) for r in p["ratio"].tolist()]
        self.pinion = [rot.Inertia(J=J) for J in p["pinion"].tolist()]
        end = self.wall.flange
        for stage in zip(self.shaft, self.wheel, self.gear, self.pinion, strict=True):
            for element in stage:
                self.connect(end, element.flange_a)
                end = element.flange_b


def values(n: int) -> Values:
    i = np.arange(n)
    return {
        "c": 1000.0 + 10 * (i % 7),
        "d": 1.0 + 0.1 * (i % 5),
        "wheel": 2.0 + 0.1 * (i % 3),
        "pinion": 0.5 + 0.1 * (i % 4),
        "ratio": 2.0 + 0.5 * (i % 2),
    }


def by_hand(x: Values, p: Values) -> Values:
    phi, w, ratio = x["phi"], x["w"], p["ratio"]
    twist = phi - jnp.insert(phi[:-1] / ratio[:-1], 0, 0.0)
    rate = w - jnp.insert(w[:-1] / ratio[:-1], 0, 0.0)
    tau = p["c"] * twist + p["d"] * rate
    after = jnp.append(tau[1:], 0.0)
    return {"phi": w, "w": (after / ratio - tau) / (p["wheel"] + p["pinion"] / ratio**2)}


CASE = Case(
    title="drive train of n gear stages",
    model=Gears,
    sizes=(10, 100, 1000, 10000),
    states=lambda n: {k: [f"wheel[{i}].{k}" for i in range(1, n + 1)] for k in ("phi", "w")},
    values=values,
    by_hand=by_hand,
)

if __name__ == "__main__":
    main(CASE)
