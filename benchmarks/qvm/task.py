"""The task: sequences of a ride, and networks to differentiate by. All contestants get the same arrays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

import acausal as ac
from examples.qvm import model
from examples.qvm.record import INPUT, OUTPUTS, SAMPLE_TIME, STATES, ride

SAMPLES = 42_000
NETWORKS = ("spring_nn.net", "damper_nn.net")

Gradient = tuple[Any, Any]
"""The loss, and its derivatives by all weights as one vector (see `flat`)."""

Contestant = Callable[["Task"], Callable[[], Gradient]]
"""From a task to a function that computes one gradient, compiled; it returns when all is computed."""


@dataclass(frozen=True)
class Task:
    """B sequences of n steps from a record.

    Attributes:
        title: in a word.
        record: the whole ride.
        starts: first sample of each sequence, shape (B,). ``length``: n.
        x0: states there, shape (B, 5).
        u0, u1: the input at the start and at the end of every step, shape (B, n).
        y: measured accelerations, shape (B, n, 2).
        sigma: their standard deviations over the record.
        params: the model's parameters, with fresh networks.
    """

    title: str
    record: ac.Data
    starts: np.ndarray
    length: int
    x0: np.ndarray
    u0: np.ndarray
    u1: np.ndarray
    y: np.ndarray
    sigma: np.ndarray
    params: dict[str, Any]


def record() -> ac.Data:
    """The noisy ride, with the sample at its end left out."""
    whole = ride(0.02).measured
    return whole.between(0.0, (SAMPLES - 0.5) * SAMPLE_TIME)


def task(title: str, data: ac.Data, params: dict[str, Any], count: int, length: int) -> Task:
    """``count`` sequences of ``length`` samples, spread over the record."""
    starts = np.arange(count) * (SAMPLES // count)
    rows = starts[:, None] + np.arange(length)
    x, y = (np.stack([data[n] for n in names], axis=1) for names in (STATES, OUTPUTS))
    u = np.append(data[INPUT], data[INPUT][-1])
    return Task(
        title, data, starts, length, x[starts], u[rows], u[rows + 1], y[rows], y.std(axis=0), params
    )


def layers(params: dict[str, Any]) -> list[Any]:
    """Weights and biases of both networks: two lists of (weights, biases)."""
    return [(params[name].weights, params[name].biases) for name in NETWORKS]


def flat(networks: list[Any]) -> np.ndarray:
    """All weights as one vector, layer by layer, each weight matrix before its bias."""
    parts = [
        np.ravel(a)
        for weights, biases in networks
        for pair in zip(weights, biases, strict=True)
        for a in pair
    ]
    return np.concatenate(parts).astype(float)


VEHICLE = {
    "body": model.BODY,
    "wheel": model.WHEEL,
    "c": model.SUSPENSION_STIFFNESS,
    "d": model.SUSPENSION_DAMPING,
    "tyre_c": model.TYRE_STIFFNESS,
    "tyre_d": model.TYRE_DAMPING,
    "travel": model.TRAVEL_SCALE,
    "speed": model.SPEED_SCALE,
    "force": model.FORCE_SCALE,
}
"""The physical parameters, for code by hand."""
