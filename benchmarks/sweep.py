"""A sweep: many variants of the quarter vehicle at once, with parameters, initial states and roads of their own."""

from __future__ import annotations

import argparse
import json
import math
import os
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import Mesh, PartitionSpec
from rich.console import Console
from rich.table import Table

import acausal as ac
from benchmarks.race import seconds
from examples.qvm.model import UNCERTAIN, with_networks
from examples.qvm.record import INPUT, SAMPLE_TIME, rough_road

ROUNDS = 5
BLOCK = 1000
"""Variants side by side; of more, what a step leaves behind no longer fits into a processor's memory."""
SPREAD = 0.2
"""Of the parameters, relative."""


class Variants(NamedTuple):
    """Of n vehicles: parameters by name, each of shape (n,); first states (n, 5); road speeds (n, steps + 1)."""

    params: dict[str, Any]
    x0: Any
    road: Any


def main() -> None:
    """Measure, print the table and the JSON line."""
    parser = argparse.ArgumentParser(description="Simulate many variants of the quarter vehicle.")
    parser.add_argument("--n", type=int, default=10_000, help="variants")
    parser.add_argument("--steps", type=int, default=250, help="of a millisecond, each")
    asked = parser.parse_args()
    cores = math.gcd(os.cpu_count() or 1, asked.n)
    if jax.config.jax_platforms == "cpu" or jax.config.jax_platforms is None:
        jax.config.update("jax_num_cpu_devices", cores)
    devices = jax.devices()[: math.gcd(len(jax.devices()), asked.n)]
    system = ac.compile(with_networks())
    given = variants(system, asked.n, asked.steps)
    one = jax.tree.map(lambda a: a[:1], given)
    columns = ("", "million steps/s", "... per core", "one by one takes")
    table = Table(*columns, title=f"{asked.n} variants of {asked.steps} steps")
    found: dict[str, dict[str, float]] = {}
    for name, dtype in (("float64", jnp.float64), ("float32", jnp.float32)):
        for what, task in (("simulation", roughness), ("gradient", gradient)):
            own = task(system, asked.steps, dtype)
            wall, cpu = _timed(jax.jit(_over(devices, _blocks(own))), given)
            _, alone = _timed(jax.jit(_blocks(own)), one)
            steps = asked.n * asked.steps
            row = {
                "steps_per_second": steps / wall,
                "steps_per_core_second": steps / cpu,
                "one_by_one_ratio": alone * asked.n / cpu,
            }
            speeds = (f"{row[k] / 1e6:.3g}" for k in ("steps_per_second", "steps_per_core_second"))
            table.add_row(f"{what}, {name}", *speeds, f"{row['one_by_one_ratio']:.2f} x")
            found[f"{what}_{name}"] = row
    Console().print(table)
    print(json.dumps({"variants": asked.n, "steps": asked.steps, "devices": len(devices), **found}))


def variants(system: ac.System, n: int, steps: int) -> Variants:
    """Random ones; each drives over its own piece of the road."""
    rng = np.random.default_rng(0)
    own = system.parameters(0)
    factors = 1 + SPREAD * rng.uniform(-1, 1, (n, len(UNCERTAIN)))
    params = {name: jnp.asarray(own[name] * factors[:, i]) for i, name in enumerate(UNCERTAIN)}
    _, speed = rough_road(1, scale=1.0)
    starts = rng.integers(0, len(speed) - steps, n)
    x0 = 0.01 * rng.standard_normal((n, len(system.states)))
    return Variants(
        params, jnp.asarray(x0), jnp.asarray(speed[starts[:, None] + np.arange(steps + 1)])
    )


def roughness(system: ac.System, steps: int, dtype: Any) -> Callable[[Variants], Any]:
    """Of one variant, the root mean square of the body's acceleration."""
    shared = system.parameters(0)

    def one(variant: Variants) -> Any:
        run = ac.simulate(
            system,
            (0.0, steps * SAMPLE_TIME),
            dt=SAMPLE_TIME,
            inputs={INPUT: variant.road},
            params={**shared, **variant.params},
            x0=variant.x0,
            solver="heun",
            dtype=dtype,
        )
        return jnp.sqrt(jnp.mean(run["body.a"] ** 2))

    return one


def gradient(system: ac.System, steps: int, dtype: Any) -> Callable[[Variants], Any]:
    """Of one variant, the derivatives of that by its parameters, first state and road."""
    return jax.grad(roughness(system, steps, dtype))


def _blocks(one: Callable[[Variants], Any]) -> Callable[[Variants], Any]:
    """Of many variants, `BLOCK` at a time."""
    return lambda many: jax.lax.map(one, many, batch_size=BLOCK)


def _over(devices: list[Any], function: Callable[[Variants], Any]) -> Callable[[Variants], Any]:
    """The same with an equal share for each device."""
    if len(devices) == 1:
        return function
    mesh, share = Mesh(np.asarray(devices), ("variants",)), PartitionSpec("variants")
    return jax.shard_map(function, mesh=mesh, in_specs=share, out_specs=share, check_vma=False)


def _timed(function: Callable[[Variants], Any], given: Variants) -> tuple[float, float]:
    """Medians of seconds, of wall and of processor."""
    jax.block_until_ready(function(given))
    times = [seconds(lambda: jax.block_until_ready(function(given))) for _ in range(ROUNDS)]
    wall, cpu = np.median(times, axis=0)
    return float(wall), float(cpu)


if __name__ == "__main__":
    main()
