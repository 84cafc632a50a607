"""Whether a large loop is torn: if few guesses are enough, and what follows from them keeps their digits."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_triangular

from acausal.structure.algebraic_loops import block_of, torn_block
from acausal.structure.equations import Equations
from acausal.structure.jacobian import Point, random_values
from acausal.structure.tearing import Torn

FEW = 12
"""The most tearing variables of a large loop: as many as are eliminated without a library."""
COST = 1000
"""The most unknowns times tearing variables: with 138 and 6, XLA compiles a gradient for half a minute."""
LOST = 1e-9
"""The largest error of a torn loop's linear equations. In a long row of equations it may grow with each of them."""


def tearing_pays(
    system: Equations,
    equations: list[int],
    unknowns: list[int],
    vanishing: set[tuple[int, int]],
    parameters: np.ndarray,
) -> bool:
    """Whether a loop is better torn than solved with its sparse Jacobian, with the model's own parameters."""
    block = block_of(system, equations, unknowns, vanishing)
    torn = torn_block(system, [block])
    if len(torn.tears) > min(FEW, COST // len(unknowns)):
        return False
    point = Point(random_values(len(system.structure.derivative)), parameters)
    place = np.full(len(system.structure.derivative), -1)
    place[unknowns] = np.arange(len(unknowns))
    rows, nodes, values = system.jacobian(equations, point)
    inside = place[nodes] >= 0
    jacobian = np.zeros((len(unknowns),) * 2)
    np.add.at(jacobian, (rows[inside], place[nodes[inside]]), values[inside])
    return _error(torn, jacobian) < LOST


def _error(torn: Torn, jacobian: np.ndarray) -> float:
    """The largest error where the equations are solved in the order of the tearing, for a solution of ones."""
    rows = [*(e for e, _ in torn.assigned), *torn.residuals]
    columns = [*(v for _, v in torn.assigned), *torn.tears]
    matrix, k = jacobian[np.ix_(rows, columns)], len(torn.assigned)
    right = np.column_stack([matrix.sum(axis=1), matrix[:, k:]])
    try:
        first = solve_triangular(matrix[:k, :k], right[:k], lower=True)
        rest = right[k:] - matrix[k:, :k] @ first
        tears = np.linalg.solve(rest[:, 1:], rest[:, 0])
    except np.linalg.LinAlgError:
        return np.inf
    found = np.append(first[:, 0] - first[:, 1:] @ tears, tears)
    return float(np.abs(found - 1.0).max())
