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
from acausal.lower import ModuleValue, evaluate
from acausal.parameters import Packed
from acausal.symbols import time
from acausal.template import EquationGroup, Integers

Signal = Callable[[Any, Array, Array], Array]
"""Values from time, states and inputs."""


def residuals(system: ac.System, t: float, x: Any, u: Any, params: Any = None) -> dict[str, float]:
    """Largest absolute residual of the flat equations, by ``component: equation`` as written."""
    packed = system.pack(params)
    t, x, u = jnp.asarray(float(t)), jnp.asarray(x, dtype=float), jnp.asarray(u, dtype=float)
    found: dict[str, float] = {}
    for group in system.flat.groups:
        rest = np.abs(_residual(system, group, packed, t, x, u))
        for component, value in zip(group.components.tolist(), rest.tolist(), strict=True):
            place = system.flat.layout.paths[component] if component >= 0 else "connection"
            name = f"{place} ({group.template.origin})"
            # NaN must win
            found[name] = value if not value <= found.get(name, 0.0) else found.get(name, 0.0)
    return found


def worst(system: ac.System, seed: int = 0, points: int = 2, params: Any = None) -> float:
    """Largest residual, relative to the largest value in the model, at random points."""
    rng = np.random.default_rng(seed)
    result = 0.0
    for _ in range(points):
        x = rng.uniform(0.2, 1.0, len(system.states))
        u = rng.uniform(0.2, 1.0, len(system.inputs))
        t = float(rng.uniform(0.1, 0.9))
        found = residuals(system, t, x, u, params)
        scale = 1.0
        if system.variables:
            values = system.observe(system.variables, t, x, u, system.pack(params))
            scale = max(1.0, float(np.abs(np.asarray(values)).max()))
        largest = max(found.values(), default=0.0, key=lambda r: (np.isnan(r), r))
        result = max(result, largest / scale, key=lambda r: (np.isnan(r), r))
    return result


def _residual(
    system: ac.System, group: EquationGroup, packed: Packed, t: Any, x: Any, u: Any
) -> np.ndarray:
    columns: dict[Any, Any] = {time: t}
    template = group.template
    for i, (symbol, order) in enumerate(zip(template.variables, template.orders, strict=True)):
        columns[symbol] = _values(system, group.variables[:, i], order, packed)(t, x, u)
    for i, symbol in enumerate(template.parameters):
        columns[symbol] = _parameters(system, group.parameters[:, i], packed)
    if not template.modules:
        return np.broadcast_to(evaluate(template.residual, columns), (len(group),))
    rows = []
    for row in range(len(group)):
        one = {s: v if jnp.ndim(v) == 0 else v[row] for s, v in columns.items()}
        modules = zip(template.modules, group.modules[row], strict=True)
        one |= {s: ModuleValue(packed.modules[int(m)]) for s, m in modules}
        rows.append(evaluate(template.residual, one))
    return np.asarray(rows)


def _parameters(system: ac.System, indices: Integers, packed: Packed) -> Array:
    layout = system.layout
    kept = [
        # -1: folded to zero, or bound to what is
        jnp.zeros(()) if layout.position[i] < 0 else packed.values[layout.position[i]]
        for i in indices
    ]
    return jnp.stack(kept)


def _values(system: ac.System, variables: Integers, order: int, packed: Packed) -> Signal:
    """The variables, ``order`` times differentiated along the vector field."""
    resolved = [system.reduced.resolve(int(v)) for v in variables]
    nodes, signs = [n for n, _ in resolved], np.asarray([s for _, s in resolved])

    def value(t: Any, x: Array, u: Array) -> Array:
        return signs * system.program.values(nodes, t, x, u, packed)

    def along(function: Signal) -> Signal:
        def slope(t: Any, x: Array, u: Array) -> Array:
            rates = system.program.vector_field(t, x, u, packed), _input_rates(system, u)
            return jax.jvp(function, (t, x, u), (jnp.ones_like(t), *rates))[1]

        return slope

    for _ in range(order):
        value = along(value)
    return value


def _input_rates(system: ac.System, u: Array) -> Array:
    """Derivatives of the inputs: the inputs ``der(...)`` where the model has them, else zero."""
    place = {key: i for i, key in enumerate(system.reduced.input_orders)}
    rates = [place.get((i, n + 1)) for i, n in system.reduced.input_orders]
    return jnp.stack([u[r] if r is not None else jnp.zeros(()) for r in rates]) if rates else u
