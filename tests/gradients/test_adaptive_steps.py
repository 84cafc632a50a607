"""Gradients of many models in adaptive steps, compared with central differences."""

from typing import Any

import pytest

from .models import CASES
from .paths import LEFT_OUT, check, paths_of


@pytest.mark.slow
@pytest.mark.parametrize("name", [n for n in CASES if (n, "adaptive") not in LEFT_OUT])
def test_gradients(name: str, record_property: Any) -> None:
    check(name, paths_of(name, "adaptive"), record_property)
