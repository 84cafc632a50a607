"""The same in JAX by hand: a plain `jax.lax.scan`, and `diffrax.diffeqsolve` as its documentation has it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import diffrax as dfx
import jax
import jax.numpy as jnp

from benchmarks.qvm.task import VEHICLE, Gradient, Task, flat, layers
from examples.qvm.record import SAMPLE_TIME


def network(layers: Any, x: Any) -> Any:
    (w1, w2, w3), (b1, b2, b3) = layers
    h = jax.nn.relu(w1[:, 0] * x + b1)
    h = jax.nn.relu(w2 @ h + b2)
    return (w3 @ h + b3)[0]


def field(networks: Any, x: Any, u: Any) -> Any:
    """Derivatives of heights and speeds of body and wheel, and of the road's height."""
    p, (spring, damper) = VEHICLE, networks
    travel, speed = x[2] - x[0], x[3] - x[1]
    learned = network(spring, travel / p["travel"]) + network(damper, speed / p["speed"])
    f = p["c"] * travel + p["d"] * speed + p["force"] * learned
    tyre = p["tyre_c"] * (x[4] - x[2]) + p["tyre_d"] * (u - x[3])
    return jnp.stack([x[1], f / p["body"], x[3], (tyre - f) / p["wheel"], u])


def scanned(networks: Any, x0: Any, u0: Any, u1: Any) -> Any:
    """Accelerations at the starts of all steps, by Heun's method in a scan."""
    h = SAMPLE_TIME

    def step(x: Any, u: Any) -> Any:
        start, end = u
        k1 = field(networks, x, start)
        k2 = field(networks, x + h * k1, end)
        return x + 0.5 * h * (k1 + k2), jnp.stack([k1[1], k1[3]])

    return jax.lax.scan(step, x0, (u0, u1))[1]


def solved(networks: Any, x0: Any, u0: Any, _: Any) -> Any:
    """The same by `diffeqsolve`, with its default adjoint."""
    ts = SAMPLE_TIME * jnp.arange(len(u0))
    road = dfx.LinearInterpolation(ts, u0)
    solution = dfx.diffeqsolve(
        dfx.ODETerm(lambda t, x, args: field(args, x, road.evaluate(t))),
        dfx.Heun(),
        t0=ts[0],
        t1=ts[-1],
        dt0=None,
        y0=x0,
        args=networks,
        saveat=dfx.SaveAt(ts=ts),
        stepsize_controller=dfx.StepTo(ts=ts),
        max_steps=len(u0),
    )
    rates = jax.vmap(lambda x, u: field(networks, x, u))(solution.ys, u0)
    return rates[:, (1, 3)]


def contestant(accelerations: Callable[..., Any]) -> Callable[[Task], Callable[[], Gradient]]:
    """Of a function (networks, x0, u0, u1) -> accelerations of one sequence, the gradient for all."""

    def prepare(task: Task) -> Callable[[], Gradient]:
        def one(networks: Any, x0: Any, u0: Any, u1: Any, y: Any) -> Any:
            errors = (accelerations(networks, x0, u0, u1) - y) / task.sigma
            return jnp.sqrt(jnp.mean(jnp.sum(errors**2, axis=1)))

        def loss(networks: Any, *data: Any) -> Any:
            if len(task.starts) == 1:
                return one(networks, *(a[0] for a in data))
            return jnp.mean(jax.vmap(one, (None, 0, 0, 0, 0))(networks, *data))

        networks = layers(task.params)
        data = [jnp.asarray(a) for a in (task.x0, task.u0, task.u1, task.y)]
        compiled = jax.jit(jax.value_and_grad(loss))

        def run() -> Gradient:
            value, by = jax.block_until_ready(compiled(networks, *data))
            return value, flat(by)

        return run

    return prepare


scan = contestant(scanned)
diffrax = contestant(solved)
