"""Right-hand sides and networks as CasADi functions: for optimal control, with exact derivatives of any order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from acausal._jax import Equation, name_of, need_double_precision, scan_of
from acausal.errors import DataError, need_package
from acausal.export.target import target_of, traced
from acausal.export.traced import places, subscripts, walk
from acausal.system import System

if TYPE_CHECKING:
    from casadi import Function


def casadi(
    model: System | Callable[..., Any],
    params: Mapping[str, Any] | None = None,
    *,
    network: str | None = None,
    inputs: Sequence[str] | None = None,
    outputs: Sequence[str] = (),
) -> Function:
    """A network, or the right-hand side of a model, as a CasADi function of expressions.

    CasADi differentiates it exactly, as often as one likes, and hands it to solvers of optimal control problems. Of a
    model it has the arguments ``t``, ``x`` and ``u`` (and ``d``, the discrete variables, if there are any) and the
    results ``der(x)`` and ``y``; what has no elements is left out. Vectors are columns. The package is under the LGPL.

    Arguments:
        model: a compiled system, or a network: a module that is called with scalars.
        params: of the system; by default its own.
        network: the name of a network among ``params``, to take it alone.
        inputs: names of a network's arguments; by default as in `acausal.export.onnx`.
        outputs: names of the variables in ``y``; of a network the name of its result.

    Raises:
        DataError: in one sentence, for an operation without counterpart (the iterations of a nonlinear algebraic
            loop), an unknown name, or if the package casadi is not installed.
    """
    need_double_precision()
    need_package("casadi", "export.casadi", "mpc")
    import casadi

    ca: Any = casadi
    target = target_of(model, params, network, inputs, outputs, None, False, "casadi")
    closed = traced(target, None, "casadi")
    columns = [ca.SX.sym(_plain(p.name), int(np.prod(p.shape))) for p in target.inputs]
    given = [_elements(c, p.shape) for c, p in zip(columns, target.inputs, strict=True)]
    found = _Walk(ca).results(closed, given)
    results = [ca.vertcat(*_objects(value).ravel().tolist()) for value in found]
    names = [[_plain(p.name) for p in ports] for ports in (target.inputs, target.outputs)]
    return ca.Function("model", columns, results, *names)


def _plain(name: str) -> str:
    """A name as CasADi has them, of letters, digits and single underscores."""
    words = "".join(c if c.isascii() and c.isalnum() else " " for c in name).split()
    return "_".join(words)


@dataclass(frozen=True, eq=False)
class Symbols:
    """An array of objects: CasADi expressions and numbers."""

    of: np.ndarray


Known: TypeAlias = Symbols | np.ndarray


def _elements(column: Any, shape: tuple[int, ...]) -> Symbols:
    found = np.empty(column.shape[0], object)
    found[:] = [column[i] for i in range(len(found))]
    return Symbols(found.reshape(shape))


def _objects(value: Known) -> np.ndarray:
    return value.of if isinstance(value, Symbols) else np.asarray(value, float).astype(object)


class _Walk:
    """The walk through what JAX has traced: numbers move as NumPy moves them, CasADi computes with them."""

    def __init__(self, ca: Any) -> None:
        self.rules = _elementwise(ca)

    def results(self, closed: Any, given: Sequence[Known]) -> list[Known]:
        return walk(closed, given, self.apply)

    def apply(self, equation: Equation, arguments: list[Known], origin: str) -> Sequence[Known]:
        name = name_of(equation)
        if name in self.rules:
            rule = np.frompyfunc(self.rules[name](equation.params), len(arguments), 1)
            return [_symbols(rule(*map(_objects, arguments)))]
        if name in REDUCTIONS:
            combine = np.frompyfunc(self.rules[REDUCTIONS[name]]({}), 2, 1)
            (found,) = map(_objects, arguments)
            for axis in sorted(equation.params["axes"], reverse=True):
                found = combine.reduce(found, axis=axis)
            return [_symbols(found)]
        if name == "dot_general":
            return [_product(equation.params["dimension_numbers"], *map(_objects, arguments))]
        if name == "scan":
            return self._scan(equation, arguments)
        count = len(arguments) if name in MOVES else 1
        if name in MOVES | PICKS and all(isinstance(a, np.ndarray) for a in arguments[count:]):
            return _moved(equation, arguments, count)
        where = f", which '{origin}' needs" if origin else ""
        raise DataError(
            f"export.casadi: CasADi's expressions have no counterpart of '{name}'{where}"
            + (": a nonlinear algebraic loop is solved by iterations." if name == "while" else ".")
        )

    def _scan(self, equation: Equation, arguments: list[Known]) -> list[Known]:
        scan = scan_of(equation.params)
        fixed, n = arguments[: scan.n_constants], scan.n_constants + scan.n_carry
        carried, rows = arguments[scan.n_constants : n], [_objects(a) for a in arguments[n:]]
        length = int(scan.options["length"])
        order = range(length)[::-1] if scan.options["reverse"] else range(length)
        stacked: dict[int, list[np.ndarray]] = {}
        for k in order:
            own = [_symbols(r[k]) for r in rows]
            results = self.results(scan.body, [*fixed, *carried, *own])
            carried = results[: scan.n_carry]
            stacked[k] = [_objects(r) for r in results[scan.n_carry :]]
        columns = zip(*(stacked[k] for k in range(length)), strict=True)
        return [*carried, *(Symbols(np.stack(column)) for column in columns)]


def _symbols(value: Any) -> Symbols:
    """An array of objects, also of what NumPy gives as a single object."""
    if isinstance(value, np.ndarray):
        return Symbols(value)
    found = np.empty((), object)
    found[()] = value
    return Symbols(found)


REDUCTIONS = {
    "reduce_sum": "add",
    "reduce_prod": "mul",
    "reduce_max": "max",
    "reduce_min": "min",
    "reduce_and": "and",
    "reduce_or": "or",
}
"""Operations along axes, and those of two elements that they repeat."""

MOVES = frozenset({
    "broadcast_in_dim", "concatenate", "expand_dims", "pad", "reshape", "rev", "slice", "split", "squeeze", "stack",
    "transpose", "unstack",
})  # fmt: skip
"""Operations that move the elements of all of their arguments."""

PICKS = frozenset({"dynamic_slice", "gather"})
"""Operations that move the elements of their first argument; the others say which."""


def _moved(equation: Equation, arguments: list[Known], count: int) -> list[Known]:
    """The elements of the first arguments, at other places."""
    moved = [_objects(a) for a in arguments[:count]]
    every = np.concatenate([a.ravel() for a in moved])
    found = places(equation, [*moved, *arguments[count:]], range(count))
    return [_symbols(every[chosen]) for chosen in found]


def _product(numbers: Any, a: np.ndarray, b: np.ndarray) -> Symbols:
    """The products of all pairs of rows, added up, as `jax.lax.dot_general` orders them."""
    return _symbols(np.einsum(subscripts(numbers, (a.ndim, b.ndim)), a, b, optimize=False))


Rule: TypeAlias = Callable[[Mapping[str, Any]], Callable[..., Any]]


def _elementwise(ca: Any) -> dict[str, Rule]:
    """By JAX's name of an operation on elements, CasADi's, given its parameters."""

    def plain(function: Callable[..., Any]) -> Rule:
        return lambda params: function

    def choose(which: Any, *cases: Any) -> Any:
        found = cases[-1]
        for i in range(len(cases) - 2, -1, -1):
            found = ca.if_else(ca.eq(which, i), cases[i], found)
        return found

    def as_kind(kind: str) -> Callable[[Any], Any]:
        if kind == "b":
            return lambda x: ca.ne(x, 0)
        return (lambda x: x) if kind == "f" else lambda x: ca.sign(x) * ca.floor(ca.fabs(x))

    same = (
        "abs:fabs acos acosh asin asinh atan atan2 atanh ceil cos cosh eq erf exp expm1 floor ge gt le log log1p lt "
        "max:fmax min:fmin ne not:logic_not and:logic_and or:logic_or pow:power rem:fmod sign sin sinh sqrt "
        "tan tanh add:plus sub:minus mul:times div:rdivide"
    )
    found = {}
    for word in same.split():
        name, _, its = word.partition(":")
        found[name] = plain(getattr(ca, its or name))
    return found | {
        "neg": plain(lambda x: -x),
        "square": plain(lambda x: x * x),
        "add_any": found["add"],
        "rsqrt": plain(lambda x: 1 / ca.sqrt(x)),
        "cbrt": plain(lambda x: ca.sign(x) * ca.fabs(x) ** (1 / 3)),
        "exp2": plain(lambda x: ca.exp(x * np.log(2.0))),
        "logistic": plain(lambda x: 0.5 + 0.5 * ca.tanh(0.5 * x)),
        "clamp": plain(lambda low, x, high: ca.fmin(ca.fmax(x, low), high)),
        "is_finite": plain(lambda x: 1.0),
        "integer_pow": lambda params: lambda x: x ** int(params["y"]),
        "round": plain(lambda x: ca.sign(x) * ca.floor(ca.fabs(x) + 0.5)),
        "convert_element_type": lambda params: as_kind(np.dtype(params["new_dtype"]).kind),
        "select_n": plain(choose),
    }
