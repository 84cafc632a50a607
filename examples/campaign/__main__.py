"""``python -m examples.campaign``: five runs of a drive train train one model; each is left out in turn."""

import argparse
import json
from pathlib import Path

from examples.campaign.study import UPDATES, run


def main() -> None:
    """Parse the command line and run."""
    parser = argparse.ArgumentParser(prog="python -m examples.campaign", description=__doc__)
    parser.add_argument(
        "--out", type=Path, default=Path("out/campaign"), help="where the page goes"
    )
    parser.add_argument("--updates", type=int, default=UPDATES, help="of each training")
    parser.add_argument("--seed", type=int, default=0, help="of the networks and the batches")
    given = parser.parse_args()
    print(json.dumps(run(given.out, given.updates, given.seed)))


if __name__ == "__main__":
    main()
