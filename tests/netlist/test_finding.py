"""`acausal.find`: classes by words and units."""

import pytest

import acausal as ac
from acausal.components import electrical as el, rotational as rot


@pytest.mark.slow
def test_the_class_of_that_name_comes_first() -> None:
    found = ac.find("resistor")
    assert found[0] is el.Resistor
    assert found.names[0] == "electrical.Resistor"
    assert "thermal.ThermalResistor" in found.names
    assert el.Resistor in found


def test_there_is_one_line_for_each() -> None:
    found = ac.find("Resistor")
    first, *others = repr(found).splitlines()
    assert first.startswith("electrical.Resistor  ")
    assert first.endswith("  Linear resistor: v = R_actual i, LossPower = v i")
    assert len(others) == len(found) - 1
    assert max(map(len, others)) <= 100
    assert "Nothing" in repr(ac.find("no such thing"))


def test_every_word_counts_and_bases_come_last() -> None:
    assert ac.find("rotational flange")[-1].__name__.startswith("Partial")
    assert set(ac.find("heat capacitor")) < set(ac.find("heat"))
    assert rot.Flange in ac.find("flange")


def test_modelicas_names_are_known() -> None:
    assert ac.find("Modelica.Mechanics.Rotational.Components.Inertia")[0] is rot.Inertia


@pytest.mark.parametrize("unit", ["N.m", "N*m", "N m"])
def test_units_find_what_has_them(unit: str) -> None:
    found = ac.find("torque", unit=unit)
    assert rot.Torque in found
    assert set(found) <= set(ac.find("torque"))
    assert el.Resistor not in ac.find(unit=unit)


def test_all_classes_are_found_once_each() -> None:
    found = ac.find()
    assert len(found) == len(set(found)) > 500
    assert len(found[:3]) == 3


def test_what_is_no_text_is_refused() -> None:
    with pytest.raises(ac.DataError, match="not a text"):
        ac.find(3)  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("thermostat", "blocks.Hysteresis"),
        ("pwm", "blocks.Pulse"),
        ("dc motor", "electrical.RotationalEMF"),
        ("EMF", "electrical.RotationalEMF"),
        ("Modelica.Electrical.Analog.Basic.EMF", "electrical.RotationalEMF"),
        ("freqHz", "blocks.Sine"),
        ("Modelica.Blocks.Discrete.ZeroOrderHold", "blocks.discrete.ZeroOrderHold"),
    ],
)
def test_what_a_class_is_called_elsewhere_is_found(text: str, name: str) -> None:
    assert name in ac.find(text).names


def test_what_is_called_otherwise_exists() -> None:
    for path in ac.components.ALSO_CALLED:
        assert path in ac.find(path.rpartition(".")[2]).names
