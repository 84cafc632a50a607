"""What is known beside a learned law: the elements that are connected between the same two nodes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from acausal.codegen import Packed, evaluate, read_parameters
from acausal.modeling import Component, Connector, ModuleCall, Parameter, full_name, references
from acausal.pages.own_law import OwnLaw, own_law, two_port_kind
from acausal.system import System

Numbers = Float[np.ndarray, " points"]


@dataclass(frozen=True)
class ParallelLaw:
    """The known part of a law: what the elements beside a learned one add to its flow.

    Attributes:
        names: the elements.
        argument: local name of the law's argument. held: of what is held at zero, such as the distance beside a speed.
        value: the known flow at values of the argument.
    """

    names: tuple[str, ...]
    argument: str
    held: str
    value: Callable[[Numbers], Numbers]


def parallel_law(system: System, network: str, packed: Packed) -> ParallelLaw | None:
    """The known elements beside that of a network, where its law is the flow between two connectors."""
    layout, (path, _, local) = system.flat.layout, network.rpartition(".")
    if path not in layout.number:
        return None
    component = layout.components[layout.number[path]]
    own = own_law(component)
    argument = None if own is None else _argument(own, local)
    if own is None or argument is None:
        return None
    ends = _ends(system, path, own.kind)
    terms: list[tuple[str, int, Callable[[Numbers], Numbers]]] = []
    held = ""
    for other, beside in zip(layout.paths, layout.components, strict=True):
        if other == path or not other:
            continue
        if two_port_kind(beside) is not own.kind:
            continue
        found = _ends(system, other, own.kind)
        law = own_law(beside) if found in (ends, ends[::-1]) else None
        if law is None or law.flow.atoms(ModuleCall):
            continue
        value = _evaluated(system, other, law, argument is own.rate, packed)
        if value is not None:
            terms.append((other, 1 if found == ends else -1, value))
            still = law.across if argument is own.rate else law.rate
            held = still.path if still is not None and still in law.flow.free_symbols else held
    if not terms:
        return None

    def total(x: Numbers) -> Numbers:
        return sum((sign * value(sign * x) for _, sign, value in terms), np.zeros_like(x))

    return ParallelLaw(tuple(name for name, _, _ in terms), argument.path, held, total)


def _argument(own: OwnLaw, local: str) -> Any:
    """The one argument of the network, if the flow is the network and nothing else."""
    flow = own.flow
    if not isinstance(flow, ModuleCall) or str(getattr(flow.args[0], "path", "")) != local:
        return None
    first: Any = flow.args[2]
    return first if first in (own.across, own.rate) else None


def _ends(
    system: System, path: str, kind: type[Connector]
) -> tuple[tuple[int, int], tuple[int, int]]:
    """The nodes where a component is connected: what its potentials are."""
    potential = kind.potential()

    def end(name: str) -> tuple[int, int]:
        index = system.flat.layout.find_variable(f"{path}.{name}.{potential}")
        assert index is not None
        return system.reduced.resolve(index)

    first, second = kind.pair
    return end(first), end(second)


def _evaluated(
    system: System, path: str, law: OwnLaw, of_rate: bool, packed: Packed
) -> Callable[[Numbers], Numbers] | None:
    """The flow as a function of the rate, or of the difference; the other is zero."""
    chosen, other = (law.rate, law.across) if of_rate else (law.across, law.rate)
    if "derivative" in law.reads or chosen is None:
        return None
    values: dict[Any, Any] = {} if other is None else {other: 0.0}
    for reference in references(law.flow):
        if isinstance(reference.declaration, Parameter):
            index = _parameter(system, path, reference)
            if index is None:
                return None
            values[reference] = read_parameters(system.layout.gather(np.asarray([index])), packed)

    def value(x: Numbers) -> Numbers:
        found = evaluate(law.flow, {**values, chosen: jnp.asarray(x)})
        return np.broadcast_to(np.asarray(found, float), x.shape)

    return value


def _parameter(system: System, path: str, reference: Any) -> int | None:
    """Number of a parameter of a component or of one around it."""
    owner: Component = system.flat.layout.components[system.flat.layout.number[path]]
    own = path if reference.owner is owner._node else reference.owner.path
    return system.flat.layout.find_parameter(full_name(own, reference.path))
