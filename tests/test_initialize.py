"""Consistent initial values: fixed starts, initial equations, conflicts and gradients."""

import re

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from tests.parts import Equations, Fixed, Force, Mass, Pendulum, SpringDamper, model

Eq, der = ac.Eq, ac.der
Start = ac.Start


def hanging(mass=None, spring=None, **more):
    """A mass on a spring from the ceiling."""
    return model(
        "c.flange - s.flange_a",
        "s.flange_b - m.flange_a",
        c=Fixed(s0=1.0),
        s=SpringDamper(c=4.0, d=0.5, **(spring or {})),
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
            self.s = Start(2 * self.m + self.factor)

    system = ac.compile(model(m=Stretched(m=1.0)))
    assert system.initial_state().tolist() == [5.0, 0.0]
    assert system.initial_state({"m.m": 4.0}).tolist() == [11.0, 0.0]


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
    np.testing.assert_allclose(system.initial_state(u0=[8.0]), [2.0, 0.0], atol=1e-9)


def test_a_dummy_states_fixed_start_sets_the_state():
    pendulum = Pendulum(x=Start(0.5), y=Start(-0.8, fixed=True))
    system = ac.compile(pendulum)
    assert system.states[0] == "x"
    np.testing.assert_allclose(system.initial_state()[0], 0.6, atol=1e-6)


# -- initial equations --------------------------------------------------------------------------------------------


def test_initial_equations_with_derivatives():
    component = Initial(
        "x v", lambda s: [Eq(der(s.x), s.v), Eq(der(s.v), 3 - s.k * s.x - s.v)],
        lambda s: [Eq(der(s.x), 0), Eq(der(der(s.x)), 0)],
        k=2.0,
    )  # fmt: skip
    np.testing.assert_allclose(start(component), [1.5, 0.0], atol=1e-9)


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
    slope = jax.jacobian(lambda s: system.initial_state({"m.s_start": s}))(jnp.array(3.0))
    assert slope.tolist() == [6.0, 0.0]


def test_under_jit_nothing_is_raised():
    component = Initial(
        "x", lambda s: [Eq(der(s.x), s.k)], lambda s: [Eq(s.x, 1), Eq(s.x, 2)], k=1.0
    )
    system = ac.compile(component)
    assert jax.jit(lambda k: system.initial_state({"k": k}))(1.0).shape == (1,)
