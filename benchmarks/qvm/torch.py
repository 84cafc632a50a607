"""The same by torchdiffeq, a step of Heun's method between samples; on one core, since more make it slower."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.qvm.task import VEHICLE, Gradient, Task, flat, layers
from examples.qvm.record import SAMPLE_TIME


def gradient(task: Task) -> Callable[[], Gradient]:
    import torch
    from torchdiffeq import odeint

    torch.set_num_threads(1)

    def tensor(a: Any) -> Any:
        return torch.tensor(np.asarray(a), dtype=torch.float64)

    networks = [
        tuple([tensor(a).requires_grad_() for a in arrays] for arrays in net)
        for net in layers(task.params)
    ]
    x0, u0, y, sigma = (tensor(a) for a in (task.x0, task.u0, task.y, task.sigma))
    ts = SAMPLE_TIME * torch.arange(task.length, dtype=torch.float64)
    p = VEHICLE

    def network(net: Any, x: Any) -> Any:
        h = x[:, None]
        weights, biases = net
        for w, b in zip(weights[:-1], biases[:-1], strict=True):
            h = torch.relu(h @ w.T + b)
        return (h @ weights[-1].T + biases[-1])[:, 0]

    def field(t: Any, x: Any) -> Any:
        """All sequences at once: x of shape (B, 5); time is the same in all, counted from the start."""
        u = u0[:, round(float(t) / SAMPLE_TIME)]
        body, body_v, wheel, wheel_v, road = x.unbind(-1)
        travel, speed = wheel - body, wheel_v - body_v
        spring, damper = networks
        learned = network(spring, travel / p["travel"]) + network(damper, speed / p["speed"])
        f = p["c"] * travel + p["d"] * speed + p["force"] * learned
        tyre = p["tyre_c"] * (road - wheel) + p["tyre_d"] * (u - wheel_v)
        return torch.stack([body_v, f / p["body"], wheel_v, (tyre - f) / p["wheel"], u], dim=-1)

    def run() -> Gradient:
        xs = odeint(field, x0, ts, method="heun2")
        rates = torch.stack([field(t, x)[:, (1, 3)] for t, x in zip(ts, xs, strict=True)], dim=1)
        squares = (((rates - y) / sigma) ** 2).sum(dim=2)
        loss = squares.mean(dim=1).sqrt().mean()
        leaves = [a for net in networks for arrays in net for a in arrays]
        by = iter(torch.autograd.grad(loss, leaves))
        derivatives = [
            tuple([next(by).numpy() for _ in arrays] for arrays in net) for net in networks
        ]
        return loss.item(), flat(derivatives)

    return run
