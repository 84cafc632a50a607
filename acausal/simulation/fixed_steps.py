"""Fixed steps: one step of a scheme, and its repetition.

Explicit Runge–Kutta schemes are unrolled from the diffrax solver's own tableau, so that XLA sees plain
arithmetic with constant coefficients. For any other solver, its `step` method is called.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, cast

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float, PyTree

from acausal._jax import Restarts, stored_scan
from acausal.codegen import Values
from acausal.data import Signal, deviation_from_line
from acausal.simulation.inputs import TimeFunction
from acausal.simulation.log import Log
from acausal.simulation.sampled_inputs import Samples
from acausal.simulation.solvers import EXPLICIT, Scheme

if TYPE_CHECKING:
    from acausal.system import System

SIDE = 16.0
"""So many rounding errors is each stage within its step, where a source may jump at the ends."""

EDGES = 3
"""A step is divided at so many edges of sources, the first that lie within it."""

State: TypeAlias = Float[Array, " n_states"]

Field = Callable[[ArrayLike, State, PyTree], State]
"""The right-hand side within a step: (fraction of the step, state, arguments) -> derivative."""

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
        own = (fraction - cuts[i]) / jnp.where(length > 0, length, 1.0)
        coefficients = None if u.coefficients is None else u.coefficients[i]
        return on_curve(u.start[i], u.end[i], coefficients, own)


class Steps(eqx.Module):
    """A sequence of n steps.

    Attributes:
        t: their starts, shape (n,), in seconds.
        h: their lengths in seconds, shape (n,), or () where all are equal.
        inputs: the inputs over each of them. parts: over parts of them, where inputs jump or bend within.
    """

    t: Float[Array, " n"]
    h: Float[Array, "*n"]
    inputs: Samples
    parts: Parts | None = None


class Step(eqx.Module):
    """One of `Steps`: its start and length, the inputs at both ends, and how they deviate from a line in between."""

    t: Float[Array, ""]
    h: Float[Array, ""]
    start: Float[Array, " n_inputs"]
    end: Float[Array, " n_inputs"]
    coefficients: Float[Array, "n_coefficients n_inputs"] | None
    parts: Parts | None = None

    def time(self, fraction: ArrayLike) -> Float[Array, ""]:
        """The time at a fraction of the step."""
        return self.t if _is_zero(fraction) else self.t + fraction * self.h

    def inputs(
        self,
        fraction: ArrayLike,
        functions: tuple[TimeFunction | None, ...],
        t: Array | None = None,
        around: ArrayLike | None = None,
    ) -> Float[Array, " n_inputs"]:
        """The inputs at a fraction of the step; functions of time as they are at ``t``, if that is given.

        Where they jump within the step, they are those of the part around a fraction.
        """
        if _is_zero(fraction):
            u = self.start
        elif self.parts is not None:
            u = self.parts.at(fraction, fraction if around is None else around)
        else:
            u = on_curve(self.start, self.end, self.coefficients, fraction)
        if all(f is None for f in functions):
            return u
        t = self.time(fraction) if t is None else t
        return jnp.stack([v if f is None else f(t) for v, f in zip(u, functions, strict=True)])


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
        functions: the inputs that are functions of time.
        step: the step.
        sided: whether something may jump at its ends, so that time stays a little within.
    """

    values: Values
    functions: tuple[TimeFunction | None, ...]
    step: Step
    sided: bool = False

    def at(
        self, fraction: ArrayLike, x: State, part: tuple[ArrayLike, ArrayLike] = (0.0, 1.0)
    ) -> Values:
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
        return self.values._replace(t=t, x=x, u=step.inputs(fraction, self.functions, t, around))


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
    """

    x: Float[Array, "n n_states"]
    y: Float[Array, "n n_outputs"] | None
    end: State
    log: Log | None = None


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
    advance = _explicit(_tableau(solver)) if explicit else _implicit(solver)
    equal = steps.h if steps.h.ndim == 0 else None
    constant = start._replace(t=None, x=None, u=None)
    constants, fixed = eqx.partition((constant, steps.inputs.functions, equal), eqx.is_array)

    sided = bool(system.edges) or any(
        isinstance(f, Signal) and f.jumps for f in steps.inputs.functions
    )

    def over(part: tuple[Any, Any], x: State, within: Within, first: State | None) -> State:
        """From one fraction of a step to another."""

        def field(fraction: ArrayLike, x: State, args: tuple[Any, Within]) -> State:
            (low, high), within = args
            at: Any = fraction if _is_whole(low, high) else low + fraction * (high - low)
            return system.rates(within.at(at, x, (low, high)))

        low, high = part
        length = within.step.h if _is_whole(low, high) else (high - low) * within.step.h
        return advance(field, x, length, (part, within), first)

    def in_parts(low: Any, high: Any, x: State, within: Within, first: State | None) -> State:
        """The same in `substeps` equal steps."""
        if substeps == 1:
            return over((low, high), x, within, first)

        def ends(j: ArrayLike) -> tuple[Any, Any]:
            return low + (high - low) * j / substeps, low + (high - low) * (j + 1) / substeps

        x = over(ends(jnp.zeros((), x.dtype)), x, within, first)
        rest = jnp.arange(1.0, substeps, dtype=x.dtype)
        return jax.lax.scan(lambda x, j: (over(ends(j), x, within, None), None), x, rest)[0]

    def whole(x: State, within: Within, first: State | None) -> State:
        cuts, moved = _cuts(system, within, divided)
        if cuts is None:
            return in_parts(0.0, 1.0, x, within, first)

        def next_part(x: State, ends: tuple[Array, Array]) -> tuple[State, None]:
            go = lambda: in_parts(*ends, x, within, None)  # noqa: E731
            return jax.lax.cond(ends[1] > ends[0], go, lambda: x), None

        x = in_parts(jnp.zeros_like(cuts[0]), cuts[0], x, within, first)
        later = cuts, jnp.append(cuts[1:], jnp.ones((), cuts.dtype))
        x = jax.lax.scan(next_part, x, later)[0]
        return x if moved is None else _with_edge_at_end(system, within, x, *moved)

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
        within = Within(values, functions, Step(t, length, start, end, coefficients, parts), sided)
        first_stage, y = observe(x, within)
        return whole(x, within, first_stage), y

    samples = steps.inputs
    h = None if equal is not None else steps.h
    restarts, own, places = (
        (None, None, ()) if runs is None else (runs.restarts, runs.own, runs.places)
    )
    rows = (steps.t, h, samples.start, samples.end, samples.coefficients, steps.parts, own)
    xs, end, ys = stored_scan(step, constants, start.x, rows, direct=direct, restarts=restarts)
    return Integrated(xs, ys, end)


def _is_whole(low: ArrayLike, high: ArrayLike) -> bool:
    return _is_zero(low) and isinstance(high, float) and high == 1.0


def _cuts(
    system: System, within: Within, divided: bool
) -> tuple[Float[Array, " p"] | None, tuple[Array, Array] | None]:
    """The fractions of a step, above 0 and increasing, at which edges of sources, or inputs, divide it.

    And whether an edge is at its end, and by what that moves: zero, with derivatives.
    """
    step = within.step
    found = [] if step.parts is None else [*step.parts.cuts]
    signals = [f for f in within.functions if isinstance(f, Signal)]
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
            found.append(jnp.where(is_within, (t - step.t) / step.h, 1.0))
    return jnp.sort(jnp.stack(found)) if found else None, moved


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


def inner_fractions(solver: object, substeps: int) -> tuple[float, ...] | None:
    """The fractions of a step, besides its ends, at which a scheme looks at inputs; ``None`` if it does not say."""
    if not isinstance(solver, EXPLICIT):
        return None
    stages = [0.0, *_tableau(solver).fractions]
    found = {(j + fraction) / substeps for j in range(substeps) for fraction in stages}
    return tuple(sorted(fraction for fraction in found if 0 < fraction < 1))


def stability_limit(solver: Scheme) -> float:
    """The rate of a damped mode, in units of 1/step, from which on an explicit scheme lets it grow."""
    rows, _, weights, _ = _tableau(solver)
    rates = np.linspace(0.0, 10.0, 1001)[1:]
    stages: list[np.ndarray] = []  # slopes over the state, in dx/dt = -x
    for row in rows:
        inner = sum((a * k for a, k in zip(row, stages, strict=True)), np.zeros(len(rates)))
        stages.append(-(1 + rates * inner))
    after = 1 + rates * sum(b * k for b, k in zip(weights, stages, strict=True))
    grows = np.abs(after) > 1
    return float(rates[np.argmax(grows)]) if grows.any() else np.inf


class Tableau(NamedTuple):
    """The coefficients of a Runge–Kutta scheme whose stages are computed one after the other.

    Attributes:
        rows: by stage, the weights of the stages before it.
        fractions: by stage, its place in the step.
        weights: of all stages in the result.
        diagonal: by stage, its own weight; 0 in an explicit scheme.
    """

    rows: Sequence[Sequence[float]]
    fractions: Sequence[float]
    weights: Sequence[float]
    diagonal: Sequence[float]


def _tableau(solver: Scheme) -> Tableau:
    if isinstance(solver, dfx.Euler):
        return Tableau([[]], [0.0], [1.0], [0.0])
    if isinstance(solver, dfx.ImplicitEuler):
        return Tableau([[]], [1.0], [1.0], [1.0])
    tableau = cast(dfx.ButcherTableau, cast(dfx.AbstractERK, solver).tableau)
    rows = [[], *([float(a) for a in row] for row in tableau.a_lower)]
    fractions = [float(tableau.c1), *(float(c) for c in tableau.c)]
    diagonal = np.zeros(len(rows)) if tableau.a_diagonal is None else tableau.a_diagonal
    return Tableau(rows, fractions, [float(b) for b in tableau.b_sol], diagonal.tolist())


def _explicit(tableau: Tableau) -> Stepper:
    """An explicit Runge–Kutta step, unrolled, without the stages that serve only an error estimate."""
    rows, fractions, weights, _ = tableau
    needed = max(i for i, b in enumerate(weights) if b) + 1

    def step(field: Field, x: State, h: Array, args: PyTree, first: State | None) -> State:
        stages = [] if first is None else [first]
        for i in range(len(stages), needed):
            stages.append(field(fractions[i], _sum(x, h, rows[i], stages), args))
        return _sum(x, h, weights, stages)

    return step


def _sum(x: State, h: Array, weights: Sequence[float], stages: Sequence[State]) -> State:
    for weight, stage in zip(weights, stages, strict=False):
        x = x + (weight * h) * stage if weight else x
    return x


def _implicit(solver: Scheme) -> Stepper:
    """A solver's own `step`, in local time from 0 to h.

    Its derivatives are those of one more Newton step of every stage. diffrax would solve for them itself, and end the
    program where the equations of a stage have no solution; here the step and its derivatives are NaN.
    """

    def solved(
        field: Field, x: State, h: Array, args: PyTree
    ) -> tuple[State, Float[Array, "n_stages n_states"]]:
        term = dfx.ODETerm(lambda t, x, args: field(t / h, x, args))
        start, h, args = _strong((jnp.zeros_like(h), h, args))
        memory = solver.init(term, start, h, x, args)
        end, _, dense, _, result = solver.step(term, start, h, x, args, memory, False)
        end = jnp.where(result == dfx.RESULTS.successful, end, jnp.nan)
        return end, dense["k"] if "k" in dense else (end - x)[None]

    def end_of(
        field: Field, x: State, h: Array, args: PyTree, known: Float[Array, "n_stages n_states"]
    ) -> State:
        """The state at the end by one Newton step from known stages; their Jacobian is not differentiated."""
        tableau, increments = _tableau(solver), list[Array]()
        for k, row, own, c in zip(
            known, tableau.rows, tableau.diagonal, tableau.fractions, strict=True
        ):
            before = _sum(x, jnp.ones(()), row, increments)
            if not own:
                increments.append(h * field(c, before, args))
                continue
            inner = before + own * k
            jacobian = jax.jacfwd(lambda x, c=c: h * field(c, x, args))(inner)
            matrix = jax.lax.stop_gradient(jnp.eye(x.size, dtype=x.dtype) - own * jacobian)
            increments.append(k + jnp.linalg.solve(matrix, h * field(c, inner, args) - k))
        return _sum(x, jnp.ones(()), tableau.weights, increments)

    @eqx.filter_custom_jvp
    def step(field: Field, x: State, h: Array, args: PyTree) -> State:
        return solved(field, x, h, args)[0]

    @step.def_jvp
    def _(primals: Any, tangents: Any) -> tuple[State, State]:
        end, known = solved(*primals)
        known = jax.lax.stop_gradient(known)

        def moved(field: Field, x: State, h: Array, args: PyTree) -> State:
            return end_of(field, x, h, args, known)

        _, tangent = eqx.filter_jvp(moved, primals, tangents)
        return end, tangent

    return lambda field, x, h, args, first: step(field, x, h, args)


def _strong(tree: PyTree) -> PyTree:
    """Arrays without JAX's weak types, which look like a change of type within diffrax's loops."""
    return jax.tree.map(
        lambda a: jax.lax.convert_element_type(a, a.dtype) if eqx.is_array(a) else a, tree
    )
