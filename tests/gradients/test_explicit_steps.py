"""Gradients of many models in fixed explicit steps, compared with central differences."""

from typing import Any

import pytest

from .models import CASES
from .paths import IN_TURN, PATHS, check, paths_of


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_gradients(name: str, record_property: Any) -> None:
    check(name, paths_of(name, "explicit"), record_property)


def test_models_and_paths_are_many() -> None:
    taken = [p for name in CASES for kind in IN_TURN for p in paths_of(name, kind)]
    assert len(CASES) >= 40
    assert all(taken.count(p) >= 10 for p in PATHS)
