"""Newton's method for the equation of an implicit step, ``x - c f(x) = known``.

A step of a multistep method is one such equation, a stage of a diagonally implicit Runge–Kutta step another.
E. Hairer, G. Wanner: Solving Ordinary Differential Equations II, Springer 1996, section IV.8.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax
from jax.typing import DTypeLike
from jaxtyping import Array, Bool, Float, Int, PyTree

from acausal._jax import without_derivatives
from acausal.codegen import StateJacobian

State = Float[Array, " n_states"]

Rates = Callable[[State], State]
"""The derivatives of the states at one time; a `codegen.Field` if the model has open loops."""

SLOW = 0.1
"""The ratio of two corrections beyond which the matrix is renewed, where it may be."""

KAPPA = 0.01
"""The part of the tolerance that may remain as error of a stage."""

SHORTEST = 1e-4
"""The shortest part of a correction that is tried."""

STAGE_TOLERANCE = {"float64": 1e-9, "float32": 1e-5}
"""Tolerance of the state in the equations of fixed steps, relative and absolute, by precision."""

STALLS, GROWS = 0.9, 10.0
"""Between these ratios of what two corrections leave of the equation, only roundoff is left, if they are tolerated."""

FREE, SHRINKS, CREEPS, ROUNDING = 1.0, 0.5, 1e-6, 16.0
"""With the derivatives of a stiff branch, corrections are small on any other branch, too. So where the equation is
off by more than so many tolerances, a small correction is the last only if the next one shrinks by the second part. If
it hardly does, the derivatives are those of another branch; unless it is less than the third part of what may remain,
or than so many rounding errors of the state."""

OF_STALL = 0.3
"""The part of such a correction that may remain as error."""

LEAST = {"float64": 1e-30, "float32": 1e-8}
"""States of fixed steps are found to the tolerance relative to their own size down to this, as far as roundoff lets."""

STAGE_STEPS = 100
"""Newton steps allowed in each of them: there is no shorter step to try instead."""


class Tolerances(eqx.Module):
    """What counts as small: relative and absolute tolerances of the states."""

    rtol: Float[Array, "*n_states"]
    atol: Float[Array, "*n_states"]

    def size(self, change: State, *states: State) -> Float[Array, ""]:
        """The root mean square of a change over what the tolerances allow at some states."""
        if not change.size:
            return jnp.zeros((), change.dtype)
        largest = jnp.abs(states[0])
        for x in states[1:]:
            largest = jnp.maximum(largest, jnp.abs(x))
        return jnp.sqrt(jnp.mean((change / (self.atol + self.rtol * largest)) ** 2))


class Patience(NamedTuple):
    """When the iteration stops.

    Attributes:
        most: corrections at most. diverges: the ratio of two corrections from which on it is given up.
        renews: whether the matrix is renewed where corrections shrink slowly.
        damps: whether it begins again with shorter corrections where it fails.
        doubts: whether the rates may have branches, so that a small correction is not taken at its word.
        least: the size of states, by precision, down to which corrections are relative to it while they still shrink;
            ``None`` where they are what the tolerances say.
    """

    most: int
    diverges: float
    renews: bool = True
    damps: bool = False
    doubts: bool = False
    least: Mapping[str, float] | None = None

    def size(self, tolerances: Tolerances, change: State, *states: State) -> Float[Array, ""]:
        """That of a correction, or of what it leaves of the equation, while these still shrink."""
        if self.least is not None:
            least = tolerances.rtol * self.least[change.dtype.name]
            tolerances = Tolerances(tolerances.rtol, least)
        return tolerances.size(change, *states)

    def stalls(self, tolerated: Array, ratio: Array, left: Any) -> Array:
        """Whether a correction was the last, as roundoff is left of the equation: ``ratio`` of what was left before."""
        if self.least is None:
            return jnp.zeros_like(ratio, bool)
        return (ratio > STALLS) & (ratio < GROWS) & (OF_STALL * tolerated < left)


ADAPTIVE = Patience(10, 2.0)
FIXED = Patience(STAGE_STEPS, np.inf, damps=True, least=LEAST)


def fixed_tolerances(dtype: DTypeLike) -> Tolerances:
    """Those of the equations of fixed steps, which have no others."""
    tolerance = jnp.asarray(STAGE_TOLERANCE[np.dtype(dtype).name], dtype)
    return Tolerances(tolerance, tolerance)


class Newton(NamedTuple):
    """The iteration.

    Attributes:
        x: the solution so far. factors: of the matrix, where it may be renewed.
        size: of the last correction over what is allowed. remains: of the equation before it, likewise.
        rate: by which corrections shrink. slow: whether that is slow.
        small: whether the last one was. turned: whether the derivatives are those of another branch.
        made: how many there were. jacobians: and how often the matrix was made.
        done, failed: why it stops.
    """

    x: State
    factors: Any
    size: Float[Array, ""]
    remains: Float[Array, ""]
    rate: Float[Array, ""]
    slow: Bool[Array, ""]
    small: Bool[Array, ""]
    turned: Bool[Array, ""]
    made: Int[Array, ""]
    jacobians: Int[Array, ""]
    done: Bool[Array, ""]
    failed: Bool[Array, ""]


class Fields(eqx.Module):
    """Right-hand sides: a time, or a fraction of a step -> derivatives as a function of the states.

    Attributes:
        function: of the time and the arguments. args: whatever has derivatives.
    """

    function: Callable[[Array | float, Any], Rates] = eqx.field(static=True)
    args: PyTree

    def __call__(self, at: Array | float) -> Rates:
        """That at a time."""
        return self.function(at, self.args)


class Equation(eqx.Module):
    """The equation ``x - c f(x) = known``.

    Attributes:
        fields: the right-hand sides. at: the time of f, as they take it. c, known: as above.
        before: a state that says, with x, how large a correction is.
    """

    fields: Fields
    at: Float[Array, ""]
    c: Float[Array, ""]
    known: State
    before: State

    @property
    def rates(self) -> Rates:
        """The right-hand side, f."""
        return self.fields(self.at)

    def residual(self, x: State) -> State:
        """What is left."""
        return x - self.known - self.c * self.rates(x)


def solve(
    equation: Equation,
    jacobian: StateJacobian,
    factors: Any,
    guess: State,
    tolerances: Tolerances,
    left: Array | float,
    patience: Patience,
    scale: Array | float = 1.0,
) -> Newton:
    """Solve an equation; the solution has derivatives of any order, by the implicit function theorem.

    Arguments:
        equation: what to solve.
        jacobian: of the model. factors: of the matrix ``I - c J``, to begin with.
        guess: where to begin.
        tolerances: of the state. left: the part of them that may remain as error.
        patience: when to stop.
        scale: of the corrections, where the factors are those for another coefficient.
    """
    whole, no = equation, jnp.array(False)
    equation, factors, guess, scale = without_derivatives((equation, factors, guess, scale))

    def correct(n: Newton) -> Newton:
        own = factors
        if patience.renews:
            again = lambda: jacobian.factorized(equation.rates, n.x, equation.c)  # noqa: E731
            own = lax.cond(n.slow, again, lambda: n.factors)
        residual = equation.residual(n.x)
        remains = n.remains  # asked for in fixed steps alone
        if patience.least is not None:
            remains = patience.size(tolerances, residual, equation.before, equation.known)
        correction = scale * jacobian.iteration_matrix.solve(own, residual)
        x = n.x - correction
        size = patience.size(tolerances, correction, equation.before, x)
        ratio, later, made = size / n.size, n.made > 0, n.made + 1
        rate = jnp.where(later, jnp.maximum(0.3 * n.rate, ratio), n.rate)
        tolerated = tolerances.size(correction, equation.before, x)
        stalls = (n.made > 1) & patience.stalls(tolerated, remains / n.remains, left)
        small = size * jnp.minimum(1.0, rate) < left
        settled, turned = small, no
        if patience.doubts:
            is_off = tolerances.size(residual, equation.before, equation.known) > FREE
            least = ROUNDING * jnp.finfo(x.dtype).eps * tolerances.size(x, equation.before, x)
            is_noise = size <= jnp.maximum(least, CREEPS * left)
            turned = later & is_off & (ratio > STALLS) & (ratio < patience.diverges) & ~is_noise
            settled = small & ((n.small & ((ratio < SHRINKS) | is_noise)) | ~is_off)
        done = (size == 0) | settled | stalls
        diverged = later & (ratio > patience.diverges) & (n.slow | (not patience.renews))
        diverged = diverged | turned
        failed = ~done & (diverged | (made >= patience.most)) | ~jnp.isfinite(size)
        kept = own if patience.renews else None
        jacobians = n.jacobians + (n.slow if patience.renews else 0)
        slow = later & (ratio > SLOW)
        done = done & ~failed
        return Newton(
            x, kept, size, remains, rate, slow, small, turned, made, jacobians, done, failed
        )

    one, none = jnp.ones((), guess.dtype), jnp.zeros((), jnp.int32)
    kept = factors if patience.renews else None
    begun = Newton(guess, kept, one, one, one, no, no, no, none, none, no, no)
    found = lax.while_loop(lambda n: ~(n.done | n.failed), correct, begun)
    if patience.damps:
        again = lambda: _damped(equation, jacobian, tolerances, left, patience, found)  # noqa: E731
        found = lax.cond(found.failed, again, lambda: found)
    return found._replace(x=_root(found.x, jacobian, whole))


@eqx.filter_custom_jvp
def _root(found: State, jacobian: StateJacobian, equation: Equation) -> State:
    """A solution that is found already."""
    return found


@_root.def_jvp
def _(primals: Any, tangents: Any) -> tuple[State, State | None]:
    jacobian, equation = primals[1:]
    x = _root(*primals)
    _, change = eqx.filter_jvp(lambda e: e.residual(x), (equation,), (tangents[2],))
    if change is None:  # the equation reads nothing that moves
        return x, None
    factors = jacobian.factorized(equation.rates, x, equation.c)
    return x, -jacobian.iteration_matrix.solve(factors, change)


def _damped(
    equation: Equation,
    jacobian: StateJacobian,
    tolerances: Tolerances,
    left: Array | float,
    patience: Patience,
    found: Newton,
) -> Newton:
    """Begin again with derivatives of zero; each correction is halved until less is left of the equation."""

    def remaining(x: State) -> tuple[State, Array]:
        residual = equation.residual(x)
        return residual, tolerances.size(residual, equation.before, equation.known)

    def correct(state: tuple[Newton, State, Array]) -> tuple[Newton, State, Array]:
        n, residual, remains = state
        factors = jacobian.factorized(equation.rates, n.x, equation.c)
        whole = jacobian.iteration_matrix.solve(factors, residual)

        def shorter(trial: Any) -> Any:
            share = trial[0] / 2
            x = n.x - share * whole
            return (share, x, *remaining(x))

        goes_on = lambda trial: ~(trial[3] < remains) & (trial[0] > SHORTEST)  # noqa: E731
        begin = jnp.full_like(n.size, 2.0), n.x, residual, jnp.full_like(remains, jnp.inf)
        share, x, residual, remains = lax.while_loop(goes_on, shorter, begin)
        size = patience.size(tolerances, share * whole, equation.before, x)
        tolerated, made = tolerances.size(whole, equation.before, x), n.made + 1
        rate = jnp.where(n.made > found.made, size / n.size, 1.0)
        left_of = patience.size(tolerances, residual, equation.before, equation.known)
        stalls = (n.made > found.made) & patience.stalls(tolerated, left_of / n.remains, left)
        small = (share == 1) & (size * jnp.minimum(1.0, rate) < left)
        near = (size == 0) | small | stalls
        failed = ~jnp.isfinite(remains) | (made >= 2 * STAGE_STEPS)
        after = n._replace(
            x=x,
            size=size,
            remains=left_of,
            rate=rate,
            made=made,
            jacobians=n.jacobians + 1,
            done=near,
            failed=failed,
        )
        return after, residual, remains

    begun = found._replace(x=equation.known, failed=jnp.array(False))
    goes_on = lambda state: ~(state[0].done | state[0].failed)  # noqa: E731
    return lax.while_loop(goes_on, correct, (begun, *remaining(begun.x)))[0]
