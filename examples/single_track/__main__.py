"""``python -m examples.single_track``: learn the tyres of a single-track vehicle from a campaign of manoeuvres."""

import json
from pathlib import Path

from examples.single_track.study import run

if __name__ == "__main__":
    print(json.dumps(run(Path("out/single_track"))))
