"""Conversion of values between units."""

import numpy as np
import pytest

import acausal as ac
from acausal.units import convert


@pytest.mark.parametrize(
    ("given", "wanted", "converted"),
    [
        ("degF", "degC", -6.666667),
        ("W/degC", "W/K", 20.0),  # a difference of temperatures
        ("%", "", 0.2),
        ("N^0.5", "kg^0.5.m^0.5/s", 20.0),
        ("m2.s-1", "cm2/s", 2e5),
        ("delta_degC", "K", 20.0),
        ("lbf/ft", "N/m", 291.878),
    ],
)
def test_values_are_converted(given, wanted, converted):
    assert convert(np.array([20.0]), given, wanted, "x") == pytest.approx(converted, rel=1e-5)


@pytest.mark.parametrize(
    ("given", "wanted", "sentence"),
    [
        ("Nm", "N.m", "x: 'Nm' is not a unit; did you mean 'N.m'?"),
        ("m", "s", "x is given in 'm', which cannot become 's'"),
        ("m", "", "x is given in 'm', which cannot become '1'"),
        ("metre per second", "m/s", "x: 'metre per second' is not a unit"),
    ],
)
def test_what_cannot_be_converted(given, wanted, sentence):
    with pytest.raises(ac.DataError, match=sentence.replace("?", r"\?")):
        convert(np.array([20.0]), given, wanted, "x")
