"""Covariances of numbers that several records have in common, beside numbers that each record has for itself.

A record's own numbers touch its own rows of the Jacobian alone, so they are eliminated record by record: time and
memory grow with the number of records, not with its square.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.linalg import solve_triangular


class RecordJacobian(NamedTuple):
    """The Jacobian of the predictions of one record, in standard deviations of the residuals.

    Attributes:
        common: by the numbers that all records have in common.
        own: by the record's own numbers.
    """

    common: Float[np.ndarray, "rows n"]
    own: Float[np.ndarray, "rows m"]


class Covariance(NamedTuple):
    """The covariance of numbers whose prior standard deviations are 1.

    Attributes:
        common: of those in common.
        own: of each record's own numbers.
        root: a triangle R of the inverse of the first, ``RᵀR``.
    """

    common: Float[np.ndarray, "n n"]
    own: tuple[Float[np.ndarray, "m m"], ...]
    root: Float[np.ndarray, "n n"]

    @property
    def determined(self) -> float:
        """How many of the numbers the data determine."""
        known = [len(c) - np.trace(c) for c in (self.common, *self.own)]
        return float(sum(known))


def posterior_covariance(blocks: Sequence[RecordJacobian], samples: float) -> Covariance:
    """The covariance of numbers, after their prior standard deviations of 1, from blocks of all records.

    Residuals are smaller than the noise, because the numbers follow a part of it: as many as the data determine. The
    rows are worth so many independent samples.
    """
    determined = covariance(blocks).determined
    grown = np.sqrt(max(samples / max(samples - determined, 1.0), 1.0))
    return covariance([RecordJacobian(b.common / grown, b.own / grown) for b in blocks])


def covariance(blocks: Sequence[RecordJacobian]) -> Covariance:
    """``(JᵀJ + 1)⁻¹`` by QR decompositions: JᵀJ would lose twice as many digits."""
    triangles = [_triangle(b) for b in blocks]
    m = blocks[0].own.shape[1]
    n = blocks[0].common.shape[1]
    reduced = np.concatenate([*(t[m:, m:] for t in triangles), np.eye(n)])
    root = np.asarray(np.linalg.qr(reduced, mode="r"))
    half = solve_triangular(root, np.eye(n))
    common = half @ half.T

    def own(triangle: Float[np.ndarray, "k m+n"]) -> Float[np.ndarray, "m m"]:
        alone, coupling = (
            solve_triangular(triangle[:m, :m], side) for side in (np.eye(m), triangle[:m, m:])
        )
        return alone @ alone.T + coupling @ common @ coupling.T

    return Covariance(common, tuple(own(t) for t in triangles), root)


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


def _triangle(block: RecordJacobian) -> Float[np.ndarray, "k m+n"]:
    """The triangle of a record's rows and the prior of its own numbers, which come first."""
    m, n = block.own.shape[1], block.common.shape[1]
    prior = np.concatenate([np.eye(m), np.zeros((m, n))], axis=1)
    rows = np.concatenate([np.concatenate([block.own, block.common], axis=1), prior])
    return np.asarray(np.linalg.qr(rows, mode="r"))
