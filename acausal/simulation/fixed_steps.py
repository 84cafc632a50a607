"""Fixed steps: one step of a scheme, and its repetition.

Explicit Runge–Kutta schemes are unrolled, so that XLA sees plain arithmetic with constant coefficients. Where there
are nonlinear loops to solve, stages are a loop: XLA compiles it several times faster, and it runs as fast.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array, Float, PyTree

from acausal._jax import Restarts, stored_scan
from acausal.codegen import StateJacobian, Values
from acausal.data import Signal, deviation_from_line
from acausal.simulation.log import Log
from acausal.simulation.newton import FIXED, Fields, Rates, fixed_tolerances
from acausal.simulation.sampled_inputs import Samples
from acausal.simulation.solvers import EXPLICIT, Scheme
from acausal.simulation.stages import ImplicitScheme, stages
from acausal.simulation.tableau import Tableau, moved, tableau_of

if TYPE_CHECKING:
    from acausal.system import System

SIDE = 16.0
"""So many rounding errors is each stage within its step, where a source may jump at the ends."""

EDGES = 3
"""A step is divided at so many edges of sources, the first that lie within it."""

State: TypeAlias = Float[Array, " n_states"]

Field = Callable[[ArrayLike, PyTree], Rates]
"""The right-hand side within a step: (fraction of the step, arguments) -> derivatives as a function of the states."""

Part: TypeAlias = tuple[Any, Any]
"""A part of a step, between two fractions of it."""

Stepper = Callable[[Field, State, Float[Array, ""], PyTree, State | None], State]
"""One step of a scheme: (field, state, length, arguments, derivative at the start if known) -> state."""


class Parts(eqx.Module):
    """The inputs over parts of steps, as they jump or bend within.

    Attributes:
        cuts: the fractions of a step at which one part ends and the next begins, shape (n, p), increasing; 1 where
            there is none. inputs: over each of p + 1 parts, arrays of shape (n, p + 1, ...).
    """

    cuts: Float[Array, "n p"]
    inputs: Samples

    def at(self, fraction: ArrayLike, around: ArrayLike) -> Float[Array, " n_inputs"]:
        """Of one step: the inputs at a fraction of it, as they are in the part around another."""
        cuts, u = jnp.pad(self.cuts, 1, constant_values=(0.0, 1.0)), self.inputs
        i = jnp.sum(self.cuts <= around)
        length = cuts[i + 1] - cuts[i]
        of_part = (fraction - cuts[i]) / jnp.where(length > 0, length, 1.0)
        coefficients = None if u.coefficients is None else u.coefficients[i]
        return on_curve(u.start[i], u.end[i], coefficients, of_part)


class Steps(eqx.Module):
    """A sequence of n steps, or one of them, whose arrays have no axis of steps.

    Attributes:
        t: their starts, shape (n,), in seconds.
        h: their lengths in seconds, shape (n,), or () where all are equal.
        inputs: the inputs over each of them. parts: over parts of them, where inputs jump or bend within.
    """

    t: Float[Array, " n"]
    h: Float[Array, "*n"]
    inputs: Samples
    parts: Parts | None = None

    def time(self, fraction: ArrayLike) -> Float[Array, ""]:
        """Of one step: the time at a fraction of it."""
        return self.t if _is_zero(fraction) else self.t + fraction * self.h

    def inputs_at(
        self, fraction: ArrayLike, t: Array | None = None, around: ArrayLike | None = None
    ) -> Float[Array, " n_inputs"]:
        """Of one step: the inputs at a fraction of it; functions of time as they are at ``t``, if that is given.

        Where they jump within the step, they are those of the part around a fraction.
        """
        known = self.inputs
        if _is_zero(fraction):
            u = known.start
        elif self.parts is not None:
            u = self.parts.at(fraction, fraction if around is None else around)
        else:
            u = on_curve(known.start, known.end, known.coefficients, fraction)
        if all(f is None for f in known.functions):
            return u
        t = self.time(fraction) if t is None else t
        pairs = zip(u, known.functions, strict=True)
        return jnp.stack([v if f is None else f(t) for v, f in pairs])


def on_curve(start: Array, end: Array, coefficients: Array | None, fraction: ArrayLike) -> Array:
    """A point of a polynomial between two ends."""
    on_line = start + fraction * (end - start)
    return (
        on_line if coefficients is None else on_line + deviation_from_line(coefficients, fraction)
    )


def _is_zero(fraction: ArrayLike) -> bool:
    return isinstance(fraction, float) and fraction == 0.0


class Within(NamedTuple):
    """The arguments of the right-hand side within a step, besides the state.

    Attributes:
        values: the values that are constant over the step; time, states and inputs are replaced.
        step: the step.
        sided: whether something may jump at its ends, so that time stays a little within.
    """

    values: Values
    step: Steps
    sided: bool = False

    def at(self, fraction: ArrayLike, x: State, part: Part = (0.0, 1.0)) -> Values:
        """The values of the model at a fraction of the step, in a part of it: between two fractions.

        Stages beyond the part's end, as Kvaerno5 has one, keep their time: its order depends on it.
        """
        step = self.step
        t, low, high = (step.time(f) for f in (fraction, *part))
        if self.sided:
            eps = SIDE * jnp.finfo(jnp.result_type(low)).eps
            apart = eps * jnp.maximum(jnp.abs(low), jnp.abs(high))
            beyond = jnp.asarray(fraction) > jnp.asarray(part[1])
            t = jnp.where(beyond, t, jnp.clip(t, low + apart, high - apart))
        around = (part[0] + part[1]) / 2
        return self.values._replace(t=t, x=x, u=step.inputs_at(fraction, t, around))


class Runs(eqx.Module):
    """Several runs, one after the other among n steps.

    Attributes:
        restarts: where they begin, and with which state.
        own: of the parameters that differ from run to run, their values at every step.
        places: where these lie in `Packed.values`.
        count: how many there are.
    """

    restarts: Restarts
    own: Float[Array, "n n_own"] | None = None
    places: tuple[int, ...] = eqx.field(static=True, default=())
    count: int = eqx.field(static=True, default=0)


class Integrated(NamedTuple):
    """The result of `integrate`.

    Attributes:
        x: the states at the steps' starts, shape (n, n_states).
        y: the outputs there, shape (n, n_outputs); ``None`` without any.
        end: the state after the last step, shape (n_states,).
        log: what has happened, by a clock that begins with the first step; ``None`` for a model without events.
        d: the discrete variables at the steps' starts, shape (n, n_discrete); ``None`` for such a model.
        d_end: the same after the last step, shape (n_discrete,).
    """

    x: Float[Array, "n n_states"]
    y: Float[Array, "n n_outputs"] | None
    end: State
    log: Log | None = None
    d: Float[Array, "n n_discrete"] | None = None
    d_end: Float[Array, " n_discrete"] | None = None


def integrate(
    system: System,
    start: Values,
    steps: Steps,
    solver: Scheme,
    *,
    outputs: Sequence[str] = (),
    substeps: int = 1,
    direct: bool = False,
    runs: Runs | None = None,
    divided: bool = True,
) -> Integrated:
    """Integrate the model over some steps. Pure: trace, differentiate and map it.

    Arguments:
        system: the model.
        start: the values of the model at the start of the first step. Time and inputs are read from ``steps``.
        steps: the n steps and their inputs.
        solver: a one-step diffrax solver, from `solvers.for_fixed_steps`.
        outputs: variables to observe at the start of every step, where their terms are shared with the
            first stage of an explicit scheme.
        substeps: equal parts that each step is divided into.
        direct: whether derivatives in forward mode must work, too; those in reverse mode then take more memory.
        runs: where further runs begin among the steps.
        divided: whether edges of sources or samples of inputs may lie within steps: the first `EDGES` divide a step.

    Returns:
        States and outputs at the steps' starts, and the state at the end. A step whose equations are not solved
        gives NaN.
    """
    outputs = tuple(outputs)
    explicit = isinstance(solver, EXPLICIT)
    tableau, dtype = tableau_of(solver).without_estimate(), start.x.dtype
    if explicit:
        scheme = (_explicit_loop if system.program.searches else _explicit)(tableau)
    else:
        scheme = _implicit(tableau, system.state_jacobian, dtype)
    divided_step = _DividedStep(system, scheme, substeps, divided)
    samples = steps.inputs
    equal, h = (steps.h, None) if steps.h.ndim == 0 else (None, steps.h)
    constant = start._replace(t=None, x=None, u=None)
    constants, fixed = eqx.partition((constant, samples.functions, equal), eqx.is_array)
    sided = bool(system.edges) or any(isinstance(f, Signal) and f.jumps for f in samples.functions)

    def observe(x: State, within: Within) -> tuple[State | None, Array | None]:
        if not outputs:
            return None, None
        values = within.at(0.0, x)
        if explicit:
            return system.rates_and_read(outputs, values)
        return None, system.read(outputs, values)

    def step(constants: PyTree, x: State, row: PyTree) -> tuple[State, Array | None]:
        values, functions, equal = eqx.combine(constants, fixed)
        t, h, start, end, coefficients, parts, own = row
        length = equal if h is None else h
        if own is not None:
            values = values._replace(packed=values.packed.replaced(places, own))
        inputs = Samples(start, end, functions, coefficients)
        within = Within(values, Steps(t, length, inputs, parts), sided)
        first_stage, y = observe(x, within)
        return divided_step(x, within, first_stage), y

    restarts, own, places = (
        (None, None, ()) if runs is None else (runs.restarts, runs.own, runs.places)
    )
    rows = (steps.t, h, samples.start, samples.end, samples.coefficients, steps.parts, own)
    xs, end, ys = stored_scan(step, constants, start.x, rows, direct=direct, restarts=restarts)
    return Integrated(xs, ys, end)


class _DividedStep(NamedTuple):
    """A step of one scheme, divided at edges of sources and samples of inputs, and between them into equal parts."""

    system: System
    scheme: Stepper
    substeps: int
    at_edges: bool

    def __call__(self, x: State, within: Within, first: State | None) -> State:
        """The state at the end; ``first`` is the derivative at the start, if it is known."""
        cuts, moved = _cuts(self.system, within, self.at_edges)
        if cuts is None:
            return self._in_substeps((0.0, 1.0), x, within, first)

        def next_part(x: State, ends: tuple[Array, Array]) -> tuple[State, None]:
            go = lambda: self._in_substeps(ends, x, within, None)  # noqa: E731
            return jax.lax.cond(ends[1] > ends[0], go, lambda: x), None

        x = self._in_substeps((jnp.zeros_like(cuts[0]), cuts[0]), x, within, first)
        later = cuts, jnp.append(cuts[1:], jnp.ones((), cuts.dtype))
        x = jax.lax.scan(next_part, x, later)[0]
        return x if moved is None else _with_edge_at_end(self.system, within, x, *moved)

    def _in_substeps(self, part: Part, x: State, within: Within, first: State | None) -> State:
        """From one fraction of the step to another, in equal parts."""
        (low, high), n = part, self.substeps
        if n == 1:
            return self._once(part, x, within, first)

        def piece(j: ArrayLike) -> Part:
            return low + (high - low) * j / n, low + (high - low) * (j + 1) / n

        x = self._once(piece(jnp.zeros((), x.dtype)), x, within, first)
        later = jnp.arange(1.0, n, dtype=x.dtype)
        return jax.lax.scan(lambda x, j: (self._once(piece(j), x, within, None), None), x, later)[0]

    def _once(self, part: Part, x: State, within: Within, first: State | None) -> State:
        """The same in a single step of the scheme."""

        def field(fraction: ArrayLike, args: tuple[Part, Within]) -> Rates:
            (low, high), within = args
            at: Any = fraction if _is_whole(low, high) else low + fraction * (high - low)
            values = within.at(at, x, (low, high))
            return self.system.field(values.t, values.u, values.packed, values.d)

        low, high = part
        length = within.step.h if _is_whole(low, high) else (high - low) * within.step.h
        return self.scheme(field, x, length, (part, within), first)


def _is_whole(low: ArrayLike, high: ArrayLike) -> bool:
    return _is_zero(low) and isinstance(high, float) and high == 1.0


def _cuts(
    system: System, within: Within, divided: bool
) -> tuple[Float[Array, " p"] | None, tuple[Array, Array] | None]:
    """The fractions of a step, above 0 and increasing, at which edges of sources, or inputs, divide it.

    And whether an edge is at its end, and by what that moves: zero, with derivatives.
    """
    step = within.step
    cuts = [] if step.parts is None else [*step.parts.cuts]
    signals = [f for f in step.inputs.functions if isinstance(f, Signal)]
    signals = [f for f in signals if f.jumps or f.interpolation == "linear"]
    moved = None
    if divided and (system.edges or signals):
        end = step.t + step.h
        eps = SIDE * jnp.finfo(jnp.result_type(step.t)).eps
        apart = eps * jnp.maximum(jnp.abs(step.t), jnp.abs(end))
        t, moved = step.t, (jnp.array(False), jnp.zeros_like(step.t))
        for _ in range(EDGES):
            times = [_next_sample(f, t + apart) for f in signals]
            if system.edges:
                ahead = system.edges.ahead(within.values.packed, t, apart)
                times += [ahead.jump, ahead.bend]
            t = jnp.min(jnp.stack([jnp.asarray(v, step.t.dtype) for v in times]))
            is_within, is_last = t < end - apart, jnp.abs(t - end) <= apart
            shift = jnp.where(is_last, t - jax.lax.stop_gradient(t), 0.0)
            moved = moved[0] | is_last, moved[1] + shift
            t = jnp.where(is_within, t, end)
            cuts.append(jnp.where(is_within, (t - step.t) / step.h, 1.0))
    return jnp.sort(jnp.stack(cuts)) if cuts else None, moved


def _with_edge_at_end(
    system: System, within: Within, x: State, there: Array, shift: Array
) -> State:
    """The same state, with derivatives by the time of an edge at the end of a step."""

    def moved() -> State:
        before = within.at(1.0, x, (0.5, 1.0))
        end = within.step.time(1.0)
        eps = 2 * SIDE * jnp.finfo(jnp.result_type(end)).eps
        after = before._replace(t=end + eps * jnp.maximum(jnp.abs(within.step.t), jnp.abs(end)))
        change = system.rates(before) - system.rates(after)
        return x + jax.lax.stop_gradient(change) * shift

    return jax.lax.cond(there, moved, lambda: x)


def _next_sample(signal: Signal, t: Array) -> Array:
    """The first sample behind a time; infinite if there is none."""
    ts = jnp.append(signal.ts, jnp.inf)
    return ts[jnp.searchsorted(ts, t, side="right")]


def inner_fractions(solver: Any, substeps: int) -> tuple[float, ...] | None:
    """The fractions of a step, besides its ends, at which a scheme looks at inputs; ``None`` if it does not say."""
    if not isinstance(solver, EXPLICIT):
        return None
    places = [0.0, *tableau_of(solver).fractions]
    fractions = {(j + place) / substeps for j in range(substeps) for place in places}
    return tuple(sorted(fraction for fraction in fractions if 0 < fraction < 1))


def _explicit(tableau: Tableau) -> Stepper:
    """An explicit Runge–Kutta step, unrolled."""

    def step(field: Field, x: State, h: Array, args: PyTree, first: State | None) -> State:
        rates = [] if first is None else [first]
        for row, fraction in zip(tableau.rows, tableau.fractions, strict=True):
            if len(row) >= len(rates):
                rates.append(field(fraction, args)(moved(x, h, row, rates)))
        return moved(x, h, tableau.weights, rates)

    return step


def _explicit_loop(tableau: Tableau) -> Stepper:
    """The same with the stages in a loop."""

    def step(field: Field, x: State, h: Array, args: PyTree, first: State | None) -> State:
        n, begin = len(tableau.rows), 0 if first is None else 1
        weights, fractions = (
            jnp.asarray(part[begin:], x.dtype)
            for part in (tableau.square(tableau.rows), tableau.fractions)
        )
        found = jnp.zeros((n, *x.shape), x.dtype)
        found = found if first is None else found.at[0].set(first)

        def one(found: Array, row: tuple[Array, Array, Array]) -> tuple[Array, None]:
            i, weights, fraction = row
            return found.at[i].set(field(fraction, args)(x + h * (weights @ found))), None

        found, _ = jax.lax.scan(one, found, (jnp.arange(begin, n), weights, fractions))
        return moved(x, h, tableau.weights, list(found))

    return step


def _implicit(tableau: Tableau, jacobian: StateJacobian, dtype: Any) -> Stepper:
    """A step whose stages are solved for; it and its derivatives are NaN where these have no solution."""
    scheme = ImplicitScheme(tableau, jacobian, fixed_tolerances(dtype), FIXED)

    def step(field: Field, x: State, h: Array, args: PyTree, first: State | None) -> State:
        increments = stages(scheme, Fields(field, args), h, x, None).increments
        return moved(x, jnp.ones_like(h), tableau.weights, list(increments))

    return step
