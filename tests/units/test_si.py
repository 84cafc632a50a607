"""Units in base units, against pint where the factor is not 1."""

from __future__ import annotations

import pytest

from acausal.units import InSI, in_si


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("1", InSI({})),
        ("N.m/rad", InSI({"kg": 1, "m": 2, "s": -2})),
        ("kW", InSI({"kg": 1, "m": 2, "s": -3}, 1000.0)),
        ("degC", InSI({"K": 1}, 1.0, 273.15)),
        ("J/degC", InSI({"kg": 1, "m": 2, "s": -2, "K": -1})),
        ("km/h", InSI({"m": 1, "s": -1}, 1000 / 3600)),
        ("V/Hz^0.5", None),
        ("no unit", None),
        ("", None),
    ],
)
def test_units_in_base_units(unit: str, expected: InSI | None) -> None:
    found = in_si(unit)
    if expected is None or found is None:
        assert found is expected
        return
    assert found.exponents == expected.exponents
    assert (found.factor, found.offset) == pytest.approx((expected.factor, expected.offset))
