"""The arguments with which a model's equations call a network."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import sympy as sp
from jaxtyping import Array, Float

from acausal.codegen import ModuleValue, Values, evaluate
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
        variables: which variable fills a slot, by name.
        parameters: where in ``Packed.values`` a slot's parameter lies; -1 for one that is folded to zero.
        modules: which module fills a slot, for calls within the arguments.
    """

    arguments: tuple[Any, ...]
    variables: tuple[tuple[sp.Symbol, str], ...]
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
    template, names, layout = group.template, system.flat.layout, system.layout
    filled = zip(template.variables, group.variables[row].tolist(), template.orders, strict=True)
    variables = tuple((s, "der(" * n + names.variable(v) + ")" * n) for s, v, n in filled)
    positions = layout.position[group.parameters[row]].tolist()
    chosen = layout.module_of[group.modules[row]].tolist()
    parameters = tuple(zip(template.parameters, positions, strict=True))
    return variables, parameters, tuple(zip(template.modules, chosen, strict=True))


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
    slots |= {s: system.read((n,), values)[0] for s, n in call.variables if s in present}
    slots |= {s: 0.0 if p < 0 else packed.values[p] for s, p in call.parameters if s in present}
    slots |= {s: ModuleValue(packed.modules[m]) for s, m in call.modules}
    return jnp.stack([jnp.asarray(evaluate(a, slots), float) for a in call.arguments])
