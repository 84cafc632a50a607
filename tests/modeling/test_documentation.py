"""Components explain themselves: `help`, signatures and representations come from the declarations."""

import inspect
import pydoc
from typing import Any

import acausal as ac
from acausal.components import electrical as el, neural, translational as tl


class Shaft(ac.Component):
    """A shaft.

    Of steel.
    """

    J = ac.Parameter(unit="kg.m2", min=0, doc="inertia")
    ratio = ac.Parameter(2.0)
    J_side = ac.Parameter(lambda self: self.J * self.ratio, unit="kg.m2")
    side = ac.Option("left", choices=("left", "right"), doc="where the motor is")
    braked = ac.Option(False)
    torque = ac.Input(unit="N.m", when="braked")
    w = ac.Variable(unit="rad/s", start=3.0)
    _hidden = ac.Variable()


class Undocumented(ac.Component):
    x = ac.Variable()


class Own(ac.Component):
    """With arguments of its own."""

    J = ac.Parameter(unit="kg.m2")

    def __init__(self, *, m: float = 2.0) -> None:
        super().__init__(J=m)


class Passing(ac.Component):
    """With an argument of its own, and parts."""

    J = ac.Parameter(unit="kg.m2")

    def __init__(self, n: int, **modifiers: Any) -> None:
        super().__init__(**modifiers)


def test_the_signature_has_the_parameters_and_their_defaults() -> None:
    parameters = inspect.signature(el.Resistor).parameters
    assert parameters["R"].default is inspect.Parameter.empty
    assert str(parameters["T_ref"]) == "T_ref=300.15"
    assert str(parameters["T"]) == "T=T_ref"
    assert {"useHeatPort", "v", "i", "p", "heatPort"} <= set(parameters)
    assert all(p.kind is p.KEYWORD_ONLY for p in parameters.values())


def test_a_signature_can_be_bound_as_the_component_is_made() -> None:
    given = {"J": 1.0, "side": "right", "w": ac.Start(1.0)}
    inspect.signature(Shaft).bind(**given)
    assert repr(Shaft(**given)).startswith("Shaft\n")


def test_what_is_hidden_or_made_by_the_author_is_as_it_is() -> None:
    assert "_hidden" not in inspect.signature(Shaft).parameters
    assert str(inspect.signature(Own)) == "(*, m: float = 2.0)"
    assert list(inspect.signature(Passing).parameters) == ["n", "J", "modifiers"]
    assert "modifiers" in inspect.signature(tl.Vehicle).parameters
    assert next(iter(inspect.signature(neural.Compliance).parameters)) == "connector"


def test_help_lists_what_the_class_declares() -> None:
    text = pydoc.plain(pydoc.render_doc(el.Resistor))
    # Newer Pythons write an argument a line, with a bar before it.
    assert "Resistor(*,R," in text.translate(str.maketrans("", "", " \n|"))
    assert "R              Ohm  resistance at T_ref" in text
    assert "T_ref  300.15  K    reference temperature" in text
    assert "alpha = Parameter(0.0, unit='1/K'" in text


def test_the_docstring_comes_first_and_the_declarations_after_it() -> None:
    assert Shaft.__doc__ == Shaft().__doc__
    assert inspect.getdoc(Shaft) == (
        "A shaft.\n\nOf steel.\n\n"
        "Parameters:\n"
        "    J                kg.m2  inertia\n"
        "    ratio   2.0\n"
        "    J_side  J*ratio  kg.m2\n\n"
        "Options:\n"
        "    side    'left'  where the motor is; one of 'left', 'right'\n"
        "    braked  False\n\n"
        "Inputs:\n"
        "    torque  N.m  only with braked\n\n"
        "Variables:\n"
        "    w  3.0  rad/s"
    )
    assert Undocumented.__doc__ is None


def test_declarations_show_what_their_author_wrote() -> None:
    assert repr(el.Resistor.R) == "Parameter(unit='Ohm', doc='resistance at T_ref')"
    assert repr(Shaft.J) == "Parameter(unit='kg.m2', min=0, doc='inertia')"
    assert repr(Shaft.J_side) == "Parameter(J*ratio, unit='kg.m2')"
    assert repr(Shaft.side).startswith("Option('left', choices=('left', 'right'), doc=")
    assert repr(Shaft.torque) == "Input(unit='N.m', when='braked')"
    assert repr(Shaft.w) == "Variable(unit='rad/s', start=3.0)"
    assert repr(ac.Input(kind="bool", unit="1")) == "Input(kind='bool', unit='1')"
    assert repr(ac.Parameter(lambda self: max(self.a, self.b))) == "Parameter(...)"


def test_a_start_shows_what_is_given() -> None:
    assert repr(ac.Start()) == "Start()"
    assert repr(ac.Start(0.1, fixed=True)) == "Start(0.1, fixed=True)"
    assert repr(ac.Start(fixed=False, nominal=3.0)) == "Start(fixed=False, nominal=3.0)"


def test_connectors_list_their_variables() -> None:
    assert inspect.getdoc(el.Pin) == (
        "Potential ``v`` [V] and current ``i`` [A], positive into the component.\n\n"
        "Potentials:\n    v  V  potential at the pin\n\n"
        "Flows:\n    i  A  current into the pin"
    )
