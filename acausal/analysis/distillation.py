"""`distill`: a short formula for a law that a network has learned."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import NamedTuple, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax.typing import ArrayLike
from jaxtyping import Array, Float
from scipy.optimize import least_squares

from acausal._jax import is_number
from acausal.errors import (
    DeclarationError,
    TrainingError,
    known_name,
    listing,
    need_whole,
    percent,
    shown,
)
from acausal.modeling import names_in
from acausal.networks import check_inputs, law_of

NEAREST = 1e-12
"""The root is constant below this, where its derivative would be unbounded."""


AnyArray: TypeAlias = Array | np.ndarray


class Term(NamedTuple):
    """A term of a formula, without its coefficient.

    Attributes:
        value: of ``x / s``, given the array library to compute it with (`jax.numpy` or `numpy`) and ``x / s``.
        symbol: the same in sympy.
        scaled: whether the term has a scale ``s``; the scale of a power is part of its coefficient.
    """

    value: Callable[[ModuleType, AnyArray], AnyArray]
    symbol: Callable[[sp.Expr], sp.Expr]
    scaled: bool


def _root(xp: ModuleType, x: AnyArray) -> AnyArray:
    return xp.sign(x) * xp.sqrt(xp.maximum(xp.abs(x), NEAREST))


TERMS: dict[str, Term] = {
    "constant": Term(lambda xp, x: xp.ones_like(x), lambda x: sp.Integer(1), False),
    "linear": Term(lambda xp, x: x, lambda x: x, False),
    "square": Term(lambda xp, x: x**2, lambda x: x**2, False),
    "cube": Term(lambda xp, x: x**3, lambda x: x**3, False),
    "signed square": Term(lambda xp, x: x * xp.abs(x), lambda x: x * sp.Abs(x), False),
    "signed root": Term(_root, lambda x: sp.sign(x) * sp.sqrt(sp.Abs(x)), False),
    "tanh": Term(lambda xp, x: xp.tanh(x), sp.tanh, True),
    "bump": Term(lambda xp, x: x * xp.exp(-(x**2)), lambda x: x * sp.exp(-(x**2)), True),
    "exponential": Term(lambda xp, x: xp.expm1(x), lambda x: sp.exp(x) - 1, True),
}
"""What a formula can be made of: powers, saturation, the Stribeck bump of friction, a diode's exponential."""


class Formula(eqx.Module):
    """``f(x) = Σ c_i term_i(x / s_i)``: a law that can be the network of a neural element, ``net=formula``.

    Its coefficients and scales can be trained, like weights.

    Attributes:
        terms: names in `TERMS`.
        coefficients, scales: c and s, shape (number of terms,).
    """

    terms: tuple[str, ...] = eqx.field(static=True)
    coefficients: Float[Array, " n_terms"]
    scales: Float[Array, " n_terms"]

    def __call__(self, *inputs: ArrayLike) -> Float[Array, ""]:
        """The value for a scalar."""
        check_inputs(self, inputs, 1)
        point = jnp.asarray(inputs[0], float)
        parts = zip(self.terms, self.scales, strict=True)
        values = [TERMS[name].value(jnp, point / scale) for name, scale in parts]
        return jnp.sum(self.coefficients * jnp.stack(values))

    def expression(self, x: sp.Expr | None = None) -> sp.Expr:
        """The formula in sympy, of a symbol (by default ``x``)."""
        symbol = sp.Symbol("x", real=True) if x is None else x
        parts = zip(self.terms, self.coefficients.tolist(), self.scales.tolist(), strict=True)
        return sp.Add(
            *(_number(c) * TERMS[name].symbol(symbol / _number(s)) for name, c, s in parts)
        )


def _number(value: float) -> sp.Expr:
    return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e6 else sp.Float(value)


Points: TypeAlias = Float[np.ndarray, " n"]
TermColumns: TypeAlias = Float[np.ndarray, "n n_terms"]
Numbers: TypeAlias = Float[np.ndarray, " n_terms"]

POINTS = 401
"""Points at which law and formula are compared."""

FINEST, WIDEST, SCALES = 300.0, 2.0, 24
"""Scales from |x|max over the first number to |x|max times the second are tried. Wider terms are like powers."""

SLACK = 1e-9
"""How much bounds are widened, as the initial point may lie on one."""

ENOUGH = 0.7
"""A further term must reduce the error at least by this factor."""

BEAM = 8
"""How many formulas of each length are extended."""

PLAIN = 1.1
"""Factor by which the error of a formula may be larger for each scale that it does not have."""

LEAST, HUGE = 1e-100, 1e9
"""Terms with smaller or larger values are not used."""

DIGITS = range(2, 8)
WORSE, EXACT = 1.05, 1e-5
"""Digits of numbers that are tried; rounding may increase the error by a factor, or up to a fraction of the law."""


@dataclass(frozen=True, eq=False)
class Distilled:
    """A formula and how good it is.

    Attributes:
        formula: the law, ready to be the network of a neural element (``neural.Resistance(net=...)``).
        expression: the same in sympy, of ``x``, in the units of the law.
        error: RMS difference from the network over the interval, in the units of the law.
        relative_error: the same relative to the RMS of the law about its mean.
        interval: where they were compared.
    """

    formula: Formula
    expression: sp.Expr
    error: float
    relative_error: float
    interval: tuple[float, float]

    def __repr__(self) -> str:
        low, high = self.interval
        return (
            f"{self.expression}   (error {self.error:.3g}, {percent(self.relative_error)}, "
            f"for x from {low:.3g} to {high:.3g})"
        )


def distill(
    network: Callable[..., Array],
    low: float,
    high: float,
    *,
    terms: int = 4,
    tolerance: float = 0.01,
    among: Sequence[str] = tuple(TERMS),
) -> Distilled:
    """A short formula for a learned law of one variable.

    A beam search: the best few formulas of each length are extended by a term, with all scales and coefficients fitted
    together, until the best is good enough or a further term hardly helps. Outside of the interval the formula
    extrapolates as its terms do.

    Arguments:
        network: a network of a trained model, ``fit.params["damper.net"]``, or any function of a scalar; for an
            energy its derivative is distilled.
        low, high: the interval of its data, such as ``fit.seen["damper.net"].interval()``.
        terms: the most terms that the formula may have.
        tolerance: error, relative to the law's RMS about its mean, at which it is good enough.
        among: names of terms to choose from, out of `acausal.analysis.distillation.TERMS`.

    Raises:
        TrainingError: for an interval, a term or a network that cannot be used.
    """
    names = _checked(low, high, terms, tolerance, among)
    x = np.linspace(low, high, POINTS)
    y = _values(network, x)
    size = float(np.std(y)) or 1.0
    beam: list[_Candidate] = [_Candidate(Formula((), jnp.zeros(0), jnp.zeros(0)), np.inf)]
    best: _Candidate | None = None
    for _ in range(terms):
        beam = _longer(x, y, beam, names)
        if best is not None and beam[0].error > ENOUGH * best.error:
            break
        best = beam[0]
        if best.error <= tolerance * size:
            break
    assert best is not None
    formula = _rounded(best.formula, best.error, x, y)
    error = _rms(formula, x, y)
    return Distilled(formula, formula.expression(), error, error / size, (float(low), float(high)))


def _checked(
    low: float, high: float, terms: int, tolerance: float, among: Sequence[str]
) -> tuple[str, ...]:
    for argument, value in {"low": low, "high": high, "tolerance": tolerance}.items():
        if not is_number(value):
            raise TrainingError(f"distill: {argument}={shown(value)}; give a finite number.")
    if not low < high:
        raise TrainingError(f"distill: {low:g} to {high:g} is not an interval; give low < high.")
    need_whole(terms, "distill: terms", TrainingError, 1)
    among = names_in(among, "among")
    for name in among:
        known_name(name, TERMS, "distill: there is no term", TrainingError)
    if not among:
        raise TrainingError(f"distill: no terms to choose from; there are {listing(TERMS)}.")
    return among


def _values(network: Callable[..., Array], x: Points) -> Points:
    try:
        y = np.asarray(jax.jit(jax.vmap(law_of(network)))(jnp.asarray(x)))
    except (TypeError, DeclarationError):  # called with one argument
        y = None
    if y is None or y.shape != x.shape:
        raise TrainingError(
            "distill: the network is not a law of one variable; fix its other arguments: "
            "distill(lambda x: network(x, 293.15), low, high)."
        )
    if not np.isfinite(y).all():
        raise TrainingError("distill: the network is not finite everywhere in the interval.")
    return y


def _columns(x: Points, chosen: Sequence[tuple[str, float]]) -> TermColumns:
    """Values of terms at all points, one column for each."""
    with np.errstate(over="ignore"):
        return np.stack([TERMS[name].value(np, x / scale) for name, scale in chosen], axis=1)


@dataclass(frozen=True, eq=False)
class _Candidate:
    formula: Formula
    error: float

    @property
    def rank(self) -> float:
        """The error, with a penalty for every scale."""
        return self.error * PLAIN ** sum(TERMS[n].scaled for n in self.formula.terms)


def _longer(
    x: Points, y: Points, beam: list[_Candidate], names: tuple[str, ...]
) -> list[_Candidate]:
    """The best formulas with one term more than those of a beam."""
    found: dict[tuple[str, ...], _Candidate] = {}
    for candidate in beam:
        known = candidate.formula
        chosen = list(zip(known.terms, known.scales.tolist(), strict=True))
        for name in names:
            scale = _best_scale(x, y, chosen, name)
            if scale is None:
                continue
            formula = _polished(x, y, [*chosen, (name, scale)])
            new = _Candidate(formula, _rms(formula, x, y))
            key = tuple(sorted(formula.terms))
            if key not in found or new.error < found[key].error:
                found[key] = new
    return sorted(found.values(), key=lambda c: c.rank)[:BEAM]


def _best_scale(x: Points, y: Points, chosen: list[tuple[str, float]], name: str) -> float | None:
    """The scale of a further term with the smallest error; ``None`` if the term is not possible."""
    if not TERMS[name].scaled:
        return None if any(name == n for n, _ in chosen) else 1.0
    reach = float(np.max(np.abs(x)))
    scales = reach * np.geomspace(1 / FINEST, WIDEST, SCALES)
    tried = [*scales, *(-scales if name == "exponential" else ())]
    errors = {s: _squared_error(_columns(x, [*chosen, (name, s)]), y) for s in map(float, tried)}
    finite = {s: error for s, error in errors.items() if np.isfinite(error)}
    return min(finite, key=lambda s: finite[s]) if finite else None


def _squared_error(columns: TermColumns, y: Points) -> float:
    largest = np.max(np.abs(columns), axis=0)
    if not np.all((largest > LEAST) & (largest < HUGE)):
        return np.inf
    return float(np.sum((columns @ _solved(columns, y) - y) ** 2))


def _solved(columns: TermColumns, y: Points) -> Numbers:
    size = np.maximum(np.sqrt(np.sum(columns**2, axis=0)), LEAST)
    return np.linalg.lstsq(columns / size, y, rcond=1e-10)[0] / size


def _polished(x: Points, y: Points, chosen: list[tuple[str, float]]) -> Formula:
    """The formula with all scales fitted at once; for given scales, the coefficients follow by linear least squares."""
    names = tuple(n for n, _ in chosen)
    scales = np.array([s for _, s in chosen])
    free = np.array([TERMS[n].scaled for n in names])

    def all_scales(logs: Numbers) -> Numbers:
        moved = scales.copy()
        moved[free] *= np.exp(logs)
        return moved

    def residual(logs: Numbers) -> Points:
        columns = _columns(x, list(zip(names, all_scales(logs), strict=True)))
        columns = np.nan_to_num(columns, posinf=HUGE, neginf=-HUGE)
        return columns @ _solved(columns, y) - y

    if free.any():
        spread = float(np.std(y)) or 1.0
        sizes = np.log(np.abs(scales[free]) / float(np.max(np.abs(x))))
        low, high = -np.log(FINEST) - sizes, np.log(WIDEST) - sizes
        bounds = (np.minimum(low, 0.0) - SLACK, np.maximum(high, 0.0) + SLACK)
        found = least_squares(lambda z: residual(z) / spread, np.zeros(free.sum()), bounds=bounds)
        scales = all_scales(found.x)
    columns = _columns(x, list(zip(names, scales, strict=True)))
    return Formula(names, jnp.asarray(_solved(columns, y)), jnp.asarray(scales))


def _rms(formula: Formula, x: Points, y: Points) -> float:
    columns = _columns(x, list(zip(formula.terms, formula.scales.tolist(), strict=True)))
    return float(np.sqrt(np.mean((columns @ np.asarray(formula.coefficients) - y) ** 2)))


def _rounded(formula: Formula, error: float, x: Points, y: Points) -> Formula:
    """The formula with as few digits as possible: scales are rounded first, then coefficients are fitted to them."""
    allowed = max(WORSE * error, EXACT * (float(np.std(y)) or 1.0))
    for digits in DIGITS:
        scales = _to_digits(np.asarray(formula.scales), digits)
        columns = _columns(x, list(zip(formula.terms, scales, strict=True)))
        coefficients = _to_digits(_solved(columns, y), digits)
        rounded = Formula(formula.terms, jnp.asarray(coefficients), jnp.asarray(scales))
        if _rms(rounded, x, y) <= allowed:
            return rounded
    return formula


def _to_digits(values: Numbers, digits: int) -> Numbers:
    return np.array([float(f"{v:.{digits - 1}e}") for v in values])
