"""Covariances of numbers that several records have in common, beside numbers that each record has for itself.

A record's own numbers touch its own rows of the Jacobian alone, so they are eliminated record by record: time and
memory grow with the number of records, not with its square.
"""

from __future__ import annotations

from collections.abc import Sequence
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
    rows, left = _without_own(blocks, error[:, None])
    n = rows.shape[1]
    matrix = np.concatenate([rows, np.eye(n)])  # the prior
    basis, root = np.linalg.qr(matrix)
    along = basis[: len(rows)].T @ left[:, 0]
    return solve_triangular(root, along), float(np.linalg.norm(along))


def untaken(
    blocks: Sequence[RecordJacobian], errors: Float[np.ndarray, "rows k"]
) -> Float[np.ndarray, "more k"]:
    """What errors of the predictions leave where all numbers have taken their part; arguments as of `move`.

    Rows for the prior follow those of the records: products of two results count what the numbers move by, too.
    """
    rows, left = _without_own(blocks, errors)
    n = rows.shape[1]
    basis = np.linalg.qr(np.concatenate([rows, np.eye(n)]))[0]
    left = np.concatenate([left, np.zeros((n, left.shape[1]))])
    return left - basis @ (basis.T @ left)


def _without_own(
    blocks: Sequence[RecordJacobian], errors: Float[np.ndarray, "rows k"]
) -> tuple[Float[np.ndarray, "more n"], Float[np.ndarray, "more k"]]:
    """The rows of what all records have in common, and errors, less what each record's own numbers take of them."""
    ends = np.cumsum([len(b.common) for b in blocks])[:-1]
    found: list[np.ndarray] = []
    for block, error in zip(blocks, np.split(errors, ends), strict=True):
        m, both = block.own.shape[1], np.concatenate([block.common, error], axis=1)
        basis = np.linalg.qr(np.concatenate([block.own, np.eye(m)]))[0]  # with its prior
        both = np.concatenate([both, np.zeros((m, both.shape[1]))])
        found.append(both - basis @ (basis.T @ both))
    rows, left = np.split(np.concatenate(found), [blocks[0].common.shape[1]], axis=1)
    return rows, left


def _triangle(block: RecordJacobian) -> Float[np.ndarray, "k m+n"]:
    """The triangle of a record's rows and the prior of its own numbers, which come first."""
    m, n = block.own.shape[1], block.common.shape[1]
    prior = np.concatenate([np.eye(m), np.zeros((m, n))], axis=1)
    rows = np.concatenate([np.concatenate([block.own, block.common], axis=1), prior])
    return np.asarray(np.linalg.qr(rows, mode="r"))
