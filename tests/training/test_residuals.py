"""What residuals say, by how much is left to explain."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.training.uncertainty.residuals import Piece, residuals

T = np.linspace(0, 20, 2001)
PUSH = np.sin(3 * T)


@pytest.mark.parametrize(
    ("left", "said"),
    [
        (0.005, "could still be explained, which is little."),
        (
            0.1,
            "10 % of it could still be explained: the model lacks something, or trained too little.",
        ),
        (0.9, "90 % of it is not explained: do not use the model before you know why."),
    ],
)
def test_residuals_are_graded_by_what_remains_to_be_explained(left: float, said: str):
    """All three follow the push beyond chance."""
    noise = 0.01 * np.random.default_rng(0).standard_normal(len(T))
    found = residuals("y", [Piece(noise + left * np.sqrt(2) * PUSH, {"push.f": PUSH})], 1.0)
    assert "the residuals still follow 'push.f'" in found.summary()
    assert found.summary().endswith(said)
    assert found.noise == pytest.approx(0.01, rel=0.1)
    assert found.unexplained == pytest.approx(left, rel=0.1)
