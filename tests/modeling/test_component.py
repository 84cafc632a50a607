"""Declaring, modifying and connecting components; and what is refused, each with place and mend."""

import math
import re

import numpy as np
import pytest

import acausal as ac
from acausal.components import translational
from tests.support.parts import Fixed, Flange, Mass, Model, Pin, Resistor, SpringDamper


class Device(ac.Component):
    mode = ac.Option("linear", choices=("linear", "cubic"))
    useSupport = ac.Option(False)
    gain = ac.Parameter(1.0, min=0, max=10, unit="N/m")
    table = ac.Parameter([0.0, 1.0], shape=":")
    matrix = ac.Parameter(0.0, shape=(2, 2))
    flange = Flange()
    support = Flange(when="useSupport")
    ground = ac.Variable(when="not useSupport")
    x = ac.Variable(unit="m")
    u = ac.Input()
    y = ac.Output()
    law = ac.Module(lambda key: abs)


def declared(component):
    return [name for name, _ in component._node.declarations()]


# -- what works ---------------------------------------------------------------------------------------


def test_a_path_leads_through_parts_and_lists():
    model = Model()
    model.box = Model()
    model.box.masses = [Mass(m=1.0), Mass(m=2.0)]
    model.box.grid = [[Mass(m=1.0)], [Mass(m=2.0)]]
    assert model.box.masses[1]._node.path == "box.masses[2]"
    assert model.box.grid[1][0]._node.path == "box.grid[2,1]"
    assert repr(model.box.masses[0]).startswith("Mass 'box.masses[1]'")
    assert repr(model.box.masses[0].flange_a) == "box.masses[1].flange_a (Flange)"


def test_options_decide_what_exists():
    assert "support" not in declared(Device())
    assert "ground" in declared(Device())
    assert "support" in declared(Device(useSupport=True))
    assert "ground" not in declared(Device(useSupport=True))


def test_a_subclass_extends_overrides_and_removes():
    class Special(Device):
        gain = ac.Parameter(5.0)
        extra = ac.Variable()
        law = None

    assert Special.gain.default == 5.0
    assert "extra" in declared(Special())
    assert "law" not in declared(Special())
    assert list(Device._declared)[:3] == ["mode", "useSupport", "gain"]


def test_assigning_a_declared_name_modifies_it():
    device = Device()
    device.gain = 3
    device.mode = "cubic"
    device.x = ac.Start(2.0, fixed=True)
    assert device._node.modifiers["gain"] == 3.0
    assert device.mode == "cubic"
    assert device._node.modifiers["x"].fixed


def test_a_later_start_keeps_what_it_leaves_open():
    device = Device(x=ac.Start(2.0, fixed=True, nominal=5.0))
    device.modify(x=ac.Start(state="prefer"))
    start = device._node.modifiers["x"]
    assert (start.value, start.fixed, start.nominal, start.state) == (2.0, True, 5.0, "prefer")


def test_modifiers_reach_into_parts_also_before_they_exist():
    class Box(ac.Component):
        def __init__(self, **modifiers):
            super().__init__(**modifiers)
            self.mass = Mass(m=1.0)

    assert Box(mass={"m": 4.0}).mass._node.modifiers["m"] == 4.0
    box = Box()
    box.modify(mass={"m": 5.0})
    assert box.mass._node.modifiers["m"] == 5.0


def test_a_connectors_variables_take_starts():
    device = Device(flange={"s": ac.Start(1.0)})
    assert device._node.modifiers["flange.s"].value == 1.0


def test_declarations_may_be_made_on_the_instance():
    class Sum(ac.Component):
        def __init__(self, n):
            super().__init__()
            self.u = [ac.Input() for _ in range(n)]
            self.y = ac.Output()

    total = Sum(3)
    assert [r.path for r in total.u] == ["u[1]", "u[2]", "u[3]"]
    assert declared(total) == ["u[1]", "u[2]", "u[3]", "y"]


def test_signals_connect_element_by_element_in_any_shape():
    class Bus(ac.Component):
        u = ac.Input(shape=(2, 2))
        y = ac.Output(shape=(2, 2))

    model = Model()
    model.a, model.b = Bus(), Bus()
    model.connect(model.a.y, model.b.u)
    assert len(model._node.connections) == 4


def test_a_node_knows_its_place():
    model = Model()
    model.box = Model()
    model.box.mass = Mass(m=1.0)
    mass, other = model.box.mass._node, Model()
    assert mass.route_from(model._node) == ("box", "mass")
    assert mass.route_from(mass) == ()
    assert mass.route_from(other._node) is None
    assert [n.label for n in mass.ancestors()] == ["Model 'box'", "Model"]


def test_connecting_three_makes_a_node_of_three():
    model = Model()
    model.a, model.b, model.c = Mass(m=1.0), Mass(m=1.0), Mass(m=1.0)
    model.connect(model.a.flange_b, model.b.flange_a, model.c.flange_a)
    assert len(model._node.connections) == 2


def test_attributes_that_are_no_declarations_stay_the_authors():
    device = Device()
    device.note = "anything"
    device._hidden = [1, 2]
    assert (device.note, device._hidden) == ("anything", [1, 2])


# -- what is refused ------------------------------------------------------------------------------------


def refused(error, *told):
    """A context that expects an error whose message says all of this."""
    return pytest.raises(error, match=".*".join(re.escape(t) for t in told))


@pytest.mark.parametrize(
    ("modifiers", "told"),
    [
        ({"gian": 1.0}, ("Device has no 'gian'", "did you mean 'gain'?")),
        ({"gain": "three"}, ("Device.gain='three'", "a number or an expression")),
        ({"gain": "3"}, ("Device.gain='3'", "a number or an expression")),
        ({"gain": math.nan}, ("Device.gain=nan", "finite")),
        ({"gain": math.inf}, ("Device.gain=inf", "finite")),
        ({"gain": -1.0}, ("Device.gain=-1 is out of range", "at least 0 N/m")),
        ({"gain": 11.0}, ("Device.gain=11 is out of range", "at most 10 N/m")),
        ({"mode": "cubik"}, ("Device.mode='cubik'", "'linear', 'cubic'")),
        ({"useSupport": 1}, ("Device.useSupport=1", "True or False")),
        ({"x": 3.0}, ("Device.x is a variable", "ac.Start(3.0)")),
        ({"x": ac.Start("a")}, ("Device.x", "a start is a finite number, got 'a'")),
        ({"x": ac.Start(math.nan)}, ("Device.x", "a start is a finite number, got nan")),
        ({"x": {"val": 1.0}}, ("Device.x", "a start has value, fixed, nominal and state")),
        ({"flange": 3.0}, ("Device.flange is a connector",)),
        ({"flange": {"t": ac.Start(1.0)}}, ("Device.flange has no 't'", "'s'")),
        ({"law": 3.0}, ("Device.law needs a module",)),
        ({"table": [1.0, "b"]}, ("Device.table[2]='b'",)),
        ({"table": [1.0, math.nan]}, ("Device.table[2]=nan",)),
    ],
)
def test_a_wrong_modifier_is_refused(modifiers, told):
    with refused(ac.DeclarationError, *told):
        Device(**modifiers)


def test_an_unknown_part_in_the_modifiers_is_told_when_the_model_is_complete():
    with refused(ac.DeclarationError, "Model has no 'bodi'", "did you mean 'body'?"):
        model = Model(bodi={"m": 1.0})
        model.body = Mass(m=1.0)
        ac.compile(model)


def test_a_start_may_contain_parameters_only():
    device = Device()
    device.x = ac.Start(device.gain * 2)
    with refused(ac.DeclarationError, "only parameters may stand in a start, got y"):
        device.x = ac.Start(device.y)


def test_a_parameter_may_contain_parameters_only():
    device = Device()
    with refused(ac.DeclarationError, "only parameters may stand in a parameter's value"):
        device.gain = device.x * 2


def test_names_are_unique():
    model = Model()
    model.a = Mass(m=1.0)
    with refused(ac.DeclarationError, "Model has a 'a' already"):
        model.a = Mass(m=1.0)
    with refused(ac.DeclarationError, "Model has a 'a' already"):
        model.a = 3.0


def test_names_do_not_hide_what_the_framework_needs():
    model = Model()
    with refused(ac.DeclarationError, "'connect' is an attribute of class Model"):
        model.connect = Mass(m=1.0)
    with refused(
        ac.DeclarationError,
        "'equations' is an attribute of class Model; define it: def equations(self)",
    ):
        model.equations = 3.0
    with refused(ac.DeclarationError, "'time' is the time"):
        model.time = ac.Parameter(1.0)
    with refused(ac.DeclarationError, "'modify' is an attribute of every component"):
        type("Bad", (ac.Component,), {"modify": ac.Variable()})
    with refused(ac.DeclarationError, "'time' is the time"):
        type("Bad", (ac.Component,), {"time": ac.Variable()})


def test_a_name_is_an_identifier():
    with refused(ac.DeclarationError, "'a.b' is not a name for a part"):
        setattr(Model(), "a.b", Mass(m=1.0))


def test_one_declaration_has_one_name():
    shared = ac.Variable()
    with refused(ac.DeclarationError, "'a' and 'b' are one declaration"):
        type("Bad", (ac.Component,), {"a": shared, "b": shared})


def test_a_part_belongs_to_one_component():
    model = Model()
    mass = Mass(m=1.0)
    model.a = mass
    with refused(ac.DeclarationError, "'b': this Mass is already 'a'", "make a second one"):
        model.b = mass


def test_a_component_does_not_contain_itself():
    outer, inner = Model(), Model()
    outer.inner = inner
    with refused(ac.DeclarationError, "'outer': a component cannot contain itself"):
        inner.outer = outer


def test_parts_are_made_in_init():
    with refused(ac.DeclarationError, "Bad.mass: a part is made in __init__"):
        type("Bad", (ac.Component,), {"mass": Mass(m=1.0)})


@pytest.mark.parametrize("holder", [{"a": Mass(m=1.0)}, [1, Mass(m=1.0)], {Mass(m=1.0)}])
def test_parts_hidden_in_a_collection_are_told(holder):
    model = Model()
    model.parts = holder
    with refused(ac.DeclarationError, "Model.parts holds components that are not part"):
        ac.compile(model)


def test_parts_appended_later_are_told():
    model = Model()
    model.parts = []
    model.parts.append(Mass(m=1.0))
    with refused(ac.DeclarationError, "Model.parts holds components that are not part"):
        ac.compile(model)


def test_what_an_option_excludes_cannot_be_read():
    with refused(ac.DeclarationError, "Device.support exists only with useSupport=True"):
        _ = Device().support
    with refused(ac.DeclarationError, "Device.ground exists only with useSupport=False"):
        _ = Device(useSupport=True).ground


def test_a_connector_holds_variables_only():
    for made in (ac.Parameter(1.0), ac.Input(), ac.Output(), Flange()):
        with refused(ac.DeclarationError, "Bad.k: a connector is made of Potential, Flow"):
            type("Bad", (ac.Connector,), {"k": made})
    with refused(ac.DeclarationError, "connector class Bad declares no variables"):
        type("Bad", (ac.Connector,), {})()
    with refused(ac.DeclarationError, "the sizes of a connector's variables are integers"):
        type("Bad", (ac.Connector,), {"r": ac.Potential(shape="n")})


def test_a_connector_outside_of_a_component_has_no_variables():
    with refused(ac.DeclarationError, "connector class Flange is used outside of a component"):
        _ = Flange().s


class Meeting(ac.Component):
    """A place for connections to be refused."""

    def __init__(self):
        super().__init__()
        self.mass, self.spring = Mass(m=1.0), SpringDamper(c=1.0, d=1.0)
        self.resistor, self.device = Resistor(R=1.0), Device()


@pytest.mark.parametrize(
    ("ends", "told"),
    [
        (
            lambda m: (m.mass.flange_a, m.resistor.p),
            ("unlike connectors", "mass.flange_a (Flange)", "resistor.p (Pin)", "one domain"),
        ),
        (lambda m: (m.mass.flange_a, m.mass.flange_a), ("mass.flange_a", "to itself")),
        (lambda m: (m.mass.flange_a,), ("at least two connectors, got 1",)),
        (lambda m: (m.mass.flange_a, m.mass), ("'mass'", "is not a connector")),
        (lambda m: ("mass.flange_a", "spring.flange_a"), ("'mass.flange_a' is not a connector",)),
        (lambda m: (m.mass.flange_a, m.mass.s), ("mass.s is not a connector",)),
        (lambda m: (m.mass.flange_a, m.device.u), ("unlike connectors", "device.u", "signal")),
        (lambda m: ((m.device.u,), ()), ("device.u, ...] has 1", "an empty vector has 0")),
    ],
)
def test_a_wrong_connection_is_refused(ends, told):
    model = Meeting()
    with refused(ac.ConnectionError, *told):
        model.connect(*ends(model))


def test_unlike_units_make_unlike_connectors():
    class Angular(ac.Connector):
        s = ac.Potential(unit="rad")
        f = ac.Flow(unit="N.m")

    class Shaft(ac.Component):
        flange_a = Angular()

    model = Model()
    model.mass, model.shaft = Mass(m=1.0), Shaft()
    with refused(ac.ConnectionError, "unlike connectors"):
        model.connect(model.mass.flange_a, model.shaft.flange_a)


def test_a_connector_of_a_foreign_component_is_told():
    model = Model()
    model.mass = Mass(m=1.0)
    stranger = Fixed()
    model.connect(model.mass.flange_a, stranger.flange)
    with refused(ac.ConnectionError, "flange", "not part of the model", "attribute"):
        ac.compile(model)


def test_connectors_of_one_class_are_of_one_kind():
    assert Pin.kind() != Flange.kind()
    assert (Flange.potential(), Flange.flow()) == ("s", "f")


def test_vector_variables_of_connectors():
    class Frame(ac.Connector):
        r = ac.Potential(shape=2)
        f = ac.Flow(shape=2)

    class Body(ac.Component):
        frame = Frame()

    assert [r.path for r in Body().frame.r] == ["frame.r[1]", "frame.r[2]"]
    assert list(Frame.declarations) == ["r[1]", "r[2]", "f[1]", "f[2]"]


def test_numbers_of_numpy_are_numbers():
    assert Device(gain=np.float32(2.0))._node.modifiers["gain"] == 2.0
    assert Device(matrix=np.eye(2))._node.modifiers["matrix"].shape == (2, 2)


def test_values_without_a_name_are_refused_with_the_class_and_a_name():
    with refused(ac.DeclarationError, "Mass takes values by name", "Mass(m=2)"):
        Mass(2)


def test_a_name_in_the_other_case_is_found():
    with refused(ac.DeclarationError, "did you mean 'm'?"):
        Mass(M=2.0)


@pytest.mark.parametrize("value", [ac.Parameter(2.0), 2.0])
def test_a_connector_cannot_be_hidden(value: object):
    with refused(ac.DeclarationError, "Bad.flange_a", "hide the connector"):
        type("Bad", (Mass,), {"flange_a": value, "__module__": __name__})


def test_a_component_shows_its_values_connectors_and_parts():
    assert str(Mass(m=2.0)).splitlines()[:2] == ["Mass", "  parameters m = 2.0 kg, L = 0.0 m"]
    model = Model()
    model.mass = Mass(m=1.0)
    assert str(model) == "Model\n  parts      mass (Mass)"
    assert repr(model.mass).startswith("Mass 'mass'\n")


def test_a_part_takes_no_number_under_a_name_that_it_lacks() -> None:
    model = ac.Component()
    model.resistor = Resistor(R=100.0)
    with pytest.raises(ac.DeclarationError, match=r"resistor.* has no 'r': did you mean 'R'\?"):
        model.resistor.r = 400.0
    model.resistor.R = 400.0


def test_an_attribute_that_is_missing_is_refused_with_place_and_near_names() -> None:
    model = Model()
    model.mass = Mass(m=1.0)
    with pytest.raises(
        AttributeError, match=r"Mass 'mass' has no 'flange_q': did you mean 'flange"
    ):
        model.connect(model.mass.flange_a, model.mass.flange_q)
    with pytest.raises(
        AttributeError, match=r"mass\.flange_a \(Flange\) has no 'x': known are 's', 'f'"
    ):
        _ = model.mass.flange_a.x  # pyright: ignore[reportAttributeAccessIssue]
    assert not hasattr(model, "nothing")
    assert getattr(model.mass.flange_a, "nothing", 3) == 3


def test_a_property_keeps_its_own_error() -> None:
    class Part(ac.Component):
        @property
        def total(self) -> float:
            return self.mass.lost

    with pytest.raises(AttributeError, match="Part has no 'mass'"):
        _ = Part().total


def test_variables_are_not_differentiated_by_sympy() -> None:
    class Decay(ac.Component):
        x = ac.Variable(start=1.0)

        def equations(self):
            yield ac.Eq((2 * self.x).diff(ac.time), -self.x)

    with pytest.raises(ac.DeclarationError, match=r"a derivative in time is ac\.der"):
        ac.compile(Decay())


def test_a_number_that_a_component_of_the_library_does_not_have_is_refused() -> None:
    class Hanging(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.spring = translational.Spring(c=1.0)

    model = Hanging()
    with pytest.raises(ac.DeclarationError, match="Spring 'spring' has no 'k'"):
        model.spring.k = 99.0
    model.spring.c = 99.0
    assert model.spring._node.modifiers["c"] == 99.0


def test_a_part_cannot_be_removed() -> None:
    model = Model()
    model.mass = Mass(m=1.0)
    with pytest.raises(ac.DeclarationError, match="mass cannot be removed"):
        del model.mass
