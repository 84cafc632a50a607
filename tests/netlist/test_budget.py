"""What a file may ask for: models that would run away are refused before anything of that size is made."""

import json
import tracemalloc
from pathlib import Path
from typing import Any

import pytest

import acausal as ac
from acausal.components import blocks, thermal
from acausal.flattening import flatten
from tests.support.counted import calls_below

B = "Modelica.Blocks"
QUARTIC: dict[str, Any] = {
    "p1": [1, 1, 1, 1],
    **{f"p{k}": f"{{{','.join([f'p{k - 1}'] * 4)}}}" for k in range(2, 16)},
}
SQUARE = [[1.0] * 400] * 400


def big(cls: str, **given: Any) -> dict[str, Any]:
    return {"components": {"big": {"class": cls, "with": given}}}


RUNAWAYS: dict[str, tuple[dict[str, Any], str]] = {
    "replicator": (
        big(f"{B}.Routing.Replicator", nout=10**9),
        (
            "components.big: Replicator with nout=1e+09 would have 1,000,000,000 elements, more than its budget of "
            "10,000; make it smaller, or raise the limit: budget=ac.Budget(vector=1_000_000_000)"
        ),
    ),
    "sum": (big(f"{B}.Math.MultiSum", nu=1e9), "components.big: MultiSum with nu=1e+09 would have"),
    "filter": (
        big("acausal.components.blocks.LowpassButterworth", n=10**6, f=1),
        "components.big: LowpassButterworth with n=1e+06 would have 1,000,000 elements",
    ),
    "delay": (
        big(f"{B}.Nonlinear.PadeDelay", n=10**6, delayTime=1),
        "components.big: PadeDelay with n=1e+06 would have 1,000,000 elements",
    ),
    "transfer function": (
        big(f"{B}.Continuous.TransferFunction", a=[1.0] * 20_000),
        "components.big: TransferFunction.a would have 20,000 elements",
    ),
    "state space": (
        big(f"{B}.Continuous.StateSpace", A=SQUARE, B=[[1.0]] * 400, C=SQUARE[:1]),
        "components.big: StateSpace.A would have 160,000 elements",
    ),
    "lists of lists": (
        {"parameters": QUARTIC, "components": {}},
        "parameters.p10: the list would have over 500,000 entries",
    ),
    "connectors": (
        big("acausal.components.thermal.ThermalCollectorMatrix", Ns=30_000, Np=30_000),
        "components.big: with HeatPort the model has at least 500,002 elements",
    ),
    "inputs of a network": (
        big("acausal.components.neural.Characteristic", secondary=10**9),
        "components.big: Characteristic with secondary=1e+09 would have",
    ),
    "weights": (
        big("acausal.components.neural.Characteristic", width=9_999, depth=60),
        "components.big: Characteristic: with a network of width 9999, depth 60 the model has at",
    ),
    "neurons": (
        big("acausal.components.neural.Characteristic", width=10**9),
        "components.big: Characteristic with width=1e+09 would have",
    ),
}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "model.json"


def load(file: Path, document: dict[str, Any], **options: Any) -> Any:
    file.write_text(json.dumps(document), encoding="utf-8")
    return ac.load(file, **options)


@pytest.mark.cases(fast=4)
@pytest.mark.parametrize("name", RUNAWAYS)
def test_a_file_that_runs_away_is_refused_at_once(name: str, file: Path) -> None:
    document, sentence = RUNAWAYS[name]
    tracemalloc.start()
    with calls_below(8_000_000), pytest.raises(ac.NetlistError) as caught:
        load(file, document)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert str(caught.value).startswith(f"model.json: {sentence}")
    assert peak < 500e6


def test_many_large_parts_are_refused_when_their_model_is_flattened(file: Path) -> None:
    part = {"class": f"{B}.Routing.Replicator", "with": {"nout": 90}}
    parts = {"components": {f"r{i}": part for i in range(12)}}
    model = load(file, parts, budget=ac.Budget(elements=1000))
    with pytest.raises(ac.DeclarationError, match=r"with Replicator 'r1' the model has at least"):
        ac.compile(model)
    flatten(model, ac.Budget(elements=2000))


def test_limits_are_raised_by_an_argument_and_stay_with_the_model(file: Path) -> None:
    document = big(f"{B}.Routing.Replicator", nout=20)
    tight = ac.Budget(vector=20, elements=22, equations=19)
    model = load(file, document, budget=tight)
    with pytest.raises(ac.DeclarationError) as caught:
        ac.compile(model)
    assert str(caught.value) == (
        "with Replicator 'big' the model has at least 20 equations, more than its budget of 19; make it smaller, or "
        "raise the limit: budget=ac.Budget(equations=190)"
    )
    assert len(ac.compile(model, budget=ac.Budget(equations=190)).variables) == 21
    with pytest.raises(ac.NetlistError, match=r"Replicator with nout=20 would have 20 elements"):
        load(file, document, budget=ac.Budget(vector=19))


def test_sizes_that_only_inner_modifiers_give_are_found(file: Path) -> None:
    inner = big(f"{B}.Routing.Replicator", nout=3)
    document = {"components": {"part": {**inner, "with": {"big": {"nout": 10**9}}}}}
    with pytest.raises(
        ac.NetlistError, match=r"^model\.json: Replicator 'part\.big'\.y would have 1,000,000,000"
    ):
        load(file, document)


def test_components_connections_and_seconds_are_counted(file: Path) -> None:
    mass = {"class": "Modelica.Mechanics.Translational.Components.Mass", "with": {"m": 1}}
    masses = {"components": {f"m[{i}]": mass for i in range(1, 5)}}
    with pytest.raises(ac.NetlistError, match=r"m\[4\]: with Mass the model has at least 5 comp"):
        load(file, masses, budget=ac.Budget(components=4))
    wire = {**masses, "connections": [["m[1].flange_b", "m[2].flange_a"]] * 9}
    with pytest.raises(ac.NetlistError, match=r"connections\[8\]: .* at least 9 equations"):
        load(file, wire, budget=ac.Budget(equations=8))
    with pytest.raises(ac.NetlistError, match=r"taken too many seconds, more than its budget of"):
        load(file, masses, budget=ac.Budget(seconds=1e-9))


def test_models_in_python_have_a_higher_budget() -> None:
    assert len(blocks.Replicator(nout=20_000).y) == 20_000
    with pytest.raises(ac.DeclarationError, match=r"Replicator\.y would have 1,000,000,000 elem"):
        ac.compile(blocks.Replicator(nout=10**9))
    with pytest.raises(ac.DeclarationError, match=r"the model has at least 7 elements"):
        ac.compile(thermal.ThermalConductor(G=1.0), budget=ac.Budget(elements=2))


@pytest.mark.parametrize("limit", [{"vector": 0}, {"seconds": -1.0}, {"elements": "many"}])
def test_a_limit_is_a_positive_number(limit: dict[str, Any]) -> None:
    with pytest.raises(ac.DeclarationError, match=r"a limit is a positive number"):
        ac.Budget(**limit)


def test_a_size_below_zero_is_refused() -> None:
    with pytest.raises(ac.DeclarationError, match=r"Replicator\.y cannot have -1 elements"):
        ac.compile(blocks.Replicator(nout=-1))


def test_parameters_that_are_used_many_times_are_evaluated_once(file: Path) -> None:
    """By their definitions the last of them is a sum of 2**60 terms."""
    doubled = {f"p{k}": f"p{k - 1}*q{k - 1}" for k in range(1, 60)}
    doubled |= {f"q{k}": f"(p{k - 1} + q{k - 1})/2" for k in range(1, 60)}
    document = big(f"{B}.Routing.Replicator", nout="p59 + 2")
    assert load(file, {**document, "parameters": {"p0": 1, "q0": 1, **doubled}}).big.nout == 3
