"""The history of a training counts events, and says where their number changed."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import Thermostat

ENDS = {"short": 3.0, "long": 6.0}
C, START = 10.0, 12.0


@pytest.fixture(scope="module")
def fit() -> ac.Fit:
    system = ac.compile(Thermostat())
    records: dict[str, ac.Data] = {}
    for name, end in ENDS.items():
        ts = np.arange(round(10 * end) + 1) / 10
        sol = ac.simulate(system, (0.0, end), saveat=ts, rtol=1e-9, atol=1e-11)
        records[name] = ac.Data(ts, {"T": np.asarray(sol["T"])})
    return ac.fit(
        system,
        records,
        targets=["T"],
        params={"C": START},
        modifiers=["C"],
        strategy="gauss_newton",
        solver="rk4",
        epochs=15,
        evaluate_every=1,
    )


def events(end: float, c: float) -> int:
    """How often the thermostat's conditions change up to a time."""
    system = ac.compile(Thermostat())
    params = {**system.parameters(), "C": c}
    return len(ac.simulate(system, (0.0, end), params=params, dt=0.1, solver="rk4").events)


@pytest.mark.slow
def test_events_are_counted_in_every_record(fit: ac.Fit) -> None:
    assert fit.params["C"] == pytest.approx(C, rel=1e-4)
    assert list(fit.history.events) == list(ENDS)
    for name, end in ENDS.items():
        counts = fit.history.events[name]
        assert len(counts) == len(fit.history.full_loss)
        assert counts[0] == events(end, START)
        assert counts[-1] == events(end, C)


@pytest.mark.slow
def test_a_change_of_their_number_is_said(fit: ac.Fit) -> None:
    changes = [c for c in fit.history.event_changes if c.record == "long"]
    counts = fit.history.events["long"]
    assert len(changes) == np.count_nonzero(np.diff(counts)) > 0
    first = changes[0]
    assert (first.before, first.events) == (counts[first.since], counts[first.epoch])
    expected = f"'long' has {first.events} events instead of {first.before}"
    assert str(first) == f"epochs {first.since} to {first.epoch}: {expected}"


def test_a_model_without_events_has_none() -> None:
    class Lag(ac.Component):
        k = ac.Parameter(0.8)
        x = ac.Variable(start=1.0, fixed=True)

        def equations(self) -> Iterator[Any]:
            yield ac.Eq(ac.der(self.x), -self.k * self.x)

    ts = np.linspace(0.0, 1.0, 11)
    data = ac.Data(ts, {"x": np.exp(-ts)})
    fit = ac.fit(
        ac.compile(Lag()), data, targets=["x"], modifiers=["k"], strategy="sequences", epochs=1
    )
    assert fit.history.events == {}
    assert fit.history.event_changes == ()
