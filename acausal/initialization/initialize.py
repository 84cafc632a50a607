"""Initialize: consistent values of the states from starts, fixed starts, initial equations or rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NoReturn

import jax
import jax.numpy as jnp
import numpy as np
import optimistix as optx
from jaxtyping import Array, Float
from numpy.typing import ArrayLike

from acausal._jax import array, compiled, is_number, is_real, traced, without_derivatives
from acausal.codegen import (
    Dense,
    Packed,
    ParameterLayout,
    Program,
    Values,
    explain_nonfinite,
    read,
    root,
)
from acausal.errors import DataError, InitializationError, listing, nearest, need_flag, shown
from acausal.flattening import LeavesCaches
from acausal.initialization.conditions import Conditions, FixedStart, initial_conditions
from acausal.modeling import ByName, by_element, by_name, names_in
from acausal.structure import ReducedModel

MAX_STEPS = 100
RELAXING, SHORTER, GROWTH, TINY = 200, 4.0, (0.5, 10.0), 1e-300
"""So many steps lead to rest; one that leads nowhere is made so much shorter, others grow between these factors."""

LEFT_OVER = 1e-6
"""How far off a condition may be, in nominal values."""
ROUNDING = 1e-9
"""A condition is met but for rounding if states move by less, in nominal values, to meet it."""
INDEPENDENT = 1e-9
"""Derivatives below this fraction of the largest one count as zero."""


@dataclass(frozen=True)
class InitializationProblem:
    """One initialization problem: which states may change, and which conditions they must meet.

    Attributes:
        moved: states that may differ from their starts. ``starts``: fixed starts that must be met.
        resting: states that must be at rest. ``least_squares``: whether conditions are met in the least-squares sense.
    """

    moved: tuple[int, ...]
    starts: tuple[FixedStart, ...]
    resting: tuple[int, ...]
    least_squares: bool


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
        return self._solution(at, self.by_state(x0 or {}), steady, least_squares)[0]

    def solves(self, x0: Any, steady: bool | Sequence[str], least_squares: bool) -> bool:
        """Whether states follow from equations, and not from starts and ``x0`` alone."""
        if len(self.reduced.guessed) or (x0 is not None and not isinstance(x0, Mapping)):
            return len(self.reduced.guessed) > 0
        starts = jnp.zeros(len(self.names))
        return self._posed(starts, self.by_state(x0 or {}), steady, least_squares)[1] is not None

    def start_or_nan(
        self,
        packed: Packed,
        u0: Float[Array, " n_inputs"],
        t0: float | Array = 0.0,
    ) -> Float[Array, " n_states"]:
        """Initial states, or NaN where the conditions cannot all hold: for programs that raise no errors."""
        at = Values(array(t0), self.conditions.starts(packed), u0, packed)
        x, _, rest, _ = self._solution(at, {})
        return x if rest is None else jnp.where(jnp.all(jnp.abs(rest) < LEFT_OVER), x, jnp.nan)

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
        x, plan, rest, jacobian = self._solution(at, x0, steady, least_squares)
        roles = [
            "given" if name in x0 else "fixed" if fixed else "start"
            for name, fixed in zip(self.names, self.conditions.fixed, strict=True)
        ]
        roles[self.reduced.n_independent :] = ["computed"] * len(self.reduced.guessed)
        if plan is None:
            return Initialization(x, self.names, tuple(roles), (), np.zeros(0))
        for i, role in zip(plan.moved, _roles(plan, np.asarray(jacobian)), strict=True):
            roles[i] = role
        names = self.conditions.names(plan.starts, plan.resting)
        return Initialization(x, self.names, tuple(roles), tuple(names), np.asarray(rest))

    # -- the problem -------------------------------------------------------------------------------

    def _solution(
        self,
        at: Values,
        given: Mapping[str, ArrayLike],
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
    ) -> tuple[Array, InitializationProblem | None, Any, Any]:
        """The states, and of the conditions to be met, if any, what is left and the Jacobian."""
        x, plan = self._posed(at.x, given, steady, least_squares)
        if plan is None:
            return self.closed(at._replace(x=x)), None, None, None
        x, rest, jacobian = self._found(plan, at._replace(x=x))
        return self.closed(at._replace(x=x)), plan, rest, jacobian

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
        overruled = bool(given) and not (plan.moved or plan.resting)
        nothing = not (plan.starts or plan.resting or self.reduced.model.initial)
        return x, None if overruled or nothing else plan

    def by_state(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Values by state; a variable that is a state under another name gives the state's.

        Raises:
            DataError: for what is not a state, or two values of one.
        """
        found: dict[str, Any] = {}
        own = frozenset(self.names)
        given = by_element(given, own, "x0")
        for name in names_in(given, "x0"):
            state, value = name, given[name]
            index = self.reduced.model.layout.find_variable(name)
            if name not in own and index is not None:
                node, sign = self.reduced.resolve(index)
                places = np.flatnonzero(self.reduced.meant[self.reduced.states] == node).tolist()
                state = self.names[places[0]] if places else name
                value = -value if sign < 0 and is_number(value) else value
            if state not in own:
                self._known("x0", [state])
            if state in found:
                raise DataError(
                    f"x0: '{name}' and the state '{state}' are the same; give one of them"
                )
            found[state] = value
        return found

    def _known(self, argument: str, names: Sequence[str]) -> None:
        for name in names:
            if name not in self.names:
                raise DataError(f"{argument}: '{name}' is not a state; {nearest(name, self.names)}")

    # -- its solution ------------------------------------------------------------------------------

    def closed(self, at: Values) -> Array:
        """The states with the guesses of loops at the solutions; those that are NaN or missing begin at starts."""
        return self._closed(at) if len(self.reduced.guessed) else at.x

    @cached_property
    def _closed(self) -> Callable[[Values], Array]:
        """What `closed` computes, compiled once."""

        @compiled
        def closed(at: Values) -> Array:
            own, given = jnp.split(at.x, [self.reduced.n_independent])
            start = self.conditions.starts(at.packed)[len(own) :]
            guess = jnp.where(jnp.isfinite(given), given, start) if len(given) else start
            nearby = at._replace(x=jnp.concatenate([own, guess]))
            found = read(self.conditions.program, self.reduced.guessed.tolist(), nearby)
            return jnp.concatenate([own, jnp.where(jnp.isfinite(found), found, guess)])

        return closed

    def _found(self, plan: InitializationProblem, start: Values) -> tuple[Array, Array, Array]:
        """The states, the residuals of the conditions, and their Jacobian by the states that moved."""
        found = self._satisfied(plan, start)
        if plan.least_squares or traced(found[1]):
            return found
        alone = len(found[1]) == len(plan.resting) > 0  # no other conditions
        rests = alone and plan.moved == plan.resting
        if rests and not _holds(*found[1:]):
            relaxed = start._replace(x=self._relaxed(plan, start))
            again = self._satisfied(plan, relaxed)
            found = again if _holds(*again[1:]) else found
        if not _holds(*found[1:]):
            self._refuse(plan, start._replace(x=found[0]), np.asarray(found[1]))
        return found

    def _relaxed(self, plan: InitializationProblem, start: Values) -> Array:
        """States that all come to rest, each after a time of its own: linearly implicit steps that grow as they do so.

        C. T. Kelley, D. E. Keyes: Convergence Analysis of Pseudo-Transient Continuation, SIAM Journal on Numerical
        Analysis 35 (1998).
        """
        free = np.asarray(plan.moved, dtype=np.int64)
        nominal = np.asarray(self.conditions.nominal)[free]
        x, f, jacobian = np.asarray(start.x)[free] / nominal, *self._rates(plan, start, start.x)
        h = 1 / max(float(np.max(np.abs(jacobian), initial=0.0)), np.finfo(float).tiny)
        for _ in range(RELAXING):
            if not np.isfinite(f).all() or (np.abs(f) < LEFT_OVER).all():
                break
            with np.errstate(all="ignore"):
                there = x + np.asarray(_smallest(jnp.eye(len(x)) / h - jacobian, jnp.asarray(f)))
            g, jacobian_there = self._rates(plan, start, start.x.at[free].set(there * nominal))
            if np.isfinite(g).all():
                h *= float(np.clip(np.linalg.norm(f) / max(np.linalg.norm(g), TINY), *GROWTH))
                x, f, jacobian = there, g, jacobian_there
            else:
                h /= SHORTER
        return start.x.at[free].set(x * nominal)

    @cached_property
    def _looked(self) -> Callable[[InitializationProblem, Values], tuple[Array, Array]]:
        """The rates of resting states, in nominal values, and their Jacobian, compiled once for every plan."""

        @compiled
        def looked(plan: InitializationProblem, at: Values) -> tuple[Array, Array]:
            free = np.asarray(plan.moved, dtype=np.int64)
            nominal = self.conditions.nominal[free]

            def rates(z: Array) -> Array:
                moved = at._replace(x=at.x.at[free].set(z * nominal))
                return self.conditions.residuals((), plan.resting, moved)

            z = at.x[free] / nominal
            return rates(z), jax.jacfwd(rates)(z)

        return looked

    def _rates(
        self, plan: InitializationProblem, start: Values, x: Array
    ) -> tuple[np.ndarray, np.ndarray]:
        f, jacobian = self._looked(plan, start._replace(x=x))
        return np.asarray(f), np.asarray(jacobian)

    @cached_property
    def _satisfied(self) -> Callable[[InitializationProblem, Values], tuple[Array, Array, Array]]:
        """`_satisfy`, compiled once for every plan."""
        return compiled(self._satisfy)

    def _satisfy(self, plan: InitializationProblem, start: Values) -> tuple[Array, Array, Array]:
        """States that satisfy the conditions, the residuals, and their Jacobian.

        The solution is found without derivatives; one Newton step from there, which moves nothing, carries them.
        """
        free = np.asarray(plan.moved, dtype=np.int64)
        nominal = self.conditions.nominal[free]

        x = start.x

        def residual(z: Array, at: Values) -> Array:
            moved = at._replace(x=at.x.at[free].set(z * nominal))
            return self.conditions.residuals(plan.starts, plan.resting, moved)

        def stationary(z: Array, at: Values) -> Array:
            half = lambda z: jnp.sum(residual(z, at) ** 2) / 2  # noqa: E731
            return jax.grad(half)(z)

        packed, frozen_x = without_derivatives((start.packed, x))
        frozen = start._replace(x=frozen_x, packed=packed)
        if not plan.moved:
            rest = residual(jnp.zeros(0), frozen)
            return x, rest, jnp.zeros((len(rest), 0))
        z0 = x[free] / nominal
        guess = jax.lax.stop_gradient(z0)
        least = _least_squares if plan.least_squares else _least_change
        z = jax.lax.stop_gradient(least(lambda z: residual(z, frozen), guess))
        vanishing = stationary if plan.least_squares else residual
        jacobian = jax.jacfwd(lambda z: vanishing(z, frozen))(z)
        change = z0 - guess
        z = z + change - _smallest(jacobian, vanishing(z, start) + jacobian @ change)
        at = jax.lax.stop_gradient(z)
        rest = residual(at, frozen)
        return x.at[free].set(z * nominal), rest, jax.jacfwd(lambda z: residual(z, frozen))(at)

    # -- errors ------------------------------------------------------------------------------------

    def _refuse(self, plan: InitializationProblem, found: Values, rest: np.ndarray) -> NoReturn:
        wrong = np.flatnonzero(~(np.abs(rest) < LEFT_OVER))
        names = self.conditions.names(plan.starts, plan.resting)
        if not np.isfinite(rest).all():
            start = found._replace(x=self.conditions.starts(found.packed))
            program = self.conditions.program
            reason = explain_nonfinite(program, start, self.reduced.name, program.all_nodes)
            without = listing([names[i] for i in np.flatnonzero(~np.isfinite(rest))])
            raise InitializationError(
                "no initial values were found: the model's equations have no finite values at its starts. "
                + (
                    reason
                    or f"Without one: {without}. Give start values nearer to the solution (ac.Start)."
                )
            )
        off = [f"{names[i]} by {abs(rest[i]):.3g}" for i in wrong]
        moved = [self.names[i] for i in plan.moved]
        held = self._held(plan, found, wrong)
        parts = [
            f"the initial conditions cannot all hold; not met: {listing(off)}",
            f"{len(rest)} conditions, but only {len(moved)} free states"
            + (f" ({listing(moved, 6)})" if moved else ""),
            *([f"{listing(held, 6)} cannot move, being fixed or given"] if held else []),
        ]
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


def _holds(rest: ArrayLike, jacobian: ArrayLike) -> bool:
    """Whether conditions are met, by what is left of them: little, or what rounding makes of fast rates."""
    left, by = np.asarray(rest), np.asarray(jacobian)
    if (np.abs(left) < LEFT_OVER).all() or not (np.isfinite(left).all() and by.size):
        return bool((np.abs(left) < LEFT_OVER).all())
    change = np.asarray(_smallest(jnp.asarray(by), jnp.asarray(left)))
    met = np.abs(left - by @ change) < LEFT_OVER
    return bool(met.all() and (np.abs(change) < ROUNDING).all())


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


def _least_change(residual: Callable[[Array], Array], guess: Array) -> Array:
    """Newton's method with the smallest steps: a root near the guess even if there are many."""
    return root(Dense(lambda x: (x, residual(x)), _smallest), guess, max_steps=MAX_STEPS)[0]


def _smallest(jacobian: Float[Array, "k m"], r: Float[Array, " k"]) -> Float[Array, " m"]:
    """The smallest step that satisfies the linear equations, with equal weight for each equation."""
    size = jnp.max(jnp.abs(jacobian), axis=1, initial=0.0)
    weight = 1 / jnp.where(size > 0, size, 1.0)
    return jnp.linalg.pinv(weight[:, None] * jacobian) @ (weight * r)


def _least_squares(residual: Callable[[Array], Array], guess: Array) -> Array:
    solver = optx.LevenbergMarquardt(rtol=1e-10, atol=1e-12)
    found = optx.least_squares(lambda z, _: residual(z), solver, guess, max_steps=1000, throw=False)
    return found.value


def initializer(
    reduced: ReducedModel, program: Program, parameters: ParameterLayout
) -> Initializer:
    """The initialization problem of a model."""
    return Initializer(initial_conditions(reduced, program, parameters))
