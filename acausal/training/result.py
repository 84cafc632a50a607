"""The result of a training, and what can be asked of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from acausal.analysis import Distilled, distill
from acausal.data import Data
from acausal.errors import TrainingError, nearest
from acausal.networks import remove_offset
from acausal.training.history import History
from acausal.training.loop import Trained
from acausal.training.objective.build_problem import Start
from acausal.training.objective.problem import Problem, Trainable, modified
from acausal.training.objective.sharding import local
from acausal.training.page import write_page
from acausal.training.uncertainty.confidence import Confidence, confidence
from acausal.training.uncertainty.conformal import Conformal, conformal
from acausal.training.uncertainty.residuals import Residuals, residuals

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Seen:
    """What a network was called with over the record, in one simulation with the trained parameters.

    Attributes:
        mean: of every argument, shape (number of arguments,).
        sigma: standard deviation, likewise.
    """

    mean: np.ndarray
    sigma: np.ndarray

    def interval(self, sigmas: float = 2.0) -> tuple[np.ndarray, np.ndarray]:
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
        validation_loss: of ``params``, over what was held out; ``None`` where nothing was.
        best_epoch: updates after which ``params`` were reached: those of the lowest loss over what was held out,
            else over the whole record, among all evaluations.
        x0: the state at the record's start, by name.
        modifiers: change of every parameter that was trained: relative, p̃/p − 1; of one with a `Shift` or `Bounded`
            absolute, p̃ − p.
        predicted: the targets in one simulation of the record, shape (N, number of targets).
        arguments: by network, what it was called with in that simulation, shape (N, number of arguments).
        seen: by network, the statistics of that.
        history: the training, update by update.
        seconds: what all of it took, of which ``compile_seconds`` in XLA's compiler.
        seconds_per_epoch: what an update took on average.
        interrupted: whether the user ended it early.
        problem, trained: what was posed and what came of it, for further questions.
    """

    system: System
    params: dict[str, Any]
    loss: float
    loss_before: float
    validation_loss: float | None
    best_epoch: int
    x0: dict[str, float]
    modifiers: dict[str, float]
    predicted: np.ndarray
    arguments: dict[str, np.ndarray]
    seen: dict[str, Seen]
    history: History
    seconds: float
    compile_seconds: float
    seconds_per_epoch: float
    interrupted: bool
    problem: Problem
    trained: Trainable

    @property
    def score(self) -> float:
        """The loss by which the best was chosen: over what was held out, else over the whole record."""
        return self.loss if self.validation_loss is None else self.validation_loss

    def confidence(self) -> Confidence:
        """How well the record determines the learned laws and the trained parameters; computed when first asked for."""
        return self._confidence

    @cached_property
    def _confidence(self) -> Confidence:
        return confidence(self.problem, self.trained, self.arguments)

    def conformal(
        self,
        data: Data | Mapping[str, ArrayLike],
        level: float = 0.9,
        x0: Start | Mapping[str, float] = "data",
    ) -> Conformal:
        """Bands around predictions that hold a share of all measurements, calibrated on a record of its own.

        Arguments:
            data: a record with inputs and targets, of which the training has seen nothing; that by which it was
                chosen (``validation``) is none.
            level: the share, in (0, 1).
            x0: the state at the record's start: ``"data"`` as measured, ``"model"`` as the model starts, or
                values by name that replace the measured ones.

        Raises:
            DataError: if the record is too short for the level, or lacks what is needed.
        """
        return conformal(self.problem, self.trained, data, level, x0)

    def residuals(self) -> tuple[Residuals, ...]:
        """What the trained model leaves over of every target."""
        record, inputs = self.problem.record, self.system.inputs
        left = np.asarray(record.y - self.predicted)
        u = np.asarray(record.steps.inputs.start)
        drivers = {n: u[:, i] for i, n in enumerate(inputs)}
        sigmas = np.asarray(record.sigma).tolist()
        rows = zip(self.problem.targets, left.T, sigmas, strict=True)
        return tuple(residuals(n, column, drivers, sigma) for n, column, sigma in rows)

    @cached_property
    def predicted_before(self) -> np.ndarray:
        """What was `predicted` before training."""
        return np.asarray(self.problem.simulate(self.problem.start()).y)

    def samples(self, network: str, most: int = 400) -> np.ndarray:
        """Some of the values that a network's first argument had over the record, at most so many."""
        values = self.arguments[self._known(network)][:, 0]
        return values[:: max(1, len(values) // most)]

    def distill(self, network: str, sigmas: float = 2.0, **wishes: Any) -> Distilled:
        """A short formula for a learned law of one variable, over ``mean ± sigmas · σ`` of what it has seen.

        Arguments:
            network: its name, such as ``"damper.net"``.
            sigmas: how far the formula reaches.
            wishes: further arguments of `acausal.distill`.
        """
        low, high = self.seen[self._known(network)].interval(sigmas)
        return distill(self.params[network], float(low[0]), float(high[0]), **wishes)

    def _known(self, network: str) -> str:
        """The name of a trained network, or a sentence about another one."""
        if network not in self.seen:
            raise TrainingError(
                f"There is no trained network '{network}': {nearest(network, self.seen)}"
            )
        return network

    def report(self, folder: str | Path, title: str = "Training") -> Path:
        """Write a self-contained page about the training, ``index.html`` in a folder; returns its path."""
        return write_page(self, Path(folder) / "index.html", title)

    def remove_offset(self) -> dict[str, Any]:
        """The parameters with every trained network less its value at zero, ``F(x) − F(0)``: the paper's (5)."""
        return remove_offset(self.params, tuple(self.seen))

    def __repr__(self) -> str:
        changes = ", ".join(f"{n} {value:+.3f}" for n, value in self.modifiers.items())
        end = " (interrupted)" if self.interrupted else ""
        lines = [
            f"Fit of {', '.join((*self.seen, *self.modifiers))}{end}",
            f"  loss      {self.loss_before:.4g} before, {self.loss:.4g} after epoch {self.best_epoch}",
            f"  time      {self.seconds:.3g} s, {self.seconds_per_epoch * 1e3:.3g} ms an epoch",
        ]
        if self.validation_loss is not None:
            lines.insert(2, f"  held out  {self.validation_loss:.4g}")
        lines += [f"  modifiers {changes}"] if changes else []
        diverged = self.history.divergences
        lines += (
            [f"  diverged  in {len(diverged)} epochs, see history.divergences"] if diverged else []
        )
        return "\n".join(lines)


def result(problem: Problem, trained: Trained) -> Fit:
    """What came of a training."""
    best, history = local(trained.best, problem.mesh), trained.history
    problem = replace(problem, mesh=None)
    seen = problem.seen(best.trainable, best.simulated.x)
    arguments = {n: np.asarray(seen[n]) for n in problem.networks}
    return Fit(
        system=problem.system,
        params=problem.assemble(best.trainable),
        loss=best.loss,
        loss_before=float(history.full_loss[0, 1]),
        validation_loss=best.validation,
        best_epoch=best.epoch,
        x0=dict(zip(problem.system.states, best.simulated.x[0].tolist(), strict=True)),
        modifiers={n: float(value) for n, value in modified(problem, best.trainable).items()},
        predicted=np.asarray(best.simulated.y),
        arguments=arguments,
        seen={n: Seen(a.mean(axis=0), a.std(axis=0)) for n, a in arguments.items()},
        history=history,
        seconds=trained.seconds,
        compile_seconds=trained.compiling,
        seconds_per_epoch=trained.updating / max(history.epochs, 1),
        interrupted=trained.interrupted,
        problem=problem,
        trained=best.trainable,
    )
