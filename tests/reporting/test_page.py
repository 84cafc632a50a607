"""A page tells what its record holds: nothing is loaded, nothing in a name can break it."""

import base64
import json
import re
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

from acausal.reporting import (
    Card,
    Curve,
    EquationList,
    PageContent,
    Plot,
    Section,
    Tab,
    Text,
    broken_at_gaps,
    kept_rows,
    render,
    table,
    titled_sections,
)
from acausal.reporting.document import library
from acausal.reporting.document.numbers import Pool, as_json
from tests.support.pages import EVIL, content


def test_names_are_texts_wherever_they_stand():
    for carried in ("", "/* a library */"):
        text = render(content(EVIL), carried)
        assert "<img" not in text
        assert text.count("<script") == (3 if carried else 2)
        assert "&lt;img" in text or "\\u003cimg" in text


def test_nothing_is_loaded():
    text = render(content())
    assert "default-src 'none'" in text
    assert not re.search(r'(src|href)="(?!data:)', text)


def test_tags_are_closed():
    text = render(content(), "")
    parser = _Tags()
    parser.feed(text)
    assert parser.open == []


class _Tags(HTMLParser):
    """Notes which elements are open."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        if tag not in ("meta", "link"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: Any) -> None:
        pass

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_without_a_library_plots_are_pictures_and_the_page_says_so():
    text = render(content(), "")
    assert "plain pictures" in text
    assert "pip install &#x27;acausal[page]&#x27;" in text
    assert text.count('<path class="curve ') == sum(len(p.curves) for p in content().plots)
    assert "data-plot" not in text


def test_a_library_that_is_not_installed_is_none(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(library, "PACKAGE", "no-such-package")
    assert library.plot_library() is None
    assert "plain pictures" in render(content())


def test_a_picture_copes_with_gaps_steps_logarithms_and_constants():
    x = np.arange(5.0)
    curves = (
        Curve("gap", x, np.array([1.0, np.nan, 3.0, np.inf, 2.0])),
        Curve("steps", x, x + 1, steps=True),
        Curve("constant", x, np.full(5, 2.0), sigma=np.full(5, 0.1)),
    )
    for log in (False, True):
        text = render(page_of(Plot("", "x", "y", curves, log=log)), "")
        assert "nan" not in text
        assert "inf" not in re.sub(
            r"info|inform", "", text.partition("<svg")[2].partition("</svg>")[0]
        )
    render(page_of(Plot("", "x", "y", ())), "")
    render(page_of(Plot("", "x", "y", (Curve("none", x, np.full(5, np.nan)),))), "")


def page_of(plot: Plot) -> PageContent:
    return PageContent("A", "", "", (), (Tab("B", (Section("", (plot,)),)),))


def test_prose_has_code():
    text = render(
        PageContent("A", "", "", (Card("a", "B", "With ``f = c x``.", False, ()),), ()), ""
    )
    assert "With <code>f = c x</code>." in text


def test_sections_without_anything_are_left_out():
    found = titled_sections({"a": [Text("b")], "c": [], "d": [None]})
    assert [s.title for s in found] == ["a"]
    assert table(("a",), [(1,)]).rows == (("1",),)


# -- numbers -----------------------------------------------------------------------------------------------


def test_long_arrays_are_packed_to_a_fraction_of_their_range():
    pool = Pool()
    y = np.sin(np.linspace(0, 9, 5000))
    y[17] = np.nan
    assert pool.add(None) == -1
    assert (pool.add(y), pool.add(y.copy()), pool.add(y, fine=True)) == (0, 0, 1)
    coarse, fine = json.loads(pool.written().text)
    for found, kind, error in ((coarse, "<u2", 2e-5), (fine, "<u4", 1e-9)):
        levels = np.frombuffer(base64.b64decode(found["packed"]), kind)
        assert np.flatnonzero(levels == found["gap"]).tolist() == [17]
        known = levels != found["gap"]
        assert (
            np.abs(found["low"] + found["span"] * levels / (found["gap"] - 1) - y)[known].max()
            < error
        )


def test_short_arrays_are_plain():
    pool = Pool()
    pool.add(np.array([1.0, np.nan, np.inf, 1e-7]))
    pool.add(np.zeros(200))
    assert json.loads(pool.written().text)[0] == [1, None, None, 1e-7]


def test_json_holds_no_markup():
    assert "<" not in as_json({"a": "</script><b>", "n": float("nan")})
    assert json.loads(as_json(["</script>", 1.5, None, True]))[0] == "</script>"


# -- thinning ----------------------------------------------------------------------------------------------


def test_peaks_stay():
    y = np.sin(np.linspace(0, 60, 40_000))
    y[12_345], y[30_001] = 5.0, -7.0
    rows = kept_rows([y, np.zeros_like(y)], 1000)
    assert 500 <= len(rows) <= 1100
    assert {0, 12_345, 30_001, len(y) - 1} <= set(rows.tolist())
    assert (np.diff(rows) > 0).all()


def test_few_samples_all_stay():
    assert kept_rows([np.zeros(10)], 20).tolist() == list(range(10))
    assert len(kept_rows([], 20)) == 0
    assert len(kept_rows([np.full(1000, np.nan)], 100)) <= 1000


def test_a_curve_is_broken_where_samples_are_missing():
    t = np.arange(30.0)
    y = np.where((t > 10) & (t < 20), np.nan, t)
    x, values = broken_at_gaps(t, y)
    assert np.isnan(values).sum() == 1
    assert len(broken_at_gaps(t, np.full(30, np.nan))[0]) == 0
    assert len(x) == 22


# -- equations -----------------------------------------------------------------------------------------


def test_events_are_written_as_text():
    text = render(
        PageContent(
            "A", "", "", (), (Tab("B", (Section("C", (EquationList(("when x > 0",)),)),)),)
        ),
        "",
    )
    assert "<code>when x &gt; 0</code>" in text
