"""Gradients of many models in fixed implicit steps, compared with central differences."""

from typing import Any

import pytest

from .paths import cases_of, check, paths_of


@pytest.mark.cases(slow=3)
@pytest.mark.parametrize("name", cases_of("implicit"))
def test_gradients(name: str, record_property: Any) -> None:
    check(name, paths_of(name, "implicit"), record_property)
