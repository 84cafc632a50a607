"""Pages in a real browser: clicks and keys do what they say, nothing is asked for, and a phone shows all of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from acausal.reporting import (
    Animation,
    Card,
    Curve,
    Moving,
    PageContent,
    Plot,
    Section,
    Tab,
    render,
)
from acausal.reporting.document.library import plot_library
from tests.support.browser import Browser, browser
from tests.support.pages import EVIL, content

PHONE = 380
"""Width of a phone, in pixels."""


@pytest.fixture(scope="module")
def tab() -> Iterator[Browser]:
    with browser() as found:
        yield found


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if plot_library() is None:
        pytest.skip("mpld3 is not installed: plots cannot be zoomed.")
    return written(tmp_path_factory.mktemp("pages"), content())


def written(folder: Path, told: Any, library: str | None = None) -> Path:
    file = folder / "index.html"
    file.write_text(render(told, library), encoding="utf-8")
    return file


def shown_card(tab: Browser) -> list[str]:
    return tab.evaluate(
        "[...document.querySelectorAll('.card')].filter(c => !c.hidden).map(c => c.dataset.card)"
    )


def axis(tab: Browser, figure: int) -> list[str]:
    """The numbers on the horizontal axis of a plot."""
    return tab.evaluate(
        f"[...document.querySelectorAll('.plot[data-plot=\"{figure}\"] svg g[text-anchor=middle] text')]"
        ".map(t => t.textContent)"
    )


def readings(tab: Browser, figure: int) -> list[str]:
    """The values at the cursor of a plot."""
    return tab.evaluate(
        f"[...document.querySelectorAll('.plot[data-plot=\"{figure}\"] .bar output')].map(o => o.textContent)"
    )


def test_a_page_asks_for_nothing_and_reports_nothing(tab: Browser, page: Path):
    tab.open(page)
    assert tab.requests == [page.resolve().as_uri()]
    assert tab.messages == []
    assert shown_card(tab) == [""]


def test_a_click_on_the_schematic_shows_the_component(tab: Browser, page: Path):
    tab.open(page)
    tab.click("svg [data-component=spring] rect")
    assert shown_card(tab) == ["spring"]
    assert tab.evaluate("location.hash") == "#spring"
    assert tab.evaluate("document.querySelectorAll('.card:not([hidden]) math').length") == 1
    assert tab.evaluate("document.querySelectorAll('.card:not([hidden]) .plot svg').length") == 2
    pressed = "[...document.querySelectorAll('[aria-pressed=true][data-component]')].map(e => e.dataset.component)"
    assert tab.evaluate(pressed) == ["spring", "spring"]
    tab.click("svg [data-component=cells] rect")
    assert shown_card(tab) == ["cells[1]"]
    assert tab.messages == []


def test_a_component_is_chosen_by_its_name_by_key_and_by_address(tab: Browser, page: Path):
    tab.open(page, part="#spring")
    assert shown_card(tab) == ["spring"]
    tab.click("button[data-component='cells[2]']")
    assert shown_card(tab) == ["cells[2]"]
    tab.evaluate("document.querySelector('svg [data-component=spring]').focus()")
    tab.press("Enter", "\r")
    assert shown_card(tab) == ["spring"]
    tab.open(page, part="#nothing%")
    assert shown_card(tab) == [""]
    assert tab.messages == []


def test_tabs_follow_clicks_and_arrow_keys(tab: Browser, page: Path):
    tab.open(page)
    visible = "[...document.querySelectorAll('[role=tabpanel]')].filter(p => p.offsetParent).map(p => p.id)"
    assert tab.evaluate(visible) == ["part0"]
    tab.click("#tab1")
    assert tab.evaluate(visible) == ["part1"]
    tab.press("ArrowRight")
    assert tab.evaluate(visible) == ["part2"]
    tab.press("ArrowRight")
    assert tab.evaluate(visible) == ["part0"]
    assert tab.evaluate("document.activeElement.getAttribute('aria-selected')") == "true"


def test_plots_of_a_group_zoom_pan_and_are_read_together(tab: Browser, page: Path):
    tab.open(page)
    tab.click("#tab1")
    place = tab.middle('.plot[data-plot="2"] svg')
    whole = axis(tab, 2)
    assert (whole[0], whole[-1]) == ("0", "10")
    tab.move(**place)
    tab.settle()
    values = readings(tab, 2)
    assert len(values) == 3
    assert all(values)
    assert readings(tab, 3) == values
    tab.wheel(place["x"], place["y"], -400)
    tab.settle()
    assert axis(tab, 2) == whole, "the wheel scrolls the page until a plot is clicked"
    tab.click('.plot[data-plot="2"] svg')
    place = tab.middle('.plot[data-plot="2"] svg')
    tab.wheel(place["x"], place["y"], -400)
    tab.settle()
    near = axis(tab, 2)
    assert near != whole
    assert axis(tab, 3) == near
    tab.drag((place["x"], place["y"]), (place["x"] + 200, place["y"]))
    tab.settle()
    moved = axis(tab, 2)
    assert float(moved[0]) < float(near[0])
    tab.click('.plot[data-plot="2"] [aria-label="Show all"]')
    assert axis(tab, 2) == whole
    assert tab.messages == []


def test_plots_follow_keys(tab: Browser, page: Path):
    tab.open(page)
    tab.click("#tab1")
    whole = axis(tab, 2)
    tab.evaluate("document.querySelector('.plot[data-plot=\"2\"] svg').focus()")
    tab.press("ArrowRight")
    first = readings(tab, 2)
    tab.press("ArrowRight")
    assert all(first)
    assert readings(tab, 2) != first
    tab.press("+", "+")
    near = axis(tab, 2)
    assert near != whole
    tab.press("ArrowRight", shift=True)
    assert float(axis(tab, 2)[0]) > float(near[0])
    tab.press("0", "0")
    assert axis(tab, 2) == whole


def test_curves_are_hidden_and_shown(tab: Browser, page: Path):
    tab.open(page)
    tab.click("#tab1")
    drawn = "document.querySelector('.plot[data-plot=\"2\"] path.after').getAttribute('d') || ''"
    assert tab.evaluate(drawn)
    tab.click('.plot[data-plot="2"] .key.after')
    assert not tab.evaluate(drawn)
    tab.click('.plot[data-plot="2"] .key.after')
    assert tab.evaluate(drawn)


def test_a_band_stays_within_the_plot_and_says_how_sure_a_law_is(tab: Browser, page: Path):
    tab.open(page)
    tab.click("#tab2")
    assert tab.evaluate("document.querySelectorAll('#part2 .shade').length") == 2
    assert tab.evaluate("document.querySelector('#part2 .band').closest('[clip-path]') !== null")
    place = tab.middle("#part2 .plot svg")
    tab.move(**place)
    tab.settle()
    assert "±" in readings(tab, 4)[0]


def test_a_printed_page_has_all_its_charts(tab: Browser, page: Path, tmp_path: Path):
    """Also those of parts and components that were never shown, as wide as the paper."""
    tab.open(page)
    tab.evaluate("""addEventListener('beforeprint', () => { window.printed =
        [...document.querySelectorAll('.plot')].map(f => ({
            drawn: f.querySelectorAll('path.curve[d^=M]').length, width: f.getBoundingClientRect().width
        })); })""")
    tab.pdf(tmp_path / "page.pdf")
    printed = tab.evaluate("window.printed")
    assert len(printed) == tab.evaluate("document.querySelectorAll('.plot').length") > 3
    assert all(plot["drawn"] >= 1 for plot in printed)
    assert all(500 < plot["width"] < 720 for plot in printed)
    assert (
        tab.evaluate(
            "[...document.querySelectorAll('[role=tabpanel]')].filter(p => p.offsetParent).length"
        )
        == 1
    )


@pytest.mark.parametrize("width", [PHONE, 1280])
@pytest.mark.parametrize("library", [None, ""], ids=["interactive", "pictures"])
def test_no_number_of_an_axis_is_cut(tab: Browser, tmp_path: Path, width: int, library: str | None):
    if library is None and plot_library() is None:
        pytest.skip("mpld3 is not installed.")
    x = np.linspace(0.0, 1.2e5, 50)
    plot = Plot("", "time [s]", "y", (Curve("a", x, x),))
    told = PageContent("Page", "", "", (Card("", "Kind", "", False, (Section("", (plot,)),)),), ())
    tab.open(written(tmp_path, told, library), width=width)
    cut = tab.evaluate("""[...document.querySelectorAll('.plot svg')].flatMap(svg => {
        const box = svg.getBoundingClientRect();
        return [...svg.querySelectorAll('text')].map(t => t.getBoundingClientRect())
            .filter(t => t.right > box.right + 0.5 || t.left < box.left - 0.5)
            .map(t => [t.left - box.left, t.right - box.left, box.width]);
    })""")
    assert cut == []


def test_a_long_title_is_broken(tab: Browser, tmp_path: Path):
    tab.open(
        written(tmp_path, content("Modelica.Blocks.Examples.PID_Controller" * 2)),
        width=PHONE,
        height=800,
    )
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE
    assert tab.evaluate("document.getElementById('theme').getBoundingClientRect().right") <= PHONE


@pytest.mark.parametrize("part", [0, 1, 2])
def test_a_phone_shows_all_of_it(tab: Browser, page: Path, part: int):
    tab.open(page, width=PHONE, height=800, part="#spring")
    tab.click(f"#tab{part}")
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE
    assert tab.evaluate(
        "[...document.querySelectorAll('.plot svg')].every(s => s.getBoundingClientRect().right <= innerWidth)"
    )
    size = "parseFloat(getComputedStyle(document.querySelector('main')).fontSize)"
    assert tab.evaluate(size) >= 15
    tab.resize(1200, 800)
    tab.settle()
    assert tab.messages == []


def test_colours_follow_the_system_and_the_button(tab: Browser, page: Path):
    ground = "getComputedStyle(document.body).backgroundColor"
    tab.dark(False)
    tab.open(page)
    assert tab.evaluate(ground) == "rgb(255, 255, 255)"
    tab.dark(True)
    dark = tab.evaluate(ground)
    assert dark != "rgb(255, 255, 255)"
    tab.click("#theme")
    assert tab.evaluate(ground) == "rgb(255, 255, 255)"
    tab.click("#theme")
    assert tab.evaluate(ground) == dark
    tab.dark(False)


def test_evil_names_do_nothing(tab: Browser, tmp_path: Path):
    tab.open(written(tmp_path, content(EVIL)))
    assert tab.messages == []
    assert tab.evaluate("document.querySelectorAll('img').length") == 0
    assert tab.evaluate("document.querySelector('h1').textContent") == EVIL
    tab.click("li:nth-child(2) button")
    assert shown_card(tab) == [EVIL]


def test_without_a_library_clicks_still_work(tab: Browser, tmp_path: Path):
    tab.open(written(tmp_path, content(), ""), width=PHONE, height=800)
    tab.click("svg [data-component=spring] rect")
    assert shown_card(tab) == ["spring"]
    tab.click("#tab1")
    assert tab.evaluate("document.querySelectorAll('#part1 .plot svg path.curve').length") == 4
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE
    assert tab.messages == []


def set_value(element: str, value: str, event: str) -> str:
    """A script that gives a control a value, as a user would."""
    return f"(() => {{ const s = {element}; s.value = {value}; s.dispatchEvent(new Event('{event}')); }})()"


def test_a_mechanism_moves_and_fits_a_phone(tab: Browser, tmp_path: Path):
    t = np.linspace(0.0, 4.0, 201)
    zero, one = np.zeros(1), np.ones(1)
    rod = Moving("rod", "M0 0H1", zero, zero, np.sin(t), one, None, (0.0, -1.0, 1.0, 1.0))
    x, y = np.cos(np.sin(t)), np.sin(np.sin(t))
    bob = Moving("bob", "M-1 0H1", x, y, zero, one, one, filled=True, traced=True)
    moving = Animation("It swings.", t, (bob, rod), "bob")
    told = PageContent("Swing", "", "", (), (Tab("", (Section("", (moving,)),)),))
    tab.open(written(tmp_path, told, ""), width=PHONE)
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE
    tab.evaluate(set_value("document.querySelector('.motion input')", "1.01", "input"))
    pose = "document.querySelectorAll('.moving')[{}].getAttribute('transform')"
    turned = float(tab.evaluate(pose.format(1)).split("rotate(")[1].split(")")[0])
    assert turned == pytest.approx(np.degrees(np.sin(1.01)), abs=0.02)
    way = "document.querySelector('.way').getAttribute('d').split('L').length"
    assert tab.evaluate(way) == 52
    tab.evaluate(set_value("document.querySelectorAll('.motion select')[1]", "''", "change"))
    assert tab.evaluate("document.querySelector('.way').getAttribute('d')") == ""
    tab.click(".motion .play")
    assert tab.evaluate("document.querySelector('.play').getAttribute('aria-label')") == "Pause"
    started = float(tab.evaluate("document.querySelector('.motion input').value"))
    tab.evaluate("new Promise(done => setTimeout(done, 200))")
    assert float(tab.evaluate("document.querySelector('.motion input').value")) > started
    assert tab.messages == []
