"""By what the loss counts targets of unlike noise, once a model explains them: by that noise.

Beside a target with much noise, the loss that counts each by its own deviation hardly sees what a target with little of
it says: where a position is known to 0.2 % and an acceleration to 10 %, a mass came out 20 times as far off.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Array, Float

from acausal.training.objective.losses import LEAST, LOSSES, noise_of
from acausal.training.objective.problem import Problem

UNLIKE = 2.0
"""Targets whose noise, relative to their deviations, differs by more than this factor are counted by it."""


def noise_scale(
    problem: Problem, predictions: Sequence[Float[Array, "N n_targets"]], step_error: float
) -> Float[np.ndarray, " n_targets"] | None:
    """Deviations by which the loss counts targets in proportion to their noise; ``None`` where theirs will do.

    What leaves nothing but noise has the same loss by either.

    Arguments:
        problem: what was trained. predictions: by training, of all records.
        step_error: of the predictions, by the loss; a target is not known better than that.
    """
    if problem.loss is not LOSSES["nrmse"] or len(problem.targets) == 1:
        return None
    sigma = np.asarray(problem.records.sigma)
    noise = np.mean([noise_of(problem.records, y) for y in predictions], axis=0) / sigma
    noise = np.maximum(noise, max(step_error, LEAST))
    if noise.max() < UNLIKE * noise.min():
        return None
    return sigma * noise * np.sqrt(len(noise) / np.sum(noise**2))
