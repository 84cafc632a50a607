"""The units of equations, values and connections: what is refused, in which words, and what is not."""

import contextlib
import inspect
import re
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, strategies as st

import acausal as ac
from acausal import components
from acausal.flattening.flat_model import FlatModel, flatten
from acausal.modeling import COMPUTABLE, Component
from acausal.units import dimensions, in_si
from acausal.units.check import check_dimensions
from acausal.units.dimensions import (
    BASE,
    DERIVED,
    NUMBER,
    PREFIXED,
    PREFIXES,
    QUANTITIES,
    ZEROS,
    Dimension,
    dimension as read,
    pint_unit,
    registry,
)
from acausal.units.infer import RULES, examine
from tests.support.counted import calls_below
from tests.support.parts import model

# -- units -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("N.m/rad", "J"),
        ("kg/m3", "kg.m-3"),
        ("m/s2", "m/s/s"),
        ("J/(kg.K)", "m2/(s2.K)"),
        ("kW.h", "J"),
        ("W/(m2.K4)", "kg/(s3.K4)"),
        ("rev/min", "1/s"),
        ("km/h", "m/s"),
        ("Ohm.F", "s"),
        ("N^0.5/m", "kg^0.5/(s.m**0.5)"),
        ("degC", "K"),
        ("1", "rad"),
        ("%", "1"),
        ("lbf/ft", "N/m"),
        ("newton", "N"),
        (" m * s ** -1 ", "m/s"),
        ("1/(m.s)", "Pa.m/(N.s)"),
    ],
)
def test_spellings_of_one_dimension(one: str, other: str) -> None:
    first, second = read(one), read(other)
    assert first is not None
    assert second is not None
    assert first.exponents == second.exponents


def test_a_unit_that_is_not_given_is_unknown() -> None:
    assert read("") is None
    assert read("1") == NUMBER


def of_pint(text: str) -> Dimension:
    powers = pint_unit(text).dimensionality
    return Dimension(tuple(powers.get(name, 0) for name in BASE.values()))


def test_the_tables_agree_with_pint() -> None:
    prefixed = {p + u for p in PREFIXES for u in PREFIXED if u != "kg"}
    prefixed.remove("mcd")  # a micro-day to pint
    for unit in (*BASE, *DERIVED, *QUANTITIES, *sorted(prefixed)):
        found, quantity = read(unit), registry().Quantity
        assert found is not None
        assert found.exponents == of_pint(unit).exponents, unit
        if unit not in ("kg", *ZEROS):
            one = quantity(1.0, pint_unit(unit)).to(pint_unit(str(found.of_si)))
            assert found.factor == pytest.approx(one.magnitude, rel=1e-12), unit
    for unit in ZEROS:
        found, at = read(unit), registry().Quantity(np.array([0.0, 1.0]), pint_unit(unit))
        zero, one = at.to("K").magnitude
        assert found is not None
        assert found.factor == pytest.approx(one - zero)
        assert found.zero == pytest.approx(zero)


def test_units_of_no_fixed_size_fit_all_of_their_dimension() -> None:
    decibel, number = read("dB"), read("1")
    assert decibel is not None
    assert number is not None
    assert decibel.agrees(number)
    assert decibel.agrees(read("%") or NUMBER)
    assert in_si("dB") is None


def test_units_are_written_as_they_are_read() -> None:
    for unit in QUANTITIES:
        assert str(read(unit)) == unit


@given(st.tuples(*[st.integers(-3, 3)] * len(BASE)))
def test_every_dimension_can_be_read_again(exponents: tuple[int, ...]) -> None:
    assert read(str(Dimension(exponents))) == Dimension(exponents)


def test_broken_powers_are_written() -> None:
    metre = read("m")
    assert metre is not None
    assert str(metre ** sp.Rational(1, 2)) == "m^0.5"


@pytest.mark.parametrize(
    ("unit", "meant"),
    [
        ("Nm", "N.m"),  # a fineness of yarn to pint
        ("kNm", "kN.m"),
        ("As", "A.s"),
        ("Nm/rad", "N.m/rad"),
        ("Kg", "kg"),
        ("k", "K"),  # Boltzmann's constant to pint
        ("N..m", "N.m"),
        ("m/", "m/s"),
        ("(m", "m"),
        ("m)", "m"),
        ("N/(m", "N/m"),
        ("m$", "m"),
        ("()", None),
        ("newtonn", None),
    ],
)
def test_what_is_no_unit(unit: str, meant: str | None) -> None:
    hint = f"did you mean '{meant}'?" if meant else "known are '1', 'm', "
    with pytest.raises(ac.UnitError, match=re.escape(f"'{unit}' is not a unit; {hint}")):
        read(unit)


def test_a_long_text_is_no_unit() -> None:
    with calls_below(10_000), pytest.raises(ac.UnitError, match=r"'m{77}\.\.\.' is not a unit"):
        read(100_000 * "m")


def test_a_unit_of_no_physics() -> None:
    with pytest.raises(ac.UnitError, match="'pixel' is not a unit"):
        read("pixel")


def test_a_misspelt_unit_names_its_place() -> None:
    class Wrong(ac.Component):
        M = ac.Parameter(1.0, unit="Nm")
        net = ac.Module(lambda key: lambda x: x, unit="N", takes=("meter per second",))

    message = refused(model(part=Wrong()))
    assert "Wrong 'part'.M: 'Nm' is not a unit; did you mean 'N.m'?" in message
    assert "Wrong 'part'.net: 'meter per second' is not a unit" in message


# -- equations -----------------------------------------------------------------------------------------

VARIABLES = {
    "s": "m", "s2": "m", "v": "m/s", "a": "m/s2", "f": "N", "phi": "rad", "w": "rad/s", "T": "K",
    "Tc": "degC", "Td": "degC", "mm": "mm", "dm": "dm", "mm_s": "mm/s", "bar": "bar", "deg": "deg",
    "rpm": "rev/min", "kWh": "kW.h", "share": "%",
    "u": "V", "i": "A", "p": "Pa", "A": "m2", "P": "W", "E": "J", "k": "1/s", "x": "", "y": "",
}  # fmt: skip
PARAMETERS = {
    "c": "N/m",
    "d": "N.s/m",
    "m": "kg",
    "tau": "s",
    "R": "Ohm",
    "C": "F",
    "n": "1",
    "T_ref": "K",
    "g": "",
}


class Stated(ac.Component):
    """Variables and parameters of these names and units, and the equations that it is given."""

    law = ac.Module(lambda key: lambda x, y: x, unit="N", takes=("m", "m/s"))
    free = ac.Module(lambda key: lambda x: x)

    def __init__(self, *stated: Callable[[Any], Any], initial: Any = None) -> None:
        super().__init__()
        for name, unit in VARIABLES.items():
            setattr(self, name, ac.Variable(unit=unit))
        for name, unit in PARAMETERS.items():
            setattr(self, name, ac.Parameter(1.0, unit=unit))
        self.stated, self.initial = stated, initial

    def equations(self) -> Iterator[ac.Eq]:
        return (ac.Eq(*equation(self)) for equation in self.stated)

    def initial_equations(self) -> Iterator[ac.Eq]:
        return (ac.Eq(*self.initial(self)) for _ in range(self.initial is not None))


def refused(part: ac.Component) -> str:
    """What is said of the units of a model, which is not compiled any further."""
    with pytest.raises(ac.UnitError) as caught:
        check_dimensions(flatten(part))
    return str(caught.value)


WRONG: dict[str, tuple[Callable[[Any], Any], str]] = {
    "another unit of a parameter": (
        lambda s: (s.E, s.c * s.s),
        "'E = c*s': 'E' is in N.m (torque or energy) but 'c*s' in N (force); should 'c' be in N (force)?",
    ),
    "a derivative is missing": (
        lambda s: (s.f, s.c * s.s + s.d * s.s),
        "'f' is in N (force) but 'd*s' in N.s (momentum); should 'd' be in N/m (stiffness), or is a der(...) missing",
    ),
    "a derivative": (
        lambda s: (ac.der(s.s), s.a),
        "'der(s)' is in m/s (speed) but 'a' in m/s2 (acceleration); is a der(...) missing or one too many?",
    ),
    "a derivative of a product": (
        lambda s: (ac.der(s.m * s.v), s.P),
        "'P' is in W (power) but 'der(v)*m' in N (force)",
    ),
    "a derivative of a derivative": (
        lambda s: (s.m * ac.der(ac.der(s.s)), s.P),
        "'P' is in W (power) but 'der(der(s))*m' in N (force)",
    ),
    "a product": (lambda s: (s.P, s.u / s.i), "'P' is in W (power) but 'u/i' in Ohm (resistance)"),
    "half of a product": (lambda s: (s.E, 0.5 * s.m * s.v), "but '0.5*m*v' in N.s (momentum)"),
    "a speed in millimetres": (
        lambda s: (ac.der(s.mm), s.v),
        "'der(mm)' is in 0.001 m/s (speed) but 'v' in m/s (speed); equations do not convert units: declare both in one",
    ),
    "a pressure in bar": (lambda s: (s.f, s.bar * s.A), "but 'A*bar' in 100000 N (force)"),
    "revolutions a minute": (lambda s: (s.w, s.rpm), "but 'rpm' in rev/min (frequency"),
    "power and kilowatt hours": (lambda s: (ac.der(s.kWh), s.P), "is in 3.6e+06 W (power) but"),
    "a sine of degrees": (lambda s: (s.x, ac.sin(s.deg)), "'deg' is in deg (pure number) but"),
    "a percentage": (lambda s: (s.x, ac.exp(s.share)), "'share' is in % (pure number) but"),
    "millimetres in a comparison": (
        lambda s: (s.x, ac.where(s.mm > s.s, 1, 2)),
        "'mm' is in mm (length) but 's' in m (length)",
    ),
    "degrees Celsius and kelvins": (
        lambda s: (s.f, s.g * (s.Tc - s.T)),
        "is in degC (temperature) but 'T' in K (temperature)",
    ),
    "the greater of degrees Celsius and kelvins": (
        lambda s: (s.x, s.g * ac.maximum(s.Tc, s.T)),
        "in degC (temperature)",
    ),
    "a multiple of pi": (lambda s: (s.A, ac.pi * s.s), "is in m2 (area) but 'pi*s' in m (length)"),
    "a power": (lambda s: (s.A, s.s**3), "'A' is in m2 (area) but 's**3' in m3 (volume)"),
    "a root": (
        lambda s: (s.v, ac.sqrt(2 * s.E)),
        "'v' is in m/s (speed) but 'sqrt(2)*sqrt(E)' in kg^0.5.m/s",
    ),
    "a sum within": (lambda s: (s.y, s.x * (s.s + s.v)), "'s' is in m (length) but 'v' in m/s"),
    "a sum with an unknown": (lambda s: (s.f, s.x + s.v), "'f' is in N (force) but 'v' in m/s"),
    "an exponent": (
        lambda s: (s.x, 2**s.s),
        "the exponent of '2', 's' is in m (length) but must be",
    ),
    "a base": (
        lambda s: (s.x, s.s**s.n),
        "the base of 's**n', 's' is in m (length) but must be a pure",
    ),
    "a sine": (
        lambda s: (s.x, ac.sin(s.s)),
        "the argument of sin, 's' is in m (length) but must be a pure number",
    ),
    "an exponential": (
        lambda s: (s.x, ac.exp(-s.k * s.s)),
        "the argument of exp, 'k*s' is in m/s (speed) but must be a pure number",
    ),
    "a logarithm": (lambda s: (s.x, ac.log(s.p)), "the argument of log, 'p' is in Pa (pressure)"),
    "a hyperbolic tangent": (
        lambda s: (s.f, s.c * s.s * ac.tanh(s.v)),
        "the argument of tanh, 'v' is in m/s (speed)",
    ),
    "an arc cosine": (
        lambda s: (s.phi, ac.acos(s.s)),
        "the argument of acos, 's' is in m (length)",
    ),
    "the angle of a vector": (
        lambda s: (s.phi, ac.atan2(s.s, s.f)),
        "'s' is in m (length) but 'f' in N (force)",
    ),
    "an angle": (
        lambda s: (s.v, ac.atan2(s.s, s.s2)),
        "'v' is in m/s (speed) but 'atan2(s, s2)' in 1 (pure number)",
    ),
    "a branch": (
        lambda s: (s.x, ac.where(s.v > 0, s.f, s.s)),
        "'f' is in N (force) but 's' in m (length)",
    ),
    "a branch and the other side": (
        lambda s: (s.f, ac.where(s.v > 0, s.p, 0)),
        "'f' is in N (force) but 'p' in Pa (pressure)",
    ),
    "a branch with numbers": (
        lambda s: (s.u * ac.where(s.x > 0, s.R, 1), s.i * ac.where(s.x > 0, 1, s.R)),
        "'i' is in A (current) but 'R*u' in V2/A",
    ),
    "a condition": (
        lambda s: (s.f, ac.where(s.v > s.f, s.c * s.s, 0)),
        "'f' is in N (force) but 'v' in m/s (speed)",
    ),
    "a condition of cases that fit": (
        lambda s: (
            s.u * ac.where(s.x > s.y + s.f + s.p, 1 / s.R, 1),
            s.i * ac.where(s.x > s.y + s.f + s.p, 1, s.R),
        ),
        "'f' is in N (force) but 'p' in Pa (pressure)",
    ),
    "a part of a condition": (
        lambda s: (s.f, ac.where(sp.And(s.v > 0, sp.Not(s.s < s.p)), s.c * s.s, s.d * s.v)),
        "'p' is in Pa (pressure) but 's' in m (length)",
    ),
    "a maximum": (
        lambda s: (s.f, ac.maximum(s.c * s.s, s.v)),
        "'v' is in m/s (speed) but 'c*s' in N (force)",
    ),
    "a minimum": (lambda s: (s.x, ac.minimum(s.f, s.p)), "'f' is in N (force) but 'p' in Pa"),
    "an absolute value": (lambda s: (s.f, ac.Abs(s.s)), "'f' is in N (force) but 'Abs(s)' in m"),
    "a sign": (lambda s: (s.f, ac.sign(s.f)), "but 'sign(f)' in 1 (pure number)"),
    "a sign of a sum": (lambda s: (s.n, ac.sign(s.f - s.s)), "'f' is in N (force) but 's' in m"),
    "a whole number": (lambda s: (s.x, s.s + ac.floor(s.f)), "but 'floor(f)' in N (force)"),
    "a remainder": (lambda s: (s.x, sp.Mod(s.s, s.p)), "'s' is in m (length) but 'p' in Pa"),
    "time": (lambda s: (s.s, s.a * ac.time), "'s' is in m (length) but 'a*time' in m/s (speed)"),
    "a bracket whose factor is multiplied out": (
        lambda s: (s.f, -3.0 * (s.Tc - s.T) - 2 * s.v),
        "'Tc' is in degC (temperature) but 'T' in K (temperature)",
    ),
    "a prescribed motion": (
        lambda s: (s.s2, ac.prescribed(s.s, s.f)),
        "'f', derivative 1 of 's', is in N (force) but must be in m/s (speed)",
    ),
    "a prescribed derivative": (
        lambda s: (s.a, ac.der(ac.prescribed(s.s, s.v))),
        "'a' is in m/s2 (acceleration) but 'v' in m/s (speed)",
    ),
    "what a network gives": (
        lambda s: (s.p, s.law(s.s, s.v)),
        "'p' is in Pa (pressure) but 'law(s, v)' in N (force)",
    ),
    "what a network takes": (
        lambda s: (s.f, s.law(s.s, s.p)),
        "argument 2 of 'law', 'p', is in Pa (pressure) but must be in m/s (speed)",
    ),
    "the rate of a network": (
        lambda s: (s.f, ac.der(s.law(s.s, s.v))),
        "'f' is in N (force) but 'der(s)*law'(s, v)' in N/s",
    ),
    "within a network": (
        lambda s: (s.f, s.free(s.s + s.p)),
        "'p' is in Pa (pressure) but 's' in m",
    ),
    "a temperature": (lambda s: (s.Tc, s.s), "'Tc' is in degC (temperature) but 's' in m (length)"),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_equations(name: str) -> None:
    equation, sentence = WRONG[name]
    message = refused(model(part=Stated(equation)))
    assert message.startswith("Stated 'part': '")
    assert sentence in message
    assert refused(model(part=Stated(initial=equation))) == message


@pytest.mark.parametrize(("unit", "told"), [("ms", "0.001 s (time)"), ("kg", "kg (mass)")])
def test_the_period_of_a_clock_is_in_seconds(unit: str, told: str) -> None:
    class Clock(ac.Component):
        start = ac.Parameter(0.0, unit="s")
        period = ac.Parameter(5.0, unit=unit)
        n = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            tick = ac.sample(self.start, self.period)
            yield ac.When(tick, ac.Eq(self.n, ac.pre(self.n) + 1))

    message = refused(Clock())
    assert f"'sample(start, period)': 'start' is in s (time) but 'period*k' in {told}" in message
    assert message.count("sample(") == 1


@pytest.mark.parametrize("period", [1, 1.0, 2, ac.pi, 0.001])
def test_a_clock_may_have_a_number_as_its_period(period: Any) -> None:
    class Clock(ac.Component):
        n = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            yield ac.When(ac.sample(0, period), ac.Eq(self.n, ac.pre(self.n) + 1))

    check_dimensions(flatten(Clock()))


RIGHT: dict[str, Callable[[Any], Any]] = {
    "a factor of temperatures on one scale": lambda s: (s.f, 3 * (s.Tc + 273.15 - s.T)),
    "a factor of temperatures beside an unknown": lambda s: (s.f, 2 * (s.Tc - s.T + s.x * s.s)),
    "a spring and a damper": lambda s: (s.f, s.c * (s.s - 0.1) + s.d * ac.der(s.s)),
    "energies": lambda s: (s.E, 0.5 * s.m * s.v**2 + s.c * s.s**2 / 2),
    "a balance": lambda s: (0, s.f - ac.der(s.m * s.v) + s.m * s.a),
    "a number as a constant with a unit": lambda s: (s.f, 5 * s.s**3 + 1.0 * s.v),
    "a large number as one": lambda s: (s.p, 1000 * s.a * s.s + s.s * s.v / 20),
    "a number that is not plain": lambda s: (s.p, 1.2 * s.v * s.a + 0.1 * s.T * s.c),
    "numbers and the time": lambda s: (s.s, 2 * ac.sin(ac.time) + 3 * ac.time),
    "functions of numbers and the time": lambda s: (s.f, s.c * s.s * ac.exp(-3 * ac.time)),
    "a literal as a term": lambda s: (s.s + 1, 2.5),
    "a literal as a constant of nature": lambda s: (s.f, 9.81 * s.m),
    "a sum of literals times": lambda s: (s.u, s.R * s.i * (1 + 0.00392 * (s.T - 293.15))),
    "angles": lambda s: (s.w, ac.der(s.phi) + s.phi / s.tau),
    "degrees Celsius": lambda s: (s.T, s.Tc + 273.15),
    "a difference of degrees Celsius": lambda s: (s.T, s.Tc - s.Td),
    "the mean of degrees Celsius": lambda s: (s.Tc, 0.5 * (s.Tc + s.Td)),
    "the greater of degrees Celsius": lambda s: (s.Tc, ac.maximum(s.Tc, s.Td)),
    "differences on two scales": lambda s: (s.x, (s.Tc - s.Td + s.T - s.T_ref) / s.T_ref),
    "a rate of degrees Celsius": lambda s: (ac.der(s.Tc), s.T / s.tau),
    "one scale into the other": lambda s: (s.Tc, s.T - s.T_ref),
    "numbers that convert": lambda s: (s.mm, 1000 * s.s),
    "small numbers that convert": lambda s: (s.s, s.dm / 10),
    "small numbers that convert back": lambda s: (s.dm, 10 * s.s),
    "pi that converts": lambda s: (s.P, s.tau * (2 * ac.pi * s.rpm / 60) ** 2 * s.x),
    "pi beside degrees": lambda s: (s.x, ac.sin(ac.pi / 180 * s.deg)),
    "speeds in millimetres": lambda s: (ac.der(s.mm), s.mm_s + s.mm / s.tau),
    "units that cancel": lambda s: (s.x, ac.exp(s.mm / s.mm - s.Tc / s.Tc)),
    "functions": lambda s: (s.x, ac.sin(s.w * ac.time + s.phi) * ac.exp(-ac.time / s.tau)),
    "a function of an unknown": lambda s: (s.n, ac.exp(s.x * s.s) + ac.log(s.g)),
    "an unknown factor": lambda s: (s.f, s.g * s.v),
    "an unknown in a sum": lambda s: (s.f, s.x + s.c * s.s),
    "an unknown exponent": lambda s: (s.f, s.c * ac.maximum(s.s, 0) ** s.g),
    "an exponent": lambda s: (s.x, (s.s / s.s2) ** s.n + 10 ** (s.n / 20)),
    "a number to an unknown": lambda s: (s.n, 2**s.x),
    "powers": lambda s: (s.A, ac.sqrt(s.s) * s.s**1.5 + s.s**3.0 / ac.Abs(s.s2)),
    "cases": lambda s: (s.f, ac.where(s.s > 0.5, s.c * s.s, 0)),
    "cases of numbers": lambda s: (
        s.u * ac.where(s.x > 0, 1 / s.R, 1),
        s.i * ac.where(s.x > 0, 1, s.R),
    ),
    "a step": lambda s: (s.v, ac.sign(s.s - s.s2) * s.v + 3 * ac.floor(s.v)),
    "an angle of a vector": lambda s: (s.phi, ac.atan2(s.s, s.s2)),
    "a prescribed motion": lambda s: (s.s2, ac.prescribed(s.s, s.v, s.a)),
    "its rate": lambda s: (s.a, ac.der(ac.prescribed(s.v, s.a))),
    "a prescribed unknown": lambda s: (s.s2, ac.prescribed(s.x, s.v)),
    "networks": lambda s: (s.f, s.law(s.s, s.v) + s.law(s.x, 0.5) + s.free(s.p)),
    "the rate of a network": lambda s: (s.P, s.v * s.law(s.s, s.v) + s.s * ac.der(s.law(s.s, 0))),
    "the rate of an unknown network": lambda s: (s.f, ac.der(s.free(s.p))),
}


@pytest.mark.parametrize("name", RIGHT)
def test_right_equations(name: str) -> None:
    equation = RIGHT[name]
    check_dimensions(flatten(Stated(equation, initial=equation)))


def test_every_function_of_equations_has_a_rule() -> None:
    for function in (*COMPUTABLE, sp.Add, sp.Mul, sp.Pow, sp.Eq, sp.Lt, sp.And, sp.Not, sp.ITE):
        assert any(kind in RULES for kind in function.__mro__), function


def test_many_cases_are_taken_as_a_whole() -> None:
    def switches(n: int) -> Callable[[Any], Any]:
        def equation(s: Any) -> Any:
            off = sum(ac.where(s.x > i, 1 / s.R, 1) for i in range(1, n))
            return s.u * (off + ac.where(s.x > n, 1 / s.R, 1)), s.i * ac.where(s.x > n, 1, s.R)

        return equation

    check_dimensions(flatten(Stated(switches(1))))
    message = refused(Stated(switches(7)))
    assert "in A (current)" in message
    assert "in V (voltage)" in message


# -- what is checked besides ---------------------------------------------------------------------------


def test_all_that_is_wrong_is_listed() -> None:
    message = refused(
        model(
            a=Stated(lambda s: (s.f, s.s), lambda s: (s.p, s.T)),
            b=Stated(lambda s: (s.f, s.s), lambda s: (s.p, s.T)),
        )
    )
    assert message == (
        "2 units are wrong: (1) Stated 'a' and 1 more: 'f = s': 'f' is in N (force) but 's' in m (length) "
        "(2) Stated 'a' and 1 more: 'p = T': 'p' is in Pa (pressure) but 'T' in K (temperature)"
    )


def test_at_most_a_dozen_are_listed() -> None:
    wrong = [lambda s, n=n: (s.f**n, s.s) for n in range(1, 21)]
    message = refused(Stated(*wrong))
    assert message.startswith("20 units are wrong: (1) Stated: 'f = s': ")
    assert "(12)" in message
    assert "(13)" not in message
    assert message.endswith(" and 8 more")


class Inner(ac.Component):
    m = ac.Parameter(1.0, unit="kg")
    masses = ac.Parameter([1.0, 2.0], unit="kg", shape=":")
    computed = ac.Parameter(lambda self: self.m + 1, unit="N")
    s_start = ac.Parameter(0.0, unit="m/s")
    s = ac.Variable(unit="m", start="s_start")
    v = ac.Variable(unit="m/s")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.s), self.v)


class Outer(ac.Component):
    k = ac.Parameter(3.0, unit="N/m")
    L = ac.Parameter(2.0, unit="m")
    free = ac.Parameter(2.0)

    def __init__(self, **parts: Callable[[Any], ac.Component]) -> None:
        super().__init__()
        for name, part in parts.items():
            setattr(self, name, part(self))


SOUND: dict[str, Any] = {"computed": 1.0, "s": ac.Start(0.0)}


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (
            {"m": lambda o: o.k},
            "'inner.m = k': 'inner.m' is in kg (mass) but 'k' in N/m (stiffness)",
        ),
        ({"m": lambda o: o.k / o.L + 1}, "'inner.m' is in kg (mass) but 'k/L' in Pa (pressure)"),
        (
            {"masses": lambda o: [1.0, o.L]},
            "'inner.masses[2] = L': 'inner.masses[2]' is in kg (mass)",
        ),
        (
            {"s": lambda o: ac.Start(o.k)},
            "'inner.s = k': 'inner.s' is in m (length) but 'k' in N/m",
        ),
        ({"s": lambda o: ac.Start(o.L + o.k)}, "but 'k' in N/m (stiffness)"),
        ({"computed": lambda o: ac.sin(o.L)}, "the argument of sin, 'L' is in m (length)"),
    ],
)
def test_wrong_values(given: dict[str, Any], sentence: str) -> None:
    def inner(outer: Any) -> Inner:
        return Inner(**SOUND | {name: value(outer) for name, value in given.items()})

    assert sentence in refused(Outer(inner=inner))


def test_right_values() -> None:
    def inner(outer: Any) -> Inner:
        return Inner(
            m=outer.free * outer.k,
            masses=[outer.k * outer.L / 9.81, outer.free],
            **SOUND | {"s": ac.Start(outer.L / 2 + 1)},
        )

    check_dimensions(flatten(Outer(inner=inner)))


def test_defaults_and_starts_that_are_computed() -> None:
    message = refused(model(inner=Inner()))
    assert "'inner.computed = inner.m + 1': 'inner.computed' is in N (force) but" in message
    assert (
        "'inner.s = inner.s_start': 'inner.s' is in m (length) but 'inner.s_start' in m/s"
        in message
    )


class Source(ac.Component):
    def __init__(self, unit: str) -> None:
        super().__init__()
        self.y = ac.Output(unit=unit)

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, 1)


class Sink(ac.Component):
    def __init__(self, unit: str) -> None:
        super().__init__()
        self.u = ac.Input(unit=unit)


def test_signals_of_unlike_units_are_not_joined() -> None:
    message = refused(model("a.y - b.u", a=Source("m"), b=Sink("N")))
    assert message == "'a.y' in m (length) and 'b.u' in N (force) are connected"


def test_all_signals_of_a_node_are_alike() -> None:
    parts = {"a": Source(""), "b": Sink("N"), "c": Sink(""), "d": Sink("m")}
    message = refused(model("a.y - b.u", "a.y - c.u", "d.u - a.y", **parts))
    assert message == "'b.u' in N (force) and 'd.u' in m (length) are connected"


def test_signals_of_like_units_are_joined() -> None:
    parts = {"a": Source("J"), "b": Sink("N.m"), "c": Sink("")}
    check_dimensions(flatten(model("a.y - b.u", "a.y - c.u", **parts)))


def test_the_check_can_be_left_out() -> None:
    class Wrong(ac.Component):
        x = ac.Variable(unit="m")

        def equations(self) -> Iterator[ac.Eq]:
            yield ac.Eq(ac.der(self.x), -self.x)

    with pytest.raises(ac.UnitError, match=r"Wrong: 'der\(x\) = -x': "):
        ac.compile(Wrong())
    assert ac.compile(Wrong(), check_units=False).states == ("x",)


# -- cost ----------------------------------------------------------------------------------------------


def test_a_template_is_looked_at_once() -> None:
    def looked_at(n: int) -> int:
        def inner(outer: Any) -> Inner:
            return Inner(m=outer.free * (n + 0.5), **SOUND)

        examine.cache_clear()
        check_dimensions(flatten(Outer(**{f"part{i}": inner for i in range(n)})))
        return examine.cache_info().misses

    assert looked_at(2) == looked_at(20) == 2


# -- random equations ----------------------------------------------------------------------------------

SIMPLE = st.sampled_from(["1", "m", "s", "kg", "m/s", "N", "N/m", "K", "V", "A"]).map(read)


class Growing:
    """Expressions of a given dimension; every symbol in them is new and stands once."""

    def __init__(self, data: st.DataObject) -> None:
        self.data = data
        self.slots: dict[sp.Symbol, Dimension] = {}

    def symbol(self, wanted: Dimension) -> sp.Symbol:
        made = sp.Symbol(f"x{len(self.slots)}", real=True)
        self.slots[made] = wanted
        return made

    def of(self, wanted: Dimension, depth: int) -> Any:
        """An expression of that dimension."""
        if depth == 0:
            return self.symbol(wanted)
        other = self.data.draw(SIMPLE)
        make = self.data.draw(st.sampled_from(GROWN))
        return make(lambda d: self.of(d, depth - 1), wanted, other)


def condition(of: Any, wanted: Dimension, other: Dimension) -> Any:
    return sp.Or(of(other) > of(other), of(wanted) <= of(wanted))


GROWN: list[Callable[[Any, Dimension, Dimension], Any]] = [
    lambda of, wanted, other: of(wanted) + 2 * of(wanted / other) * of(other),
    lambda of, wanted, other: of(wanted) - of(wanted) - 1,
    lambda of, wanted, other: of(wanted / other) * of(other),
    lambda of, wanted, other: of(wanted * other) / of(other),
    lambda of, wanted, other: ac.sqrt(of(wanted**2)),
    lambda of, wanted, other: of(wanted**-1) ** -1,
    lambda of, wanted, other: ac.maximum(of(wanted), of(wanted)),
    lambda of, wanted, other: ac.Abs(of(wanted)),
    lambda of, wanted, other: of(wanted) * ac.sin(of(NUMBER)),
    lambda of, wanted, other: of(wanted) * ac.exp(of(other) / of(other)),
    lambda of, wanted, other: of(wanted) * ac.atan2(of(other), of(other)),
    lambda of, wanted, other: of(wanted) * of(NUMBER) ** of(NUMBER),
    lambda of, wanted, other: ac.where(condition(of, wanted, other), of(wanted), of(wanted)),
    lambda of, wanted, other: of(wanted) * ac.where(of(other) > of(other), of(NUMBER), 0),
]


@given(st.data())
def test_random_equations(data: st.DataObject) -> None:
    """What is built to fit is accepted; with the unit of any one symbol changed it is not."""
    grown = Growing(data)
    wanted = data.draw(SIMPLE)
    residual = grown.symbol(wanted) - grown.of(wanted, data.draw(st.integers(1, 3)))
    assert examine(residual, tuple(grown.slots.items())) is None
    symbol = data.draw(st.sampled_from(sorted(residual.free_symbols, key=str)))
    factor = data.draw(SIMPLE.filter(lambda d: d != NUMBER))
    changed = grown.slots | {symbol: grown.slots[symbol] * factor}
    assert examine(residual, tuple(changed.items())) is not None
    unknown = {s: d for s, d in changed.items() if s != symbol}
    assert examine(residual, tuple(unknown.items())) is None


# -- the library ---------------------------------------------------------------------------------------


def concrete(package: str) -> Iterator[type[Component]]:
    module = getattr(components, package)
    for name in sorted(vars(module)):
        member = getattr(module, name)
        if inspect.isclass(member) and issubclass(member, Component):
            yield member


def values(cls: type[Component]) -> dict[str, Any]:
    """A value for every parameter of a class that needs one."""
    needed = {
        n: d for n, d in cls._declared.items() if isinstance(d, ac.Parameter) and d.default is None
    }
    shapes = {n: [2 if isinstance(k, str) else k for k in d.shape or ()] for n, d in needed.items()}
    return {n: np.ones(shape) if shape else 1.0 for n, shape in shapes.items()}


def variants(cls: type[Component]) -> Iterator[dict[str, Any]]:
    """Every option of a class at every choice, the others as declared."""
    yield {}
    for name, declared in cls._declared.items():
        if isinstance(declared, ac.Option):
            choices = declared.choices or (True, False) * isinstance(declared.default, bool)
            others = [c for c in choices if c != declared.default]
            yield from ({name: c} for c in others[: 1 if len(others) > FEW else None])


FEW = 7
"""Choices beyond which they are values, such as the nine of a logic signal, and one of them tells as much as all."""


@cache
def instances(package: str) -> tuple[FlatModel, ...]:
    """The classes of a package in all their variants, but those that need discrete states or other values."""
    found: list[FlatModel] = []
    for cls in concrete(package):
        for options in variants(cls):
            with contextlib.suppress(ac.ModelError, TypeError, AttributeError, NotImplementedError):
                found.append(flatten(cls(**values(cls), **options)))
    return tuple(found)


SHARES = {"blocks": (150, 0.4), "digital": (10, 0), "electrical": (150, 0.85), "fluid": (40, 0.9),
          "hydraulic": (11, 0.9), "magnetic": (35, 0.8),
          "neural": (2, 0.8), "planar": (100, 0.85), "rotational": (60, 0.9),
          "thermal": (25, 1), "translational": (60, 0.9)}  # fmt: skip
"""By package, how many variants there are and which share of wrong units is found, at least.

What a network gives has any unit: an energy that is computed from it tells nothing.
"""


@pytest.mark.cases(fast=0, slow=99)
@pytest.mark.parametrize("package", components.PACKAGES)
def test_the_library_has_right_units(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """And none that pint must be asked for, as its import takes longer than the check."""
    dimensions.dimension.cache_clear()
    dimensions._read.cache_clear()
    monkeypatch.setattr(dimensions, "_of_pint", lambda symbol: pytest.fail(f"{symbol} is unknown"))
    assert len(instances(package)) >= SHARES[package][0]
    for flat in instances(package):
        check_dimensions(flat)


@pytest.mark.cases(fast=2)
@pytest.mark.parametrize("package", components.PACKAGES)
def test_wrong_units_in_the_library_would_be_found(package: str) -> None:
    """Each unit in turn is multiplied by a unit that is not found elsewhere."""
    found: dict[tuple[str, str], bool] = {}
    for flat in instances(package):
        for form in flat.layout.forms:
            for name, declared in (*form.parameters, *form.variables):
                place = type(form.prototype).__name__, name.partition("[")[0]
                if declared.unit and "." not in name and not found.get(place):
                    found[place] = is_refused(flat, declared)
    missed = [place for place, refused in found.items() if not refused]
    assert len(missed) <= (1 - SHARES[package][1]) * len(found), missed


def is_refused(flat: FlatModel, declared: Any) -> bool:
    right = declared.unit
    declared.unit = f"{right}.mol"
    try:
        check_dimensions(flat)
    except ac.UnitError:
        return True
    finally:
        declared.unit = right
    return False
