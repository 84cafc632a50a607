"""How JAX represents a traced function: the names of its operations and of their parameters.

Everything that this package relies on and that JAX does not document is in this file. `tests/_jax/test_primitives.py`
fails when JAX changes it. The code that reads jaxprs then falls back on `jax.vmap` and `jax.lax.scan`, which is slower.

`jax.extend.core.primitives` is public, but it does not list all operations (``split``, ``stack``), and which ones
it lists depends on the version: hence names instead.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import jax
from jax import Array
from jax.extend.core import ClosedJaxpr, Jaxpr, JaxprEqn, Literal, Var, jaxpr_as_fun

Equation: TypeAlias = JaxprEqn
"""One operation of a traced function."""


def _names(text: str) -> frozenset[str]:
    return frozenset(text.split())


CALLED = ("jaxpr", "call_jaxpr", "fun_jaxpr")
"""Parameters that hold the jaxpr which an operation calls."""

CALLS = _names(
    "jit pjit closed_call core_call checkpoint remat remat2 "
    "custom_jvp_call custom_vjp_call custom_vjp_call_jaxpr"
)
"""Operations that call a jaxpr. (Rules for derivatives have been applied before.)"""

WRITTEN_OUT = _names("call_hi_primitive eval_jaxpr")
"""Further operations that call a jaxpr, from JAX 0.12 on: of roots, for example."""

OBJECT = "_prim"
"""The parameter of an operation with an object that writes the jaxpr."""

ELEMENTWISE = _names(
    "abs acos acosh add add_any and asin asinh atan atan2 atanh cbrt ceil clamp convert_element_type copy cos "
    "cosh div eq erf exp exp2 expm1 floor ge gt integer_pow is_finite le log log1p log2 logistic lt max min mul "
    "ne neg nextafter not one_minus_square or pow rem round rsqrt select_n sign sin sinh sqrt square "
    "stop_gradient sub tan tanh xor"
)
"""Operations on each element of arrays of one shape; some of their arguments may be single numbers."""

AXES_FROM_THE_FRONT = _names(
    "argmax concatenate reduce_and reduce_max reduce_min reduce_or reduce_prod reduce_sum rev split squeeze stack "
    "unstack"
)
"""Operations whose parameters count axes from the front, so that a further axis at the end changes nothing."""

BARRIER = "optimization_barrier"
BROADCAST, DOT, PAD, RESHAPE = "broadcast_in_dim", "dot_general", "pad", "reshape"
SCAN, SLICE, TRANSPOSE, WHILE = "scan", "slice", "transpose", "while"

PARAMETERS: Mapping[str, tuple[str, ...]] = {
    BROADCAST: ("shape", "broadcast_dimensions"),
    DOT: ("dimension_numbers",),
    PAD: ("padding_config",),
    RESHAPE: ("new_sizes",),
    SCAN: ("jaxpr", "length", "reverse", "unroll"),
    SLICE: ("start_indices", "limit_indices", "strides"),
    TRANSPOSE: ("permutation",),
}
"""Parameters of operations, in the order in which `parameters` gives them."""

LOOPS = frozenset({SCAN, WHILE})
"""Operations that repeat a jaxpr."""

COMPILED = (
    ELEMENTWISE
    | AXES_FROM_THE_FRONT
    | PARAMETERS.keys()
    | LOOPS
    | CALLS
    | {BARRIER, "custom_linear_solve", "dynamic_slice", "gather", "iota"}
)
"""Operations that XLA compiles itself; for others, and for products of two matrices, it calls libraries."""


class UnknownEquationError(Exception):
    """JAX has written an operation in a way that this version of acausal cannot read."""


class Scan(NamedTuple):
    """A loop over rows.

    Attributes:
        body: its closed jaxpr: (constants, carry, row) -> (carry, outputs).
        n_constants, n_carry: how many of its arguments are constants, and how many are carried.
        options: further keyword arguments of `jax.lax.scan`.
    """

    body: ClosedJaxpr
    n_constants: int
    n_carry: int
    options: dict[str, Any]


def name_of(equation: Equation) -> str:
    """The name of an operation."""
    return equation.primitive.name


def parameters(equation: Equation) -> tuple[Any, ...]:
    """The values of an operation's `PARAMETERS`.

    Raises:
        UnknownEquationError: if JAX calls them something else.
    """
    return _read(name_of(equation), equation.params)


def _read(name: str, params: Mapping[str, Any]) -> tuple[Any, ...]:
    wanted = PARAMETERS[name]
    if missing := [parameter for parameter in wanted if parameter not in params]:
        raise UnknownEquationError(f"'{name}' has no parameter {', '.join(missing)}")
    return tuple(params[parameter] for parameter in wanted)


def scan_of(params: Mapping[str, Any]) -> Scan:
    """The parts of a scan, from its parameters.

    Raises:
        UnknownEquationError: if JAX writes scans in another way.
    """
    body, *options = _read(SCAN, params)
    n_constants, n_carry = _shared_and_carried(params)
    names = PARAMETERS[SCAN][1:]
    return Scan(_closed(body), n_constants, n_carry, dict(zip(names, options, strict=True)))


def _shared_and_carried(params: Mapping[str, Any]) -> tuple[int, int]:
    """How many arguments of a scan are constants, and how many are carried."""
    if "num_consts" in params and "num_carry" in params:  # to JAX 0.11
        return params["num_consts"], params["num_carry"]
    try:
        constants, carry, _ = params["ft_in"].unpack()  # from JAX 0.12: a tree for each kind
        return len(constants), len(carry)
    except (KeyError, AttributeError, TypeError, ValueError) as error:
        raise UnknownEquationError(f"'scan' does not say what it carries ({error})") from error


def called(equation: Equation) -> ClosedJaxpr:
    """The closed jaxpr that an operation calls.

    Raises:
        UnknownEquationError: if there is none where JAX is known to keep it.
    """
    for name in CALLED:
        if name in equation.params:
            return _closed(equation.params[name])
    if OBJECT in equation.params:
        return _written_out(equation.params[OBJECT], equation)
    raise UnknownEquationError(f"'{name_of(equation)}' has no parameter {' or '.join(CALLED)}")


def _written_out(of: Any, equation: Equation) -> ClosedJaxpr:
    """What an object stands for that is an operation."""

    def expanded(*flat: Any) -> list[Any]:
        return jax.tree.leaves(of.expand(*jax.tree.unflatten(of.in_tree, flat)))

    given: list[Any] = [v.aval for v in equation.invars]
    return jax.make_jaxpr(expanded)(*(jax.ShapeDtypeStruct(a.shape, a.dtype) for a in given))


def bind(equation: Equation, arrays: Sequence[Array]) -> list[Array]:
    """The results of an operation for other arguments."""
    results = equation.primitive.bind(*arrays, **equation.params)
    return list(results) if equation.primitive.multiple_results else [results]


def shapes(atoms: Sequence[Var | Literal]) -> list[tuple[int, ...]]:
    """The shapes of variables; () for those without a shape, such as a token."""
    return [getattr(atom.aval, "shape", ()) for atom in atoms]


def largest(equation: Equation) -> int:
    """The most elements of any array that an operation reads or writes."""
    return max(map(math.prod, shapes([*equation.invars, *equation.outvars])), default=0)


def all_equations(jaxpr: Jaxpr, in_loop: bool = False) -> Iterator[tuple[Equation, bool]]:
    """All operations of a jaxpr and of those within it, and whether they are part of a loop."""
    for equation in jaxpr.eqns:
        yield equation, in_loop
        for inner in _inner(equation.params):
            yield from all_equations(inner, in_loop or name_of(equation) in LOOPS)


def is_readable(equation: Equation) -> bool:
    """Whether the jaxpr that an operation calls or repeats can be found in it."""
    return name_of(equation) not in LOOPS | CALLS or any(True for _ in _inner(equation.params))


def as_function(closed: ClosedJaxpr, constants: Sequence[Array]) -> Callable[..., list[Array]]:
    """A traced function with other constants in place of those that it captured."""
    return jaxpr_as_fun(ClosedJaxpr(closed.jaxpr, list(constants)))


def _closed(jaxpr: Jaxpr | ClosedJaxpr) -> ClosedJaxpr:
    return jaxpr if isinstance(jaxpr, ClosedJaxpr) else ClosedJaxpr(jaxpr, [])


def _inner(params: Mapping[str, Any]) -> Iterator[Jaxpr]:
    """The jaxprs among the parameters of an operation."""
    for value in params.values():
        for item in value if isinstance(value, tuple | list) else (value,):
            if isinstance(item, Jaxpr | ClosedJaxpr):
                yield _closed(item).jaxpr
