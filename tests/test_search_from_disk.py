"""The search of the documentation works on pages that are opened from the file system: docs/iframe-worker.js."""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.paths import ROOT

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)

PAGE = """<!doctype html><meta charset="utf-8"><script src="iframe-worker.js"></script><body><p>waiting</p><script>
const worker = new Worker("worker.js");
worker.addEventListener("message", (event) => {
  document.querySelector("p").textContent = "found " + event.data;
});
worker.postMessage("backlash");
</script></body>"""

WORKER = 'self.addEventListener("message", (event) => self.postMessage(event.data.length + 1));'


def test_nothing_is_loaded_from_elsewhere() -> None:
    """The plugin adds a script from another site unless one of this name is there."""
    settings = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    assert "polyfills: [iframe-worker.js]" in settings
    assert "- offline" in settings
    assert (ROOT / "docs" / "iframe-worker.js").is_file()


@pytest.mark.skipif(BROWSER is None, reason="no chromium is installed")
def test_a_page_from_disk_talks_to_its_worker(tmp_path: Path) -> None:
    assert BROWSER is not None
    shutil.copy(ROOT / "docs" / "iframe-worker.js", tmp_path)
    (tmp_path / "worker.js").write_text(WORKER, encoding="utf-8")
    (tmp_path / "page.html").write_text(PAGE, encoding="utf-8")
    options = ("--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=3000")
    address = (tmp_path / "page.html").as_uri()
    done = subprocess.run(
        [BROWSER, *options, "--dump-dom", address],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert "found 9" in done.stdout
