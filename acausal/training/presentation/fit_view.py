"""The view of a training in a notebook and as text, and the rows of tables that pages share with it."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from acausal.reporting import Curve, View, small_plot
from acausal.training.auto.verdict import Verdict
from acausal.training.history import History
from acausal.training.objective.start_sizes import found_starts
from acausal.training.objective.timing import delay_of, lag_of
from acausal.training.record_fit import RecordFit
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Confidence

MOST_TARGETS = 4
"""Targets that are plotted."""


def loss_rows(fit: TrainedModel) -> list[tuple[str, float, float]]:
    """By kind of loss: what it is, before and after."""
    rows = [(f"loss over {fit.evaluated or 'the record'}", fit.loss_before, fit.loss)]
    if fit.validation_loss is not None:
        before = float(fit.history.validation_loss[0, 1])
        rows.append(("loss over what is held out", before, fit.validation_loss))
    return rows


def loss_curves(history: History) -> list[Curve]:
    """The losses over the updates: of the batches, over the whole record, and over what is held out."""
    epochs = np.arange(history.epochs, dtype=float)
    curves = [
        Curve("batches", epochs, history.loss, "measured"),
        Curve("whole record", *history.full_loss.T.astype(float), role="after", dots=True),
        Curve("held out", *history.validation_loss.T.astype(float), role="before", dots=True),
    ]
    return [curve for curve in curves if len(curve.x)]


def parameter_rows(
    fit: TrainedModel, sure: Confidence | None = None
) -> list[tuple[str, str, str, str]]:
    """By trained parameter: its name, value, change and the change's standard deviation, if that is known."""
    written, params = fit.problem.modifiers.written, fit.problem.assemble(fit.trained)
    rows: list[tuple[str, str, str, str]] = []
    for name, change in fit.modifiers.items():
        unit = fit.problem.unit(name)
        value = f"{float(params[name]):.6g} {unit}".removesuffix(" 1")
        deviation = "" if sure is None else written(name, sure.parameters[name], ".2g", unit)
        rows.append((name, value, written(name, change, "+.3g", unit), deviation))
    return rows


def fit_view(fit: TrainedModel) -> str:
    """HTML of a training."""
    end = ", ended by the user" if fit.interrupted else ""
    view = View(
        f"Fit of {', '.join((*fit.seen, *fit.modifiers))}",
        f"{fit.samples_trained} samples, {fit.history.epochs} updates in {fit.seconds:.3g} s{end}; "
        f"best after update {fit.best_epoch}",
    )
    view.table(("", "before", "after"), loss_rows(fit))
    units = {n: fit.system.unit(n) for n in fit.problem.targets}
    view.table(("target", "RMS error", "unit"), [(n, e, units[n]) for n, e in fit.rms.items()])
    if parameters := [row[:3] for row in parameter_rows(fit)]:
        view.table(("parameter", "value", "change"), parameters)
    record = next(iter(fit.records.values()))
    for i, (target, unit) in enumerate(list(units.items())[:MOST_TARGETS]):
        view.folded(f"{target}, measured and simulated", _followed(record, i, unit), opened=i == 0)
    losses = small_plot(loss_curves(fit.history), across="update", upwards="loss", logarithmic=True)
    view.folded("Losses, update by update", losses)
    if fit.history.divergences:
        view.text(f"{len(fit.history.divergences)} divergences; see fit.history.divergences")
    return str(view)


def fit_text(fit: TrainedModel, stages: str, verdict: Verdict | None) -> str:
    """A training in lines of text; ``stages`` is what they reached, in one."""
    each, epochs = fit.seconds_per_epoch, fit.history.epochs
    parts = fit.prepare_seconds, fit.compile_seconds, each * epochs
    rest = max(fit.seconds - sum(parts), 0.0)
    times = (
        f"{fit.prepare_seconds:.3g} s to prepare, {fit.compile_seconds:.3g} s to compile, "
        f"{each * epochs:.3g} s for {epochs} epochs of {each * 1e3:.3g} ms, {rest:.3g} s for the rest"
    )
    lines = [
        f"Fit of {', '.join((*fit.seen, *fit.modifiers))}{' (interrupted)' * fit.interrupted}",
        f"  loss      {fit.loss_before:.4g} before, {fit.loss:.4g} after epoch {fit.best_epoch}",
        f"  time      {fit.seconds:.3g} s: {times}",
    ]
    if fit.validation_loss is not None:
        lines.insert(2, f"  held out  {fit.validation_loss:.4g}")
    late = [f"{delay_of(n)} {value:.4g} s" for n, value in fit.delays.items()]
    late += [f"{lag_of(n)} {value:.4g} s" for n, value in fit.lags.items()]
    moved = {n: value for n, value in fit.modifiers.items() if n not in fit.problem.timing.values}
    found, diverged = found_starts(fit.problem), len(fit.history.divergences)
    further = {
        "evaluated": f"over {fit.evaluated}" if fit.evaluated else "",
        "modifiers": ", ".join(f"{n} {value:+.3f}" for n, value in moved.items()),
        "starts": "" if fit.starts is None else fit.starts.summary(),
        "times": ", ".join(late),
        "x0": f"found: {found}" if found else "",
        "stages": stages if fit.stages else "",
        "verdict": "" if verdict is None else str(verdict),
        "diverged": f"in {diverged} epochs, see history.divergences" if diverged else "",
    }
    return "\n".join([*lines, *(f"  {title:<9} {text}" for title, text in further.items() if text)])


def _followed(record: RecordFit, target: int, unit: str) -> str:
    measured: Float[np.ndarray, " n"] = record.measured[:, target]
    exist = ~np.isnan(measured)
    curves = [
        Curve("measured", record.time[exist], measured[exist]),
        Curve("simulated", record.time, record.predicted[:, target]),
    ]
    return small_plot(curves, across="time in s", upwards=unit or "1")
