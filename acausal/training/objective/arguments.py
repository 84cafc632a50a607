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
    layout = system.flat.layout
    targets = system.layout.module_of
    known = {layout.module(i): i for i in range(len(targets))}
    if module not in known:
        raise ModelError(f"the model has no module '{module}': {nearest(module, known)}")
    return tuple(_calls(system, int(targets[known[module]])))


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
