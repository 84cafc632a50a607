"""Conditions at the initial time: fixed starts and initial equations, and how far a state is from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal._jax import array, compiled
from acausal.codegen import (
    Arguments,
    ArrayFormula,
    Packed,
    ParameterLayout,
    Program,
    UnlikeFormulas,
    Values,
    compute,
    execute,
    formula_of,
    join_formulas,
    rates,
    read,
    run,
)
from acausal.flattening import Binding, FlatModel, LeavesCaches
from acausal.structure import ReducedModel

OPEN, DEPENDENT = 1e4, 1e8
"""How far states without a start move where others move by 1; those that depend on the rest."""


@dataclass(frozen=True)
class FixedStart:
    """``sign * node = start`` of ``variable``."""

    node: int
    sign: int
    variable: int


@dataclass(frozen=True)
class Conditions(LeavesCaches):
    """The initial conditions of a model.

    Attributes:
        start_of: for every state the variable whose start it takes, and the sign; ``fixed``: whether it is fixed, which
            guesses of loops are not.
        further: the other fixed starts: of variables that are not states, and of further names of a state.
    """

    reduced: ReducedModel
    program: Program
    parameters: ParameterLayout
    start_of: tuple[tuple[int, int], ...]
    fixed: np.ndarray
    further: tuple[FixedStart, ...]

    @property
    def nominal(self) -> np.ndarray:
        """Typical magnitudes of the states, shape (n_states,)."""
        n = self.reduced.model.n_variables
        return np.asarray(
            [self.reduced.model.nominal[v] if v < n else 1.0 for v, _ in self.start_of]
        )

    @cached_property
    def mobility(self) -> np.ndarray:
        """How far each state may move for the conditions, in nominal values, where another one moves by 1.

        Of states that are tied to each other, those without a start move first; of these, dependent ones.
        """
        model, states, every = self.reduced.model, self.reduced.states, self.reduced.projections
        dependent = np.isin(states, [s for p in every for s in p.dependent])
        given = [
            v < model.n_variables
            and bool(model.start_given[v] or model.start[v] != 0 or v in self._bindings)
            for v, _ in self.start_of
        ]
        far = np.where(given, 1.0, np.where(dependent, DEPENDENT, OPEN))
        return np.where(np.isin(states, [s for p in every for s in p.states]), far, 1.0)

    @cached_property
    def own(self) -> tuple[FixedStart, ...]:
        """The fixed starts that states take directly."""
        return tuple(
            FixedStart(int(state), sign, variable)
            for state, (variable, sign), fixed in zip(
                self.reduced.states, self.start_of, self.fixed, strict=True
            )
            if fixed
        )

    def names(self, starts: Sequence[FixedStart], resting: Sequence[int] = ()) -> list[str]:
        """The conditions that `residuals` belong to, as text."""
        layout = self.reduced.model.layout
        names = [f"{layout.variable(c.variable)} (fixed start)" for c in starts]
        for group in self.reduced.model.initial:
            places = zip(group.components.tolist(), group.origins, strict=True)
            names += [self.reduced.model.stated_at(c, o) for c, o in places]
        names += [stated for p in self.reduced.projections for stated in p.constraints]
        states = self.reduced.states
        return names + [f"der({self.reduced.name(int(states[i]))}) = 0" for i in resting]

    def starts(self, packed: Packed) -> Float[Array, " n_states"]:
        """Start values of the states, shape (n_states,); those that are sought without one are a little off zero."""
        found, states = self._starts(packed, self.start_of), self.reduced.states
        curved = [s for p in self.reduced.projections if not p.is_linear for s in p.dependent]
        sought = np.isin(states, [*self.reduced.guesses, *curved])
        if not sought.any():
            return found
        off = self.reduced.start_guess(states) - self.reduced.start_values(states)
        return found + np.where(sought, off, 0.0)

    def discrete_start(self, packed: Packed) -> Float[Array, " n_discrete"]:
        """Start values of the discrete variables, shape (n_discrete,)."""
        members, signs = self.reduced.start_members
        nodes = self.reduced.discrete.tolist()
        return self._starts(packed, [(int(members[n]), int(signs[n])) for n in nodes])

    def residuals(
        self,
        starts: Sequence[FixedStart],
        resting: Sequence[int],
        at: Values,
    ) -> Float[Array, " n_conditions"]:
        """How far a state is from fixed starts, from the initial equations, and from rest in some states.

        Fixed starts and rates are measured in nominal values, so that their squares may be added.
        """
        nominal = self.reduced.model.nominal
        parts: list[Any] = []
        if starts:
            values = read(self.program, [c.node for c in starts], at)
            signs = np.asarray([c.sign for c in starts])
            wanted = self._starts(at.packed, [(c.variable, 1) for c in starts])
            parts.append((signs * values - wanted) / nominal[[c.variable for c in starts]])
        arrays = self._arrays(at) if self._initial else ()
        parts += [jnp.atleast_1d(a) for one in self._initial for a in execute(one, at, arrays)]
        if self.reduced.gaps:
            parts.append(read(self.program, self.reduced.gaps, at))
        if resting:
            dx = rates(self.program, at)
            parts.append((dx / self.nominal)[np.asarray(resting)])
        return jnp.concatenate(parts)

    @cached_property
    def _bindings(self) -> dict[int, Binding]:
        return {b.target: b for b in self.reduced.model.starts}

    def _starts(self, packed: Packed, members: Sequence[tuple[int, int]]) -> Array:
        """Start values of variables, each with its sign."""
        if any(v in self._bindings for v, _ in members):
            return self._computed(packed, tuple(members))
        return array(self._numbers(members) * [sign for _, sign in members])

    def _numbers(self, members: Sequence[tuple[int, int]]) -> np.ndarray:
        """The start values that are numbers; zero for those of derivatives."""
        model, n = self.reduced.model, self.reduced.model.n_variables
        return np.asarray([model.start[v] if v < n else 0.0 for v, _ in members], dtype=float)

    @cached_property
    def _computed(self) -> Callable[[Packed, tuple[tuple[int, int], ...]], Array]:
        """`_compute`, compiled once for each choice of variables."""
        return compiled(self._compute)

    def _compute(self, packed: Packed, members: tuple[tuple[int, int], ...]) -> Array:
        """Start values of which some are expressions; those of one expression side by side."""
        x = jnp.asarray(self._numbers(members))
        groups: dict[Any, list[tuple[int, tuple[int, ...]]]] = {}
        for row, (variable, _) in enumerate(members):
            if (b := self._bindings.get(variable)) is not None:
                groups.setdefault((b.expression, b.symbols), []).append((row, b.arguments))
        for (expression, symbols), found in groups.items():
            rows, arguments = (np.asarray(part) for part in zip(*found, strict=True))
            read = zip(symbols, map(self.parameters.gather, arguments.T), strict=True)
            formula = ArrayFormula(expression, Arguments(parameters=tuple(read)), len(rows))
            x = x.at[rows].set(compute(formula, packed))
        return x * np.asarray([sign for _, sign in members], dtype=float)

    @cached_property
    def _initial(self) -> list[ArrayFormula | UnlikeFormulas]:
        """The initial equations; derivatives are read in further copies of the program's arrays."""
        formulas = [
            formula_of(
                group,
                self.reduced,
                self.program,
                self.parameters,
                orders=[0] * len(group.template.orders),
                copies=group.template.orders,
            )
            for group in self.reduced.model.initial
        ]
        sizes = self.program.sizes * self._copies(formulas)
        return join_formulas(formulas, sizes, self.parameters.size)

    def _copies(self, formulas: Sequence[ArrayFormula | UnlikeFormulas]) -> int:
        """How many copies of the program's arrays formulas read."""
        last = max((s for f in formulas for s in f.sources), default=0)
        return 1 + last // len(self.program.nodes)

    def _arrays(self, at: Values) -> list[Any]:
        """The arrays of the program that initial equations read, and copies with derivatives along the vector field."""
        n, sources = len(self.program.nodes), {s for f in self._initial for s in f.sources}
        wanted = {s % n for s in sources}

        def value(t: Array, x: Array, /) -> list[Any]:
            return run(self.program, wanted, at._replace(t=t, x=x))

        def along(
            function: Callable[[Array, Array], list[Any]],
        ) -> Callable[[Array, Array], list[Any]]:
            def rate(t: Array, x: Array, /) -> list[Any]:
                dx = rates(self.program, at._replace(t=t, x=x))
                return jax.jvp(function, (t, x), (jnp.ones_like(t), dx))[1]

            return rate

        arrays: list[Any] = []
        for _ in range(self._copies(self._initial)):
            arrays += value(jnp.asarray(at.t, dtype=float), at.x)
            value = along(value)
        return arrays


def initial_conditions(
    reduced: ReducedModel, program: Program, parameters: ParameterLayout
) -> Conditions:
    """Collect the initial conditions of a model."""
    model = reduced.model
    members, signs = reduced.start_members
    start_of = [(int(members[s]), int(signs[s])) for s in reduced.states]
    fixed = [
        v < model.n_variables and bool(model.fixed[v]) and i < reduced.n_independent
        for i, (v, _) in enumerate(start_of)
    ]
    met = {v for v, _ in start_of[: reduced.n_independent]}
    resolved = [(v, *reduced.resolve(v)) for v in np.flatnonzero(model.fixed).tolist()]
    discrete = set(reduced.discrete.tolist())  # their starts hold before the first event
    further = [
        FixedStart(node, sign, v)
        for v, node, sign in resolved
        if v not in met and node not in discrete
    ]
    return Conditions(
        reduced,
        program,
        parameters,
        tuple(start_of),
        np.asarray(fixed, dtype=bool),
        _distinct(model, further, dict(zip(reduced.states.tolist(), start_of, strict=True))),
    )


def _distinct(
    model: FlatModel, starts: list[FixedStart], start_of: dict[int, tuple[int, int]]
) -> tuple[FixedStart, ...]:
    """The fixed starts, without those that repeat a number that their node already has."""
    bound = {b.target for b in model.starts}
    known = {
        (state, sign * float(model.start[v]))
        for state, (v, sign) in start_of.items()
        if v < model.n_variables and model.fixed[v] and v not in bound
    }
    kept: list[FixedStart] = []
    for c in starts:
        given = c.node, c.sign * float(model.start[c.variable])
        if c.variable in bound or given not in known:
            kept.append(c)
            known.add(given)
    return tuple(kept)
