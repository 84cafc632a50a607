"""`Fit`: a trained model, and further questions to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.analysis import Distilled, distill
from acausal.data import RecordsLike
from acausal.errors import need_text
from acausal.files import need_path
from acausal.jobs import Workers
from acausal.networks import remove_offset
from acausal.pages import write_page
from acausal.reporting import PageContent, PlainTable
from acausal.training.auto.verdict import Verdict, verdict
from acausal.training.conformal import Conformal, conformal
from acausal.training.member import Trained
from acausal.training.objective.initial_state import InitialState
from acausal.training.objective.problem import Problem
from acausal.training.predict import OwnParameters, predict
from acausal.training.prediction import Predictions
from acausal.training.presentation.export_with_card import export_with_card
from acausal.training.presentation.fit_page import fit_content
from acausal.training.presentation.fit_view import fit_text, fit_view
from acausal.training.profile import Profile, profile
from acausal.training.record_fit import RecordFit, of_records
from acausal.training.starts import Starts
from acausal.training.strategy import StageResult
from acausal.training.trained_model import Seen, TrainedModel
from acausal.training.uncertainty.confidence import Confidence

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, eq=False, repr=False)
class Fit(TrainedModel):
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
        seconds: total time; ``prepare_seconds``: the part before the training, as for starts, scales and steps that the
            data give; ``compile_seconds``: the part in XLA's compiler after that.
        seconds_per_epoch: average time of an update.
        interrupted: whether the user ended it early.
        starts: what several starts of the parameters reached; ``None`` for one.
        problem, trained: the training problem and what was trained, for further questions.
        settings: how it was trained: the seed and the options, as texts by name.
        stages: what the training did, one part after the other, and the loss that each reached.
        step_error: how much twice as many steps change the predictions, relative to the targets' deviations; for fixed
            steps of explicit methods.
        not_laws: networks of which ``strategy="auto"`` knew no scales: modules of your own.
        without_constant: networks that ``strategy="auto"`` made vanish at zero, because nothing in the records
            determines their constant.
        pieces: in how many pieces ``strategy="auto"`` followed the records, each from a start of its own, because the
            model is too sensitive to its start to follow them whole (chaotic, for instance); 0 where they are whole.
        misread: a sentence on each input with which ``strategy="auto"`` would have left less by linear laws alone if it
            had another sign or unit.
    """

    @cached_property
    def verdict(self) -> Verdict | None:
        """Whether the fit explains the records down to their noise; ``None`` for other losses than ``"nrmse"``."""
        return verdict(self)

    def stages_summary(self) -> str:
        """The stages and what each reached, in a line."""
        line = " → ".join(f"{stage.title} {stage.loss:.4g}" for stage in self.stages)
        return line if self.verdict is None else f"{line}; noise {self.verdict.noise:.4g}"

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
        """How wide bands around predictions must be to hold a share of all measurements, measured on other records.

        ``predict(data, conformal=...)`` takes them.

        Arguments:
            data: one record or several, with inputs and targets, that the training has never used, not even to choose
                the best (``validation``).
            level: the share, in (0, 1).
            x0: the state at a record's start, as of `predict`.

        Raises:
            DataError: if the record is too short for the level, or lacks what is needed.
        """
        found = self.predict(data, x0)
        units = {n: self.system.unit(n) for n in self.problem.targets}
        return conformal(found, units, level)

    def predict(
        self,
        data: RecordsLike,
        x0: InitialState = "auto",
        *,
        params: OwnParameters | None = None,
        conformal: Conformal | None = None,
        executor: Workers | None = None,
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
            executor: whose workers predict the records, in some dozens of blocks: any `concurrent.futures.Executor`, or
                a function that makes one. By default this process does.

        Returns:
            By record a `Prediction`: times, targets, bands, errors, `plot`; of all of them ``errors`` and `report`.

        Raises:
            DataError: if a record lacks an input, or for a name or value that does not fit; for what cannot be sent to
                workers, and for workers that are lost again and again.
            TrainingError: if the model diverges over a record of the training.
        """
        return predict(self, data, x0, params, conformal, executor)

    def evaluate(
        self,
        data: RecordsLike,
        x0: InitialState = "auto",
        *,
        params: OwnParameters | None = None,
        conformal: Conformal | None = None,
        executor: Workers | None = None,
    ) -> DataFrame | PlainTable:
        """The errors of other records in a table, with a row for each; arguments and errors as of `predict`.

        Returns:
            A pandas DataFrame; without pandas a `PlainTable`, which prints the same.
        """
        found = self.predict(data, x0, params=params, conformal=conformal, executor=executor)
        return found.errors

    def distill(self, network: str, sigmas: float = 2.0, **options: Any) -> Distilled:
        """A short formula for a learned law of one variable, over ``mean ± sigmas · σ`` of its argument in training.

        Arguments:
            network: its name, such as ``"damper.net"``.
            sigmas: how far the formula reaches to either side.
            options: further arguments of `acausal.distill`.
        """
        low, high = self.seen[self.need_network(network)].interval(sigmas)
        return distill(self.params[network], float(low[0]), float(high[0]), **options)

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
        return fit_content(self, self.verdict, need_text(title, "title") or "Training", profiles)

    def export(
        self,
        path: str | Path,
        *,
        confidence: Confidence | None = None,
        notes: Mapping[str, object] | None = None,
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
            options: of the function that writes this form, such as ``outputs=["body.a"]``; ``ranges={}`` leaves the
                flag out.

        Returns:
            The path.

        Raises:
            DataError, ExportError: for an unknown ending, or as the function for this form does.
        """
        return export_with_card(self, path, confidence, notes, options)

    def remove_offset(self) -> dict[str, Any]:
        """The parameters with every trained network less its value at zero, ``F(x) − F(0)``: the paper's (5)."""
        return remove_offset(self.params, tuple(self.seen))

    def _repr_html_(self) -> str:
        return fit_view(self)

    def __repr__(self) -> str:
        return fit_text(self, self.stages_summary(), self.verdict)


def result(
    problem: Problem,
    trained: Trained,
    prepare_seconds: float,
    held: Problem | None,
    *,
    starts: Starts | None,
    settings: dict[str, str],
    stages: tuple[StageResult, ...],
    step_error: float | None,
    not_laws: tuple[str, ...],
    without_constant: tuple[str, ...],
    pieces: int,
    misread: tuple[str, ...],
) -> Fit:
    """The result of a training; arguments as the attributes of `Fit`."""
    best, history, held_out = trained.best, trained.history, dict[str, RecordFit]()
    if held is not None:
        held = replace(held, mesh=None)
        known = held.over_other_records(best.trainable)
        held_out = of_records(held, known, held.simulate(known))
    records = of_records(problem, best.trainable, trained.simulated)
    arguments = {
        n: np.concatenate([record.arguments[n] for record in records.values()])
        for n in problem.networks
    }
    return Fit(
        system=problem.system,
        params=problem.model_params(best.trainable),
        loss=best.loss,
        loss_before=float(history.full_loss[0, 1]),
        validation_loss=best.validation,
        best_epoch=best.epoch,
        records=records,
        held_out=held_out,
        modifiers={n: float(value) for n, value in problem.changes(best.trainable).items()},
        arguments=arguments,
        seen={n: Seen(a.mean(axis=0), a.std(axis=0)) for n, a in arguments.items()},
        history=history,
        seconds=prepare_seconds + trained.seconds,
        prepare_seconds=prepare_seconds,
        compile_seconds=trained.compiling,
        seconds_per_epoch=trained.updating / max(history.epochs, 1),
        interrupted=trained.interrupted,
        problem=problem,
        trained=best.trainable,
        starts=starts,
        settings=settings,
        stages=stages,
        step_error=step_error,
        not_laws=not_laws,
        without_constant=without_constant,
        pieces=pieces,
        misread=misread,
    )
