"""`fit`: train the networks and parameters of a model on measured data."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
from jax import Array
from jax.typing import ArrayLike

from acausal import losses, solvers
from acausal.data import Data
from acausal.errors import DataError, TrainingError, listing, nearest
from acausal.history import History
from acausal.modifiers import modifiers
from acausal.neural import networks, remove_offset
from acausal.problem import Problem, Trainable, modified
from acausal.progress import Observer, display
from acausal.record import Record, lay_out, sequences
from acausal.regularizers import Context, Regularizer, label
from acausal.trainer import Trainer, begin
from acausal.training import Trained, train

if TYPE_CHECKING:
    from acausal.system import System

DIVERGED = 1e3
"""A sequence whose normalised error is larger has diverged."""

REFERENCE_POINTS = 1000
"""Points of the record at which regularizers look at networks."""

Start = Literal["data", "model"]


def fit(
    system: System,
    data: Data | Mapping[str, ArrayLike],
    targets: Sequence[str],
    *,
    params: Mapping[str, Any] | None = None,
    train: Iterable[str] | None = None,
    modifiers: Mapping[str, float] | Iterable[str] | None = None,
    gamma: float = 0.2,
    loss: str | losses.Loss = "nrmse",
    regularizers: Iterable[Regularizer] = (),
    sequence_length: float | None = None,
    batch_size: int = 1,
    subsample: float | None = None,
    epochs: int = 1000,
    optimizer: optax.GradientTransformation | None = None,
    dt: float | None = None,
    solver: str | solvers.Solver = "heun",
    x0: Start | Mapping[str, float] = "data",
    seed: int = 0,
    evaluate_every: int | None = None,
    progress: bool = True,
    observers: Sequence[Observer] = (),
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
        modifiers: parameters to train beside them, ``p̃ = (1 + γ tanh δ) p`` (the paper's (7), (8)): names, or a γ by
            name. ``gamma``: the γ of those without their own.
        loss: ``"nrmse"``, the paper's (21), or a function (predicted, measured, sigma) -> scalar of shapes
            (M, k), (M, k), (k,); averaged over a batch's sequences.
        regularizers: penalties, see `acausal.regularizers`; any function (params, context) -> scalar.
        sequence_length: in seconds; ``None`` takes the whole record at once.
        batch_size: sequences in each update.
        subsample: fraction of each sequence's points, drawn at random, that count in the loss.
        epochs: number of updates.
        optimizer: any optax optimizer; by default Adam, its rate falling from 0.01 to 0.0001 as a cosine.
        dt: step of the integration in seconds, a whole part of the sample time (the default).
        solver: of the fixed steps, by name or a diffrax solver.
        x0: state at the record's start, for sequences that begin there and for the loss over the whole record:
            ``"data"`` as measured, ``"model"`` as the model starts, or values by name that replace the measured ones.
        seed: of the networks, the sequences and the points. The same seed gives the same result.
        evaluate_every: updates between two evaluations over the whole record, among which the best is
            returned; by default a tenth of the epochs.
        progress: whether to show progress, if there is a terminal or a notebook.
        observers: called with a `Progress` about twice a second.

    Returns:
        The best of the training, also after Ctrl-C.

    Raises:
        DataError: if the data do not fit the model; one sentence says where.
        TrainingError: if there is nothing to train or the training cannot go on.
    """
    if epochs < 1:
        raise TrainingError(f"epochs={epochs}; at least one is needed.")
    problem = _problem(
        system,
        Data.of(data).for_system(system),
        (targets,) if isinstance(targets, str) else tuple(targets),
        dict(system.parameters(seed) if params is None else params),
        _Choice(train, modifiers, gamma, loss, tuple(regularizers), x0),
        _Cut(sequence_length, batch_size, subsample),
        _Scheme(dt, solver),
    )
    chosen = _default_optimizer(epochs) if optimizer is None else optimizer
    method = Trainer(optax.with_extra_args_support(chosen), DIVERGED if loss == "nrmse" else np.inf, modified)
    state = begin(method, problem.start(), jax.random.key(seed))
    every = max(1, epochs // 10) if evaluate_every is None else evaluate_every
    with display(progress, epochs) as show:
        trained = _train(problem, method, state, epochs, every, (show, *observers))
    _warn(trained)
    return _result(problem, trained)
