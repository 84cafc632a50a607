"""The options of a training are written once: type checkers, `help` and the training see the same ones."""

import inspect
from dataclasses import FrozenInstanceError, fields
from typing import Any

import diffrax
import numpy as np
import pytest

import acausal as ac
from acausal.simulation import Adaptive
from acausal.training.build_problem import _solver, build_problem
from acausal.training.objective.sequences import Sequences
from acausal.training.options import FitKeywords, FitOptions
from tests.support.oscillator import learned, plain, record


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


@pytest.mark.slow
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


def test_whole_numbers_may_be_of_numpy() -> None:
    options = FitOptions(epochs=np.int32(2), batch_size=np.int8(3), starts=np.uint8(2))  # pyright: ignore[reportArgumentType]
    assert (options.updates, options.batch_size, options.starts) == ((2,), 3, 2)
    assert FitOptions(
        strategy=("equation_error", "whole_record"), epochs=np.array([2, 3])
    ).updates == (2, 3)  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"train": 3}, "train=3 is not names of networks."),
        ({"modifiers": [None]}, "modifiers=[None] is not names of parameters, nor modifiers by name."),
        ({"gamma": "x"}, "gamma='x' is not a number."),
        ({"loss": 3}, "loss=3 is not a loss, by name or as a function."),
        ({"batch_size": 1.5}, "batch_size=1.5; give a whole number, 1 or more."),
        ({"strategy": None}, "strategy=None is not a strategy, nor several: give their names."),
        ({"epochs": float("nan")}, "epochs=nan; give a whole number, 1 or more."),
        ({"optimizer": 3}, "optimizer=3 is not an optax optimizer; give one such as optax.adam(0.01)."),
        ({"patience": "x"}, "patience='x'; give a whole number, 1 or more."),
        ({"starts": None}, "starts=None; give a whole number, 1 or more."),
        ({"epochs": (2, True)}, "epochs=True; give a whole number, 1 or more."),
        ({"checkpoint": 3}, "checkpoint: 3 is not a path; give a text such as 'folder/file', or a pathlib.Path."),
    ],
)  # fmt: skip
def test_values_of_the_wrong_kind_get_one_sentence(given: Any, sentence: str) -> None:
    with pytest.raises(ac.TrainingError) as found:
        FitOptions(**given)
    assert str(found.value) == sentence


@pytest.mark.cases(fast=1, slow=2)
@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"loss": lambda: 0.0}, "The loss cannot be computed: "),
        ({"loss": lambda p, m, s: p[:, 0]}, "The loss has the shape"),
        ({"regularizers": lambda p, c: None}, "The regularizer '<lambda>' cannot be computed: "),
    ],
)
def test_what_functions_of_a_training_give_is_checked(given: Any, sentence: str) -> None:
    with pytest.raises(ac.TrainingError, match=sentence):
        ac.fit(learned(), record(end=2.0), "mass.a", sequence_length=0.2, progress=False, **given)


@pytest.mark.parametrize(("given", "kind"), [({}, Adaptive), ({"dt": 0.1}, diffrax.Kvaerno3)])
def test_stiff_is_a_solver_of_trainings(given, kind):
    options = FitOptions(solver="stiff", **given)
    assert isinstance(_solver(options, np.dtype(float)), kind)


@pytest.mark.parametrize(
    ("given", "length"),
    [
        ({"strategy": "sequences"}, "auto"),
        ({"strategy": ("sequences", "whole_record")}, "auto"),
        ({"strategy": "sequences", "sequence_length": None}, None),
        ({"strategy": "whole_record"}, None),
    ],
)
def test_a_strategy_of_sequences_has_sequences_of_a_default_length(given, length):
    assert FitOptions.of("fit", given).sequence_length == length


@pytest.mark.slow
def test_the_default_length_is_of_measured_states():
    data = record(end=3.0)

    def cut_of(names: list[str], **more: object) -> Sequences:
        chosen = ac.Data(data.time, {n: data[n] for n in names}).for_system(plain())
        options = FitOptions(sequence_length="auto", modifiers=["mass.m"], **more)
        return build_problem(
            plain(), {"record": chosen}, ("mass.a",), plain().parameters(), options
        ).sequences

    every = ["push.f", "mass.a", "mass.s", "mass.v"]
    found = cut_of(every)
    assert (found.length, found.batch_size, found.whole) == (50, 16, False)
    assert cut_of(every, batch_size=3).batch_size == 3
    assert cut_of(every[:3]).whole
    assert cut_of(every, x0="fit").whole
