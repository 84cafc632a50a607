"""Equation error: targets computed from measured states, without any simulation."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int, PRNGKeyArray

from acausal._jax import compiled
from acausal.codegen import Values
from acausal.errors import TrainingError, listing
from acausal.training.objective.problem import Problem
from acausal.training.objective.records import Records
from acausal.training.objective.sequences import Batch
from acausal.training.objective.smoothing import without_noise
from acausal.training.objective.trainable import Trainable

SAMPLES = 5000
"""The most samples of the records that count; they are evenly spread."""


class EquationError(Problem):
    """The loss of targets that are observed in the measured states and inputs, sample by sample.

    It costs next to nothing and gives a good start, but it is biased by the noise that remains in the states. It
    depends only on what determines targets at an instant (an acceleration depends on a force; a position does not).

    Attributes, besides those of `Problem`:
        rows: indices of the samples that count.
        x: the states there, smoothed.
    """

    rows: Int[Array, " n_rows"]
    x: Float[Array, "n_rows n_states"]

    def draw(self, key: PRNGKeyArray, update: int | Int[Array, ""] = 0) -> Batch:
        """All samples, whatever the key."""
        return Batch(jnp.zeros(1, int), jnp.ones(1), None)

    def losses(self, trainable: Trainable, batch: Batch) -> Float[Array, " 1"]:
        """The loss over all samples."""
        packed, records = self.pack(self.assemble(trainable), trainable), self.records
        steps = self.steps(packed, self.rows)
        y, weight, of = (a[self.rows] for a in (records.y, records.weight, records.of))

        def at(t: Array, x: Array, u: Array, record: Array) -> Float[Array, " n_targets"]:
            return self.system.read(self.targets, Values(t, x, u, self.packed_of(packed, record)))

        seen = jax.vmap(at)(steps.t, self.x, steps.inputs.start, of)
        return self.compare_some(seen, y, weight)[None]

    def entry(self, best: Trainable) -> Trainable:
        """What another part of the training has found, as a start of this one."""
        return best


def equation_error(problem: Problem) -> EquationError:
    """The equation error of a problem.

    Raises:
        TrainingError: if states are not measured, the model has events, or no target depends on something that is to
            be trained.
    """
    if problem.system.events is not None:
        raise TrainingError(
            "The equation error looks at instants, where the discrete variables of a model with events are not known: "
            "leave 'equation_error' out of the strategy."
        )
    if problem.records.x is None:
        raise TrainingError(
            "The equation error needs all states in the data: "
            "leave 'equation_error' out of the strategy, or measure them."
        )
    if slow := [n for n in problem.targets if n in problem.timing.delays + problem.timing.lags]:
        raise TrainingError(
            f"The equation error knows no delay or lag of a target, here {listing(slow)}: leave 'equation_error' out."
        )
    states = _smoothed(problem.records, np.asarray(problem.records.x))
    known = np.flatnonzero(np.isfinite(states).all(axis=1) & np.asarray(problem.records.sampled))
    spread = np.linspace(0, len(known) - 1, min(len(known), SAMPLES)).astype(int)
    rows = known[np.unique(spread)]
    own = {field.name: getattr(problem, field.name) for field in fields(problem)}
    objective = EquationError(**own, rows=jnp.asarray(rows), x=jnp.asarray(states[rows]))
    unseen = _unseen(objective)
    if unseen:
        raise TrainingError(
            f"At an instant no target depends on {listing(unseen)}: the equation error cannot train it. "
            "Add a target that does, such as a force or an acceleration, or leave 'equation_error' out."
        )
    return objective


def _smoothed(
    records: Records, x: Float[np.ndarray, "N n_states"]
) -> Float[np.ndarray, "N n_states"]:
    """The measured states, record by record: short gaps bridged, and smoothed where samples are evenly spaced."""
    found = x.copy()
    t = np.asarray(records.steps.t)
    for k in range(records.count):
        rows = records.rows_of(k)
        for i in range(x.shape[1]):
            found[rows, i] = without_noise(t[rows], x[rows, i])
    return found


def _unseen(objective: EquationError) -> list[str]:
    """Networks and parameters that the loss does not depend on."""
    start = objective.start()
    batch = objective.draw(jax.random.key(0))
    gradient = compiled(jax.grad(lambda tree: objective.losses(tree, batch)[0]))(start)
    parts: dict[str, Any] = {**gradient.networks, **gradient.modifiers}
    return [n for n, g in parts.items() if not any(bool(a.any()) for a in jax.tree.leaves(g))]
