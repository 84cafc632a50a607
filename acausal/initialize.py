"""Initialize: consistent values of the states from starts, fixed starts and initial equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax.core import Tracer

from acausal.errors import DataError, InitializationError, listing, nearest
from acausal.flatten import FlatModel
from acausal.generate import Program
from acausal.instructions import chosen_module
from acausal.lower import evaluate
from acausal.parameters import Packed, ParameterLayout
from acausal.reduce import ReducedModel
from acausal.solve import newton
from acausal.symbols import time
from acausal.template import Binding, EquationGroup

MAX_STEPS = 50


@dataclass(frozen=True)
class Condition:
    """A fixed start that no state takes by itself: ``sign * node = start`` of ``variable``."""

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
        conditions: fixed starts that are not met by that: of variables that are not states, and of further
            names of a state.
    """

    reduced: ReducedModel
    program: Program
    parameters: ParameterLayout
    start_of: tuple[tuple[int, int], ...]
    fixed: np.ndarray
    conditions: tuple[Condition, ...]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the states."""
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
                raise DataError(
                    f"x0 has shape {x.shape}; the model has {len(self.names)} states: {listing(self.names)}"
                )
            return x
        given = dict(x0 or {})
        for name in given:
            if name not in self.names:
                raise DataError(f"x0: '{name}' is not a state; {nearest(name, self.names)}")
        u = jnp.zeros(len(self.reduced.inputs)) if u0 is None else jnp.asarray(u0, dtype=float)
        x = self._starts(packed, self.start_of)
        for i, name in enumerate(self.names):
            if name in given:
                x = x.at[i].set(given[name])
        told = np.asarray([n in given for n in self.names], dtype=bool)
        conditions = [c for c in self.conditions if c.node not in self.reduced.states[told]]
        free = ~told & ~self.fixed
        if not conditions and not self.reduced.model.initial:
            return x
        if given and not free.any():
            return x
        moved = tuple(np.flatnonzero(free).tolist())
        x, rest = self._satisfied(packed, x, moved, tuple(conditions), u, jnp.asarray(t0, float))
        self._check(conditions, rest)
        return x

    @cached_property
    def _bindings(self) -> dict[int, Binding]:
        return {b.target: b for b in self.reduced.model.starts}

    def _starts(self, packed: Packed, members: Sequence[tuple[int, int]]) -> Any:
        """Start values of variables, each with its sign; those of one expression side by side."""
        model, n = self.reduced.model, self.reduced.model.n_variables
        number = [model.start[v] if v < n else 0.0 for v, _ in members]
        x = jnp.asarray(np.asarray(number, dtype=float))
        groups: dict[Any, list[tuple[int, tuple[int, ...]]]] = {}
        for row, (variable, _) in enumerate(members):
            if (b := self._bindings.get(variable)) is not None:
                groups.setdefault((b.expression, b.symbols), []).append((row, b.arguments))
        for (expression, symbols), found in groups.items():
            rows, arguments = (np.asarray(part) for part in zip(*found, strict=True))
            position = self.parameters.position[arguments]  # -1: folded, or bound to what is folded
            read = jnp.where(position >= 0, packed.values[position], 0.0)
            x = x.at[rows].set(evaluate(expression, dict(zip(symbols, read.T, strict=True))))
        return x * np.asarray([sign for _, sign in members], dtype=float)

    @cached_property
    def _satisfied(self) -> Any:
        """`_satisfy`, compiled once for every choice of what is free."""
        return eqx.filter_jit(self._satisfy)

    def _satisfy(
        self,
        packed: Packed,
        x: Any,
        moved: tuple[int, ...],
        conditions: tuple[Condition, ...],
        u: Any,
        t0: Any,
    ) -> tuple[Any, Any]:
        """States that satisfy the conditions, and by how much they do not; ``moved`` are free to move."""
        free = np.asarray(moved, dtype=np.int64)

        def residual(z: Any, packed: Packed, x: Any) -> Any:
            return self._residuals(conditions, packed, x.at[free].set(z), u, t0)

        frozen, start = _stop_gradient((packed, x))
        z0 = x[free]
        z = _least_change(lambda z: residual(z, frozen, start), jax.lax.stop_gradient(z0))
        slope = jax.jacfwd(lambda z: residual(z, frozen, start))(z)
        step = z0 - jax.lax.stop_gradient(z0)
        correction = jnp.linalg.pinv(slope) @ (residual(z, packed, x) + slope @ step)
        return x.at[free].set(z + step - correction), residual(z, frozen, start)

    def _check(self, conditions: Sequence[Condition], rest: Any) -> None:
        if isinstance(rest, Tracer):
            return
        wrong = np.flatnonzero(~(np.abs(np.asarray(rest)) < 1e-6))
        if len(wrong):
            names = self._names_of(conditions)
            raise InitializationError(
                f"the initial conditions cannot all hold; left over: {listing([names[i] for i in wrong])}. "
                "Is a start fixed twice, or in conflict with a connection?"
            )

    def _names_of(self, conditions: Sequence[Condition]) -> list[str]:
        layout = self.reduced.model.layout
        names = [f"{layout.variable(c.variable)} (fixed start)" for c in conditions]
        for group in self.reduced.model.initial:
            places = [layout.paths[c] for c in group.components]
            names += [
                f"{p} ({group.template.origin})" if p else group.template.origin for p in places
            ]
        return names

    def _residuals(
        self, conditions: Sequence[Condition], packed: Packed, x: Any, u: Any, t0: float
    ) -> Any:
        parts: list[Any] = []
        if conditions:
            values = self.program.values([c.node for c in conditions], t0, x, u, packed)
            signs = np.asarray([c.sign for c in conditions])
            starts = self._starts(packed, [(c.variable, 1) for c in conditions])
            parts.append(signs * values - starts)
        parts += [self._initial(group, packed, x, u, t0) for group in self.reduced.model.initial]
        return jnp.concatenate(parts)

    def _initial(self, group: EquationGroup, packed: Packed, x: Any, u: Any, t0: float) -> Any:
        """Residuals of initial equations; derivatives are taken along the vector field."""
        columns: dict[sp.Symbol, Any] = {time: jnp.asarray(t0)}
        for i, (symbol, order) in enumerate(
            zip(group.template.variables, group.template.orders, strict=True)
        ):
            columns[symbol] = self._variables(group.variables[:, i], order, packed, x, u, t0)
        for i, symbol in enumerate(group.template.parameters):
            kept = self.parameters.position[group.parameters[:, i]] >= 0
            read = (
                self.parameters.gather(group.parameters[kept, i]).read([packed.values])
                if kept.any()
                else 0.0
            )
            columns[symbol] = jnp.zeros(len(group)).at[np.flatnonzero(kept)].set(read)
        for i, symbol in enumerate(group.template.modules):
            columns[symbol] = chosen_module(packed, self.parameters.chosen(group.modules[:, i]))
        return jnp.broadcast_to(evaluate(group.template.residual, columns), (len(group),))

    def _variables(
        self, variables: Any, order: int, packed: Packed, x: Any, u: Any, t0: float
    ) -> Any:
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


def _stop_gradient(tree: Any) -> Any:
    return jax.tree.map(lambda v: jax.lax.stop_gradient(v) if eqx.is_array(v) else v, tree)


def _least_change(residual: Any, z0: Any) -> Any:
    """Gauss-Newton with the smallest steps: a root near the guess also where there are many."""
    smallest = lambda z, r: jnp.linalg.pinv(jax.jacfwd(residual)(z)) @ r  # noqa: E731
    return newton(residual, z0, smallest, MAX_STEPS)[0]


def initializer(
    reduced: ReducedModel, program: Program, parameters: ParameterLayout
) -> Initializer:
    """Collect what the model says about the initial time."""
    model = reduced.model
    members, signs = reduced.start_members
    start_of = [(int(members[s]), int(signs[s])) for s in reduced.states]
    fixed = [v < model.n_variables and bool(model.fixed[v]) for v, _ in start_of]
    met = {v for v, _ in start_of}
    resolved = [(v, *reduced.resolve(v)) for v in np.flatnonzero(model.fixed).tolist()]
    conditions = [Condition(node, sign, v) for v, node, sign in resolved if v not in met]
    return Initializer(
        reduced,
        program,
        parameters,
        tuple(start_of),
        np.asarray(fixed, dtype=bool),
        _distinct(model, conditions, dict(zip(reduced.states.tolist(), start_of, strict=True))),
    )


def _distinct(
    model: FlatModel, conditions: list[Condition], start_of: dict[int, tuple[int, int]]
) -> tuple[Condition, ...]:
    """The conditions without those that repeat a number that their node is given already."""
    bound = {b.target for b in model.starts}
    known = {
        (state, sign * float(model.start[v]))
        for state, (v, sign) in start_of.items()
        if v < model.n_variables and model.fixed[v] and v not in bound
    }
    kept: list[Condition] = []
    for c in conditions:
        told = c.node, c.sign * float(model.start[c.variable])
        if c.variable in bound or told not in known:
            kept.append(c)
            known.add(told)
    return tuple(kept)
