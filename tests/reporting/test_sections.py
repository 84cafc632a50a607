"""Sections of pages are made from plain arrays with names: no training is needed."""

from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np

from acausal.reporting import (
    LearnedLaw,
    Page,
    add_laws,
    add_parameters,
    add_predictions,
    add_records,
)

TIME = np.linspace(0.0, 1.0, 50)


@dataclass(frozen=True)
class Curve:
    x: np.ndarray
    law: np.ndarray
    sigma: np.ndarray


@dataclass(frozen=True)
class Followed:
    time: np.ndarray
    measured: np.ndarray
    predicted: np.ndarray

    @property
    def rms(self) -> dict[str, float]:
        return {"mass.s": 0.01, "mass.v": 0.01}


@dataclass(frozen=True)
class Statistics:
    mean: np.ndarray
    sigma: np.ndarray


def written(page: Page, folder: Path) -> str:
    return page.write(folder / "index.html").read_text(encoding="utf-8")


def test_every_target_has_a_figure_with_its_unit(tmp_path: Path) -> None:
    page, y = Page("Title"), np.stack([TIME, TIME**2], axis=1)
    units = {"mass.s": "m", "mass.v": "m/s"}
    gappy = y.copy()
    gappy[10:20] = np.nan
    before, after = Followed(TIME, gappy, 0 * y), Followed(TIME, gappy, y + 0.01)
    add_records(page, "Measured and simulated", {"run": before}, {"run": after}, units)
    bands = {"run": {"mass.s": Curve(TIME, TIME, 0 * TIME + 0.1)}}
    add_predictions(page, {"run": after}, bands, {"mass.s": "m"})
    text = written(page, tmp_path)
    assert text.count("<figure>") == 3
    assert "A stretch of &#x27;mass.v&#x27;, and its errors over all of it." in text
    assert "RMS error of mass.v [m/s]" in text
    assert "0.01" in text


def test_of_many_records_each_is_in_the_table_and_some_are_drawn(tmp_path: Path) -> None:
    page, y = Page("Title"), TIME[:, None]
    nothing = Followed(TIME, np.full_like(y, np.nan), y)
    records = {f"run {i}": Followed(TIME, y, y) for i in range(20)} | {"run 3": nothing}
    add_records(page, "Held out", {}, records, {"mass.s": "m"})
    text = written(page, tmp_path)
    assert text.count("<figure>") == 8
    assert all(f"run {i}" in text for i in range(20))


def test_laws_and_parameters(tmp_path: Path) -> None:
    page, one = Page("Title"), np.ones(1)
    law = LearnedLaw(Curve(TIME, TIME, 0 * TIME), Statistics(0.5 * one, 0.2 * one), TIME[::10])
    add_laws(page, {"net": law})
    add_parameters(page, ("parameter", "value"), [("mass.m", "2 kg")], ["It is known."])
    text = written(page, tmp_path)
    for piece in ("Learned laws", "mass.m", "It is known."):
        assert piece in text


def test_what_is_empty_has_no_heading(tmp_path: Path) -> None:
    page = Page("Title")
    add_laws(page, {})
    add_parameters(page, ("parameter", "value"), [])
    assert "<h2>" not in written(page, tmp_path)
