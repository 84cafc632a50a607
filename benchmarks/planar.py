"""Planar mechanics: seconds to compile, and microseconds per right-hand side.

A four-bar linkage whose crank turns, and alone is a state or one of all joints; a vehicle on four wheels that slip; and
chains of n bodies that hang from hinges.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.components import blocks, planar, rotational as rot

STEPS, ROUNDS = 1000, 9
"""How many right-hand sides are timed at once, and how often; the fastest round counts."""


class FourBar(ac.Component):
    """Crank, coupler and rocker on two fixed frames, with a body at each end; the crank turns round."""

    def __init__(self, *, driven: bool = True) -> None:
        super().__init__()
        self.left, self.right = planar.Fixed(), planar.Fixed(r=(1.0, 0.0))
        angles = (0.6, -0.4, 1.0, -1.2)
        self.joint = [planar.Revolute(phi=ac.Start(phi)) for phi in angles]
        self.joint[0].modify(w=ac.Start(14.0))
        if driven:
            self.joint[0].modify(stateSelect="always")
        self.rod = [planar.FixedTranslation(r=(length, 0.0)) for length in (0.4, 1.0, 0.8)]
        self.body = [planar.Body(m=1.0, I=0.02) for _ in self.rod]
        end = self.left.frame
        for joint, rod, body in zip(self.joint, self.rod, self.body, strict=False):
            self.connect(end, joint.frame_a)
            self.connect(joint.frame_b, rod.frame_a)
            self.connect(rod.frame_b, body.frame_a)
            end = rod.frame_b
        self.connect(end, self.joint[3].frame_a)
        self.connect(self.joint[3].frame_b, self.right.frame)


class TwoTrack(ac.Component):
    """A body on four wheels, the front ones turned by a fixed angle; each wheel has a torque."""

    def __init__(self) -> None:
        super().__init__()
        self.body = planar.Body(m=1200.0, I=1800.0, enableGravity=False, v=ac.Start([10.0, 0.1]))
        corners = [(1.2, 0.8), (1.2, -0.8), (-1.4, 0.8), (-1.4, -0.8)]
        self.corner = [planar.FixedTranslation(r=r) for r in corners]
        self.steering = [planar.FixedRotation(alpha=a) for a in (0.05, 0.05, 0.0, 0.0)]
        self.wheel = [
            planar.SlipBasedWheelJoint(
                radius=0.3, r=(1.0, 0.0), N=3000.0, mu_A=1.0, mu_S=0.7, sAdhesion=0.05, sSlide=0.2,
                vAdhesion_min=0.05, vSlide_min=0.2,
            )
            for _ in corners
        ]  # fmt: skip
        self.load = blocks.Constant(k=0.0)
        self.rim = [rot.Inertia(J=1.0, w=ac.Start(33.0)) for _ in corners]
        self.drive = [rot.ConstantTorque(tau_constant=100.0) for _ in corners]
        for parts in zip(self.corner, self.steering, self.wheel, self.rim, self.drive, strict=True):
            corner, steering, wheel, rim, drive = parts
            self.connect(self.body.frame_a, corner.frame_a)
            self.connect(corner.frame_b, steering.frame_a)
            self.connect(steering.frame_b, wheel.frame_a)
            self.connect(self.load.y, wheel.dynamicLoad)
            self.connect(drive.flange, rim.flange_a)
            self.connect(rim.flange_b, wheel.flange_a)


class Chain(ac.Component):
    """n bodies on rods, each hinged to the one before; the first hinge is fixed."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.wall = planar.Fixed()
        self.joint = [planar.Revolute(phi=ac.Start(0.1 * (i % 3))) for i in range(n)]
        self.rod = [planar.FixedTranslation(r=(0.0, -1.0)) for _ in range(n)]
        self.body = [planar.Body(m=1.0, I=0.1) for _ in range(n)]
        end = self.wall.frame
        for joint, rod, body in zip(self.joint, self.rod, self.body, strict=True):
            self.connect(end, joint.frame_a)
            self.connect(joint.frame_b, rod.frame_a)
            self.connect(rod.frame_b, body.frame_a)
            end = rod.frame_b


def measured(make: Callable[[], ac.Component]) -> dict[str, float]:
    """Seconds until a model is derived and its right-hand side compiled, and microseconds of one."""
    begin = time.perf_counter()
    system = ac.compile(make())
    derived = time.perf_counter() - begin
    packed, x = system.pack(), system.initial_state()

    def field(x: Any) -> Any:
        return system.vector_field(0.0, x, None, packed)

    @jax.jit
    def run(x: Any) -> Any:
        return jax.lax.fori_loop(0, STEPS, lambda _, x: x + 1e-7 * field(x), x)

    begin = time.perf_counter()
    assert jnp.isfinite(jax.block_until_ready(run(x))).all()
    compiled = time.perf_counter() - begin
    return {
        "states": len(system.states),
        "derive_seconds": derived,
        "compile_seconds": compiled,
        "microseconds": 1e6 * min(_seconds(run, x) for _ in range(ROUNDS)) / STEPS,
    }


def _seconds(function: Callable[[Any], Any], x: Any) -> float:
    begin = time.perf_counter()
    jax.block_until_ready(function(x))
    return time.perf_counter() - begin


def main() -> None:
    """Measure, print a table, and a line of JSON at the end."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("n", nargs="*", type=int, default=[1, 2, 4, 8, 16], help="bodies of chains")
    models: dict[str, Callable[[], ac.Component]] = {
        "four_bar": FourBar,
        "four_bar_of_all": lambda: FourBar(driven=False),
        "two_track": TwoTrack,
    }
    models |= {f"chain_{n}": lambda n=n: Chain(n) for n in parser.parse_args().n}
    found = {name: measured(make) for name, make in models.items()}
    table = Table("", *next(iter(found.values())))
    for name, own in found.items():
        table.add_row(name, *(f"{value:.3g}" for value in own.values()))
    Console().print(table)
    print(json.dumps({f"{name}_{key}": v for name, own in found.items() for key, v in own.items()}))


if __name__ == "__main__":
    main()
