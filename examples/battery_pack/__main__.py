"""``python -m examples.battery_pack``: drive a pack of a thousand cells for an hour, and differentiate it."""

import argparse
from pathlib import Path

from rich.console import Console
from rich.table import Table

from examples.battery_pack.figures import picture
from examples.battery_pack.study import CELLS, ROWS, study


def main() -> None:
    """Parse the command line and run."""
    parser = argparse.ArgumentParser(prog="python -m examples.battery_pack", description=__doc__)
    parser.add_argument("--rows", type=int, default=ROWS, help="in series")
    parser.add_argument("--cells", type=int, default=CELLS, help="in parallel")
    parser.add_argument("--out", type=Path, default=Path("out/battery-pack.png"))
    given = parser.parse_args()
    found = study(rows=given.rows, cells=given.cells)
    table = Table(show_header=False, box=None)
    for row in found.table():
        table.add_row(*row)
    Console().print(table)
    given.out.parent.mkdir(parents=True, exist_ok=True)
    picture(found).savefig(given.out, dpi=130)
    print(given.out)


if __name__ == "__main__":
    main()
