"""What messages say."""

from __future__ import annotations

import pytest

from acausal.errors import percent


@pytest.mark.parametrize(
    ("share", "text"), [(0.0123, "1.2 %"), (0.999, "100 %"), (2.234, "223 %"), (-3.0, "-300 %"), (2e-6, "0.0002 %")]
)  # fmt: skip
def test_shares_are_written_without_powers_of_ten(share: float, text: str) -> None:
    assert percent(share) == text
