"""A scan that stores only the states between its steps.

The derivative of a small step in reverse mode repeats the step from its stored state, instead of storing what the step
computed: arithmetic is cheaper than memory.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple, Protocol, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jax.custom_derivatives import SymbolicZero
from jaxtyping import Array, Bool, PyTree, Shaped

from acausal._jax import primitives
from acausal._jax.batching import batched, is_small, operations
from acausal._jax.differentiation import merged, picked, scattered

ScanStep: TypeAlias = Callable[[PyTree, Array, PyTree], tuple[Array, PyTree]]
"""(constants, state, row) -> (next state, outputs), of arrays."""

FlatStep: TypeAlias = Callable[[Sequence[Array], Array, Sequence[Array]], list[Array]]
"""The same with flat lists: [next state, *outputs]."""

_Cotangents: TypeAlias = tuple[list[Array | None], Array, list[Array | None]]
"""Of constants, first state and rows; None for an array for which no derivative is needed."""

_Carry: TypeAlias = tuple[Array, list[Array]]
"""The adjoint of the state, and the totals of constants' cotangents."""

_Sample: TypeAlias = tuple[Array, list[Array], Array | None, list[Array | None]]
"""State and row of a step, and the cotangents of the state and the outputs there."""

AT_ONCE, MANY = 2, 2
"""Steps of the derivative in one iteration of its loop, where totals have so many numbers for each operation of a step.

The steps of one iteration write to the totals once. For the quarter vehicle, whose networks have four weights for each
operation, that saves a fifth of the time; for smaller networks it saves nothing and doubles the time to compile.
"""


EXPLODED = 1e15
"""Growth of the adjoint from the results to the first state beyond which none of its digits is right: 1/eps or so."""


class Restarts(NamedTuple):
    """Rows at which another run begins, so that one loop makes many runs of any lengths.

    Attributes:
        begins: whether one begins at the row.
        first: its first state; other rows are not read.
    """

    begins: Bool[Array, " n"]
    first: Shaped[Array, "n n_states"]


FIRST = 1
"""Where the first states of further runs are among the flat rows."""


def stored_scan(
    step: ScanStep,
    constants: PyTree,
    x0: Shaped[Array, " n_states"],
    rows: PyTree,
    *,
    direct: bool = False,
    restarts: Restarts | None = None,
) -> tuple[Shaped[Array, "n n_states"], Shaped[Array, " n_states"], PyTree]:
    """Repeat a step for every row, each from the state where the one before ended, as `jax.lax.scan` does.

    Arguments:
        step: pure.
        constants: a pytree of arrays that all steps share.
        x0: the first state.
        rows: a pytree of arrays with a leading axis of n rows.
        direct: store what the steps compute, so that forward mode works, too.
        restarts: rows at which another run begins.

    Returns:
        The states before the steps, with a leading axis of n; the state after the last one; the outputs of
        all steps, with a leading axis. All can be differentiated by all arguments. Where steps are repeated and the
        adjoint explodes, as it does when steps are too long for their scheme to be stable, derivatives are NaN.
    """
    if restarts is not None:
        begins, first = restarts
        inner = step

        def restarted(constants: PyTree, x: Array, row: PyTree) -> tuple[Array, PyTree]:
            (begins, first), row = row
            return inner(constants, jnp.where(begins, first, x), row)

        step, rows = restarted, ((begins, first), rows)
    row = jax.tree.map(lambda a: jax.ShapeDtypeStruct(a.shape[1:], a.dtype), rows)
    closed, shapes = jax.make_jaxpr(step, return_shape=True)(constants, x0, row)
    shared, by_row = jax.tree.leaves(constants), jax.tree.leaves(rows)
    captured = len(closed.consts)

    def flat(constants: Sequence[Array], x: Array, row: Sequence[Array]) -> list[Array]:
        evaluate = primitives.as_function(closed, constants[:captured])
        return evaluate(*constants[captured:], x, *row)

    is_repeated = not direct and is_small(closed.jaxpr, in_loop=True)
    run = _forward
    if is_repeated:
        run = partial(_repeating, operations(closed.jaxpr), None if restarts is None else FIRST)
    states, end, *outputs = run(flat, [*closed.consts, *shared], x0, by_row)
    if restarts is not None:
        states = jnp.where(restarts.begins[:, None], restarts.first, states)
    return states, end, jax.tree.unflatten(jax.tree.structure(shapes[1]), outputs)


class _Input(Protocol):
    """What JAX gives a forward rule: a value, and whether its derivative is needed."""

    value: Array
    perturbed: bool


class _Saved(eqx.Module):
    """What the derivative needs.

    Attributes:
        constants, states, rows: of the loop.
        sizes: the largest magnitudes of its results: the states', the last state's, the outputs'.
        moved: the constants and rows whose derivatives are needed.
        operations: in a step.
        first: which of the rows holds first states of further runs, if one does.
    """

    constants: list[Array]
    states: Array
    rows: list[Array]
    sizes: list[Array]
    moved: tuple[tuple[bool, ...], tuple[bool, ...]] = eqx.field(static=True)
    operations: int = eqx.field(static=True)
    first: int | None = eqx.field(static=True)


def _forward(
    step: FlatStep, constants: list[Array], x0: Array, rows: list[Array]
) -> Sequence[Array]:
    """[states, end, *outputs]."""

    def body(x: Array, row: list[Array]) -> tuple[Array, tuple[Array, list[Array]]]:
        new, *outputs = step(constants, x, row)
        return new, (x, outputs)

    end, (states, outputs) = lax.scan(body, x0, rows)
    return [states, end, *outputs]


def _repeating(
    size: int,
    first: int | None,
    step: FlatStep,
    constants: list[Array],
    x0: Array,
    rows: list[Array],
) -> Sequence[Array]:
    """The same, with a derivative that repeats the steps."""
    n = len(constants)

    @batched
    def run(*args: Array) -> Sequence[Array]:
        return _forward(step, list(args[:n]), args[n], list(args[n + 1 :]))

    @jax.custom_vjp
    def scan(constants: list[Array], x0: Array, rows: list[Array]) -> Sequence[Array]:
        return run(*constants, x0, *rows)

    def keep(
        constants: list[_Input], x0: _Input, rows: list[_Input]
    ) -> tuple[Sequence[Array], _Saved]:
        moved = tuple(p.perturbed for p in constants), tuple(p.perturbed for p in rows)
        shared, by_row = [p.value for p in constants], [p.value for p in rows]
        results = run(*shared, x0.value, *by_row)
        sizes = [_size(r) for r in results]
        return results, _Saved(shared, results[0], by_row, sizes, moved, size, first)

    def back(saved: _Saved, cotangents: list[Array | SymbolicZero]) -> _Cotangents:
        return _back(step, saved, [None if isinstance(c, SymbolicZero) else c for c in cotangents])

    scan.defvjp(keep, back, symbolic_zeros=True)
    return scan(constants, x0, rows)


def _back(step: FlatStep, saved: _Saved, cotangents: list[Array | None]) -> _Cotangents:
    """Cotangents of constants, first state and rows."""
    n, m = len(saved.constants), len(saved.rows)
    some_constants, some_rows = saved.moved
    given = [c is not None for c in cotangents]

    def backward(*args: Array) -> list[Array]:
        constants, states, rows = list(args[:n]), args[n], list(args[n + 1 : n + 1 + m])
        to_states, to_end, *to_outputs = scattered(given, args[n + 1 + m :])

        def body(carry: _Carry, sample: _Sample) -> tuple[_Carry, list[Array]]:
            adjoint, totals = carry
            x, row, to_state, to_output = sample

            def moved(some: list[Array], x: Array, own: list[Array]) -> list[Array]:
                return step(merged(constants, some_constants, some), x, merged(row, some_rows, own))

            new, pull = jax.vjp(moved, picked(constants, some_constants), x, picked(row, some_rows))
            seeds = [
                jnp.zeros_like(v) if c is None else c
                for c, v in zip(to_output, new[1:], strict=True)
            ]
            by_constants, by_x, by_row = pull([adjoint, *seeds])
            totals = [total + own for total, own in zip(totals, by_constants, strict=True)]
            return (by_x if to_state is None else by_x + to_state, totals), by_row

        adjoint = jnp.zeros_like(states[0]) if to_end is None else to_end
        start = adjoint, [jnp.zeros_like(c) for c in picked(constants, some_constants)]
        samples = states, rows, to_states, to_outputs
        unroll = AT_ONCE if sum(t.size for t in start[1]) > MANY * saved.operations else 1
        (adjoint, totals), by_rows = lax.scan(body, start, samples, reverse=True, unroll=unroll)
        return [adjoint, *totals, *by_rows]

    known = [c for c in cotangents if c is not None]
    found = batched(backward)(*saved.constants, saved.states, *saved.rows, *known)
    count = sum(some_constants)
    largest = jnp.abs(found[0])
    if saved.first is not None:
        by_first = scattered(some_rows, found[1 + count :])[saved.first]
        largest = largest if by_first is None else jnp.maximum(largest, jnp.abs(by_first).max(0))
    exploded = _exploded(largest, saved, cotangents)
    adjoint, *others = (jnp.where(exploded, jnp.nan, c).astype(c.dtype) for c in found)
    by_constants = scattered(some_constants, others[:count])
    return by_constants, adjoint, scattered(some_rows, others[count:])


def _exploded(adjoint: Array, saved: _Saved, cotangents: list[Array | None]) -> Array:
    """Whether the adjoint of first states has grown more than `EXPLODED` times on its way, though states have not.

    Both the plain numbers must have grown and those relative to the sizes of states and results: either may mislead, as
    units are arbitrary, and results may be zero. Where the states themselves grow, so does the adjoint: what they have
    grown since the first half of the steps is allowed for.
    """
    largest = [None if c is None else _size(c) for c in cotangents]
    given = [(a, size) for a, size in zip(largest, saved.sizes, strict=True) if a is not None]
    plain = jnp.stack([a for a, _ in given]).max()
    relative = jnp.stack([a * size for a, size in given]).max()
    sizes = jnp.max(jnp.abs(saved.states), axis=0)
    early = jnp.max(jnp.abs(saved.states[: (len(saved.states) + 1) // 2]), axis=0)
    grown = EXPLODED * jnp.max(jnp.where(early > 0, sizes / early, 1.0), initial=1.0)
    return (_size(adjoint) > grown * plain) & (_size(adjoint * sizes) > grown * relative)


def _size(array: Array) -> Array:
    return jnp.max(jnp.abs(array), initial=0.0)
