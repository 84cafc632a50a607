"""The drive of the pack: what its cells do, and what the learned resistance is worth."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

import acausal as ac
from examples.battery_pack.cycle import HOUR, current
from examples.battery_pack.model import COOLANT, CURRENT, LAW, Pack

TOLERANCE = 1e-6
"""Of a step, relative and in the states' units."""

NOMINAL, ROWS, CELLS = 3.65, 100, 10
"""Voltage of a cell, cells in series and in parallel of the car's pack."""


@dataclass(frozen=True)
class Drive:
    """A pack, and the inputs and times of its drive.

    Attributes:
        rows, cells: in series; in parallel.
        system: the compiled pack.
        inputs: by name.
        t: times to save, in seconds.
    """

    rows: int
    cells: int
    system: ac.System
    inputs: dict[str, Any]
    t: Float[np.ndarray, " n"]

    def simulate(self, params: Any = None, **options: Any) -> ac.Solution:
        """The drive, with some parameters."""
        chosen: dict[str, Any] = {"rtol": TOLERANCE, "atol": TOLERANCE, **options}
        span = float(self.t[0]), float(self.t[-1])
        return ac.simulate(
            self.system, span, saveat=self.t, inputs=self.inputs, params=params, **chosen
        )


def drive(
    rows: int = ROWS, cells: int = CELLS, seconds: float = HOUR, every: float = 10.0
) -> Drive:
    """A drive of a pack whose cells bear the same currents, however many they are."""
    inputs = {CURRENT: current(NOMINAL * ROWS * CELLS / cells), COOLANT: 293.15}
    times = np.arange(0.0, seconds + every / 2, every)
    return Drive(rows, cells, ac.compile(Pack(rows, cells)), inputs, times)


def warmth(driven: Drive, law: Any, **options: Any) -> Float[Array, ""]:
    """The mean temperature of the cells at the end, in K, for a network of the resistance."""
    params = {**driven.system.parameters(), LAW: law}
    return jnp.mean(driven.simulate(params, **options).x[-1, np.asarray(places(driven, "body.T"))])


def places(driven: Drive, state: str) -> list[int]:
    """Where a state of all cells lies in the vector of states, row by row."""
    return [i for i, name in enumerate(driven.system.states) if name.endswith(f".{state}")]


@dataclass(frozen=True)
class Study:
    """What was found.

    Attributes:
        drive, sol: what was simulated.
        gradient: of the mean cell's final temperature by the weights of the network.
        seconds: that compiling, the first simulation, another and a gradient took.
    """

    drive: Drive
    sol: ac.Solution
    gradient: Any
    seconds: dict[str, float]

    def table(self) -> list[tuple[str, str]]:
        """Rows of names and figures."""
        x = np.asarray(self.sol.x)
        T, soc = (x[:, places(self.drive, name)] for name in ("body.T", "charge.soc"))
        voltage = np.asarray(self.sol["voltmeter.v"])
        norm = float(jnp.sqrt(sum(jnp.sum(a**2) for a in jax.tree.leaves(self.gradient))))
        return [
            ("cells", f"{self.drive.rows} x {self.drive.cells}"),
            ("states", f"{len(self.drive.system.states)}"),
            ("voltage", f"{voltage.max():.1f} to {voltage.min():.1f} V"),
            ("charge at the end", f"{100 * soc[-1].min():.1f} to {100 * soc[-1].max():.1f} %"),
            ("hottest cell", f"{T.max() - 273.15:.1f} °C"),
            ("temperatures at the end", f"{np.ptp(T[-1]):.2f} K apart"),
            ("gradient by all weights", f"{norm:.3g} K"),
            ("steps", str(self.sol.statistics)),
            *((name, f"{s:.2f} s") for name, s in self.seconds.items()),
        ]


def study(**options: Any) -> Study:
    """Compile, simulate, and differentiate."""
    seconds: dict[str, float] = {}

    def timed(name: str, function: Any) -> Any:
        start = time.perf_counter()
        found = jax.block_until_ready(function())
        seconds[name] = time.perf_counter() - start
        return found

    driven = timed("compile", lambda: drive(**options))
    timed("first simulation", lambda: driven.simulate().x)
    sol = timed("again", driven.simulate)
    law = driven.system.parameters()[LAW]
    gradient = jax.jit(jax.grad(lambda law: warmth(driven, law)))
    timed("first gradient", lambda: gradient(law))
    found = timed("gradient again", lambda: gradient(law))
    return Study(driven, sol, found, seconds)
