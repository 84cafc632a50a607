"""Records whose inputs are larger, smaller or of the other sign than they say, or count from another zero."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import equinox as eqx
import jax
import numpy as np
from jaxtyping import Array, Float

from acausal.errors import percent
from acausal.modeling import antiderivatives
from acausal.training.objective.simulator import Simulator

UNIT = 5.0
"""An input that is off by a larger factor has another unit, rather than a sensor that is out of tune."""

S = TypeVar("S", bound=Simulator)


def gains(simulator: Simulator) -> dict[str, Float[np.ndarray, " n_inputs"]]:
    """By input that is given by samples, which of the model's inputs change with it: itself, and its derivatives."""
    of = [antiderivatives(name)[-1] for name in simulator.system.inputs]
    functions = simulator.records.steps.inputs.functions or (None,) * len(of)
    sampled = [name for name, function in zip(of, functions, strict=True) if function is None]
    return {n: np.asarray([n == other for other in of], float) for n in dict.fromkeys(sampled)}


def with_gain(simulator: S, gain: Float[Array, " n_inputs"]) -> S:
    """The same, with the samples of inputs times these numbers."""
    samples = simulator.records.steps.inputs
    scaled = jax.tree.map(lambda a: a * gain, replace(samples, functions=()))
    scaled = replace(scaled, functions=samples.functions)
    return eqx.tree_at(lambda s: s.records.steps.inputs, simulator, scaled)


def with_offset(simulator: S, offset: Float[Array, " n_inputs"]) -> S:
    """The same, with these numbers added to the samples of inputs."""
    samples = simulator.records.steps.inputs
    moved = replace(samples, start=samples.start + offset, end=samples.end + offset)
    return eqx.tree_at(lambda s: s.records.steps.inputs, simulator, moved)


def with_held(simulator: S, place: int, values: Float[Array, " n"]) -> S:
    """The same, with one input held at these values from sample to sample."""
    samples = simulator.records.steps.inputs
    start, end = (a.at[:, place].set(values) for a in (samples.start, samples.end))
    held = replace(samples, start=start, end=end)
    return eqx.tree_at(lambda s: s.records.steps.inputs, simulator, held)


def in_words(name: str, gain: float) -> str:
    """What an input would be that is so many times what its record says."""
    if -2 < gain < -0.5:
        return f"{name} had the opposite sign"
    if 0.5 < gain < 2:
        return f"{name} were {percent(abs(gain - 1))} {'larger' if gain > 1 else 'smaller'}"
    return f"{name} were {float(f'{gain:.2g}'):g} times as large"


def to_check(gain: float) -> str:
    """What to look at if an input is so many times what its record says."""
    if gain < 0:
        return "check which way it counts"
    return f"check its {'calibration' if 1 / UNIT < gain < UNIT else 'unit'}"
