"""Values in other units: what people write in the headers of files is read, and never as something else."""

import numpy as np
import pytest

import acausal as ac
from acausal.units import convert


@pytest.mark.parametrize(
    ("given", "wanted", "factor"),
    [
        ("mm", "m", 1e-3),
        ("mm²", "m2", 1e-6),
        ("cm/s²", "m/s2", 1e-2),
        ("km·s⁻¹", "m/s", 1e3),
        ("kg m s-2", "N", 1.0),
        ("m s^-1", "m/s", 1.0),
        ("kW.h", "J", 3.6e6),
        ("1/min", "1/s", 1 / 60),
        ("µm", "m", 1e-6),
        ("lbf", "N", 4.4482216152605),
    ],
)
def test_what_people_write(given, wanted, factor):
    np.testing.assert_allclose(convert(np.ones(2), given, wanted, "x"), factor)


@pytest.mark.parametrize("given", ["°C", "degC"])
def test_degrees(given):
    np.testing.assert_allclose(convert(np.zeros(1), given, "K", "T"), 273.15)


@pytest.mark.parametrize("given", ["Nm", "metre per second", "m/s/", "m²²m", "s2.5"])
def test_what_is_refused(given):
    with pytest.raises(ac.DataError, match="x"):
        convert(np.ones(1), given, "N.m", "x")
