"""What public libraries write: names, sizes, redeclarations, buses."""

import copy
import re
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac

FILE = Path(__file__).with_name("Idioms.mo")
MOVES = {
    "choosing.x": -1 * 3,
    "buttons.x": -3,
    "guarded.y": -1,
    "starting.x[1]": 10 + 1,
    "starting.x[2]": 3 - 1,
    # 2*x + (1 + 2^2)/2 + 2*(3*(0 + 5*3)/2), and -3*1 + 2*1 + (5 + 6) + 10*5
    "functions.v.x": 2 + 2.5 + 45,
    "functions.v.y": -3 + 2 + 11 + 50,
    "stack.watch.x": 10 * (1 + 2) + (1 + 2) + 200,
    "stack.cell[1].heat.T": 6 / (1 + 2),
    # -load + turned + gain*2*turned
    "direct.machine.x[1]": -1 - 1 - 10 * 2,
    "rotating.machine.x[1]": -1 - 1 - 20 * 2,
    "rotating.machine.x[2]": -1 + 1 + 20 * 2,
    "voltages.own.x[1]": 2,
    "voltages.own.x[2]": 3,
    "voltages.given.x[1]": 5,
    "voltages.given.x[2]": 6,
    "matrices.store.c.v[1]": 1,
    "matrices.store.c.v[2]": 2,
    "matrices.x[1,1]": -9 * (0.25 + 0.25),
    "matrices.x[2,1]": -9 * (0.5 + 0.5),
    # L*der(i) = v - R*(the sum of both) - w*L*(i, turned)
    "lines.one.i[1]": (1 - 2 + 3) / 2,
    "lines.one.i[2]": (0 - 2 - 3) / 2,
    "lines.two.i[1]": (1 - 2 + 3) / 4,
    "lines.two.i[2]": (0 - 2 - 3) / 4,
    "piping.pipe.x": 3 + 2 + 2010,
    "piping.weighted.sum": 3 + 4,
    "controlled.mass.m.s": 1,
    "controlled.mass.m.v": (-3 - 5) / 2,
    "controlled.sum[1].y": 1,
    "controlled.sum[2].y": 1,
    "free.x[1]": 1,
    "free.x[2]": -4,
    "population.g.species.population": 4 - 0.5 - 1,
    "tank.c[1]": 1,
    "tank.c[2]": 2,
    "fast.law.x": -5,
    "redeclared.law.x": -2,
    "branch.x": 10 * 4 / 2,
}
"""State -> its derivative where every state is 1."""


@pytest.fixture(scope="module")
def model() -> Any:
    return ac.load(FILE, "Idioms.All")


@pytest.fixture(scope="module")
def system(model: Any) -> ac.System:
    return ac.compile(model)


@pytest.mark.slow
def test_states_move_as_their_equations_say(system: ac.System) -> None:
    ones = np.ones(len(system.states))
    params = system.parameters()
    found = jax.jit(lambda x: system.vector_field(0.0, x, None, params))(ones)
    moves = dict(zip(system.states, map(float, found), strict=True))
    assert moves == pytest.approx(MOVES)


@pytest.mark.slow
def test_a_copy_has_the_same_equations(model: Any, system: ac.System) -> None:
    again = ac.compile(copy.deepcopy(model))
    assert [str(e) for e in again.equations] == [str(e) for e in system.equations]


def test_names_are_those_of_the_text(system: ac.System) -> None:
    assert {"population.'1st'.replace", "population.g.document"} <= set(system.parameters())


@pytest.mark.slow
def test_a_derivative_is_sampled(tmp_path: Path) -> None:
    file = tmp_path / "sampled.mo"
    file.write_text("""
        model M
          Real x(start = 1, fixed = true);
          Real rate(start = 0, fixed = true), last(start = 0, fixed = true);
        equation
          der(x) = -x;
          when sample(0.25, 0.5) then
            rate = 3*der(x);
          end when;
        algorithm
          when time > 0.5 then
            last := der(x);
          end when;
        end M;""")
    run = ac.simulate(ac.compile(ac.load(file)), (0, 1), dt=0.05)
    assert run["rate"][-1] == pytest.approx(-3 * np.exp(-0.75), rel=1e-6)
    assert run["last"][-1] == pytest.approx(-np.exp(-0.5), rel=1e-4)


@pytest.mark.slow
def test_some_elements_of_an_array_are_fixed() -> None:
    run = ac.simulate(ac.compile(ac.load(FILE, "Idioms.Starting")), (0, 0.1))
    assert [run["x[1]"][0], run["x[2]"][0]] == pytest.approx([4, 3])


@pytest.mark.slow
def test_an_algorithm_is_one_unit() -> None:
    run = ac.simulate(ac.compile(ac.load(FILE, "Idioms.Counting")), (0, 1), dt=0.05)
    names = ("n", "m", "both[1]", "both[2]")
    at = {name: [int(run[name][i]) for i in (3, 5, 7, 9, 13, 17)] for name in names}
    # 10*n at 0.55 is 10, which the third 'when' sets back
    assert at["n"] == [1, 2, 3, 0, 1, 3]
    assert at["m"] == [0, 2, 2, 4, 1, 3]
    assert at["both[1]"] == [1, 2, 3, 4, 1, 3]
    assert at["both[2]"] == [0, 20, 20, 20, 20, 10]


TABLE = "#1\ndouble tab(2,2)\n0 1\n1 3\n"
READS = """
package Lib
  model M
    parameter String file = {file};
    Modelica.Blocks.Sources.CombiTimeTable t(
      tableOnFile = true, tableName = "tab", columns = {{2}},
      fileName = file);
    Real y = t.y[1];
  equation
    when time > 1 then
      Modelica.Utilities.Streams.print("done");
    end when;
  end M;
end Lib;"""


@pytest.mark.cases(fast=1, slow=4)
@pytest.mark.parametrize(
    "file",
    [
        'Modelica.Utilities.Files.loadResource("modelica://Lib/data/table.txt")',
        '"modelica://Lib/data/table.txt"',
        '"modelica://Lib.M/data/table.txt"',
        '"file://{folder}/data/table.txt"',
        '"data/table.txt"',
    ],
)
def test_files_are_looked_for_beside_the_text(tmp_path: Path, file: str) -> None:
    folder = tmp_path / "Lib"
    (folder / "data").mkdir(parents=True)
    (folder / "data" / "table.txt").write_text(TABLE)
    (folder / "package.mo").write_text(READS.format(file=file.format(folder=folder)))
    with pytest.warns(UserWarning, match="line 11, column 7: this text is not printed"):
        model = ac.load(folder)
    assert ac.simulate(ac.compile(model), 0.5, dt=0.1)["y"][-1] == pytest.approx(2)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("none.txt", r"there is no file 'none.txt' in .*Lib or .*here$"),
        ("/no/none.txt", r"there is no file '/no/none.txt'$"),
        ("modelica://Other/none.txt", r"there is no folder of a package 'Other'; give the folder"),
    ],
)
def test_a_file_that_is_not_there_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, reason: str
) -> None:
    (tmp_path / "Lib").mkdir()
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    (tmp_path / "Lib" / "package.mo").write_text(READS.format(file=f'"{name}"'))
    with pytest.raises(ac.ModelError, match="line 7, column 7") as caught:
        ac.load(tmp_path / "Lib")
    assert re.search(reason, str(caught.value).splitlines()[0])
    (tmp_path / "here" / "none.txt").write_text(TABLE)
    if name == "none.txt":  # the present folder counts, too
        with pytest.warns(UserWarning, match="not printed"):
            ac.load(tmp_path / "Lib")


@pytest.mark.slow
def test_members_of_arrays_inputs_with_a_value_and_names_of_instances(tmp_path: Path) -> None:
    file = tmp_path / "members.mo"
    file.write_text("""
        package P
          connector In = input Real; connector Out = output Real;
          block Store
            parameter Boolean use = true; parameter Real least = 0.5; parameter String name = getInstanceName();
            In u = level if use;
            Real level(nominal = least), twice = 2*level;
          equation
            if not use then
              level = 1;
            end if;
          end Store;
          record R Real x[2]; end R;
          record Named parameter String name = "a"; end Named;
          model M
            parameter Named names[:] = {Named(), Named("b")};
            Store s, t(use = false);
            Out y = 3*time;
            discrete Real last(start = 7, fixed = true);
            R r[3](x = {{1, 2}, {3, 4}, {5, 6}});
            Real second[3] = r.x[2], n = if names[2].name == "b" and s.name == "M.s" then 1 else 0;
          equation
            connect(y, s.u);
            when terminal() then
              last = y;
            end when;
          end M;
        end P;""")
    with pytest.warns(UserWarning, match="line 24, column 18: the end of a simulation is no event"):
        model = ac.load(file, "P.M")
    run = ac.simulate(ac.compile(model), 1.0, dt=0.5)
    assert [float(run[n][-1]) for n in ("s.twice", "t.twice", "second[3]", "n", "last")] == [
        6,
        2,
        6,
        1,
        7,
    ]


def test_a_unit_that_nobody_knows_is_a_warning(tmp_path: Path) -> None:
    file = tmp_path / "costs.mo"
    file.write_text(
        'model M Real x(unit="dollar", start=1, fixed=true); equation der(x) = -x; end M;'
    )
    with pytest.warns(UserWarning, match="M.x: 'dollar' is not a unit"):
        assert ac.compile(ac.load(file)).states == ("x",)


def test_a_nominal_value_may_be_a_parameter_without_a_value() -> None:
    model = ac.load(FILE, "Idioms.Branch")
    model.modify(area=4.0)
    assert ac.simulate(ac.compile(model), 1.0, dt=0.1)["x"][-1] == pytest.approx(10 * 4 / 4)


SUMS = """
package P
  function total "1 + 2 + ... + n"
    input Real n;
    output Real y = 0;
  algorithm
    for i in 1:integer(n) loop y := y + i; end for;
  end total;
  model Part
    parameter Real a;
    Real x = total(a);
  end Part;
  model Two
    Part p(a = 2), q(a = 3);
  end Two;
  model Sizes
    parameter Real a = 0.3;
    parameter Integer n = integer(10*a + 0.5);
    Real x[n](each start = a, each fixed = true);
  equation
    der(x) = -x;
  end Sizes;
end P;"""


def test_what_parameters_decide_in_a_function_is_their_own_parts(tmp_path: Path) -> None:
    """Two parts alike but for a number by which a function's loop ends: they had the equations of the first."""
    (tmp_path / "P.mo").write_text(SUMS)
    run = ac.simulate(ac.compile(ac.load(tmp_path / "P.mo", "P.Two")), 1.0)
    assert [run["p.x"][-1], run["q.x"][-1]] == [1 + 2, 1 + 2 + 3]


def test_a_parameter_that_has_decided_a_size_stays(tmp_path: Path) -> None:
    (tmp_path / "P.mo").write_text(SUMS)
    model = ac.load(tmp_path / "P.mo", "P.Sizes")
    model.modify(a=0.31)  # decides the same
    with pytest.raises(ac.ModelError, match=r"'a' decided .* was 3.* 5.*Sizes\(a=...\)"):
        model.modify(a=0.5)
    assert ac.compile(model).parameters()["a"] == 0.31
    larger = ac.import_modelica(tmp_path / "P.mo").Sizes(a=0.5)
    assert len(ac.compile(larger).states) == 5


def test_a_function_too_large_for_an_expression_is_a_number(tmp_path: Path) -> None:
    """The exponential function of a matrix, by its series until nothing changes."""
    (tmp_path / "M.mo").write_text("""
      model M
        function series
          input Real A[:, size(A, 1)];
          output Real sum[size(A, 1), size(A, 1)] = identity(size(A, 1));
        protected
          Real term[size(A, 1), size(A, 1)] = identity(size(A, 1));
          Integer i = 1;
        algorithm
          while max(abs(term)) > 1e-18 loop
            term := term*A/i;
            sum := sum + term;
            i := i + 1;
          end while;
        end series;
        parameter Real A[2, 2] = {{-1, 0.2}, {0.3, -2}};
        Real x[2](each start = 1, each fixed = true);
      equation
        der(x) = series(A)*x;
      end M;""")
    with pytest.warns(UserWarning, match=r"column 18: series has no expression .* follow 'A'"):
        model = ac.load(tmp_path / "M.mo")
    system = ac.compile(model)
    found = system.vector_field(0.0, np.ones(2), None, system.parameters())
    np.testing.assert_allclose(found, expm([[-1, 0.2], [0.3, -2]]) @ [1, 1], rtol=1e-12)
    with pytest.raises(ac.ModelError, match="'A' decided"):
        model.modify(A=[[-1.0, 0.2], [0.3, -3.0]])


@pytest.mark.slow
def test_elements_of_discrete_arrays_start_by_their_initial_equations(tmp_path: Path) -> None:
    (tmp_path / "D.mo").write_text("""
      model D
        discrete Real a[2];
        Integer k[3];
      initial equation
        pre(a[2]) = 3;
        pre(a[1]) = 1;
        pre(k) = {4, 5, 6};
      equation
        when sample(0.5, 0.5) then
          for i in 1:2 loop a[i] = pre(a[i]) + 1; end for;
          for i in 1:3 loop k[i] = pre(k[i]) + i; end for;
        end when;
      end D;""")
    run = ac.simulate(ac.compile(ac.load(tmp_path / "D.mo")), 0.7, dt=0.1)
    ends = {name: [float(run[name][i]) for i in (0, -1)] for name in ("a[1]", "a[2]", "k[3]")}
    assert ends == {"a[1]": [1, 2], "a[2]": [3, 4], "k[3]": [6, 9]}


def test_functions_compare_numbers_by_equality(tmp_path: Path) -> None:
    """In a model nothing could watch for it; a function has no events."""
    (tmp_path / "M.mo").write_text("""
      model M
        function inverse "of all numbers but zero"
          input Real u;
          output Real y;
        algorithm
          if u <> 0 then y := 1/u; else y := 0; end if;
        end inverse;
        Real x(start = 1, fixed = true), y, z;
      equation
        der(x) = -x;
        y = inverse(x);
        z = inverse(max(0, -x));
      end M;""")
    run = ac.simulate(ac.compile(ac.load(tmp_path / "M.mo")), 1.0, dt=0.01)
    assert run["y"][-1] == pytest.approx(np.e)
    assert run["z"][-1] == 0


def test_an_array_of_unlike_units_has_none(tmp_path: Path) -> None:
    (tmp_path / "M.mo").write_text("""
      model M
        Modelica.Blocks.Interfaces.RealOutput r[2](final unit = {"m", "rad"});
        Modelica.Blocks.Interfaces.RealOutput v[2](final unit = {"m/s", "m/s"});
      equation
        r = {time, 2*time};
        v = {1, 2};
      end M;""")
    system = ac.compile(ac.load(tmp_path / "M.mo"))
    assert [system.unit(name) for name in ("r[1]", "v[2]")] == ["", "m/s"]
