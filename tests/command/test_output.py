"""What commands print in terminals, pipes and for programs."""

import io
import json
import sys

import pytest

import acausal as ac
from acausal.command.output import CommandOutput

HEADER, ROWS = ("name", "unit"), [("m[1].s", "m"), ("m[12].v", "m/s")]


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_columns_in_a_pipe(capsys: pytest.CaptureFixture[str]) -> None:
    CommandOutput().table(HEADER, ROWS)
    assert capsys.readouterr().out == "  name     unit\n  m[1].s   m\n  m[12].v  m/s\n"


def test_tables_in_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Names with brackets are no markup."""
    monkeypatch.setattr(sys, "stdout", terminal := Terminal())
    monkeypatch.setenv("TERM", "xterm-256color")
    CommandOutput().title("states")
    CommandOutput().table(HEADER, ROWS)
    assert "\x1b[" in terminal.getvalue()
    assert "m[12].v" in terminal.getvalue()


def test_warnings_and_errors(capsys: pytest.CaptureFixture[str]) -> None:
    out = CommandOutput(as_json=True)
    out.warn("a gap")
    out.say("for people")
    assert out.fail(ac.DataError("no data")) == 4
    printed, complained = capsys.readouterr()
    assert complained == "warning: a gap\nerror: no data\n"
    assert json.loads(printed) == {
        "error": {"kind": "data", "message": "no data", "exit_code": 4},
        "warnings": ["a gap"],
    }


def test_numbers_that_json_does_not_know(capsys: pytest.CaptureFixture[str]) -> None:
    CommandOutput(as_json=True).result({"values": [1.0, float("nan"), float("inf")]})
    assert json.loads(capsys.readouterr().out)["values"] == [1.0, None, None]
