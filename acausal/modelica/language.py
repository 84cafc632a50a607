"""Functions of the language that need more than the values of their arguments, and those of arrays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import reduce
from typing import Any

import numpy as np
import sympy as sp

from acausal.modelica.evaluate import Evaluator
from acausal.modelica.overconstrained import is_root, is_rooted
from acausal.modelica.resources import path_of
from acausal.modelica.syntax import Comprehension, FunctionCall
from acausal.modelica.values import (
    Record,
    array_of,
    as_array,
    each,
    elements,
    identity,
    is_array,
    is_end,
    is_record,
    shape_of,
    type_of,
)
from acausal.modeling import (
    Discrete,
    Reference,
    change,
    check_size,
    der,
    dividend,
    edge,
    initial,
    owner_and_name,
    pre,
    sample,
)
from acausal.netlist import function as known_function


def _without_events(count: int) -> Callable[[Evaluator, FunctionCall], Any]:
    """The last of so many arguments, whose conditions are no events."""

    def applied(self: Evaluator, call: FunctionCall) -> Any:
        if len(call.arguments) != count:
            name = call.function.words[-1]
            raise self.wrong(f"{name}(...) takes {count} argument{'s' * (count != 1)}")
        frame = self.frame
        self.frame = replace(frame, events=False)
        try:
            return self.value(call.arguments[-1])
        finally:
            self.frame = frame

    return applied


def _homotopy(self: Evaluator, call: FunctionCall) -> Any:
    values = self.arguments(call, 2)
    return self.value(call.named["actual"]) if "actual" in call.named else values[0]


def _semi_linear(self: Evaluator, call: FunctionCall) -> Any:
    x, a, b = self.arguments(call, 3)
    holds = self.relation(">=", x, 0)
    return self.chosen(holds, self.arithmetic("*", a, x), self.arithmetic("*", b, x))


def _edge(self: Evaluator, call: FunctionCall) -> Any:
    if any(type_of(v) in ("Real", "Integer") for v in elements(self.arguments(call, 1)[0])):
        raise self.wrong("edge(...) takes a Boolean")
    return _mapped(edge)(self, call)


def _mapped(function: Callable[[Any], Any]) -> Callable[[Evaluator, FunctionCall], Any]:
    """A function of one variable, applied to each element."""

    def applied(self: Evaluator, call: FunctionCall) -> Any:
        frame = self.frame
        if frame.build is not None:  # the variable, not what an algorithm has assigned to it
            known = frame.build.names
            self.frame = replace(
                frame, local={k: v for k, v in frame.local.items() if k not in known}
            )
        (value,) = self.arguments(call, 1)
        self.frame = frame
        try:
            return each(function, value)
        except Exception as error:
            raise self.wrong(str(error)) from None

    return applied


def _der(self: Evaluator, call: FunctionCall) -> Any:
    (value,) = self.arguments(call, 1)
    if self.frame.calls and self.frame.build is None:
        raise self.wrong("a function has no derivatives; give them as arguments", len("der"))
    for element in elements(value):
        discrete = isinstance(element, Reference) and isinstance(element.declaration, Discrete)
        if discrete or type_of(element) in ("Boolean", "String"):
            raise self.wrong("only a Real that moves has a derivative")
    return each(lambda v: der(self.number(v)), value)


def _sample(self: Evaluator, call: FunctionCall) -> Any:
    start, period = self.arguments(call, 2)
    try:
        return sample(start, period)
    except Exception as error:
        raise self.wrong(str(error)) from None


FOLDED = {"sum": ("+", 0), "product": ("*", 1)}
"""Reductions by an operator, and what is left of no values."""


def _reduction(name: str) -> Callable[[Evaluator, FunctionCall], Any]:
    def reduced(self: Evaluator, call: FunctionCall) -> Any:
        if len(call.arguments) == 1:
            (value,) = self.arguments(call, 1)
            values = elements(as_array(value))
            if name in ("min", "max") and not is_array(value):
                raise self.wrong(f"{name}(...) takes an array or two numbers")
        else:
            values = self.arguments(call, 2)
        if name in FOLDED:
            operator, first = FOLDED[name]
            values = values if values and is_record(values[0]) else [first, *values]
            return reduce(lambda a, b: self._applied(operator, a, b), values)
        if values and all(type_of(v) == "Boolean" for v in values):
            return reduce(
                lambda a, b: self.logical(sp.And if name == "min" else sp.Or, a, b), values
            )
        numbers = [self.number(v) for v in values]
        if numbers and all(isinstance(v, int | float) for v in numbers):
            return min(numbers) if name == "min" else max(numbers)
        try:
            function = known_function(name)
            assert function is not None
            return self.finite(function(*(sp.sympify(v) for v in numbers)))
        except TypeError:
            raise self.wrong(f"{name} of {len(numbers)} values is not supported") from None

    return reduced


def _size(self: Evaluator, call: FunctionCall) -> Any:
    value, *which = self.arguments(call, 1, 2)
    shape = shape_of(value)
    if not which:
        return array_of(shape)
    index = self.whole(which[0], "a dimension")
    if not 1 <= index <= len(shape):
        raise self.wrong(f"there are {len(shape)} dimensions, not {index}")
    return shape[index - 1]


def _filled(number: Any) -> Callable[[Evaluator, FunctionCall], Any]:
    def filled(self: Evaluator, call: FunctionCall) -> Any:
        values = self.arguments(call, 1, 20)
        first, sizes = (values[0], values[1:]) if number is None else (number, values)
        shape = [self.whole(n, "a size") for n in sizes]
        check_size(int(np.prod(shape)), "the array")
        found = np.empty((*shape, *np.shape(first)), dtype=object)
        found[...] = first
        return found

    return filled


def _identity(self: Evaluator, call: FunctionCall) -> Any:
    (n,) = self.arguments(call, 1)
    n = self.whole(n, "a size")
    check_size(n * n, "the array")
    return identity(n)


def _diagonal(self: Evaluator, call: FunctionCall) -> Any:
    values = elements(self.arguments(call, 1)[0])
    return array_of(
        [[v if i == j else 0 for j in range(len(values))] for i, v in enumerate(values)]
    )


def _linspace(self: Evaluator, call: FunctionCall) -> Any:
    a, b, n = self.arguments(call, 3)
    n = self.whole(n, "a size")
    check_size(n, "the array")
    step = self.arithmetic("/", self.arithmetic("-", b, a), n - 1)
    return array_of([self.arithmetic("+", a, self.arithmetic("*", step, i)) for i in range(n)])


def _on_array(function: Callable[[Any], Any]) -> Callable[[Evaluator, FunctionCall], Any]:
    def applied(self: Evaluator, call: FunctionCall) -> Any:
        (value,) = self.arguments(call, 1)
        return function(value if isinstance(value, np.ndarray) else array_of([value]))

    return applied


def _cat(self: Evaluator, call: FunctionCall) -> Any:
    first, *parts = self.arguments(call, 2, 50)
    try:
        return np.concatenate(parts, axis=self.whole(first, "a dimension") - 1)
    except ValueError:
        raise self.wrong("the arrays do not fit") from None


def _array(self: Evaluator, call: FunctionCall) -> Any:
    if len(call.arguments) == 1 and isinstance(call.arguments[0], Comprehension):
        return self.value(call.arguments[0])
    return as_array([self.value(a) for a in call.arguments])


def _cross(self: Evaluator, call: FunctionCall) -> Any:
    a, b = self.arguments(call, 2)
    if np.shape(a) != (3,) or np.shape(b) != (3,):
        raise self.wrong("cross(...) takes two vectors of 3 elements")
    return array_of([a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))])


def _skew(self: Evaluator, call: FunctionCall) -> Any:
    (vector,) = self.arguments(call, 1)
    if np.shape(vector) != (3,):
        raise self.wrong("skew(...) takes a vector of 3 elements")
    x, y, z = vector
    minus = [self.arithmetic("-", 0, v) for v in (x, y, z)]
    return array_of([[0, minus[2], y], [z, 0, minus[0]], [minus[1], x, 0]])


def _outer_product(self: Evaluator, call: FunctionCall) -> Any:
    a, b = self.arguments(call, 2)
    return array_of([[self.arithmetic("*", x, y) for y in b] for x in a])


def _rounding(
    function: Callable[[Evaluator, Any, Any], Any], least: int
) -> Callable[[Evaluator, FunctionCall], Any]:
    def applied(self: Evaluator, call: FunctionCall) -> Any:
        values = self.arguments(call, least)
        return each(lambda *v: function(self, v[0], v[-1]), *values)

    return applied


def _floor(self: Evaluator, x: Any, _: Any) -> Any:
    return self.floored(x)


def _ceil(self: Evaluator, x: Any, _: Any) -> Any:
    return self.arithmetic("-", 0, self.floored(self.arithmetic("-", 0, x)))


def _quotient(self: Evaluator, x: Any, y: Any) -> Any:
    """The greatest integer not above ``x / y``."""
    on = dividend(self.number(x), self.number(y), lambda v: type_of(v) == "Integer")
    return self.floored(self.arithmetic("/", on, y))


def _div(self: Evaluator, x: Any, y: Any) -> Any:
    ratio = self.arithmetic("/", x, y)
    if not isinstance(ratio, sp.Expr):
        return int(ratio)
    below = self.arithmetic("-", 0, _quotient(self, self.arithmetic("-", 0, x), y))
    return self.chosen(self.relation(">=", ratio, 0), _quotient(self, x, y), below)


def _mod(self: Evaluator, x: Any, y: Any) -> Any:
    return self.arithmetic("-", x, self.arithmetic("*", _quotient(self, x, y), y))


def _rem(self: Evaluator, x: Any, y: Any) -> Any:
    return self.arithmetic("-", x, self.arithmetic("*", _div(self, x, y), y))


def _integer_of(self: Evaluator, x: Any, _: Any) -> Any:
    return x if isinstance(x, sp.Expr) else self.whole(x, "Integer(...)")


def _cardinality(self: Evaluator, call: FunctionCall) -> Any:
    self.connecting = True
    (end,) = self.arguments(call, 1)
    self.connecting = False
    if self.frame.build is None or not self.frame.build.connected:
        raise self.wrong("cardinality(...) stands in equations only", len("cardinality"))
    while isinstance(end, Record) or is_array(end):  # all parts are connected at once
        parts = end.fields.values() if isinstance(end, Record) else end
        end = next(part for part in parts if is_end(part))
    wanted, node = owner_and_name(end), self.frame.build.component._node
    counted = self.frame.build.counted
    if wanted not in counted:
        pairs = [pair for n in (node, *node.ancestors()) for pair in n.connections]
        counted[wanted] = sum(owner_and_name(e) == wanted for pair in pairs for e in pair)
    return counted[wanted]


def _norm(self: Evaluator, call: FunctionCall) -> Any:
    """The Euclidean norm of a vector."""
    vector, *order = self.arguments(call, 1, 2)
    if order and order[0] != 2:
        raise self.wrong("norm(v, p) is known for p=2 only")
    squares = reduce(lambda a, v: self.arithmetic("+", a, self.arithmetic("*", v, v)), vector, 0)
    return self.arithmetic("^", squares, 0.5)


def _assertion(self: Evaluator, call: FunctionCall) -> Any:
    raise self.wrong("assert(...) is a statement, not a value")


def _initial(self: Evaluator, call: FunctionCall) -> Any:
    self.arguments(call, 0)
    return initial()


def _string(self: Evaluator, call: FunctionCall) -> Any:
    value = self.value(call.arguments[0]) if call.arguments else ""
    if isinstance(value, sp.Basic):
        if self.varies(value):
            raise self.wrong("a text of what changes with time is not supported")
        value = self.known(value, "a text")
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _instance_name(self: Evaluator, call: FunctionCall) -> Any:
    self.arguments(call, 0)
    build = self.frame.build
    return self.frame.node.definition.name if build is None else build.path


def _resource(self: Evaluator, call: FunctionCall) -> Any:
    """The path of a file."""
    (text,) = self.arguments(call, 1)
    if not isinstance(text, str):
        raise self.wrong("the name of a file is a text")
    return path_of(text, self.frame, self.wrong)


def _of_numbers(
    function: Callable[..., Any], count: int = 1
) -> Callable[[Evaluator, FunctionCall], Any]:
    """A function of matrices whose elements are known when the model is built."""

    def applied(self: Evaluator, call: FunctionCall) -> Any:
        given = [self.known_array(v) for v in self.arguments(call, count)]
        try:
            found = function(*given)
        except np.linalg.LinAlgError as error:
            raise self.wrong(f"{call.function.text}: {str(error).lower()}") from None
        return array_of(found.tolist()) if np.ndim(found) else float(found)

    return applied


def _eigenvalues(matrix: Any) -> Any:
    """Real and imaginary parts, as columns."""
    found = np.linalg.eigvals(matrix)
    return np.stack([found.real, found.imag], axis=1)


SPECIAL: dict[str, Callable[[Evaluator, FunctionCall], Any]] = {
    "der": _der, "pre": _mapped(pre), "edge": _edge, "change": _mapped(change),
    "initial": _initial, "sample": _sample, "noEvent": _without_events(1), "smooth": _without_events(2),
    "homotopy": _homotopy, "semiLinear": _semi_linear,
    "sum": _reduction("sum"), "product": _reduction("product"), "min": _reduction("min"), "max": _reduction("max"),
    "size": _size, "ndims": lambda self, call: len(np.shape(self.arguments(call, 1)[0])),
    "zeros": _filled(0), "ones": _filled(1), "fill": _filled(None), "identity": _identity, "diagonal": _diagonal,
    "linspace": _linspace, "transpose": _on_array(lambda a: a.T), "vector": _on_array(lambda a: a.reshape(-1)),
    "scalar": _on_array(lambda a: a.reshape(-1)[0]), "matrix": _on_array(lambda a: a.reshape(len(a), -1)),
    "cat": _cat, "array": _array, "cross": _cross, "skew": _skew, "outerProduct": _outer_product,
    "symmetric": _on_array(lambda a: np.triu(a) + np.triu(a, 1).T),
    "integer": _rounding(_floor, 1), "floor": _rounding(_floor, 1), "ceil": _rounding(_ceil, 1),
    "div": _rounding(_div, 2), "mod": _rounding(_mod, 2), "rem": _rounding(_rem, 2),
    "Integer": _rounding(_integer_of, 1), "String": _string, "cardinality": _cardinality, "assert": _assertion,
    "getInstanceName": _instance_name, "Modelica.Utilities.Files.loadResource": _resource,
    "Modelica.Math.Vectors.norm": _norm, "Modelica.Math.Vectors.length": _norm,
    "Modelica.Math.Matrices.inv": _of_numbers(np.linalg.inv), "Modelica.Math.Matrices.det": _of_numbers(np.linalg.det),
    "Modelica.Math.Matrices.solve": _of_numbers(np.linalg.solve, 2),
    "Modelica.Math.Matrices.eigenValues": _of_numbers(_eigenvalues),
    "Connections.isRoot": is_root, "Connections.rooted": is_rooted, "rooted": is_rooted,
}  # fmt: skip
"""Functions of the language that need more than the values of their arguments."""
