"""The framework: the gradient that `acausal.fit` takes in an update."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

import acausal as ac
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.objective.sequences import Batch
from acausal.training.objective.sharding import replicate
from acausal.training.options import FitOptions
from benchmarks.qvm.task import NETWORKS, Gradient, Task, flat
from examples.qvm.model import with_networks
from examples.qvm.record import OUTPUTS, SAMPLE_TIME


def gradient(task: Task, **choice: Any) -> Callable[[], Gradient]:
    """Ready to run; ``choice`` may name the ``dtype`` and the ``devices``, as for `acausal.fit`."""
    problem = posed(task, **choice)
    batch = Batch(jnp.asarray(task.starts), jnp.ones(len(task.starts)), None)
    compiled = jax.jit(jax.value_and_grad(_loss))
    arguments = replicate((problem.start(), problem, batch), problem.mesh)

    def run() -> Gradient:
        loss, by = jax.block_until_ready(compiled(*arguments))
        return loss, flat([(by.networks[n].weights, by.networks[n].biases) for n in NETWORKS])

    return run


def posed(task: Task, **choice: Any) -> Problem:
    """The training problem behind a task."""
    is_whole = len(task.starts) == 1
    options = FitOptions(
        sequence_length=None if is_whole else task.length * SAMPLE_TIME,
        batch_size=len(task.starts),
        **choice,
    )
    return build_problem(
        ac.compile(with_networks()), {"record": task.record}, OUTPUTS, task.params, options
    )


def _loss(trainable: Any, problem: Problem, batch: Batch) -> Any:
    return jnp.mean(problem.losses(trainable, batch))
