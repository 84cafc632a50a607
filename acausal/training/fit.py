"""`fit`: train the networks and parameters of a model on measured data."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import numpy as np
import optax
from jax.typing import DTypeLike
from numpy.typing import ArrayLike

from acausal.data import Data
from acausal.distilled import Distilled, distill
from acausal.errors import TrainingError, nearest
from acausal.neural import remove_offset
from acausal.simulation.solvers import Solver
from acausal.training import checkpoint as checkpoints
from acausal.training.confidence import Confidence, confidence
from acausal.training.fingerprint import fingerprint
from acausal.training.history import History
from acausal.training.loop import Trained
from acausal.training.loop import train as run
from acausal.training.losses import Loss
from acausal.training.page import write_page
from acausal.training.pose import Start, pose
from acausal.training.problem import Problem, Trainable, modified
from acausal.training.progress import Observer, display
from acausal.training.regularizers import Regularizer
from acausal.training.residuals import Residuals, residuals
from acausal.training.spread import Device, local
from acausal.training.strategy import legs

if TYPE_CHECKING:
    from acausal.system import System

DIVERGED = 1e3
"""A sequence whose normalised error is larger has diverged."""


def fit(
    system: System,
    data: Data | Mapping[str, ArrayLike],
    targets: Sequence[str],
    *,
    params: Mapping[str, Any] | None = None,
    train: Iterable[str] | None = None,
    modifiers: Mapping[str, float] | Iterable[str] | None = None,
    gamma: float = 0.2,
    loss: str | Loss = "nrmse",
    regularizers: Iterable[Regularizer] = (),
    sequence_length: float | None = None,
    batch_size: int = 1,
    subsample: float | None = None,
    strategy: str | Sequence[str] = "sequences",
    epochs: int | Sequence[int] | None = None,
    optimizer: optax.GradientTransformation | None = None,
    dt: float | None = None,
    solver: str | Solver = "heun",
    x0: Start | Mapping[str, float] = "data",
    dtype: DTypeLike = np.float64,
    devices: Sequence[Device] | None = None,
    seed: int = 0,
    evaluate_every: int | None = None,
    progress: bool = True,
    observers: Sequence[Observer] = (),
    checkpoint: str | Path | None = None,
    checkpoint_every: float = 60.0,
    resume: bool = False,
) -> Fit:
    """Train networks and parameters of a model so that its outputs follow a measured record.

    Every update takes a batch of random sequences that start from measured states (or the whole record),
    integrates the model over them in fixed steps, and moves along the gradient of the loss. All updates run in one
    compiled program. A sequence that diverges is left out, told in the history, and harms nothing.

    Arguments:
        system: a compiled model.
        data: a record with all inputs and targets of the model, and its states where sequences start from them.
        targets: the variables to fit, measured in the data.
        params: where to start, as `system.parameters` gives them; by default with networks made from ``seed``.
        train: names of the networks to train; by default all.
        modifiers: parameters to train beside them, ``p̃ = (1 + γ tanh δ) p`` (the paper's (7), (8)): names, or
            a γ by name.
        gamma: the γ of modifiers without their own.
        loss: ``"nrmse"``, the paper's (21), or a function (predicted, measured, sigma) -> scalar of shapes
            (M, k), (M, k), (k,); averaged over a batch's sequences.
        regularizers: penalties, see `acausal.training.regularizers`; any function (params, context) -> scalar.
        sequence_length: in seconds; ``None`` takes the whole record at once.
        batch_size: sequences in each update.
        subsample: fraction of each sequence's points, drawn at random, that count in the loss.
        strategy: what to do, or several one after the other, each from where the one before was best:
            ``"sequences"`` as the arguments above say; ``"equation_error"``: targets computed from measured
            states without simulation, in a second or so, biased by noise; ``"whole_record"``: L-BFGS on the
            simulation of the whole record. ``("equation_error", "whole_record")`` is the fastest way where all
            states are measured, ``"whole_record"`` with ``x0="fit"`` where they are not.
        epochs: number of updates, or one for each part of the strategy; by default 1000 for sequences, 300 for
            the equation error and 200 for the whole record.
        optimizer: of sequences: any optax optimizer; by default Adam, its rate falling from 0.01 to 0.0001 as a
            cosine.
        dt: step of the integration in seconds, a whole part of the sample time (the default).
        solver: of the fixed steps, by name or a diffrax solver.
        x0: state at the record's start, for sequences that begin there and for the loss over the whole record:
            ``"data"`` as measured, ``"model"`` as the model starts, or values by name that replace the measured ones.
            ``"fit"``: found by the training, for the record and, tied by continuity, for each of the sequences, which
            then lie side by side (multiple shooting). No state need be measured.
        dtype: precision of the integration, float64 or float32; weights, losses and the optimizer stay in double.
        devices: that the sequences of every batch are spread over, such as ``jax.devices()``; ``batch_size`` is a
            multiple of their number. By default JAX's default device alone.
        seed: of the networks, the sequences and the points. The same seed gives the same result.
        evaluate_every: updates between two evaluations over the whole record, among which the best is
            returned; by default a tenth of the epochs.
        progress: whether to show progress, if there is a terminal or a notebook.
        observers: called with a `Progress` about twice a second.
        checkpoint: a file ``….safetensors``, or a folder for it, that holds all of the training: written before the
            first update, then at intervals and at the end, also after Ctrl-C; never half.
        checkpoint_every: seconds between two writings.
        resume: whether to go on from the checkpoint if there is one; all other arguments must be as they were. The
            training ends where it would have ended without the break, bit for bit on the same machine.

    Returns:
        The best of the training, also after Ctrl-C.

    Raises:
        DataError: if the data do not fit the model, or the checkpoint is damaged or of another training.
        TrainingError: if there is nothing to train, the training cannot go on, or no checkpoint can be written.
    """
    problem = pose(
        system,
        Data.of(data).for_system(system),
        (targets,) if isinstance(targets, str) else tuple(targets),
        dict(system.parameters(seed) if params is None else params),
        train=train,
        modifiers=modifiers,
        gamma=gamma,
        loss=loss,
        regularizers=tuple(regularizers),
        sequence_length=sequence_length,
        batch_size=batch_size,
        subsample=subsample,
        dt=dt,
        solver=solver,
        x0=x0,
        dtype=dtype,
        devices=devices,
    )
    limit = DIVERGED if loss == "nrmse" else np.inf
    plan = legs(problem, strategy, epochs, evaluate_every, optimizer, limit)
    first = jax.process_index() == 0
    identity = fingerprint(problem, plan, seed)
    path, stored = _checkpoint(checkpoint, resume, identity)
    with (
        display(progress and first, sum(leg.epochs for leg in plan)) as show,
        checkpoints.keeping(path if first else None, checkpoint_every, identity) as keep,
    ):
        trained = run(problem, plan, jax.random.key(seed), (show, *observers), keep, stored)
    _warn(trained)
    return _result(problem, trained)


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
        best_epoch: updates after which ``params`` were reached.
        x0: the state at the record's start, by name.
        modifiers: relative change p̃/p − 1 of every parameter that was trained.
        seen: by network, the statistics of what it was called with.
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
    best_epoch: int
    x0: dict[str, float]
    modifiers: dict[str, float]
    seen: dict[str, Seen]
    history: History
    seconds: float
    compile_seconds: float
    seconds_per_epoch: float
    interrupted: bool
    problem: Problem
    trained: Trainable

    def confidence(self) -> Confidence:
        """How well the record determines the learned laws and the trained parameters."""
        return confidence(self.problem, self.trained, self._arguments)

    def residuals(self) -> tuple[Residuals, ...]:
        """What the trained model leaves over of every target."""
        record, inputs = self.problem.record, self.system.inputs
        left = np.asarray(record.y - self.predicted)
        u = np.asarray(record.steps.inputs.start)
        drivers = {n: u[:, i] for i, n in enumerate(inputs)}
        return tuple(residuals(n, left[:, i], drivers) for i, n in enumerate(self.problem.targets))

    @cached_property
    def predicted(self) -> np.ndarray:
        """The targets in one simulation of the record, shape (N, number of targets)."""
        return np.asarray(_predict(self.problem, self.trained))

    @cached_property
    def predicted_before(self) -> np.ndarray:
        """The same before training."""
        return np.asarray(_predict(self.problem, self.problem.start()))

    def samples(self, network: str, most: int = 400) -> np.ndarray:
        """Some of the values that a network's first argument had over the record, at most so many."""
        values = np.asarray(self._arguments[network])[:, 0]
        return values[:: max(1, len(values) // most)]

    @cached_property
    def _arguments(self) -> dict[str, Any]:
        _, x = self.problem.simulate(self.trained)
        return self.problem.seen(self.trained, x)

    def distill(self, network: str, sigmas: float = 2.0, **wishes: Any) -> Distilled:
        """A short formula for a learned law of one variable, over ``mean ± sigmas · σ`` of what it has seen.

        Arguments:
            network: its name, such as ``"damper.net"``.
            sigmas: how far the formula reaches.
            wishes: further arguments of `acausal.distill`.
        """
        if network not in self.seen:
            raise TrainingError(
                f"There is no trained network '{network}': {nearest(network, self.seen)}"
            )
        low, high = self.seen[network].interval(sigmas)
        return distill(self.params[network], float(low[0]), float(high[0]), **wishes)

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
        lines += [f"  modifiers {changes}"] if changes else []
        diverged = self.history.divergences
        lines += (
            [f"  diverged  in {len(diverged)} epochs, see history.divergences"] if diverged else []
        )
        return "\n".join(lines)


def _checkpoint(
    path: str | Path | None, resume: bool, identity: Mapping[str, str]
) -> tuple[Path | None, checkpoints.Stored | None]:
    """Where to write checkpoints, and the one to go on from."""
    if path is None:
        if resume:
            raise TrainingError("resume=True needs a checkpoint to go on from: checkpoint='...'.")
        return None, None
    file = checkpoints.place(path)
    if not file.exists():
        return file, None
    if not resume:
        raise TrainingError(
            f"There is a checkpoint '{file}' already: resume=True goes on from it; "
            "to begin anew, remove it or name another file."
        )
    return file, checkpoints.read(file, identity)


def _result(problem: Problem, trained: Trained) -> Fit:
    best, history = local(trained.best, problem.mesh), trained.history
    problem = replace(problem, mesh=None)
    seen = problem.seen(best.trainable, best.x)
    statistics = {
        n: Seen(np.mean(seen[n], axis=0), np.std(seen[n], axis=0)) for n in problem.networks
    }
    return Fit(
        system=problem.system,
        params=problem.assemble(best.trainable),
        loss=best.loss,
        loss_before=float(history.full_loss[0, 1]),
        best_epoch=best.epoch,
        x0=dict(zip(problem.system.states, best.x[0].tolist(), strict=True)),
        modifiers={n: float(value) for n, value in modified(problem, best.trainable).items()},
        seen=statistics,
        history=history,
        seconds=trained.seconds,
        compile_seconds=trained.compiling,
        seconds_per_epoch=trained.updating / max(history.epochs, 1),
        interrupted=trained.interrupted,
        problem=problem,
        trained=best.trainable,
    )


@eqx.filter_jit
def _predict(problem: Problem, trainable: Trainable) -> Any:
    return problem.predict(trainable, problem.assemble(trainable))


def _warn(trained: Trained) -> None:
    diverged = trained.history.divergences
    if diverged:
        warnings.warn(
            f"Something diverged in {len(diverged)} of {trained.history.epochs} epochs and was left out "
            f"(fit.history.divergences); first, {diverged[0]}.",
            stacklevel=3,
        )
    if not np.isfinite(trained.best.loss):
        warnings.warn(
            "The trained model diverges over the whole record: its loss is infinite.", stacklevel=3
        )
