"""A rig around a plant that is an FMU: ``Mass_Damper``, a mass between a wall's spring and damper and a force."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import acausal as ac
from acausal.components import neural

PUSH, POSITION, SPRING, NET = "push", "plant.y", "plant.spring.c", "friction.net"


class Rubbing(ac.Component):
    """The true friction: ``y = F tanh(u/v_0)``."""

    F, v_0 = ac.Parameter(400.0, unit="N"), ac.Parameter(5.0, unit="m/s")
    u, y = ac.Input(unit="m/s"), ac.Output(unit="N")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.F * ac.tanh(self.u / self.v_0))


class Rig(ac.Component):
    """The plant, a force that pushes it, and a friction that brakes it.

    Arguments:
        fmu: the file of ``Mass_Damper``. friction: from the mass's speed to a force; by default it is to be learned.
    """

    push = ac.Input(unit="N")
    load = ac.Output(unit="N")

    def __init__(self, fmu: Path, friction: ac.Component | None = None) -> None:
        super().__init__()
        self.plant = ac.FMU(fmu, observe=["damper.v_rel"])
        learned = neural.Characteristic(
            odd=True, monotone=True, width=8, depth=1, activation="tanh", input_scale=5.0, output_scale=400.0
        )  # fmt: skip
        self.friction = learned if friction is None else friction
        self.connect(self.plant["damper.v_rel"], self.friction.u)
        self.connect(self.load, self.plant.f)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.load, self.push + self.friction.y)
