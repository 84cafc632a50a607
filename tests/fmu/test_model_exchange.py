"""Our own models out as FMUs and in again: trajectories and gradients are those of the models themselves."""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, translational as tl
from acausal.fmu.derivatives import Differentiated
from acausal.fmu.model_exchange import Exchange
from tests.export.test_c import Chain
from tests.support.fmus import need_fmpy
from tests.support.hybrid import Ball, Braked, Sampled, Thermostat


class Mass(ac.Component):
    """A mass on a spring with a damper, pushed by a force."""

    m, c, d = ac.Parameter(1.0), ac.Parameter(400.0), ac.Parameter(2.0)
    f = ac.Input(unit="N")
    s = ac.Variable(start=0.1, fixed=True, unit="m")
    v = ac.Variable(fixed=True, unit="m/s")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(ac.der(self.s), self.v)
        yield ac.Eq(self.m * ac.der(self.v), self.f - self.d * self.v - self.c * self.s**3)


class Row(ac.Component):
    """Three lags."""

    x = ac.Variable(shape=3, start=1.0, fixed=True)

    def equations(self) -> Iterator[Any]:
        for i, x in enumerate(self.x):
            yield ac.Eq(ac.der(x), (i + 1) * (1 - x) + 1)


class Pulsed(ac.Component):
    """A lag that a pulse drives whose times are known, without events."""

    T = ac.Parameter(0.3)
    x = ac.Variable(start=0.0, fixed=True)

    def __init__(self) -> None:
        super().__init__()
        self.pulse = blocks.BooleanPulse(width=40.0, period=0.1, startTime=0.01)

    def equations(self) -> Iterator[Any]:
        push = ac.where(self.pulse.y > 0.5, 1 + ac.sin(40 * ac.time), 0.0)
        yield ac.Eq(self.T * ac.der(self.x), push - self.x)


class Started(Pulsed):
    """A pulsed lag that is switched on at an event, too."""

    begin = ac.Parameter(0.13)
    on = ac.Discrete(0.0)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.T * ac.der(self.x), self.on + ac.where(self.pulse.y > 0.5, 1, 0) - self.x)
        yield ac.When(ac.time > self.begin, ac.Eq(self.on, 1.0))


class Sticking(ac.Component):
    """A mass that a spring pulls over rough ground: it sticks and slips."""

    def __init__(self) -> None:
        super().__init__()
        self.pull, self.spring = tl.ConstantSpeed(v_fixed=0.1), tl.Spring(c=50.0)
        rest = ac.Start(0.0, fixed=True)
        self.mass = tl.Mass(m=1.0, s=rest, v=rest)
        self.ground = tl.SupportFriction(f_pos=[[0.0, 4.0]], peak=1.5)
        self.connect(self.pull.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.ground.flange_a)


class Pushed(ac.Component):
    """A mass on rough ground that a force pushes until it breaks away."""

    def __init__(self) -> None:
        super().__init__()
        self.wall, self.spring = tl.Fixed(), tl.SpringDamper(c=100.0, d=1.0)
        self.mass, self.push = tl.Mass(m=1.0), tl.Force()
        self.ground = tl.SupportFriction(f_pos=[[0.0, 2.0], [1.0, 3.0]], peak=1.3)
        self.connect(self.wall.flange, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.mass.flange_a, self.ground.flange_a)
        self.connect(self.mass.flange_b, self.push.flange)


class Driven(ac.Component):
    """A source, an FMU, and a state that integrates its output."""

    def __init__(self, path: Path, **values: Any) -> None:
        super().__init__()
        self.plant = ac.FMU(path, values)
        self.push, self.area = ac.Output(unit="N"), ac.Variable(fixed=True)
        self.connect(self.push, self.plant.f)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.push, 3 * ac.sin(20 * ac.time))
        yield ac.Eq(ac.der(self.area), self.plant.s)


class FedBack(ac.Component):
    """An output of the FMU that is one of its states, and acts back on its input."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.plant, self.gain = ac.FMU(path), blocks.Gain(k=-2.0)
        self.connect(self.plant.s, self.gain.u)
        self.connect(self.gain.y, self.plant.f)


class Several(ac.Component):
    """One FMU in three places, with values of their own."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.part = [ac.FMU(path, {"f": 1.0, "d": d}) for d in (1.0, 2.0, 3.0)]


Exported = Callable[..., Path]


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A model as an FMU; of each one a file."""
    need_fmpy()
    folder, known = tmp_path_factory.mktemp("fmus"), dict[Any, Path]()

    def export(model: type[ac.Component] | Any, fmi: str = "2.0", *arguments: Any) -> Path:
        key = model, fmi, arguments
        if key not in known:
            system = ac.compile(model(*arguments))
            outputs = [s for s in system.states if s in ("s", "h", "T")] or None
            path = folder / f"{model.__name__}{fmi[0]}.fmu"
            known[key] = ac.export.fmu(system, path, fmi=fmi, outputs=outputs)
        return known[key]

    return export


def test_an_output_that_is_a_state_is_a_signal(exported: Exported) -> None:
    system = ac.compile(FedBack(exported(Mass)))
    assert system.states == ("plant.s", "plant.v")
    field = ac.compile(Mass())
    x = jnp.array([0.1, 0.0])
    rates = system.vector_field(0.0, x, None, system.parameters())
    wanted = field.vector_field(0.0, x, jnp.array([-0.2]), field.parameters())
    np.testing.assert_allclose(rates, wanted, rtol=1e-12)


def test_only_what_is_differentiated_costs_evaluations(
    exported: Exported, monkeypatch: pytest.MonkeyPatch
) -> None:
    columns: list[int] = []
    quotient = Differentiated.quotient

    def counted(self: Differentiated, *given: Any) -> Any:
        columns.append(given[2])
        return quotient(self, *given)

    monkeypatch.setattr(Differentiated, "quotient", counted)
    system = ac.compile(FedBack(exported(Mass)))
    x, known = jnp.array([0.1, 0.3]), system.parameters()

    def rate(v: Any, params: Any) -> Any:
        return system.vector_field(0.0, jnp.stack([x[0], v]), None, params)[1]

    assert jax.grad(rate)(0.3, known) == pytest.approx(-2.0, rel=1e-12)
    assert not columns  # the parameters stay as they are
    by_d = jax.grad(lambda d: rate(0.3, known | {"plant.d": d}))(2.0)
    assert by_d == pytest.approx(-0.3, rel=1e-7)
    assert set(columns) == {5, 6, 7}


def push(t: Any) -> Any:
    return 3 * jnp.sin(20 * t)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_steps_are_those_of_the_model(exported: Exported, fmi: str) -> None:
    system = ac.compile(Driven(exported(Mass, fmi)))
    found = ac.simulate(system, 0.5, dt=1e-3)
    expected = ac.simulate(ac.compile(Mass()), 0.5, dt=1e-3, inputs={"f": push})
    np.testing.assert_allclose(found["plant.s"], expected["s"], atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    "options",
    [{"dt": 5e-3}, pytest.param({"rtol": 1e-8}, marks=pytest.mark.slow)],
    ids=["fixed", "adaptive"],
)
def test_gradients_are_those_of_the_model(exported: Exported, options: dict[str, Any]) -> None:
    native = ac.compile(Mass())
    system = ac.compile(Driven(exported(Mass), s=0.1))

    def loss(system: ac.System, params: dict[str, Any], name: str, **inputs: Any) -> Any:
        run = ac.simulate(system, 0.2, saveat=[0.1, 0.2], params=params, **inputs, **options)
        return jnp.sum(run[name] ** 2)

    at = {"m": 1.1, "c": 390.0, "d": 1.9}
    expected = jax.grad(lambda p: loss(native, p, "s", inputs={"f": push}))(at)
    given = {f"plant.{n}": v for n, v in at.items()}
    found = jax.grad(lambda p: loss(system, p, "plant.s"))(given | {"plant.s.start": 0.1})
    for name, value in expected.items():
        np.testing.assert_allclose(found[f"plant.{name}"], value, rtol=2e-6)
    assert abs(found["plant.s.start"]) > 1e-3


@pytest.mark.slow
def test_start_values_are_parameters(exported: Exported) -> None:
    system = ac.compile(ac.FMU(exported(Ball), {"h": 2.0}))
    for h in (2.0, 1.5):
        run = ac.simulate(system, 0.1, dt=0.05, params={"h.start": h})
        np.testing.assert_allclose(run["h"][-1], h - 9.81 * 0.005, rtol=1e-12)


def test_an_input_without_a_source_is_the_start_value(exported: Exported) -> None:
    alone, given = (ac.compile(ac.FMU(exported(Mass), v)) for v in ({}, {"f": 0.0}))
    assert alone.input_defaults == {"f": 0.0}  # as our exports have it
    expected = ac.simulate(given, 0.1, dt=1e-2)["s"]
    np.testing.assert_array_equal(ac.simulate(alone, 0.1, dt=1e-2)["s"], expected)
    record = ac.Data(np.linspace(0, 0.1, 11), {"s": expected})
    with pytest.warns(UserWarning, match="The data lack 'f': 'f' is 0 throughout, the start value"):
        again = ac.simulate(alone, 0.1, dt=1e-2, inputs=record)
    np.testing.assert_array_equal(again["s"], expected)


def test_starts_of_states_are_guesses_that_x0_and_rest_replace(exported: Exported) -> None:
    system = ac.compile(ac.FMU(exported(Mass), {"f": 3.2, "s": 0.3}))
    assert system.initial_state()[0] == 0.3
    assert system.initial_state(x0={"v": 1.0}).tolist() == [0.3, 1.0]
    at_rest = system.initial_state(steady=True)
    np.testing.assert_allclose(at_rest, [(3.2 / 400) ** (1 / 3), 0.0], atol=1e-9)


@pytest.mark.slow
@pytest.mark.cases(fast=1)
@pytest.mark.parametrize(
    ("model", "end", "name"),
    [(Ball, 2.4, "h"), (Thermostat, 12.0, "T"), (Sampled, 1.0, None), (Braked, 3.0, None)],
)
def test_events_are_those_of_the_model(
    exported: Exported, model: type[ac.Component], end: float, name: str | None
) -> None:
    native, system = ac.compile(model()), ac.compile(ac.FMU(exported(model)))
    name = name or native.states[0]
    inputs = dict.fromkeys(native.inputs, 0.5)
    options: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11, "saveat": np.linspace(0, end, 8)}
    expected = ac.simulate(native, end, inputs=inputs, **options)
    found = ac.simulate(system, end, inputs=inputs, **options)
    np.testing.assert_allclose(found[name], expected[name], atol=1e-9)
    assert len(found.events) >= 2


@pytest.mark.slow
def test_a_gradient_through_what_an_fmu_samples_and_keeps_is_warned_of(tmp_path: Path) -> None:
    path = ac.export.fmu(ac.compile(Sampled()), tmp_path / "sampled.fmu", outputs=["x"])
    for options in ({}, {"open_loop": True}):
        system = ac.compile(ac.FMU(path, **options))

        def end(x: Any, system: ac.System = system) -> Any:
            return ac.simulate(system, 0.25, dt=0.05, x0={"x": x})["x"][-1]

        if options:
            jax.grad(end)(0.0)
        else:
            with pytest.warns(UserWarning, match="The gradient is wrong: .* samples a number"):
                jax.grad(end)(0.0)


@pytest.mark.slow
def test_an_element_of_a_state_may_be_an_output(tmp_path: Path) -> None:
    system = ac.compile(Row())
    ac.export.fmu(system, tmp_path / "row.fmu", fmi="3.0", outputs=["x[3]"])
    again = ac.compile(ac.FMU(tmp_path / "row.fmu"))
    one, other = (ac.simulate(s, 1.0, dt=0.01)["x[3]"] for s in (system, again))
    np.testing.assert_allclose(other, one, atol=1e-12)


@pytest.mark.slow
def test_gradients_go_through_events(exported: Exported) -> None:
    native, system = ac.compile(Ball()), ac.compile(ac.FMU(exported(Ball)))

    def loss(system: ac.System, e: Any) -> Any:
        run = ac.simulate(system, 1.4, saveat=[0.7, 1.4], params={"e": e}, rtol=1e-10, atol=1e-12)
        return jnp.sum(run["h"] ** 2)

    found, expected = (jax.grad(lambda e, s=s: loss(s, e))(0.8) for s in (system, native))
    np.testing.assert_allclose(found, expected, rtol=1e-6)


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize("model", [Pulsed, Started])
def test_gradients_move_events_whose_time_is_known(
    exported: Exported, model: type[ac.Component]
) -> None:
    at = {"pulse.startTime": 0.01, "pulse.period": 0.1, "pulse.width": 40.0}
    expected, waves = dict.fromkeys(at, 0.0), 40.0 if model is Pulsed else 0.0
    for share in (0, 0.4, 1, 1.4):  # of edges, in periods; one up that comes later leaves less
        edge = 0.01 + 0.1 * share
        left = (1 + np.sin(waves * edge)) / 0.3 * np.exp(-(0.2 - edge) / 0.3)
        left *= 1 if share % 1 else -1
        expected["pulse.startTime"] += left
        expected["pulse.period"] += left * share
        expected["pulse.width"] += left * 0.1 / 100 if share % 1 else 0
    if model is Started:
        at["begin"], expected["begin"] = 0.13, -np.exp(-(0.2 - 0.13) / 0.3) / 0.3
    system = ac.compile(ac.FMU(exported(model)))
    found = jax.grad(lambda p: ac.simulate(system, 0.2, dt=0.01, params=p)["x"][-1])(at)
    for name, slope in expected.items():
        np.testing.assert_allclose(found[name], slope, rtol=2e-5, err_msg=name)


@pytest.mark.machines
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_indicators_whose_meaning_changes_with_the_mode_are_no_further_events(
    exported: Exported, fmi: str
) -> None:
    native, system = ac.compile(Sticking()), ac.compile(ac.FMU(exported(Sticking, fmi)))
    expected, found = (ac.simulate(s, 2.0, rtol=1e-8, atol=1e-10) for s in (native, system))
    np.testing.assert_allclose(found["mass.s"][-1], expected["mass.s"][-1], atol=1e-9)
    assert len(found.events) <= len(expected.events) + 1


@pytest.mark.slow
@pytest.mark.cases(fast=1)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_an_event_that_an_input_makes_happens_in_the_fmu(exported: Exported, fmi: str) -> None:
    """At the instant the force is as great as what holds the mass, but for rounding."""
    native, system = ac.compile(Pushed()), ac.compile(ac.FMU(exported(Pushed, fmi)))
    t = np.arange(0, 1.001, 0.01)
    inputs = {"push.f": (t, 12 * np.sin(3 * t) + 5 * np.sin(8 * t))}
    for end in (t[-1], 0.4, 0.7):  # where steps end differs with it, by rounding
        expected, found = (ac.simulate(s, end, inputs=inputs) for s in (native, system))
        assert len(found.events) == len(expected.events)
        assert float(found["mass.s"][-1]) == pytest.approx(float(expected["mass.s"][-1]), rel=1e-6)
    assert float(expected["mass.s"][-1]) > 0.04


@pytest.mark.slow
def test_instances_go_back_to_states_that_they_had(
    exported: Exported, monkeypatch: pytest.MonkeyPatch
) -> None:
    times: list[float] = []
    happen = Exchange.happen

    def counted(self: Exchange, time: float, inputs: int) -> Any:
        times.append(time)
        return happen(self, time, inputs)

    monkeypatch.setattr(Exchange, "happen", counted)
    system = ac.compile(ac.FMU(exported(Mass), {"f": 1.0}, step=0.01))  # an event each
    last = lambda d: ac.simulate(system, 0.2, dt=0.01, params={"d": d})["s"][-1]  # noqa: E731
    found = float(jax.grad(last)(2.0))
    assert (
        len(times) < 12 * 20
    )  # five instances go there, and back; else each goes there again from the start
    np.testing.assert_allclose(found, (last(2.001) - last(1.999)) / 2e-3, rtol=1e-5)


@pytest.mark.slow
def test_arrays_of_fmi_3_are_arrays(exported: Exported) -> None:
    start = [0.02, -0.01, 0.03, 0.01]
    arrays = ac.FMU(exported(Chain, "3.0", 4), {"mass.s": start, "leg.c": [90.0, 95, 100, 105]})
    assert len(arrays["leg.c"]) == 4
    model = Chain(4)
    for leg, c in zip(model.leg, (90.0, 95, 100, 105), strict=True):
        leg.modify(c=c)
    native, system = ac.compile(model), ac.compile(arrays)
    x0 = {f"mass[{i}].s": s for i, s in enumerate(start, 1)}
    expected = ac.simulate(native, 0.1, dt=1e-2, x0=x0)
    found = ac.simulate(system, 0.1, dt=1e-2)
    for i in range(1, 5):
        np.testing.assert_allclose(found[f"mass.s[{i}]"], expected[f"mass[{i}].s"], atol=1e-12)


@pytest.mark.slow
def test_equal_fmus_share_calls_and_a_pickled_system_loads_its_own(exported: Exported) -> None:
    system = ac.compile(Several(exported(Mass)))
    run = ac.simulate(system, 0.1, dt=1e-2)
    again = ac.simulate(pickle.loads(pickle.dumps(system)), 0.1, dt=1e-2)
    alone = ac.compile(ac.FMU(exported(Mass), {"f": 1.0}))
    for i, d in enumerate((1.0, 2.0, 3.0), 1):
        expected = ac.simulate(alone, 0.1, dt=1e-2, params={"d": d})["s"]
        np.testing.assert_allclose(run[f"part[{i}].s"], expected, atol=1e-13)
        np.testing.assert_array_equal(run[f"part[{i}].s"], again[f"part[{i}].s"])


@pytest.mark.slow
def test_lanes_have_instances_of_their_own(exported: Exported) -> None:
    system = ac.compile(ac.FMU(exported(Mass), {"f": 1.0}))
    last = lambda d: ac.simulate(system, 0.1, dt=1e-2, params={"d": d})["s"][-1]  # noqa: E731
    each = jnp.asarray([1.0, 2.0, 3.0])
    np.testing.assert_allclose(jax.vmap(last)(each), [last(d) for d in each.tolist()], rtol=1e-13)
    single = ac.simulate(system, 0.1, dt=1e-2, dtype=np.float32)["s"][-1]
    np.testing.assert_allclose(single, last(2.0), rtol=1e-5)


def test_a_model_with_an_fmu_is_not_exported(exported: Exported, tmp_path: Path) -> None:
    system = ac.compile(Driven(exported(Mass)))
    for write in (ac.export.fmu, ac.export.c, ac.export.onnx, ac.export.modelica):
        with pytest.raises(ac.ExportError, match="'plant' is an FMU, whose equations nobody knows"):
            write(system, tmp_path / "model.fmu")


def test_a_file_names_an_fmu_only_where_native_code_is_allowed(exported: Exported) -> None:
    path = exported(Mass)
    given = {"path": f'"{path.name}"', "values": {"f": 3.2}, "d": 2.5}
    file = path.with_suffix(".json")  # paths are relative to it
    part = {"class": "acausal.components.FMU", "with": given}
    file.write_text(json.dumps({"components": {"plant": part}}))
    with pytest.raises(ac.ModelError, match=r"components\.plant: .* load the model with allow_nat"):
        ac.load(file)
    with pytest.raises(ac.ModelError, match="load: allow_native='no'; give True or False"):
        ac.load(file, allow_native="no")  # pyright: ignore[reportArgumentType]
    known = ac.compile(ac.load(file, allow_native=True)).parameters()
    assert (known["plant.f"], known["plant.d"]) == (3.2, 2.5)


@pytest.mark.slow
def test_the_command_line_takes_an_fmu(
    exported: Exported, capsys: pytest.CaptureFixture[str]
) -> None:
    from acausal.command import main

    assert main(["show", str(exported(Mass)), "--only", "parameters"]) == 0
    assert "400" in capsys.readouterr().out
