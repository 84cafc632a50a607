"""``python -m examples.cascaded_tanks.tried --data DIR``: other losses, delays and lags, judged by held-out thirds.

No row uses the test record.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from typing import Any

import acausal as ac
from examples.cascaded_tanks import study
from examples.cascaded_tanks.model import MODELS, OURS, OUTPUT
from examples.measured.judge import spread
from examples.measured.load import load
from examples.measured.present import Row, show

TRIED: dict[str, dict[str, Any]] = {
    OURS: {},
    "... by maximum likelihood": {"loss": "likelihood"},
    "... by Huber's loss": {"loss": "huber"},
    "... by Student's loss": {"loss": "student"},
    "... and a sensor that is late": {"delays": {OUTPUT: ac.Delay(2.0, min=-8.0, max=20.0)}},
    "... and a sensor that lags": {"lags": {OUTPUT: ac.Lag(4.0, max=60.0)}},
}
"""What else our model is trained with."""


def main() -> None:
    """Try all; print a table, and a line of JSON each."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--data", type=Path, help="folder with the data set's files")
    parser.add_argument("--seeds", type=int, default=5)
    given = parser.parse_args()
    (measured,) = load(given.data, "Cascaded_Tanks", ["dataBenchmark.mat"])
    rows: list[Row] = []
    for name, options in TRIED.items():
        begun = time.time()
        found = study.train(measured, MODELS[OURS], seeds=given.seeds, tested=False, **options)
        mean, around = spread([trained.errors for trained in found])
        rows.append(Row(name, mean, around))
        line = {
            "row": name,
            "validation": [trained.errors["validation"] for trained in found],
            "times": [{**fit.delays, **fit.lags} for trained in found for fit in trained.parts],
            "seconds": time.time() - begun,
        }
        print(json.dumps(line), flush=True)
    show("Cascaded Tanks: error over held-out thirds in V", {"validation": "validation"}, rows)


if __name__ == "__main__":
    main()
