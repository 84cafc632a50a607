"""``python -m examples.efmi_qvm``: train the eFMI project's quarter vehicle, write it as C, and measure the C."""

import argparse

from examples.efmi_qvm.study import run

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m examples.efmi_qvm", description=__doc__)
    parser.add_argument("--seed", type=int, default=0, help="of the networks' weights")
    run(parser.parse_args().seed)
