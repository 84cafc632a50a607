"""``python -m examples.qvm``: the demo; with ``--paper`` all trainings of the paper."""

import time

STARTED = time.time()

import argparse  # noqa: E402


def main() -> None:
    """Parse the command line and run."""
    parser = argparse.ArgumentParser(prog="python -m examples.qvm", description=__doc__)
    parser.add_argument(
        "--paper", action="store_true", help="the paper's five trainings, 1000 epochs each"
    )
    parser.add_argument(
        "--seed", type=int, default=0, help="of the networks' weights and the batches"
    )
    arguments = parser.parse_args()
    if arguments.paper:
        from examples.qvm import paper

        paper.run(STARTED, arguments.seed)
    else:
        from examples.qvm import demo

        demo.run(STARTED, arguments.seed)


if __name__ == "__main__":
    main()
