"""Equations of a file with events: read, written again, and refused in one sentence."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid import GRAVITY, ball_height, sampled_end

Write = Callable[[dict[str, Any]], Path]

BALL: dict[str, Any] = {
    "model": "Ball",
    "parameters": {"e": 0.8, "g": GRAVITY},
    "variables": {
        "h": {"start": 1.0, "fixed": True, "unit": "m"},
        "v": {"start": 0.0, "fixed": True, "unit": "m/s", "stateSelect": "always"},
        "n": {"discrete": "int"},
    },
    "equations": [
        "der(h) = v",
        "der(v) = -9.81",
        "when h < 0 then reinit(v, -e*pre(v)); n = pre(n) + 1; end when",
    ],
}
RELAYS: dict[str, Any] = {
    "parameters": {"low": 0.2, "high": 0.8, "period": 0.1, "k": 2.0, "far": 3.0},
    "variables": {
        "x": {"start": 0.0, "fixed": True},
        "y": {"start": 0.0, "fixed": True},
        "u": {"discrete": "real"},
        "on": {"discrete": "bool", "start": 1},
        "turns": {"discrete": "int"},
        "first": {"discrete": "real", "start": -1},
        "mode": {"discrete": "int"},
    },
    "equations": [
        "der(x) = if on then 1 else -1",
        "on = x < low or pre(on) and x < high",
        "when change(on) then turns = pre(turns) + 1; end when;",
        "der(y) = u - y",
        "when sample(0, period) then u = k*(1 - y) end when",
        "when initial() then first = time + 7; end when",
        "when {not on, x > far} then mode = 1; elsewhen edge(on) then mode = 2; end when",
    ],
}


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def written(document: dict[str, Any]) -> Path:
        path = tmp_path / "model.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    return written


@pytest.mark.slow
def test_a_ball_of_a_file_bounces(write: Write) -> None:
    system = ac.compile(ac.load(write(BALL)), check_units=False)
    run = ac.simulate(system, (0.0, 1.5), saveat=[1.5], rtol=1e-10, atol=1e-12)
    assert float(run["h"][0]) == pytest.approx(ball_height(1.0, 0.8, 1.5), rel=1e-8)
    assert [e.after["n"] for e in run.events if e.after] == [1.0, 2.0]
    assert system.discrete.keys() == {"n"}


@pytest.mark.slow
def test_clocks_relays_and_chains_of_a_file(write: Write) -> None:
    system = ac.compile(ac.load(write(RELAYS)))
    run = ac.simulate(system, (0.0, 3.05), saveat=[0.5, 1.0, 1.6, 3.05], rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(run["on"], [1, 0, 1, 1])
    np.testing.assert_allclose(run["turns"], [0, 1, 2, 4])
    np.testing.assert_allclose(run["mode"], [0, 1, 2, 2])
    np.testing.assert_allclose(run["first"], 7.0)
    assert float(run["y"][-1]) == pytest.approx(sampled_end(0.1, 2.0, 3.05), abs=1e-7)


@pytest.mark.parametrize("document", [BALL, RELAYS], ids=["ball", "relays"])
def test_it_is_written_as_it_was_read(
    document: dict[str, Any], write: Write, tmp_path: Path
) -> None:
    model = ac.load(write(document))
    ac.save(model, tmp_path / "again.json")
    again = json.loads((tmp_path / "again.json").read_text(encoding="utf-8"))
    assert again == document
    assert list(again) == list(document)


def test_a_start_that_changed_since_is_written(write: Write, tmp_path: Path) -> None:
    model = ac.load(write(BALL))
    model.modify(h=ac.Start(2.0))
    ac.save(model, tmp_path / "again.json")
    again = json.loads((tmp_path / "again.json").read_text(encoding="utf-8"))
    assert again["variables"]["h"]["start"] == 2.0
    assert again["variables"]["v"] == BALL["variables"]["v"]


def test_a_subsystem_has_equations_and_conditions_may_stay_literal(write: Write) -> None:
    lag = {
        "variables": {"z": {"start": 1.0, "fixed": True}},
        "components": {},
        "equations": ["der(z) = noEvent(if z > 0 then -z else 0)"],
    }
    system = ac.compile(ac.load(write({"components": {"lag": lag}})))
    assert system.events is None
    assert system.states == ("lag.z",)


def test_a_variable_may_be_called_self(write: Write) -> None:
    path = write(
        {"variables": {"self": {"start": 2.0}}, "components": {}, "equations": ["der(self) = 1"]}
    )
    assert ac.compile(ac.load(path)).table()["start"]["self"] == 2.0


WRONG = {
    "an unknown name": ("when q < 0 then n = 1; end when", "'q' is not known here"),
    "no end": ("when h < 0 then n = 1;", "'end' expected"),
    "nothing to do": ("when h < 0 then end when", "nothing stands behind 'then'"),
    "no condition": ("when h + 1 then n = 1; end when", "neither true nor false"),
    "a period of zero": ("when sample(0, 0) then n = 1; end when", "a period above zero, not 0"),
    "a period that varies": ("when sample(0, h) then n = 1; end when", "h varies in a simulation"),
    "pre of a number": ("n = pre(3)", "the value before an event is a variable's"),
    "reinit outside": ("reinit(v, 1)", "'reinit' cannot be called"),
    "reinit of a number": ("when h < 0 then reinit(2, 1); end when", "only a variable can jump"),
    "code": ("n = __import__('os')", "is not allowed"),
    "no text": (3, "an equation is a text"),
    "no equation": ("h + v", "'=' expected"),
}


@pytest.mark.parametrize(("text", "words"), WRONG.values(), ids=WRONG)
def test_wrong_equations_are_refused_with_their_place(text: Any, words: str, write: Write) -> None:
    path = write({**BALL, "equations": ["der(h) = v", text]})
    with pytest.raises(ac.NetlistError) as caught:
        ac.load(path)
    sentence = str(caught.value)
    assert sentence.startswith("model.json: equations[1]: ")
    assert words in sentence
    assert "\n" not in sentence


VARIABLES = {
    "no attributes": (3, "a variable is an object of its attributes"),
    "unknown": ({"begin": 1}, "unknown attribute 'begin'"),
    "no kind": ({"discrete": "logic"}, "one of 'real', 'bool', 'int' is needed"),
    "no unit": ({"unit": 3}, "a text is needed"),
}


@pytest.mark.parametrize(("raw", "words"), VARIABLES.values(), ids=VARIABLES)
def test_wrong_variables_are_refused_with_their_place(raw: Any, words: str, write: Write) -> None:
    with pytest.raises(ac.NetlistError, match=r"^model.json: variables.q") as caught:
        ac.load(write({"variables": {"q": raw}}))
    assert words in str(caught.value)
