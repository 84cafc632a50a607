"""``python -m examples.emps.laps --data DIR``: what to train with, chosen by laps of the training record left out.

The reference repeats four times. Each lap in turn is predicted in open loop by a training on the others, as records of
their own. So options are chosen without the test record. What a run's own friction and offset are worth shows at last,
when they are found from the first lap of the test run: that is more than the benchmark gives, and no result of it.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac
from examples.emps import model, study
from examples.emps.model import INPUT, KINDS, OURS, OUTPUT, Kind
from examples.measured.judge import spread
from examples.measured.load import load
from examples.measured.present import Row, show

LAPS = {
    "lap 1": (0, 6240),
    "lap 2": (6240, 12480),
    "lap 3": (12480, 18720),
    "lap 4": (18720, 24841),
}
"""Samples of the laps."""
OWN = {"dry.Fc": 1.0, "offset.f_constant": 0.2}
"""What may be another one in each record, and by how much [N, N]."""
PLAIN, ALONE = "passive network", "passive network, with a tolerance of the offset alone"
BY_LAP, LATE = {"per_record": OWN}, {"delays": {INPUT: ac.Delay(0.0, min=-5e-3, max=5e-3)}}
TRIED: dict[str, tuple[str, Mapping[str, Any]]] = {
    PLAIN: (PLAIN, {}),
    ALONE: (ALONE, {}),
    OURS: (OURS, {}),
    f"{PLAIN}, friction and offset of each lap": (PLAIN, BY_LAP),
    f"{PLAIN}, noise by maximum likelihood": (PLAIN, {"loss": "likelihood"}),
    f"{PLAIN}, a voltage that is late": (PLAIN, LATE),
    f"{OURS}, friction and offset of each lap": (OURS, BY_LAP),
    f"{OURS}, noise by maximum likelihood": (OURS, {"loss": "likelihood"}),
    f"{OURS}, a voltage that is late": (OURS, LATE),
}
"""Kinds of models, and options of their trainings."""
CHOSEN = f"{OURS}, noise by maximum likelihood"
"""What predicts laps best that were left out; it was chosen before it was tested."""


def left_out(
    kind: Kind, measured: study.Measured, options: Mapping[str, Any], seed: int = 0
) -> dict[str, float]:
    """Errors in mm over each lap, of a training on the others."""
    records = {name: study.record(measured, span) for name, span in LAPS.items()}
    system, errors = kind.build(model.Axis), dict[str, float]()
    for name, span in LAPS.items():
        others = {n: r for n, r in records.items() if n != name}
        fit = study.train(kind, others, seed, **options)
        errors[name] = study.open_loop(system, fit.params, measured, span)[1]
    return errors


def tested(training: study.Measured, test: study.Measured, seed: int) -> dict[str, float]:
    """Errors of the test record with what the laps have chosen, trained on all of them."""
    kind, options = TRIED[CHOSEN]
    records = {name: study.record(training, span) for name, span in LAPS.items()}
    return study.judge(KINDS[kind], study.train(KINDS[kind], records, seed, **options).params, test)


def adapted(kind: Kind, params: Mapping[str, Any], measured: study.Measured) -> dict[str, float]:
    """Friction and offset of a run from its first lap, and errors in mm over the others with and without them."""
    system = kind.build(model.Axis)
    first, *_, last = LAPS.values()
    own = ac.fit(
        system,
        {"run": study.record(measured, first)},
        [OUTPUT, "carriage.a"],
        params=params,
        train=[],
        per_record=OWN,
        strategy="gauss_newton",
        progress=False,
    )
    values = own.records["run"].parameters
    rest = first[1], last[1]
    before = study.open_loop(system, params, measured, rest)[1]
    after = study.open_loop(system, {**params, **values}, measured, rest)[1]
    return {**values, "common_mm": before, "own_mm": after}


def main() -> None:
    """Try all options; print a table, and a line of JSON."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--data", type=Path, help="folder with the data set's files")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--only", nargs="+", type=int, help="numbers of rows, from 0")
    parser.add_argument("--test", action="store_true", help="what was chosen, instead")
    parser.add_argument("--adapt", action="store_true", help="to the test run's first lap instead")
    given = parser.parse_args()
    training, test = load(given.data, "EMPS", ["DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"])
    if given.test:
        errors = [tested(training, test, seed) for seed in range(given.seeds)]
        mean, around = spread(errors)
        print(json.dumps({"mean": mean, "spread": around, "seeds": errors}))
        return
    if given.adapt:
        fits = [study.train(KINDS[OURS], study.record(training), s) for s in range(given.seeds)]
        print(json.dumps([adapted(KINDS[OURS], fit.params, test) for fit in fits]))
        return
    rows: list[Row] = []
    for number, (name, (kind, options)) in enumerate(TRIED.items()):
        if given.only is not None and number not in given.only:
            continue
        begun = time.time()
        found = [left_out(KINDS[kind], training, options, s) for s in range(given.seeds)]
        whole = [float(np.sqrt(np.mean(np.square(list(f.values()))))) for f in found]
        errors = {"mean": float(np.mean(whole)), **found[0]}
        rows.append(Row(name, errors, {"mean": float(np.std(whole))} if len(whole) > 1 else None))
        print(
            json.dumps({"row": name, "rms": whole, "laps": found, "seconds": time.time() - begun}),
            flush=True,
        )
    show("EMPS: laps left out, open loop [mm]", {n: n for n in ("mean", *LAPS)}, rows)


if __name__ == "__main__":
    main()
