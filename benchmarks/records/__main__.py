"""``python -m benchmarks.records [--parts speed]``: what several records cost, and what gaps take away.

The quarter vehicle over 42 s, noise of 2 %, in 1, 4, 16 and 64 records of unequal lengths with as many samples in all.
Prints a table and one JSON line.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Sequence
from typing import Any, Literal

import jax
import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.training.build_problem import build_problem
from acausal.training.objective.problem import Problem
from acausal.training.options import FitOptions
from benchmarks.measure import in_turns
from benchmarks.records.cut import pieces, thinned
from examples.qvm.judge import loss as loss_over
from examples.qvm.model import with_networks
from examples.qvm.record import OUTPUTS, STATES, Ride, ride

COUNTS = (1, 4, 16, 64)
NOISE = 0.02
EPOCHS = (500, 300)

Start = Literal["fit", "data"]


def main() -> None:
    """Measure the chosen parts."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--parts", nargs="+", default=list(PARTS), choices=list(PARTS))
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2, 3, 4])
    arguments = parser.parse_args()
    found: dict[str, Any] = {}
    for part in arguments.parts:
        found |= PARTS[part](arguments.seeds)
    print(json.dumps(found))


# -- speed -------------------------------------------------------------------------------------------


def speed(seeds: Sequence[int]) -> dict[str, Any]:
    """Seconds of an epoch over the sum of the single records', and of compiling over one record's."""
    del seeds
    system, measured = ac.compile(with_networks()), ride(NOISE).measured
    params = system.parameters(0)
    found: dict[str, Any] = {}
    compiling: dict[int, float] = {}
    for count in COUNTS:
        records = pieces(measured, count)
        together, compiling[count] = _update(_posed(system, records, params))
        by_length: dict[int, list[str]] = {}
        for name, record in records.items():
            by_length.setdefault(len(record), []).append(name)
        singles = [
            (_update(_posed(system, {names[0]: records[names[0]]}, params))[0], len(names))
            for names in by_length.values()
        ]
        seconds, *alone = in_turns(together, *(run for run, _ in singles))
        total = sum(s * n for s, (_, n) in zip(alone, singles, strict=True))
        found[f"epoch_over_singles_{count}"] = seconds / total
        found[f"compile_seconds_{count}"] = compiling[count]
        print(
            f"{count:3d} records: an epoch {1e3 * seconds:.1f} ms, {seconds / total:.3f} of the sum of single ones; "
            f"compiled in {compiling[count]:.2f} s",
            flush=True,
        )
    found["compile_64_over_1"] = compiling[64] / compiling[1]
    return found


def _posed(system: ac.System, records: dict[str, ac.Data], params: dict[str, Any]) -> Problem:
    return build_problem(system, records, OUTPUTS, params, FitOptions())


def _update(problem: Problem) -> tuple[Callable[[], Any], float]:
    """The gradient of an epoch, ready to run; and the seconds that it took to compile."""
    batch = problem.draw(jax.random.key(0))

    def loss(trainable: Any, problem: Problem) -> Any:
        return jnp.mean(problem.losses(trainable, batch))

    arguments = problem.start(), problem
    clock = time.process_time()
    compiled = jax.jit(jax.value_and_grad(loss)).lower(*arguments).compile()
    seconds = time.process_time() - clock
    return lambda: compiled(*arguments), seconds


# -- what is learned ---------------------------------------------------------------------------------


def learned(seeds: Sequence[int]) -> dict[str, Any]:
    """Losses over another ride, of trainings on one record and on 64 that hold the same samples.

    Where every record starts is trained, too. Records that start as measured, with the noise of one sample of each
    state, show what that is worth: each second of 64 records has such a start.
    """
    driven, other = ride(NOISE), ride(NOISE, road_seed=7, noise_seed=7)
    found: dict[str, Any] = {}
    kinds: tuple[tuple[str, int, Start], ...] = (
        ("1", 1, "fit"),
        ("64", 64, "fit"),
        ("64_as_measured", 64, "data"),
    )
    for name, count, x0 in kinds:
        records = pieces(driven.measured, count)
        losses = [_judged(records, x0, driven, other, seed) for seed in seeds]
        found[f"validation_{name}"] = losses
        print(f"{name} records: losses over another ride {_summary(losses)}", flush=True)
    low, high = min(found["validation_1"]), max(found["validation_1"])
    found["within_64"] = sum(low <= loss <= high for loss in found["validation_64"])
    return found


def gaps(seeds: Sequence[int]) -> dict[str, Any]:
    """Losses against the truth without noise: all samples; two rates, a fifth of the samples missing, and a gap."""
    driven = ride(NOISE)
    found: dict[str, Any] = {}
    for name, record in (
        ("full", driven.measured),
        ("thinned", thinned(driven.measured, OUTPUTS)),
        ("thinned_states", thinned(driven.measured, OUTPUTS, STATES)),
    ):
        losses = [_judged({"run": record}, "fit", driven, driven, seed) for seed in seeds]
        found[f"clean_loss_{name}"] = losses
        print(f"{name}: losses against the truth without noise {_summary(losses)}", flush=True)
    full = np.mean(found["clean_loss_full"])
    for name in ("thinned", "thinned_states"):
        found[f"{name}_over_full"] = float(np.mean(found[f"clean_loss_{name}"]) / full)
    return found


def _summary(losses: Sequence[float]) -> str:
    return f"{np.round(losses, 5)}, mean {np.mean(losses):.5f}"


def _judged(records: dict[str, ac.Data], x0: Start, driven: Ride, other: Ride, seed: int) -> float:
    """The loss of a training against the outputs of a ride without noise."""
    fit = ac.fit(
        ac.compile(with_networks()),
        records,
        OUTPUTS,
        seed=seed,
        x0=x0,
        strategy=("equation_error", "whole_record"),
        epochs=EPOCHS,
        evaluate_every=100,
        solver="rk4",
        progress=False,
    )
    return loss_over(fit.system, fit.params, other.clean, driven, solver="rk4")


PARTS = {"speed": speed, "learned": learned, "gaps": gaps}


if __name__ == "__main__":
    main()
