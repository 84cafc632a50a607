"""Gradients of many models in adaptive steps, compared with central differences."""

from typing import Any

import pytest

from .paths import cases_of, check, paths_of


@pytest.mark.cases(slow=3)
@pytest.mark.parametrize("name", cases_of("adaptive"))
def test_gradients(name: str, record_property: Any) -> None:
    check(name, paths_of(name, "adaptive"), record_property)
