"""Runge–Kutta schemes: explicit ones, their steps from the tableau and in reverse, and diagonally implicit ones."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, ClassVar

import diffrax as dfx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Float

from acausal.simulation.newton import Fields, Rates
from acausal.simulation.stages import ImplicitScheme, stages
from acausal.simulation.steps.one_step import Made, Memory, OneStep, State, part_of_step
from acausal.simulation.steps.problem import Attempt, Counts, Integration, RightHandSide
from acausal.simulation.tableau import Tableau, moved, tableau_of

MANY = 256
"""States from which on a step is made in reverse stage by stage, as it is where the right-hand side is long.

XLA compiles the loop of a small model as a whole if all stages are written out, which can be eight times faster.
"""


class Explicit(OneStep):
    """An explicit Runge–Kutta scheme."""

    def make(self, field: RightHandSide, t: Array, h: Array, x: State, first: State) -> Made:
        """One step."""
        tableau = tableau_of(self.solver)
        stages = self._stages(tableau, field, t, h, x, first)
        if tableau.hands_on:
            end, last = moved(x, h, tableau.rows[-1], stages), stages[-1]
        else:
            end = moved(x, h, tableau.weights, stages)
            last = field(t + h, end)
        error = moved(jnp.zeros_like(x), h, tableau.errors, stages)
        k = h * jnp.stack(stages)
        counts = Counts.of(rates=len(stages) - 1 + (not tableau.hands_on))
        done = jnp.array(True)
        fastest = _fastest(tableau, x, h, stages, end)
        return Made(end, error, {"y0": x, "y1": end, "k": k}, last, done, fastest, counts)

    def _stages(
        self, tableau: Tableau, field: RightHandSide, t: Array, h: Array, x: State, first: State
    ) -> list[State]:
        """The derivatives of all stages: in a loop where the right-hand side is long, else written out."""
        if field.is_long:
            c = self._tableau(h.dtype)[2]
            known = jnp.zeros((len(c), *x.shape), x.dtype).at[0].set(first)
            return list(self._loop(lambda i, inner: field(t + c[i] * h, inner), h, x, known, 1))
        stages = [first]
        for row, fraction in zip(tableau.rows[1:], tableau.fractions[1:], strict=True):
            stages.append(field(t + fraction * h, moved(x, h, row, stages)))
        return stages

    def _loop(
        self,
        rates: Callable[[Array, State], State],
        h: Array,
        x: State,
        stages: Float[Array, "n_stages n_states"],
        begin: int,
    ) -> Float[Array, "n_stages n_states"]:
        """The derivatives of the stages from one on, by stage and state; those before it are known."""
        a = self._tableau(h.dtype)[0]

        def one(i: Array, stages: Array) -> Array:
            return stages.at[i].set(rates(i, x + h * (a[i] @ stages)))

        return lax.fori_loop(begin, len(a), one, stages)

    def back(
        self,
        of_moved: Any,
        own: list[Array],
        row: Any,
        begin: State,
        adjoint: State,
        to_saved: Float[Array, "n_saved n_states"],
        which: tuple[Array, Array],
    ) -> tuple[State, list[Array]]:
        """See `OneStep.back`.

        One stage at a time: XLA would fuse the sums over all stages into whatever reads a piece of them, and compute
        them again for each. Of stage i, at the state ``x + h sum a_ij k_j``, the cotangent is ``b_i`` of the end's
        and ``a_ji`` of what each later one has handed on.
        """
        if begin.size < MANY and not of_moved(own)[1].field.is_long:
            return super().back(of_moved, own, row, begin, adjoint, to_saved, which)
        a, b, c = self._tableau(row.h.dtype)
        t, h, n = row.t, row.h, len(c)
        linear = jnp.zeros(
            (n + 2, *begin.shape), begin.dtype
        )  # the interpolation is: any values will do
        linear = {"y0": linear[0], "y1": linear[1], "k": linear[2:]}
        dense = self._to_dense(of_moved(own)[1].ts, row, linear, to_saved, which)
        to_end = adjoint + dense["y1"]

        def rates(i: Array, own: list[Array], x: State) -> State:
            return of_moved(own)[1].field(t + c[i] * h, x)

        def reverse(carry: tuple[Array, Array, list[Array]]) -> tuple[Array, Array, list[Array]]:
            i, handed, totals = carry
            to_stage = h * (b[i] * to_end + a[:, i] @ handed + dense["k"][i])
            pull = jax.vjp(partial(rates, i), own, begin + h * (a[i] @ stages))[1]
            by_own, by_x = pull(to_stage)
            totals = [total + own for total, own in zip(totals, by_own, strict=True)]
            return i - 1, handed.at[i].set(by_x), totals

        nothing = jnp.zeros((n, *begin.shape), begin.dtype)
        stages = self._loop(lambda i, inner: rates(i, own, inner), h, begin, nothing, 0)
        unseen = (which[0] >= which[1]) & (b[-1] == 0)  # the last stage, where nothing is saved
        state = n - 1 - unseen, nothing, [jnp.zeros_like(v) for v in own]
        _, handed, totals = lax.while_loop(lambda s: s[0] >= 0, reverse, state)
        return to_end + dense["y0"] + jnp.sum(handed, axis=0), totals

    def _tableau(self, dtype: Any) -> tuple[Array, Array, Array]:
        """The matrix, the weights and the nodes, of all stages, the first included."""
        tableau = tableau_of(self.solver)
        parts = tableau.square(tableau.rows), tableau.weights, tableau.fractions
        a, b, c = (jnp.asarray(part, dtype) for part in parts)
        return a, b, c


def _fastest(tableau: Tableau, x: State, h: Array, stages: list[State], end: State) -> Array:
    """From the last two stages of a scheme that both are at the end of the step."""
    if not (tableau.hands_on and len(stages) > 2 and tableau.fractions[-2] == 1):
        return jnp.zeros_like(h)
    other = moved(x, h, tableau.rows[-2], stages)
    change, apart = stages[-1] - stages[-2], end - other
    size = jnp.sqrt(jnp.sum(apart**2))
    return lax.stop_gradient(jnp.sqrt(jnp.sum(change**2)) / jnp.where(size > 0, size, jnp.inf))


class Diagonal(OneStep):
    """A diagonally implicit Runge–Kutta scheme, each stage of which is solved by itself.

    Attributes:
        scheme: how stages are found.
    """

    scheme: ImplicitScheme

    def make(self, field: RightHandSide, t: Array, h: Array, x: State, first: State) -> Made:
        """One step."""
        tableau = self.scheme.tableau
        found = stages(self.scheme, Fields(_within, (field, t, h)), h, x, first)
        k = found.increments
        end = x + jnp.asarray(tableau.weights, x.dtype) @ k
        error = jnp.asarray(tableau.errors, x.dtype) @ k if tableau.errors else jnp.zeros_like(x)
        none = h == 0  # as events leave behind
        last = jnp.where(none, first, k[-1] / jnp.where(none, 1.0, h)).astype(x.dtype)
        counts = Counts.of(
            rates=found.corrections, jacobians=found.jacobians, corrections=found.corrections
        )
        dense = {"y0": x, "y1": end}
        if self.solver.interpolation_cls is not dfx.LocalLinearInterpolation:
            dense["k"] = k
        fastest = jnp.zeros_like(h)
        return Made(end, error, dense, last, found.done, fastest, counts, found.factors)

    small: ClassVar[float] = 1.0
    """Its interpolation is of lower order than its steps, and all of these are looked into."""

    def as_state(self, made: Made, off: State) -> State:
        """A fast mode follows its equilibrium: the defect is divided by the matrix of the stages."""
        solve = self.scheme.jacobian.iteration_matrix.solve
        return solve(lax.stop_gradient(made.factors), lax.stop_gradient(off))


def _within(fraction: Any, args: tuple[RightHandSide, Array, Array]) -> Rates:
    field, t, h = args
    return field.at(t + fraction * h)


class Paced(OneStep):
    """A one-step scheme whose steps count whatever their error is, and go from each known time to the next.

    Attributes:
        scheme: makes the steps.
    """

    scheme: OneStep

    def first(self, field: RightHandSide, t: Array, h: Array, x: Array, f: Array) -> Any:
        """What a step may use that begins here."""
        return self.scheme.first(field, t, h, x, f)

    def make(self, field: RightHandSide, t: Array, h: Array, x: Array, first: Any) -> Made:
        """One step."""
        made = self.scheme.make(field, t, h, x, first)
        knows = isinstance(self.scheme, Explicit)
        begin = first if knows else field(t, x)
        end = made.first if knows else field(t + h, made.x)
        return made._replace(dense={"ends": (x, made.x), "rates": (begin, end)})

    def between(self, dense: Any, t: Array, h: Array, at: Array) -> Array:
        """The state at a time within a step: on the cubic through its ends."""
        (x0, x1), (f0, f1), s = dense["ends"], dense["rates"], part_of_step(t, h, at)
        bend = (1 - 2 * s) * (x1 - x0) + (s - 1) * h * f0 + s * h * f1
        return (1 - s) * x0 + s * x1 + s * (s - 1) * bend

    def begin(self, problem: Integration, t: Array, x: Array) -> tuple[Memory, Counts]:
        """What is known at the begin, or after an event."""
        h = jnp.full_like(t, jnp.inf)
        zero = jnp.zeros((), jnp.int32)
        first = self.first(problem.field, t, jnp.ones_like(t), x, problem.field(t, x))
        return Memory(h, x, first, zero, zero), Counts.of(rates=1)

    chooses: ClassVar[bool] = False
    """Its steps are given."""

    def attempt(self, problem: Integration, memory: Memory, t: Array, h: Array) -> Attempt:
        """Make a step of length h from t."""
        made = self.make(problem.field, t, h, memory.x, memory.first)
        done = made.done & jnp.all(jnp.isfinite(made.x))
        again = jnp.where(done, jnp.inf, 0.0)  # it would be the same step
        after = memory._replace(h=again.astype(h.dtype), x=made.x, first=made.first)
        never = jnp.array(False)
        return Attempt(done, made.x, after, made.dense, (), never, never, made.counts)
