"""Small classes after the chapters of the specification, right ones and wrong ones, here and in rumoca and pymoca.

``Chapters.json`` has what the variables of the right ones are after 1 s: by closed forms, or by rumoca.
``Wrong.json`` has wrong texts, each with words of the sentence that refuses it.
"""

import json
import signal
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.modelica import parse, read_source
from acausal.modelica.syntax import ClassDefinition, Declared

FOLDER = Path(__file__).parent
FILE = FOLDER / "Chapters.mo"
RIGHT: dict[str, dict[str, float]] = json.loads((FOLDER / "Chapters.json").read_text())
WRONG: dict[str, str] = json.loads((FOLDER / "Wrong.json").read_text())
NEAR = {"rel": 1e-6, "abs": 1e-6}

NOT_IN_RUMOCA = {
    "Expressions.OfExpressions": "derivatives of expressions",
    "Classes.Colours": "arrays over an enumeration",
    "Inheritance.Modified": "modifiers of redeclared classes, and of dotted names",
    "Equations.Pendulum": "derivatives of derivatives",
    "Connections.Bank": "connections of slices",
    "Arrays.Constructed": "Integers in the place of a Real",
    "Arrays.Further": "several iterators",
    "Algorithms.Sections": "variables that are read and assigned again",
    "Algorithms.Straight": "algorithms of several variables",
    "Functions.Steps": "while and return",
    "Functions.WithRecords": "records in functions",
    "Operators.Overloaded": "operators of several functions",
}
"""Models of which rumoca 0.10 does not take a part, or drops it; their values are closed forms."""


@pytest.fixture(scope="module")
def rumoca() -> Any:
    return pytest.importorskip("rumoca", reason="rumoca, which compares, is not installed")


def difference(name: str, found: Any) -> dict[str, Any]:
    """The variables of a model whose value is not that of the table."""
    values = {variable: float(np.asarray(found(variable))[-1]) for variable in RIGHT[name]}
    return {v: x for v, x in values.items() if x != pytest.approx(RIGHT[name][v], **NEAR)}


@pytest.mark.slow
@pytest.mark.parametrize("package", dict.fromkeys(n.partition(".")[0] for n in RIGHT))
def test_right_classes_have_the_values_of_the_table(tmp_path: Path, package: str) -> None:
    """All models of a package as parts of one model."""
    names = [n for n in RIGHT if n.startswith(f"{package}.")]
    parts = {n: n.replace(".", "_") for n in names}
    file = tmp_path / "All.mo"
    rows = "".join(f"  Chapters.{n} {part};\n" for n, part in parts.items())
    file.write_text(f"model All\n{rows}end All;")
    system = ac.compile(ac.load(file, path=[FOLDER]), check_units=False)
    run = ac.simulate(system, 1.0, saveat=[0.0, 1.0], rtol=1e-9, atol=1e-11)
    wrong = {n: difference(n, lambda v, p=part: run[f"{p}.{v}"]) for n, part in parts.items()}
    assert {n: w for n, w in wrong.items() if w} == {}


@pytest.mark.slow
def test_rumoca_has_the_values_of_the_table(rumoca: Any) -> None:
    wrong: dict[str, Any] = {}
    config = rumoca.SimConfig(rtol=1e-11, atol=1e-13)
    for name in RIGHT.keys() - NOT_IN_RUMOCA.keys():
        text = f"{FILE.read_text()}\nmodel Run\n  Chapters.{name} m;\nend Run;"
        run = rumoca.Session().loads(text, model="Run").simulate(1.0, dt=0.01, config=config)
        wrong[name] = difference(name, lambda v, run=run: run[f"m.{v}"])
    assert len(wrong) >= 50
    assert {n: w for n, w in wrong.items() if w} == {}


def test_wrong_classes_are_refused(tmp_path: Path) -> None:
    file, wrong = tmp_path / "wrong.mo", dict[str, str]()
    for text, words in WRONG.items():
        file.write_text(text)
        found = "nothing"
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                ac.compile(ac.load(file, "M"))
        except ac.ModelError as error:
            found = str(error)
        if words not in found:
            wrong[text] = found
    assert wrong == {}


@contextmanager
def seconds(limit: int) -> Iterator[None]:
    """A call that takes longer is stopped by an error."""

    def stop(*_: Any) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(limit)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


@pytest.mark.slow
def test_rumoca_refuses_the_wrong_classes(rumoca: Any) -> None:
    taken: list[str] = []
    for text in WRONG:
        try:
            with seconds(20):
                rumoca.Session().loads(text, model="M").simulate(1.0, dt=0.1)
        except rumoca.RumocaError:
            continue
        taken.append(text)
    assert taken == []


def test_pymoca_finds_the_same_classes() -> None:
    """Classes within classes, their kinds, and their components with type, dimensions and prefixes."""
    tree = pytest.importorskip("pymoca.parser", reason="pymoca is not installed")
    whole = tree.parse(FILE.read_text())
    _, (own,) = parse(read_source(FILE))
    assert _of_pymoca(whole.classes[own.name]) == _of_text(own)


def _of_text(definition: ClassDefinition) -> Any:
    elements = definition.elements
    components = [
        (e.name, e.type.text, len(e.subscripts), e.prefixes.variability, e.prefixes.connection)
        for e in elements
        if isinstance(e, Declared)
    ]
    inner = {e.name: _of_text(e) for e in elements if isinstance(e, ClassDefinition)}
    return definition.kind, sorted(components), inner


def _of_pymoca(cls: Any) -> Any:
    words = ("parameter", "constant", "discrete"), ("flow", "stream")
    components = [
        (
            s.name,
            str(s.type),
            sum(getattr(size, "value", size) is not None for row in s.dimensions for size in row),
            *(next((w for w in some if w in s.prefixes), "") for some in words),
        )
        for s in cls.symbols.values()
        if str(s.type) != cls.name  # a literal of an enumeration
    ]
    inner = {n: _of_pymoca(c) for n, c in cls.classes.items()}
    return cls.type.removeprefix("operator") or "operator", sorted(components), inner
