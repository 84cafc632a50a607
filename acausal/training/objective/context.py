"""The trajectory of a model over its records before training, and the arguments of its networks along it."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.errors import TrainingError
from acausal.training.objective.problem import Problem
from acausal.training.objective.regularizers import Context, Trajectory

SAMPLES = 1000
"""The most samples of the records in the context of regularizers; they are evenly spread."""


def context(problem: Problem) -> Context:
    """The arguments of regularizers besides the parameters.

    Raises:
        TrainingError: if states are not measured, and the model diverges.
    """
    rows = np.unique(np.linspace(0, len(problem.records) - 1, SAMPLES).astype(int))
    x = states_before_training(problem)
    t = problem.records.steps.t
    passed = Trajectory(problem.system, t[rows], x[rows], problem.inputs[rows])
    return Context(problem.networks, problem.seen(problem.start(), x, jnp.asarray(rows)), passed)


def states_before_training(problem: Problem) -> Float[Array, "N n_states"]:
    """The states at every row: as measured, else as the model has them before training.

    Raises:
        TrainingError: if the model diverges.
    """
    measured = problem.records.x
    if measured is not None and not bool(jnp.isnan(measured).any()):
        return measured
    x = problem.simulate(problem.start()).x
    if not bool(jnp.isfinite(x).all()):
        raise TrainingError(
            "The model diverges over its records before training; start from better parameters."
        )
    return x
