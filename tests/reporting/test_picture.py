"""Small plots are SVG that needs nothing else, whatever the curves are."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from acausal.reporting import Curve, small_plot
from acausal.reporting.document.picture import POINTS, ticks


def curve(y: object, **options: object) -> Curve:
    y = np.asarray(y, float)
    return Curve("a <b>", np.arange(len(y), dtype=float), y, **options)  # pyright: ignore[reportArgumentType]


def test_a_plot_is_valid_svg_with_labels() -> None:
    text = small_plot([curve([0, 1, 4])], across="time in s", upwards="m")
    root = ElementTree.fromstring(text)
    assert root.tag.endswith("svg")
    assert {"a <b>", "time in s", "m"} <= {e.text for e in root.iter()}


def test_what_is_not_finite_interrupts_a_curve() -> None:
    (path,) = re.findall(
        r' d="(M[^"]*L[^"]*)" fill="none"', small_plot([curve([0, 1, np.nan, 2, 3])])
    )
    assert path.count("M") == 2


@pytest.mark.parametrize("y", [[], [np.nan, np.nan]])
def test_nothing_to_show_is_an_empty_text(y: list[float]) -> None:
    assert small_plot([curve(y)]) == ""


@pytest.mark.parametrize("y", [[3.0, 3.0], [0.0, 0.0], [1e-300, 1e300], [5.0]])
def test_any_extent_can_be_drawn(y: list[float]) -> None:
    assert "NaN" not in small_plot([curve(y)]).replace("nan", "NaN")


def test_long_curves_keep_their_peaks() -> None:
    y = np.zeros(100_000)
    y[54_321] = 1.0
    text = small_plot([curve(y)])
    assert len(text) < 20 * POINTS
    heights = [float(v) for v in re.findall(r"L[\d.]+ ([\d.]+)", text)]
    assert min(heights) < 0.3 * max(heights)


def test_a_logarithmic_axis_leaves_out_what_is_not_positive() -> None:
    text = small_plot([curve([1, 10, 0, 100])], logarithmic=True)
    assert ">10<" in text
    assert ">100<" in text


def test_a_band_and_steps() -> None:
    text = small_plot(
        [curve([1, 2, 3], bounds=(np.zeros(3), np.full(3, 4.0))), curve([1, 2, 3], steps=True)]
    )
    assert "fill-opacity" in text
    assert "H" in text


def test_ticks_are_round() -> None:
    assert ticks(0, 1, 5) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert ticks(-3e5, 7e5, 4) == pytest.approx([0, 5e5])
