"""What ``strategy="auto"`` chooses from the data: scales, a linear start, steps of the integration, and stages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from acausal.data import Data
from acausal.errors import percent
from acausal.networks import Affine, LawShape, Scales, lacks_scales, linear_shape, with_scales
from acausal.training.auto.linear_start import (
    LinearStart,
    linear_module,
    linear_start,
    with_constants_at_zero,
)
from acausal.training.auto.step_choice import StepChoice, chosen_steps, tried_steps
from acausal.training.build_problem import build_problem, trained_networks
from acausal.training.objective.input_gains import gains, in_words, to_check, with_gain
from acausal.training.objective.losses import noise_loss
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.options import UPDATES, FitOptions
from acausal.training.strategy import EVALUATIONS, Stage

if TYPE_CHECKING:
    from acausal.system import System

PEAK = 4.0
"""A law's argument counts by its standard deviation: peaks are rare. They are so many times as large at most."""

MOST = 4000
"""Rows of the part of the records in which the linear start is sought."""

EXPLAINS = 0.5
"""The linear start explains a record if it leaves less than this part of the targets' deviation."""

ALMOST = 0.2
"""Where nothing can begin within records, it is sought over ever shorter beginnings until it leaves less than this."""

FEWEST = 12
"""A start that leaves the records sooner is sought over so many first samples."""

PIECE, PIECES = 25, 60
"""Samples of the pieces of records in which it is sought where it explains nothing; and how many pieces."""

CLOSE, GOOD = 1.0, 1.1
"""A fit with a loss below this many times that of the noise is not trained longer, or not in any other way."""

FEW = 60
"""Up to so many numbers are trained by Gauss-Newton."""

WINDOWS = 100
"""Updates over windows."""

GROWS, GROWS_AT_EVENTS = 2.0, 1.4
"""So many times as long is the next beginning of records; less in models with events, where one too late stays so."""

LONGER = 4
"""So many times the updates of `UPDATES` more over whole records, above the noise and while they gain something."""

GAIN, NATS = 2e-3, 0.5
"""A stage over whole records ends when its loss has not fallen by this part since the last evaluation, or by less where
so small a part raises the logarithm of the likelihood of all samples by more than this."""


GAINS, LOOKED_AT = (-1.0, 1e3, 1e-3), 3
"""By what inputs are multiplied to see whether they were misread; and how many inputs."""


class Misread(NamedTuple):
    """An input with which linear laws explain records if it is multiplied by a number: what they leave, and of what."""

    name: str
    gain: float
    loss: float
    level: float

    def __str__(self) -> str:
        """What to check."""
        return (
            f"If {in_words(self.name, self.gain)}, linear laws alone would leave {percent(self.loss / self.level)} of "
            f"the targets, less than what was trained: {to_check(self.gain)}."
        )


@dataclass(frozen=True, eq=False)
class Automatic:
    """What was chosen.

    Attributes:
        options: with steps.
        params: where each training starts.
        stages: what to do.
        step: of the integration; ``None`` where the user has said anything of it.
        linear: the linear start; ``None`` where no network lacks scales.
        not_laws: networks that are no laws of the library, which are trained from where they are.
        find_misread: finds inputs that would explain the records with another sign or unit; ``None`` where nobody asks.
        pieces: how many pieces the records were cut into, as the model is sensitive; 0 where they are whole.
    """

    options: FitOptions
    params: tuple[Mapping[str, Any], ...]
    stages: tuple[Stage, ...]
    step: StepChoice | None
    linear: LinearStart | None
    not_laws: tuple[str, ...]
    find_misread: Callable[[], Iterator[Misread]] | None
    pieces: int = 0

    def concerns(self, loss: float) -> tuple[str, ...]:
        """A sentence on each input that may have been misread, where a training ended with much loss."""
        if self.find_misread is None or self.linear is None:
            return ()
        if loss <= EXPLAINS * np.sqrt(len(self.linear.problem.targets)):
            return ()
        return tuple(str(one) for one in self.find_misread() if one.loss < loss / 2)

    def begin(self, problem: Problem, start: Trainable) -> Trainable:
        """The start of a training, with parameters and first states where the linear start found them."""
        if self.linear is None:
            return start
        linear, states = self.linear.trainable, start.states
        shooting, whole = self.linear.problem.shooting, problem.shooting
        if linear.states is not None and shooting is not None and whole is not None:
            first = shooting.of_first(linear.states)
            if len(whole.first) == len(first) and states is not None:
                moves = (first - whole.start[whole.first]) / whole.scale
                states = states.at[whole.first].set(moves)
        return replace(start, modifiers=linear.modifiers, states=states)


def automatic(
    system: System,
    records: dict[str, Data],
    targets: tuple[str, ...],
    params: Sequence[dict[str, Any]],
    options: FitOptions,
) -> Automatic:
    """Choose scales, a start, steps and stages; what the user's options say stays. Errors as of `build_problem`.

    Everything follows from the arguments alone, so that a training that is resumed chooses the same.
    """
    names = trained_networks(system, options.train, params[0])
    shapes = {n: linear_shape(params[0][n]) for n in names if lacks_scales(params[0][n])}
    fixed = tuple(n for n in names if n not in shapes and not hasattr(params[0][n], "left_open"))
    linear = {n: linear_module(shape) for n, shape in shapes.items()}
    part = _part(records, MOST)
    base = replace(options, sequence_length=None, epochs=None)

    def problem_of(data: dict[str, Data], step: StepChoice, x0: Any = None) -> Problem:
        chosen = step.of(base, data)
        chosen = chosen if x0 is None else replace(chosen, x0=x0)
        return build_problem(system, data, targets, {**params[0], **linear}, chosen)

    rows = int(np.median([len(data) for data in records.values()]))
    begun = _begin(problem_of, part, tried_steps(options, system.events is not None), shapes, rows)
    start, is_nrmse = begun.start, options.loss == "nrmse"
    noise = noise_loss(problem_of(part, begun.step).records) if is_nrmse else None
    step = chosen_steps(begun.step, start.problem, start.trainable, noise, options)
    laws = _scales(begun, shapes)
    if shapes:
        start = with_constants_at_zero(start, shapes, {n: laws[n][0] for n in shapes})
        begun = begun._replace(start=start)
        laws = _scales(begun, shapes)
    at_zero = {n for n in start.loose if shapes[n].every == 1}
    scaled = tuple(
        each | {n: with_scales(each[n], *laws[n], without_constant=n in at_zero) for n in shapes}
        for each in params
    )
    stages = _stages(
        start.problem, rows, begun.rows, scaled[0], names, begun.explains, noise, options
    )
    free = None if step.solver is None or options.dt is not None else step
    linear_start = start if shapes else None
    misread = (
        partial(_find_misread, problem_of, part, begun.step, shapes)
        if is_nrmse and shapes
        else None
    )
    return Automatic(step.of(options, records), scaled, stages, free, linear_start, fixed, misread)


class _Begin(NamedTuple):
    """Where a training begins.

    Attributes:
        step: of its integration.
        start: with linear laws.
        explains: whether it explains whole records; ``rows``: else, of their beginnings that come first.
    """

    step: StepChoice
    start: LinearStart
    explains: bool
    rows: int


def _begin(
    problem_of: Callable[..., Problem],
    part: dict[str, Data],
    trials: Iterable[StepChoice],
    shapes: dict[str, LawShape],
    rows: int,
) -> _Begin:
    """The linear start of whole records; where that explains nothing, of pieces or of beginnings of them."""
    begun: _Begin | None = None
    for trial in trials:
        whole = _start(problem_of(part, trial), shapes)
        if begun is None or whole.loss < 0.8 * begun.start.loss:
            explains = bool(whole.loss < EXPLAINS * np.sqrt(len(whole.problem.targets)))
            first = max(2 * PIECE, rows // 16)
            if not (explains or shapes):
                first = min(first, _followed(whole))
            begun = _Begin(trial, whole, explains, first)
        if begun.explains:
            break
        pieces, begins = _pieces(part, whole.problem) if shapes else ({}, {})
        if pieces:
            short = _start(problem_of(pieces, trial, begins), shapes)
            if np.isfinite(short.loss):
                trainable = replace(short.trainable, states=None)
                title = f"linear law of pieces of {PIECE} samples"
                start = replace(short, trainable=trainable, title=title)
                begun = begun._replace(step=trial, start=start)
                break
    assert begun is not None
    if begun.explains or not shapes or _begins_anywhere(begun.start.problem):
        return begun
    for first in (n for n in (rows // 4, rows // 16, 2 * PIECE) if n >= 2 * PIECE):
        beginnings = {n: _first_rows(data, first) for n, data in part.items()}
        short = _start(problem_of(beginnings, begun.step), shapes)
        if short.loss < begun.start.loss:
            short = replace(short, title=f"linear law of the first {first} samples")
            begun = begun._replace(start=short, rows=first)
        if short.loss < ALMOST * np.sqrt(len(short.problem.targets)):
            break
    return begun


def _followed(start: LinearStart) -> int:
    """How many first samples a start follows in all records, before it leaves more than it may; `FEWEST` at least."""
    problem, records = start.problem, start.problem.records
    counts = np.asarray(records.weight) > 0
    with np.errstate(all="ignore"):
        off = np.asarray(problem.simulate(start.trainable).y) - np.asarray(records.y)
        squares = np.where(counts, off / np.asarray(records.sigma), 0.0) ** 2
    followed: list[int] = []
    for k in range(records.count):
        own = records.rows_of(k)
        left = np.cumsum(squares[own].sum(axis=1))
        lost = ~(left <= EXPLAINS**2 * np.cumsum(counts[own].sum(axis=1)))
        followed.append(int(np.argmax(np.append(lost, True))))
    return max(FEWEST, min(followed))


def _find_misread(
    problem_of: Callable[..., Problem],
    part: dict[str, Data],
    step: StepChoice,
    shapes: dict[str, LawShape],
) -> Iterator[Misread]:
    """Inputs that may have been misread: with another sign or unit, linear laws explain the records."""
    problem = problem_of(part, step)
    level = float(np.sqrt(len(problem.targets)))
    for name, own in [*gains(problem).items()][:LOOKED_AT]:
        for gain in GAINS:
            turned = linear_start(with_gain(problem, jnp.asarray(1 + (gain - 1) * own)), shapes)
            if turned.loss < EXPLAINS * level:
                yield Misread(name, gain, turned.loss, level)


def _start(problem: Problem, shapes: dict[str, LawShape]) -> LinearStart:
    if shapes:
        return linear_start(problem, shapes)
    trainable = problem.start()
    loss = float(problem.simulate(trainable).loss)
    nothing = np.zeros((0, 0))
    return LinearStart({}, {}, loss if np.isfinite(loss) else np.inf, problem, trainable, nothing)


def _part(records: dict[str, Data], most: int) -> dict[str, Data]:
    """The records, or their beginnings, with so many rows at most."""
    lengths = [len(d) for d in records.values()]
    if sum(lengths) <= most:
        return records
    part: dict[str, Data] = {}
    for name, data in sorted(records.items(), key=lambda item: -len(item[1])):
        left = most - sum(len(d) for d in part.values())
        if left < 2:
            break
        part[name] = _first_rows(data, left)
    return {n: part[n] for n in records if n in part}


def _first_rows(data: Data, rows: int) -> Data:
    """So many first rows of a record, or all of a shorter one."""
    return data if len(data) <= rows else data.between(data.time[0], data.time[rows - 1])


def _begins_anywhere(problem: Problem) -> bool:
    """Whether a simulation can begin within records: all states are measured, and no mode tells of the past."""
    return problem.records.x is not None and not problem.system.remembered


def _pieces(
    data: dict[str, Data], problem: Problem
) -> tuple[dict[str, Data], dict[str, dict[str, float]]]:
    """Short pieces of records that begin where all states are known, and the states there."""
    if not _begins_anywhere(problem):
        return {}, {}
    x = np.asarray(problem.records.x)
    cuts = [
        (name, k, x[row])
        for i, name in enumerate(data)
        for k, row in enumerate(problem.records.rows_of(i)[:-PIECE])
        if k % PIECE == 0 and np.isfinite(x[row]).all()
    ]
    pieces: dict[str, Data] = {}
    begins: dict[str, dict[str, float]] = {}
    for name, k, state in cuts[:: max(1, -(-len(cuts) // PIECES))]:
        t = data[name].time
        piece = f"{name} from {t[k]:g} s"
        pieces[piece] = data[name].between(t[k], t[k + PIECE - 1])
        begins[piece] = dict(zip(problem.system.states, state.tolist(), strict=True))
    return pieces, begins


def _scales(begun: _Begin, shapes: dict[str, LawShape]) -> dict[str, tuple[Scales, Affine]]:
    """By network, its scales and its linear law."""
    if not shapes:
        return {}
    start = begun.start
    problem, records = start.problem, start.problem.records
    simulated = problem.simulate(start.trainable)
    x, d = simulated.x if begun.explains or records.x is None else records.x, simulated.d
    passed = x if d is None else jnp.concatenate([x, d], axis=1)
    finite = jnp.asarray(np.flatnonzero(np.isfinite(np.asarray(passed)).all(axis=1)))
    seen = problem.seen(start.trainable, x, d, finite)
    return {
        n: _scales_of(np.asarray(seen[n]), start.laws[n], start.sensitive[n], shapes[n])
        for n in shapes
    }


def _scales_of(
    seen: np.ndarray, law: Affine, sensitive: Affine, shape: LawShape
) -> tuple[Scales, Affine]:
    seen = seen if len(seen) else np.stack([-np.ones(shape.every), np.ones(shape.every)])
    low, high, mean = seen.min(axis=0), seen.max(axis=0), seen.mean(axis=0)
    half = (high - low) / 2
    half = np.where(half > 1e-9 * np.abs(mean), half, np.maximum(np.abs(mean), 1.0))
    centre = np.where(np.abs(mean) > 0.3 * half, mean, 0.0)
    far = np.maximum(np.maximum(high - centre, centre - low), half)
    reach = np.maximum(np.sqrt(np.mean((seen - centre) ** 2, axis=0)), far / PEAK)
    values = law.offset + seen[:, : shape.inputs] @ np.asarray(law.slope)
    size = float(np.std(values))
    left = [s * r for s, r in zip(sensitive.slope, reach, strict=False)] + [sensitive.offset]
    wide = min((s for s in left if np.isfinite(s) and s > 0), default=0.0)
    output = float(np.hypot(size, min(wide, 10 * size) if size > 0 else wide)) or 1.0
    scales = Scales(tuple(centre.tolist()), tuple(reach.tolist()), output)
    return scales, law


def _stages(
    problem: Problem,
    rows: int,
    begun: int,
    params: Mapping[str, Any],
    names: Sequence[str],
    explains: bool,
    noise: float | None,
    options: FitOptions,
) -> tuple[Stage, ...]:
    leaves = [
        leaf for n in names for leaf in jax.tree.leaves(eqx.filter(params[n], eqx.is_inexact_array))
    ]
    count = sum(leaf.size for leaf in leaves) + len(problem.modifiers.names)
    few = count <= FEW
    kind = "gauss_newton" if few else "whole_record"
    usual = options.epochs is None
    epochs = UPDATES[kind] if usual else options.updates[0]
    close, enough = (0.0, 0.0) if noise is None else (CLOSE, GOOD)
    gain = min(GAIN, NATS / float(np.sum(np.asarray(problem.records.weight) > 0)))
    whole = Stage(kind, epochs, gain=gain, title="whole record")
    more = whole._replace(epochs=LONGER * epochs, every=epochs // EVALUATIONS, above=close)
    ends = (whole, more._replace(title="whole record, longer")) if usual else (whole,)
    if _begins_anywhere(problem):
        lengths = [n for n in (PIECE, 8 * PIECE) if 2 * n < rows]
        part = Stage("sequences", WINDOWS, onward=True, descent=True)
        windows = [part._replace(rows=n, title=f"windows of {n} samples") for n in lengths]
    else:
        part = Stage("whole_record", WINDOWS, onward=True)
        grows = GROWS if problem.system.events is None else GROWS_AT_EVENTS
        # the last one is about as far from all rows
        count = int(np.log(rows / begun) / np.log(grows) + 0.5)
        lengths = [int(begun * grows**k) for k in range(max(count, 0))]
        windows = [part._replace(rows=n, title=f"first {n} samples") for n in lengths]
    if not explains:
        planned = (*windows, *ends)
    elif noise is None or not names:
        planned = (whole,)
    else:
        planned = (*ends, *(stage._replace(above=enough) for stage in (*windows, *ends)))
    return tuple(stage._replace(may_fail=True) for stage in planned)
