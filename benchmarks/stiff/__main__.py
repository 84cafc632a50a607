"""``python -m benchmarks.stiff [--parts plates gradient ladder pack problems]``: stiff models beside other solvers.

Ratios are medians over rounds in which all programs take turns. Prints a line for each measurement and one JSON line.
"""

from __future__ import annotations

import argparse
import json
from typing import Any

from benchmarks.stiff.pack import pack
from benchmarks.stiff.plates import gradients, plates
from benchmarks.stiff.sections import ladder
from benchmarks.stiff.work_precision import problems

PARTS = {
    "plates": plates,
    "gradient": gradients,
    "ladder": ladder,
    "pack": pack,
    "problems": problems,
}


def main() -> None:
    """Measure the chosen parts."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--parts", nargs="+", default=list(PARTS), choices=list(PARTS))
    found: dict[str, Any] = {}
    for part in parser.parse_args().parts:
        found |= PARTS[part]()
    print(json.dumps(found))


if __name__ == "__main__":
    main()
