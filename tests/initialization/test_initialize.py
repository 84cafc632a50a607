"""Consistent initial values: fixed starts, initial equations, conflicts and gradients."""

import re

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from tests.support.parts import Equations, Fixed, Force, Mass, Pendulum, SpringDamper, model

Eq, der = ac.Eq, ac.der
Start = ac.Start


def hanging(mass=None, spring=None, **more):
    """A mass on a spring from the ceiling."""
    return model(
        "c.flange - s.flange_a",
        "s.flange_b - m.flange_a",
        c=Fixed(s0=1.0),
        s=SpringDamper(**{"c": 4.0, "d": 0.5, **(spring or {})}),
        m=Mass(m=2.0, **(mass or {})),
        **more,
    )


class Initial(Equations):
    """Equations with initial equations."""

    def __init__(self, variables, stated, initial, **parameters):
        super().__init__(variables, stated, **parameters)
        self._initial = initial

    def initial_equations(self):
        yield from self._initial(self)


def start(component, **given):
    return ac.compile(component).initial_state(**given)


# -- starts ---------------------------------------------------------------------------------------------------


def test_states_start_where_they_are_told_to_and_else_at_zero():
    assert start(hanging()).tolist() == [0.0, 0.0]
    assert start(hanging({"s": Start(0.5), "v": Start(-1.0)})).tolist() == [0.5, -1.0]


def test_a_start_may_be_given_to_any_name_of_a_state():
    class Named(Mass):
        position = ac.Variable()

        def equations(self):
            yield from super().equations()
            yield Eq(self.position, -self.s)

    system = ac.compile(model(m=Named(m=1.0, position=Start(0.5))))
    assert system.states == ("m.s", "m.v")
    assert system.initial_state().tolist() == [-0.5, 0.0]


def test_starts_are_expressions_of_parameters():
    class Stretched(Mass):
        factor = ac.Parameter(3.0)

        def __init__(self, **modifiers):
            super().__init__(**modifiers)
            self.s = Start(self.factor * self.m + 2)

    system = ac.compile(model(m=Stretched(m=1.0)))
    assert system.initial_state().tolist() == [5.0, 0.0]
    assert system.initial_state({"m.m": 4.0}).tolist() == [14.0, 0.0]


def test_x0_by_name_or_as_a_whole():
    system = ac.compile(hanging({"s": Start(0.5)}))
    assert system.initial_state(x0={"m.v": 2.0}).tolist() == [0.5, 2.0]
    assert system.initial_state(x0=[7.0, 8.0]).tolist() == [7.0, 8.0]
    with pytest.raises(ac.DataError, match=r"'m\.w' is not a state; did you mean 'm\.[sv]'"):
        system.initial_state(x0={"m.w": 1.0})
    with pytest.raises(ac.DataError, match=r"x0 has shape \(3,\); the model has 2 states: 'm.s'"):
        system.initial_state(x0=[1.0, 2.0, 3.0])


# -- conditions on other variables --------------------------------------------------------------------------------


def test_a_fixed_start_of_a_distance():
    # s_rel = m.s - 1
    x = start(hanging(spring={"s_rel": Start(0.25, fixed=True)}))
    np.testing.assert_allclose(x, [1.25, 0.0], atol=1e-9)


def test_a_fixed_start_of_an_acceleration_moves_what_is_free():
    # 2 a = -4 (s - 1) - 0.5 v
    fixed = {"a": Start(3.0, fixed=True), "v": Start(1.0, fixed=True)}
    np.testing.assert_allclose(start(hanging(fixed)), [1 - 6.5 / 4, 1.0], atol=1e-9)


def test_what_is_not_determined_moves_as_little_as_possible():
    component = Equations(
        "x y z", lambda s: [Eq(der(s.x), 1), Eq(der(s.y), 1), Eq(s.z, s.x + 2 * s.y)]
    )
    component.modify(z=Start(5.0, fixed=True))
    np.testing.assert_allclose(start(component), [1.0, 2.0], atol=1e-9)


def test_nonlinear_conditions():
    component = Equations(
        "x y r", lambda s: [Eq(der(s.x), 1), Eq(der(s.y), 1), Eq(s.r, s.x**2 + s.y**2)]
    )
    component.modify(x=Start(0.6, fixed=True), y=Start(1.0), r=Start(1.0, fixed=True))
    np.testing.assert_allclose(start(component), [0.6, 0.8], atol=1e-9)


def test_conditions_use_the_inputs():
    system = ac.compile(
        model(
            "f.flange - m.flange_a",
            "m.flange_b - s.flange_a",
            "s.flange_b - c.flange",
            f=Force(),
            m=Mass(m=2.0, a=Start(0.0, fixed=True), v=Start(0.0, fixed=True)),
            s=SpringDamper(c=4.0, d=1.0),
            c=Fixed(),
        )
    )
    np.testing.assert_allclose(system.initial_state(inputs=[8.0]), [2.0, 0.0], atol=1e-9)


@pytest.mark.slow
def test_a_dummy_states_fixed_start_sets_the_state():
    pendulum = Pendulum(x=Start(0.5, state="prefer"), y=Start(-0.8, fixed=True))
    system = ac.compile(pendulum)
    assert system.states[0] == "x"
    np.testing.assert_allclose(system.initial_state()[0], 0.6, atol=1e-6)


# -- initial equations --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_initial_equations_with_derivatives():
    component = Initial(
        "x v", lambda s: [Eq(der(s.x), s.v), Eq(der(s.v), 3 - s.k * s.x - s.v)],
        lambda s: [Eq(der(s.x), 0), Eq(der(der(s.x)), 0)],
        k=2.0,
    )  # fmt: skip
    np.testing.assert_allclose(start(component), [1.5, 0.0], atol=1e-9)


@pytest.mark.slow
def test_initial_equations_of_many_alike_components():
    def make(k):
        return Initial(
            "x", lambda s: [Eq(der(s.x), 6 - s.k * s.x)], lambda s: [Eq(der(s.x), 0)], k=k
        )

    np.testing.assert_allclose(start(model(a=make(1.0), b=make(2.0), c=make(3.0))), [6, 3, 2])


def test_initial_equations_depend_on_time_and_zero_parameters():
    component = Initial(
        "x", lambda s: [Eq(der(s.x), 1)], lambda s: [Eq(s.x + s.k, ac.time**2)], k=0.0
    )
    np.testing.assert_allclose(start(component, t0=3.0), [9.0])


@pytest.mark.slow
def test_initial_equations_with_modules():
    class Learned(Initial):
        net = ac.Module(lambda key: lambda x: 3.0 * x)

    def make(**modifiers):
        made = Learned("x", lambda s: [Eq(der(s.x), s.net(s.x))], lambda s: [Eq(der(s.x), 6)])
        made.modify(**modifiers)
        return made

    assert start(make()) == pytest.approx(2.0)
    both = model(a=make(), b=make(net=lambda key: lambda x: 2.0 * x))
    np.testing.assert_allclose(start(both), [2.0, 3.0])


# -- conflicts ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("component", "told"),
    [
        (
            lambda: hanging({"s": Start(0.5, fixed=True)}, {"s_rel": Start(0.0, fixed=True)}),
            "'s.s_rel (fixed start) by 0.5'",
        ),
        (
            lambda: model(
                "a.flange_b - b.flange_a",
                a=Mass(m=1.0, s=Start(0.0, fixed=True)),
                b=Mass(m=1.0, s=Start(1.0, fixed=True)),
            ),
            "'b.s (fixed start) by 1'",
        ),
        (
            lambda: Initial(
                "x", lambda s: [Eq(der(s.x), -s.x)], lambda s: [Eq(s.x, 1), Eq(der(s.x), 1)]
            ),
            "Initial: x = 1 by 1",
        ),
        (
            lambda: Initial("x", lambda s: [Eq(der(s.x), 1)], lambda s: [Eq(s.x**2, -1)]),
            "Initial: x**2 = -1 by 1",
        ),
    ],
)
def test_conflicts_are_told(component, told):
    with pytest.raises(ac.InitializationError, match=re.escape(told)) as error:
        start(component())
    assert "Is a start fixed twice" in str(error.value)


def test_the_same_start_fixed_twice_is_no_conflict():
    system = ac.compile(
        model(
            "a.flange_b - b.flange_a",
            a=Mass(m=1.0, s=Start(2.0, fixed=True)),
            b=Mass(m=1.0, s=Start(2.0, fixed=True)),
        )
    )
    assert system.initializer.conditions.further == ()
    assert system.initial_state().tolist() == [2.0, 0.0]


def test_what_x0_gives_overrides_fixed_starts():
    system = ac.compile(
        model(
            "a.flange_b - b.flange_a",
            a=Mass(m=1.0, s=Start(0.0, fixed=True)),
            b=Mass(m=1.0, s=Start(1.0, fixed=True)),
        )
    )
    assert system.initial_state(x0={"a.s": 3.0}).tolist() == [3.0, 0.0]


# -- gradients ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_gradients_go_through_the_initialization():
    component = Initial(
        "x y", lambda s: [Eq(der(s.x), s.y - s.p * s.x**3), Eq(der(s.y), -s.x - s.q * s.y)],
        lambda s: [Eq(der(s.x), 0.5), Eq(der(s.y), -0.25)],
        p=2.0, q=1.5,
    )  # fmt: skip
    component.modify(x=Start(1.0), y=Start(1.0))
    system = ac.compile(component)

    @jax.jit
    def solve(p, q):
        return system.initial_state({"p": p, "q": q})

    x, y = solve(2.0, 1.5)
    assert y - 2 * x**3 == pytest.approx(0.5, abs=1e-8)
    ours = jax.jit(jax.jacfwd(solve, argnums=(0, 1)))(2.0, 1.5)
    backward = jax.jit(jax.jacrev(solve, argnums=(0, 1)))(2.0, 1.5)
    h = 1e-5
    for i, (dp, dq) in enumerate([(h, 0), (0, h)]):
        differences = (solve(2.0 + dp, 1.5 + dq) - solve(2.0 - dp, 1.5 - dq)) / (2 * h)
        np.testing.assert_allclose(ours[i], differences, rtol=1e-6)
        np.testing.assert_allclose(backward[i], differences, rtol=1e-6)


def test_gradients_with_respect_to_starts_that_are_parameters():
    class Free(Mass):
        s_start = ac.Parameter(0.5)

        def __init__(self, **modifiers):
            super().__init__(**modifiers)
            self.s = Start(self.s_start**2, fixed=True)

    system = ac.compile(model(m=Free(m=1.0)))
    derivative = jax.jacobian(lambda s: system.initial_state({"m.s_start": s}))(jnp.array(3.0))
    assert derivative.tolist() == [6.0, 0.0]


@pytest.mark.slow
def test_under_jit_nothing_is_raised():
    component = Initial(
        "x", lambda s: [Eq(der(s.x), s.k)], lambda s: [Eq(s.x, 1), Eq(s.x, 2)], k=1.0
    )
    system = ac.compile(component)
    assert jax.jit(lambda k: system.initial_state({"k": k}))(1.0).shape == (1,)


# -- rest, least squares, and what was decided --------------------------------------------------------------------


@pytest.fixture(scope="module")
def hanging_system():
    """A mass on a spring below s = 1, pulled by an input."""
    return ac.compile(
        model(
            "c.flange - s.flange_a", "s.flange_b - m.flange_a", "m.flange_b - f.flange",
            c=Fixed(s0=1.0), s=SpringDamper(c=4.0, d=0.5), m=Mass(m=2.0), f=Force(),
        )
    )  # fmt: skip


@pytest.mark.slow
def test_at_rest(hanging_system):
    at_rest = hanging_system.initial_state(inputs=[2.0], steady=True)
    np.testing.assert_allclose(at_rest, [1.5, 0.0], atol=1e-12)
    derivative = jax.jacfwd(
        lambda f: hanging_system.initial_state(inputs=jnp.array([f]), steady=True)
    )(2.0)
    np.testing.assert_allclose(derivative, [0.25, 0.0], atol=1e-12)


@pytest.mark.parametrize("inputs", [{"f.f": 2.0}, {"f.f": jnp.asarray(2.0)}, [2.0], np.array([2])])
def test_inputs_at_the_start_by_name_or_in_order(hanging_system, inputs):
    found = hanging_system.initialize(inputs=inputs, steady=True)
    np.testing.assert_allclose(found.x, [1.5, 0.0], atol=1e-12)


@pytest.mark.parametrize(
    ("inputs", "told"),
    [
        ({"f.F": 1.0}, r"^inputs: 'f\.F' is not an input; did you mean 'f\.f'\?$"),
        ([1.0, 2.0], r"^inputs has shape \(2,\); the model has the inputs \(f\.f\)$"),
        (
            {"f.f": "much"},
            r"^inputs=\{'f.f': 'much'\} are not inputs at one time; give real numbers\.$",
        ),
        ({"f.f": [1.0, 2.0]}, r"^inputs has shape \(1, 2\)"),
    ],
)
def test_inputs_that_do_not_fit_are_told(hanging_system, inputs, told):
    for find in (hanging_system.initialize, hanging_system.initial_state):
        with pytest.raises(ac.DataError, match=told):
            find(inputs=inputs, steady=True)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"t0": "now"}, "^t0='now' is not a time; give seconds"),
        ({"t0": np.nan}, "^t0=nan is not a time"),
        ({"steady": 3}, "^steady: 3 is not a name"),
        ({"x0": 3}, "^x0=3 has no names|^x0 has shape"),
        ({"x0": {3: 1.0}}, "^x0: 3 is not a name"),
        ({"x0": {"m.v": "fast"}}, "^x0: 'm.v' is 'fast'; give a real number that is finite"),
        ({"x0": {"m.v": np.ones(3)}}, "^x0: 'm.v' is array"),
        ({"x0": {"m.v": np.nan}}, "^x0: 'm.v' is nan"),
        ({"x0": {"m.v": 1j}}, "^x0: 'm.v' is 1j"),
        ({"params": {"m.m": "heavy"}}, "^params: 'm.m' must be numbers, got 'heavy'"),
    ],
)
def test_what_is_no_start_is_told(hanging_system, given, told):
    for find in (hanging_system.initialize, hanging_system.initial_state):
        with pytest.raises(ac.DataError, match=told):
            find(**given)


def test_a_whole_state_that_is_not_finite_is_told(hanging_system):
    with pytest.raises(ac.DataError, match=r"^x0: 'm.v' is nan; give finite numbers"):
        hanging_system.initial_state(x0=[0.0, np.nan])


@pytest.mark.slow
def test_some_states_at_rest(hanging_system):
    found = hanging_system.initialize(x0={"m.v": 2.0}, inputs=[0.0], steady=["m.v"])
    np.testing.assert_allclose(found.x, [0.75, 2.0])
    assert found.roles == ("computed", "given")
    assert found.conditions == ("der(m.v) = 0",)
    with pytest.raises(ac.DataError, match=r"steady: 'm\.w' is not a state; did you mean"):
        hanging_system.initial_state(steady=["m.w"])


@pytest.mark.slow
def test_a_free_mass_at_rest_stays_where_it_starts():
    found = ac.compile(model(m=Mass(m=1.0, s=Start(3.0), v=Start(1.0)))).initialize(steady=True)
    np.testing.assert_allclose(found.x, [3.0, 0.0], atol=1e-12)
    assert found.roles == ("start", "computed")


@pytest.mark.slow
def test_what_the_conditions_leave_open_is_told():
    component = Equations(
        "x y z w", lambda s: [Eq(der(s.x), 1), Eq(der(s.y), 1), Eq(der(s.w), 1), Eq(s.z, s.x + s.y)]
    )
    component.modify(z=Start(5.0, fixed=True), x=Start(1.0))
    found = ac.compile(component).initialize()
    assert found.roles == ("chosen", "chosen", "start")
    np.testing.assert_allclose(found.x, [3.0, 2.0, 0.0])
    told = repr(found)
    assert "3 states, 1 conditions, 3 left open" in told
    assert "z (fixed start): off by" in told


@pytest.mark.slow
def test_the_smallest_change_is_measured_in_nominal_values():
    component = Equations("x y z", lambda s: [Eq(der(s.x), 1), Eq(der(s.y), 1), Eq(s.z, s.x + s.y)])
    component.modify(z=Start(10.0, fixed=True), x=Start(nominal=3.0))
    np.testing.assert_allclose(start(component), [9.0, 1.0])


def conflicting():
    """x is fixed, and its double too, to values of a parameter that do not fit."""
    component = Initial(
        "x z", lambda s: [Eq(der(s.x), -s.x), Eq(s.z, 2 * s.x)], lambda s: [Eq(s.x**2, s.p)], p=4.0
    )
    component.modify(x=Start(1.0, fixed=True), z=Start(4.0, fixed=True))
    return component


@pytest.mark.slow
def test_least_squares_meets_conditions_as_well_as_can_be():
    system = ac.compile(conflicting())
    with pytest.raises(ac.InitializationError, match=r"least_squares=True"):
        system.initial_state()

    @jax.jit
    def fitted(p):
        return system.initial_state({"p": p}, least_squares=True)[0]

    x, h = float(fitted(4.0)), 1e-4
    # minimum of (x - 1)² + (2 x - 4)² + (x² - p)²
    assert (x - 1) + 2 * (2 * x - 4) + 2 * x * (x**2 - 4) == pytest.approx(0, abs=1e-7)
    differences = (float(fitted(4.0 + h)) - float(fitted(4.0 - h))) / (2 * h)
    assert float(jax.grad(fitted)(4.0)) == pytest.approx(differences, rel=1e-6)
    found = system.initialize(least_squares=True)
    assert found.roles == ("fitted",)
    np.testing.assert_allclose(found.residuals, [x - 1, 2 * x - 4, x**2 - 4], atol=1e-6)


def test_a_conflict_names_what_cannot_move():
    with pytest.raises(ac.InitializationError) as error:
        start(hanging({"s": Start(0.5, fixed=True)}, {"s_rel": Start(0.0, fixed=True)}))
    assert "1 condition, but only 1 free state ('m.v'); 'm.s' cannot move" in str(error.value)


# -- parameters found at the initial time ---------------------------------------------------------------------------


@pytest.mark.slow
def test_a_parameter_that_makes_a_start_fit():
    system = ac.compile(
        hanging(
            {"s": Start(0.5, fixed=True), "a": Start(3.0, fixed=True), "v": Start(0.0, fixed=True)},
            {"c": Start(1.0, fixed=False)},
        )
    )
    assert system.states == ("s.c", "m.s", "m.v")
    assert "s.c" not in system.parameters()

    def stiffness(m):
        return system.initial_state({**system.parameters(), "m.m": m})[0]

    assert float(stiffness(2.0)) == pytest.approx(12.0)  # 2 · 3 = c · 0.5
    assert float(jax.grad(stiffness)(2.0)) == pytest.approx(6.0)
    rates = system.vector_field(0.0, system.initial_state(), None, system.parameters())
    assert float(rates[0]) == 0.0


class Tuned(ac.Component):
    """The stiffness of one spring determines that of another."""

    c = ac.InitialParameter(1.0, unit="N/m")

    def __init__(self):
        super().__init__()
        self.wall, self.soft = Fixed(), SpringDamper(c=self.c, d=0.5)
        self.mass = Mass(m=1.0, s=Start(1.0, fixed=True), a=Start(-6.0, fixed=True))
        self.hard = SpringDamper(c=2 * self.c, d=0.5)
        self.connect(self.wall.flange, self.soft.flange_a, self.hard.flange_a)
        self.connect(self.soft.flange_b, self.hard.flange_b, self.mass.flange_a)


@pytest.mark.slow
def test_parameters_that_follow_from_found_ones():
    system = ac.compile(Tuned())
    found = system.initialize(x0={"mass.v": 0.0})
    np.testing.assert_allclose(found.x, [2.0, 1.0, 0.0], atol=1e-9)
    u = jnp.zeros(0)
    assert float(system.observe("hard.c", 0.0, found.x, u, system.parameters())) == pytest.approx(4)
    pair = ac.compile(model(a=Tuned(), b=Tuned()))
    assert pair.states[0] == "a.c"
    assert pair.initial_state(x0={"a.mass.v": 0.0, "b.mass.v": 0.0})[3] == pytest.approx(2.0)


@pytest.mark.slow
def test_initial_values_by_name():
    found = ac.compile(hanging()).initialize(x0={np.str_("m.s"): 0.5}, steady=np.array(["m.v"]))
    assert float(found["m.s"]) == 0.5
    assert "der(m.v) = 0" in ac.compile(hanging()).initialize(steady="m.v").conditions
    np.testing.assert_array_equal(found[["m.v", "m.s"]], [found["m.v"], 0.5])
    assert list(found) == list(found.states)
    assert "m.s" in found
    with pytest.raises(ac.DataError, match=r"'m\.a' is not a state"):
        found["m.a"]


def test_a_state_can_be_given_by_another_name():
    class Twins(ac.Component):
        x = ac.Variable()
        other = ac.Variable()

        def equations(self):
            yield ac.Eq(ac.der(self.x), -self.x)
            yield ac.Eq(self.other, -self.x)

    system = ac.compile(Twins())
    (state,) = system.states
    alias = "other" if state == "x" else "x"
    assert float(system.initial_state(x0={alias: 2.0})[0]) == -2.0
    assert system.initialize(x0={alias: 2.0}).roles == ("given",)
    with pytest.raises(ac.DataError, match="are the same; give one of them"):
        system.initial_state(x0={"x": 2.0, "other": -2.0})


class Determined(ac.Component):
    """A parameter that follows from two conditions, which contradict each other where both begin at zero."""

    p = ac.Parameter(1.0)
    x, y = ac.Variable(), ac.Variable()

    def equations(self):
        yield Eq(der(self.x), self.y**2 - self.x)
        yield Eq(der(self.y), -0.1 * self.p * self.y)

    def initial_equations(self):
        yield Eq(der(self.x), 0)
        yield Eq(self.y, 2)
        yield Eq(self.p * self.y, 6)


@pytest.mark.parametrize("guess", [0.0, 1.0, 10.0])
def test_conditions_that_contradict_each_other_at_the_starts_alone_are_met(guess: float) -> None:
    found = ac.compile(Determined(p=Start(guess, fixed=False))).initialize()
    assert {n: float(found[n]) for n in ("x", "y", "p")} == pytest.approx({"x": 4, "y": 2, "p": 3})
