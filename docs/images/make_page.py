"""Draw docs/images/page.png, the page of a trained quarter vehicle in a browser: python docs/images/make_page.py."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

import acausal as ac  # noqa: E402
from examples.qvm.experiments import DEMO, fit  # noqa: E402
from examples.qvm.record import ride  # noqa: E402
from tests.support.browser import browser  # noqa: E402


def main() -> None:
    """Train the quarter vehicle and take a picture of its page."""
    trained = fit(DEMO, ride(0.02))
    with TemporaryDirectory() as folder, browser() as tab:
        page = ac.page(trained, folder, "A quarter vehicle learns its suspension")
        tab.open(page, width=1100, height=1310, part="#damper_nn")
        tab.screenshot(Path(__file__).with_name("page.png"))


if __name__ == "__main__":
    main()
