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
from acausal.training.objective.losses import number
from acausal.training.objective.modifiers import Modifiers
from acausal.training.objective.problem import Problem
from acausal.training.objective.record import Batch
from acausal.training.objective.smoothing import smoothed
from acausal.training.objective.trainable import Trainable

SAMPLES = 5000
"""The most samples of the record that count; they are evenly spread."""


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
        packed = p.system.pack(p.assemble(trainable))
        t, u, y = (a[self.rows] for a in (p.times, p.inputs, p.measured))
        predicted = jax.vmap(lambda t, x, u: p.system.read(p.targets, Values(t, x, u, packed)))(
            t, self.x, u
        )
        return number("The loss", p.loss, predicted, y, p.sigma)[None]

    def penalties(self, trainable: Trainable) -> dict[str, Float[Array, ""]]:
        """What every regularizer adds to the loss."""
        return self.problem.penalties(trainable)


def equation_error(problem: Problem) -> EquationError:
    """The equation error of a problem.

    Raises:
        TrainingError: if states are not measured, or no target depends on something that is to be trained.
    """
    if problem.measured_states is None:
        raise TrainingError(
            "The equation error needs all states in the data: "
            "leave 'equation_error' out of the strategy, or measure them."
        )
    states = _smoothed(np.asarray(problem.measured_states), problem.is_uniform)
    count = problem.samples
    rows = np.unique(np.linspace(0, count - 1, min(count, SAMPLES)).astype(int))
    objective = EquationError(problem, jnp.asarray(rows), jnp.asarray(states[rows]))
    unseen = _unseen(objective)
    if unseen:
        raise TrainingError(
            f"At an instant no target depends on {listing(unseen)}: the equation error cannot train it. "
            "Add a target that does, such as a force or an acceleration, or leave 'equation_error' out."
        )
    return objective


def _smoothed(
    x: Float[np.ndarray, "n_samples n_states"], uniform: bool
) -> Float[np.ndarray, "n_samples n_states"]:
    """The measured states; smoothed, if samples are evenly spaced."""
    return np.stack([smoothed(column) for column in x.T], axis=1) if uniform else x


def _unseen(objective: EquationError) -> list[str]:
    """Networks and parameters that the loss does not depend on."""
    start = objective.problem.start()
    batch = objective.draw(jax.random.key(0))
    gradient = eqx.filter_jit(jax.grad(lambda tree: objective.losses(tree, batch)[0]))(start)
    parts: dict[str, Any] = {**gradient.networks, **gradient.modifiers}
    return [n for n, g in parts.items() if not any(bool(a.any()) for a in jax.tree.leaves(g))]
