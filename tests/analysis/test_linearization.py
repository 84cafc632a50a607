"""Linearization against what is known in closed form."""

import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el, translational as tl
from tests.support.counted import compilations
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


def test_its_matrices_are_one_program_at_all_points() -> None:
    system = ac.compile(Oscillator())
    with compilations() as found:
        for t, x in ((0.0, [0.0, 0.0]), (1.5, [0.1, 0.2])):
            ac.linearize(system, x, outputs=["mass.s"], t=t)
    assert found.count("jit(_matrices)") == 1
    assert len(found) < 6


def test_eigenvalues_and_damping(linearized: ac.Linearization) -> None:
    expected = -1 + 1j * np.sqrt(99) * np.array([-1, 1])
    np.testing.assert_allclose(linearized.eigenvalues(), expected)
    np.testing.assert_allclose(linearized.damping(), [0.1, 0.1])
    assert "mode -1 ± 9.95j: 1.592 Hz, damping 0.1\n  A = [[   0.    1.]" in repr(linearized)
    view = linearized._repr_html_()
    assert "1.592 Hz" in view
    assert view.count("<table>") == 4


def test_no_zero_has_a_sign_in_print() -> None:
    A, nothing = np.array([[-0.0, 1.0], [-1.0, -0.0]]), np.zeros((0, 0))
    none = np.zeros((2, 0))
    undamped = ac.Linearization(
        A, none, none.T, nothing, ("x", "v"), (), (), x=np.zeros(2), u=np.zeros(0)
    )
    assert "-0" not in repr(undamped)


def test_real_eigenvalues_are_complex_numbers_too() -> None:
    values = np.diag([-3.0, -2.0])
    row = np.zeros((1, 2))
    overdamped = ac.Linearization(
        values, row.T, row, np.zeros((1, 1)), ("a", "b"), ("u",), ("y",), row[0], np.zeros(1)
    )
    assert overdamped.eigenvalues().dtype == complex
    assert "mode -2: time constant 0.5 s\n  mode -3" in repr(overdamped)


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
        ac.linearize(system, inputs={"drive.F": 1.0})
    with pytest.raises(ac.DataError, match=r"^t='now' is not a time"):
        ac.linearize(system, t="now")  # type: ignore[arg-type]
    with pytest.raises(ac.DataError, match=r"^outputs: 3 is not a name"):
        ac.linearize(system, outputs=3)  # type: ignore[arg-type]


# -- one vocabulary --------------------------------------------------------------------------------


def test_inputs_are_functions_of_time_or_an_array() -> None:
    system = ac.compile(Oscillator())
    by_name = ac.linearize(system, inputs={"drive.f": lambda t: 2.0 * t}, t=1.5)
    np.testing.assert_array_equal(by_name.u, ac.linearize(system, inputs=[3.0], t=1.5).u)


@pytest.mark.slow
def test_a_model_is_linearized_at_rest() -> None:
    system = ac.compile(Oscillator())
    linear = ac.linearize(system, "steady", inputs={"drive.f": 10.0})
    np.testing.assert_allclose(linear.x, [0.1, 0.0], atol=1e-12)
    point = ac.operating_point(system, inputs={"drive.f": 10.0})
    np.testing.assert_allclose(ac.linearize(system, point).x, linear.x, atol=1e-12)
    np.testing.assert_allclose(ac.linearize(system, point).u, [10.0])


# -- responses -------------------------------------------------------------------------------------


def test_the_step_response_is_that_of_the_oscillator(linearized: ac.Linearization) -> None:
    t, y = linearized.step_response(5.0)
    w, decay = np.sqrt(99), np.exp(-t)
    expected = (1 - decay * (np.cos(w * t) + np.sin(w * t) / w)) / 100
    np.testing.assert_allclose(y[:, 0, 0], expected, atol=1e-13)
    assert y[0, 1, 0] == pytest.approx(1.0)  # a force accelerates at once
    settled, _ = linearized.step_response()
    assert settled[-1] == pytest.approx(7.0)
    for wrong in ([0.0, 1.0, 1.5], "long", -1.0, [1.0, 2.0]):
        with pytest.raises(ac.DataError, match="are not times"):
            linearized.step_response(wrong)  # pyright: ignore[reportArgumentType]


def test_bode_nyquist_and_step_draw(linearized: ac.Linearization) -> None:
    plt = pytest.importorskip("matplotlib.pyplot")
    try:
        upper, lower = linearized.bode().axes
        omega, decibels = upper.lines[0].get_data()
        assert 9.9 < omega[np.argmax(decibels)] < 10.0
        assert decibels[0] == pytest.approx(-40, abs=0.1)  # 1/c
        assert lower.lines[0].get_ydata()[-1] == pytest.approx(-180, abs=2)
        assert [text.get_text() for text in upper.get_legend().get_texts()] == ["mass.s", "mass.a"]
        figure, axes = plt.subplots(2)
        assert linearized.bode([1.0, 10.0], axes=axes) is figure
        (ax,) = linearized.nyquist().axes
        assert len(ax.lines) == 2 * 2 + 3
        upper, lower = linearized.step(3.0).axes
        assert upper.lines[0].get_xdata()[-1] == 3.0
        assert (upper.get_ylabel(), lower.get_ylabel()) == ("mass.s", "mass.a")
        with pytest.raises(ac.DataError, match="there are 1; give 2, for outputs"):
            linearized.step(axes=[upper])
    finally:
        plt.close("all")


def test_without_outputs_there_is_nothing_to_draw() -> None:
    with pytest.raises(ac.DataError, match=r"no outputs; give linearize"):
        ac.linearize(ac.compile(Oscillator())).bode()
    with pytest.raises(ac.DataError, match=r"no inputs; the model has none"):
        ac.linearize(plain_undriven(), outputs="mass.s").step()


def plain_undriven() -> ac.System:
    class Undriven(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.wall, self.spring, self.mass = tl.Fixed(), tl.Spring(c=1.0), tl.Mass(m=1.0)
            self.connect(self.wall.flange, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.mass.flange_a)

    return ac.compile(Undriven())


def test_python_control_takes_it(linearized: ac.Linearization) -> None:
    pytest.importorskip("control", reason="python-control is not installed")
    model = linearized.to_control()
    assert model.output_labels == ["mass_s", "mass_a"]
    assert model.state_labels == ["mass_s", "mass_v"]
    np.testing.assert_allclose(model(10j)[:, 0], linearized.frequency_response(10.0)[0, :, 0])


def test_gains_are_those_of_python_control(linearized: ac.Linearization) -> None:
    control = pytest.importorskip("control")
    gain = linearized.lqr({"mass.s": 50.0}, {"drive.f": 0.1})
    wanted, _, _ = control.lqr(linearized.A, linearized.B, np.diag([50.0, 0.0]), [[0.1]])
    np.testing.assert_allclose(gain, wanted, rtol=1e-8)
    gain = linearized.kalman({"mass.v": 0.3}, {"mass.s": 0.01, "mass.a": 0.2})
    noise = np.diag([1e-4, 0.04])
    wanted, _, _ = control.lqe(linearized.A, np.eye(2), linearized.C, np.diag([0, 0.09]), noise)
    np.testing.assert_allclose(gain, wanted, rtol=1e-8)


def test_wrong_weights_are_refused(linearized: ac.Linearization) -> None:
    with pytest.raises(ac.DataError, match="states: 'mass' is not in the linearization"):
        linearized.lqr({"mass": 1.0}, {"drive.f": 1.0})
    with pytest.raises(ac.DataError, match=r"inputs: give a number above zero for 'drive\.f'"):
        linearized.lqr({"mass.s": 1.0}, {})
    with pytest.raises(ac.DataError, match=r"sensors: 'mass\.s' is -1\.0"):
        linearized.kalman({"mass.v": 1.0}, {"mass.s": -1.0})


@pytest.mark.slow
@pytest.mark.parametrize("closed", [0.0, 1.0])
def test_a_switch_is_as_its_input_says(closed: float) -> None:
    circuit = ac.Component()
    circuit.ground, circuit.source = el.Ground(), el.ConstantVoltage(V=10.0)
    circuit.switch, circuit.r, circuit.l = (
        el.IdealClosingSwitch(),
        el.Resistor(R=10),
        el.Inductor(L=1),
    )
    circuit.connect(circuit.ground.p, circuit.source.n, circuit.l.n)
    circuit.connect(circuit.source.p, circuit.switch.p)
    circuit.connect(circuit.switch.n, circuit.r.p)
    circuit.connect(circuit.r.n, circuit.l.p)
    system, inputs = ac.compile(circuit), {"switch.control": closed}
    resistance = 10 + (1e-5 if closed else 1e5)
    at = ac.linearize(system, {"l.i": 1.0}, inputs, outputs=["l.v"])
    np.testing.assert_allclose(at.A, [[-resistance]])
    np.testing.assert_allclose(at.C, [[-resistance]])
    resting = ac.linearize(system, "steady", inputs)
    np.testing.assert_allclose(resting.x, [10 / resistance])
    np.testing.assert_allclose(resting.A, [[-resistance]])
    given = 0.0, [1.0], [closed], system.parameters()
    np.testing.assert_allclose(system.vector_field(*given), [10 - resistance])
    np.testing.assert_allclose(system.observe("l.v", *given), 10 - resistance)


def test_the_response_to_a_differentiated_input_has_its_derivatives() -> None:
    class Base(ac.Component):
        """A mass on a spring on a base whose position is given."""

        def __init__(self) -> None:
            super().__init__()
            self.base, self.foot = tl.Position(exact=True), tl.Mass(m=1.5)
            self.spring, self.mass = tl.SpringDamper(c=40.0, d=2.0), tl.Mass(m=2.0)
            self.connect(self.base.flange, self.foot.flange_a)
            self.connect(self.foot.flange_b, self.spring.flange_a)
            self.connect(self.spring.flange_b, self.mass.flange_a)

    linear = ac.linearize(ac.compile(Base()), outputs=["mass.s", "foot.a"])
    omega = np.array([0.5, 2.0, 4.0, 10.0])
    s = 1j * omega
    given = linear.inputs.index("base.s_ref")
    response = linear.frequency_response(omega)[:, :, given]
    np.testing.assert_allclose(response[:, 0], (2 * s + 40) / (2 * s**2 + 2 * s + 40), rtol=1e-9)
    np.testing.assert_allclose(response[:, 1], s**2, rtol=1e-9)
    with pytest.warns(UserWarning, match=r"der\(base\.s_ref\)', .* only at its instant"):
        linear.step_response(1.0)


def test_the_name_of_an_array_stands_for_its_elements() -> None:
    class Two(ac.Component):
        x = ac.Variable(shape=2, start=0.0)
        u = ac.Input()

        def equations(self):
            yield ac.Eq(ac.der(self.x), -np.array([1.0, 2.0]) * self.x + self.u)

    linear = ac.linearize(ac.compile(Two()), outputs=["x", "u"])
    assert linear.outputs == ("x[1]", "x[2]", "u")


class Draining(ac.Component):
    """A tank whose outlet gives no derivative where it is empty."""

    area = ac.Parameter(2.0)
    h = ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(self.area * ac.der(self.h), -ac.sqrt(self.h))


def test_a_point_without_derivatives_is_refused() -> None:
    system = ac.compile(Draining())
    assert np.isfinite(ac.linearize(system, {"h": 1.0}).A).all()
    with pytest.raises(ac.DataError, match=r"derivative of 'der\(h\)' by 'h' is -inf .*x="):
        ac.linearize(system)
    with pytest.raises(ac.DataError, match=r"linearize: 'der\(h\)' = .* is -inf: a division by"):
        ac.linearize(system, {"h": 1.0}, params={"area": 0.0})
