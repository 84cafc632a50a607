"""Equation error: targets computed from measured states, without any simulation."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int, PRNGKeyArray

from acausal.codegen import Values
from acausal.errors import TrainingError, listing
from acausal.training.objective.modifiers import Modifiers
from acausal.training.objective.problem import Problem
from acausal.training.objective.records import Records
from acausal.training.objective.sequences import Batch
from acausal.training.objective.smoothing import without_noise
from acausal.training.objective.trainable import Trainable

SAMPLES = 5000
"""The most samples of the records that count; they are evenly spread."""


class EquationError(eqx.Module):
    """The loss of targets that are observed in the measured states and inputs, sample by sample.

    It costs next to nothing and gives a good start, but it is biased by the noise that remains in the states. It
    depends only on what determines targets at an instant (an acceleration depends on a force; a position does not).

    Attributes:
        problem: the model and the data.
        rows: indices of the samples that count.
        x: the states there, smoothed.
    """

    problem: Problem
    rows: Int[Array, " n_rows"]
    x: Float[Array, "n_rows n_states"]

    @property
    def modifiers(self) -> Modifiers:
        """The parameters that are trained."""
        return self.problem.modifiers

    def start(self) -> Trainable:
        """What is trained, where training starts."""
        return self.problem.start()

    def draw(self, key: PRNGKeyArray) -> Batch:
        """All samples, whatever the key."""
        return Batch(jnp.zeros(1, int), jnp.ones(1), None)

    def losses(self, trainable: Trainable, batch: Batch) -> Float[Array, " 1"]:
        """The loss over all samples."""
        p = self.problem
        packed = p.pack(p.assemble(trainable), trainable)
        records = p.records
        steps = p.steps(packed, self.rows)
        y, weight, of = (a[self.rows] for a in (records.y, records.weight, records.of))

        def at(t: Array, x: Array, u: Array, record: Array) -> Float[Array, " n_targets"]:
            return p.system.read(p.targets, Values(t, x, u, p.packed_of(packed, record)))

        return p.compare_some(jax.vmap(at)(steps.t, self.x, steps.inputs.start, of), y, weight)[
            None
        ]

    def entry(self, best: Trainable) -> Trainable:
        """What another part of the training has found, as a start of this one."""
        return best

    def weighed(self, loss: Float[Array, ""], trainable: Trainable) -> Float[Array, ""]:
        """The loss, and what is known without data."""
        return self.problem.weighed(loss, trainable)

    def penalties(self, trainable: Trainable) -> dict[str, Float[Array, ""]]:
        """What every regularizer adds to the loss."""
        return self.problem.penalties(trainable)


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
    objective = EquationError(problem, jnp.asarray(rows), jnp.asarray(states[rows]))
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
    start = objective.problem.start()
    batch = objective.draw(jax.random.key(0))
    gradient = eqx.filter_jit(jax.grad(lambda tree: objective.losses(tree, batch)[0]))(start)
    parts: dict[str, Any] = {**gradient.networks, **gradient.modifiers}
    return [n for n, g in parts.items() if not any(bool(a.any()) for a in jax.tree.leaves(g))]
