"""Index reduction, choice of states, loops and diagnosis, judged by the flat equations themselves."""

import cProfile
import inspect
import itertools
import pstats
import re
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.flattening.flat_model import flatten
from acausal.structure import Assignment, TornLoop, reduce
from tests.structure.test_sparse_loops import Train
from tests.support.oracle import worst
from tests.support.parts import (
    Capacitor,
    ConstantVoltage,
    Diode,
    Equations,
    Fixed,
    Force,
    Ground,
    Inductor,
    Lever,
    Mass,
    Model,
    NonlinearResistor,
    Pendulum,
    Position,
    Resistor,
    SignalVoltage,
    Sine,
    SpringDamper,
    model,
)
from tests.support.slow import some_slow

Eq, der = ac.Eq, ac.der


def loops(system):
    return [s for s in system.reduced.steps if isinstance(s, TornLoop)]


def sizes(system):
    """Numbers of unknowns and of tearing variables of every loop, and how many are alike."""
    return [(s.shape.n_unknowns, len(s.shape.torn.tears), len(s.unknowns)) for s in loops(system)]


def rates(system, x, u=None, t=0.0, **params):
    return system.vector_field(t, jnp.asarray(x), u, {**system.parameters(), **params})


# -- rigid joints -------------------------------------------------------------------------------------------


def test_masses_joined_rigidly_behave_as_their_sum():
    system = ac.compile(
        model(
            "f.flange - a.flange_a",
            "a.flange_b - b.flange_a",
            "b.flange_b - c.flange_a",
            f=Force(),
            a=Mass(m=1.0, L=0.5),
            b=Mass(m=2.0),
            c=Mass(m=5.0, L=0.1),
        )
    )
    assert system.states == ("a.s", "a.v")
    np.testing.assert_allclose(rates(system, [0.3, 2.0], [16.0]), [2.0, 2.0])
    assert worst(system) < 1e-12


def test_a_lever_couples_masses():
    system = ac.compile(
        model(
            "a.flange_b - l.flange_a",
            "l.flange_b - b.flange_a",
            "f.flange - a.flange_a",
            a=Mass(m=2.0),
            l=Lever(ratio=4.0),
            b=Mass(m=16.0),
            f=Force(),
        )
    )
    # s_a = 4 s_b: the second mass counts 1/16
    np.testing.assert_allclose(rates(system, [0.0, 1.0], [3.0]), [1.0, 1.0])
    assert worst(system) < 1e-12


def test_a_lever_of_ratio_zero_holds_one_side():
    system = ac.compile(
        model(
            "a.flange_b - l.flange_a",
            "l.flange_b - b.flange_a",
            a=Mass(m=2.0),
            l=Lever(ratio=0.0),
            b=Mass(m=3.0),
        )
    )
    assert system.states == ("b.s", "b.v")
    assert worst(system) < 1e-12


def test_prescribed_motion_by_a_source():
    system = ac.compile(
        model(
            "s.y - p.s_ref", "p.flange - m.flange_a", s=Sine(omega=2.0), p=Position(), m=Mass(m=3.0)
        )
    )
    assert system.states == ()
    assert system.inputs == ()
    force = system.observe("p.flange.f", 0.7, jnp.zeros(0), None, system.parameters())
    assert float(force) == pytest.approx(3 * 4 * np.sin(1.4))
    assert worst(system) < 1e-12


def test_prescribed_motion_by_an_open_input_asks_for_its_derivatives():
    system = ac.compile(model("p.flange - m.flange_a", p=Position(), m=Mass(m=3.0)))
    assert system.inputs == ("p.s_ref", "der(p.s_ref)", "der(der(p.s_ref))")
    assert system.reduced.input_orders == ((0, 0), (0, 1), (0, 2))
    force = system.observe("p.flange.f", 0.0, jnp.zeros(0), [1.0, 2.0, 5.0], system.parameters())
    assert float(force) == -15.0
    assert worst(system) < 1e-12


@pytest.mark.slow
def test_signs_survive_differentiation():
    # x' = -v: in the twice differentiated constraint der(x) stands with both signs
    def stated(s):
        yield Eq(der(s.x), -s.v)
        yield Eq(der(s.y), s.w)
        yield Eq(der(s.v), s.f * s.x)
        yield Eq(der(s.w), -s.f * s.y - 9.81)
        yield Eq(s.x**2 + s.x * s.y + s.y**2, 1)
        yield Eq(s.z, s.x * der(s.x))

    system = ac.compile(Equations("x y v w f z", stated))
    assert len(system.states) == 4
    assert worst(system) < 1e-10


# -- electrical ----------------------------------------------------------------------------------------------


def test_capacitors_in_a_loop_share_a_state():
    system = ac.compile(
        model(
            "r.n - a.p - b.p",
            "a.n - b.n - g.p - v.n",
            "v.p - r.p",
            v=ConstantVoltage(V=5.0),
            r=Resistor(R=2.0),
            a=Capacitor(C=1.0),
            b=Capacitor(C=4.0),
            g=Ground(),
        )
    )
    assert system.states == ("a.v",)
    np.testing.assert_allclose(rates(system, [1.0]), [(5 - 1) / 2 / 5])
    assert worst(system) < 1e-12


def test_a_capacitor_loop_without_a_common_node_name():
    system = ac.compile(
        model(
            "a.n - g.p - r.n - q.n",
            "a.p - b.p - r.p",
            "b.n - c.p - q.p",
            "c.n - g.p",
            a=Capacitor(C=1.0),
            b=Capacitor(C=2.0),
            c=Capacitor(C=3.0),
            r=Resistor(R=2.0),
            q=Resistor(R=3.0),
            g=Ground(),
        )
    )
    assert len(system.states) == 2
    assert worst(system) < 1e-12


def test_inductors_that_meet_share_states():
    parts = {f"l{i}": Inductor(L=float(i)) for i in (1, 2, 3)}
    parts |= {f"r{i}": Resistor(R=float(i)) for i in (1, 2, 3)}
    lines = [f"l{i}.n - r{i}.p" for i in (1, 2, 3)]
    system = ac.compile(
        model("l1.p - l2.p - l3.p", *lines, "r1.n - r2.n - r3.n - g.p", **parts, g=Ground())
    )
    assert len(system.states) == 2
    assert worst(system) < 1e-12


def test_a_voltage_on_a_capacitor_is_differentiated():
    system = ac.compile(
        model("v.p - c.p", "v.n - c.n - g.p", v=SignalVoltage(), c=Capacitor(C=2.0), g=Ground())
    )
    assert system.inputs == ("v.v", "der(v.v)")
    assert float(system.observe("c.i", 0.0, jnp.zeros(0), [1.0, 3.0], system.parameters())) == 6.0


# -- higher index -----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_pendulum_in_cartesian_coordinates():
    system = ac.compile(Pendulum(x=ac.Start(0.6, state="prefer"), y=ac.Start(-0.8)))
    assert system.states == ("x", "v")
    params = system.parameters()
    x = jnp.array([0.6, 0.0])
    values = system.observe(["y", "w", "f"], 0.0, x, None, params)
    np.testing.assert_allclose(values, [-0.8, 0.0, 0.8 * 9.81], atol=1e-12)
    # tangential acceleration: g sin(angle)
    np.testing.assert_allclose(rates(system, x)[1], -0.8 * 9.81 * 0.6)
    assert worst(system) < 1e-9


def independent(model):
    """The states from which the others follow at the start."""
    found = reduce(flatten(model))
    dependent = [s for p in found.projections for s in p.dependent]
    return [found.name(int(s)) for s in found.states if s not in dependent]


@pytest.mark.slow
@pytest.mark.parametrize(("start", "state"), [((1.0, 0.0), "y"), ((0.0, -1.0), "x")])
def test_states_are_chosen_that_work_where_the_model_starts(start, state):
    pendulum = Pendulum(x=ac.Start(start[0]), y=ac.Start(start[1]))
    assert independent(pendulum)[0] == state
    system = ac.compile(pendulum)
    assert np.isfinite(rates(system, system.initial_state())).all()


def test_starts_that_a_class_declares_count_as_those_that_modifiers_give():
    class Lying(Pendulum):
        def __init__(self):
            super().__init__()
            del self.x
            self.x = ac.Variable(start=1.0)

    assert independent(Lying()) == ["y", "w"]


def test_a_start_that_is_given_counts_more_than_that_of_another_name():
    class Named(Pendulum):
        def __init__(self):
            super().__init__(x=ac.Start(1.0), y=ac.Start(0.0))
            self.height = ac.Variable(start=0.5)

        def equations(self):
            yield from super().equations()
            yield ac.Eq(self.height, self.y)

    assert independent(Named()) == ["y", "w"]


@pytest.mark.parametrize("n", [3, 6])
def test_a_signal_differentiated_many_times(n):
    names = [f"x{i}" for i in range(n)]

    def stated(s):
        x = [getattr(s, name) for name in names]
        yield Eq(x[0], ac.sin(ac.time))
        for a, b in itertools.pairwise(x):
            yield Eq(der(a), b + x[0])

    system = ac.compile(Equations(" ".join(names), stated))
    assert system.states == ()
    assert worst(system) < 1e-12


def test_constraints_between_relative_coordinates():
    def stated(s):
        yield Eq(der(der(s.x)), s.f - s.x)
        yield Eq(der(der(s.y)), -s.f)
        yield Eq(s.r, s.x - s.y)
        yield Eq(s.r, ac.sin(ac.time))

    system = ac.compile(Equations("x y r f", stated))
    assert system.states == ("x", "der(x)")
    assert worst(system) < 1e-12


@pytest.mark.slow
def test_piecewise_constraints():
    def stated(s):
        yield Eq(der(s.x), s.f)
        yield Eq(der(s.y), 1 - s.f)
        yield Eq(s.x, ac.where(s.y > 0.5, 2 * s.y - 0.5, s.y))

    assert worst(ac.compile(Equations("x y f", stated))) < 1e-12


# -- choice of states -------------------------------------------------------------------------------------------


def two_masses(**modifiers):
    return model(
        "a.flange_b - b.flange_a", a=Mass(m=1.0, L=1.0), b=Mass(m=2.0, **modifiers), n=Fixed()
    )


def test_the_first_declared_is_the_state():
    assert ac.compile(two_masses()).states == ("a.s", "a.v")


def test_the_user_may_prefer_another():
    prefer = ac.Start(state="prefer")
    assert ac.compile(two_masses(s=prefer, v=prefer)).states == ("b.s", "b.v")
    assert ac.compile(two_masses(v=prefer)).states == ("b.s", "b.v")
    assert ac.compile(two_masses(s=prefer)).states == ("b.s", "b.v")


def test_always_beats_prefer_and_never_gives_way():
    whole = two_masses(s=ac.Start(state="prefer"))
    whole.a.modify(s=ac.Start(state="always"))
    assert ac.compile(whole).states[0] == "a.s"
    whole.a.modify(s=ac.Start(state="never"))
    assert ac.compile(whole).states[0] == "b.s"


def coupled(order, first, second):
    """Four states under two constraints, in some order of declaration."""

    def stated(s):
        yield Eq(der(s.a), -s.a + s.l + s.m)
        yield Eq(der(s.b), -2 * s.b - s.l - s.m + 1)
        yield Eq(der(s.c), -3 * s.c + s.l)
        yield Eq(der(s.d), -s.d - s.m)
        yield first(s)
        yield second(s)

    return Equations(f"{order} l m", stated, p=2.0, q=0.5)


@pytest.mark.parametrize("order", ["a b c d", "c d a b", "d b c a", "c a b d"])
def test_numbers_decide_where_the_structure_promises_too_much(order):
    # a - b occurs in both constraints: a and b cannot both be computed from c and d
    component = coupled(order, lambda s: Eq(s.a - s.b + s.c, 0), lambda s: Eq(s.a - s.b - s.d, 0))
    system = ac.compile(component)
    assert set(system.states) != {"c", "d"}
    assert worst(system) < 1e-10


def test_parameter_values_decide_too():
    # p q = 1
    component = coupled(
        "c d a b", lambda s: Eq(s.p * s.a - s.b + s.c, 0), lambda s: Eq(s.a - s.q * s.b - s.d, 0)
    )
    system = ac.compile(component)
    assert set(system.states) != {"c", "d"}
    assert worst(system) < 1e-10


def test_constraints_that_repeat_each_other_are_told():
    with pytest.raises(
        ac.StructureError, match="constraints between states repeat or contradict"
    ) as error:
        ac.compile(
            coupled(
                "a b c d", lambda s: Eq(2 * s.a - 3 * s.b, 1), lambda s: Eq(4 * s.a - 6 * s.b, 2)
            )
        )
    assert "4*a - 6*b = 2" in str(error.value)
    assert "derivative" not in str(error.value)


# -- loops --------------------------------------------------------------------------------------------------------


@pytest.mark.cases(fast=1, slow=2)
@pytest.mark.parametrize("n", some_slow([1, 2, 3, 4, 5], [3, 5]))
def test_linear_loops(n):
    rng = np.random.default_rng(n)
    a, b = rng.normal(size=(n, n)) + 3 * np.eye(n), rng.normal(size=n)

    class Linear(ac.Component):
        A = ac.Parameter(a, shape=(n, n))
        x = ac.Variable(shape=n)
        z = ac.Variable()

        def equations(self):
            for i in range(n):
                total = sum(self.A[i][j] * self.x[j] for j in range(n))
                yield Eq(total * (1 + self.z**2), b[i] + self.z)
            yield Eq(der(self.z), sum(self.x))

    system = ac.compile(Linear())
    names = [f"x[{i + 1}]" for i in range(n)]
    z = 0.4

    def solution(matrix):
        params = {
            **system.parameters(),
            **{f"A[{i + 1},{j + 1}]": matrix[i, j] for i in range(n) for j in range(n)},
        }
        return system.observe(names, 0.0, jnp.array([z]), None, params)

    expected = np.linalg.solve(a * (1 + z**2), b + z)
    np.testing.assert_allclose(solution(jnp.asarray(a)), expected, rtol=1e-11)
    if n == 3:
        ours = jax.jacobian(solution)(jnp.asarray(a))
        other = jax.jacobian(lambda m: jnp.linalg.solve(m * (1 + z**2), b + z))(jnp.asarray(a))
        np.testing.assert_allclose(ours, other, rtol=1e-9)


def test_a_loop_that_depends_on_time_and_states():
    def stated(s):
        yield Eq(s.a * (2 + ac.sin(ac.time)) + s.b * s.x, 1)
        yield Eq(s.b * (1 + s.x**2) - s.a, s.x)
        yield Eq(der(s.x), s.a - s.b)

    assert worst(ac.compile(Equations("a b x", stated))) < 1e-12


def test_derivatives_in_a_loop():
    def stated(s):
        yield Eq(2 * der(s.x) + der(s.y), s.y)
        yield Eq(der(s.y) - s.x * der(s.x), s.x - s.y)

    assert worst(ac.compile(Equations("x y", stated))) < 1e-12


@pytest.mark.slow
def test_a_divisor_that_is_zero_is_not_divided_by():
    # two springs in series, one of them without damping: f = c s + 0 v
    parts = {"x": Fixed(), "m": Mass(m=2.0)}
    lines = ("x.flange - a.flange_a", "a.flange_b - b.flange_a", "b.flange_b - m.flange_a")
    for da, db in ((0.0, 2.0), (2.0, 0.0)):
        springs = {"a": SpringDamper(c=10.0, d=da), "b": SpringDamper(c=20.0, d=db)}
        parts = {"x": Fixed(), "m": Mass(m=2.0)}
        system = ac.compile(model(*lines, **parts, **springs))
        assert worst(system) < 1e-12


def diode_circuit(n=1, **law):
    """n circuits of a source, a resistor and a diode."""
    made = Model()
    made.g = Ground()
    made.v = [SignalVoltage() for _ in range(n)]
    made.r = [Resistor(R=1.0 + i) for i in range(n)]
    made.d = [Diode() for _ in range(n)]
    for v, r, d in zip(made.v, made.r, made.d, strict=True):
        made.connect(v.p, r.p)
        made.connect(r.n, d.p)
        made.connect(d.n, v.n, made.g.p)
    return made


@pytest.mark.slow
def test_a_nonlinear_loop_and_its_implicit_gradient():
    system = ac.compile(diode_circuit())
    assert sizes(system) == [(3, 1, 1)]
    params = system.parameters()

    @jax.jit
    def current(resistance, voltage):
        given = {**params, "r[1].R": resistance}
        return system.observe("d[1].i", 0.0, jnp.zeros(0), voltage[None], given)

    i = float(current(2.0, jnp.array(1.5)))
    assert 2 * i + 0.5 * np.log(i / 0.1 + 1) == pytest.approx(1.5, abs=1e-9)
    derivatives = jax.jit(jax.grad(current, argnums=(0, 1)))(2.0, jnp.array(1.5))
    h = 1e-5
    np.testing.assert_allclose(
        derivatives,
        [
            (current(2 + h, jnp.array(1.5)) - current(2 - h, jnp.array(1.5))) / (2 * h),
            (current(2.0, jnp.array(1.5 + h)) - current(2.0, jnp.array(1.5 - h))) / (2 * h),
        ],
        rtol=1e-7,
    )


@pytest.mark.parametrize("voltage", [-5.0, 0.5, 50.0])
def test_a_steep_diode_converges_from_afar(voltage):
    system = ac.compile(
        model(
            "v.p - r.p", "r.n - d.p", "d.n - v.n - g.p",
            v=SignalVoltage(), r=Resistor(R=100.0), d=Diode(I_s=1e-12, V_t=0.026), g=Ground(),
        )
    )  # fmt: skip
    names = ["d.v", "d.i"]
    v, i = system.observe(names, 0.0, jnp.zeros(0), [voltage], system.parameters())
    assert float(v + 100 * i) == pytest.approx(voltage)
    assert float(i) == pytest.approx(1e-12 * np.expm1(v / 0.026), rel=1e-6, abs=1e-15)


@pytest.mark.slow
def test_equal_loops_are_solved_side_by_side():
    few, many = ac.compile(diode_circuit(2)), ac.compile(diode_circuit(40))
    assert sizes(few) == [(3, 1, 2)]
    assert sizes(many) == [(3, 1, 40)]
    u = np.linspace(0.5, 2.0, 2)
    i = few.observe(["d[1].i", "d[2].i"], 0.0, jnp.zeros(0), u, few.parameters())
    np.testing.assert_allclose(i * np.array([1.0, 2.0]) + 0.5 * np.log(i / 0.1 + 1), u, rtol=1e-9)


class Cubic(eqx.Module):
    k: jax.Array

    def __call__(self, i):
        return self.k * (i + 0.3 * i**3)


def with_laws(laws):
    made = Model()
    made.g = Ground()
    made.v = [SignalVoltage() for _ in laws]
    made.r = [NonlinearResistor(law=law) for law in laws]
    made.q = [Resistor(R=2.0) for _ in laws]
    for v, r, q in zip(made.v, made.r, made.q, strict=True):
        made.connect(v.p, r.p)
        made.connect(r.n, q.p)
        made.connect(q.n, v.n, made.g.p)
    return made


def test_modules_in_loops_each_with_its_own_weights():
    system = ac.compile(with_laws([Cubic(jnp.array(1.0)), Cubic(jnp.array(4.0))]))
    assert [s.shape.is_linear for s in loops(system)] == [False]
    params = system.parameters()
    i = system.observe(["r[1].i", "r[2].i"], 0.0, jnp.zeros(0), [3.0, 3.0], params)
    np.testing.assert_allclose(np.array([1.0, 4.0]) * (i + 0.3 * i**3) + 2 * i, 3.0, rtol=1e-9)


def test_a_module_in_a_constraint_goes_through_index_reduction():
    def stated(s):
        yield Eq(der(s.x), s.v)
        yield Eq(der(s.v), s.f)
        yield Eq(der(s.y), s.f - s.y)
        yield Eq(s.y, s.net(s.x) + 2 * s.v)

    class Bound(Equations):
        net = ac.Module(lambda key: Cubic(jnp.array(1.5)))

    assert worst(ac.compile(Bound("x v y f", stated))) < 1e-10


@pytest.mark.parametrize(
    "stated",
    [
        lambda s: [Eq(s.y, s.x + 0.5 * ac.floor(s.x + 3)), Eq(der(s.y), 1)],
        lambda s: [Eq(s.y, 3 * s.x + ac.where(s.x > 5, 1, -1)), Eq(der(s.y), 1)],
        lambda s: [Eq(s.y, s.x + s.x**3), Eq(der(s.y), 1)],
        lambda s: [Eq(s.y, s.x * ac.Abs(s.x)), Eq(der(s.y), 1)],
        lambda s: [Eq(der(s.x) ** 3 + der(s.x), s.y), Eq(der(s.y), s.x - s.y)],
    ],
)
def test_what_is_not_linear_is_not_solved_as_if_it_were(stated):
    assert worst(ac.compile(Equations("x y", stated))) < 1e-8


def test_levels_group_equal_formulas():
    made = Model()
    made.x = Fixed()
    made.m = [Mass(m=1.0 + i) for i in range(6)]
    made.s = [SpringDamper(c=2.0, d=1.0) for _ in range(6)]
    for m, s in zip(made.m, made.s, strict=True):
        made.connect(made.x.flange, s.flange_a)
        made.connect(s.flange_b, m.flange_a)
    steps = ac.compile(made).reduced.steps
    assert all(isinstance(s, Assignment) for s in steps)
    # the forces of the springs, the accelerations, and what holds the wall
    assert [len(s.unknowns) for s in steps] == [6, 6, 1]


# -- models without much ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("variables", "stated", "states"),
    [
        ("", lambda s: [], ()),
        ("x y", lambda s: [Eq(s.x + s.y, 3), Eq(s.x - s.y, 1)], ()),
        ("x", lambda s: [Eq(s.x, ac.sin(ac.time))], ()),
        ("x", lambda s: [Eq(der(s.x), 3)], ("x",)),
        ("x y", lambda s: [Eq(der(s.x), 0), Eq(der(s.y), s.x)], ("x", "y")),
        ("x", lambda s: [Eq(s.x, -s.x)], ()),
        ("x y", lambda s: [Eq(s.x, s.k), Eq(s.y, der(s.x))], ()),
        ("x y", lambda s: [Eq(s.y, der(s.x)), Eq(s.x, ac.time**2)], ()),
    ],
)
def test_small_models(variables, stated, states):
    system = ac.compile(Equations(variables, stated, k=2.0))
    assert system.states == states
    assert system.initial_state().shape == (len(states),)
    assert rates(system, np.ones(len(states))).shape == (len(states),)
    assert worst(system) < 1e-12
    assert len(system.equations) == len(states)


# -- diagnosis ----------------------------------------------------------------------------------------------------


class Forgetful(SpringDamper):
    """A spring without its base classes' equations."""

    def equations(self):
        yield Eq(self.f, self.c * self.s_rel)


class Watched(ac.Component):
    """A tank whose level a switch watches; an equation sets the switch's input."""

    def __init__(self, leak=1.0):
        super().__init__()
        self.tank = Equations(
            "level", lambda s: [Eq(der(s.level), s.q - leak * s.level)], inputs="q"
        )
        self.switch = Switch()
        self.connect(self.switch.flow, self.tank.q)

    def equations(self):
        yield from super().equations()
        yield Eq(self.switch.level, self.tank.level)


class Switch(ac.Component):
    """A flow below a level."""

    level, flow, on = ac.Input(), ac.Output(), ac.Discrete(0, kind="bool")

    def equations(self):
        yield Eq(self.on, self.level < 1)
        yield Eq(self.flow, self.on)


@pytest.mark.parametrize(
    ("whole", "told"),
    [
        (
            lambda: Watched(),
            [
                "4 equations for 3 unknowns",
                "redundant equations: 'Watched: switch.level = tank.level'",
                "together with: 'tank (Equations: der(level) = -1.0*level + q)'",
                "set the Input 'switch.level', to which nothing is",
            ],
        ),
        (
            lambda: Watched(leak=0),
            ["discrete variable 'switch.on' is tied to the derivative of the input 'switch.level'", "an Output"],
        ),
        (
            lambda: model("a.flange_a - x.flange", "a.flange_b - y.flange", a=Mass(m=1.0), x=Fixed(), y=Fixed()),
            ["11 equations for 11 unknowns", "undetermined: 'a.flange_a.f'", "y.flange", "joined rigidly"],
        ),
        (
            lambda: model(a=SpringDamper(c=1.0, d=1.0)),
            [
                "undetermined: 'a.flange_a.s'",
                "overdetermined; redundant equations",
                "a Fixed (a ground, a reference) missing",
            ],
        ),
        (
            lambda: model("v.p - r.p", "v.n - r.n", v=ConstantVoltage(V=1.0), r=Resistor(R=1.0)),
            ["undetermined: 'v.n.v'", "ground"],
        ),
        (
            lambda: model(
                "v.p - w.p", "v.n - w.n - g.p", v=ConstantVoltage(V=1.0), w=ConstantVoltage(V=2.0), g=Ground()
            ),
            ["undetermined: 'v.i'", "w (ConstantVoltage: v = V)", "together with: 'v (ConstantVoltage: v = V)'"],
        ),
        (
            lambda: Equations("x y", lambda s: [Eq(der(s.x), 1)]),
            ["1 equations for 2 unknowns", "undetermined: 'y'", "an equation forgotten?"],
        ),
        (
            lambda: Equations("x y", lambda s: [Eq(der(s.x), -2 * s.y)]),
            ["1 equations for 2 unknowns", "undetermined: 'y', or else 'x'", "an equation forgotten?"],
        ),
        (
            lambda: Equations("x", lambda s: [Eq(der(s.x), 1), Eq(der(s.x), 1)]),
            ["2 equations for 1 unknowns", "Equations: der(x) = 1", "an equation stated twice?"],
        ),
        (
            lambda: Equations("x", lambda s: [Eq(s.x, s.x), Eq(der(s.x), 1)]),
            ["Equations: x = x"],
        ),
        (
            lambda: Equations("x", lambda s: [Eq(s.p, s.q), Eq(der(s.x), 1)], p=1.0, q=1.0),
            ["Equations: p = q"],
        ),
        (
            lambda: Equations("x y", lambda s: [Eq(s.x + s.y, 1), Eq(s.x + s.y, 2)]),
            ["undetermined: 'y'", "x + y = 2", "together with: 'Equations: x + y = 1'"],
        ),
        (
            lambda: Equations(
                "x y", lambda s: [Eq(s.p * s.x + s.y, 1), Eq(s.x + s.q * s.y, 2)], p=2.0, q=0.5
            ),
            ["the equations of a loop repeat or contradict"],
        ),
        (
            lambda: model(
                "a.flange_b - k.flange_a - l.flange_a",
                "k.flange_b - l.flange_b - b.flange_a",
                a=Mass(m=1.0), b=Mass(m=1.0), k=Lever(), l=Lever(),
            ),
            ["constraints between states repeat", "l (Lever: flange_a.s = flange_b.s*ratio)", "two ways?"],
        ),
        (
            lambda: model(m=Mass(m=0.0)),
            ["'m.a' cannot be computed from m (Mass: a*m = ", "because of 'm.m'; give another value"],
        ),
        (
            lambda: model(
                "x.flange - a.flange_a", "a.flange_b - b.flange_a", "b.flange_b - m.flange_a",
                x=Fixed(), a=SpringDamper(c=1.0, d=0.0), b=SpringDamper(c=1.0, d=0.0), m=Mass(m=1.0),
            ),
            ["repeat or contradict", "'a.d', 'b.d' being zero may be why"],
        ),
        (
            lambda: Equations("x", lambda s: [Eq(s.x, s.u), Eq(s.x, 3)], inputs="u"),
            ["overdetermined; redundant equations: 'Equations: x = 3'"],
        ),
        (
            lambda: model(part=Equations("x", lambda s: [Eq(der(s.x), s.u), Eq(s.u, 3)], inputs="u")),
            ["part (Equations: u = 3)", "set the Input 'part.u', to which nothing is", "an Output."],
        ),
        (
            lambda: model(
                "c.flange - s.flange_a", "s.flange_b - m.flange_a",
                c=Fixed(), s=Forgetful(c=1.0, d=0.0), m=Mass(m=1.0),
            ),
            ["undetermined", "'s' (Forgetful) states none of the equations of its base class SpringDamper"],
        ),
    ],
)  # fmt: skip
def test_a_singular_model_is_explained(whole, told):
    with pytest.raises(ac.StructureError, match=".*".join(map(re.escape, told))):
        ac.compile(whole())


@pytest.mark.slow
def test_index_reduction_of_a_rigid_chain_takes_time_in_proportion_to_its_length():
    def calls(n):
        profile = cProfile.Profile()
        profile.runcall(reduce, flatten(Train(n)))
        return pstats.Stats(profile).total_calls

    calls(120)  # fills caches
    found = [calls(n) for n in (120, 240, 480)]
    assert found[2] - found[1] == pytest.approx(2 * (found[1] - found[0]), rel=0.1)


class StatedTwice(ac.Component):
    """A model in lines of this file."""

    def __init__(self) -> None:
        super().__init__()
        self.x, self.y = ac.Variable(), ac.Variable()

    def equations(self):
        yield ac.Eq(ac.der(self.x), -self.x)
        yield from self.further()

    def further(self):
        yield ac.Eq(self.y, 2 * self.x)
        yield ac.Eq(self.y, 3 * self.x)


def test_lines_of_equations_that_do_not_fit_are_named() -> None:
    lines, first = inspect.getsourcelines(StatedTwice)
    places = {
        text: first + k
        for k, line in enumerate(lines)
        for text in ("-self.x", "2 *", "3 *")
        if text in line
    }
    file = Path(__file__).name
    expected = f"See lines {places['3 *']}, {places['-self.x']}, {places['2 *']} of {file}."
    with pytest.raises(ac.StructureError, match=re.escape(expected)):
        ac.compile(StatedTwice())
