"""Operations of networks on each element, as texts of Modelica."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from acausal._jax import Equation, name_of, shapes
from acausal.errors import DataError
from acausal.export.modelica_text.lines import BlockTerm, Body, Index

Rule = Callable[[Body, Equation, Sequence[BlockTerm]], Sequence[BlockTerm]]

TEXTS: dict[str, str] = {
    "abs": "abs({0})", "acos": "acos({0})", "add": "({0} + {1})", "add_any": "({0} + {1})", "asin": "asin({0})",
    "atan": "atan({0})", "atan2": "atan2({0}, {1})", "convert_element_type": "{0}", "cos": "cos({0})",
    "cosh": "cosh({0})", "div": "({0}/{1})", "exp": "exp({0})", "expm1": "(exp({0}) - 1)", "log": "log({0})",
    "log1p": "log(1 + {0})", "logistic": "(1/(1 + exp(-{0})))", "max": "max({0}, {1})", "min": "min({0}, {1})",
    "mul": "({0}*{1})", "neg": "(-{0})", "pow": "({0}^{1})", "rsqrt": "(1/sqrt({0}))", "sin": "sin({0})",
    "sinh": "sinh({0})", "sqrt": "sqrt({0})", "square": "({0}^2)", "sub": "({0} - {1})",
    "tan": "tan({0})", "tanh": "tanh({0})", "clamp": "min(max({1}, {0}), {2})",
    "sign": "noEvent(if {0} > 0 then 1 else if {0} < 0 then -1 else 0)",
}  # fmt: skip
"""Operations on each element."""

CONDITIONS: dict[str, str] = {
    "ge": "({0} >= {1})", "gt": "({0} > {1})", "le": "({0} <= {1})", "lt": "({0} < {1})",
    "and": "({0} and {1})", "or": "({0} or {1})", "not": "(not {0})",
    "ne": "({0} < {1} or {0} > {1})", "eq": "({0} >= {1} and {0} <= {1})",
}  # fmt: skip
"""Conditions; Modelica has no equality of real numbers."""

KNOWN_CONDITIONS = {
    "(not true)": "false", "(not false)": "true", "(true and true)": "true", "(false or false)": "false",
    "(true and false)": "false", "(false and true)": "false", "(false and false)": "false",
}  # fmt: skip
"""Conditions that are known."""


def refuse(equation: Equation) -> DataError:
    """The error for an operation that has no counterpart."""
    return DataError(
        f"the operation '{name_of(equation)}' of this network or table has no counterpart in Modelica; write it "
        "without, export the model as an FMU, or, if it is a table of the library, leave out selfcontained=True"
    )


def shape_of(equation: Equation, i: int = 0) -> tuple[int, ...]:
    """Sizes of a result."""
    return shapes(equation.outvars)[i]


def _each(terms: Sequence[BlockTerm], shape: tuple[int, ...], index: Index) -> list[str]:
    """The elements of several arrays at a place; numbers, and axes of one element, serve all places."""
    found: list[str] = []
    for term in terms:
        own = index[len(shape) - len(term.shape) :]
        found.append(
            term.at(tuple("1" if n == 1 else i for n, i in zip(term.shape, own, strict=True)))
        )
    return found


NEUTRAL = {"add": 0.0, "add_any": 0.0, "sub": 0.0, "mul": 1.0, "div": 1.0}
"""Second arguments that change nothing."""


def _unchanged(equation: Equation, terms: Sequence[BlockTerm]) -> BlockTerm | None:
    """The argument that an operation leaves as it is."""
    name = name_of(equation)
    if name not in NEUTRAL:
        return None
    first, second = terms
    for term, other in ((first, second), (second, first)):
        same = other.value is not None and bool((other.value == NEUTRAL[name]).all())
        if same and term.shape == shape_of(equation):
            return term
        if name in ("sub", "div"):
            break
    return None


def _known_condition(
    equation: Equation, terms: Sequence[BlockTerm], texts: Sequence[str]
) -> str | None:
    """A condition that is known: of a number and itself, or infinity."""
    name = name_of(equation)
    if name in ("and", "or", "not"):
        return None
    if texts[0] == texts[1]:
        return "true" if name in ("ge", "le", "eq") else "false"
    for value, below in ((terms[1].value, ("lt", "le")), (terms[0].value, ("gt", "ge"))):
        if value is not None and np.isinf(value).all():
            rising = bool((value > 0).all())
            if name in ("eq", "ne"):
                return "true" if name == "ne" else "false"
            return "true" if (name in below) is rising else "false"
    return None


def _elementwise(template: str, truth: bool) -> Rule:
    def rule(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
        shape = shape_of(equation)
        same_term = _unchanged(equation, terms)
        if same_term is not None:
            return [same_term]

        def element(index: Index) -> str:
            texts = _each(terms, shape, index)
            known = _known_condition(equation, terms, texts) if truth else None
            if known is not None:
                return known
            found = template.format(*texts)
            return KNOWN_CONDITIONS.get(found, found)

        plain = template == "{0}" and all(t.is_plain for t in terms)
        whole = terms[0].whole if template == "{0}" else None
        bound = terms[0].truth if template == "{0}" else truth
        return [BlockTerm(block, shape, element, whole=whole, truth=bound, plain=plain)]

    return rule


def _convert(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    """Truth values as numbers and back; other types are all real."""
    (term,), shape = terms, shape_of(equation)
    wanted = np.dtype(equation.params["new_dtype"]) == bool
    if wanted == term.truth:
        return [term]
    template = "({0} < 0 or {0} > 0)" if wanted else "noEvent(if {0} then 1 else 0)"
    return [BlockTerm(block, shape, lambda index: template.format(term.at(index)), truth=wanted)]


def _add(sign: str) -> Rule:
    """Sums of products of matrices stay in one equation."""
    other = _elementwise(f"({{0}} {sign} {{1}})", False)

    def rule(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> Sequence[BlockTerm]:
        a, b = terms
        if (a.is_product or b.is_product) and a.shape == b.shape and a.whole and b.whole:
            return [BlockTerm(block, a.shape, None, whole=f"{a.whole} {sign} {b.whole}")]
        return other(block, equation, terms)

    return rule


def _power(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    n, (x,) = int(equation.params["y"]), terms
    template = f"({{0}}^{n})" if n >= 0 else f"(1/{{0}}^{-n})"
    return [BlockTerm(block, x.shape, lambda index: template.format(x.at(index)))]


def _select(block: Body, equation: Equation, terms: Sequence[BlockTerm]) -> list[BlockTerm]:
    if len(terms) != 3 or not terms[0].truth:
        raise refuse(equation)
    shape, truth = shape_of(equation), terms[1].truth

    def element(index: Index) -> str:
        which, no, yes = _each(terms, shape, index)
        if which in ("true", "false"):
            return yes if which == "true" else no
        choice = f"if {which} then {yes} else {no}"
        return f"({choice})" if truth else f"noEvent({choice})"

    return [BlockTerm(block, shape, element, truth=truth)]


ELEMENTWISE: dict[str, Rule] = {
    **{name: _elementwise(template, False) for name, template in TEXTS.items()},
    **{name: _elementwise(template, True) for name, template in CONDITIONS.items()},
    "add": _add("+"),
    "add_any": _add("+"),
    "convert_element_type": _convert,
    "integer_pow": _power,
    "select_n": _select,
    "sub": _add("-"),
}
"""By operation, how its results are written."""
