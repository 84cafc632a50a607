"""``python -m examples.battery_cell``: train a cell on measured records, and predict others."""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import acausal as ac
from examples.battery_cell import engineer, figures, predict, study
from examples.battery_cell.model import build
from examples.battery_cell.records import campaign, read
from examples.measured.present import show

PARAMS, LINES = "cell.safetensors", "leave_one_out.jsonl"


def main() -> None:
    given = arguments()
    try:
        if given.predict is not None:
            if given.data is not None and not (given.out / PARAMS).is_file():
                trained(given)
            predicted(given)
        elif given.leave_one_out:
            path = given.out / LINES
            lines = study.leave_one_out(campaign(given.data), range(given.seeds), path)
            print(json.dumps(study.summary(lines)))
        else:
            trained(given)
    except ac.DataError as error:
        sys.exit(str(error))


def arguments() -> argparse.Namespace:
    about = "A battery cell from measured records."
    parser = argparse.ArgumentParser(prog="python -m examples.battery_cell", description=about)
    parser.add_argument("--data", type=Path, help="folder with the campaign's files: trains")
    parser.add_argument(
        "--leave-one-out",
        action="store_true",
        help="each record in turn; goes on where it was interrupted",
    )
    parser.add_argument("--seeds", type=int, default=5, help="of --leave-one-out")
    parser.add_argument("--seed", type=int, default=0, help="of one training")
    parser.add_argument("--predict", type=Path, help="a record to predict from its first voltage")
    parser.add_argument("--ambient", type=float, default=25.0, help="of the chamber, in degC")
    parser.add_argument("--out", type=Path, default=Path("out/battery_cell"), help="for results")
    given = parser.parse_args()
    if given.data is None and given.predict is None:
        parser.error("give --data FOLDER to train, or --predict record.csv")
    return given


def trained(given: argparse.Namespace) -> None:
    tables = campaign(given.data)
    begun = time.time()
    fit = study.train(tables, given.seed)
    seconds = time.time() - begun
    study.save(fit, given.out / PARAMS)
    engineer.show(fit.params)
    engineer.write(fit.params, given.out / "laws.csv")
    errors = study.judge(fit, tables)
    show("A battery cell: root mean square errors", figures.COLUMNS, figures.rows(errors))
    path = figures.page(given.out, fit, tables, errors)
    print(json.dumps({"seconds": seconds, "errors": errors, "page": str(path)}))


def predicted(given: argparse.Namespace) -> None:
    trained = given.out / PARAMS
    if not trained.is_file():
        raise ac.DataError(f"There is no {trained}: train first, with --data FOLDER.")
    system = build()
    params = ac.load_params(trained, system)
    table = read(given.predict, given.ambient)
    found = predict.predict(system, params, table)
    path = given.out / f"{given.predict.stem}_predicted.csv"
    predict.write(path, table, found)
    drawn = path.with_suffix(".png")
    figures.record(table, found).savefig(drawn, dpi=120)
    told = {"soc_start": found.start, "rms_mV": 1e3 * found.rms}
    print(json.dumps({**told, "written": [str(path), str(drawn)]}))


if __name__ == "__main__":
    main()
