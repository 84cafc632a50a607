"""Linearization against what is known in closed form."""

import numpy as np
import pytest

import acausal as ac
from acausal.components import translational as tl
from tests.support.oscillator import plain


class Oscillator(ac.Component):
    """A driven mass on a spring and a damper."""

    def __init__(self) -> None:
        super().__init__()
        self.wall = tl.Fixed()
        self.spring = tl.SpringDamper(c=100.0, d=2.0)
        self.mass = tl.Mass(m=1.0)
        self.drive = tl.Force()
        self.connect(self.wall.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.drive.flange)


@pytest.fixture(scope="module")
def linearized() -> ac.Linearization:
    return ac.linearize(ac.compile(Oscillator()), outputs=["mass.s", "mass.a"])


def test_matrices_are_those_of_the_oscillator(linearized: ac.Linearization) -> None:
    A, B, C, D = linearized
    assert linearized.states == ("mass.s", "mass.v")
    np.testing.assert_allclose(A, [[0, 1], [-100, -2]])
    np.testing.assert_allclose(B, [[0], [1]])
    np.testing.assert_allclose(C, [[1, 0], [-100, -2]])
    np.testing.assert_allclose(D, [[0], [1]])


def test_eigenvalues_and_damping(linearized: ac.Linearization) -> None:
    expected = -1 + 1j * np.sqrt(99) * np.array([-1, 1])
    np.testing.assert_allclose(linearized.eigenvalues(), expected)
    np.testing.assert_allclose(linearized.damping(), [0.1, 0.1])


def test_frequency_response_of_position_and_acceleration(linearized: ac.Linearization) -> None:
    omega = np.array([0.1, 10.0, 100.0])
    position = 1 / (100 - omega**2 + 2j * omega)
    response = linearized.frequency_response(omega)
    np.testing.assert_allclose(response[:, 0, 0], position)
    np.testing.assert_allclose(response[:, 1, 0], -(omega**2) * position)


def test_a_nonlinear_model_is_linearized_where_it_is() -> None:
    class Cubic(tl.PartialCompliant):
        def equations(self):
            yield from super().equations()
            yield ac.Eq(self.f, 5.0 * self.s_rel**3)

    class Model(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.wall, self.spring, self.mass = tl.Fixed(), Cubic(), tl.Mass(m=2.0)
            self.connect(self.wall.flange, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.mass.flange_a)

    A = ac.linearize(ac.compile(Model()), {"mass.s": 0.3}).A
    np.testing.assert_allclose(A[1, 0], -15 * 0.3**2 / 2.0)


def test_outputs_are_named_by_texts_of_any_kind() -> None:
    system = plain()
    names = np.array(["mass.s", "mass.a"])
    assert ac.linearize(system, outputs=names).outputs == ("mass.s", "mass.a")
    assert ac.linearize(system, outputs="mass.s").outputs == ("mass.s",)


@pytest.mark.parametrize("omega", ["x", None, np.nan, [], np.ones((2, 2)), 1j])
def test_what_is_no_frequency(linearized: ac.Linearization, omega: object) -> None:
    with pytest.raises(
        ac.DataError, match=r"^omega=.* are not frequencies; give numbers, in rad/s"
    ):
        linearized.frequency_response(omega)  # type: ignore[arg-type]


def test_an_undamped_pole_has_no_response() -> None:
    class Pushed(ac.Component):
        def __init__(self) -> None:
            self.mass = tl.Mass(m=1.0)
            self.push = tl.Force()
            self.connect(self.push.flange, self.mass.flange_a)

    linearized = ac.linearize(ac.compile(Pushed()), outputs=["mass.s"])
    with pytest.raises(ac.DataError, match=r"^omega=0 rad/s is an undamped pole"):
        linearized.frequency_response([1.0, 0.0])


def test_wrong_names_are_refused(linearized: ac.Linearization) -> None:
    system = ac.compile(Oscillator())
    with pytest.raises(ac.DataError, match=r"'mass\.x' is not a state; did you mean 'mass\."):
        ac.linearize(system, {"mass.x": 1.0})
    with pytest.raises(ac.DataError, match=r"'drive\.F' is not an input"):
        ac.linearize(system, u={"drive.F": 1.0})
    with pytest.raises(ac.DataError, match=r"^t='now' is not a time"):
        ac.linearize(system, t="now")  # type: ignore[arg-type]
    with pytest.raises(ac.DataError, match=r"^outputs: 3 is not a name"):
        ac.linearize(system, outputs=3)  # type: ignore[arg-type]
