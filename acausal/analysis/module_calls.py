"""The arguments with which a model's equations call a network."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
import sympy as sp
from jaxtyping import Array, Float

from acausal.codegen import Packed, Values, chosen_module, evaluate, read, read_parameters
from acausal.errors import ModelError, nearest
from acausal.flattening import EquationGroup, Integers
from acausal.modeling import ModuleCall, time

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Calls:
    """A call of a module that some equations of one template state: one row for each of these equations.

    Attributes:
        arguments: expressions in the slots of the template.
        targets: (n,) which module each row calls.
        variables: by slot, (n,) which node fills it, and with what sign.
        parameters: by slot, (n,) which parameter fills it.
        modules: by slot, which module fills it, for calls within the arguments.
    """

    arguments: tuple[Any, ...]
    targets: Integers
    variables: tuple[tuple[sp.Symbol, Integers, Integers], ...]
    parameters: tuple[tuple[sp.Symbol, Integers], ...]
    modules: tuple[tuple[sp.Symbol, tuple[int, ...]], ...]

    @property
    def nodes(self) -> Integers:
        """All nodes that the arguments read."""
        return np.concatenate([np.zeros(0, np.int64), *(nodes for _, nodes, _ in self.variables)])

    def values(self, system: System, values: Values) -> Float[Array, "n n_arguments"]:
        """The arguments at one point."""
        n, packed = len(self.targets), values.packed
        slots: dict[sp.Symbol, Any] = {time: values.t}
        if self.variables:
            found = read(system.program, self.nodes.tolist(), values)
            for i, (symbol, _, signs) in enumerate(self.variables):
                own = found[i * n : (i + 1) * n]
                slots[symbol] = own if (signs == 1).all() else own * signs
        slots |= {s: read_parameters(system.layout, p, packed) for s, p in self.parameters}
        slots |= {s: chosen_module(packed, chosen) for s, chosen in self.modules}
        each = [jnp.asarray(evaluate(a, slots), float) for a in self.arguments]
        return jnp.stack([jnp.broadcast_to(a, (n,)) for a in each], axis=1)


def target(system: System, module: str) -> int:
    """The index of a module, or of the one that it refers to.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    targets = system.layout.module_of
    known = {system.flat.layout.module(i): i for i in range(len(targets))}
    if module not in known:
        raise ModelError(f"the model has no module '{module}': {nearest(module, known)}")
    return int(targets[known[module]])


def calls(system: System, *modules: str) -> tuple[Calls, ...]:
    """Every call of some modules, in order of the equations.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    return tuple(_calls(system, [target(system, module) for module in modules]))


def _calls(system: System, wanted: list[int]) -> Iterator[Calls]:
    for group, call, called in _stated(system):
        rows = np.isin(called, wanted)
        if rows.any():
            yield _filled(system, group.rows(rows), called[rows], call.args[2:])


def _stated(system: System) -> Iterator[tuple[EquationGroup, Any, Integers]]:
    """The calls of modules that equations state: their group, the call, and the module that each row calls."""
    for group in system.flat.groups:
        if group.template.modules:
            for call in sorted(group.template.residual.atoms(ModuleCall), key=sp.default_sort_key):
                slot = group.template.modules.index(call.args[0])
                yield group, call, system.layout.module_of[group.modules[:, slot]]


def _filled(
    system: System, group: EquationGroup, targets: Integers, arguments: tuple[Any, ...]
) -> Calls:
    """The arguments of one call, with what fills their slots in the equations of a group."""
    template = group.template
    present = {s for a in arguments for s in a.free_symbols}
    columns = zip(template.variables, group.variables.T.tolist(), template.orders, strict=True)
    variables = tuple((s, *_nodes(system, v, n)) for s, v, n in columns if s in present)
    parameters = zip(template.parameters, group.parameters.T, strict=True)
    modules = zip(template.modules, system.layout.module_of[group.modules].T.tolist(), strict=True)
    return Calls(
        arguments,
        targets,
        variables,
        tuple((s, p) for s, p in parameters if s in present),
        tuple((s, tuple(chosen)) for s, chosen in modules),
    )


def _nodes(system: System, variables: list[int], order: int) -> tuple[Integers, Integers]:
    """Nodes and signs of variables, or of derivatives of them, that stand in the model's equations."""
    found = [system.reduced.resolve_derivative(variable, order) for variable in variables]
    nodes, signs = zip(*(pair for pair in found if pair is not None), strict=True)
    return np.asarray(nodes, np.int64), np.asarray(signs, np.int64)


def arguments(system: System, module: str, values: Values) -> Float[Array, "n_calls n_arguments"]:
    """The arguments of every call of a module at one point.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    return jnp.concatenate([found.values(system, values) for found in calls(system, module)])


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
    """What a module takes and gives, by the first equation that calls it.

    Arguments:
        system: the model.
        module: name of the module.
        packed: the model's parameters, of which a factor may be made.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    wanted = target(system, module)
    for group, call, called in _stated(system):
        rows = np.flatnonzero(called == wanted)
        if not rows.size:
            continue
        first = group.rows(rows[:1])
        arguments = tuple(_label(system, first, a) for a in call.args[2:])
        given, factor = _given(first, call)
        if given is None:
            return Labels(arguments, "")
        slots = zip(group.template.parameters, first.parameters[0].tolist(), strict=True)
        values = {s: read_parameters(system.layout, p, packed) for s, p in slots}
        return Labels(arguments, _label(system, first, given), float(evaluate(factor, values)))
    return Labels((), "")


def _given(group: EquationGroup, call: Any) -> tuple[Any, Any]:
    """The variable that is a law times a factor of numbers and parameters; None where it is more than that."""
    template, law = group.template, sp.Dummy()
    residual: Any = sp.expand(template.residual.xreplace({call: law}))
    others = residual.free_symbols & {*template.variables, time}
    if len(others) == 1:
        (variable,) = others
        factor = -residual.coeff(law) / residual.coeff(variable)
        rest: Any = sp.simplify(residual - residual.coeff(variable) * (variable - factor * law))
        known = {*template.parameters}
        if variable in template.variables and rest == 0 and factor.free_symbols <= known:
            return variable, factor
    return None, sp.S.One


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
