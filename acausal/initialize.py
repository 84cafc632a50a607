"""Initialize: consistent values of the states from starts, fixed starts and initial equations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp

from acausal.errors import DataError, InitializationError, listing, nearest
from acausal.generate import Program
from acausal.lower import ModuleValue, evaluate
from acausal.parameters import Packed, ParameterLayout
from acausal.reduce import ReducedModel
from acausal.symbols import time
from acausal.template import EquationGroup

TOLERANCE = 1e-8
MAX_STEPS = 50


@dataclass(frozen=True)
class Condition:
    """A variable that is fixed at the initial time although it is no state: ``sign * node = start``."""

    node: int
    sign: int
    variable: int


@dataclass(frozen=True)
class Initializer:
    """The initialization problem of a model.

    States with a fixed start take it. The others start from their guess and move as little as possible to
    satisfy the fixed starts of other variables and the initial equations.

    Attributes:
        start_of: for every state the variable whose start it takes, and the sign; ``fixed``: whether it is fixed.
        conditions: fixed starts of variables that are not states.
    """

    reduced: ReducedModel
    program: Program
    parameters: ParameterLayout
    start_of: tuple[tuple[int, int], ...]
    fixed: np.ndarray
    conditions: tuple[Condition, ...]

    @cached_property
    def names(self) -> tuple[str, ...]:
        return tuple(self.reduced.name(int(s)) for s in self.reduced.states)

    def __call__(
        self, packed: Packed, x0: Mapping[str, Any] | Any = None, u0: Any = None, t0: float = 0.0
    ) -> Any:
        """Initial states, shape (n_states,); ``x0`` gives some (by name) or all of them.

        Raises:
            DataError: if ``x0`` names what is not a state or has the wrong length.
            InitializationError: if the initial conditions contradict each other.
        """
        if x0 is not None and not isinstance(x0, Mapping):
            x = jnp.asarray(x0, dtype=float)
            if x.shape != (len(self.names),):
                raise DataError(f"x0 has shape {x.shape}; the model has {len(self.names)} states: {listing(self.names)}")
            return x
        given = dict(x0 or {})
        for name in given:
            if name not in self.names:
                raise DataError(f"x0: '{name}' is not a state; {nearest(name, self.names)}")
        u = jnp.zeros(len(self.reduced.inputs)) if u0 is None else jnp.asarray(u0, dtype=float)
        starts = self._starts(packed)
        x = jnp.stack([jnp.asarray(given.get(n, s), dtype=float) for n, s in zip(self.names, starts, strict=True)]) if starts else jnp.zeros(0)
        free = np.asarray([n not in given for n in self.names]) & ~self.fixed
        if not self.conditions and not self.reduced.model.initial:
            return x
        if given and not free.any():
            return x
        return self._satisfy(packed, x, np.flatnonzero(free), u, t0)

    def _starts(self, packed: Packed) -> list[Any]:
        return [sign * self._start(packed, variable) for variable, sign in self.start_of]

    def _start(self, packed: Packed, variable: int) -> Any:
        model = self.reduced.model
        for binding in model.starts:
            if binding.target == variable:
                values = {
                    s: 0.0 if model.folded[a] else packed.values[self.parameters.position[a]]
                    for s, a in zip(binding.symbols, binding.arguments, strict=True)
                }
                return evaluate(binding.expression, values)
        return float(model.start[variable])

    def _satisfy(self, packed: Packed, x: Any, free: np.ndarray, u: Any, t0: float) -> Any:
        def residual(z: Any, packed: Packed, x: Any) -> Any:
            return self._residuals(packed, x.at[free].set(z), u, t0)

        frozen, start = jax.lax.stop_gradient((packed, x))
        z0 = x[free]
        z = _least_change(lambda z: residual(z, frozen, start), jax.lax.stop_gradient(z0))
        slope = jax.jacfwd(lambda z: residual(z, frozen, start))(z)
        inverse = jnp.linalg.pinv(slope)
        moved = z0 - jax.lax.stop_gradient(z0)
        result = z + moved - inverse @ (residual(z, packed, x) + slope @ moved)
        self._check(residual(z, frozen, start))
        return x.at[free].set(result)

    def _check(self, rest: Any) -> None:
        if isinstance(rest, jax.core.Tracer):
            return
        wrong = np.flatnonzero(~(np.abs(np.asarray(rest)) < 1e-6))
        if len(wrong):
            raise InitializationError(
                f"the initial conditions cannot all hold; left over: {listing([self._condition_names[i] for i in wrong])}. "
                "Is a start fixed twice, or in conflict with a connection?"
            )

    @cached_property
    def _condition_names(self) -> list[str]:
        layout = self.reduced.model.layout
        names = [f"{layout.variable(c.variable)} (fixed start)" for c in self.conditions]
        for group in self.reduced.model.initial:
            names += [f"{layout.paths[c]} ({group.template.origin})" for c in group.components]
        return names

    def _residuals(self, packed: Packed, x: Any, u: Any, t0: float) -> Any:
        parts: list[Any] = []
        if self.conditions:
            values = self.program.values([c.node for c in self.conditions], t0, x, u, packed)
            signs = np.asarray([c.sign for c in self.conditions])
            starts = jnp.stack([jnp.asarray(self._start(packed, c.variable)) for c in self.conditions])
            parts.append(signs * values - starts)
        parts += [self._initial(group, packed, x, u, t0) for group in self.reduced.model.initial]
        return jnp.concatenate(parts)

    def _initial(self, group: EquationGroup, packed: Packed, x: Any, u: Any, t0: float) -> Any:
        """Residuals of initial equations; derivatives are taken along the vector field."""
        columns: dict[sp.Symbol, Any] = {time: jnp.asarray(t0)}
        for i, (symbol, order) in enumerate(zip(group.template.variables, group.template.orders, strict=True)):
            columns[symbol] = self._variables(group.variables[:, i], order, packed, x, u, t0)
        for i, symbol in enumerate(group.template.parameters):
            kept = ~self.reduced.model.folded[group.parameters[:, i]]
            read = self.parameters.gather(group.parameters[kept, i]).read([packed.values]) if kept.any() else 0.0
            columns[symbol] = jnp.zeros(len(group)).at[np.flatnonzero(kept)].set(read)
        for i, symbol in enumerate(group.template.modules):
            columns[symbol] = ModuleValue(packed.modules[int(group.modules[0, i])])
        return jnp.broadcast_to(evaluate(group.template.residual, columns), (len(group),))

    def _variables(self, variables: Any, order: int, packed: Packed, x: Any, u: Any, t0: float) -> Any:
        resolved = [self.reduced.resolve(int(v)) for v in variables]
        nodes, signs = [n for n, _ in resolved], np.asarray([s for _, s in resolved])

        def value(t: Any, x: Any) -> Any:
            return signs * self.program.values(nodes, t, x, u, packed)

        def along(function: Any) -> Any:
            def slope(t: Any, x: Any) -> Any:
                rate = self.program.vector_field(t, x, u, packed)
                return jax.jvp(function, (t, x), (jnp.ones_like(t), rate))[1]

            return slope

        for _ in range(order):
            value = along(value)
        return value(jnp.asarray(t0, dtype=float), x)


def _least_change(residual: Any, z0: Any) -> Any:
    """Gauss-Newton with the smallest steps: a root near the guess also where there are many."""

    def step(state: Any) -> Any:
        z, r, k = state
        z = z - jnp.linalg.pinv(jax.jacfwd(residual)(z)) @ r
        return z, residual(z), k + 1

    def unfinished(state: Any) -> Any:
        _, r, k = state
        return (jnp.max(jnp.abs(r), initial=0.0) > TOLERANCE) & (k < MAX_STEPS)

    return jax.lax.while_loop(unfinished, step, (z0, residual(z0), 0))[0]


def initializer(reduced: ReducedModel, program: Program, parameters: ParameterLayout) -> Initializer:
    """Collect what the model says about the initial time."""
    model, aliases = reduced.model, reduced.aliases
    number = {int(s): i for i, s in enumerate(reduced.states)}
    members: dict[int, list[int]] = {s: [] for s in number}
    conditions: list[Condition] = []
    own = np.arange(model.n_variables)
    states = np.isin(aliases.representative[own], reduced.states)
    for v in own[states].tolist():
        members[int(aliases.representative[v])].append(v)
    for v in own[model.fixed & ~states].tolist():
        node, sign = reduced.resolve(v)
        conditions.append(Condition(node, sign, v))
    start_of: list[tuple[int, int]] = []
    fixed: list[bool] = []
    for state in reduced.states.tolist():
        best = max(
            members[state],
            key=lambda v: (model.fixed[v], model.start_given[v], v == state, -v),
            default=state,
        )
        start_of.append((best, reduced.resolve(best)[1]))
        fixed.append(bool(best < model.n_variables and model.fixed[best]))
    return Initializer(
        reduced, program, parameters, tuple(start_of), np.asarray(fixed, dtype=bool), _distinct(conditions)
    )


def _distinct(conditions: list[Condition]) -> tuple[Condition, ...]:
    found: dict[int, Condition] = {}
    for condition in conditions:
        found.setdefault(condition.node, condition)
    return tuple(found.values())
