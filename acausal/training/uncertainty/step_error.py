"""How far errors of the predictions move what is trained: that of fixed steps, and what a training has left."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from jaxtyping import Float
from scipy.linalg import solve_triangular

from acausal.simulation import Adaptive
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.uncertainty.record_elimination import RecordJacobian


def step_error(problem: Problem, trainable: Trainable) -> Float[np.ndarray, "N n_targets"]:
    """What shorter steps change in the predictions; zero for adaptive steps, which know their error.

    Nothing is known where inputs are delayed by a time that is trained, as they are laid out for these steps: zero.
    """
    known = np.asarray(problem.simulate(trainable).y)
    if isinstance(problem.solver, Adaptive) or problem.timing.delays:
        return np.zeros_like(known)
    return np.asarray(problem.finer().simulate(trainable).y) - known


def move(
    blocks: Sequence[RecordJacobian], error: Float[np.ndarray, " rows"]
) -> tuple[Float[np.ndarray, " n"], float]:
    """How an error of the predictions moves what all records have in common; by how many standard deviations at most.

    Arguments:
        blocks: the Jacobian by record; the error is in standard deviations of the residuals, too.
        error: by all rows, one after the other.

    What each record has for itself takes its part of the error first.
    """
    ends = np.cumsum([0, *(len(b.common) for b in blocks)]).tolist()
    rows: list[np.ndarray] = []
    left: list[np.ndarray] = []
    for block, (a, b) in zip(blocks, pairwise(ends), strict=True):
        m = block.own.shape[1]
        basis = np.linalg.qr(np.concatenate([block.own, np.eye(m)]))[0]  # with its prior
        common = np.concatenate([block.common, np.zeros((m, block.common.shape[1]))])
        shift = np.concatenate([error[a:b], np.zeros(m)])
        rows.append(common - basis @ (basis.T @ common))
        left.append(shift - basis @ (basis.T @ shift))
    n = blocks[0].common.shape[1]
    matrix = np.concatenate([*rows, np.eye(n)])  # the prior
    basis, root = np.linalg.qr(matrix)
    along = basis[: len(matrix) - n].T @ np.concatenate(left)
    return solve_triangular(root, along), float(np.linalg.norm(along))
