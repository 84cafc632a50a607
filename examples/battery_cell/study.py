"""Training on several records at once, with what is known before as priors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

import acausal as ac
from examples.battery_cell.model import Cell, TARGETS
from examples.battery_cell.records import Table

POSITIVE = ac.Bounded(0, math.inf)
POSITIVES = (
    "particle.Q", "particle.tau", "overhang.Q", "creep.tau", "transfer.I_0",
    "resistance.R", "relaxation.R", "relaxation.tau", "core.C", "case.C", "convection.G", "conduction.G",
)
ENERGIES = ("particle.E_a", "creep.E_a", "transfer.E_a", "resistance.E_a", "relaxation.E_a")
NETS = ("ocv.net", "ocv.entropy", "resistance.net", "particle.diffusion[1].net")
MODIFIERS: dict[str, Any] = {
    **dict.fromkeys(POSITIVES, POSITIVE),
    **dict.fromkeys(ENERGIES, ac.Shift(8e3)),
    "overhang_start": ac.Shift(0.2),
}
PER_RECORD = {"soc_start": 0.03, "warmth_start": 1.0}
MILLIVOLTS, KELVINS, PRIOR = 8e-3, 0.4, 3e-3
SPREADS = {n: 0.7 for n in POSITIVES} | {"particle.Q": 0.02}
WEIGHTS = 2.0

def loss(predicted: Array, measured: Array, sigma: Array, weight: Array) -> Array:
    scaled = (predicted - measured) / jnp.array([MILLIVOLTS, 2*KELVINS])
    total = jnp.sum(weight, axis=0)
    squares = jnp.sum(weight * scaled**2, axis=0) / jnp.where(total > 0, total, 1.0)
    return jnp.sqrt(jnp.sum(squares) + 1e-12)

def prior(start: Mapping[str, Any]):
    def penalty(params: Mapping[str, Any], context: Any) -> Array:
        total = jnp.zeros(())
        for n in POSITIVES:
            total += (jnp.log(params[n] / start[n]) / SPREADS[n]) ** 2
        for n in ENERGIES:
            total += ((params[n] - start[n]) / 8e3) ** 2
        for n in NETS:
            a, b = (jax.tree.leaves(p[n]) for p in (params, start))
            total += sum(jnp.sum((x - y) ** 2) for x, y in zip(a, b)) / WEIGHTS**2
        return PRIOR * total
    return penalty

def train(tables: Mapping[str, Table], seed: int = 0, epochs: int = 40, params=None, **kw) -> ac.Fit:
    system = ac.compile(Cell(soc_start=0.0, warmth_start=0.0))
    start = params or system.parameters(seed)
    return ac.fit(
        system, {n: t.few().data() for n, t in tables.items()}, TARGETS, params=start, seed=seed,
        **({"train": NETS, "modifiers": MODIFIERS, "per_record": PER_RECORD, "loss": loss, "regularizers": prior(system.parameters(seed)),
        "strategy": "gauss_newton", "epochs": epochs, "dt": 10.0, "solver": "heun", "x0": "model", "progress": False}|kw),
    )
