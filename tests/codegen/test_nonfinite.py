"""Models whose equations have no finite value somewhere: what is said of the place."""

import pytest

import acausal as ac
from acausal.flattening import FEW_VARIANTS
from tests.support.parts import Equations, model

Eq, der = ac.Eq, ac.der


def fold():
    """x grows from 0.5; y follows from y² = 1 - x, which has no solution above x = 1."""
    component = Equations("x y", lambda s: [Eq(der(s.x), s.y), Eq(s.y**2, 1 - s.x)])
    component.modify(x=ac.Start(0.5, fixed=True), y=ac.Start(1.0))
    return component


class Fold(ac.Component):
    """As `fold`; subclasses inherit its equations."""

    x, y = ac.Variable(), ac.Variable()

    def equations(self):
        yield Eq(der(self.x), self.y)
        yield Eq(self.y**2, 1 - self.x)


@pytest.mark.slow
def test_of_classes_that_inherit_a_loop_the_one_that_fails_is_named():
    whole = ac.Component()
    for name in (*(f"Early{i}" for i in range(FEW_VARIANTS)), "Late"):
        start = {"x": ac.Start(0.5 * (name == "Late"), fixed=True), "y": ac.Start(1.0)}
        setattr(whole, name.lower(), type(name, (Fold,), {})(**start))
    with pytest.raises(ac.SimulationError, match=r"for 'late\.y'.*leaves 'Late: y\*\*2 = 1"):
        ac.simulate(ac.compile(whole), 1.8, dt=0.02)


def square_root():
    component = Equations("x", lambda s: [Eq(der(s.x), -ac.sqrt(s.x))])
    component.modify(x=ac.Start(1.0, fixed=True))
    return component


@pytest.mark.machines
@pytest.mark.parametrize(
    ("part", "steps", "sentence"),
    [
        (fold, {"dt": 0.02}, r"for 'part\.y'; the nearest point is part\.y = .*leaves 'Equations: y\*\*2 = 1"),
        pytest.param(
            fold, {"max_steps": 2000}, r"There Newton's method finds no solution of the equations for 'part\.y';",
            marks=pytest.mark.slow,
        ),
        (square_root, {"dt": 0.03}, r"There 'der\(part\.x\)' = -sqrt\(x\) is nan: a division by zero"),
    ],
)  # fmt: skip
def test_the_place_of_a_breakdown(part, steps, sentence):
    system = ac.compile(model(part=part()))
    with pytest.raises(ac.SimulationError, match=sentence):
        ac.simulate(system, (0.0, 3.0), **steps)


@pytest.mark.slow
def test_a_loop_without_a_solution_at_the_start():
    component = Equations(
        "x y", lambda s: [Eq(der(s.x), s.y), Eq(ac.exp(s.y) + s.y**2, s.p - s.x)], p=-1.0
    )
    component.modify(x=ac.Start(1.0), y=ac.Start(2.0, fixed=True))
    with pytest.raises(
        ac.InitializationError,
        match=r"no finite values at its starts.*no solution of the equations for 'y';",
    ):
        ac.compile(component).initial_state()


def test_a_singular_linear_loop():
    component = Equations(
        "x y z",
        lambda s: [Eq(der(s.x), s.y), Eq(s.y + s.z, s.x), Eq(s.y + s.p * s.z, 2 * s.x)],
        p=2.0,
    )
    system = ac.compile(component)
    with pytest.raises(ac.SimulationError, match="linear equations for 'y', 'z' are singular"):
        ac.simulate(system, (0, 1), dt=0.1, x0={"x": 1.0}, params={**system.parameters(), "p": 1.0})


def test_inputs_with_the_other_sign_are_read_as_the_program_reads_them():
    """v = der(-u) is 4 where der(u) is -4: its root exists, and 1/x is to blame."""

    def stated(s):
        rates = [Eq(der(s.x), ac.sqrt(s.v)), Eq(der(s.y), 1 / s.x)]
        return [Eq(s.p, -s.u), Eq(s.v, der(s.p)), *rates]

    system = ac.compile(Equations("p v x y", stated, inputs="u"))
    assert system.inputs == ("u", "der(u)")
    point = system.values(0.0, [0.0, 0.0], [1.0, -4.0], system.parameters())
    told = system.explain_nonfinite(point)
    assert told is not None
    assert told.startswith("'der(y)' = 1/x is inf")
