"""Gradients of many models in fixed explicit steps, compared with central differences."""

from typing import Any

import pytest

from .models import CASES
from .paths import DEAR, IN_TURN, PATHS, cases_of, check, paths_of


@pytest.mark.cases(slow=3)
@pytest.mark.parametrize("name", cases_of("explicit"))
def test_gradients(name: str, record_property: Any) -> None:
    check(name, paths_of(name, "explicit"), record_property)


def test_models_and_paths_are_many() -> None:
    taken = [p for name in CASES for kind in IN_TURN for p in paths_of(name, kind)]
    assert len(CASES) >= 40
    assert all(taken.count(p) >= 10 for p in PATHS)


def test_every_model_but_the_dear_is_in_the_slow_tests() -> None:
    cases = [case for kind in IN_TURN for case in cases_of(kind)]
    slow = [
        case.values[0] for case in cases if pytest.mark.slow.mark in [m.mark for m in case.marks]
    ]
    assert sorted([*slow, *DEAR]) == sorted(CASES)
