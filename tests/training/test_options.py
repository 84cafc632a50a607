"""The options of a training are written once: type checkers, `help` and the training see the same ones."""

import inspect
from dataclasses import FrozenInstanceError, fields
from typing import Any

import pytest

import acausal as ac
from acausal.training.options import FitKeywords, FitOptions
from tests.support.oscillator import learned, record


def test_type_checkers_see_the_options_that_there_are() -> None:
    assert FitKeywords.__annotations__.keys() == {f.name for f in fields(FitOptions)}
    for field in fields(FitOptions):
        assert FitKeywords.__annotations__[field.name].__forward_arg__ == field.type


@pytest.mark.parametrize("function", [ac.fit, ac.ensemble])
def test_help_names_every_option_with_its_default(function: Any) -> None:
    shown = inspect.signature(function).parameters
    for field in fields(FitOptions):
        assert shown[field.name].default == field.default
        assert shown[field.name].kind is inspect.Parameter.KEYWORD_ONLY
        assert f"\n    {field.name}: " in inspect.getdoc(function)
    assert "options" not in shown
    assert list(shown)[:3] == ["system", "data", "targets"]


def test_options_cannot_change() -> None:
    with pytest.raises(FrozenInstanceError):
        FitOptions().gamma = 0.3  # pyright: ignore[reportAttributeAccessIssue]


def test_iterables_may_be_used_up_by_reading_them_once() -> None:
    seen: list[Any] = []
    given: dict[str, Any] = {
        "sequence_length": 0.2, "epochs": 2, "progress": False, "evaluate_every": 1,
        "regularizers": (r for r in [ac.SmallCorrection()]), "observers": (o for o in [seen.append]),
    }  # fmt: skip
    fit = ac.fit(learned(), record(end=2.0), "mass.a", **given)
    assert "SmallCorrection" in fit.history.penalties
    assert [progress.epoch for progress in seen] == [1, 2]


def test_one_number_of_updates_counts_for_every_part() -> None:
    options = FitOptions(strategy=("equation_error", "whole_record"), epochs=7)
    assert options.updates == (7, 7)
    assert FitOptions(strategy="gauss_newton").updates == (50,)
