"""``python -m examples.four_bar``: learn the friction of a linkage's joint from the motor's torque."""

import json
from pathlib import Path

from examples.four_bar.study import run

if __name__ == "__main__":
    print(json.dumps(run(Path("out/four_bar"))))
