"""Solve algebraic loops with JAX: torn blocks of one shape, side by side.

Linear blocks are solved directly, nonlinear ones by Newton's method, with derivatives by the implicit function theorem.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import above_rounding, value_and_jacobian
from acausal.codegen.elimination import eliminate
from acausal.codegen.instructions import ArrayFormula, SolveTornLoop
from acausal.codegen.lower import ModuleValue
from acausal.codegen.newton import Block, Dense, Residual, root
from acausal.codegen.reading import Arrays, compute, fill, read_elements
from acausal.codegen.values import Packed, Values
from acausal.modeling import time

FEW = 12
"""The most unknowns that are eliminated in array operations; more take XLA too long to compile."""

REST, ROUNDINGS = 1e-9, 1e3
"""What rounding may leave of equations, of the magnitudes of their terms, or in roundings of them."""

Torn = Callable[[Array], tuple[Sequence[Array], Array]]
"""From tearing variables (m,) to all unknowns of a block, n scalars, and its residuals (m,)."""


def solve_block(
    block: Torn,
    guess: Float[Array, " m"],
    scale: Float[Array, " m"] | float = 1.0,
    *,
    is_linear: bool = False,
    may_repeat_itself: bool = False,
) -> Float[Array, " n"]:
    """Unknowns of a block near a guess; NaN where Newton's method does not converge, or equations contradict.

    Of a block that is affine in its tearing variables, the guess gives only their number. Its equations may repeat each
    other, where that is said; of what they leave undetermined the least is taken.
    """
    invert = partial(_solve, may_be_singular=may_repeat_itself)

    def solve(residual: Residual, start: Array) -> Array:
        if is_linear:
            r, jacobian = value_and_jacobian(residual, start, axis=-1)
            found = -invert(jacobian, r)
            return _where_solved(jacobian, found, r) if may_repeat_itself else found
        found, converged = root(Dense(_stacked(block), _solve), start, scale)
        return jnp.where(converged, found, jnp.nan)

    def tangent(linear: Residual, y: Float[Array, " m"]) -> Float[Array, " m"]:
        """Where a linear function is ``y``: derivatives are those of a root, by the implicit function theorem."""
        return invert(jax.jacfwd(linear)(jnp.zeros_like(y)), y)

    start = jnp.zeros_like(guess) if is_linear else guess
    return _stacked(block)(jax.lax.custom_root(lambda z: block(z)[1], start, solve, tangent))[0]


def _where_solved(
    a: Float[Array, "m m"], x: Float[Array, " m"], b: Float[Array, " m"]
) -> Float[Array, " m"]:
    """``x`` if ``a x + b = 0`` but for rounding, else NaN."""
    rest = above_rounding(REST, ROUNDINGS, a.dtype)
    terms = jnp.abs(a) @ jnp.abs(x) + jnp.abs(b)
    return jnp.where(jnp.all(jnp.abs(a @ x + b) <= rest * terms), x, jnp.nan)


def _stacked(block: Torn) -> Block:
    """A block that gives its unknowns as an array; a linear one is solved without."""

    def stacked(z: Array) -> tuple[Array, Array]:
        unknowns, residuals = block(z)
        return jnp.stack(unknowns), residuals

    return stacked


def nearest(
    block: Torn, guess: Float[Array, " m"], scale: Float[Array, " m"] | float = 1.0
) -> Float[Array, " m"]:
    """Tearing variables where the search for a root of a nonlinear block ends, whether or not they are a root."""
    return root(Dense(_stacked(block), _solve), guess, scale)[0]


def _solve(
    a: Float[Array, "m m"], b: Float[Array, " m"], *, may_be_singular: bool = False
) -> Float[Array, " m"]:
    """``a^-1 b``; spelled out for the small sizes where a library call costs more than the arithmetic."""
    match a.shape[0]:
        case n if may_be_singular and n <= FEW:
            return eliminate(a, b, may_be_singular)
        case 1:
            return b / a[0]
        case 2:
            determinant = a[0, 0] * a[1, 1] - a[0, 1] * a[1, 0]
            first = a[1, 1] * b[0] - a[0, 1] * b[1]
            second = a[0, 0] * b[1] - a[1, 0] * b[0]
            return jnp.stack([first, second]) / determinant
        case n if n <= FEW:
            return eliminate(a, b)
        case _:
            return jnp.linalg.solve(a, b)


Known = Sequence[Any]
"""What the loops read: the values of their arguments, in order."""

NOTHING: Any = np.zeros(0)


def solve_torn_loops(loop: SolveTornLoop, values: Values, arrays: Arrays) -> list[Array]:
    """The unknowns, one array each over the loops."""

    def one(t: Any, known: Known, guess: Array, scale: Array) -> Array:
        block = lambda tears: _torn(loop, tears, t, known)  # noqa: E731
        return solve_block(
            block,
            guess,
            scale,
            is_linear=loop.is_linear,
            may_repeat_itself=loop.may_repeat_itself,
        )

    scale = jnp.asarray(loop.scale, values.x.dtype)
    return _for_each(loop, values, arrays, one, _guess(loop, values, arrays), scale)


def _guess(loop: SolveTornLoop, values: Values, arrays: Arrays) -> Array:
    """Where the search for the tearing variables starts, (size, n_tears)."""
    guess = jnp.asarray(loop.guess, values.x.dtype)
    if not any(loop.guessed):
        return guess
    pairs = zip(guess.T, loop.guessed, strict=True)
    columns = [start if state is None else read_elements(state, arrays) for start, state in pairs]
    return jnp.stack([jnp.broadcast_to(column, loop.size) for column in columns], axis=1)


def matched_residuals_of_torn_loops(
    loop: SolveTornLoop, values: Values, arrays: Arrays, unknowns: list[Array]
) -> list[Array]:
    """For given unknowns the residuals of the equations matched to them, one array each over the loops."""

    def one(t: Any, known: Known, own: Array) -> Array:
        return jnp.stack([_value(loop.equations[e], list(own), t, known) for e in loop.matched])

    rows = jnp.stack(unknowns, axis=-1).reshape(loop.size, loop.outputs)
    return _for_each(loop, values, arrays, one, rows)


def _for_each(
    loop: SolveTornLoop,
    values: Values,
    arrays: Arrays,
    function: Callable[..., Array],
    *rows: Array,
) -> list[Array]:
    """What a function of time, arguments and rows gives for each of the loops; an array over them for each result."""
    filled = fill(loop.arguments, values.packed, arrays, values.t)
    t = filled.pop(time)

    def one(known: dict[int, Any], *own: Array) -> Array:
        return function(t, list(known.values()), *own)

    named = dict(enumerate(filled.values()))
    if loop.size == 1:
        return list(one(named, *(r[0] for r in rows)))
    if any(isinstance(v, ModuleValue) and isinstance(v.module, tuple) for v in named.values()):
        each = [{k: _row(v, i) for k, v in named.items()} for i in range(loop.size)]
        return list(jnp.stack([one(*own) for own in zip(each, *rows, strict=True)]).T)
    shared = {k: v for k, v in named.items() if isinstance(v, ModuleValue) and not v.stacked}
    parts = {
        k: eqx.partition(v.module if isinstance(v, ModuleValue) else v, eqx.is_array)
        for k, v in named.items()
        if k not in shared
    }
    batched = {
        k: jnp.broadcast_to(v, (loop.size, *jnp.shape(v)[1:])) if eqx.is_array(v) else v
        for k, (v, _) in parts.items()
    }

    def row(arrays: dict[int, Any], *own: Array) -> Array:
        combined = {k: eqx.combine(v, parts[k][1]) for k, v in arrays.items()}
        both = {**shared, **combined}
        return one({k: both[k] for k in named}, *own)

    return list(jax.vmap(row)(batched, *rows).T)


def nearest_of_torn_loop(
    loop: SolveTornLoop, row: int, values: Values, arrays: Arrays
) -> tuple[Array, Array]:
    """Unknowns and residuals of one of the loops, where the search for its solution stopped."""
    filled = fill(loop.arguments, values.packed, arrays, values.t)
    t = filled.pop(time)
    known = [_row(value, row) for value in filled.values()]

    def block(tears: Array) -> tuple[list[Array], Array]:
        return _torn(loop, tears, t, known)

    guess = _guess(loop, values, arrays)[row]
    return _stacked(block)(nearest(block, guess, jnp.asarray(loop.scale[row])))


def _row(value: Any, i: int) -> Any:
    """The value for one of several instances."""
    if not isinstance(value, ModuleValue):
        return value[i] if jnp.ndim(value) else value
    if isinstance(value.module, tuple):
        return value.module[i]
    if not value.stacked:
        return value
    return jax.tree.map(lambda leaf: leaf[i] if eqx.is_array(leaf) else leaf, value.module)


def _torn(loop: SolveTornLoop, tears: Array, t: Any, known: Known) -> tuple[list[Array], Array]:
    """All unknowns of a torn block, and its residuals, for given tearing variables."""
    unknowns: list[Any] = [None] * loop.outputs
    for i, variable in enumerate(loop.tears):
        unknowns[variable] = tears[i]
    for unknown, formula in loop.assigned:
        unknowns[unknown] = _value(formula, unknowns, t, known)
    residuals = [_value(f, unknowns, t, known) for f in loop.residuals]
    return unknowns, jnp.stack(residuals)


def _value(formula: ArrayFormula, unknowns: Sequence[Any], t: Any, known: Known) -> Array:
    """The value of a formula of the block."""
    return compute(formula, Packed(NOTHING, tuple(known)), [*unknowns, *known], t)
