"""Declarations, references and equations."""

import math
from collections.abc import Iterator
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

import acausal as ac
from acausal.modeling import Module, ModuleCall, Reference, der, references, time


class Part(ac.Component):
    k = ac.Parameter(2.0, unit="N/m", doc="stiffness")
    x = ac.Variable(unit="m")
    y = ac.Variable(shape=2)
    A = ac.Parameter([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], shape=(2, 3))
    net = Module(lambda key: eqx.nn.Identity())


def test_read_on_the_class_a_declaration_is_itself():
    assert isinstance(Part.k, ac.Parameter)
    assert (Part.k.name, Part.k.unit, Part.k.doc) == ("k", "N/m", "stiffness")


def test_read_on_an_instance_it_is_a_real_symbol_that_knows_its_owner():
    part = Part()
    assert isinstance(part.x, Reference)
    assert part.x.owner is part._node
    assert part.x.path == "x"
    assert part.x.declaration is Part.x
    assert part.x.is_real
    assert str(part.x + part.k) == "k + x"
    assert sp.latex(part.x) == "x"


def test_references_are_one_object_each_and_differ_between_instances():
    a, b = Part(), Part()
    assert a.x is a.x
    assert a.x is not b.x


def test_vectors_are_counted_from_one():
    part = Part()
    assert [r.path for r in part.y] == ["y[1]", "y[2]"]
    assert part.A[1][2].path == "A[2,3]"


def test_references_in_order_of_appearance_each_once():
    part = Part()
    assert sorted(r.path for r in references(part.x * part.k + part.x)) == ["k", "x"]
    assert list(references(sp.Integer(3))) == []


@pytest.mark.parametrize("value", [3, 3.0, np.float64(3.0), np.int64(3), sp.Integer(3)])
def test_numbers_become_exact(value):
    assert ac.Eq(Part().x, value).rhs == 3


def test_eq_reads_as_it_was_written():
    part = Part()
    assert str(ac.Eq(part.x, part.k * 2)) == "x = 2*k"


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("text", "right side is str 'text'"),
        (None, "right side is NoneType"),
        ((1, 2), "right side is tuple"),
        (math.nan, "right side is nan; a finite number"),
        (math.inf, "right side is inf; a finite number"),
    ],
)
def test_eq_refuses_what_is_no_expression(value, told):
    with pytest.raises(ac.DeclarationError, match=told):
        ac.Eq(Part().x, value)


def test_a_list_is_no_side_of_an_equation():
    with pytest.raises(ac.DeclarationError, match="left side is list"):
        ac.Eq([*Part().y], 0)


def test_start_checks_its_state_preference():
    with pytest.raises(ac.DeclarationError, match="state='perfer' must be one of never, avoid"):
        ac.Start(1.0, state="perfer")


def test_der_is_real_and_keeps_its_argument():
    part = Part()
    assert der(part.x).is_real
    assert der(part.x).args == (part.x,)
    with pytest.raises(TypeError):
        der(part.x, part.k)


def test_a_module_call_differentiates_by_counting_orders():
    part = Part()
    call = part.net(part.x)
    assert isinstance(call, ModuleCall)
    derivative = sp.diff(call, part.x)
    assert derivative == ModuleCall(call.args[0], sp.Tuple(1), part.x)
    assert sp.diff(derivative, part.x) == ModuleCall(call.args[0], sp.Tuple(2), part.x)
    assert sp.diff(call, part.k) == 0
    assert str(derivative) == "net'(x)"


def test_a_module_call_obeys_the_chain_rule_per_argument():
    part = Part()
    call = part.net(part.x**2, part.k * part.x)
    module = call.args[0]
    assert str(ModuleCall(module, sp.Tuple(2, 1), part.x, part.k)) == "net'''2(x, k)"
    expected = 2 * part.x * ModuleCall(module, sp.Tuple(1, 0), *call.args[2:])
    expected += part.k * ModuleCall(module, sp.Tuple(0, 1), *call.args[2:])
    assert sp.expand(sp.diff(call, part.x) - expected) == 0


def test_a_module_call_needs_expressions():
    with pytest.raises(ac.DeclarationError, match="an argument of net is str"):
        Part().net("x")


def test_time_is_a_real_symbol():
    assert time is ac.time
    assert time.is_real


def test_the_default_of_an_input_is_a_number():
    assert ac.Input(default=(1.0, 2)).default == (1.0, 2)
    for wrong in ("three", ((1.0,), 2.0), jax.random.key(0)):
        with pytest.raises(ac.DeclarationError, match=r"default=.* must be a number"):
            ac.Input(default=wrong)


@pytest.mark.parametrize(
    "start", [[1.0, 2.0], (1.0, 2.0), np.array([1.0, 2.0]), jnp.array([1, 2])], ids=type
)
def test_the_start_of_an_array_is_a_number_for_each(start: object) -> None:
    class Two(ac.Component):
        x = ac.Variable(shape=2, start=start, fixed=True)

        def equations(self) -> Iterator[ac.Eq]:
            for x in self.x:
                yield ac.Eq(ac.der(x), -x)

    np.testing.assert_array_equal(ac.compile(Two()).initialize()["x"], [1.0, 2.0])


def test_a_parameter_that_is_an_array_declares_its_shape() -> None:
    class Matrix(ac.Component):
        A = ac.Parameter(np.eye(2))

    class Row(ac.Component):
        a = ac.Parameter([1, 2, 3])
        x = ac.Variable()

        def equations(self) -> Iterator[ac.Eq]:
            yield ac.Eq(self.x, self.a[0])

    with pytest.raises(ac.DeclarationError, match=r"is an array; declare shape=\(2, 2\)"):
        ac.compile(Matrix())
    with pytest.raises(ac.DeclarationError, match=r"Row\.a: its default .* declare shape=\(3,\)"):
        ac.compile(Row())


@pytest.mark.parametrize("start", [[1.0, 2.0, 3.0], np.ones((2, 3)), np.ones((3, 2))])
def test_a_start_has_no_more_numbers_than_elements(start: Any) -> None:
    class Few(ac.Component):
        x = ac.Variable(shape=(2,) * np.ndim(start), start=start)

        def equations(self) -> Iterator[ac.Eq]:
            for x in np.ravel(np.asarray(self.x, dtype=object)):
                yield ac.Eq(ac.der(x), -x)

    with pytest.raises(ac.DeclarationError, match="the start of 'x' has the shape"):
        ac.compile(Few())
