"""The result of a training, and further analyses of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from acausal.analysis import Distilled, distill, labels
from acausal.data import RecordsLike
from acausal.errors import TrainingError, nearest
from acausal.files import need_path
from acausal.networks import remove_offset
from acausal.pages import write_page
from acausal.reporting import PageContent, PlainTable
from acausal.training.auto.verdict import (
    StageResult,
    Verdict,
    step_error,
    verdict,
)
from acausal.training.export_with_card import export_with_card
from acausal.training.fit_page import fit_content
from acausal.training.fit_view import fit_view
from acausal.training.history import History
from acausal.training.member import Trained
from acausal.training.objective.error_laws import LogLikelihood
from acausal.training.objective.held_out import HeldOut
from acausal.training.objective.initial_state import InitialState
from acausal.training.objective.problem import Problem
from acausal.training.objective.sharding import on_default_device
from acausal.training.objective.start_sizes import found_starts
from acausal.training.objective.timing import delay_of, lag_of
from acausal.training.objective.trainable import Trainable, changes_of
from acausal.training.page_subject import LearnedLaw
from acausal.training.predict import OwnParameters, predict
from acausal.training.prediction import Predictions
from acausal.training.profile import Profile, profile
from acausal.training.record_fit import RecordFit, of_records, residuals_of
from acausal.training.starts import Starts
from acausal.training.uncertainty.confidence import Band, Confidence, confidence
from acausal.training.uncertainty.conformal import Conformal, conformal
from acausal.training.uncertainty.residuals import Residuals

if TYPE_CHECKING:
    from pandas import DataFrame

    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Seen:
    """Statistics of a network's arguments over the record, in one simulation with the trained parameters.

    Attributes:
        mean: of every argument.
        sigma: standard deviation of every argument.
    """

    mean: Float[np.ndarray, " n_arguments"]
    sigma: Float[np.ndarray, " n_arguments"]

    def interval(
        self, sigmas: float = 2.0
    ) -> tuple[Float[np.ndarray, " n_arguments"], Float[np.ndarray, " n_arguments"]]:
        """Bounds ``mean ± sigmas · σ`` of every argument; outside of 2σ a network extrapolates."""
        return self.mean - sigmas * self.sigma, self.mean + sigmas * self.sigma


@dataclass(frozen=True, eq=False)
class Fit:
    """The result of `fit`.

    Attributes:
        system: the model.
        params: its trained parameters: a flat dict with networks and physical values.
        loss: over one simulation of the whole record, every point of it; infinite if the model diverges there.
        loss_before: the same before training.
        validation_loss: of ``params``, over the held-out samples; ``None`` without validation.
        best_epoch: updates after which ``params`` were reached: those of the lowest loss over the held-out samples,
            else over the whole record, among all evaluations.
        records: by name of a record, how the trained model follows it: times, predictions, errors, initial state.
        held_out: the same for the records with held-out samples; there only these count as measured.
        modifiers: change of every parameter that was trained: relative, p̃/p − 1; of one with a `Shift` or `Bounded`
            absolute, p̃ − p. Trained
            delays and lags are among them, as ``delay(force)`` in seconds; see `delays` and `lags`.
        arguments: by network, what it was called with in one simulation of every record.
        seen: by network, the statistics of these arguments.
        history: the training, update by update.
        seconds: total time; ``compile_seconds``: the part in XLA's compiler.
        seconds_per_epoch: average time of an update.
        interrupted: whether the user ended it early.
        starts: what several starts of the parameters reached; ``None`` for one.
        problem, trained: the training problem and what was trained, for further questions.
        settings: how it was trained: the seed and the options, as texts by name.
        stages: what the training did, one part after the other, and the loss that each reached.
        step_error: how much twice as many steps change the predictions, relative to the targets' deviations; measured
            with ``strategy="auto"`` and fixed steps.
        not_laws: networks of which ``strategy="auto"`` knew no scales: modules of your own.
    """

    system: System
    params: dict[str, Any]
    loss: float
    loss_before: float
    validation_loss: float | None
    best_epoch: int
    records: dict[str, RecordFit]
    held_out: dict[str, RecordFit]
    modifiers: dict[str, float]
    arguments: dict[str, Float[np.ndarray, "n_calls n_arguments"]]
    seen: dict[str, Seen]
    history: History
    seconds: float
    compile_seconds: float
    seconds_per_epoch: float
    interrupted: bool
    problem: Problem
    trained: Trainable
    starts: Starts | None = None
    settings: Mapping[str, str] = field(default_factory=dict[str, str])
    stages: tuple[StageResult, ...] = ()
    step_error: float | None = None
    not_laws: tuple[str, ...] = ()

    @cached_property
    def verdict(self) -> Verdict | None:
        """Whether the fit explains the records down to their noise; ``None`` for other losses than ``"nrmse"``."""
        return verdict(self)

    def stages_summary(self) -> str:
        """The stages and what each reached, in a line."""
        line = " → ".join(f"{stage.title} {stage.loss:.4g}" for stage in self.stages)
        return line if self.verdict is None else f"{line}; noise {self.verdict.noise:.4g}"

    @property
    def x0(self) -> dict[str, float]:
        """The state at the start of the only record, by name."""
        return self._only("x0").x0

    @property
    def predicted(self) -> Float[np.ndarray, "N n_targets"]:
        """The targets in one simulation of the only record."""
        return self._only("predicted").predicted

    @property
    def predicted_before(self) -> Float[np.ndarray, "N n_targets"]:
        """The same before training."""
        self._only("predicted")
        return next(iter(self.before.values())).predicted

    @property
    def time(self) -> Float[np.ndarray, " N"]:
        """The times of the only record, in seconds."""
        return self._only("time").time

    @property
    def samples_trained(self) -> int:
        """How many samples the training's records have."""
        return sum(len(record.time) for record in self.records.values())

    def _only(self, what: str) -> RecordFit:
        """The only record.

        Raises:
            TrainingError: if there are several.
        """
        first, *others = self.records.values()
        if others:
            raise TrainingError(
                f"There are {len(self.records)} records: ask one of them, fit.records['{first.name}'].{what}."
            )
        return first

    @property
    def rms(self) -> dict[str, float]:
        """By target, the root mean square error over all records, in the target's unit."""
        errors = np.concatenate([record.errors for record in self.records.values()])
        squares = np.sqrt(np.nanmean(errors**2, axis=0))
        return dict(zip(self.problem.targets, squares.tolist(), strict=True))

    @cached_property
    def noise(self) -> dict[str, float]:
        """By target, the level of its noise in its unit: as given to the loss, or as estimated from all records.

        For losses that know of no noise it is the root mean square error.
        """
        problem, records = self.problem, self.problem.records
        if not isinstance(problem.loss, LogLikelihood):
            return self.rms
        predicted = problem.simulate(self.trained).y
        levels = problem.loss.levels(predicted, records.y, records.sigma, records.weight)
        return dict(zip(problem.targets, levels.tolist(), strict=True))

    @property
    def delays(self) -> dict[str, float]:
        """The delays of inputs and targets in seconds, trained or given."""
        found = self.problem.assemble(self.trained)
        return {n: float(found[delay_of(n)]) for n in self.problem.timing.delays}

    @property
    def lags(self) -> dict[str, float]:
        """The time constants of targets' sensors in seconds, trained or given."""
        found = self.problem.assemble(self.trained)
        return {n: float(found[lag_of(n)]) for n in self.problem.timing.lags}

    @property
    def score(self) -> float:
        """The loss by which the best was chosen: over the held-out samples, else over the whole record."""
        return self.loss if self.validation_loss is None else self.validation_loss

    def confidence(self, record: str | None = None) -> Confidence:
        """How well the records determine the learned laws and the trained parameters; computed when first asked for.

        Arguments:
            record: what this record alone determines; by default all together.

        Raises:
            TrainingError: for a name that is not a record, or if the model diverges over a record.
        """
        if record not in self._confidences:
            problem = self.problem if record is None else self._alone(record)
            self._confidences[record] = confidence(problem, self.trained, self.arguments)
        return self._confidences[record]

    @cached_property
    def _confidences(self) -> dict[str | None, Confidence]:
        return {}

    def _alone(self, record: str) -> Problem:
        """The problem in which one record alone counts."""
        known = self.problem.records
        if record not in known.names:
            raise TrainingError(f"There is no record '{record}': {nearest(record, known.names)}")
        counts = (known.of == known.names.index(record))[:, None]
        return replace(
            self.problem,
            records=replace(known, weight=jnp.where(counts, known.weight, 0.0)),
            prior=None,
        )

    def profile(
        self, parameter: str, points: int = 21, width: float = 3.0, level: float = 0.95
    ) -> Profile:
        """The loss along a trained parameter, with everything else trained again where it is held.

        Unlike `confidence`, which is local, this shows the whole way: an interval that need not be symmetric, and
        whether there is one. Up to 60 trained numbers take Gauss-Newton steps; with more, such as the weights of
        networks, all are trained by at most 120 updates of L-BFGS. All points are trained in one program.

        Arguments:
            parameter: its name, such as ``"mass.m"``.
            points: where it is held, an odd number.
            width: how far from the fit's value to either side, in standard deviations of `confidence`; less where it
                would leave its bounds or change its sign.
            level: of the interval.

        Raises:
            TrainingError: for a parameter that was not trained, numbers that do not fit, or if the model diverges.
        """
        return profile(
            self.problem, self.trained, self.confidence(), parameter, points, width, level
        )

    def conformal(
        self,
        data: RecordsLike,
        level: float = 0.9,
        x0: InitialState = "auto",
    ) -> Conformal:
        """Bands around predictions that hold a share of all measurements, calibrated on other records.

        Arguments:
            data: one record or several, with inputs and targets, that the training has never used, not even to choose
                the best (``validation``).
            level: the share, in (0, 1).
            x0: the state at a record's start: ``"auto"`` as measured, and as the model starts where it is not,
                ``"data"`` as measured, ``"model"`` as the model starts, ``"steady"``
                at rest, or values by name that replace the measured ones; or such a choice by record.

        Raises:
            DataError: if the record is too short for the level, or lacks what is needed.
        """
        return conformal(self.problem, self.trained, data, level, x0)

    def predict(
        self,
        data: RecordsLike,
        x0: InitialState = "auto",
        *,
        params: OwnParameters | None = None,
        conformal: Conformal | None = None,
    ) -> Predictions:
        """Predict other records, each in one simulation, with bands of two standard deviations.

        Delays, lags and laws are as trained. What a record has for itself is found from its targets by the likelihood
        of the training: initial states within what is known of them, and parameters of ``per_record``. Of a record
        without targets these are as expected: the state as measured or as the model starts, the parameters' mean.

        Arguments:
            data: one record or several, with the model's inputs; targets may be missing.
            x0: the state at a record's start, as of `FitOptions`, or by record. ``"auto"`` finds it; values by name,
                ``"data"``, ``"model"`` and ``"steady"`` are taken as they are.
            params: values of parameters that differ between records, by name, or by record and name; the others are
                found.
            conformal: from `conformal`, whose bands are given in the place of those of two standard deviations.

        Returns:
            By record a `Prediction`: times, targets, bands, errors, `plot`; of all of them ``errors`` and `report`.

        Raises:
            DataError: if a record lacks an input, or for a name or value that does not fit.
            TrainingError: if the model diverges over a record of the training.
        """
        return predict(self, data, x0, params, conformal)

    def evaluate(
        self,
        data: RecordsLike,
        x0: InitialState = "auto",
        *,
        params: OwnParameters | None = None,
        conformal: Conformal | None = None,
    ) -> DataFrame | PlainTable:
        """The errors of other records in a table, with a row for each; arguments and errors as of `predict`.

        Returns:
            A pandas DataFrame; without pandas a `PlainTable`, which prints the same.
        """
        return self.predict(data, x0, params=params, conformal=conformal).errors

    def residuals(self, record: str | None = None) -> tuple[Residuals, ...]:
        """The residuals of every target: over one record, or over all of them.

        Raises:
            TrainingError: for a name that is not a record.
        """
        if record is not None and record not in self.records:
            raise TrainingError(f"There is no record '{record}': {nearest(record, self.records)}")
        chosen = list(self.records.values()) if record is None else [self.records[record]]
        return residuals_of(chosen)

    @cached_property
    def before(self) -> dict[str, RecordFit]:
        """The records before training, as `records`."""
        start = self.problem.start()
        return of_records(self.problem, start, self.problem.simulate(start))

    def samples(self, network: str, most: int = 400) -> Float[np.ndarray, " n_samples"]:
        """Some of the values that a network's first argument had over the record, at most so many."""
        values = self.arguments[self._known(network)][:, 0]
        return values[:: max(1, len(values) // most)]

    def distill(self, network: str, sigmas: float = 2.0, **options: Any) -> Distilled:
        """A short formula for a learned law of one variable, over ``mean ± sigmas · σ`` of its argument in training.

        Arguments:
            network: its name, such as ``"damper.net"``.
            sigmas: how far the formula reaches to either side.
            options: further arguments of `acausal.distill`.
        """
        low, high = self.seen[self._known(network)].interval(sigmas)
        return distill(self.params[network], float(low[0]), float(high[0]), **options)

    def _known(self, network: str) -> str:
        """The name of a trained network; any other name is refused with a sentence."""
        if network not in self.seen:
            raise TrainingError(
                f"There is no trained network '{network}': {nearest(network, self.seen)}"
            )
        return network

    def report(
        self, path: str | Path, title: str = "Training", *, profiles: Sequence[Profile] = ()
    ) -> Path:
        """Write a page about the training, one HTML file that needs no network; returns the file.

        It shows the model, component by component, with what it has learned, the records before and after training, the
        laws, the parameters, and how sure all of it is. With ``pip install 'acausal[page]'`` plots can be zoomed and
        read.

        Arguments:
            path: a folder, in which ``index.html`` is written, or a file that ends in ``.html``.
            title: of the page.
            profiles: from `profile`, to show whether parameters are identifiable.

        Raises:
            DataError: if it cannot be written.
        """
        need_path(path, "report")
        return write_page(self.page_content(title, profiles), path)

    def page_content(self, title: str = "", profiles: Sequence[Profile] = ()) -> PageContent:
        """All that the page of the training shows; arguments as of `report`."""
        trained = ", ".join((*self.seen, *self.modifiers))
        end = ", ended by the user" if self.interrupted else ""
        lead = (
            f"{trained} trained on {self.samples_trained} samples of {', '.join(self.problem.targets)} in "
            f"{self.seconds:.3g} s, {self.history.epochs} updates{end}."
        )
        lead += "" if self.verdict is None else f" The model {self.verdict}"
        return fit_content(self, self.before, title or "Training", lead, self._losses(), profiles)

    def _losses(self) -> list[tuple[str, str, str]]:
        """Losses before and after, in rows."""
        rows = [("loss over the record", f"{self.loss_before:.4g}", f"{self.loss:.4g}")]
        for before in self.history.validation_loss[:1, 1]:
            rows.append(
                ("loss over what is held out", f"{before:.4g}", f"{self.validation_loss:.4g}")
            )
        return rows

    def with_bands(self, bands: Mapping[str, Band]) -> dict[str, LearnedLaw]:
        """Learned laws as reports show them: over their arguments in training, in the quantity that the model has."""
        packed = self.system.pack(self.params)

        def law(name: str, band: Band) -> LearnedLaw:
            found = labels(self.system, name, packed)
            argument = found.arguments[0] if found.arguments else "argument"
            return LearnedLaw(
                band.times(found.factor),
                self.seen[name],
                self.samples(name),
                argument,
                found.result,
                found.factor,
            )

        return {name: law(name, band) for name, band in bands.items()}

    @property
    def ranges(self) -> dict[str, tuple[tuple[float, float], ...]]:
        """By network, the least and the greatest value of each argument in one simulation of every record.

        `export` takes them as ``ranges``. A network that was called with values that are not finite has none.
        """
        return {
            name: tuple(zip(seen.min(axis=0).tolist(), seen.max(axis=0).tolist(), strict=True))
            for name, seen in self.arguments.items()
            if np.isfinite(seen).all()
        }

    def export(
        self,
        path: str | Path,
        *,
        confidence: Confidence | None = None,
        notes: Mapping[str, object] | None = None,
        overwrite: bool = False,
        **options: Any,
    ) -> Path:
        """Write the trained model for other tools, and a model card beside it.

        The ending of the path chooses the form: ``.fmu``, ``.c`` (and its header), ``.onnx``, ``.jax``, ``.mlir``,
        ``.mlirbc``, ``.mo``; see `acausal.export`. An FMU and C tell when a network leaves its `ranges`. The card
        has the name of the file and ``.md``, and says the same as JSON in ``.json``: what was trained on which data,
        losses, ranges, promises, versions, and the file's hash.

        Arguments:
            path: of the file.
            confidence: from `confidence`, to tell how well laws and parameters are known.
            notes: further lines of the card, by title, such as ``{"loss of the linear model": 0.44}``.
            overwrite: whether files of these names may be replaced.
            options: of the function that writes this form, such as ``outputs=["body.a"]``; ``ranges={}`` leaves the
                flag out.

        Returns:
            The path.

        Raises:
            DataError, ExportError: for an unknown ending, or as the function for this form does.
        """
        return export_with_card(self, path, confidence, notes, overwrite, options)

    def remove_offset(self) -> dict[str, Any]:
        """The parameters with every trained network less its value at zero, ``F(x) − F(0)``: the paper's (5)."""
        return remove_offset(self.params, tuple(self.seen))

    def _repr_html_(self) -> str:
        written, params = self.problem.modifiers.written, self.problem.assemble(self.trained)
        losses = [("loss over the record", self.loss_before, self.loss)]
        for before in self.history.validation_loss[:1, 1].tolist():
            losses.append(("loss over what is held out", before, self.validation_loss or np.nan))
        parameters = [
            (
                n,
                f"{float(params[n]):.6g} {unit}".removesuffix(" 1"),
                written(n, change, "+.3g", unit),
            )
            for n, change in self.modifiers.items()
            for unit in [self.problem.unit(n)]
        ]
        end = ", ended by the user" if self.interrupted else ""
        return fit_view(
            f"Fit of {', '.join((*self.seen, *self.modifiers))}",
            f"{self.samples_trained} samples, {self.history.epochs} updates in {self.seconds:.3g} s{end}; "
            f"best after update {self.best_epoch}",
            losses,
            self.rms,
            {n: self.system.unit(n) for n in self.problem.targets},
            parameters,
            next(iter(self.records.values())),
            self.history,
        )

    def _times(self) -> str:
        """What the time was spent on; the parts add up."""
        each, epochs = self.seconds_per_epoch, self.history.epochs
        rest = max(self.seconds - self.compile_seconds - each * epochs, 0.0)
        return (
            f"{self.compile_seconds:.3g} s to compile, {each * epochs:.3g} s for {epochs} epochs of "
            f"{each * 1e3:.3g} ms, {rest:.3g} s for the rest"
        )

    def __repr__(self) -> str:
        times = self.problem.timing
        changes = ", ".join(
            f"{n} {value:+.3f}" for n, value in self.modifiers.items() if n not in times.values
        )
        late = [f"{delay_of(n)} {value:.4g} s" for n, value in self.delays.items()]
        late += [f"{lag_of(n)} {value:.4g} s" for n, value in self.lags.items()]
        end = " (interrupted)" if self.interrupted else ""
        lines = [
            f"Fit of {', '.join((*self.seen, *self.modifiers))}{end}",
            f"  loss      {self.loss_before:.4g} before, {self.loss:.4g} after epoch {self.best_epoch}",
            f"  time      {self.seconds:.3g} s: {self._times()}",
        ]
        if self.validation_loss is not None:
            lines.insert(2, f"  held out  {self.validation_loss:.4g}")
        lines += [f"  modifiers {changes}"] if changes else []
        lines += [] if self.starts is None else [f"  starts    {self.starts.summary()}"]
        lines += [f"  times     {', '.join(late)}"] if late else []
        found = found_starts(self.problem)
        lines += [f"  x0        found: {found}"] if found else []
        lines += [f"  stages    {self.stages_summary()}"] if self.stages else []
        lines += [] if self.verdict is None else [f"  verdict   {self.verdict}"]
        diverged = self.history.divergences
        lines += (
            [f"  diverged  in {len(diverged)} epochs, see history.divergences"] if diverged else []
        )
        return "\n".join(lines)


def _of_held_out(problem: Problem, trainable: Trainable) -> dict[str, RecordFit]:
    problem = replace(problem, mesh=None)
    known = problem.over_other_records(trainable)
    return of_records(problem, known, problem.simulate(known))


def result(
    problem: Problem,
    trained: Trained,
    held: HeldOut | None = None,
    starts: Starts | None = None,
    settings: Mapping[str, str] | None = None,
    stages: tuple[StageResult, ...] = (),
    not_laws: tuple[str, ...] | None = None,
) -> Fit:
    """The result of a training; ``not_laws`` is not None for one whose steps were chosen by measurement."""
    best, history = on_default_device(trained.best, problem.mesh), trained.history
    problem = replace(problem, mesh=None)
    seen = problem.seen(best.trainable, best.simulated.x)
    arguments = {n: np.asarray(seen[n]) for n in problem.networks}
    return Fit(
        system=problem.system,
        params=problem.model_params(best.trainable),
        loss=best.loss,
        loss_before=float(history.full_loss[0, 1]),
        validation_loss=best.validation,
        best_epoch=best.epoch,
        records=of_records(problem, best.trainable, best.simulated),
        held_out={} if held is None else _of_held_out(held.problem, best.trainable),
        modifiers={n: float(value) for n, value in changes_of(problem, best.trainable).items()},
        arguments=arguments,
        seen={n: Seen(a.mean(axis=0), a.std(axis=0)) for n, a in arguments.items()},
        history=history,
        seconds=trained.seconds,
        compile_seconds=trained.compiling,
        seconds_per_epoch=trained.updating / max(history.epochs, 1),
        interrupted=trained.interrupted,
        problem=problem,
        trained=best.trainable,
        starts=starts,
        settings=dict(settings or {}),
        stages=stages,
        step_error=None
        if not_laws is None
        else step_error(problem, best.trainable, best.simulated),
        not_laws=not_laws or (),
    )
