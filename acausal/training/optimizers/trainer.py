"""How training moves: updates of an optimizer, many in one compiled program, of one training or of several.

The trainer knows nothing of models. It asks a problem for batches, losses and penalties, takes gradients and
sees to it that a sequence which diverges poisons neither weights nor the optimizer.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple, Protocol

import equinox as eqx
import jax
import jax.numpy as jnp
import optax
from jax import Array

from acausal.training.optimizers.descent import Descent
from acausal.training.optimizers.gradients import Slope, Slopes, gradients, total

CHUNK = 128
"""At most so many updates between two looks at the training."""


class Batch(Protocol):
    """A batch of sequences that can leave out some of them."""

    @property
    def start(self) -> Array:
        """Index of each sequence's first sample, shape (B,)."""
        ...

    @property
    def weight(self) -> Array:
        """Weight of each sequence, shape (B,)."""
        ...

    def without(self, bad: Any) -> Any:
        """The batch without the sequences of a mask."""
        ...


class Objective(Protocol):
    """What a trainer can minimise: a pytree with pure functions."""

    def draw(self, key: Any) -> Any:
        """A batch."""
        ...

    def losses(self, trainable: Any, batch: Any) -> Array:
        """The loss of every sequence of a batch, shape (B,)."""
        ...

    def penalties(self, trainable: Any) -> dict[str, Array]:
        """Terms that are added, by name."""
        ...


class State(eqx.Module):
    """Everything that training carries from update to update.

    Attributes:
        trainable: what is trained.
        optimizer: the optimizer's state.
        epoch: updates done.
        rejected: updates rejected in a row up to now.
        key: source of all batches; batch i depends on it and on i alone.
    """

    trainable: Any
    optimizer: Any
    epoch: Array
    rejected: Array
    key: Array


class Entry(eqx.Module):
    """What an update tells; with a leading axis, what many tell.

    Attributes:
        loss: mean loss of the batch's sequences that count, without penalties.
        penalties: by name.
        logged: what was logged of the trainable, see `Trainer`.
        diverged: how many sequences were left out; ``first``: where the first of them starts (a sample's index).
        rejected: whether the update was rejected, or was a trial that L-BFGS takes back.
    """

    loss: Array
    penalties: dict[str, Array]
    logged: Any
    diverged: Array
    first: Array
    rejected: Array


class Trainer(NamedTuple):
    """How a problem is trained.

    Attributes:
        optimizer: any optax optimizer.
        limit: a sequence with a larger loss has diverged.
        log: what of the trainable to log at every update.
        slopes: what the optimizer is told of a point.
    """

    optimizer: optax.GradientTransformationExtraArgs
    limit: float
    log: Callable[[Any, Any], Any]
    slopes: Slopes = gradients


def begin(trainer: Trainer, trainable: Any, key: Array) -> State:
    """The state before the first update. Those of several trainings, stacked, can be advanced together."""
    zero = jnp.zeros((), int)
    return State(trainable, trainer.optimizer.init(trainable), zero, zero, key)


def converged(state: State) -> Array:
    """Whether the optimizer says that it has nothing more to find; for several trainings, of each."""
    if isinstance(state.optimizer, Descent):
        return state.optimizer.converged
    return jnp.zeros_like(state.epoch, bool)


@eqx.filter_jit
def advance(problem: Any, trainer: Trainer, state: State, until: Array) -> tuple[State, Entry]:
    """Make updates until ``until`` of them are done, at most `CHUNK`, or until the optimizer has nothing more to find.

    Arguments:
        problem: what to minimise.
        trainer: how.
        state: of one training, or of several with a leading axis.
        until: updates, the same for all of them.

    Returns:
        The new state, and a log with room for `CHUNK` entries of which the first are filled; where there are several
        trainings, their axis is the second one.
    """

    def alone(state: State) -> tuple[State, Entry]:
        return _update(problem, trainer, state)

    def said(trainable: Any) -> Entry:
        return _empty_entry(problem, trainer, trainable)

    update, empty = (_each(alone), jax.vmap(said)) if state.epoch.ndim else (alone, said)
    first = jnp.max(state.epoch)
    shapes = jax.eval_shape(empty, state.trainable)
    log = jax.tree.map(lambda s: jnp.zeros((CHUNK, *s.shape), s.dtype), shapes)

    def body(carry: tuple[State, Entry]) -> tuple[State, Entry]:
        state, log = carry
        row = jnp.max(state.epoch) - first
        state, entry = update(state)
        return state, jax.tree.map(lambda rows, new: rows.at[row].set(new), log, entry)

    def is_on(carry: tuple[State, Entry]) -> Array:
        state, _ = carry
        return (jnp.max(state.epoch) < until) & ~converged(state).all()

    return jax.lax.while_loop(is_on, body, (state, log))


def _each(update: Callable[[State], Any]) -> Callable[[State], Any]:
    """The update of every training.

    A processor makes one after the other: networks with weights of their own each are many small products of
    matrices, which it computes faster apart than side by side.
    """
    if jax.default_backend() == "cpu":
        return partial(jax.lax.map, update)
    return jax.vmap(update)


def _empty_entry(problem: Objective, trainer: Trainer, trainable: Any) -> Entry:
    number, count = jnp.zeros(()), jnp.zeros((), int)
    said = problem.penalties(trainable), trainer.log(problem, trainable)
    return Entry(number, *said, count, count, jnp.zeros((), bool))


def _update(problem: Objective, trainer: Trainer, state: State) -> tuple[State, Entry]:
    drawn = problem.draw(jax.random.fold_in(state.key, state.epoch))
    batch, result, bad = _slope(problem, trainer, state.trainable, drawn)
    slopes = result.gradient, result.curvature
    usable = _finite((result.total, slopes)) & ~_diverged(result.losses, trainer).any()
    gradient, curvature = _select(usable, slopes, jax.tree.map(jnp.zeros_like, slopes))
    steps, optimizer = trainer.optimizer.update(
        gradient,
        state.optimizer,
        state.trainable,
        value=jnp.where(usable, result.total, jnp.inf),
        grad=gradient,
        value_fn=lambda trainable: total(problem, trainable, batch)[0],
        **({} if curvature is None else {"curvature": curvature}),
    )
    moved = optax.apply_updates(state.trainable, steps)
    accepted = _finite(moved) & (usable | _takes_back(optimizer))
    trainable, optimizer = _select(accepted, (moved, optimizer), (state.trainable, state.optimizer))
    rejected = jnp.where(accepted, 0, state.rejected + 1)
    entry = Entry(
        jnp.average(result.losses, weights=batch.weight),
        result.penalties,
        trainer.log(problem, state.trainable),
        bad.sum(),
        drawn.start[jnp.argmax(bad)],
        ~(accepted & usable),
    )
    return State(trainable, optimizer, state.epoch + 1, rejected, state.key), entry


def _slope(
    problem: Objective, trainer: Trainer, trainable: Any, batch: Any
) -> tuple[Any, Slope, Array]:
    """The slope for the sequences of a batch that do not diverge, and a mask of those that do.

    Where some diverge it is computed a second time without them: in a loop, so that the program holds it once and a
    healthy batch pays nothing.
    """

    def evaluate(batch: Any) -> Slope:
        return trainer.slopes(problem, trainable, batch)

    if batch.start.shape[0] == 1:
        result = evaluate(batch)
        return batch, result, _diverged(result.losses, trainer)

    def again(carry: tuple[Any, Slope, Array, Array]) -> Array:
        _, result, bad, count = carry
        new = _diverged(result.losses, trainer)
        return (count == 0) | ((count == 1) & new.any() & ~bad.all())

    def body(carry: tuple[Any, Slope, Array, Array]) -> tuple[Any, Slope, Array, Array]:
        batch, _, bad, count = carry
        batch = jax.tree.map(
            lambda new, old: jnp.where(bad.any(), new, old), batch.without(bad), batch
        )
        result = evaluate(batch)
        bad = jnp.where(count == 0, _diverged(result.losses, trainer), bad)
        return batch, result, bad, count + 1

    zeros = jnp.zeros(batch.start.shape)
    penalties = jax.tree.map(jnp.zeros_like, jax.eval_shape(problem.penalties, trainable))
    empty = Slope(zeros, penalties, jnp.zeros(()), jax.tree.map(jnp.zeros_like, trainable))
    none = zeros > 0
    batch, result, bad, _ = jax.lax.while_loop(again, body, (batch, empty, none, jnp.asarray(0)))
    return batch, result, bad


def _takes_back(optimizer: Any) -> Any:
    """Whether the optimizer itself goes back from a point that diverges, to a better one it knows."""
    return jnp.isfinite(optimizer.value) if isinstance(optimizer, Descent) else False


def _diverged(losses: Array, trainer: Trainer) -> Array:
    return ~(losses <= trainer.limit)


def _finite(tree: Any) -> Array:
    return jnp.stack([jnp.isfinite(leaf).all() for leaf in jax.tree.leaves(tree)]).all()


def _select(condition: Array, new: Any, old: Any) -> Any:
    return jax.tree.map(lambda a, b: jnp.where(condition, a, b), new, old)
