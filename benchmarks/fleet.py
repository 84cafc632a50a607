"""A fleet: what an epoch takes in time and memory over the number of records, and a sweep on one core and on all.

With ``--stream 4`` it is instead what a training takes on 4 GB of records that stay in their files.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import resource
import sys
import tempfile
import time
from concurrent.futures import Executor, ProcessPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import psutil
from rich.console import Console
from rich.table import Table
from scipy.io import savemat

import acausal as ac
from examples.fleet.model import (
    INPUT,
    MASS,
    SAMPLE_TIME,
    SPEED,
    SPREAD,
    TYPICAL,
    fleet,
    learned,
    truth,
)

EPOCHS = 40
DT, SECONDS = 0.01, 30.0
"""Step and length of a variant [s]; its state is kept once a second."""
ROUNDS = 3
STREAMED, IN_MEMORY = 1000, 20
"""Records in files, and how many of them are made at a time."""


def main() -> None:
    """Measure, print the tables and the JSON line."""
    parser = argparse.ArgumentParser(description="Train on a fleet, and sweep over one.")
    parser.add_argument("--n", type=int, nargs="+", default=[125, 250, 500, 1000], help="records")
    parser.add_argument("--variants", type=int, default=10_000)
    parser.add_argument("--stream", type=float, metavar="GB", help="train on so much from files")
    asked = parser.parse_args()
    if asked.stream is not None:
        with tempfile.TemporaryDirectory() as folder:
            size = _alone(written, folder, asked.stream)
            found = _alone(streamed, folder)
        table = Table("", "", title=f"Training on {size / 1e9:.3g} GB of files")
        for name, value in found.items():
            table.add_row(name, f"{value:.4g}")
        Console().print(table)
        print(json.dumps({"bytes": size, **found}))
        return
    records = {n: _alone(trained, n) for n in sorted(asked.n)}
    table = Table("records", "ms an epoch", "epochs [MB]", "all [MB]", title="Training")
    for n, row in records.items():
        table.add_row(
            str(n), f"{1e3 * row['epoch_seconds']:.3g}",
            f"{row['epochs_mb']:.0f}", f"{row['peak_mb']:.0f}",
        )  # fmt: skip
    Console().print(table)
    cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else [0, 1]
    busy = os.getloadavg()[0]
    here, one, all_ = (swept(asked.variants, own) for own in ([], cores[:1], cores))
    columns = ("", "seconds", "of processor time: caller", "... workers")
    table = Table(*columns, title=f"{asked.variants} variants, load {busy:.1f} before")
    for name, row in (
        ("this process", here), ("a worker on one core", one), (f"{len(cores)} workers", all_),
    ):  # fmt: skip
        table.add_row(name, *(f"{value:.3g}" for value in row))
    Console().print(table)
    found = {
        "records": records,
        "growth": {k: growth(records, k) for k in ("epoch_seconds", "epochs_mb", "peak_mb")},
        "variants": asked.variants,
        "cores": len(cores),
        "load": busy,
        "here": here._asdict(),
        "one_core": one._asdict(),
        "all_cores": all_._asdict(),
        "speedup": one.seconds / all_.seconds,
        "speedup_of_free_cores": one.on_free_cores(1) / all_.on_free_cores(len(cores)),
    }
    print(json.dumps(found))


def growth(records: dict[int, dict[str, float]], name: str) -> float | None:
    """The power of the number of records with which a figure grows, between the smallest and the largest."""
    small, large = min(records), max(records)
    if small == large:
        return None
    ratio = records[large][name] / max(records[small][name], 1e-9)
    return math.log(ratio) / math.log(large / small)


def trained(n: int) -> dict[str, float]:
    """An epoch over n records, each vehicle with its own mass, and the memory of the process at its peak."""
    system, data = learned(), fleet(n)
    before = _peak()
    fit = ac.fit(
        system,
        data,
        SPEED,
        per_record={MASS: SPREAD},
        strategy="whole_record",
        epochs=EPOCHS,
        progress=False,
    )
    own = np.array([r.parameters[MASS] for r in fit.records.values()])
    return {
        "epoch_seconds": fit.seconds_per_epoch,
        "epochs_mb": _peak() - before,
        "peak_mb": _peak(),
        "loss": fit.loss,
        "masses_deviation": float(np.std(own)),
    }


def written(folder: str, gigabytes: float) -> int:
    """Write the records of a thousand vehicles, a file each; returns their bytes."""
    rows, count = round(gigabytes * 1e9 / STREAMED / 32), 0
    for block in range(0, STREAMED, IN_MEMORY):
        own = fleet(IN_MEMORY, seed=block, seconds=rows * SAMPLE_TIME)
        for k, record in enumerate(own.values(), block):
            v = record[SPEED]
            s = SAMPLE_TIME * np.append(0.0, np.cumsum((v[1:] + v[:-1]) / 2))
            columns = {"time": record.time, "force": record[INPUT], "v": v, "s": s}
            path = Path(folder) / f"vehicle {k}.mat"
            savemat(path, columns)
            count += path.stat().st_size
    return count


def streamed(folder: str) -> dict[str, float]:
    """A training on the records of a folder, each vehicle with its own mass: its time, and the memory at the peak."""
    names = {"force": INPUT, "v": SPEED, "s": "body.s"}
    system, stream = learned(), ac.Data.stream(f"{folder}/*.mat", rename=names)
    before, begun = _peak(), time.perf_counter()
    fit = ac.fit(
        system, stream, SPEED, per_record={MASS: SPREAD}, strategy="sequences", progress=False
    )
    return {
        "records": len(stream),
        "samples": fit.samples_trained,
        "seconds": time.perf_counter() - begun,
        "epochs": fit.history.epochs,
        "epoch_seconds": fit.seconds_per_epoch,
        "before_mb": before,
        "peak_mb": _peak(),
        "loss_before": fit.loss_before,
        "loss": fit.loss,
    }


class Swept(NamedTuple):
    """Medians of a sweep: seconds on the clock, and of processor time in the process that calls and in its workers."""

    seconds: float
    caller: float
    workers: float

    def on_free_cores(self, count: int) -> float:
        """Seconds on the clock if nothing else ran, from processor time: the workers share theirs evenly."""
        return self.caller + self.workers / count


def swept(variants: int, cores: list[int]) -> Swept:
    """A sweep over masses and drags, with a worker on each of some cores, or here without any."""
    system, side = truth(), round(math.sqrt(variants))
    over = {
        MASS: np.linspace(TYPICAL - 2 * SPREAD, TYPICAL + 2 * SPREAD, side),
        "resistance.air": np.linspace(0.3, 0.9, variants // side),
    }
    given: dict[str, Any] = {
        "dt": DT, "saveat": np.arange(SECONDS + 1), "inputs": {INPUT: 1000.0}, "solver": "rk4"
    }  # fmt: skip

    def once(executor: Executor | None) -> tuple[float, ...]:
        begun = _clocks()
        runs = ac.sweep(system, over, SECONDS, executor=executor, **given).runs
        np.asarray(runs.x)
        return tuple(b - a for a, b in zip(begun, _clocks(), strict=True))

    def median(executor: Executor | None) -> Swept:
        once(executor)  # compiles
        return Swept(*np.median([once(executor) for _ in range(ROUNDS)], axis=0).tolist())

    if not cores:
        return median(None)
    spawn = multiprocessing.get_context("spawn")
    free = spawn.SimpleQueue()
    for core in cores:
        free.put(core)
    with ProcessPoolExecutor(
        len(cores), mp_context=spawn, initializer=_pinned, initargs=(free,)
    ) as pool:
        return median(pool)


def _clocks() -> tuple[float, float, float]:
    """Now, and the processor time of this process and of those that it has started."""
    children = [child.cpu_times() for child in psutil.Process().children(recursive=True)]
    return time.perf_counter(), time.process_time(), sum(c.user + c.system for c in children)


def _pinned(free: Any) -> None:
    """Keep a worker on a core of its own, where the system can."""
    core = free.get()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {core})


def _alone(function: Any, *arguments: Any) -> Any:
    """A function's result in a process of its own, whose memory is then that of the function."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn) as pool:
        return pool.submit(function, *arguments).result()


def _peak() -> float:
    """The most memory that this process has had [MB]."""
    kilo = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return kilo / (1e6 if sys.platform == "darwin" else 1e3)


if __name__ == "__main__":
    main()
