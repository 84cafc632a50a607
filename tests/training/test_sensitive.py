"""A model that is too sensitive to follow a whole record is trained on pieces of it."""

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.training.auto.odd_records import odd_records
from acausal.training.auto.sensitive import in_pieces
from acausal.training.record_fit import RecordFit
from tests.support.slow import some_slow


class Pendulum(ac.Component):
    """It turns over, and where it does so depends on everything before."""

    g, d = ac.Parameter(9.81), ac.Parameter(0.4)

    def __init__(self) -> None:
        super().__init__()
        self.push = ac.Input()
        self.phi, self.w = ac.Variable(start=0.0), ac.Variable(start=0.0)

    def equations(self):
        yield ac.Eq(ac.der(self.phi), self.w)
        yield ac.Eq(ac.der(self.w), self.push - self.g * ac.sin(self.phi) - self.d * self.w)


@cache
def pendulum() -> ac.System:
    return ac.compile(Pendulum())


@cache
def record() -> ac.Data:
    t = np.linspace(0, 30, 1501)
    push = 9 * np.sin(2.1 * t) + 4 * np.sin(3.7 * t + 1)
    true = ac.simulate(pendulum(), (0, 30), saveat=t, rtol=1e-9, inputs={"push": (t, push)})
    rng = np.random.default_rng(0)
    measured = {
        n: true[n] + 0.01 * np.std(true[n]) * rng.standard_normal(len(t)) for n in ("phi", "w")
    }
    return ac.Data(t, {"push": push, **measured})


@pytest.mark.parametrize("measured", some_slow(["phi", "phi w"], ["phi w"], ["phi"]))
def test_a_chaotic_record_is_followed_in_pieces(measured: str) -> None:
    data = ac.Data(record().time, {n: record()[n] for n in ("push", *measured.split())})
    wrong = {"g": 8.0, "d": 0.6}
    fit = ac.fit(
        pendulum(), data, "phi", modifiers=["g", "d"], params=wrong, epochs=20, progress=False
    )
    assert fit.params["g"] == pytest.approx(9.81, rel=0.02)
    assert fit.params["d"] == pytest.approx(0.4, rel=0.1)
    assert fit.pieces == len(fit.records) > 4
    assert f"followed in {fit.pieces} pieces" in str(fit)
    assert "explains the record down to its noise" in str(fit)


def test_pieces_begin_where_states_are_measured_and_hold_all_else() -> None:
    t = np.arange(400) * 0.1
    x = np.where((t >= 10) & (t < 10.45), np.nan, np.sin(t))
    data = {
        "day": ac.Data(t, {"x": x, "u": np.cos(t)}, missing="nan"),
        "short": ac.Data(t[:50], {"x": x[:50], "u": 0 * t[:50]}),
    }
    pieces = in_pieces(data, 10.0, ("x",))
    assert pieces is not None
    assert list(pieces) == [
        "day from 0 s",
        "day from 10.5 s",
        "day from 20 s",
        "day from 30 s",
        "short",
    ]
    assert sum(len(p) for p in pieces.values()) == 450 - 5
    assert all(np.isfinite(p["x"][0]) for p in pieces.values())
    assert in_pieces(data, 50.0, ("x",)) is None


def left_of(pieces: int, **errors: float) -> list[str]:
    """What is said of records, or of three pieces of each, of which the last leaves so much."""
    t, fits = np.linspace(0, 1, 50), dict[str, RecordFit]()
    for record, size in errors.items():
        for start, much in ((0, 0.1), (1, 0.1), (2, size)):
            name = f"{record} from {start} s" if pieces else f"{record}{start}"
            off = much * np.sin(5 * t)[:, None]
            fits[name] = RecordFit(
                name, ("x",), t + start, off, 0 * off, {}, np.ones(1), {}, {}, {}
            )
    fit: Any = SimpleNamespace(pieces=pieces, records=fits)
    return list(odd_records(fit))


def test_a_record_is_odd_among_records_and_not_a_piece_among_pieces() -> None:
    assert not left_of(3, record=0.4)
    assert left_of(0, record=0.4)[0].startswith("Of 'record2' it leaves")
    assert not left_of(6, a=0.3, b=0.3)
    assert left_of(6, a=0.1, b=0.9)[0].startswith("Of 'b' it leaves")
