"""The command line, as it is typed."""

import csv
import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import acausal as ac
from acausal.command import EXIT_CODES, main
from tests.support.paths import ROOT

MODEL = {
    "model": "Oscillator",
    "components": {
        "fixed": {"class": "Modelica.Mechanics.Translational.Components.Fixed"},
        "spring": {
            "class": "Modelica.Mechanics.Translational.Components.SpringDamper",
            "with": {"c": 50.0, "d": 1.0},
        },
        "mass": {
            "class": "Modelica.Mechanics.Translational.Components.Mass",
            "with": {"m": 2.0, "s": {"start": 0.1, "fixed": True}, "v": {"fixed": True}},
        },
        "push": {"class": "Modelica.Mechanics.Translational.Sources.Force"},
    },
    "connections": [
        ["fixed.flange", "spring.flange_a"],
        ["spring.flange_b", "mass.flange_a"],
        ["push.flange", "mass.flange_b"],
    ],
    "stop_time": 2.0,
}

PYTHON = """
import acausal as ac

model = ac.load("oscillator.json")

def make():
    return ac.compile(ac.load("oscillator.json"))

def wrong():
    return 1 / 0

def number():
    return 3

class Needs(ac.Component):
    def __init__(self, count):
        super().__init__()
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a model, in which commands run."""
    (tmp_path / "oscillator.json").write_text(json.dumps(MODEL))
    (tmp_path / "own_models.py").write_text(PYTHON)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.delitem(sys.modules, "own_models", raising=False)
    return tmp_path


@pytest.fixture
def typed(capsys: pytest.CaptureFixture[str]):
    """Type a command: its exit code, what it prints, and what it complains about."""

    def run(*words: str) -> tuple[int, str, str]:
        code = main(words)
        return code, *capsys.readouterr()

    return run


PUSH = ("--input", "push.f=1")


# -- in a shell ---------------------------------------------------------------------------------------


def shell(*words: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """`python -m acausal` in a process of its own."""
    command = [sys.executable, "-m", "acausal", *words]
    env = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(ROOT), "JAX_PLATFORMS": "cpu"}
    return subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_in_a_shell(folder: Path) -> None:
    done = shell("check", "oscillator.jsn", cwd=folder)
    assert done.returncode == 3
    assert done.stdout == ""
    assert done.stderr == f"error: oscillator.jsn: cannot be read ({os.strerror(errno.ENOENT)})\n"
    assert shell("--version", cwd=folder).stdout == f"acausal {ac.__version__}\n"


def test_help_imports_neither_jax_nor_rich(folder: Path) -> None:
    code = (
        "import sys; from acausal.command import main; main(['simulate', '--help']);"
        "print([m for m in ('jax', 'numpy', 'rich', 'sympy') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.endswith("\n[]\n")


def test_help_lists_commands_and_exit_codes(typed) -> None:
    code, out, _ = typed("--help")
    assert code == 0
    for word in ("check", "show", "simulate", "fit", "predict", "export", "page", "new"):
        assert f"\n    {word} " in out
        code, own, _ = typed(word, "--help")
        assert code == 0
        assert "\nexamples:\n  acausal " in own
        assert all(len(line) <= 120 for line in own.splitlines())
    for number, meaning in EXIT_CODES.items():
        assert f"{number:>3}  {meaning}" in out


def test_no_command_and_wrong_words_are_usage(typed) -> None:
    assert typed()[0] == 2
    assert typed("chek", "oscillator.json")[0] == 2
    assert typed("simulate", "oscillator.json", "--set", "mass.m")[0] == 2
    assert typed("export", "oscillator.json", "model.xyz")[0] == 2
    code, out, err = typed("export", "oscillator.json", "model.mo", "--fmi", "2.0")
    assert (code, out) == (2, "")
    assert err == "error: --fmi does not go with the form modelica.\n"


# -- models -------------------------------------------------------------------------------------------


def test_check(typed) -> None:
    code, out, err = typed("check", "oscillator.json")
    assert (code, err) == (0, "")
    assert out.startswith("Oscillator is right: ")
    assert "2 states, 1 input, 3 parameters, 0 networks" in out


def test_tables_are_no_networks(typed, folder: Path) -> None:
    table = {"class": "Modelica.Blocks.Sources.TimeTable", "with": {"table": [[0, 0], [1, 2]]}}
    gain = {"class": "Modelica.Blocks.Math.Gain", "with": {"k": 3.0}}
    joined = [["ramp.y", "gain.u"]]
    parts = {"ramp": table, "gain": gain}
    (folder / "ramp.json").write_text(
        json.dumps({"model": "Ramp", "components": parts, "connections": joined})
    )
    assert " 0 networks, 1 table" in typed("check", "ramp.json")[1]
    _, out, _ = typed("show", "ramp.json")
    assert "tables (1)" in out
    assert "networks" not in out


def test_check_lists_what_nothing_is_connected_to(typed, folder: Path) -> None:
    path = "acausal.components.translational."
    parts = {
        "mass": {"class": path + "Mass", "with": {"m": 1.0}},
        "spring": {"class": path + "Spring", "with": {"c": 1.0}},
    }
    joined = [["mass.flange_b", "spring.flange_a"]]
    (folder / "free.json").write_text(json.dumps({"components": parts, "connections": joined}))
    code, out, _ = typed("check", "free.json")
    assert code == 0
    assert "nothing is connected to mass.flange_a, spring.flange_b: no flow" in out
    _, out, _ = typed("check", "free.json", "--json")
    assert json.loads(out)["unconnected"] == ["mass.flange_a", "spring.flange_b"]


@pytest.mark.parametrize(
    "command",
    [
        ("page", "oscillator.json", "out"),
        ("export", "oscillator.json", "out/index.mo"),
        ("simulate", "oscillator.json", *PUSH, "--dt", "0.1", "--out", "out/index.html"),
    ],
)
def test_what_exists_is_replaced(typed, folder: Path, command: tuple[str]) -> None:
    (folder / "out").mkdir()
    for name in ("index.html", "index.mo", "notes.md"):
        (folder / "out" / name).write_text("old")
    assert typed(*command)[0] == 0
    left = [file.name for file in (folder / "out").iterdir() if file.read_text() == "old"]
    assert len(left) == 2
    assert "notes.md" in left


@pytest.mark.parametrize(
    "command",
    [
        ("export", "oscillator.json", "oscillator.json", "--form", "modelica"),
        ("simulate", "oscillator.json", "--inputs", "a.csv", "--out", "./a.csv"),
        ("simulate", "oscillator.json", *PUSH, "--plot", "oscillator.json"),
        ("simulate", "own_models.py:model", *PUSH, "--out", "own_models.py"),
        ("fit", "oscillator.json", "*.csv", "--targets", "mass.s", "--out", "a.csv"),
        ("predict", "oscillator.json", "*.csv", "--training", "*.csv", "--targets", "mass.s", "--out", "."),
    ],
)  # fmt: skip
def test_no_command_writes_to_a_file_that_it_reads(
    typed, folder: Path, command: tuple[str]
) -> None:
    for name in "ab":
        (folder / f"{name}.csv").write_text("time,mass.s,push.f\n0,0,1\n0.1,0,1\n")
    before = {file: file.read_bytes() for file in folder.iterdir() if file.is_file()}
    code, _, err = typed(*command)
    assert code == 4
    assert "is read by this command; give another" in err
    assert {file: file.read_bytes() for file in folder.iterdir() if file.is_file()} == before


def test_records_whose_files_would_be_one_are_refused(typed, folder: Path) -> None:
    for name in ("a b", "a_b", "a.1", "a.2"):
        (folder / f"{name}.csv").write_text("time,mass.s,push.f\n0,0,1\n0.1,0,1\n")
    _, _, err = typed(
        "predict", "oscillator.json", "*.csv", "--training", "a_b.csv", "--targets", "mass.s", "--out", "bands"
    )  # fmt: skip
    assert "--out: two of the records 'a b', 'a.1', 'a.2', 'a_b' have the same name as files" in err


def test_check_for_programs(typed) -> None:
    code, out, _ = typed("check", "oscillator.json", "--json")
    found = json.loads(out)
    assert code == 0
    assert found["ok"] is True
    assert found["states"] == ["mass.s", "mass.v"]
    assert found["inputs"] == ["push.f"]
    assert found["open_starts"] == []
    assert found["warnings"] == []


def test_check_many(typed, folder: Path) -> None:
    """All are checked; the first that is wrong gives the exit code."""
    still = {"components": {"mass": {"class": "acausal.components.translational.Mass"}}}
    (folder / "no_mass.json").write_text(json.dumps(still))
    models = ("no_mass.json", "nowhere.json", "oscillator.json")
    code, out, err = typed("check", *models)
    assert code == 3
    assert out.startswith("Oscillator is right: ")
    first, second = err.splitlines()
    assert first.startswith("error: no_mass.json: ")
    assert second.startswith("error: nowhere.json: cannot be read")
    code, out, _ = typed("check", *models, "--json")
    kinds = [json.loads(line).get("error", {}).get("kind") for line in out.splitlines()]
    assert (code, kinds) == (3, ["model", "model", None])


@pytest.mark.parametrize("model", ["own_models:model", "own_models:make", "own_models.py:make"])
def test_models_of_python(typed, model: str) -> None:
    code, out, _ = typed("show", model, "--only", "states", "--json")
    assert code == 0
    assert [row["name"] for row in json.loads(out)["states"]] == ["mass.s", "mass.v"]


@pytest.mark.parametrize(
    ("model", "sentence"),
    [
        ("own_models:modl", "own_models:modl: own_models has no 'modl': did you mean 'model'?"),
        ("own_models:number", "own_models:number is 3, not a model; name a class of components."),
        ("own_models:wrong", "wrong() fails (own_models.py, line 10): ZeroDivisionError: division"),
        ("own_models:Needs", "Needs() fails: TypeError: Needs.__init__() missing 1 required"),
        ("nowhere:Model", "there is no module 'nowhere'; start acausal in the folder that has it"),
        ("nowhere.py:Model", "there is no file 'nowhere.py'."),
        ("own_models.py", "name the class in it, too: own_models.py:Class"),
    ],
)
def test_wrong_models(typed, model: str, sentence: str) -> None:
    code, _, err = typed("check", model)
    assert code == 3
    assert err.startswith("error: ")
    assert sentence in err
    assert err.count("\n") == 1


def test_errors_for_programs(typed) -> None:
    code, out, err = typed("check", "nowhere.json", "--json")
    assert code == 3
    assert json.loads(out)["error"] == {
        "kind": "model",
        "message": err.removeprefix("error: ").strip(),
        "exit_code": 3,
    }


def test_show(typed) -> None:
    code, out, _ = typed("show", "oscillator.json", "--set", "mass.m=4")
    assert code == 0
    assert out.splitlines() == [
        "Oscillator",
        "states (2)",
        "  name    start  unit  how",
        "  mass.s  0.1    m     fixed",
        "  mass.v  0      m/s   fixed",
        "inputs (1)",
        "  name    unit",
        "  push.f  N",
        "parameters (3)",
        "  name      value  unit",
        "  spring.c  50     N/m",
        "  spring.d  1      N.s/m",
        "  mass.m    4      kg",
        "equations (2)",
        "  der(mass.s) = mass.v",
        "  der(mass.v) = (-mass.s*spring.c - mass.v*spring.d + push.f)/mass.m",
    ]


def test_show_with_another_part(typed) -> None:
    code, out, _ = typed("show", "oscillator.json", "--replace", "spring=neural.Compliance")
    assert code == 0
    assert "spring.net" in out
    assert "spring.c " not in out


@pytest.mark.parametrize(
    ("other", "sentence"),
    [
        ("spring=neural.Complianse", "there is no class 'neural.Complianse'"),
        ("sprung=neural.Compliance", "no part 'sprung' to replace: did you mean 'spring'?"),
        ("spring=own_models:number", "own_models:number is 3, not a model"),
    ],
)
def test_parts_that_cannot_be_replaced(typed, other: str, sentence: str) -> None:
    code, _, err = typed("show", "oscillator.json", "--replace", other)
    assert code == 3
    assert sentence in err
    assert err.count("\n") == 1


# -- simulation ---------------------------------------------------------------------------------------


@pytest.mark.slow
def test_simulate(typed, folder: Path) -> None:
    code, out, _ = typed(
        "simulate",
        "oscillator.json",
        *PUSH,
        "--points",
        "5",
        "--names",
        "mass.*",
        "--out",
        "run.csv",
    )
    assert code == 0
    assert out.startswith("Oscillator: 5 points from 0 to 2 s\n")
    assert out.endswith("wrote run.csv\n")
    with (folder / "run.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0][0] == "time [s]"
    assert "mass.a [m/s2]" in rows[0]
    assert all(name.partition(" ")[0].count(".") == 1 for name in rows[0][1:])
    assert [row[0] for row in rows[1:]] == ["0.0", "0.5", "1.0", "1.5", "2.0"]


@pytest.mark.slow
def test_simulate_for_programs(typed, folder: Path) -> None:
    pytest.importorskip("matplotlib")
    (folder / "push.csv").write_text("time,push.f\n0,0\n1,1\n2,0\n")
    words = ("--inputs", "push.csv", "--x0", "mass.s=0.2", "--points", "3", "--plot", "run.svg")
    code, out, _ = typed("simulate", "oscillator.json", *words, "--json")
    found = json.loads(out)
    assert code == 0
    assert found["time"] == [0.0, 1.0, 2.0]
    assert found["variables"]["mass.s"]["values"][0] == 0.2
    assert found["variables"]["push.f"] == {"unit": "N", "values": [0.0, 1.0, 0.0]}
    assert found["files"] == ["run.svg"]
    assert (folder / "run.svg").read_text().startswith("<?xml")


@pytest.mark.slow
def test_simulate_into_a_pipe(typed) -> None:
    code, out, _ = typed("simulate", "oscillator.json", *PUSH, "--points", "2", "--out", "-")
    assert code == 0
    assert out.splitlines()[0] == "time [s],mass.s [m],mass.v [m/s],push.f [N]"
    assert len(out.splitlines()) == 3
    assert typed("simulate", "oscillator.json", *PUSH, "--out", "-", "--json")[0] == 2


@pytest.mark.parametrize(
    ("words", "code", "sentence"),
    [
        ((), 4, "No value for the model's input 'push.f'"),
        ((*PUSH, "--set", "mas.m=1"), 4, "mas.m"),
        ((*PUSH, "--names", "mass.z*"), 4, "No variable is called 'mass.z*'"),
        ((*PUSH, "--names", "mass.z"), 4, "The model has no variable 'mass.z'"),
        ((*PUSH, "--inputs", "push.xyz"), 4, "'.xyz' is no known ending"),
        ((*PUSH, "--params", "nowhere.safetensors"), 4, "nowhere.safetensors"),
        (
            (*PUSH, "--points", "1000000000000"),
            4,
            "--points 1000000000000 is not from 2 to 10_000_000",
        ),
        ((*PUSH, "--set", "spring.c=1e99", "--dt", "0.1"), 5, "s"),
    ],
)
def test_simulations_that_cannot_be(typed, words, code: int, sentence: str) -> None:
    found, out, err = typed("simulate", "oscillator.json", *words)
    assert (found, out) == (code, "")
    assert sentence in err
    assert err.startswith("error: ")


def test_a_number_that_is_too_large_is_none(typed) -> None:
    code, _, err = typed("simulate", "oscillator.json", *PUSH, "--set", "mass.m=1e400")
    assert code == 2
    assert "'mass.m=1e400' is not NAME=NUMBER, such as mass.m=2.5" in err


@pytest.mark.parametrize(
    ("words", "form"),
    [(("--replace", "mass"), "PART=CLASS"), (("--rename", "a="), "COLUMN=NAME")],
)
def test_a_pair_without_a_value_is_refused_with_its_form(typed, words, form: str) -> None:
    code, _, err = typed("simulate", "oscillator.json", *PUSH, *words)
    assert code == 2
    assert f"'{words[1]}' is not {form}" in err


# -- training -----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_fit(typed, folder: Path) -> None:
    """What a stiffer spring does; the training finds its stiffness, and the simulation takes it."""
    stiffer = ("--set", "spring.c=60", "--points", "101", "--out", "run.csv")
    assert typed("simulate", "oscillator.json", *PUSH, *stiffer)[0] == 0
    (folder / "options.toml").write_text(
        'strategy = "gauss_newton"\nepochs = 9\n'
        "[modifiers]\n'spring.c' = { Bounded = { low = 40.0, high = 90.0 } }\n"
    )
    fit = ("fit", "oscillator.json", "run.csv", "--targets", "mass.s", "--options", "options.toml")
    code, out, err = typed(*fit, "-o", "epochs=10", "--json")
    found = json.loads(out)
    assert (code, err) == (0, "")
    assert found["parameters"]["spring.c"] == pytest.approx(60.0, rel=0.01)
    assert found["loss"] < 0.1 * found["loss_before"]
    assert found["files"] == ["Oscillator-trained.safetensors"]
    assert isinstance(found["good"], bool)
    assert "explains" in found["verdict"][0]
    assert found["verdict"][0] in typed(*fit, "-o", "epochs=10")[1]

    again = ("show", "oscillator.json", "--only", "parameters", "--json")
    _, out, _ = typed(*again, "--params", "Oscillator-trained.safetensors")
    assert json.loads(out)["parameters"][0]["value"] == found["parameters"]["spring.c"]

    predict = ("predict", *fit[1:3], "--training", "run.csv", *fit[3:], "--out", "predicted")
    code, out, err = typed(*predict, "--params", "Oscillator-trained.safetensors", "--json")
    assert (code, err) == (0, "")
    assert json.loads(out)["records"]["record"]["mass.s"] < 1e-4
    with (folder / "predicted" / "record.csv").open() as file:
        assert next(csv.reader(file)) == [
            "time [s]",
            "mass.s [m]",
            "mass.s low [m]",
            "mass.s high [m]",
        ]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("-o", "epoch=3"), "There is no option 'epoch': did you mean 'epochs'?"),
        (("-o", "optimizer=adam"), "The option 'optimizer' can be given in Python only."),
        (("-o", "strategy=magic"), "No strategy 'magic'"),
        (("-o", 'loss={"Eval": {}}'), "loss: there is no 'Eval'; known are 'Bounded'"),
        (("-o", 'loss={"Huber": {"x": 1}}'), "loss: Huber cannot be made"),
        (("--options", "nowhere.json"), "'nowhere.json' cannot be read: No such file"),
        (("--options", "own_models.py"), "'own_models.py' cannot be read"),
    ],
)
def test_options_that_are_wrong(typed, words, sentence: str) -> None:
    code, _, err = typed("fit", "oscillator.json", "run.csv", "--targets", "mass.s", *words)
    assert code == (4 if words[0] == "--options" else 6)
    assert sentence in err


# -- export, page -------------------------------------------------------------------------------------


def test_export(typed, folder: Path) -> None:
    code, out, _ = typed("export", "oscillator.json", "model.mo")
    assert (code, out) == (0, "wrote model.mo\n")
    assert "model Oscillator" in (folder / "model.mo").read_text()
    code, out, _ = typed("export", "oscillator.json", "c/plant.c", "--solver", "euler", "--json")
    assert code == 0
    assert json.loads(out)["files"] == ["c/plant.h", "c/plant.c"]
    code, _, err = typed("export", "oscillator.json", "", "--form", "c")
    assert (code, err) == (4, "error: export: '' is not a path; it is empty.\n")


def test_page(typed, folder: Path) -> None:
    code, out, _ = typed("page", "oscillator.json", "out")
    assert (code, out) == (0, "wrote out/index.html\n")
    assert "Oscillator" in (folder / "out" / "index.html").read_text()
