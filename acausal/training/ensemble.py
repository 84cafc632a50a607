"""Ensembles: the same training from several seeds, and the spread of their results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from jaxtyping import Float
from numpy.typing import ArrayLike

from acausal.data import Data, RecordsLike, Stream
from acausal.errors import DataError, TrainingError, need_compiled, need_text, need_whole, shown
from acausal.files import need_path
from acausal.networks import law_at
from acausal.pages import write_page
from acausal.reporting import Band, PageContent, table
from acausal.training.objective.initial_state import InitialState
from acausal.training.options import FitKeywords, FitOptions, documented
from acausal.training.preparation import prepare
from acausal.training.presentation.page_of_several import prediction_blocks, several_content
from acausal.training.record_fit import of_other_records
from acausal.training.result import Fit
from acausal.training.streaming import need_one_training
from acausal.training.train_from_starts import run
from acausal.training.uncertainty.bumps import SIGMAS
from acausal.training.uncertainty.confidence import BAND_POINTS

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Ensemble:
    """The results of trainings that differ in their seed alone.

    Their spread shows what the record and the training leave open; standard deviations are estimates for further
    trainings. The spread does not show errors that all of them share, such as a law that overfits the record's noise:
    see `Fit.confidence`.

    Attributes:
        fits: one for each member.
    """

    fits: tuple[Fit, ...]

    @cached_property
    def laws(self) -> dict[str, Band]:
        """By network, mean and standard deviation of what the members have learned.

        Over the values of the first argument that occurred in all trainings; other arguments are held at their mean.
        """
        return {name: self._law(name) for name in self.fits[0].seen}

    def _law(self, name: str) -> Band:
        seen = np.concatenate([fit.arguments[name] for fit in self.fits])
        centre, sigma = seen[:, 0].mean(), seen[:, 0].std() or 1.0
        x = np.linspace(centre - SIGMAS * sigma, centre + SIGMAS * sigma, BAND_POINTS)
        rest = seen[:, 1:].mean(axis=0)
        learned = [np.asarray(law_at(fit.params[name], x, rest)) for fit in self.fits]
        return _mean_and_deviation(x, learned)

    @cached_property
    def predicted(self) -> dict[str, Band]:
        """By target, mean and standard deviation over the time of the only record, in one simulation by each member."""
        return self._predictions(self.fits[0].time, [fit.predicted for fit in self.fits])

    @cached_property
    def predicted_records(self) -> dict[str, dict[str, Band]]:
        """The same for every record, by name."""
        return {
            name: self._predictions(record.time, [fit.records[name].predicted for fit in self.fits])
            for name, record in self.fits[0].records.items()
        }

    def predict(
        self, data: Data | Mapping[str, ArrayLike], x0: InitialState = "auto"
    ) -> dict[str, Band]:
        """The same over another record.

        Arguments:
            data: the record, with inputs and targets.
            x0: the state at its start: ``"auto"`` as measured, and as the model starts where it is not, ``"data"`` as
                measured, ``"model"`` as the model starts, ``"steady"`` at rest, or values by name that replace the
                measured ones.

        Raises:
            DataError: if the record lacks what is needed.
        """
        found = [of_other_records(f.problem, f.trained, data, x0) for f in self.fits]
        records = [one for members in found for one in members.values()]
        return self._predictions(records[0].time, [one.predicted for one in records])

    def _predictions(
        self, time: Float[np.ndarray, " N"], ys: Sequence[Float[np.ndarray, "N n_targets"]]
    ) -> dict[str, Band]:
        names = self.fits[0].problem.targets
        return {
            name: _mean_and_deviation(time, [y[:, i] for y in ys]) for i, name in enumerate(names)
        }

    @property
    def modifiers(self) -> dict[str, tuple[float, float]]:
        """By trained parameter, mean and standard deviation of its change."""
        found = {n: [fit.modifiers[n] for fit in self.fits] for n in self.fits[0].modifiers}
        return {n: (float(np.mean(v)), float(np.std(v, ddof=1))) for n, v in found.items()}

    @property
    def best(self) -> Fit:
        """The member with the lowest loss over the held-out samples, else over the whole record."""
        return min(self.fits, key=lambda fit: fit.score)

    def report(self, folder: str | Path, title: str = "Ensemble") -> Path:
        """Write a self-contained page, ``index.html`` in a folder; returns its path."""
        return write_page(self.page_content(title), need_path(folder, "report"))

    def page_content(self, title: str = "") -> PageContent:
        """All that the page shows."""
        best = self.best
        trained = ", ".join((*best.seen, *best.modifiers))
        lead = (
            f"{trained} trained {len(self.fits)} times on {best.samples_trained} samples of "
            f"{', '.join(best.problem.targets)} in {best.seconds:.3g} s."
        )
        rows = [
            (k, f"{fit.loss_before:.4g}", f"{fit.loss:.4g}", f"{fit.score:.4g}")
            for k, fit in enumerate(self.fits)
        ]
        units = {name: best.system.unit(name) for name in best.problem.targets}
        changes = [
            (n, f"{mean:+.4g}", f"{sigma:.2g}") for n, (mean, sigma) in self.modifiers.items()
        ]
        return several_content(
            best,
            need_text(title, "title") or "Ensemble",
            lead,
            table(("member", "loss before", "after", "deciding loss"), rows),
            {
                "Measured and simulated": [
                    *prediction_blocks(best.records, self.predicted_records, units)
                ]
            },
            self.laws,
            {f"member {k}": fit.history for k, fit in enumerate(self.fits)},
            table(("parameter", "change", "standard deviation"), changes) if changes else None,
        )

    def __repr__(self) -> str:
        losses = ", ".join(f"{fit.score:.4g}" for fit in self.fits)
        first = self.fits[0]
        lines = [
            f"Ensemble of {len(self.fits)} for {', '.join((*first.seen, *first.modifiers))}",
            f"  losses    {losses}",
            f"  time      {first.seconds:.3g} s",
        ]
        changes = [f"{n} {mean:+.3f} ± {sigma:.3f}" for n, (mean, sigma) in self.modifiers.items()]
        return "\n".join([*lines, *([f"  modifiers {', '.join(changes)}"] if changes else [])])


@documented
def ensemble(
    system: System,
    data: RecordsLike | Stream,
    targets: str | Sequence[str],
    *,
    members: int = 5,
    params: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    seed: int = 0,
    **options: Unpack[FitKeywords],
) -> Ensemble:
    """Train several times from different seeds, in one compiled program or each on a worker (``executor``).

    Arguments:
        system, data, targets: as of `acausal.fit`.
        members: number of trainings.
        params: where to start: the numbers of all members, whose networks come from their own seeds; or all
            parameters of each member, which then differ only in their networks.
        seed: of the first member; the others follow by one each.
        options: see `acausal.training.FitOptions`, each by its name. Not ``devices``.

    Raises:
        DataError, TrainingError: as `acausal.fit` does; if there are fewer than two members, or their networks are
            not alike.
        TypeError: for a keyword that is not an option.
    """
    need_compiled(system, "ensemble")
    members = need_whole(members, "members", TrainingError, 2)
    fit_options = FitOptions.of("ensemble", options)
    need_one_training(data, fit_options, members)
    if fit_options.devices is not None:
        raise TrainingError("An ensemble is trained on one device: leave out devices=.")
    if fit_options.starts > 1:
        raise TrainingError(
            "The members of an ensemble differ in their seeds alone: leave out starts=, or pass the params of an "
            "ac.fit(..., starts=...)."
        )
    seed = need_whole(seed, "seed", TrainingError)
    if params is None or isinstance(params, Mapping):
        numbers = {n: leaf for n, leaf in (params or {}).items() if not callable(leaf)}
        params = [numbers] * members
    if not isinstance(params, Sequence):
        raise DataError(
            f"params={shown(params)} are not parameters; give a mapping by name, or one for each member."
        )
    if len(params) != members:
        raise TrainingError(f"There are {len(params)} params for {members} members.")
    seeds = tuple(range(seed, seed + members))
    return Ensemble(run(prepare(system, data, targets, fit_options, seeds=seeds, params=params)))


def _mean_and_deviation(
    x: Float[np.ndarray, " points"], curves: Sequence[Float[np.ndarray, " points"]]
) -> Band:
    return Band(x, np.mean(curves, axis=0), np.std(curves, axis=0, ddof=1))
