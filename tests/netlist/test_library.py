"""Libraries: how names in files find classes, and only these."""

import subprocess
import sys
import types
from typing import Any

import pytest

import acausal as ac
from acausal import components
from acausal.components import fluid, neural as nn, thermal, translational as tl
from acausal.netlist import library
from acausal.netlist.library import Library

MSL = Library(components)


@pytest.mark.parametrize(
    ("name", "cls"),
    [
        ("Modelica.Mechanics.Translational.Components.Mass", tl.Mass),
        ("Modelica.Mechanics.Translational.Interfaces.Flange_b", tl.Flange),
        (
            "Modelica.Thermal.HeatTransfer.Celsius.FixedTemperature",
            thermal.celsius.FixedTemperature,
        ),
        ("Modelica.Thermal.HeatTransfer.Sources.FixedTemperature", thermal.FixedTemperature),
        ("Modelica.Blocks.Interfaces.RealInput", ac.Input),
        ("acausal.components.translational.Mass", tl.Mass),
        ("acausal.components.translational.components.Mass", tl.Mass),
        ("acausal.components.neural.Compliance", nn.Compliance),
    ],
)
def test_names_find_classes(name: str, cls: Any) -> None:
    assert MSL.find(name) is cls


@pytest.mark.parametrize(
    "name",
    [
        "",
        ".",
        "os.system",
        "Mass",
        "acausal.Component",
        "acausal.components",
        "acausal.components.translational",
        "acausal.components.laws.coulomb",
        "acausal.components.laws.ac.Component",
        "acausal.components.translational.components.ac.compile",
        "acausal.components.translational.Mass.equations",
        "acausal.components.translational.Mass.__init__",
        "acausal.components.__builtins__",
        "acausal.components.import_module",
        "acausal.components.modelica.MODELICA",
        "acausal.components.blocks.filters._Pair",
        "Modelica.Mechanics.Translational.Components.Vehicle.x",
    ],
)
def test_other_names_find_nothing(name: str) -> None:
    assert MSL.find(name) is None
    with pytest.raises(KeyError):
        library.find_class((MSL,), name)


def test_hints() -> None:
    def hint(name: str) -> str:
        with pytest.raises(KeyError) as caught:
            library.find_class((MSL,), name)
        return str(caught.value.args[0])

    assert "'Modelica.Mechanics.Translational.Components.Spring'?" in hint(
        "Modelica.Mechanics.Translational.Components.Spirng"
    )
    assert "'Modelica.Mechanics.Rotational.Components.Inertia'?" in hint(
        "Modelica.Mechanics.Rotational.Inertia"
    )
    assert "does not cover it yet" in hint("Modelica.Electrical.Analog.Lines.TLine2")
    assert "name it as Modelica does, or by its Python path within a library" in hint("os.system")


def test_names_of_classes() -> None:
    assert MSL.name_of(tl.Mass) == "Modelica.Mechanics.Translational.Components.Mass"
    assert MSL.name_of(tl.Flange) == "Modelica.Mechanics.Translational.Interfaces.Flange"
    assert MSL.name_of(nn.Resistance) == "acausal.components.neural.Resistance"
    assert MSL.name_of(tl.IdealGear) == "acausal.components.translational.IdealGear"

    class Local(ac.Component):
        pass

    assert MSL.name_of(Local) is None


def test_constants() -> None:
    assert MSL.constant("Modelica.Thermal.FluidHeatFlow.Media.Water()") == fluid.Water()
    assert MSL.constant("FluidHeatFlow.Media.Medium()") == fluid.Medium()
    assert MSL.constant("Modelica.Electrical.Machines.Thermal.Constants.alpha20Copper") == 3.92e-3
    assert MSL.constant("Modelica.Blocks.Types.Init.SteadyState") == "SteadyState"
    assert MSL.constant("StateSelect.prefer") == "prefer"
    assert MSL.constant("Types.Unknown.SteadyState") is None
    assert MSL.constant("water") is None


def test_records_have_names() -> None:
    assert MSL.constant_name(fluid.Water()) == "Water()"
    assert MSL.constant_name(fluid.Water(rho=990.0, lambda_=0.5)) == "Water(rho=990.0, lambda=0.5)"
    assert MSL.constant_name(object()) is None


def test_every_name_of_modelica_finds_a_component_a_connector_or_a_signal() -> None:
    for name, path in MSL.modelica_names.items():
        cls = MSL.find(name)
        assert issubclass(cls, ac.Component | ac.Connector) or cls in (ac.Input, ac.Output), name
        assert path.startswith("acausal.components."), name
        assert not MSL.lacks(name), name


@pytest.mark.slow
def test_a_name_of_modelica_imports_its_own_package_only() -> None:
    program = """if True:
        import sys
        from acausal import components
        from acausal.netlist import Library
        assert Library(components).find("Modelica.Thermal.HeatTransfer.Components.HeatCapacitor")
        loaded = (n.split(".") for n in sys.modules if n.startswith("acausal.components."))
        print(*sorted({words[2] for words in loaded} & set(components.PACKAGES)))
        """
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["thermal"]


def test_two_classes_of_modelica_may_be_one_here() -> None:
    rotational = "Modelica.Mechanics.Rotational.Components.IdealGearR2T"
    translational = "Modelica.Mechanics.Translational.Components.IdealGearR2T"
    assert MSL.find(rotational) is MSL.find(translational) is tl.IdealGearR2T
    assert MSL.name_of(tl.IdealGearR2T) == rotational


def test_the_library_is_announced() -> None:
    assert [known.module.__name__ for known in library.installed()] == ["acausal.components"]


def test_a_users_library(monkeypatch: pytest.MonkeyPatch) -> None:
    class CubicSpring(tl.PartialCompliant):
        k = ac.Parameter(unit="N/m3")

    module = types.ModuleType("springs")
    monkeypatch.setitem(sys.modules, "springs", module)
    CubicSpring.__module__, CubicSpring.__qualname__ = "springs", "CubicSpring"
    module.__dict__.update(CubicSpring=CubicSpring, MODELICA_NAMES={"Mine.Cubic": "CubicSpring"})
    mine = Library(module)
    assert mine.find("springs.CubicSpring") is CubicSpring
    assert mine.find("Mine.Cubic") is CubicSpring
    assert mine.name_of(CubicSpring) == "Mine.Cubic"
    assert mine.constant("Water()") is None
    module.__dict__.update(RECORDS={"Oil": fluid.MineralOil()})
    assert Library(module).constant("My.Oil()") == fluid.MineralOil()


def test_importing_the_library_is_cheap() -> None:
    assert components.__getattr__("blocks").__name__ == "acausal.components.blocks"
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = components.nonsense  # type: ignore[attr-defined]
