"""Draw docs/images/notebook-system.png, a system as notebooks show it: python docs/images/make_notebook.py.

Needs a headless chromium.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.test_docs import blocks  # noqa: E402

SIZE = "780,560"


def main() -> None:
    """Run the first block of the page about notebooks, and take a picture of what it shows."""
    page: dict = {"__name__": "page"}
    exec(next(blocks(ROOT / "docs" / "notebook.md")), page)
    browser = next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome")))
    )
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "system.html"
        shown = page["system"]._repr_html_()
        file.write_text(f'<!doctype html><meta charset="utf-8"><body>{shown}</body>', "utf-8")
        picture = Path(__file__).with_name("notebook-system.png")
        options = ("--headless", "--no-sandbox", "--hide-scrollbars", f"--window-size={SIZE}")
        command = [browser, *options, f"--screenshot={picture}", file.as_uri()]
        subprocess.run(command, check=True, capture_output=True)


if __name__ == "__main__":
    main()
