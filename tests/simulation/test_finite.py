"""Values that are not finite, and states that run away: nothing is silent."""

import functools
import warnings

import jax
import pytest

import acausal as ac
from tests.support.parts import Equations

Eq, der = ac.Eq, ac.der


@functools.cache
def falling() -> ac.System:
    """x falls from 1 to -4; nothing but y and z depends on its root."""
    component = Equations(
        "x y z", lambda s: [Eq(der(s.x), -5.0), Eq(s.y, ac.sqrt(s.x)), Eq(s.z, 1 + s.y)]
    )
    component.modify(x=ac.Start(1.0, fixed=True))
    return ac.compile(component)


@functools.cache
def stiff() -> ac.System:
    component = Equations("T", lambda s: [Eq(der(s.T), s.k * s.T)], k=-1e5)
    component.modify(T=ac.Start(300.0, fixed=True))
    return ac.compile(component)


SENTENCE = (
    r"is nan first at t = 0\.25 s, and at 16 of 21 times\. "
    r"There 'y' = sqrt\(x\) is nan: a division by zero, or a function outside its domain"
)


@pytest.mark.parametrize(
    "read",
    [lambda sol: sol["y"], lambda sol: sol["z"], lambda sol: sol.to_dict(), lambda sol: sol.plot("z")],
    ids=["y", "z", "all", "plot"],
)  # fmt: skip
def test_a_variable_that_is_not_finite_is_said_when_it_is_read(read):
    solution = ac.simulate(falling(), (0, 1), dt=0.05)
    with pytest.warns(UserWarning, match=SENTENCE) as said:
        read(solution)
    assert len(said) == 1
    assert said[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read(solution)  # once for every variable


def test_what_is_finite_is_read_without_a_word():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ac.simulate(falling(), (0, 0.1), dt=0.05)["y"].shape == (3,)
        assert ac.simulate(falling(), (0, 1), dt=0.05)["x"].shape == (21,)


def test_a_loop_that_breaks_no_state():
    component = Equations("x y", lambda s: [Eq(der(s.x), 1.0), Eq(ac.exp(s.y) + s.y**2, 2 - s.x)])
    component.modify(x=ac.Start(0.0, fixed=True))
    solution = ac.simulate(ac.compile(component), (0, 2), dt=0.25)
    with pytest.warns(
        UserWarning, match="Newton's method finds no solution of the equations for 'y';"
    ):
        solution["y"]


def test_a_result_of_jit_is_read_outside():
    component = Equations("x y", lambda s: [Eq(der(s.x), -s.y), Eq(s.y, ac.sqrt(s.x))])
    component.modify(x=ac.Start(0.05, fixed=True))
    system = ac.compile(component)
    solution = jax.jit(lambda x: ac.simulate(system, (0, 2), dt=0.05, x0={"x": x}))(0.05)
    with pytest.warns(
        UserWarning, match=r"'x' is nan first at t = 0\.45 s.*On the way there 'y' = sqrt"
    ):
        solution["x"]


def test_only_the_equations_behind_a_name_are_looked_at():
    point = falling().values(0.0, [-1.0], None, falling().parameters())
    assert falling().explain_nonfinite(point) is None  # the rate is finite
    assert falling().explain_nonfinite(point, "x") is None
    told = falling().explain_nonfinite(point, ("x", "z"))
    assert told is not None
    assert told.startswith("'y' = sqrt(x) is nan")


@pytest.mark.parametrize("steps", [20, 200])
def test_a_finite_run_away_is_refused(steps):
    sentence = (
        r"^The simulation broke down after t = 0\.008 s: 'T' has run away to 4\.89e\+35 .*"
        r"dt=0\.001 s is too long for the model's fastest mode, 1e\+05 1/s at the start"
    )
    with pytest.raises(ac.SimulationError, match=sentence):
        ac.simulate(stiff(), (0, steps * 1e-3), dt=1e-3, solver="heun")


def test_an_adaptive_run_away_is_refused():
    params = {"k": 100.0}
    with pytest.raises(ac.SimulationError, match=r"^The simulation with .* 'T' has run away to"):
        ac.simulate(stiff(), (0, 1), params=params)


@pytest.mark.parametrize(
    "start", [ac.Start(1e32, fixed=True), ac.Start(0.0, fixed=True, nominal=1e31)]
)
def test_states_that_are_large_by_nature(start):
    component = Equations("n", lambda s: [Eq(der(s.n), 1e31)])
    component.modify(n=start)
    assert float(ac.simulate(ac.compile(component), (0, 1), dt=0.25).x[-1, 0]) >= 0.9e31


class Thresholds(ac.Component):
    """A threshold behind a square root of what becomes negative."""

    x, y = ac.Variable(start=0.5, fixed=True), ac.Variable(start=0.0, fixed=True)
    on = ac.Discrete(kind="bool")

    def equations(self):
        yield Eq(der(self.x), -1)
        yield Eq(self.on, ac.sqrt(self.x) > 0.5)
        yield Eq(der(self.y), self.on)


@pytest.mark.slow
def test_conditions_without_a_value_are_no_silent_result() -> None:
    with pytest.warns(UserWarning, match=r"undefined \(nan\) at the end of \d+ steps"):
        ac.simulate(ac.compile(Thresholds()), 1.0)


class Repeated(ac.Component):
    """Two linear equations for ``y`` and ``z``, which a parameter makes the same; ``y`` decides alone."""

    p = ac.Parameter(2.0)
    x = ac.Variable(start=1.0, fixed=True)
    y, z = ac.Variable(), ac.Variable()
    on = ac.Discrete(kind="bool")

    def equations(self):
        yield Eq(der(self.x), self.on)
        yield Eq(self.y + self.z, self.x)
        yield Eq(self.y + self.p * self.z, self.x)
        yield Eq(self.on, self.y > 0.5)


@pytest.mark.slow
def test_undefined_conditions_name_the_singular_equations_behind_them() -> None:
    expected = (
        r"undefined \(nan\) at the end of \d+ steps.* At t = 0 s, .*singular.* lock the same motion"
    )
    with pytest.warns(UserWarning, match=expected):
        ac.simulate(ac.compile(Repeated()), 1.0, params={"p": 1.0})
