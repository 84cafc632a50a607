"""Fixed steps: one step of a scheme, and its repetition.

Explicit Runge–Kutta schemes are unrolled from the diffrax solver's own tableau, so that XLA sees plain
arithmetic with constant coefficients; of any other solver the `step` method is called.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.typing import ArrayLike

from acausal._jax import stored_scan
from acausal.data import bow
from acausal.simulation.inputs import Drive, Samples
from acausal.simulation.solvers import Solver

if TYPE_CHECKING:
    from acausal.system import System

Field = Callable[[ArrayLike, Array, Any], Array]
"""The right-hand side within a step: (fraction of the step, state, arguments) -> derivative."""

_Args = tuple[Any, tuple[Drive | None, ...], "Step"]
"""What a right-hand side needs beside the state: parameters, inputs that are functions, the step."""

Stepper = Callable[[Field, Array, ArrayLike, Any, Array | None], Array]
"""One step of a scheme: (field, state, length, arguments, derivative at the start if known) -> state."""


class Steps(eqx.Module):
    """A row of n steps.

    Attributes:
        t: their starts, shape (n,), in seconds.
        h: their lengths in seconds, shape (n,), or () where all are equal.
        inputs: what drives the model over each.
    """

    t: Array
    h: Array
    inputs: Samples


class Step(eqx.Module):
    """One of `Steps`: its start and length, the inputs at both ends, and how they bend in between."""

    t: Array
    h: Array
    start: Array
    end: Array
    bends: Array | None

    def time(self, fraction: ArrayLike) -> Array:
        """The time at a fraction of the step."""
        return self.t if _is_zero(fraction) else self.t + fraction * self.h

    def inputs(self, fraction: ArrayLike, functions: tuple[Drive | None, ...]) -> Array:
        """The inputs at a fraction of the step, shape (number of inputs,)."""
        u = self._sampled(fraction)
        if all(f is None for f in functions):
            return u
        t = self.time(fraction)
        return jnp.stack([v if f is None else f(t) for v, f in zip(u, functions, strict=True)])

    def _sampled(self, fraction: ArrayLike) -> Array:
        if _is_zero(fraction):
            return self.start
        on_line = self.start + fraction * (self.end - self.start)
        return on_line if self.bends is None else on_line + bow(self.bends, fraction)


def _is_zero(fraction: ArrayLike) -> bool:
    return isinstance(fraction, float) and fraction == 0.0


def integrate(
    system: System,
    packed: Any,
    x0: Array,
    steps: Steps,
    solver: Solver,
    *,
    outputs: Sequence[str] = (),
    substeps: int = 1,
    direct: bool = False,
) -> tuple[Array, Array | None, Array]:
    """Integrate the model over a row of steps. Pure: trace, differentiate and map it.

    Arguments:
        system: the model.
        packed: its parameters, `system.pack(params)`.
        x0: initial state, shape (number of states,).
        steps: the n steps and their inputs.
        solver: a one-step diffrax solver, from `solvers.for_fixed_steps`.
        outputs: variables to observe at the start of every step, where their terms are shared with the
            first stage of an explicit scheme.
        substeps: equal parts that each step is divided into.
        direct: whether derivatives in forward mode must work, too; those in reverse mode then take more memory.

    Returns:
        The states at the steps' starts, shape (n, number of states); the outputs there, shape
        (n, number of outputs), ``None`` without any; the state at the end. A step whose equations are not
        solved gives NaN.
    """
    outputs = tuple(outputs)
    explicit = isinstance(solver, dfx.AbstractERK)
    advance = _explicit(solver) if explicit else _implicit(solver)
    equal = steps.h if steps.h.ndim == 0 else None
    constants, fixed = eqx.partition((packed, steps.inputs.functions, equal), eqx.is_array)

    def field(fraction: ArrayLike, x: Array, args: _Args) -> Array:
        packed, functions, step = args
        return system.vector_field(step.time(fraction), x, step.inputs(fraction, functions), packed)

    def part(x: Array, j: ArrayLike, args: _Args, slope: Array | None) -> Array:
        def within(fraction: ArrayLike, x: Array, args: Any) -> Array:
            j, args = args
            return field((j + fraction) / substeps, x, args)

        return advance(within, x, args[2].h / substeps, (j, args), slope)

    def whole(x: Array, args: _Args, slope: Array | None) -> Array:
        if substeps == 1:
            return advance(field, x, args[2].h, args, slope)
        x = part(x, jnp.zeros((), x.dtype), args, slope)
        rest = jnp.arange(1.0, substeps, dtype=x.dtype)
        return jax.lax.scan(lambda x, j: (part(x, j, args, None), None), x, rest)[0]

    def observe(x: Array, args: _Args) -> tuple[Array | None, Array | None]:
        packed, functions, step = args
        point = (step.t, x, step.inputs(0.0, functions), packed)
        if not outputs:
            return None, None
        if explicit:
            return system.vector_field_and_observe(outputs, *point)
        return None, system.observe(outputs, *point)

    def step(constants: Any, x: Array, row: Any) -> tuple[Array, Array | None]:
        packed, functions, equal = eqx.combine(constants, fixed)
        t, own, start, end, bends = row
        args = packed, functions, Step(t, equal if own is None else own, start, end, bends)
        slope, y = observe(x, args)
        return whole(x, args, slope), y

    own, samples = None if equal is not None else steps.h, steps.inputs
    rows = (steps.t, own, samples.start, samples.end, samples.bends)
    xs, end, ys = stored_scan(step, constants, x0, rows, direct=direct)
    return xs, ys, end


def _explicit(solver: dfx.AbstractERK) -> Stepper:
    """An explicit Runge–Kutta step, unrolled, without the stages that serve only an error estimate."""
    tableau: Any = solver.tableau
    rows = [[], *([float(a) for a in row] for row in tableau.a_lower)]
    fractions = [0.0, *(float(c) for c in tableau.c)]
    weights = [float(b) for b in tableau.b_sol]
    needed = max(i for i, b in enumerate(weights) if b) + 1

    def step(field: Field, x: Array, h: ArrayLike, args: Any, slope: Array | None) -> Array:
        slopes = [] if slope is None else [slope]
        for i in range(len(slopes), needed):
            slopes.append(field(fractions[i], _sum(x, h, rows[i], slopes), args))
        return _sum(x, h, weights, slopes)

    return step


def _sum(x: Array, h: ArrayLike, weights: Sequence[float], slopes: Sequence[Array]) -> Array:
    for weight, slope in zip(weights, slopes, strict=False):
        x = x + (weight * h) * slope if weight else x
    return x


def _implicit(solver: Solver) -> Stepper:
    """A solver's own `step`, in local time from 0 to h."""

    def step(field: Field, x: Array, h: Any, args: Any, slope: Array | None) -> Array:
        term = dfx.ODETerm(lambda t, x, args: field(t / h, x, args))
        start, h, args = _strong((jnp.zeros_like(h), h, args))
        memory = solver.init(term, start, h, x, args)
        x, _, _, _, result = solver.step(term, start, h, x, args, memory, False)
        return jnp.where(result == dfx.RESULTS.successful, x, jnp.nan)

    return step


def _strong(tree: Any) -> Any:
    """Arrays without JAX's weak types, which diffrax would take for a change of type within its loops."""
    return jax.tree.map(
        lambda a: jax.lax.convert_element_type(a, a.dtype) if eqx.is_array(a) else a, tree
    )
