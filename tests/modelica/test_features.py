"""What libraries use: connectors in connectors, ``inner`` and ``outer``, enumerations, records in functions."""

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac

FILE = Path(__file__).with_name("Features.mo")
START = {
    "plugged.w.c.v[1]": 1.0,
    "plugged.w.c.v[2]": 2.0,
    "named.p.x": 1.0,
    "named.q.x": 1.0,
    "bundled.store.T[1]": 1.0,
    "bundled.store.T[2]": 2.0,
}


@pytest.fixture(scope="module")
def model() -> Any:
    return ac.load(FILE, "Features.All")


@pytest.fixture(scope="module")
def system(model: Any) -> ac.System:
    return ac.compile(model)


def test_states_move_as_their_equations_say(system: ac.System) -> None:
    x = [START[name] for name in system.states]
    found = np.asarray(system.vector_field(0.5, x, None, system.parameters()))
    wanted = {
        # capacitors of 1 F over resistors of 1 and 2 ohm, through the plug of a composite, times a signal in the plug
        "plugged.w.c.v[1]": -2.5 * 1,
        "plugged.w.c.v[2]": -2.5 * 2 / 2,
        # two losses at a store of 2 J/K: vectors, and a connector within
        "bundled.store.T[1]": -(1 + 1) * 1 / 2,
        "bundled.store.T[2]": -(2 + 2) * 2 / 2,
        # records: p has a = 1, b = 3, c = 0.5; q has a = 4, b = 12; doubled by a function
        "named.p.x": -(2 * 1 + 3 + 0.5 + 1),
        "named.q.x": -(2 * 4 + 12 + 7 + 1),
    }
    assert dict(zip(system.states, found, strict=True)) == pytest.approx(wanted)


def test_a_copy_moves_in_the_same_way(model: Any, system: ac.System) -> None:
    assert [str(e) for e in ac.compile(copy.deepcopy(model)).equations] == [
        str(e) for e in system.equations
    ]


def test_how_often_a_connector_is_connected(model: Any) -> None:
    assert "n = 2" in [str(e).rpartition("plugged.r.")[2] for e in model.plugged.r.equations()]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("t", "expected"),
    [
        (0.5, {"x": 10, "n": 1, "found": 0, "y": 4, "any": 0, "all": 0}),
        (1.2, {"x": 20, "n": 2, "found": 3, "y": 9.6, "any": 1, "all": 0}),
        (1.6, {"x": 20, "n": 2, "found": 2, "y": 12.8, "any": 1, "all": 0}),
        (3.5, {"x": 30, "n": 3, "found": 1, "y": 10, "any": 1, "all": 1}),
    ],
)
def test_choices_of_a_model_that_runs(running: ac.Solution, t: float, expected: Any) -> None:
    i = int(np.argmin(np.abs(np.asarray(running.t) - t)))
    found = {name: float(running[f"choices.{name}"][i]) for name in expected}
    assert found == pytest.approx(expected)
    assert float(running["choices.top"][i]) == 30
    middle = [float(running[f"choices.watch.{name}"][i]) for name in ("middle", "outside")]
    assert middle == [expected["n"] == 2, expected["n"] != 2]


def test_texts_decide_what_is_known_when_the_model_is_built() -> None:
    assert ac.load(FILE, "Features.Choices")._node.modifiers["turns"] == 3


@pytest.mark.slow
def test_signals_are_passed_on_by_connections(running: ac.Solution) -> None:
    assert np.asarray(running["passing.on"]).tolist() == [0, 0, 1, 1, 1]
    assert np.allclose(running["passing.twice"], 6)


@pytest.mark.slow
def test_inner_parts_reach_all_that_is_within(running: ac.Solution) -> None:
    t = np.asarray(running.t)
    y = 2 * t + np.where(t < 0.5, 1.5 * t**2, 1.5 * 0.25)  # the wind ends at 0.5 s
    for name in ("a.y", "d.body.y"):
        assert np.allclose(running[f"surrounded.{name}"], y, atol=1e-5)
    filled = 5 + 2 * (t**2 + np.where(t < 0.5, t**3 / 2, 1.5 * 0.25 * t - 0.125))
    assert np.allclose(running["surrounded.tank.x"], filled, atol=1e-4)


@pytest.fixture(scope="module")
def running() -> ac.Solution:
    system = ac.compile(ac.load(FILE, "Features.Running"))
    return ac.simulate(system, (0.0, 4.0), saveat=[0.25, 0.5, 1.2, 1.6, 3.5], rtol=1e-8, atol=1e-10)


def test_elements_of_a_parameter_decide_a_table() -> None:
    system = ac.compile(ac.load(FILE, "Features.Tabled"))
    assert float(system.observe("table.y[1]", 0.0, [], None, system.parameters())) == 3


def test_the_text_of_an_interface_is_read_where_the_library_lacks_its_members(
    tmp_path: Path,
) -> None:
    (tmp_path / "Modelica").mkdir()
    (
        tmp_path / "Modelica" / "package.mo"
    ).write_text("""package Modelica package Blocks package Interfaces
        connector RealInput = input Real; connector RealOutput = output Real;
        partial block MIMO
          parameter Integer nin = 1, nout = 1; RealInput u[nin]; RealOutput y[nout];
        end MIMO;
      end Interfaces; end Blocks; end Modelica;""")
    text = """model M extends Modelica.Blocks.Interfaces.MIMO(final nin = 3, nout = 2);
      equation y = {u[1] + u[2], u[3]}; end M;"""
    (tmp_path / "user.mo").write_text(text)
    system = ac.compile(ac.load(tmp_path / "user.mo"))
    assert (system.inputs, system.outputs) == (("u[1]", "u[2]", "u[3]"), ("y[1]", "y[2]"))


def test_a_class_is_found_without_reading_all_others(tmp_path: Path) -> None:
    (tmp_path / "P").mkdir()
    (tmp_path / "P" / "package.mo").write_text("package P end P;")
    (tmp_path / "P" / "A.mo").write_text("within P; model A Real x = 1; end A;")
    (tmp_path / "P" / "Other.mo").write_text("within P; this is no Modelica")
    assert type(ac.load(tmp_path / "P", "P.A")).__name__ == "A"


def test_a_variable_that_is_given_loses_the_equation_of_its_class(tmp_path: Path) -> None:
    file = tmp_path / "Tube.mo"
    file.write_text("""
        model Tube "the length of the tube is not that of the motion"
          import Modelica.Magnetic.FluxTubes.*;
          Shapes.Force.HollowCylinderAxialFlux tube(l = 0.01 + tube.flange.s/2, r_o = 0.02, mu_r = 1);
          Sources.ConstantMagneticPotentialDifference source(V_m = 100);
          Basic.Ground ground;
          Modelica.Mechanics.Translational.Components.Fixed fixed(s0 = 0.006);
        equation
          connect(source.port_p, tube.port_p);
          connect(source.port_n, tube.port_n);
          connect(source.port_n, ground.port);
          connect(tube.flange, fixed.flange);
        end Tube;
    """)
    system = ac.compile(ac.load(file))
    assert float(ac.simulate(system, 1, dt=1.0)["tube.l"][0]) == pytest.approx(0.013)


def test_an_array_of_parameters_that_initial_equations_determine(tmp_path: Path) -> None:
    file = tmp_path / "Found.mo"
    file.write_text("""
        model Found
          parameter Real k[2](each fixed = false, start = {1, 2});
          Real x[2](each start = 3, each fixed = true);
        initial equation
          k[1]^2 = 4;
          k[1] + k[2] = 7;
        equation
          der(x) = -k .* x;
        end Found;
    """)
    run = ac.simulate(ac.compile(ac.load(file)), 0.1, dt=0.05)
    assert [float(run[f"k[{i}]"][-1]) for i in (1, 2)] == pytest.approx([2, 5])
    assert float(run["x[2]"][-1]) == pytest.approx(3 * np.exp(-0.5), rel=1e-4)


@pytest.mark.slow
def test_what_discrete_variables_are_before_the_start(tmp_path: Path) -> None:
    """A step is active from the start until half a second; a block counts how often its level changes."""
    file = tmp_path / "Steps.mo"
    file.write_text("""
        package Steps
          partial block Step
            Boolean local, next;
            discrete Real never(start = 3);
          initial equation
            pre(next) = pre(local);
          equation
            local = pre(next);
            next = local and time < 0.5;
            when false then
              never = 4;
            end when;
          end Step;
          block First
            output Boolean active;
            extends Step;
          initial equation
            active = true;
          equation
            active = local;
          end First;
          block Counter
            Modelica.Blocks.Interfaces.IntegerInput level(start = 7, fixed = true);
            Integer n(start = 0, fixed = true);
          equation
            when change(level) then
              n = pre(n) + 1;
            end when;
          end Counter;
          model All
            First first;
            Counter counter(level = if first.active then 1 elseif time < 0.7 then 2 else 5);
          end All;
        end Steps;
    """)
    run = ac.simulate(ac.compile(ac.load(file, "Steps.All")), 1, saveat=[0.0, 0.4, 0.6, 1.0])
    assert run["first.active"].tolist() == [1, 1, 0, 0]
    assert run["first.never"].tolist() == [3] * 4
    assert (run["counter.n"] - run["counter.n"][0]).tolist() == [0, 0, 1, 2]


@pytest.mark.slow
def test_what_is_inner_and_outer_passes_on_something_else(tmp_path: Path) -> None:
    """Within a level its surroundings are twice those around it; a port that nobody connects is off."""
    file = tmp_path / "Levels.mo"
    file.write_text("""
        package Levels
          model Surroundings
            output Boolean warm;
            output Boolean said;
            Real T;
          equation
            warm = said;
          end Surroundings;
          model Leaf
            outer Surroundings s;
            Real T = s.T;
            discrete Real n(start = 0, fixed = true);
          equation
            when s.said then
              n = pre(n) + 1;
            end when;
          end Leaf;
          connector Port
            input Boolean on;
          end Port;
          model Level
            inner outer Surroundings s(T = 2*outside, warm = outside > 4 or port.on);
            Real outside = s.T;
            Leaf leaf;
            Port port;
          equation
            if cardinality(port) == 0 then
              port.on = false;
            end if;
          end Level;
          model All
            inner Surroundings s(T = 3 + 2*time, warm = false);
            Leaf leaf;
            Level level;
          end All;
        end Levels;
    """)
    run = ac.simulate(ac.compile(ac.load(file, "Levels.All")), 1, saveat=[0.0, 1.0])
    assert [float(run[n][-1]) for n in ("leaf.T", "level.leaf.T")] == pytest.approx([5, 10])
    assert [float(run[n][-1]) for n in ("leaf.n", "level.leaf.n")] == [0, 1]


@pytest.mark.slow
def test_an_algorithm_that_chooses_again_and_again_stays_small(tmp_path: Path) -> None:
    """Each choice reads what the one before has made: as one expression it would have 2^16 cases."""
    file = tmp_path / "Choices.mo"
    file.write_text("""
        model Choices
          Integer n;
        algorithm
          n := if time < 0.5 then 0 else 3;
          for i in 1:16 loop
            if n == 2*i or n == 5 then
              n := n + 2;
            else
              n := n + 1;
            end if;
          end for;
        end Choices;
    """)

    def chosen(n: int) -> int:
        for i in range(1, 17):
            n += 2 if n in (2 * i, 5) else 1
        return n

    run = ac.simulate(ac.compile(ac.load(file)), 1, saveat=[0.0, 1.0])
    assert run["n"].tolist() == [chosen(0), chosen(3)]


@pytest.mark.slow
def test_outputs_of_the_librarys_interfaces_may_change_at_events(tmp_path: Path) -> None:
    path = tmp_path / "sampled.mo"
    path.write_text(
        """package Sampled
          block Hold extends Modelica.Blocks.Interfaces.SISO;
            equation when sample(0, 0.1) then y = 2*u; end when; end Hold;
          block Steps extends Modelica.Blocks.Interfaces.SO(y(start = 3)); input Real u;
            equation when u > 0.5 then y = pre(y) + u; elsewhen u > 0.8 then y = 10; end when; end Steps;
          block Count extends Modelica.Blocks.Interfaces.MO(nout = 2);
            algorithm when sample(0.15, 0.1) then y[1] := time; y[2] := pre(y[2]) + 1; end when; end Count;
          block Mix extends Modelica.Blocks.Interfaces.MIMO(nin = 2, nout = 3);
            equation y[1] = u[1] + u[2]; y[2] = u[1] - u[2]; y[3] = Modelica.Math.Vectors.norm(u, 2); end Mix;
          model All
            Hold hold(u = time); Steps steps(u = time); Count count; Mix mix(u = {3*time, 4*time});
            Real x(start = 0, fixed = true);
          equation
            der(x) = hold.y;
          end All;
        end Sampled;"""
    )
    end = ac.simulate(ac.compile(ac.load(path, "Sampled.All")), 1.0)
    wanted = {
        "x": 2 * 0.1 * sum(0.1 * k for k in range(10)),
        "steps.y": 10, "count.y[1]": 0.95, "count.y[2]": 9, "mix.y[1]": 7, "mix.y[2]": -1, "mix.y[3]": 5,
    }  # fmt: skip
    assert {name: float(end[name][-1]) for name in wanted} == pytest.approx(wanted)
    at = ac.simulate(ac.compile(ac.load(path, "Sampled.All")), 0.7)
    assert float(at["steps.y"][-1]) == pytest.approx(3.5)


@pytest.mark.slow
def test_quotients_of_integers_are_exact(tmp_path: Path) -> None:
    """Rounded quotients of the expanded expressions were a whole off wherever one divides the other."""
    file = tmp_path / "Quotients.mo"
    file.write_text("""
        model Quotients
          parameter Integer n = 3;
          Integer k(start = 0, fixed = true), m, d, r, away, held(start = 0);
        equation
          when sample(0.5, 0.5) then
            k = pre(k) + 1;
            held = mod(2*k - 5, 7);
          end when;
          m = mod(5 - 2*k, n);
          d = div(5 - 2*k, 3);
          r = rem(5 - 2*k, 3);
          away = mod(k - 7, -n);
        end Quotients;
    """)
    run = ac.simulate(ac.compile(ac.load(file)), 15.0, saveat=np.arange(0.25, 15, 0.5))
    k = np.arange(30)
    expected = {
        "m": np.mod(5 - 2 * k, 3),
        "d": np.trunc((5 - 2 * k) / 3),
        "r": np.fmod(5 - 2 * k, 3),
        "away": np.mod(k - 7, -3),
        "held": np.where(k > 0, np.mod(2 * k - 5, 7), 0),
    }
    for name, values in expected.items():
        assert run[name].tolist() == values.tolist(), name
