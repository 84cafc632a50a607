"""Gradients of many models in adaptive steps, compared with central differences."""

from typing import Any

import pytest

from .models import CASES
from .paths import PATHS, check, paths_of


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_gradients(name: str, record_property: Any) -> None:
    check(name, [p for p in paths_of(name) if PATHS[p].adaptive], record_property)
