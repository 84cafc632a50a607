"""Make the pictures that the code of the pages saves: python docs/images/make_from_pages.py [page.md ...]."""

import os
import shutil
import sys
import tempfile
from pathlib import Path
from types import ModuleType
from typing import Any

import matplotlib
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec

matplotlib.use("Agg")
save = Figure.savefig

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT))

from tests.test_docs import blocks  # noqa: E402

GALLERY = sorted(p.relative_to(HERE.parent).as_posix() for p in HERE.parent.glob("gallery/*.md"))
PAGES = (
    "getting-started.md",
    "next-hour.md",
    "quarter-vehicle.md",
    "neural.md",
    "drawings.md",
    "fleet.md",
    *GALLERY,
)


def save_both(figure: Figure, path: str, **options: Any) -> None:
    """Save a figure of the gallery twice: as it is, and with its panels below each other, for phones."""
    save(figure, path, **options)
    panels = [axes for axes in figure.axes if axes.get_subplotspec() is not None]
    if not path.startswith("gallery-") or len(panels) < 2:
        return
    rows = GridSpec(len(panels), 1, figure=figure)
    for axes, row in zip(panels, rows, strict=True):
        axes.set_subplotspec(row)
    figure.set_size_inches(4.6, 3.0 * len(panels))
    save(figure, path.replace(".png", "-narrow.png"), **options)


def main() -> None:
    """Run the pages in an empty folder and take the pictures that they leave there."""
    Figure.savefig = save_both
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name in sys.argv[1:] or PAGES:
            page = ModuleType(Path(name).stem)
            sys.modules[page.__name__] = page
            for block in blocks(HERE.parent / name):
                exec(compile(block, name, "exec"), vars(page))
        for picture in Path(folder).iterdir():
            if picture.suffix in (".png", ".svg"):
                shutil.copy(picture, HERE)
        os.chdir(HERE)


if __name__ == "__main__":
    main()
