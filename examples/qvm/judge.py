"""How good a trained vehicle is: its learned forces against the true ones, its modifiers against their targets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

import acausal as ac
from examples.qvm.model import UNCERTAIN, truth
from examples.qvm.record import INPUT, OUTPUTS, Ride

SPRING, DAMPER = "spring_nn.net", "damper_nn.net"
STUCK = 0.02
"""Below the breakaway speed [m/s] friction is a matter of regularisation, not of data."""


@dataclass(frozen=True)
class Verdict:
    """Figures of one training.

    Attributes:
        loss: over the whole record, as measured; ``loss_clean``: against the outputs without noise.
        spring_error, damper_error: RMS difference [N] of learned and true force within 2 sigma of what the
            network has seen, both less their value at zero; the damper's outside of ``STUCK``.
        modifiers: by parameter. ``modifier_error``: largest distance from the targets.
        ratio_error: largest error of a ratio of two parameters, relative to the true ratio.
    """

    loss: float
    loss_clean: float
    spring_error: float
    damper_error: float
    modifiers: dict[str, float]
    modifier_error: float | None
    ratio_error: float | None

    def figures(self) -> dict[str, Any]:
        return {k: v for k, v in asdict(self).items() if v not in (None, {})}


def true_forces() -> dict[str, Callable[[Any], Any]]:
    """The forces of the true vehicle that the networks stand for, by network: functions of travel and speed."""
    system = ac.compile(truth())
    params = system.pack()

    def of(name: str, state: str) -> Callable[[Any], Any]:
        position = system.states.index(state)

        def force(s: Any) -> Any:
            x = jnp.zeros(len(system.states)).at[position].set(s)
            return system.observe(name, 0.0, x, jnp.zeros(1), params)

        return jax.jit(lambda s: jnp.vectorize(force)(jnp.asarray(s)))

    return {SPRING: of("progressive.f", "wheel.s"), DAMPER: of("friction.f", "wheel.v")}


def judge(fit: ac.Fit, ride: Ride) -> Verdict:
    """Compare a training with the truth."""
    params, true = fit.remove_offset(), true_forces()

    def error(name: str, gap: float) -> float:
        sigma = float(fit.seen[name].sigma[0])
        x = np.linspace(-2 * sigma, 2 * sigma, 2001)
        x = jnp.asarray(x[np.abs(x) > gap])
        return float(
            jnp.sqrt(jnp.mean((jax.vmap(ac.networks.law_of(params[name]))(x) - true[name](x)) ** 2))
        )

    factors = {n: (1 + m) / (1 + UNCERTAIN[n]) for n, m in fit.modifiers.items()}
    return Verdict(
        loss=fit.loss,
        loss_clean=loss(fit.system, fit.params, ride.clean, ride),
        spring_error=error(SPRING, 0.0),
        damper_error=error(DAMPER, STUCK),
        modifiers=fit.modifiers,
        modifier_error=max((abs(m - UNCERTAIN[n]) for n, m in fit.modifiers.items()), default=None),
        ratio_error=max(factors.values()) / min(factors.values()) - 1 if factors else None,
    )


def loss(
    system: ac.System, params: dict[str, Any], record: ac.Data, ride: Ride, *, solver: str = "heun"
) -> float:
    """The paper's loss (21) of a simulation of the whole ride against the outputs of a record."""
    solution = ac.simulate(
        system,
        (record.time[0], record.time[-1]),
        dt=record.sample_time,
        inputs={INPUT: record[INPUT]},
        params=params,
        solver=solver,
    )
    squares = [
        ((np.asarray(solution[n]) - record[n]) / ride.measured[n].std()) ** 2 for n in OUTPUTS
    ]
    return float(np.sqrt(np.mean(sum(squares))))
