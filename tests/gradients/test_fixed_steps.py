"""Gradients of many models in fixed steps, compared with central differences."""

from typing import Any

import pytest

from .models import CASES
from .paths import PATHS, check, paths_of


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_gradients(name: str, record_property: Any) -> None:
    check(name, [p for p in paths_of(name) if PATHS[p].fixed], record_property)


def test_models_and_paths_are_many() -> None:
    taken = [p for name in CASES for p in paths_of(name)]
    assert len(CASES) >= 40
    assert all(taken.count(p) >= 10 for p in PATHS)
