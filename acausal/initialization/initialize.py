"""Initialize: consistent values of the states from starts, fixed starts, initial equations or rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NoReturn

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy.typing import ArrayLike

from acausal._jax import array, compiled, is_number, is_real, traced
from acausal.codegen import (
    Packed,
    ParameterLayout,
    Program,
    Values,
    explain_nonfinite,
    read,
)
from acausal.errors import DataError, InitializationError, listing, nearest, need_flag, shown
from acausal.flattening import LeavesCaches, is_hidden
from acausal.initialization.conditions import Conditions, initial_conditions
from acausal.initialization.solve import (
    LEFT_OVER,
    InitializationProblem,
    InitializationSolver,
    InitialStates,
)
from acausal.modeling import ByName, by_element, by_name, is_of_kind, names_in
from acausal.structure import ReducedModel

INDEPENDENT = 1e-9
"""Derivatives below this fraction of the largest one count as zero."""


@dataclass(frozen=True, repr=False)
class Initialization(ByName):
    """Initial values of the states, and how each was found. ``found["mass.s"]`` is one by name.

    Attributes:
        x: the values, shape (n_states,). ``states``: their names.
        roles: for every state "given" (by ``x0``), "fixed" (its start), "computed" (the conditions determine it),
            "chosen" (the conditions leave it open: as near to its start as they allow), "start" (no condition
            depends on it: it takes its start) or "fitted" (least squares).
        conditions: as text; ``residuals``: how far each is off, in nominal values.
    """

    x: Float[Array, " n_states"]
    states: tuple[str, ...]
    roles: tuple[str, ...]
    conditions: tuple[str, ...]
    residuals: np.ndarray

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the states."""
        return self.states

    def _column(self, name: str) -> Float[Array, ""]:
        if name not in self.states:
            raise DataError(f"'{name}' is not a state; {nearest(name, self.states)}")
        return self.x[self.states.index(name)]

    def _side_by_side(self, names: tuple[str, ...]) -> Float[Array, " n_names"]:
        return jnp.asarray([self._column(n) for n in names])

    def __repr__(self) -> str:
        width = max(map(len, self.states), default=0)
        lines = [
            f"  {name:<{width}}  {float(value): .6g}  {role}"
            for name, value, role in zip(self.states, self.x, self.roles, strict=True)
        ]
        lines += [
            f"  {name}: off by {abs(float(rest)):.2g}"
            for name, rest in zip(self.conditions, self.residuals, strict=True)
        ]
        n_open = sum(r in ("chosen", "start") for r in self.roles)
        counts = f"{len(self.states)} states, {len(self.conditions)} conditions, {n_open} left open"
        return "\n".join([f"Initialization ({counts})", *lines])


@dataclass(frozen=True)
class Initializer(LeavesCaches):
    """The initialization problem of a model.

    States with a fixed start take it. The others start from their guess and move as little as possible,
    measured in nominal values, to satisfy the other conditions.
    """

    conditions: Conditions

    @property
    def reduced(self) -> ReducedModel:
        """The model."""
        return self.conditions.reduced

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the states."""
        return tuple(self.reduced.name(int(s)) for s in self.reduced.states)

    def __call__(
        self,
        packed: Packed,
        x0: Mapping[str, ArrayLike] | ArrayLike | None,
        u0: Float[Array, " n_inputs"],
        t0: float = 0.0,
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
        d: Float[Array, " n_discrete"] | None = None,
    ) -> Float[Array, " n_states"]:
        """Initial states, shape (n_states,), for given discrete variables; see `System.initial_state`."""
        if x0 is not None and not isinstance(x0, Mapping):
            return self.closed(Values(array(t0), self._whole(x0), u0, packed, d))
        at = Values(array(t0), self.conditions.starts(packed), u0, packed, d)
        return self._solution(at, self.by_state(x0 or {}), steady, least_squares)[1].x

    def starts(
        self, packed: Packed, x0: Mapping[str, ArrayLike] | ArrayLike | None
    ) -> Float[Array, " n_states"]:
        """Where states are looked for from: what is given, and the starts of the others."""
        starts = self.conditions.starts(packed)
        if x0 is None or isinstance(x0, Mapping):
            return self._posed(starts, self.by_state(x0 or {}), False, False)[0]
        whole = self._whole(x0)
        return jnp.concatenate([whole, starts[len(whole) :]])

    def discrete_starts(
        self, packed: Packed, x0: Mapping[str, ArrayLike] | ArrayLike | None = None
    ) -> Float[Array, " n_discrete"] | None:
        """What discrete variables begin with: what ``x0`` gives by name, and their start values; None without any."""
        if not len(self.reduced.discrete):
            return None
        starts = self.conditions.discrete_start(packed)
        given = self.given(x0)[1] if isinstance(x0, Mapping) else {}
        for place, value in given.items():
            starts = starts.at[place].set(value)
        return starts

    def solves(self, x0: Any, steady: bool | Sequence[str], least_squares: bool) -> bool:
        """Whether states follow from equations, and not from starts and ``x0`` alone."""
        is_exact = bool(self.reduced.exact.all())
        if not is_exact or (x0 is not None and not isinstance(x0, Mapping)):
            return not is_exact
        starts = jnp.zeros(len(self.names))
        return self._posed(starts, self.by_state(x0 or {}), steady, least_squares)[1] is not None

    def start_or_nan(
        self,
        packed: Packed,
        u0: Float[Array, " n_inputs"],
        t0: float | Array = 0.0,
        d: Float[Array, " n_discrete"] | None = None,
    ) -> Float[Array, " n_states"]:
        """Initial states, or NaN where the conditions cannot all hold: for programs that raise no errors."""
        at = Values(array(t0), self.conditions.starts(packed), u0, packed, d)
        plan, found = self._solution(at, {})
        met = jnp.all(jnp.abs(found.residuals) < LEFT_OVER)
        return found.x if plan is None else jnp.where(met, found.x, jnp.nan)

    def report(
        self,
        packed: Packed,
        x0: Mapping[str, ArrayLike] | None,
        u0: Float[Array, " n_inputs"],
        t0: float = 0.0,
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
        d: Float[Array, " n_discrete"] | None = None,
    ) -> Initialization:
        """Initial states and how each was found; see `System.initialize`."""
        x0 = self.by_state(by_name(x0, "x0", "the states by name"))
        at = Values(array(t0), self.conditions.starts(packed), u0, packed, d)
        plan, found = self._solution(at, x0, steady, least_squares)
        roles = [
            "given" if name in x0 else "fixed" if fixed else "start"
            for name, fixed in zip(self.names, self.conditions.fixed, strict=True)
        ]
        roles[self.reduced.n_independent :] = ["computed"] * len(self.reduced.guessed)
        if plan is None:
            return Initialization(found.x, self.names, tuple(roles), (), np.zeros(0))
        for i, role in zip(plan.moved, _roles(plan, np.asarray(found.jacobian)), strict=True):
            roles[i] = role
        names = self.conditions.names(plan.starts, plan.resting)
        rest = np.asarray(found.residuals)
        return Initialization(found.x, self.names, tuple(roles), tuple(names), rest)

    # -- the problem -------------------------------------------------------------------------------

    def _solution(
        self,
        at: Values,
        given: Mapping[str, ArrayLike],
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
    ) -> tuple[InitializationProblem | None, InitialStates]:
        """The problem, if there are conditions to be met, and the states."""
        x, plan = self._posed(at.x, given, steady, least_squares)
        found = InitialStates(x, jnp.zeros(0), jnp.zeros((0, 0)))
        if plan is not None:
            start = at._replace(x=x)
            found = self._solver.find(plan, start)
            if not (plan.least_squares or traced(found.residuals) or found.holds):
                self._refuse(plan, start, found)
        return plan, found._replace(x=self.closed(at._replace(x=found.x)))

    @cached_property
    def _solver(self) -> InitializationSolver:
        return InitializationSolver(self.conditions)

    def _whole(self, x0: ArrayLike) -> Array:
        if not is_real(x0):
            raise DataError(f"x0={shown(x0)} are not the states; give real numbers.")
        x = jnp.asarray(x0, dtype=float)
        if x.shape not in {(len(self.names),), (self.reduced.n_independent,)}:
            raise DataError(
                f"x0 has shape {x.shape}; the model has {len(self.names)} states: {listing(self.names)}"
            )
        if traced(x):
            return x
        bad = np.flatnonzero(~np.isfinite(np.asarray(x)))
        if len(bad):
            raise DataError(f"x0: '{self.names[bad[0]]}' is {x[bad[0]]}; give finite numbers.")
        return x

    def _posed(
        self,
        x: Any,
        given: Mapping[str, ArrayLike],
        steady: bool | Sequence[str],
        least_squares: bool,
    ) -> tuple[Array, InitializationProblem | None]:
        """The states to begin with, from their starts, and the conditions that remain to be met, if any."""
        is_known = not traced(x, list(given.values()))
        x = np.array(x) if is_known else x
        for i, name in enumerate(self.names):
            if name in given:
                if not is_number(given[name]):
                    raise DataError(
                        f"x0: '{name}' is {shown(given[name])}; give a real number that is finite."
                    )
                if is_known:
                    x[i] = given[name]
                else:
                    x = x.at[i].set(given[name])
        x, least_squares = array(x), need_flag(least_squares, "least_squares")
        is_given = np.asarray([n in given for n in self.names], dtype=bool)
        is_own = np.arange(len(self.names)) < self.reduced.n_independent  # guesses follow
        at_will = ~is_given & ~self.conditions.fixed & is_own
        if isinstance(steady, bool):  # fixed starts must be those of rest
            resting = ~is_given & is_own & steady
        else:
            named = names_in(steady, "steady")
            self._known("steady", named)
            resting = np.asarray([n in named for n in self.names], dtype=bool)
        nodes = self.reduced.states[is_given]
        starts = [*(self.conditions.own if least_squares else ()), *self.conditions.further]
        moved = ~is_given & is_own if least_squares else at_will
        plan = InitializationProblem(
            tuple(np.flatnonzero(moved).tolist()),
            tuple(c for c in starts if c.node not in nodes),
            tuple(np.flatnonzero(resting).tolist()),
            least_squares,
        )
        # x0 says all that fixed starts leave open
        is_free = not self.reduced.gaps
        overruled = bool(given) and not (plan.moved or plan.resting) and is_free
        nothing = not (plan.starts or plan.resting or self.reduced.model.initial) and is_free
        return x, None if overruled or nothing else plan

    def by_state(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Values by state; a variable that is a state under another name gives the state's.

        Raises:
            DataError: for what neither is a state nor remembered by events, or two values of one.
        """
        return self.given(given)[0]

    def given(self, given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[int, Any]]:
        """Values by state, and by place of a discrete variable; errors as of `by_state`."""
        found: dict[str, Any] = {}
        discrete: dict[int, Any] = {}
        own = frozenset(self.names)
        given = by_element(given, own.union(self._remembered), "x0")
        for name in names_in(given, "x0"):
            state, value = name, given[name]
            index = self.reduced.model.layout.find_variable(name)
            if name not in own and index is not None:
                node, sign = self.reduced.resolve(index)
                places = np.flatnonzero(self.reduced.meant[self.reduced.states] == node).tolist()
                if node in self.reduced.discrete:
                    place = self._places[node]
                    if place in discrete:
                        raise DataError(
                            f"x0: '{name}' and another name are the same; give one of them"
                        )
                    discrete[place] = self._discrete_start(name, node, value, sign)
                    continue
                state = self.names[places[0]] if places else name
                value = -value if sign < 0 and is_number(value) else value
            if state not in own:
                self._known("x0", [state])
            if state in found:
                raise DataError(
                    f"x0: '{name}' and the state '{state}' are the same; give one of them"
                )
            found[state] = value
        return found, discrete

    @cached_property
    def _places(self) -> dict[int, int]:
        """By node of a discrete variable its place."""
        return {node: place for place, node in enumerate(self.reduced.discrete.tolist())}

    @cached_property
    def _remembered(self) -> dict[str, int]:
        """By name of the discrete variables that begin with a value, their nodes."""
        flat = self.reduced.model
        names = {flat.layout.variable(i): i for i in flat.remembered.tolist()}
        return {n: self.reduced.resolve(i)[0] for n, i in names.items() if not is_hidden(n)}

    def _discrete_start(self, name: str, node: int, value: Any, sign: int) -> Any:
        """The start of a discrete variable, which may have been given by another name."""
        known = {node: own for own, node in self._remembered.items()}
        if node not in known:
            remedy = f" Give {listing(self._remembered, 6)}." if self._remembered else ""
            raise DataError(
                f"x0: '{name}' follows from other variables at the start, and has no value of its own.{remedy}"
            )
        if not is_number(value):
            raise DataError(f"x0: '{name}' is {shown(value)}; give a real number that is finite.")
        found, layout = -value if sign < 0 else value, self.reduced.model.layout
        index = layout.find_variable(known[node])
        declared = None if index is None else layout.variable_declaration(index)
        kind = getattr(declared, "kind", "real")
        if not traced(found) and not is_of_kind(float(found), kind):
            what = "True or False" if kind == "bool" else "a whole number"
            whose = "" if name == known[node] else f", so that '{known[node]}' is {float(found):g}"
            raise DataError(f"x0: '{name}' is {shown(value)}{whose}; give {what}.")
        return found

    def _known(self, argument: str, names: Sequence[str]) -> None:
        for name in names:
            if name not in self.names:
                raise DataError(f"{argument}: '{name}' is not a state; {nearest(name, self.names)}")

    # -- its solution ------------------------------------------------------------------------------

    def closed(self, at: Values) -> Array:
        """The states that are close to variables at these; guesses of loops that are NaN or missing begin at starts."""
        return at.x if self.reduced.exact.all() else self._closed(at)

    @cached_property
    def _closed(self) -> Callable[[Values], Array]:
        """What `closed` computes, compiled once."""

        @compiled
        def closed(at: Values) -> Array:
            own, given = jnp.split(at.x, [self.reduced.n_independent])
            start = self.conditions.starts(at.packed)[len(own) :]
            guess = jnp.where(jnp.isfinite(given), given, start) if len(given) else start
            nearby = jnp.concatenate([own, guess])
            places = np.flatnonzero(~self.reduced.exact)
            meant = self.reduced.meant[self.reduced.states[places]].tolist()
            found = read(self.conditions.program, meant, at._replace(x=nearby))
            return nearby.at[places].set(jnp.where(jnp.isfinite(found), found, nearby[places]))

        return closed

    # -- errors ------------------------------------------------------------------------------------

    def _refuse(self, plan: InitializationProblem, start: Values, found: InitialStates) -> NoReturn:
        """Say which conditions are not met, and what stands in their way.

        Raises:
            InitializationError: always.
        """
        rest, names = np.asarray(found.residuals), self.conditions.names(plan.starts, plan.resting)
        if not np.isfinite(rest).all():
            at = start._replace(x=self.conditions.starts(start.packed))
            program = self.conditions.program
            reason = explain_nonfinite(program, at, self.reduced.name, program.all_nodes)
            without = listing([names[i] for i in np.flatnonzero(~np.isfinite(rest))])
            raise InitializationError(
                "no initial values were found: the model's equations have no finite values at its starts. "
                + (
                    reason
                    or f"Without one: {without}. Give start values nearer to the solution (ac.Start)."
                )
            )
        wrong = np.flatnonzero(np.abs(rest) >= LEFT_OVER)
        off = listing([f"{names[i]} by {abs(rest[i]):.3g}" for i in wrong])
        held = self._held(plan, start._replace(x=found.x), wrong)
        if plan.rests_alone and not held:
            raise InitializationError(
                f"no rest was found near the start; where the search ended: {off}. Does the model come to rest at "
                "all? Give starts nearer to it (x0={...}), let only some states rest (steady=[...]), or simulate "
                "until nothing changes."
            )
        moved = [self.names[i] for i in plan.moved]
        many, few = _counted(len(rest), "condition"), _counted(len(moved), "free state")
        parts = [f"the initial conditions cannot all hold; not met: {off}"]
        if held or len(rest) > len(moved):
            parts.append(f"{many}, but only {few}" + (f" ({listing(moved, 6)})" if moved else ""))
        if held:
            parts.append(f"{listing(held, 6)} cannot move, being fixed or given")
        fixed = [n for i, n in enumerate(self.names) if n in held and self.conditions.fixed[i]]
        remedy = (
            f"The model does not rest at the fixed {listing(fixed, 6)}: make such starts guesses (fixed=False), or "
            "name the states that are to rest (steady=[...])."
            if fixed and wrong[-1] >= len(names) - len(plan.resting)
            else "Is a start fixed twice, or in conflict with a connection? Make one of them a guess (fixed=False), "
            "give starts nearer to a solution, or take the nearest values (least_squares=True)."
        )
        raise InitializationError(f"{'; '.join(parts)}. {remedy}")

    def _held(self, plan: InitializationProblem, found: Values, wrong: np.ndarray) -> list[str]:
        """States that cannot change although violated conditions depend on them."""

        def residual(x: Array) -> Array:
            return self.conditions.residuals(plan.starts, plan.resting, found._replace(x=x))

        jacobian = np.asarray(jax.jacfwd(residual)(found.x))[wrong]
        hit = np.abs(jacobian).max(axis=0, initial=0.0) > 0
        return [n for i, n in enumerate(self.names) if hit[i] and i not in plan.moved]


def _counted(n: int, what: str) -> str:
    return f"{n} {what}" if n == 1 else f"{n} {what}s"


def _roles(plan: InitializationProblem, jacobian: np.ndarray) -> list[str]:
    """What determined each of the states that moved."""
    if plan.least_squares:
        return ["fitted"] * len(plan.moved)
    _, sizes, rows = np.linalg.svd(jacobian)
    rank = int((sizes > INDEPENDENT * sizes.max(initial=0.0)).sum())
    is_open = np.abs(rows[rank:]).max(axis=0, initial=0.0) > INDEPENDENT
    touched = np.abs(jacobian).max(axis=0) > 0
    return [
        "start" if not hit else "chosen" if undetermined else "computed"
        for hit, undetermined in zip(touched, is_open, strict=True)
    ]


def initializer(
    reduced: ReducedModel, program: Program, parameters: ParameterLayout
) -> Initializer:
    """The initialization problem of a model."""
    return Initializer(initial_conditions(reduced, program, parameters))
