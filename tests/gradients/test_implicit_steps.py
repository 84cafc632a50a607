"""Gradients of many models in fixed implicit steps, compared with central differences."""

from typing import Any

import pytest

from .models import CASES
from .paths import check, paths_of


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_gradients(name: str, record_property: Any) -> None:
    check(name, paths_of(name, "implicit"), record_property)
