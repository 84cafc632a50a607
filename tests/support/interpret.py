"""Run a traced JAX function in numpy, operation by operation: no compilation, for models that are run once or twice."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import jax
import jax.extend.core as jex
import numpy as np

Rule = Callable[..., Any]
"""From arguments and parameters of an operation to its result; a tuple where there are several."""


def in_numpy(function: Callable[..., Any], *example: Any) -> Callable[..., Any]:
    """The same function without JAX, for arguments that look like ``example``; results are flat lists of arrays."""
    closed = jax.make_jaxpr(function)(*example)

    def run(*args: Any) -> list[Any]:
        with np.errstate(all="ignore"):
            return _run(closed.jaxpr, closed.consts, [np.asarray(a) for a in jax.tree.leaves(args)])

    return run


def _run(jaxpr: Any, consts: Sequence[Any], args: Sequence[Any]) -> list[Any]:
    values: dict[Any, Any] = dict(zip(jaxpr.constvars, consts, strict=True))
    values.update(zip(jaxpr.invars, args, strict=True))

    def read(atom: Any) -> Any:
        return np.asarray(atom.val) if isinstance(atom, jex.Literal) else values[atom]

    for equation in jaxpr.eqns:
        rule = RULES.get(equation.primitive.name)
        read_in = [read(v) for v in equation.invars]
        if rule is None:  # rare: let JAX compile that one operation
            result = equation.primitive.bind(*read_in, **equation.params)
            result = result if equation.primitive.multiple_results else (result,)
        else:
            result = rule(*read_in, **equation.params)
            result = result if isinstance(result, tuple | list) else (result,)
        values.update(zip(equation.outvars, result, strict=True))
    return [np.asarray(read(v)) for v in jaxpr.outvars]


def _elementwise(function: Callable[..., Any]) -> Rule:
    return lambda *args, **_: function(*args)


def _call(name: str) -> Rule:
    return lambda *args, **p: _run(p[name].jaxpr, p[name].consts, args)


def _broadcast(x: Any, *, shape: Any, broadcast_dimensions: Any, **_: Any) -> Any:
    kept = [1] * len(shape)
    for axis, size in zip(broadcast_dimensions, np.shape(x), strict=True):
        kept[axis] = size
    return np.broadcast_to(np.reshape(x, kept), shape)


def _slice(x: Any, *, start_indices: Any, limit_indices: Any, strides: Any) -> Any:
    steps = strides or [1] * len(start_indices)
    return x[tuple(map(slice, start_indices, limit_indices, steps))]


def _gather(x: Any, index: Any, **p: Any) -> Any:
    assert x.ndim == 1
    assert index.shape[-1] == 1
    return np.reshape(x[index[..., 0]], index.shape[:-1])


def _split(x: Any, *, sizes: Any, axis: int) -> Any:
    return tuple(np.split(x, np.cumsum(sizes)[:-1], axis))


def _while(*args: Any, **p: Any) -> Any:
    n, m = p["cond_nconsts"], p["body_nconsts"]
    test, body = p["cond_jaxpr"], p["body_jaxpr"]
    state = list(args[n + m :])
    while np.any(going := _run(test.jaxpr, test.consts, [*args[:n], *state])[0]):
        after = _run(body.jaxpr, body.consts, [*args[n : n + m], *state])
        state = [_where(going, a, b) for a, b in zip(after, state, strict=True)]
    return state


def _where(chosen: Any, a: Any, b: Any) -> Any:
    """Several loops side by side end each in its own time."""
    axes = tuple(range(np.ndim(chosen), np.ndim(a)))
    return np.where(np.expand_dims(chosen, axes), a, b)


def _solve(*args: Any, const_lengths: Any, jaxprs: Any, **_: Any) -> Any:
    """A linear system that is given by its product with a vector: one product for every unit vector."""
    operator, known = jaxprs.matvec, args[: const_lengths.matvec]
    right = [np.asarray(b) for b in args[sum(const_lengths) :]]
    ends = np.cumsum([b.size for b in right])

    def parts(flat: Any) -> list[Any]:
        pieces = np.split(flat, ends[:-1])
        return [p.reshape(b.shape) for p, b in zip(pieces, right, strict=True)]

    def product(flat: Any) -> Any:
        results = _run(operator.jaxpr, operator.consts, [*known, *parts(flat)])
        return np.concatenate([np.ravel(r) for r in results])

    matrix = np.stack([product(unit) for unit in np.eye(ends[-1])], axis=1)
    try:
        return parts(np.linalg.solve(matrix, np.concatenate([b.ravel() for b in right])))
    except np.linalg.LinAlgError:
        return [np.full(b.shape, np.nan) for b in right]


def _select(which: Any, *cases: Any) -> Any:
    return np.choose(np.asarray(which, dtype=int), cases)


def _dot(a: Any, b: Any, *, dimension_numbers: Any, **_: Any) -> Any:
    """Sum over some axes; those of a batch come first, then the rest of ``a``, then the rest of ``b``."""
    (left, right), (left_batch, right_batch) = dimension_numbers
    in_a = list(range(np.ndim(a)))
    in_b = list(range(np.ndim(a), np.ndim(a) + np.ndim(b)))
    for i, j in zip((*left, *left_batch), (*right, *right_batch), strict=True):
        in_b[j] = in_a[i]
    batch = [in_a[i] for i in left_batch]
    summed = {in_a[i] for i in left} | set(batch)
    rest = [i for i in (*in_a, *in_b) if i not in summed]
    return np.einsum(a, in_a, b, in_b, [*batch, *rest])


RULES: dict[str, Rule] = {
    "abs": _elementwise(np.abs),
    "add": _elementwise(np.add),
    "add_any": _elementwise(np.add),
    "and": _elementwise(np.logical_and),
    "broadcast_in_dim": _broadcast,
    "concatenate": lambda *xs, dimension: np.concatenate(xs, dimension),
    "convert_element_type": lambda x, *, new_dtype, **_: np.asarray(x, new_dtype),
    "copy": _elementwise(lambda x: x),
    "cos": _elementwise(np.cos),
    "custom_jvp_call": _call("call_jaxpr"),
    "custom_linear_solve": _solve,
    "div": _elementwise(np.divide),
    "dot_general": _dot,
    "eq": _elementwise(np.equal),
    "exp": _elementwise(np.exp),
    "gather": _gather,
    "ge": _elementwise(np.greater_equal),
    "gt": _elementwise(np.greater),
    "integer_pow": lambda x, *, y: np.power(x, y),
    "iota": lambda *, dtype, shape, dimension, **_: _broadcast(
        np.arange(shape[dimension], dtype=dtype), shape=shape, broadcast_dimensions=(dimension,)
    ),
    "is_finite": _elementwise(np.isfinite),
    "jit": _call("jaxpr"),
    "le": _elementwise(np.less_equal),
    "lt": _elementwise(np.less),
    "lu": lambda a: (a, None, None),  # only `_solve` reads it, and needs it not
    "max": _elementwise(np.maximum),
    "min": _elementwise(np.minimum),
    "mul": _elementwise(np.multiply),
    "ne": _elementwise(np.not_equal),
    "neg": _elementwise(np.negative),
    "not": _elementwise(np.logical_not),
    "or": _elementwise(np.logical_or),
    "reduce_max": lambda x, *, axes, **_: np.max(x, axis=tuple(axes)),
    "reduce_and": lambda x, *, axes, **_: np.all(x, axis=tuple(axes)),
    "reduce_sum": lambda x, *, axes, **_: np.sum(x, axis=tuple(axes)),
    "reshape": lambda x, *, new_sizes, **_: np.reshape(x, new_sizes),
    "select_n": _elementwise(_select),
    "sin": _elementwise(np.sin),
    "slice": _slice,
    "split": _split,
    "sqrt": _elementwise(np.sqrt),
    "squeeze": lambda x, *, dimensions: np.squeeze(x, tuple(dimensions)),
    "stack": lambda *xs, axis=0, **_: np.stack(xs, axis),
    "stop_gradient": _elementwise(lambda x: x),
    "sub": _elementwise(np.subtract),
    "transpose": lambda x, *, permutation: np.transpose(x, permutation),
    "while": _while,
}
