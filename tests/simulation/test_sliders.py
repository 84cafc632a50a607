"""Sliders simulate again without compiling again, and refuse what is neither a parameter nor a range."""

from typing import Any

import pytest

import acausal as ac
from acausal.components import translational as tl
from acausal.simulation.sliders import Moved, ranges_of
from tests.support.counted import compilations


class Oscillator(ac.Component):
    def __init__(self) -> None:
        super().__init__()
        self.wall, self.spring, self.mass, self.push = (
            *(tl.Fixed(), tl.Spring(c=50.0)),
            *(tl.Mass(m=1.0), tl.Force()),
        )
        self.connect(self.wall.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Oscillator())


def moved(system: ac.System, **options: Any) -> Moved:
    ranges = ranges_of(system, {"spring.c": (1.0, 100.0), "push.f": (0.0, 4.0)})
    return Moved(system, ranges, (0.0, 1.0), "mass.s", {}, {}, {"dt": 0.01, **options})


def test_a_slider_starts_at_the_model_s_value(system: ac.System) -> None:
    spring, push = moved(system).ranges
    assert (spring.value, spring.unit, spring.logarithmic) == (50.0, "N/m", True)
    assert (push.value, push.unit, push.logarithmic) == (2.0, "N", False)


def test_moving_compiles_nothing(system: ac.System) -> None:
    """Neither for a parameter, nor for an input, nor to read what is plotted."""
    model = moved(system)
    first = model.picture({"spring.c": 50.0, "push.f": 1.0})
    with compilations() as compiled:
        second = model.picture({"spring.c": 20.0, "push.f": 3.0})
    assert not compiled
    assert first.startswith("<svg")
    assert first != second


def test_what_fails_is_told_instead_of_a_picture(system: ac.System) -> None:
    model = moved(system, x0={"mass.z": 1.0})
    assert "mass.z" in model.picture({"spring.c": 50.0, "push.f": 1.0})


@pytest.mark.parametrize(
    ("ranges", "message"),
    [
        ({"spring.k": (0, 1)}, "'spring.k' is neither a parameter nor an input"),
        ({"spring.c": (1, 0)}, "give the least and the largest value"),
        ({"spring.c": 3}, "give the least and the largest value"),
    ],
)
def test_what_cannot_be_moved_is_refused(system: ac.System, ranges: Any, message: str) -> None:
    with pytest.raises(ac.DataError, match=message):
        ranges_of(system, ranges)


def test_names_alone_vary_by_a_factor_within_their_bounds(system: ac.System) -> None:
    (spring,) = ranges_of(system, ["spring.c"])
    assert (spring.low, spring.high) == (12.5, 200.0)
    with pytest.raises(ac.DataError, match="the least and the largest value"):
        ranges_of(system, ["push.f"])
    with pytest.raises(
        ac.DataError, match=r"not a time; give it first, ac\.sliders\(system, 10\.0, "
    ):
        ac.sliders(system, ["spring.c"])  # pyright: ignore


def test_widgets_follow(system: ac.System) -> None:
    pytest.importorskip("ipywidgets")
    box = ac.sliders(
        system, (0.0, 1.0), {"spring.c": (1.0, 100.0)}, dt=0.01, inputs={"push.f": 1.0}
    )
    knob, picture = box.children
    before = picture.value
    knob.value = 80.0
    assert picture.value != before
