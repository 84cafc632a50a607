"""Tearing on integers; which loops of a model are torn, and what a component can say about it."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, strategies as st

import acausal as ac
from acausal.components import electrical as el
from acausal.flattening import flatten
from acausal.structure import SparseLoop, TornLoop, blocks, reduce
from acausal.structure.tearing import Preference, tear
from tests.structure.test_graph import incidences
from tests.structure.test_sparse_loops import Net, Train
from tests.support.counted import calls_below
from tests.support.parts import Equations
from tests.support.planar import GRAVITY, Arm, Linkage

Eq = ac.Eq


def check_torn(torn, incidence, n):
    known = set(torn.tears)
    for e, v in torn.assigned:
        assert set(incidence[e]) - known == {v}
        known.add(v)
    assert known == set(range(n))
    used = [e for e, _ in torn.assigned]
    assert sorted([*used, *torn.residuals]) == list(range(n))
    assert len(torn.tears) == len(torn.residuals)


def anything(equation, variable):
    return True


@given(incidences, st.booleans())
def test_tearing_leaves_assignments_in_order(incidence, some):
    n = len(incidence)
    incidence = [sorted({*row, i}) for i, row in enumerate(incidence)]
    torn = tear(incidence, lambda e, v: not (some and (e + v) % 3 == 0), n)
    check_torn(torn, incidence, n)


@given(incidences, st.data())
def test_preferences_are_kept(incidence, data):
    n = len(incidence)
    incidence = [sorted({*row, i}) for i, row in enumerate(incidence)]
    required = data.draw(st.sets(st.integers(0, n - 1)))
    torn = tear(incidence, anything, n, lambda v: Preference(required=v in required))
    check_torn(torn, incidence, n)
    assert required <= set(torn.tears)


def test_a_ring_is_torn_once():
    n = 50
    torn = tear([[i, (i + 1) % n] for i in range(n)], anything, n)
    assert len(torn.tears) == 1


@pytest.mark.parametrize("kind", [{"better": True}, {"rank": 1}, {"required": True}])
def test_of_equals_the_preferred_one_is_torn(kind):
    n = 5
    for wanted in range(n):
        ring = [[i, (i + 1) % n] for i in range(n)]
        torn = tear(
            ring, anything, n, lambda v, w=wanted: Preference(**kind) if v == w else Preference()
        )
        assert torn.tears == (wanted,)


def test_what_cannot_be_solved_is_torn():
    torn = tear([[0, 1], [0, 1]], lambda e, v: False, 2)
    assert torn.tears == (0, 1)
    assert torn.assigned == ()


def test_a_guess_that_follows_from_others_is_dropped():
    # by numbers of equations 0 comes first, but all follows from 1 and 2
    incidence = [[0, 1, 2], [0, 3, 1], [0, 4, 2], [0, 3, 4, 1], [0, 1, 2, 4]]
    assert len(tear(incidence, anything, 5).tears) == 2


@pytest.mark.slow
def test_a_large_block_is_torn_with_bounded_work():
    n = 2000
    rng = np.random.default_rng(0)
    incidence = [sorted({i, *rng.integers(0, n, 3).tolist()}) for i in range(n)]
    with calls_below(20_000_000):
        torn = tear(incidence, anything, n)
    check_torn(torn, incidence, n)


# -- in models -------------------------------------------------------------------------------------------


def loops(model):
    """Kind, unknowns and tearing variables of every loop."""
    return [
        (type(s), s.shape.n_unknowns, len(s.shape.torn.tears))
        if isinstance(s, TornLoop)
        else (type(s), len(s.unknowns), None)
        for s in reduce(flatten(model)).steps
        if isinstance(s, TornLoop | SparseLoop)
    ]


@pytest.mark.parametrize("n", [2, 6, 10])
def test_an_arm_is_torn_at_its_joints(n):
    assert loops(Arm(n)) == [(TornLoop, 10 * n - 4, n)]


def test_a_large_loop_is_torn_where_few_guesses_are_enough():
    ((kind, unknowns, tears),) = loops(Arm(6, load=9))
    assert (kind, tears) == (TornLoop, 6)
    assert blocks.LARGE < unknowns < blocks.WRITTEN


def test_a_linkage_is_torn_at_its_joints_and_where_it_closes():
    assert [tears for *_, tears in loops(Linkage([0.3, 1.0, 0.7]))] == [2, 2, 5]


@pytest.mark.slow
def test_loops_with_many_tearing_variables_or_that_lose_digits_are_sparse():
    assert loops(Arm(12)) == [(SparseLoop, 116, None)]
    assert [kind for kind, *_ in loops(Net(6, lambda k: el.Conductor(G=1.0)))] == [SparseLoop]
    assert [kind for kind, *_ in loops(Train(60))] == [SparseLoop]


def hinted(**hints):
    """A ring of three unknowns, with preferences."""

    class Ring(ac.Component):
        x = ac.Variable(start=1.0)
        a = ac.Variable(tear=hints.get("a", "default"))
        b = ac.Variable(tear=hints.get("b", "default"))
        c = ac.Variable(tear=hints.get("c", "default"))

        def equations(self):
            yield Eq(ac.der(self.x), self.a)
            yield Eq(self.a, 2 * self.b + self.x)
            yield Eq(self.b, 3 * self.c - self.x)
            yield Eq(self.c, 5 * self.a)

    reduced = reduce(flatten(Ring()))
    (loop,) = (s for s in reduced.steps if isinstance(s, TornLoop))
    return [reduced.name(int(loop.unknowns[0][i])) for i in loop.shape.torn.tears]


@pytest.mark.parametrize(
    ("hints", "torn"),
    [
        ({"b": "prefer"}, ["b"]),
        ({"c": "prefer", "a": "avoid"}, ["c"]),
        ({"a": "never", "b": "avoid"}, ["c"]),
        ({"a": "always", "b": "prefer"}, ["a"]),
        ({"a": "always", "b": "always"}, ["a", "b"]),
        ({"a": "never", "b": "never", "c": "never"}, ["a"]),
    ],
)
def test_a_component_can_say_what_is_torn(hints, torn):
    assert hinted(**hints) == torn


def test_a_wrong_hint_is_refused():
    with pytest.raises(ac.DeclarationError, match="tear='often' must be one of never, avoid"):
        ac.Variable(tear="often")


def test_of_several_names_the_strongest_preference_counts():
    class Names(ac.Component):
        x = ac.Variable(start=1.0)
        a, b = ac.Variable(), ac.Variable(tear="avoid")
        c = ac.Variable()

        def equations(self):
            yield Eq(ac.der(self.x), self.a)
            yield Eq(self.a, -self.b)
            yield Eq(self.b, 2 * self.c + self.x)
            yield Eq(self.c, 3 * self.b)

    reduced = reduce(flatten(Names()))
    (loop,) = (s for s in reduced.steps if isinstance(s, TornLoop))
    (torn,) = loop.shape.torn.tears
    assert reduced.name(int(loop.unknowns[0][torn])) == "c"


@pytest.mark.slow
def test_a_torn_arm_moves_as_a_sparse_one(monkeypatch):
    torn = ac.compile(Arm(3))
    monkeypatch.setattr(blocks, "LARGE", 10)
    monkeypatch.setattr(blocks, "WRITTEN", 10)
    sparse = ac.compile(Arm(3))
    for system, kind in ((torn, TornLoop), (sparse, SparseLoop)):
        assert any(isinstance(s, kind) for s in system.reduced.steps)
    x = jnp.linspace(0.2, 1.0, 6)

    def rates_and_gradient(system):
        def speed(x, packed):
            rates = system.vector_field(0.0, x, None, packed)
            return jnp.sum(rates**2), rates

        (_, rates), found = jax.jit(jax.value_and_grad(speed, (0, 1), has_aux=True))(
            x, system.pack()
        )
        return rates, found[0], found[1].values

    for ours, theirs in zip(*map(rates_and_gradient, (torn, sparse)), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-8, atol=1e-10)


@pytest.mark.machines
def test_a_linkage_closes_and_keeps_its_energy():
    linkage = Linkage([0.3, 1.0, 0.7], [1.0, 0.5, -1.0])
    for joint in linkage.joint:
        joint.modify(d=0.0)
    system = ac.compile(linkage)
    assert system.states[:2] == ("joint[1].phi", "joint[1].w")
    solution = ac.simulate(system, (0, 0.5), dt=1e-3, x0={"joint[1].phi": 1.0, "joint[1].w": 2.0})
    assert np.ptp(solution["joint[1].phi"]) > 0.3
    end = solution[["outer[3].frame_b.x", "outer[3].frame_b.y"]]
    np.testing.assert_allclose(end, np.broadcast_to([1.0, 0.0], end.shape), atol=1e-9)
    energy = sum(
        (1.0 + 0.1 * k)
        * (
            (solution[f"body[{k + 1}].v_x"] ** 2 + solution[f"body[{k + 1}].v_y"] ** 2) / 2
            + GRAVITY * solution[f"body[{k + 1}].frame.y"]
        )
        + 0.1 * solution[f"body[{k + 1}].w"] ** 2 / 2
        for k in range(3)
    )
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


def test_where_starts_are_given_loops_are_torn_there():
    names = ["b", "c"]
    for wanted in names:

        def stated(s):
            yield Eq(ac.der(s.x), s.b)
            yield Eq(s.b**3 + s.c, s.x)
            yield Eq(s.c**3 - s.b, s.x)

        component = Equations("x b c", stated)
        component.modify(**{wanted: ac.Start(2.0)})
        reduced = reduce(flatten(component))
        (loop,) = (s for s in reduced.steps if isinstance(s, TornLoop))
        torn = [reduced.name(int(loop.unknowns[0][i])) for i in loop.shape.torn.tears]
        assert torn == [wanted]
