"""Cross-validation: train without a part of the samples, judge on it, and so for each part in turn."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

import numpy as np

from acausal.data import RecordsLike, records_of
from acausal.errors import TrainingError, need_compiled, need_text
from acausal.files import need_path
from acausal.pages import write_page
from acausal.reporting import PageContent, aligned, table
from acausal.training.ensemble import Ensemble
from acausal.training.member import Trained
from acausal.training.objective.folds import Folds, LeftOut, judged_on, left_out
from acausal.training.options import FitKeywords, FitOptions, documented
from acausal.training.preparation import Training, prepare
from acausal.training.presentation.page_of_several import several_content
from acausal.training.presentation.page_records import record_blocks
from acausal.training.record_fit import RecordFit, rms_of
from acausal.training.result import Fit
from acausal.training.train import train_on_workers
from acausal.training.train_from_starts import run
from acausal.training.trained_model import out_of_range

if TYPE_CHECKING:
    from acausal.system import System


class Spread(NamedTuple):
    """A figure over the folds.

    Attributes:
        mean: of the folds that have it.
        deviation: their standard deviation; NaN for a single one.
    """

    mean: float
    deviation: float


@dataclass(frozen=True, eq=False)
class Fold:
    """A training without a part of the samples, judged on this part.

    Attributes:
        name: of the part: a record, or a block of time.
        fit: the training; ``fit.held_out`` has what it predicts of the part, where only that counts as measured.
        held_out_loss: over the part; infinite if the model diverges.
    """

    name: str
    fit: Fit
    held_out_loss: float

    @property
    def training_loss(self) -> float:
        """The loss over the samples that it was trained on."""
        return self.fit.loss

    @property
    def rms(self) -> dict[str, float]:
        """By target, the root mean square error over the part, in the target's unit; NaN where it is not measured."""
        return rms_of(self.fit.held_out.values())

    @cached_property
    def parameters(self) -> dict[str, float]:
        """The values of the trained parameters, delays and lags."""
        found = self.fit.problem.assemble(self.fit.trained)
        return {n: float(found[n]) for n in self.fit.modifiers}

    def __repr__(self) -> str:
        return f"Fold(without '{self.name}', loss {self.training_loss:.4g}, held out {self.held_out_loss:.4g})"


@dataclass(frozen=True, eq=False)
class CrossValidation:
    """The result of `cross_validate`: how well the model predicts what it was not trained on.

    Attributes:
        folds: one for each part that was left out.
    """

    folds: tuple[Fold, ...]

    @property
    def fits(self) -> tuple[Fit, ...]:
        """The trainings."""
        return tuple(fold.fit for fold in self.folds)

    @property
    def training_loss(self) -> Spread:
        """Of the samples that folds were trained on."""
        return _spread(fold.training_loss for fold in self.folds)

    @property
    def held_out_loss(self) -> Spread:
        """Of the samples that they were judged on."""
        return _spread(fold.held_out_loss for fold in self.folds)

    @property
    def rms(self) -> dict[str, Spread]:
        """By target, the root mean square error over what was left out, in the target's unit."""
        return {n: _spread(fold.rms[n] for fold in self.folds) for n in self.targets}

    @property
    def training_rms(self) -> dict[str, Spread]:
        """The same over what folds were trained on."""
        return {n: _spread(fold.fit.rms[n] for fold in self.folds) for n in self.targets}

    @property
    def targets(self) -> tuple[str, ...]:
        """The variables that are compared."""
        return self.fits[0].problem.targets

    @property
    def parameters(self) -> dict[str, Spread]:
        """By trained parameter, its value."""
        every = [fold.parameters for fold in self.folds]
        return {n: _spread(values[n] for values in every) for n in every[0]}

    @cached_property
    def records(self) -> dict[str, RecordFit]:
        """Every record, each sample as predicted by the fold that was trained without it."""
        found: dict[str, RecordFit] = {}
        for fold in self.folds:
            for name, record in fold.fit.held_out.items():
                found[name] = _joined(found[name], record) if name in found else record
        return found

    def summary(self) -> str:
        """One sentence: the errors of what was left out, beside those of what was trained on."""
        units = self._units
        errors = [
            f"{_written(spread)} {units[n]}".removesuffix(" 1").rstrip()
            + f" RMS of {n} ({self.training_rms[n].mean:.3g} where trained)"
            for n, spread in self.rms.items()
        ]
        worst = max(self.folds, key=lambda fold: fold.held_out_loss)
        return (
            f"What {len(self.folds)} folds left out is predicted to {', '.join(errors)}; "
            f"worst without '{worst.name}'."
        )

    @property
    def _units(self) -> dict[str, str]:
        system = self.fits[0].system
        return {name: system.unit(name) for name in self.targets}

    def report(self, folder: str | Path, title: str = "Cross-validation") -> Path:
        """Write a self-contained page, ``index.html`` in a folder; returns its path."""
        return write_page(self.page_content(title), need_path(folder, "report"))

    def page_content(self, title: str = "") -> PageContent:
        """All that the page shows."""
        first, names = self.fits[0], list(self.parameters)
        rows = [(fold.name, *(f"{fold.parameters[n]:.6g}" for n in names)) for fold in self.folds]
        rows.append(("mean ± deviation", *(_written(s) for s in self.parameters.values())))
        header = ("without", *(f"{n} [{first.problem.unit(n)}]" for n in names))
        remarks = {
            record.name: sentence
            for fold in self.folds
            for record in fold.fit.held_out.values()
            if (sentence := out_of_range(record, fold.fit))
        }
        return several_content(
            first,
            need_text(title, "title") or "Cross-validation",
            self.summary(),
            table(self._header, self._rows()),
            {"What was left out": [*record_blocks(first, self.records, {}, remarks=remarks)]},
            Ensemble(self.fits).laws,
            {f"without {fold.name}": fold.fit.history for fold in self.folds},
            table(header, rows) if names else None,
        )

    @property
    def _header(self) -> tuple[str, ...]:
        errors = (
            f"RMS error of {n} [{unit}]".removesuffix(" []") for n, unit in self._units.items()
        )
        return ("without", "training loss", "held-out loss", *errors)

    def _rows(self) -> list[tuple[str, ...]]:
        rows = [
            (
                fold.name,
                f"{fold.training_loss:.4g}",
                f"{fold.held_out_loss:.4g}",
                *(f"{fold.rms[n]:.4g}" for n in self.targets),
            )
            for fold in self.folds
        ]
        spreads = (self.training_loss, self.held_out_loss, *self.rms.values())
        return [*rows, ("mean ± deviation", *map(_written, spreads))]

    def __repr__(self) -> str:
        return f"{self.summary()}\n{aligned([self._header, *self._rows()], right=True)}"


def _spread(values: Iterable[float]) -> Spread:
    known = [value for value in values if not np.isnan(value)]
    if not known:
        return Spread(float("nan"), float("nan"))
    if not np.isfinite(known).all():
        return Spread(float("inf"), float("nan"))
    deviation = float(np.std(known, ddof=1)) if len(known) > 1 else float("nan")
    return Spread(float(np.mean(known)), deviation)


def _written(spread: Spread) -> str:
    return f"{spread.mean:.4g} ± {spread.deviation:.2g}"


def _joined(one: RecordFit, other: RecordFit) -> RecordFit:
    """A record of which one fold left out a part, and another fold another one."""
    theirs = ~np.isnan(other.measured)
    return replace(
        one,
        measured=np.where(theirs, other.measured, one.measured),
        predicted=np.where(theirs, other.predicted, one.predicted),
    )


REFUSED = {
    "validation": "it holds out each part in turn itself",
    "checkpoint": "a fold is trained at once",
    "devices": "folds are trained on one device",
}
"""Options that a cross-validation does not have."""


@documented
def cross_validate(
    system: System,
    data: RecordsLike,
    targets: str | Sequence[str],
    *,
    folds: Folds = "records",
    params: Mapping[str, Any] | None = None,
    seed: int = 0,
    **options: Unpack[FitKeywords],
) -> CrossValidation:
    """Train without a part of the samples and judge the model on it, for each part in turn.

    All folds share one compiled program. What is left out decides nothing: the best state of a fold is the one with the
    lowest loss over what it is trained on. A record that is left out is predicted from the state at its start, with the
    parameters that are expected of other records where they differ (``per_record``).

    Arguments:
        system, data, targets: as of `acausal.fit`.
        folds: ``"records"`` leaves out each record in turn; a number leaves out each of so many blocks of time of every
            record. The model is simulated through a block, but compared only outside of it.
        params, seed: as of `acausal.fit`, the same for all folds.
        options: see `acausal.training.FitOptions`, each by its name. Not ``validation``, ``checkpoint`` and
            ``devices``.

    Returns:
        The folds with their losses and errors. After Ctrl-C those that are complete, if there are two.

    Raises:
        DataError, TrainingError: as `acausal.fit` does; for folds without samples to train on or to be judged on.
        TypeError: for a keyword that is not an option.
    """
    need_compiled(system, "cross_validate")
    fit_options = FitOptions.of("cross_validate", options)
    for name, reason in REFUSED.items():
        if getattr(fit_options, name) is not None:
            raise TrainingError(f"cross_validate has no {name}=: {reason}; leave it out.")
    training = prepare(
        system, records_of(data), targets, fit_options, seeds=(seed,), params=(params,)
    )
    parts = left_out(training.problem.records, folds)
    trained: Sequence[tuple[Trained, ...] | None] = [None] * len(parts)
    if fit_options.executor is not None:
        trained = train_on_workers(training, parts)
    found: list[Fold] = []
    for part, one in zip(parts, trained, strict=True):
        fold = _fold(training, part, one)
        if fold.fit.interrupted:
            break
        found.append(fold)
    if len(found) < 2:
        raise KeyboardInterrupt
    return CrossValidation(tuple(found))


def _fold(training: Training, part: LeftOut, trained: tuple[Trained, ...] | None) -> Fold:
    """One fold, as workers have trained it, or trained here."""
    judged = judged_on(training.problem, part, training.records, training.options.x0)
    (fit,) = run(training.without(part), judged, f"Without '{part.name}': ", trained)
    fit = replace(fit, records=_counting(fit.records), held_out=_counting(fit.held_out))
    loss = float(judged.held_out_loss(fit.trained))
    return Fold(part.name, fit, loss if np.isfinite(loss) else np.inf)


def _counting(records: Mapping[str, RecordFit]) -> dict[str, RecordFit]:
    """The records of which something counts as measured."""
    return {n: r for n, r in records.items() if np.isfinite(r.measured).any()}
