"""The page of the quarter vehicle: small, quick, quiet, and readable on a phone."""

from __future__ import annotations

from pathlib import Path

import pytest

import acausal as ac
from acausal.reporting.document.library import plot_library
from examples.qvm.experiments import DEMO, fit
from examples.qvm.record import ride
from tests.support.browser import browser, need_browser

LARGEST = 2_000_000
"""Bytes of the page."""

LONGEST = 1000
"""Milliseconds until the page can be used."""


@pytest.mark.slow
def test_the_page_of_the_quarter_vehicle(tmp_path: Path):
    need_browser()
    if plot_library() is None:
        pytest.skip("mpld3 is not installed: plots cannot be zoomed.")
    trained = fit(DEMO, ride(0.02), epochs=40, validation=0.2)
    file = ac.page(trained, tmp_path)
    assert file.stat().st_size <= LARGEST
    with browser() as tab:
        for width in (1200, 380):
            tab.open(file, width=width, height=800, part="#damper_nn")
            assert float(tab.evaluate("document.documentElement.dataset.ready")) <= LONGEST
            for number in range(tab.evaluate("document.querySelectorAll('[role=tab]').length")):
                tab.click(f"#tab{number}")
                assert tab.evaluate("document.documentElement.scrollWidth") <= width
            tab.click("#tab0")
            tab.click("svg [data-component=suspension]")
            assert tab.evaluate("location.hash") == "#suspension"
            assert tab.requests == [file.resolve().as_uri()]
            assert tab.messages == []
