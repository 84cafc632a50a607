"""The main oracle: a compiled system must satisfy the flat equations that it was compiled from.

`residuals` fills every equation, as it stands before any reduction, with the values that the system
computes: derivatives along the vector field, inputs' derivatives from the inputs named ``der(...)``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

import acausal as ac
from acausal.codegen import Packed, Values, rates, read
from acausal.codegen.lower import ModuleValue, evaluate
from acausal.flattening.equation_group import EquationGroup
from acausal.flattening.template import Integers
from acausal.modeling import time

Signal = Callable[[Any, Array, Array], Array]
"""Values from time, states and inputs."""


def residuals(system: ac.System, t: float, x: Any, u: Any, params: Any = None) -> dict[str, float]:
    """Largest absolute residual of the flat equations, by ``component (equation as written)``."""
    rest = _all(system, system.pack(params))(t, x, u)
    return _by_name(system, rest)


def worst(system: ac.System, seed: int = 0, points: int = 2, params: Any = None) -> float:
    """Largest residual, relative to the largest value in the model, at random points."""
    rng = np.random.default_rng(seed)
    packed = system.pack(params)
    evaluate_all = _all(system, packed)
    result = 0.0
    for _ in range(points):
        x = rng.uniform(0.2, 1.0, len(system.states))
        u = rng.uniform(0.2, 1.0, len(system.inputs))
        t = float(rng.uniform(0.1, 0.9))
        x = np.asarray(
            system.closed(Values(jnp.asarray(t), jnp.asarray(x), jnp.asarray(u), packed))
        )
        largest = float(np.max([0.0, *_by_name(system, evaluate_all(t, x, u)).values()]))
        result = float(np.max([result, largest / max(1.0, np.abs(x).max(initial=0.0))]))
    return result


def _all(system: ac.System, packed: Packed) -> Callable[[Any, Any, Any], list[Array]]:
    """Residuals of all groups; compiled, as that is faster than operation by operation."""

    def evaluate_all(t: Any, x: Any, u: Any) -> list[Array]:
        return flat_residuals(system, packed, t, trajectory(system, packed, t, x, u))

    return jax.jit(evaluate_all, compiler_options={"xla_backend_optimization_level": 0})


def trajectory(
    system: ac.System, packed: Packed, t: Any, x: Any, u: Any, highest: int | None = None
) -> list[Array]:
    """Values of all flat variables and of their derivatives in time, up to the ``highest`` that an equation has."""
    resolved = [system.reduced.resolve(v) for v in range(system.flat.n_variables)]
    nodes, signs = [n for n, _ in resolved], np.asarray([s for _, s in resolved])
    if highest is None:
        highest = max((n for g in system.flat.groups for n in g.template.orders), default=0)

    def every(t: Any, x: Array, u: Array) -> Array:
        return (
            signs * read(system.program, nodes, Values(t, x, u, packed)) if nodes else jnp.zeros(0)
        )

    t, x, u = (jnp.asarray(v, dtype=float) for v in (t, x, u))
    signals: list[Signal] = [every]
    for _ in range(highest):
        signals.append(_along(system, packed, signals[-1]))
    return [signal(t, x, u) for signal in signals]


def flat_residuals(system: ac.System, packed: Packed, t: Any, values: list[Array]) -> list[Array]:
    """Residuals of all groups of flat equations for these values and derivatives of the variables."""
    return [_residual(system, group, packed, t, values) for group in system.flat.groups]


def _by_name(system: ac.System, rest: list[Array]) -> dict[str, float]:
    found: dict[str, float] = {}
    for group, values in zip(system.flat.groups, rest, strict=True):
        for component, value in zip(group.components.tolist(), np.abs(values), strict=True):
            place = system.flat.layout.paths[component] if component >= 0 else "connection"
            name = f"{place} ({group.origins[0]})"
            found[name] = float(np.max([found.get(name, 0.0), value]))  # NaN wins
    return found


def _residual(
    system: ac.System, group: EquationGroup, packed: Packed, t: Any, values: list[Array]
) -> Array:
    """One group's equations; ``values[n]`` are the n-th derivatives of all variables."""
    columns: dict[Any, Any] = {time: t}
    template = group.template
    for i, (symbol, order) in enumerate(zip(template.variables, template.orders, strict=True)):
        columns[symbol] = values[order][group.variables[:, i]]
    for i, symbol in enumerate(template.parameters):
        columns[symbol] = _parameters(system, group.parameters[:, i], packed)
    if not template.modules:
        return jnp.broadcast_to(evaluate(template.residual, columns), (len(group),))
    rows = []
    for row in range(len(group)):
        one = {s: v if jnp.ndim(v) == 0 else v[row] for s, v in columns.items()}
        modules = zip(template.modules, group.modules[row], strict=True)
        one |= {s: ModuleValue(packed.modules[int(m)]) for s, m in modules}
        rows.append(evaluate(template.residual, one))
    return jnp.stack(rows)


def _parameters(system: ac.System, indices: Integers, packed: Packed) -> Array:
    layout = system.layout
    kept = [
        # -1: folded to zero, or bound to what is
        jnp.zeros(()) if layout.position[i] < 0 else packed.values[layout.position[i]]
        for i in indices
    ]
    return jnp.stack(kept)


def _along(system: ac.System, packed: Packed, signal: Signal) -> Signal:
    """The derivative of a signal along the vector field."""

    def derivative(t: Any, x: Array, u: Array) -> Array:
        tangents = rates(system.program, Values(t, x, u, packed)), _input_rates(system, u)
        return jax.jvp(signal, (t, x, u), (jnp.ones_like(t), *tangents))[1]

    return derivative


def _input_rates(system: ac.System, u: Array) -> Array:
    """Derivatives of the inputs: the inputs ``der(...)`` where the model has them, else zero."""
    place = {key: i for i, key in enumerate(system.reduced.input_orders)}
    rates = [place.get((i, n + 1)) for i, n in system.reduced.input_orders]
    return jnp.stack([u[r] if r is not None else jnp.zeros(()) for r in rates]) if rates else u
