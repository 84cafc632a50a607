"""The arguments with which a model's equations call a network."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
import sympy as sp
from jaxtyping import Array, Float

from acausal.codegen import ArrayFormula, Packed, Values, compute, formula_of, run
from acausal.errors import ModelError, known_name
from acausal.flattening import EquationGroup, Integers
from acausal.modeling import ModuleCall, time

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Calls:
    """A call of a module that some equations of one template state: one row for each of these equations.

    Attributes:
        arguments: what it is called with. targets: (n,) which module each row calls.
    """

    arguments: tuple[ArrayFormula, ...]
    targets: Integers

    def values(self, system: System, values: Values) -> Float[Array, "n n_arguments"]:
        """The arguments at one point."""
        arrays = run(system.program, {s for a in self.arguments for s in a.sources}, values)
        each = [compute(a, values.packed, arrays, values.t) for a in self.arguments]
        n = len(self.targets)
        return jnp.stack([jnp.broadcast_to(a, (n,)).astype(float) for a in each], axis=1)


def target(system: System, module: str) -> int:
    """The index of a module, or of the one that it refers to.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    targets = system.layout.module_of
    known = {system.flat.layout.module(i): i for i in range(len(targets))}
    return int(targets[known[known_name(module, known, "the model has no module", ModelError)]])


def calls(system: System, *modules: str, at_events: bool = False) -> tuple[Calls, ...]:
    """Every call of some modules, in order of the equations; perhaps with those that change variables ``at_events``.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    wanted = [target(system, module) for module in modules]
    return tuple(_calls(system, wanted, at_events))


def _calls(system: System, wanted: list[int], at_events: bool) -> Iterator[Calls]:
    for group, call, called in _stated(system, at_events):
        rows = np.isin(called, wanted)
        if rows.any():
            own = partial(
                formula_of, group.rows(rows), system.reduced, system.program, system.layout
            )
            yield Calls(tuple(map(own, call.args[2:])), called[rows])


def _stated(system: System, at_events: bool) -> Iterator[tuple[EquationGroup, Any, Integers]]:
    """The calls of modules that equations and conditions state, and then those at events.

    Each is given by its group, the call, and the module that each row calls.
    """
    for group in system.flat.equations(at_events=at_events):
        if group.template.modules:
            for call in sorted(group.template.residual.atoms(ModuleCall), key=sp.default_sort_key):
                slot = group.template.modules.index(call.args[0])
                yield group, call, system.layout.module_of[group.modules[:, slot]]


def arguments(system: System, module: str, values: Values) -> Float[Array, "n_calls n_arguments"]:
    """The arguments of every call of a module at one point.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    found = calls(system, module, at_events=True)
    return jnp.concatenate([call.values(system, values) for call in found])


@dataclass(frozen=True)
class Labels:
    """What a law takes and gives where a model first calls it, in words for axes and tables.

    Attributes:
        arguments: names with units, or expressions.
        result: name with unit of the variable that the law gives; empty where its value alone is no variable's.
        factor: what the law is multiplied with to give that variable.
    """

    arguments: tuple[str, ...]
    result: str
    factor: float = 1.0


def labels(system: System, module: str, packed: Packed) -> Labels:
    """What a module takes and gives, by the first equation that calls it; parameters may give a factor.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    wanted = target(system, module)
    for group, call, called in _stated(system, at_events=True):
        rows = np.flatnonzero(called == wanted)
        if not rows.size:
            continue
        first = group.rows(rows[:1])
        arguments = tuple(_label(system, first, a) for a in call.args[2:])
        given, factor = _given(first, call)
        if given is None:
            return Labels(arguments, "")
        formula = formula_of(first, system.reduced, system.program, system.layout, factor)
        return Labels(arguments, _label(system, first, given), float(compute(formula, packed)))
    return Labels((), "")


def _given(group: EquationGroup, call: Any) -> tuple[Any, Any]:
    """The variable that is a law times a factor of numbers and parameters; None where it is more than that.

    Where only one of several cases has the law, that case counts.
    """
    template, law = group.template, sp.Dummy()
    residual: Any = template.residual.xreplace({call: law})
    residual = sp.expand(residual.replace(sp.Piecewise, lambda *cases: _only_case(law, *cases)))
    others = residual.free_symbols & {*template.variables, time}
    if len(others) == 1:
        (variable,) = others
        factor = -residual.coeff(law) / residual.coeff(variable)
        rest: Any = sp.simplify(residual - residual.coeff(variable) * (variable - factor * law))
        known = {*template.parameters}
        if variable in template.variables and rest == 0 and factor.free_symbols <= known:
            return variable, factor
    return None, sp.S.One


def _only_case(law: sp.Symbol, *cases: Any) -> Any:
    """The value in the only one of some cases that has a law; without such a case all of them."""
    values = [value for value, _ in cases if value.has(law)]
    return values[0] if len(values) == 1 else sp.Piecewise(*cases)


def _label(system: System, group: EquationGroup, expression: Any) -> str:
    """An expression of the first equation of a group by its names; a variable has its unit."""
    template, layout = group.template, system.flat.layout
    places = zip(template.variables, group.variables[0].tolist(), template.orders, strict=True)
    names = {s: "der(" * k + layout.variable(i) + ")" * k for s, i, k in places}
    if expression in names:
        name = names[expression]
        return f"{name} [{system.unit(name)}]".replace(" []", "")
    parameters = zip(template.parameters, group.parameters[0].tolist(), strict=True)
    names |= {s: layout.parameter(p) for s, p in parameters}
    return str(expression.xreplace({s: sp.Symbol(name) for s, name in names.items()}))
