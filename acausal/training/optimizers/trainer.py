"""Updates of an optimizer, many in one compiled program, for one training or for several.

The trainer knows nothing about models. It gets batches, losses and penalties from an objective, computes gradients, and
leaves out sequences that diverge, so that they spoil neither the weights nor the optimizer's state.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, Int, PRNGKeyArray, PyTree

from acausal._jax import Descent, compiled, either
from acausal.training.optimizers.gradients import (
    Evaluate,
    LossDerivatives,
    Objective,
    total,
    with_gradient,
)

UPDATES_PER_CALL = 128
"""The most updates in one call of the compiled program."""


class State(eqx.Module):
    """Everything that training carries from update to update.

    Attributes:
        trainable: what is trained.
        optimizer: the optimizer's state.
        epoch: updates done.
        rejected: updates rejected in a row up to now.
        key: source of all batches; batch i depends only on it and on i.
    """

    trainable: PyTree
    optimizer: PyTree
    epoch: Int[Array, "*trainings"]
    rejected: Int[Array, "*trainings"]
    key: PRNGKeyArray


class UpdateLog(eqx.Module):
    """The log of an update; with a leading axis, of many.

    Attributes:
        loss: mean loss of the batch's sequences that count, without penalties.
        penalties: by name.
        logged: the values logged from the trainable, see `Trainer`.
        diverged: how many sequences were left out; ``exploded``: those of them with a finite loss; ``first``: where the
            first of them starts (a sample's index).
        rejected: whether the update was rejected.
        turned_down: whether the update was a trial that a descent turned down, whose loss may be of any size.
    """

    loss: Float[Array, "*updates"]
    penalties: dict[str, Float[Array, "*updates"]]
    logged: PyTree
    diverged: Int[Array, "*updates"]
    exploded: Int[Array, "*updates"]
    first: Int[Array, "*updates"]
    rejected: Bool[Array, "*updates"]
    turned_down: Bool[Array, "*updates"]


class Trainer(NamedTuple):
    """How an objective is trained.

    Attributes:
        optimizer: any optax optimizer.
        limit: a sequence with a larger loss has diverged.
        log: (objective, trainable) -> values to log at every update.
        evaluate: gives the losses and the derivatives that the optimizer needs.
    """

    optimizer: optax.GradientTransformationExtraArgs
    limit: float
    log: Callable[..., PyTree]
    evaluate: Evaluate = with_gradient


def begin(trainer: Trainer, trainable: PyTree, key: PRNGKeyArray) -> State:
    """The state before the first update. Those of several trainings, stacked, can be advanced together."""
    zero = jnp.zeros((), int)
    return State(trainable, trainer.optimizer.init(trainable), zero, zero, key)


def update_key(key: PRNGKeyArray, epoch: int | Int[Array, ""]) -> PRNGKeyArray:
    """The source of an update's batch."""
    return jax.random.fold_in(key, epoch)


def converged(state: State) -> Bool[Array, "*trainings"]:
    """Whether the optimizer has converged; for several trainings, one value each."""
    if isinstance(state.optimizer, Descent):
        return state.optimizer.converged
    return jnp.zeros_like(state.epoch, bool)


def epochs_of(state: State) -> list[int]:
    """The updates that every training has made in its segment."""
    return np.atleast_1d(np.asarray(state.epoch)).tolist()


def candidates(state: State) -> tuple[PyTree, ...]:
    """What is trained; and of a descent, whose present trial may be of any kind, the best point that it knows."""
    if not isinstance(state.optimizer, Descent):
        return (state.trainable,)
    known = jax.vmap(_best_known)(state) if state.epoch.ndim else _best_known(state)
    return state.trainable, known


@compiled
def _best_known(state: State) -> PyTree:
    """The best point of a descent; before the first update its start."""
    point, unravel = ravel_pytree(state.trainable)
    known = jnp.isfinite(state.optimizer.value)
    return unravel(jnp.where(known, state.optimizer.point, point))


@compiled
def advance(
    objective: Objective,
    trainer: Trainer,
    state: State,
    until: Int[Array, ""],
    *,
    active: Bool[Array, " trainings"] | None = None,
    side_by_side: bool | None = None,
) -> tuple[State, UpdateLog]:
    """Do updates until ``until`` of them are done, at most `UPDATES_PER_CALL`, or until the optimizer has converged.

    Arguments:
        objective: what to minimise.
        trainer: how.
        state: of one training, or of several with a leading axis.
        until: updates, the same for all of them.
        active: of several trainings, those that go on; by default all. Those that have converged stay as they are.
        side_by_side: whether to map over several trainings, which is faster on an accelerator and done there by
            default. A CPU is faster with one after the other, because networks with different weights are many small
            matrix products.

    Returns:
        The new state, and a log with room for `UPDATES_PER_CALL` entries of which the first are filled; where there
        are several trainings, their axis is the second one.
    """
    if side_by_side is None:
        side_by_side = jax.default_backend() != "cpu"

    def alone(state: State) -> tuple[State, UpdateLog]:
        return _update(objective, trainer, state)

    going = jnp.ones(state.epoch.shape, bool) if active is None else active

    def unless_over(row: tuple[State, Bool[Array, ""]]) -> tuple[State, UpdateLog]:
        state, goes_on = row
        _, entry = jax.eval_shape(alone, state)
        nothing = jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), entry)
        return jax.lax.cond(
            goes_on & ~converged(state), alone, lambda state: (state, nothing), state
        )

    def of_all(state: State) -> tuple[State, UpdateLog]:
        over_rows = jax.vmap(unless_over) if side_by_side else partial(jax.lax.map, unless_over)
        return over_rows((state, going))

    update = of_all if state.epoch.ndim else alone
    first = jnp.max(state.epoch)
    _, shapes = jax.eval_shape(update, state)
    log = jax.tree.map(lambda s: jnp.zeros((UPDATES_PER_CALL, *s.shape), s.dtype), shapes)

    def body(carry: tuple[State, UpdateLog]) -> tuple[State, UpdateLog]:
        state, log = carry
        row = jnp.max(state.epoch) - first
        state, entry = update(state)
        return state, jax.tree.map(lambda rows, new: rows.at[row].set(new), log, entry)

    def is_on(carry: tuple[State, UpdateLog]) -> Bool[Array, ""]:
        state, _ = carry
        return (jnp.max(state.epoch) < until) & (going & ~converged(state)).any()

    return jax.lax.while_loop(is_on, body, (state, log))


def _update(objective: Objective, trainer: Trainer, state: State) -> tuple[State, UpdateLog]:
    drawn = objective.draw(update_key(state.key, state.epoch), state.epoch)
    batch, found, bad, exploded = evaluate_healthy(objective, trainer, state.trainable, drawn)
    derivatives = found.gradient, found.hessian
    usable = _finite((found.total, derivatives)) & ~_diverged(found, trainer).any()
    zeros = jax.tree.map(jnp.zeros_like, derivatives)
    gradient, hessian = either(usable, derivatives, zeros)
    value = jnp.where(usable, found.total, jnp.inf)
    steps, optimizer = trainer.optimizer.update(
        gradient,
        state.optimizer,
        state.trainable,
        value=value,
        grad=gradient,
        value_fn=lambda trainable: total(objective, trainable, batch)[0],
        **({} if hessian is None else {"hessian": hessian}),
    )
    moved = optax.apply_updates(state.trainable, steps)
    turned_down = _turned_down(optimizer, value)
    accepted = _finite(moved) & (usable | turned_down)
    trainable, optimizer = either(accepted, (moved, optimizer), (state.trainable, state.optimizer))
    rejected = jnp.where(accepted, 0, state.rejected + 1)
    entry = UpdateLog(
        jnp.average(found.losses, weights=batch.weight),
        found.penalties,
        trainer.log(objective, state.trainable),
        bad.sum(),
        exploded,
        drawn.start[jnp.argmax(bad)],
        ~accepted,
        turned_down,
    )
    return State(trainable, optimizer, state.epoch + 1, rejected, state.key), entry


def evaluate_healthy(
    objective: Objective, trainer: Trainer, trainable: PyTree, batch: PyTree
) -> tuple[PyTree, LossDerivatives, Bool[Array, " batch"], Int[Array, ""]]:
    """Losses and derivatives of the sequences that do not diverge.

    Besides, their batch; a mask of those that do; and how many of these have a finite loss, so that only their gradient
    explodes.

    If some diverge, everything is computed again without them: in a loop, so that the program contains it only once and
    a healthy batch costs nothing extra.
    """

    def evaluate(batch: PyTree) -> LossDerivatives:
        return trainer.evaluate(objective, trainable, batch)

    if batch.start.shape[0] == 1:
        found = evaluate(batch)
        return batch, found, _diverged(found, trainer), _exploded(found, trainer)

    def again(carry: tuple[PyTree, LossDerivatives, Array, Array, Array]) -> Bool[Array, ""]:
        _, found, bad, _, count = carry
        new = _diverged(found, trainer)
        return (count == 0) | ((count == 1) & new.any() & ~bad.all())

    def body(
        carry: tuple[PyTree, LossDerivatives, Array, Array, Array],
    ) -> tuple[PyTree, LossDerivatives, Array, Array, Array]:
        batch, _, bad, exploded, count = carry
        batch = either(bad.any(), batch.without(bad), batch)
        found = evaluate(batch)
        bad = jnp.where(count == 0, _diverged(found, trainer), bad)
        exploded = jnp.where(count == 0, _exploded(found, trainer), exploded)
        return batch, found, bad, exploded, count + 1

    zeros = jnp.zeros(batch.start.shape)
    penalties = jax.tree.map(jnp.zeros_like, jax.eval_shape(objective.penalties, trainable))
    none, zero = zeros > 0, jnp.zeros((), int)
    empty = LossDerivatives(
        zeros, penalties, jnp.zeros(()), jax.tree.map(jnp.zeros_like, trainable), none
    )
    first = batch, empty, none, zero, zero
    batch, found, bad, exploded, _ = jax.lax.while_loop(again, body, first)
    return batch, found, bad, exploded


def _turned_down(optimizer: PyTree, value: Float[Array, ""]) -> Bool[Array, ""]:
    """Whether a descent, by its state after a trial of this value, has gone back to a point that it knew before."""
    if not isinstance(optimizer, Descent):
        return jnp.zeros((), bool)
    return jnp.isfinite(optimizer.value) & (optimizer.value != value)


def _diverged(found: LossDerivatives, trainer: Trainer) -> Bool[Array, " batch"]:
    return ~(found.losses <= trainer.limit) | found.exploded


def _exploded(found: LossDerivatives, trainer: Trainer) -> Int[Array, ""]:
    """How many sequences have a finite loss, but no finite gradient."""
    return (found.exploded & (found.losses <= trainer.limit)).sum()


def _finite(tree: PyTree) -> Bool[Array, ""]:
    return jnp.stack([jnp.isfinite(leaf).all() for leaf in jax.tree.leaves(tree)]).all()
