"""The arguments with which a model's equations call a network."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
import sympy as sp
from jaxtyping import Array, Float

from acausal.codegen import ModuleValue, Values, evaluate, read, read_parameters
from acausal.errors import ModelError, nearest
from acausal.flattening import EquationGroup
from acausal.modeling import ModuleCall, time

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True)
class Call:
    """One call of a module in the equations of a model.

    Attributes:
        arguments: expressions in the slots of the equation that holds the call.
        variables: which node fills a slot, and with what sign.
        parameters: which parameter fills a slot.
        modules: which module fills a slot, for calls within the arguments.
    """

    arguments: tuple[Any, ...]
    variables: tuple[tuple[sp.Symbol, tuple[int, int]], ...]
    parameters: tuple[tuple[sp.Symbol, int], ...]
    modules: tuple[tuple[sp.Symbol, int], ...]


def calls(system: System, module: str) -> tuple[Call, ...]:
    """Every call of a module, in order of the equations.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    return tuple(_calls(system, _target(system, module)))


def _target(system: System, module: str) -> int:
    """The index of a module, or of the one that it refers to."""
    targets = system.layout.module_of
    known = {system.flat.layout.module(i): i for i in range(len(targets))}
    if module not in known:
        raise ModelError(f"the model has no module '{module}': {nearest(module, known)}")
    return int(targets[known[module]])


def _calls(system: System, target: int) -> Iterator[Call]:
    for group in system.flat.groups:
        if not group.template.modules:
            continue
        found = sorted(group.template.residual.atoms(ModuleCall), key=sp.default_sort_key)
        for row in range(len(group)):
            filled = _slots(system, group, row)
            modules: dict[Any, int] = dict(filled[2])
            yield from (Call(c.args[2:], *filled) for c in found if modules[c.args[0]] == target)


def _slots(system: System, group: EquationGroup, row: int) -> tuple[Any, Any, Any]:
    """What fills the slots of one equation: its variables, parameters and modules."""
    template = group.template
    filled = zip(template.variables, group.variables[row].tolist(), template.orders, strict=True)
    variables = tuple((s, _node(system, v, n)) for s, v, n in filled)
    chosen = system.layout.module_of[group.modules[row]].tolist()
    parameters = tuple(zip(template.parameters, group.parameters[row].tolist(), strict=True))
    return variables, parameters, tuple(zip(template.modules, chosen, strict=True))


def _node(system: System, variable: int, order: int) -> tuple[int, int]:
    """Node and sign of a variable, or of a derivative of it, that stands in the model's equations."""
    found = system.reduced.resolve_derivative(variable, order)
    assert found is not None
    return found


def arguments(system: System, module: str, values: Values) -> Float[Array, "n_calls n_arguments"]:
    """The arguments of every call of a module at one point.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    return jnp.stack([_arguments_of(system, call, values) for call in calls(system, module)])


def _arguments_of(system: System, call: Call, values: Values) -> Float[Array, " n_arguments"]:
    present = {s for a in call.arguments for s in a.free_symbols}
    packed = values.packed
    slots: dict[sp.Symbol, Any] = {time: values.t}
    own = [(s, *found) for s, found in call.variables if s in present]
    if own:
        symbols, nodes, signs = zip(*own, strict=True)
        found = read(system.program, nodes, values) * np.asarray(signs)
        slots |= dict(zip(symbols, found, strict=True))
    parameters = [(s, p) for s, p in call.parameters if s in present]
    slots |= {s: read_parameters(system.layout, p, packed) for s, p in parameters}
    slots |= {s: ModuleValue(packed.modules[m]) for s, m in call.modules}
    return jnp.stack([jnp.asarray(evaluate(a, slots), float) for a in call.arguments])


@dataclass(frozen=True)
class Labels:
    """What a law takes and gives where a model first calls it, in words for axes and tables.

    Attributes:
        arguments: names with units, or expressions.
        result: name with unit; empty where the law's value is no variable of the model.
    """

    arguments: tuple[str, ...]
    result: str


def labels(system: System, module: str) -> Labels:
    """What a module takes and gives, by the first equation that calls it.

    Raises:
        ModelError: for a name that is no module of the model.
    """
    target = _target(system, module)
    for group in system.flat.groups:
        template = group.template
        if not template.modules:
            continue
        chosen = system.layout.module_of[group.modules[0]].tolist()
        modules: dict[Any, int] = dict(zip(template.modules, chosen, strict=True))
        found = sorted(template.residual.atoms(ModuleCall), key=sp.default_sort_key)
        for call in found:
            if modules[call.args[0]] != target:
                continue
            rest: Any = template.residual.xreplace({call: sp.Integer(0)})
            result = _label(system, group, -rest if (-rest).is_Symbol else rest)
            arguments = tuple(_label(system, group, a) or str(a) for a in call.args[2:])
            return Labels(arguments, result)
    return Labels((), "")


def _label(system: System, group: EquationGroup, expression: Any) -> str:
    """Name and unit of a variable of the first equation of a group; an empty text for anything else."""
    template, layout = group.template, system.flat.layout
    places = zip(template.variables, group.variables[0].tolist(), template.orders, strict=True)
    for symbol, index, order in places:
        if symbol == expression:
            name = "der(" * order + layout.variable(index) + ")" * order
            return f"{name} [{system.unit(name)}]".replace(" []", "")
    return ""
