"""What stands for other machines: values with other last bits, and how near bars are to what is measured."""

import numpy as np
import pytest

from tests.support.machines import CHANGE, changed, distances


def test_values_change_in_their_last_bits_by_seed() -> None:
    values = np.append(np.random.default_rng(0).normal(size=1000), [0.0, np.nan])
    one, again, other = (changed(values, seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, again)
    assert np.mean(one[:-2] != other[:-2]) > 0.5
    assert 0.9 * CHANGE < np.max(np.abs(one[:-2] / values[:-2] - 1)) < 1.5 * CHANGE
    assert one[-2] == 0
    assert np.isnan(one[-1])


@pytest.mark.parametrize(
    ("op", "left", "right", "nearest"),
    [
        ("<", 0.8, 1.0, 0.25),
        (">", 0.8, 1.0, 0.25),
        ("<", np.array([0.1, 0.5]), 1.0, 1.0),
        ("<", np.array([0.5, 0.1]), np.array([1.0, 0.11]), 0.1),
        ("==", 1.08, pytest.approx(1.0, abs=0.1), 0.25),
        ("==", [1.0, 1.08], pytest.approx([1.0, 1.0], abs=0.1), 0.25),
        ("==", {"a": 1.08}, pytest.approx({"a": 1.0}, rel=0.1), 0.25),
        ("<", 3, 4, None),
        ("<", "a", "b", None),
        ("==", 1.0, 1.0, None),
    ],
)
def test_the_nearest_bar_is_found(
    op: str, left: object, right: object, nearest: float | None
) -> None:
    found = [apart for *_, apart in distances(op, left, right)]
    if nearest is None:
        assert not found
    else:
        assert min(found) == pytest.approx(nearest)
