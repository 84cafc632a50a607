"""Records on the page of a training: as measured and simulated, errors over time, and all variables of the first."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

import acausal.simulation as simulation
from acausal.codegen import Values
from acausal.pages import labelled
from acausal.reporting import Block, Curve, Plot, Role, Text, broken_at_gaps, kept_rows, table
from acausal.simulation import Solution
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.record_fit import RecordFit
from acausal.training.trained_model import TrainedModel

RECORDS_SHOWN, POINTS, ALL_POINTS = 8, 10_000, 40_000
"""Records that are drawn, points in a plot, and points in all plots."""

FAR = 20
"""What is farther from a plot than so many times its height is no number of it."""


def runs_of(fit: TrainedModel) -> dict[str, Solution]:
    """The first record, simulated before and after training; what diverges is left out."""
    problem = fit.problem
    states = {"before training": problem.start(), "after training": fit.trained}
    found = {label: _run(problem, trainable) for label, trainable in states.items()}
    return {label: run for label, run in found.items() if np.isfinite(np.asarray(run.x)).all()}


def _run(problem: Problem, trainable: Trainable) -> Solution:
    """The first record as a solution, of which any variable can be read."""
    system, records = problem.system, problem.records
    params = problem.model_params(trainable)
    own = problem.per_record.values(problem.assemble(trainable), trainable.per_record)
    params = {**params, **{n: values[0] for n, values in own.items()}}
    rows = records.rows_of(0)
    packed = problem.pack(problem.assemble(trainable), trainable)
    steps = problem.steps(packed, jnp.asarray(rows))
    t, x = np.asarray(records.steps.t)[rows], problem.simulate(trainable).x[rows]
    u = np.asarray(steps.inputs.start)
    if system.events is None:
        return Solution(Values(jnp.asarray(t), x, jnp.asarray(u), system.pack(params)), system)
    start = dict(zip(system.states, np.asarray(x[0]).tolist(), strict=True))
    inputs = {n: (t, u[:, i]) for i, n in enumerate(system.inputs)}
    ends = float(t[0]), float(t[-1])
    return simulation.simulate(system, ends, saveat=t, inputs=inputs, params=params, x0=start)


def record_blocks(
    fit: TrainedModel,
    records: Mapping[str, RecordFit],
    before: Mapping[str, RecordFit],
    of: str = "",
    remarks: Mapping[str, str] | None = None,
) -> Iterable[Block]:
    """A table of errors, and every target over time with the error below it.

    Arguments:
        fit: the training.
        records: by name, after training. before: before it; may be empty.
        of: what the captions begin with.
        remarks: sentences above the plots of a record, by name.
    """
    if not records:
        return
    units = {n: fit.system.unit(n) for n in fit.problem.targets}
    header = ["record", "samples", *(f"RMS error of {n} [{unit}]" for n, unit in units.items())]
    header += [f"{n} before" for n in units if before]
    yield table(header, [_errors(r, before.get(n), list(units)) for n, r in records.items()])
    shown = list(records.items())[:RECORDS_SHOWN]
    if len(shown) < len(records):
        yield Text(f"The first {len(shown)} are drawn.")
    most = max(300, min(POINTS, ALL_POINTS // (len(shown) * len(units))))
    for name, record in shown:
        where = "" if len(records) == 1 else f" of '{name}'"
        if sentence := (remarks or {}).get(name):
            yield Text(sentence)
        for i, (target, unit) in enumerate(units.items()):
            caption = f"{of}'{target}'{where}"
            yield from _record(record, before.get(name), i, target, unit, caption, most)


def _errors(record: RecordFit, before: RecordFit | None, targets: Sequence[str]) -> list[str]:
    """A record's errors as a row of a table."""
    runs = [record] if before is None else [record, before]
    return [record.name, str(len(record.time)), *(f"{r.rms[n]:.4g}" for r in runs for n in targets)]


def _record(
    record: RecordFit,
    before: RecordFit | None,
    i: int,
    target: str,
    unit: str,
    caption: str,
    most: int,
) -> Iterable[Block]:
    """One target of a record: as measured and simulated above, the error below."""
    measured = record.measured[:, i]
    if np.isnan(measured).all():
        yield Text(f"{caption} is not measured.")
        return
    runs: dict[Role, RecordFit] = {} if before is None else {"before": before}
    runs["after"] = record
    window = _window(measured, [run.predicted[:, i] for run in runs.values()])
    room = window[1] - window[0]
    beyond = list[str]()

    def drawable(role: Role, values: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """What can be drawn: a curve leaves the plot, and what is far off is neither drawn nor read."""
        if not np.isfinite(values).all():
            beyond.append(f"{role} training the model diverges")
        elif values.min() < window[0] or values.max() > window[1]:
            beyond.append(
                f"{role} training it reaches from {values.min():.4g} to {values.max():.4g}"
            )
        far = (values < window[0] - FAR * room) | (values > window[1] + FAR * room)
        return np.where(np.isfinite(values) & ~far, values, np.nan)

    predicted: dict[Role, Float[np.ndarray, " n"]] = {
        role: drawable(role, run.predicted[:, i]) for role, run in runs.items()
    }
    errors: dict[Role, Float[np.ndarray, " n"]] = {r: measured - y for r, y in predicted.items()}
    rows = kept_rows([measured, *predicted.values(), *errors.values()], most)
    known = np.flatnonzero(~np.isnan(measured))
    rows = np.union1d(rows, known[kept_rows([measured[known]], most)])
    t = record.time[rows]
    above = [Curve("measured", *broken_at_gaps(t, measured[rows]), "measured")]
    above += [Curve(role, t, y[rows], role) for role, y in predicted.items()]
    below = [Curve(role, *broken_at_gaps(t, y[rows]), role) for role, y in errors.items()]
    drawn = (
        ""
        if len(rows) == len(record.time)
        else (
            f" {len(rows)} of {len(record.time)} samples are drawn, among them the extremes of every stretch."
        )
    )
    if beyond:
        drawn += (
            f" The plot shows what was measured, with room: {' and '.join(beyond)} {unit}.".replace(
                " .", "."
            )
        )
    group = f"record {caption}"
    yield Plot(
        "",
        "time [s]",
        labelled(target, unit),
        tuple(above),
        group=group,
        limits=window if beyond else None,
    )
    yield Plot(
        f"{caption[:1].upper()}{caption[1:]} as measured and simulated, and below it the error over time.{drawn}",
        "time [s]",
        f"error [{unit or '1'}]",
        tuple(below),
        group=group,
        limits=_window(errors["after"], list(errors.values())) if beyond else None,
        low=True,
    )


def _window(
    values: Float[np.ndarray, " n"], curves: Sequence[Float[np.ndarray, " n"]]
) -> tuple[float, float]:
    """What a plot of values shows: all of the curves beside them that are within 1.5 times their range."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 0.0)
    room = 1.5 * (high - low) or 0.05 * abs(high) or 1e-12
    others = np.concatenate([[low, high], *curves])
    others = others[np.isfinite(others)]
    least, most = max(low - room, float(others.min())), min(high + room, float(others.max()))
    return least - 0.04 * room, most + 0.04 * room
