"""Records with discrete inputs, and with modes that are given instead of simulated."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import electrical as el
from tests.support.hybrid import Ball, Thermostat

ENDS = (0.0, 6.0)
TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-12}


@pytest.fixture(scope="module")
def run() -> tuple[ac.Solution, tuple[np.ndarray, np.ndarray]]:
    """A run of the thermostat, and its modes with the instants at which they change."""
    system = ac.compile(Thermostat())
    times = np.linspace(*ENDS, 61)
    sol = ac.simulate(system, ENDS, saveat=times, **TIGHT)
    instants = np.array([0.0, *(e.t for e in sol.events), 6.0])
    modes = ac.simulate(system, ENDS, saveat=instants, **TIGHT)["on"]
    return sol, (instants, np.asarray(modes))


@pytest.fixture(scope="module")
def driven() -> ac.System:
    return ac.compile(Thermostat(), inputs=["on"])


@pytest.mark.slow
def test_a_given_mode_is_an_input_and_needs_no_events(
    driven: ac.System, run: tuple[ac.Solution, tuple[np.ndarray, np.ndarray]]
) -> None:
    sol, on = run
    assert driven.inputs == ("on",)
    assert driven.held_inputs == {"on"}
    assert driven.events is None
    assert driven.variables == ("T", "on")
    again = ac.simulate(driven, ENDS, saveat=sol.t, inputs={"on": on}, **TIGHT)
    np.testing.assert_allclose(again["T"], sol["T"], rtol=1e-9)


@pytest.mark.slow
def test_a_training_takes_the_measured_mode(
    driven: ac.System, run: tuple[ac.Solution, tuple[np.ndarray, np.ndarray]]
) -> None:
    sol, on = run
    data = ac.Data(signals={"T": (np.asarray(sol.t), np.asarray(sol["T"])), "on": on})
    fit = ac.fit(
        driven,
        data,
        targets=["T"],
        params={"C": 8.0, "G": 1.2},
        modifiers={"C": ac.Bounded(1, 100), "G": ac.Bounded(0.1, 10)},
        strategy="gauss_newton",
        solver="rk4",
        dt=0.1,
        epochs=20,
    )
    assert fit.params["C"] == pytest.approx(10.0, rel=1e-6)
    assert fit.params["G"] == pytest.approx(1.0, rel=1e-6)


@pytest.mark.slow
def test_conditions_that_others_need_stay() -> None:
    class Both(Thermostat):
        n = ac.Discrete(0, kind="int")

        def equations(self) -> Iterator[Any]:
            yield from super().equations()
            yield ac.When(self.high < self.T, ac.Eq(self.n, ac.pre(self.n) + 1))

    system = ac.compile(Both(), inputs=["on"])
    sol = ac.simulate(system, (0.0, 6.0), inputs={"on": 1.0}, saveat=[6.0])
    assert sol["n"][-1] == 1
    assert [e.condition for e in sol.events] == ["high < T"]


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (
            ["T"],
            "'T' is not a discrete variable that an equation of the model gives: known are 'on'",
        ),
        ("on", r"give a list: inputs=\['on'\]"),
    ],
)
def test_only_discrete_variables_are_given(names: Any, message: str) -> None:
    with pytest.raises(ac.ModelError, match=message):
        ac.compile(Thermostat(), inputs=names)


def test_an_input_is_not_given_again() -> None:
    class Driven(ac.Component):
        u = ac.Input()
        x = ac.Variable()

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), self.u)

    with pytest.raises(ac.ModelError, match="'u' is an input already; leave it out"):
        ac.compile(Driven(), inputs=["u"])


def test_a_mode_alone_is_no_target() -> None:
    ts = np.linspace(0.0, 1.0, 11)
    data = ac.Data(ts, {"n": np.floor(2 * ts), "h": 1 - ts, "v": -ts})
    with pytest.raises(ac.TrainingError, match="'n': what changes at events only"):
        ac.fit(ac.compile(Ball()), data, targets=["n"], modifiers=["e"])


@pytest.mark.slow
def test_sequences_that_do_not_know_the_mode_are_warned_of(
    run: tuple[ac.Solution, tuple[np.ndarray, np.ndarray]],
) -> None:
    sol, _ = run
    data = ac.Data(sol.t, {"T": sol["T"]})
    options: dict[str, Any] = {"sequence_length": 1.0, "solver": "rk4", "epochs": 1}
    with pytest.warns(UserWarning, match="start values of 'on', whatever they are in the record"):
        ac.fit(ac.compile(Thermostat()), data, targets=["T"], modifiers=["C"], **options)


class Charged(ac.Component):
    """A capacitor that a switch connects to a source; the switch's signal stays open."""

    def __init__(self) -> None:
        super().__init__()
        self.source, self.ground = el.ConstantVoltage(V=10.0), el.Ground()
        self.switch, self.resistor = el.IdealClosingSwitch(Goff=1e-9), el.Resistor(R=2.0)
        self.capacitor = el.Capacitor(C=0.5, v=ac.Start(0.0, fixed=True))
        self.connect(self.source.p, self.switch.p)
        self.connect(self.switch.n, self.resistor.p)
        self.connect(self.resistor.n, self.capacitor.p)
        self.connect(self.capacitor.n, self.source.n)
        self.connect(self.source.n, self.ground.p)


@pytest.mark.machines
def test_a_switching_signal_is_held_from_sample_to_sample() -> None:
    system = ac.compile(Charged())
    assert system.held_inputs == {"switch.control"}
    ts = np.linspace(0.0, 2.0, 21)
    control = np.where((ts > 0.45) & (ts < 1.15), 1.0, 0.0)  # closed from 0.5 to 1.2 s
    charging = np.clip(ts - 0.5, 0.0, 0.7)
    data = ac.Data(ts, {"switch.control": control, "capacitor.v": 10 * (1 - np.exp(-charging))})
    sol = ac.simulate(system, (0.0, 2.0), inputs=data, saveat=ts, **TIGHT)
    np.testing.assert_allclose(sol["capacitor.v"], data["capacitor.v"], atol=1e-4)
    fit = ac.fit(
        system,
        data,
        targets=["capacitor.v"],
        params={"resistor.R": 1.8},
        modifiers=["resistor.R"],
        strategy="gauss_newton",
        solver="rk4",
        epochs=10,
    )
    assert fit.params["resistor.R"] == pytest.approx(2.0, rel=1e-4)
