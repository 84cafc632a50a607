"""A bridge of ideal diodes."""

from __future__ import annotations

import numpy as np

from acausal.components import electrical as el
from tests.gradients.models import Built, at


def bridge(*, L: float = 1e-4, R: float = 10.0, phase: float = np.pi / 2) -> Built:
    """Six ideal diodes behind three inductive lines, which feed a resistor and a choke; without current at first."""
    turns = {f"v{k}": phase - 2 * np.pi * (k - 1) / 3 for k in (1, 2, 3)}
    return Built(
        "d1.n d2.n d3.n load.p",
        "load.n choke.p",
        "d4.p d5.p d6.p choke.n",
        "v1.n v2.n v3.n ground.p",
        *(f"v{k}.p l{k}.p" for k in (1, 2, 3)),
        *(f"l{k}.n d{k}.p d{k + 3}.n" for k in (1, 2, 3)),
        **{f"d{k}": el.IdealDiode() for k in range(1, 7)},
        **{name: el.SineVoltage(V=100, f=50, phase=turn) for name, turn in turns.items()},
        l1=el.Inductor(L=L, i=at(0.0)),
        l2=el.Inductor(L=L, i=at(0.0)),
        l3=el.Inductor(L=L),
        load=el.Resistor(R=R),
        choke=el.Inductor(L=1e-2, i=at(0.0)),
        ground=el.Ground(),
    )
