"""The options of a training: their names, types, defaults and meanings, written once for `fit` and `ensemble`.

All files of the room read `FitOptions`. `FitKeywords` repeats names and types, because a type checker takes the
keywords of a function only from a `TypedDict`; a test compares the two.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, TypedDict, TypeVar, cast

import numpy as np
import optax
from jax.typing import DTypeLike

from acausal._jax import is_number, traced
from acausal.errors import TrainingError, known_name, nearest, need_flag, need_whole, shown
from acausal.files import need_path
from acausal.jobs import Workers, need_workers
from acausal.simulation import Solver
from acausal.training.objective.error_laws import ErrorLaw
from acausal.training.objective.held_out import Validation
from acausal.training.objective.initial_state import InitialState
from acausal.training.objective.losses import Loss
from acausal.training.objective.modifiers import Modifier
from acausal.training.objective.prior import Earlier
from acausal.training.objective.regularizers import Regularizer
from acausal.training.objective.sharding import Device
from acausal.training.objective.timing import Delay, Lag
from acausal.training.objective.weighting import RecordWeights, Weight
from acausal.training.progress import Observer

UPDATES = {
    "auto": 200,
    "sequences": 1000,
    "equation_error": 300,
    "whole_record": 200,
    "gauss_newton": 50,
}
"""The parts that a strategy is made of, and how many updates each makes by default."""

OF_SEQUENCES = ("sequence_length", "batch_size", "subsample", "optimizer")
"""Options that only sequences have: where one is given, ``"auto"`` means ``"sequences"``."""


def _is_number(value: Any) -> bool:
    return is_number(value) and not traced(value) and not isinstance(value, bool | np.bool_)


def _are(one: Callable[[Any], bool], values: Any) -> bool:
    """Whether they are some of that kind; what can be read only once is taken as it is."""
    try:
        found = iter(values)
    except TypeError:
        return False
    return isinstance(values, Iterator) or all(map(one, found))


def _are_many(values: Any) -> bool:
    return _are(lambda value: True, values) and not isinstance(values, str)


def _are_texts(values: Any) -> bool:
    return _are(lambda value: isinstance(value, str), values)


def _is_optimizer(value: Any) -> bool:
    return not isinstance(value, type) and hasattr(value, "init") and hasattr(value, "update")


DEVIATIONS = "standard deviations by name, such as {'mass.m': 0.1}"
KINDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "train": (_are_texts, "names of networks"),
    "modifiers": (_are_texts, "names of parameters, nor modifiers by name"),
    "gamma": (_is_number, "a number"),
    "per_record": (lambda v: isinstance(v, Mapping), DEVIATIONS),
    "delays": (lambda v: isinstance(v, Mapping), "delays by name, such as {'motor.w': 0.01}"),
    "lags": (lambda v: isinstance(v, Mapping), "time constants by name, such as {'motor.w': 0.01}"),
    "parameter_spread": (lambda v: isinstance(v, Mapping), DEVIATIONS),
    "loss": (
        lambda v: isinstance(v, str | ErrorLaw) or callable(v),
        "a loss, by name or as a function",
    ),
    "record_weights": (lambda v: isinstance(v, str | Mapping), "a text, nor factors by name"),
    "sample_weights": (lambda v: isinstance(v, Mapping), "weights by target"),
    "regularizers": (lambda v: callable(v) or _are_many(v), "a function, nor several"),
    "prior": (
        lambda v: hasattr(v, "confidence") and hasattr(v, "params"),
        "the result of a training",
    ),
    "sequence_length": (
        lambda v: _is_number(v) or (isinstance(v, str) and v == "auto"),
        "a number of seconds",
    ),
    "subsample": (_is_number, "a fraction"),
    "strategy": (
        lambda v: isinstance(v, str | Sequence) and _are_texts(v),
        "a strategy, nor several: give their names",
    ),
    "optimizer": (_is_optimizer, "an optax optimizer; give one such as optax.adam(0.01)"),
    "rtol": (_is_number, "a number"),
    "atol": (_is_number, "a number"),
    "x0": (lambda v: isinstance(v, str | Mapping), "a text, nor values by name"),
    "devices": (_are_many, "devices; give some of jax.devices()"),
    "observers": (_are_many, "several functions"),
    "checkpoint_every": (_is_number, "a number of seconds"),
}
"""What the values of options must be, in words for a message."""

FLAGS = ("progress", "resume")
"""Options that are truth values."""

COUNTS = ("batch_size", "starts", "evaluate_every", "patience")
"""Options that are whole numbers from 1."""

OWN_OPTIMIZER = {
    "auto": "L-BFGS or Levenberg-Marquardt",
    "whole_record": "L-BFGS",
    "gauss_newton": "Levenberg-Marquardt",
}
"""Parts of a strategy that take no other optimizer."""

OPTIONS = "options: see `acausal.training.FitOptions`, each by its name"
"""A line in the documentation of functions with options, in whose place `help` shows all of them."""


class FitKeywords(TypedDict, total=False):
    """The keywords of `acausal.fit` for type checkers; see `FitOptions`."""

    train: Iterable[str] | None
    modifiers: Mapping[str, float | Modifier] | Iterable[str] | None
    gamma: float | None
    parameter_spread: Mapping[str, float] | None
    per_record: Mapping[str, float | None] | None
    delays: Mapping[str, float | Delay] | None
    lags: Mapping[str, float | Lag] | None
    loss: str | Loss | ErrorLaw
    record_weights: RecordWeights
    sample_weights: Mapping[str, Weight] | None
    regularizers: Regularizer | Iterable[Regularizer]
    prior: Earlier | None
    sequence_length: float | Literal["auto"] | None
    batch_size: int | None
    subsample: float | None
    starts: int
    strategy: str | Sequence[str]
    epochs: int | Sequence[int] | None
    optimizer: optax.GradientTransformation | None
    dt: float | None
    solver: str | Solver | None
    rtol: float | None
    atol: float | None
    x0: InitialState
    dtype: DTypeLike
    devices: Sequence[Device] | None
    validation: Validation
    evaluate_every: int | None
    patience: int | None
    progress: bool
    observers: Iterable[Observer]
    checkpoint: str | Path | None
    checkpoint_every: float
    resume: bool
    executor: Workers | None


@dataclass(frozen=True, kw_only=True, eq=False)
class FitOptions:
    """The options of `acausal.fit` and `acausal.ensemble`, each given there by its name.

    Attributes:
        train: names of the networks to train; by default all.
        modifiers: parameters to train besides them: names, which are free within the bounds that the parameters
            declare (positive ones by any factor), or by name a γ, which bounds ``p̃ = (1 + γ tanh δ) p`` (the paper's
            (7), (8)), an `acausal.Shift`, which also moves one that is 0, or bounds: an `acausal.Bounded`.
        gamma: the γ of modifiers without their own, such as 0.2; by default they are free.
        parameter_spread: parameters that differ from run to run, with their standard deviations: the loss of a
            simulation is the mean over the model and those with one of these parameters a deviation higher or lower,
            within the bounds that it declares, so that the model follows other runs, too.
        per_record: parameters with a value for each record, such as an offset or a friction that changes from day to
            day: by name the standard deviation from record to record, which ties the values to the common one, or
            ``None`` for free values. Unlike a `parameter_spread`, which makes the model follow runs that nobody has
            measured, it finds the values of the runs that are measured.
        delays: by input or target, how late it is: an `acausal.Delay`, which is trained, or seconds. The model sees an
            input ``u(t - τ)`` as the record interpolates it (before its start, the first value); of a target
            ``y(t - τ)`` of the prediction is compared. `Fit.delays` has the result. An input with the interpolation
            "previous" jumps, so that its delay can only be given.
        lags: by target, the time constant of its sensor's first-order lag: an `acausal.Lag`, which is trained, or
            seconds. A record starts at rest. The lag comes before a delay. `Fit.lags` has the result.
        loss: ``"nrmse"``, the paper's (21), or a function (predicted, measured, sigma) or (predicted, measured, sigma,
            weight) -> scalar of shapes (M, k), (M, k), (k,), (M, k); averaged over a batch's sequences. The weight is
            zero where nothing is measured. ``"likelihood"``: maximum likelihood of normal errors, in which each target
            counts by its noise, as estimated or given by `acausal.Likelihood`; ``"huber"`` and ``"student"``, or
            `acausal.Huber` and `acausal.Student`, tolerate outliers. Sequences estimate the noise each for itself, from
            some dozens of samples or more.
        record_weights: ``"samples"``: all samples count equally; ``"records"``: all records do, however long they are;
            or factors of their samples' weights by name of a record, 1 where there is none.
        sample_weights: by target a factor, or a function of time [s] that gives the weight of a sample then; 0 leaves
            it out. Only the ratios of all weights matter. Sequences are drawn as often as their samples count.
        regularizers: penalties, such as `acausal.ZeroCrossing`; any function (params, context) -> scalar.
        prior: an earlier fit, when new data come without the old ones: what it knew about laws and trained parameters
            (its `Fit.confidence`) is the prior of this training, which starts from its parameters. Directions that the
            new data leave open stay as they were. Train the same parameters again; those left out stay fixed.
        sequence_length: in seconds; ``None`` takes all of every record at once. ``"auto"`` is 50 samples where
            sequences can begin from measured states, else ``None``; a strategy that names ``"sequences"`` has it by
            default.
        batch_size: sequences in each update; by default 1, and 16 of those 50 samples.
        subsample: fraction of each sequence's points, drawn at random, that count in the loss.
        starts: starting points of the trained parameters: the given one, and others spread over their modifiers'
            ranges (evenly between bounds, and over decades where these are a decade apart). After 0.3 of the updates
            the best quarter goes on, after 0.6 a quarter of these; the best is returned, and ``fit.starts`` tells how
            many reached it. Networks start the same each time.
        strategy: what to do, or several parts one after the other, each from where the one before was best:
            ``"auto"`` finds scales and a linear law for every network that has no scales, the method and the length of
            the steps, and the parts from the data (`Fit.stages`); with an option of sequences it is ``"sequences"``.
            ``"sequences"`` as the options above say; ``"equation_error"``: targets computed from measured
            states without simulation, in a second or so, biased by noise; ``"whole_record"``: L-BFGS on the
            simulation of the whole record; ``"gauss_newton"``: damped Gauss-Newton steps (Levenberg-Marquardt) on it,
            for up to some 60 weights and parameters. ``("equation_error", "whole_record")`` is the fastest way where
            all states are measured, ``"whole_record"`` with ``x0="fit"`` where they are not.
        epochs: number of updates, or one for each part of the strategy; by default 1000 for sequences, 300 for
            the equation error, 200 for the whole record and 50 for Gauss-Newton.
        optimizer: of sequences: any optax optimizer; by default Adam, its rate falling from 0.01 to 0.0001 as a
            cosine.
        dt: step of the integration in seconds, a whole part of the sample time (the default).
        solver: of the fixed steps, by name or a diffrax solver; by default chosen by measurement with
            ``strategy="auto"``, else ``"heun"``. ``"auto"`` and ``"bdf"`` choose their steps, and any
            solver with an error estimate does if ``rtol`` or ``atol`` is given. Such steps end at every sample of a
            model with inputs. ``"stiff"`` is BDF, and Kvaerno3 with ``dt``.
        rtol: relative tolerance of adaptive steps, 1e-6 by default.
        atol: absolute tolerance of adaptive steps in the states' units, 1e-8 by default.
        x0: state at a record's start, for sequences that begin there and for the loss over the whole record.
            ``"auto"``: what is measured, within its noise, and the model's start values of other states, within their
            size, are the prior of states that the training finds; ``print(fit)`` tells of them. What no record
            measures and the model fixes is exact where a record begins at time 0. ``"data"`` exactly as
            measured, ``"model"`` as the model starts, ``"steady"`` at rest with the inputs at the start, or values by
            name that replace the measured ones; others are found. By record: ``{"run 1": "data", "run 2": {...}}``.
            ``"fit"``: found by the training, for the record and, tied by continuity, for each of the sequences, which
            then lie side by side (multiple shooting). No state need be measured. Discrete variables that events
            remember begin as given or measured; truth values, with "auto" and "fit", as the first samples show.
        dtype: precision of the integration, float64 or float32; weights, losses and the optimizer stay in double.
        devices: which share the sequences of every batch, such as ``jax.devices()``; ``batch_size`` is a
            multiple of their number. By default JAX's default device alone.
        validation: what to hold out, which chooses the best: the last part of every record, such as 0.2 (predicted
            in one simulation from the record's start), names of records, or other records (which start as ``x0`` says;
            with ``"fit"`` from their own measured states, and as the model starts where these are not measured).
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
        executor: whose workers train the members, folds or starts, each alone to its own end: any
            `concurrent.futures.Executor`, or a function that makes one; by default this process trains all of them in
            one program. Of several starts, all go on to the end then. Each has a checkpoint of its own, from which it
            goes on if its worker is lost: ``checkpoint="run.safetensors"`` gives ``run-0.safetensors`` and so on, in a
            folder that all workers share. After Ctrl-C, nothing is returned.
    """

    train: Iterable[str] | None = None
    modifiers: Mapping[str, float | Modifier] | Iterable[str] | None = None
    gamma: float | None = None
    parameter_spread: Mapping[str, float] | None = None
    per_record: Mapping[str, float | None] | None = None
    delays: Mapping[str, float | Delay] | None = None
    lags: Mapping[str, float | Lag] | None = None
    loss: str | Loss | ErrorLaw = "nrmse"
    record_weights: RecordWeights = "samples"
    sample_weights: Mapping[str, Weight] | None = None
    regularizers: Regularizer | Iterable[Regularizer] = ()
    prior: Earlier | None = None
    sequence_length: float | Literal["auto"] | None = None
    batch_size: int | None = None
    subsample: float | None = None
    starts: int = 1
    strategy: str | Sequence[str] = "auto"
    epochs: int | Sequence[int] | None = None
    optimizer: optax.GradientTransformation | None = None
    dt: float | None = None
    solver: str | Solver | None = None
    rtol: float | None = None
    atol: float | None = None
    x0: InitialState = "auto"
    dtype: DTypeLike = np.float64
    devices: Sequence[Device] | None = None
    validation: Validation = None
    evaluate_every: int | None = None
    patience: int | None = None
    progress: bool = True
    observers: Iterable[Observer] = ()
    checkpoint: str | Path | None = None
    checkpoint_every: float = 60.0
    resume: bool = False
    executor: Workers | None = None

    @staticmethod
    def of(function: str, given: Mapping[str, Any]) -> FitOptions:
        """The options from the keywords of a public function; to be called in that function.

        Raises:
            TypeError: for an unknown keyword.
            TrainingError: for a value that does not fit any training.
        """
        known = [f.name for f in fields(FitOptions)]
        for name in given:
            if name not in known:
                raise TypeError(f"{function} has no argument '{name}': {nearest(name, known)}")
        chosen = FitOptions(**given)
        named = chosen.strategy != "auto" and "sequences" in chosen.parts
        if named and "sequence_length" not in given:
            return replace(chosen, sequence_length="auto")
        return chosen

    def __post_init__(self) -> None:
        """Check what can be checked without a model and data.

        Raises:
            TrainingError: for a value that does not fit any training.
        """
        for name, (fits, wanted) in KINDS.items():
            value = getattr(self, name)
            left_out = value is None and FitOptions.__dataclass_fields__[name].default is None
            if not (left_out or fits(value)):
                raise TrainingError(f"{name}={shown(value)} is not {wanted}.")
        if self.executor is not None:
            need_workers(self.executor, "training", TrainingError)
            for name in ("devices", "observers"):
                if getattr(self, name):
                    raise TrainingError(
                        f"{name}= needs a training in this process, but executor= trains on workers: leave out one."
                    )
        if self.checkpoint is not None:
            need_path(self.checkpoint, "checkpoint", TrainingError)
        for name in FLAGS:
            object.__setattr__(self, name, need_flag(getattr(self, name), name, TrainingError))
        for name in COUNTS:
            if (count := getattr(self, name)) is not None or name == "starts":
                # NumPy's numbers become Python's, which do not overflow
                object.__setattr__(self, name, need_whole(count, name, TrainingError, 1))
        for function in (*self.penalties, *self.all_observers):
            if not callable(function):
                raise TrainingError(
                    f"{shown(function)} is not a function, but the training calls it."
                )
        if "auto" in self.parts and len(self.parts) > 1:
            raise TrainingError("strategy='auto' chooses all parts itself; give it alone.")
        for name in self.parts:
            known_name(name, UPDATES, "No strategy", TrainingError)
        if self.optimizer is not None and all(name in OWN_OPTIMIZER for name in self.parts):
            named = ", then ".join(self.parts)
            raise TrainingError(
                f"optimizer= is for sequences, but the strategy is {named}, which has its own: leave it out."
            )
        if self.starts > 1 and self.devices is not None:
            raise TrainingError("Several starts are trained on one device: leave out devices=.")
        if not self.parts or len(self.updates) != len(self.parts):
            raise TrainingError(
                f"epochs={self.epochs} for the strategy {self.parts}: give one number, or one for each part."
            )

    def described(self) -> dict[str, str]:
        """The options that say how a training was done, as texts by name: those given, and the most important ones."""
        found = {
            "strategy": ", then ".join(self.parts),
            "updates": ", ".join(map(str, self.updates)),
        }
        found["optimizer"] = _name_of_optimizer(self)
        for name in fields(self):
            value = getattr(self, name.name)
            important = name.name in ("loss", "solver")
            if name.name in _NOT_DESCRIBED or not (important or value is not name.default):
                continue
            found[name.name] = _in_words(value)
        return found

    @cached_property
    def penalties(self) -> tuple[Regularizer, ...]:
        """The regularizers, also if a single one is given."""
        given = self.regularizers
        return (given,) if callable(given) else tuple(given)

    @cached_property
    def all_observers(self) -> tuple[Observer, ...]:
        """The observers."""
        return tuple(self.observers)

    @cached_property
    def parts(self) -> tuple[str, ...]:
        """The parts of the strategy."""
        if self.strategy == "auto" and any(getattr(self, n) is not None for n in OF_SEQUENCES):
            return ("sequences",)
        return (self.strategy,) if isinstance(self.strategy, str) else tuple(self.strategy)

    @property
    def automatic(self) -> bool:
        """Whether the stages are chosen from the data."""
        return self.parts == ("auto",)

    @cached_property
    def updates(self) -> tuple[int, ...]:
        """How many updates each part makes at most."""
        if self.epochs is None:
            return tuple(UPDATES[name] for name in self.parts)
        several = _are_many(self.epochs) and np.ndim(self.epochs) > 0
        counts = cast(Any, self.epochs if several else (self.epochs,) * len(self.parts))
        return tuple(need_whole(count, "epochs", TrainingError, 1) for count in counts)


_NOT_DESCRIBED = (
    "train", "modifiers", "strategy", "epochs", "optimizer", "devices", "progress", "observers", "checkpoint",
    "checkpoint_every", "resume", "executor",
)  # fmt: skip
"""Options that change nothing of the result, or that are told otherwise."""


def _name_of_optimizer(options: FitOptions) -> str:
    if options.optimizer is not None:
        return "of the user (optax)"
    adam = "Adam, its rate falling from 0.01 to 0.0001 as a cosine"
    return ", then ".join(OWN_OPTIMIZER.get(part, adam) for part in options.parts)


def _in_words(value: Any) -> str:
    """A value of an option as a text without addresses of memory."""
    if isinstance(value, str | bool | int | float):
        return str(value)
    if isinstance(value, Mapping):
        return ", ".join(f"{n}: {_in_words(v)}" for n, v in cast(Mapping[str, Any], value).items())
    if isinstance(value, tuple | list):
        return ", ".join(map(_in_words, cast(Sequence[Any], value)))
    name = getattr(value, "__name__", type(value).__name__)
    return name if " at 0x" in repr(value) or len(repr(value)) > 80 else repr(value)


Function = TypeVar("Function", bound=Callable[..., Any])


def documented(function: Function) -> Function:
    """The same function with every option in its signature and documentation at run time, for `help` and notebooks."""
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    options = inspect.signature(FitOptions).parameters.values()
    vars(function)["__signature__"] = signature.replace(parameters=[*own, *options])
    head, line, tail = (function.__doc__ or "").partition(OPTIONS)
    listed = (FitOptions.__doc__ or "").partition("Attributes:\n")[2].rstrip()
    if line and listed:
        function.__doc__ = f"{head}{listed.lstrip()}{tail[1:]}"
    return function
