"""`fit`: train the networks and parameters of a model on measured data."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import optax
from jax.typing import DTypeLike
from numpy.typing import ArrayLike

from acausal.data import Data
from acausal.errors import need_compiled
from acausal.simulation import Solver
from acausal.training.objective.build_problem import Start
from acausal.training.objective.held_out import Validation
from acausal.training.objective.losses import Loss
from acausal.training.objective.modifiers import Modifier
from acausal.training.objective.regularizers import Regularizer
from acausal.training.objective.sharding import Device
from acausal.training.progress import Observer
from acausal.training.result import Fit
from acausal.training.train_from_starts import together

if TYPE_CHECKING:
    from acausal.system import System


def fit(
    system: System,
    data: Data | Mapping[str, ArrayLike],
    targets: Sequence[str],
    *,
    params: Mapping[str, Any] | None = None,
    train: Iterable[str] | None = None,
    modifiers: Mapping[str, float | Modifier] | Iterable[str] | None = None,
    gamma: float = 0.2,
    tolerances: Mapping[str, float] | None = None,
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
    validation: Validation = None,
    evaluate_every: int | None = None,
    patience: int | None = None,
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
        params: where to start: those of the model's parameters that are other than `system.parameters` gives them for
            ``seed``, from which networks are made.
        train: names of the networks to train; by default all.
        modifiers: parameters to train beside them, ``p̃ = (1 + γ tanh δ) p`` (the paper's (7), (8)): names, or
            by name a γ, an `acausal.Shift`, which also moves one that is 0, or bounds: an `acausal.Bounded`.
        gamma: the γ of modifiers without their own.
        tolerances: parameters that differ from run to run, with their deviations: the loss of a simulation is the mean
            over the model and those with one of these parameters a deviation more or less, so that other runs are
            followed, too.
        loss: ``"nrmse"``, the paper's (21), or a function (predicted, measured, sigma) -> scalar of shapes
            (M, k), (M, k), (k,); averaged over a batch's sequences.
        regularizers: penalties, such as `acausal.ZeroCrossing`; any function (params, context) -> scalar.
        sequence_length: in seconds; ``None`` takes the whole record at once.
        batch_size: sequences in each update.
        subsample: fraction of each sequence's points, drawn at random, that count in the loss.
        strategy: what to do, or several one after the other, each from where the one before was best:
            ``"sequences"`` as the arguments above say; ``"equation_error"``: targets computed from measured
            states without simulation, in a second or so, biased by noise; ``"whole_record"``: L-BFGS on the
            simulation of the whole record; ``"gauss_newton"``: damped Gauss-Newton steps (Levenberg-Marquardt) on it,
            for up to some 60 weights and parameters. ``("equation_error", "whole_record")`` is the fastest way where
            all states are measured, ``"whole_record"`` with ``x0="fit"`` where they are not.
        epochs: number of updates, or one for each part of the strategy; by default 1000 for sequences, 300 for
            the equation error, 200 for the whole record and 50 for Gauss-Newton.
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
        validation: what to hold out, by which the best is chosen: the last part of the record, such as 0.2 (predicted
            in one simulation from the record's start), or another record (which starts as ``x0`` says; with ``"fit"``
            from its own measured states).
        evaluate_every: updates between two evaluations over the whole record and what is held out, among which the
            best is returned; by default a tenth of the epochs.
        patience: evaluations without a better one after which a part of the strategy ends.
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
    need_compiled(system, "fit")
    (trained,) = together(
        system,
        data,
        targets,
        seeds=(seed,),
        params=({**system.parameters(seed), **(params or {})},),
        train=train,
        modifiers=modifiers,
        gamma=gamma,
        tolerances=tolerances,
        loss=loss,
        regularizers=regularizers,
        sequence_length=sequence_length,
        batch_size=batch_size,
        subsample=subsample,
        strategy=strategy,
        epochs=epochs,
        optimizer=optimizer,
        dt=dt,
        solver=solver,
        x0=x0,
        dtype=dtype,
        devices=devices,
        validation=validation,
        evaluate_every=evaluate_every,
        patience=patience,
        progress=progress,
        observers=observers,
        checkpoint=checkpoint,
        checkpoint_every=checkpoint_every,
        resume=resume,
    )
    return trained
