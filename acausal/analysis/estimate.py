"""`estimate`: states and drifting parameters of a model from measured data, by filters or a moving horizon."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, cast

import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Bool, Float, PRNGKeyArray
from scipy.optimize import minimize

from acausal._jax import (
    as_key,
    compiled,
    is_number,
    need_double_precision,
    traced,
    value_and_jacobian,
)
from acausal.analysis.estimation import Estimation
from acausal.analysis.filtering import (
    Belief,
    EnsembleFilter,
    Filter,
    Filtered,
    Linearized,
    Measured,
    by_points,
    run,
)
from acausal.analysis.moving_horizon import EKF, SOFT, Bounds, MovingHorizon
from acausal.analysis.tracking import (
    AlongRecord,
    check_model,
    make_model,
    numbers_by_name,
    rows_of,
    to_estimate,
)
from acausal.codegen import Packed, Values
from acausal.data import Data, Record, noise_level
from acausal.errors import (
    DataError,
    known_name,
    need_compiled,
    need_whole,
    shown,
    warn,
)
from acausal.modeling import names_in
from acausal.simulation import (
    Steps,
    announce_inputs,
    evaluate_all,
    functions_of_time,
    polynomials_over_steps,
)

if TYPE_CHECKING:
    from acausal.system import System

METHODS = ("ekf", "ukf", "enkf", "mhe")

LEVELS = np.logspace(-4, 2, 9)
"""Process noise that is tried where none is given: random walks over the record, in sizes of the states."""

FAINT = 1e-3
"""The noise of a sensor whose samples show none, relative to the standard deviation of its signal."""

RUN_AWAY, GROWS = 1e3, 10.0
"""Where the model without corrections shows so many times more than what is measured, it is unstable; and states run
away that pass so many times as much in the second half of the record."""

FAR = 7.0
"""Noise is fitted within so many powers of e around where that begins."""


def estimate(
    system: System,
    record: Record,
    method: Literal["ekf", "ukf", "enkf", "mhe"] = "ekf",
    *,
    sensors: str | Sequence[str] | Mapping[str, float] | None = None,
    states: Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    noise: Mapping[str, float] | Literal["fit"] | None = None,
    x0: Mapping[str, ArrayLike] | Literal["steady"] | None = None,
    params: Mapping[str, Any] | None = None,
    dt: float | None = None,
    solver: Any = "auto",
    smooth: bool = False,
    window: int = 20,
    bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
    members: int = 200,
    seed: int = 0,
) -> Estimation:
    """Estimate the states of a model, and parameters that drift, from what was measured.

    Samples may be missing, and sensors may have different rates. The model is stepped by its own fixed steps, so that
    algebraic loops hold at every estimate. With ``noise`` and ``sensors`` as numbers all of it can be traced and
    differentiated: the log likelihood by parameters, for example; of a model with events in forward mode only.

    At an event, a covariance goes on with the derivatives through the instant, and what a controller has sampled is
    estimated as a state is. Whole numbers and truth values are certain: those of the mean, or of each member of an
    ensemble. A correction across a condition is an event.

    Arguments:
        system: a compiled model; without events for a moving horizon.
        record: with the model's inputs, and measurements of any of its variables.
        method: ``"ekf"``, the extended Kalman filter, whose derivatives are exact; ``"ukf"``, the unscented one;
            ``"enkf"``, an ensemble; or ``"mhe"``, a moving horizon: the most likely way through the last rows, found by
            Gauss-Newton steps at every row.
        sensors: what of the record is measured, by default all that the model computes; or the standard deviations of
            their noise, by name. Others are estimated from the record.
        states: standard deviations of the states at the start, by name; by default the noise of the sensor where a
            state is measured, and else the state's size.
        parameters: those to estimate with the states, by name, and their standard deviations at the start. They are
            constant, or random walks with ``noise``.
        noise: of the process: by state or such a parameter, the standard deviation of its random walk after one second;
            0 for others. By default one level for all states, relative to their sizes, is found by likelihood.
            ``"fit"`` finds that of each state, and of each sensor that ``sensors`` does not give.
        x0: the expected state at the start, by name, or ``"steady"``; by default as measured, else as the model starts.
        params: what differs from the model's parameters.
        dt: the longest step of the integration; by default as short as the model's modes ask for; steps of a model with
            events follow their errors.
        solver: of the steps; ``"auto"`` is classical Runge-Kutta, or implicit for stiff models.
        smooth: whether estimates use later measurements, too, as `Estimation.smooth`.
        window: samples of the moving horizon.
        bounds: of the moving horizon, by state or estimated parameter: the lowest and the highest value, ``None`` for
            none. They may be exceeded by about a thousandth of the standard deviation at the start.
        members: of the ensemble. seed: of its random numbers.

    Returns:
        The estimates: any variable of the model by its name, with standard deviations, innovations and likelihood.
        Times are those of the record, and further ones where samples are farther apart than usual.

    Raises:
        DataError: if the record lacks inputs or measurements, or an argument does not fit.
        ModelError: for a model that is not compiled, has no states, or has events that the method does not follow.
    """
    how = filter_for(system, method, "estimate")
    window = need_whole(window, "window", DataError, 2)
    members = need_whole(members, "members", DataError, 2)
    data = Data.of(record).for_system(system)
    if len(data) < 2:
        raise DataError("The record has fewer than two samples.")
    known = _sensors(system, data, sensors)
    r = jnp.stack([jnp.asarray(v, float) for v in known.values()])
    drift = to_estimate(system, parameters)
    names = (*system.states, *drift)
    path, measured, first = _lay_out(system, data, known, tuple(drift), x0, params, dt, solver)
    size = _sizes(path, first, measured)
    spread = _spread(system, data, states, known, size)
    start = belief_at(first, spread, path.model.params, drift)
    key = as_key(seed)
    walk = jnp.zeros(len(start.mean)).at[: len(size)].set(size / jnp.sqrt(path.t[-1] - path.t[0]))

    if isinstance(how, MovingHorizon):
        deviation = jnp.sqrt(jnp.diag(start.covariance))
        how = how._replace(window=window, bounds=_bounds(bounds, names, deviation))
    elif bounds is not None:
        raise DataError(f"bounds: method='{method}' keeps none; take method='mhe'.")

    def filtered(q: Array, r: Array, how: Filter | MovingHorizon = EKF) -> Filtered:
        begin = _with_members(start, members, key) if isinstance(how, EnsembleFilter) else start
        return _filtered(how, path, begin, measured._replace(sigma=r), q, key)

    if isinstance(noise, Mapping):
        of = "a state, nor a parameter to estimate"
        chosen = numbers_by_name(noise, names, "noise", of)
        walks = jnp.stack([jnp.asarray(chosen.get(n, 0.0), float) for n in names])
        q = jnp.zeros_like(walk).at[: len(names)].set(walks)
    elif noise is None or noise == "fit":
        q = _best_level(lambda level: filtered(level * walk, r)) * walk
        if noise == "fit":
            given = sensors if isinstance(sensors, Mapping) else {}
            free = np.array([n not in given for n in known])
            # steps that end at events, as they are made here, have derivatives in forward mode alone
            forward = system.events is not None
            q, r = _fitted(lambda q, r: _likelihood(filtered(q, r)), q, r, free, forward=forward)
    else:
        raise DataError(f"noise={shown(noise)}: give 'fit', or numbers by name of a state.")
    found = filtered(q, r, how)
    if (
        not traced(found.mean)
        and (lost := np.flatnonzero(~np.isfinite(found.mean).all(axis=1))).size
    ):
        warn(
            f"The estimates are not finite from t = {float(path.t[lost[0]]):g} s on: the model diverges in its steps "
            "there. Give a smaller dt=, solver='kvaerno3' for a stiff model, a nearer x0=, or more noise=."
        )
    levels = dict(zip(names, q[: len(names)], strict=True))
    result = Estimation.of(path, found, measured, levels, dict(zip(known, r, strict=True)))
    return result.smooth() if smooth else result


def filter_for(system: System, method: str, what: str) -> Filter | MovingHorizon:
    """The filter of a name, for a model that it can follow.

    Raises:
        DataError: for an unknown name.
        ModelError: for a model that is not compiled, has no states, or has events that the filter does not follow.
    """
    need_compiled(system, what)
    need_double_precision()
    if not isinstance(method, str):
        raise DataError(f"method={shown(method)}; give the name of a method, such as 'ekf'.")
    known_name(method, METHODS, "No method")
    if method == "mhe":
        check_model(system, f"{what}, method='mhe',", events=False)
    check_model(system, what, events=what == "estimate")
    return {
        "ekf": EKF, "ukf": Linearized(by_points), "enkf": EnsembleFilter(), "mhe": MovingHorizon(),
    }[method]  # fmt: skip


def _sensors(system: System, data: Data, given: Any) -> dict[str, Any]:
    """The standard deviation of the noise of every sensor, by name.

    Raises:
        DataError: for what the model does not compute, or is not in the record, or if nothing is measured.
    """
    computed = [n for n in system.variables if n not in system.inputs]
    measured = tuple(
        n for n in computed if n in data.signals and np.isfinite(data.signals[n]).any()
    )
    if isinstance(given, Mapping):
        levels = numbers_by_name(
            given, tuple(computed), "sensors", "a variable that the model computes"
        )
        for name, value in levels.items():
            if not traced(value) and not value > 0:
                raise DataError(
                    f"sensors: the noise of '{name}' is {value:g}; give one above zero."
                )
    else:
        levels = dict.fromkeys(measured if given is None else names_in(given, "sensors"))
    for name in levels:
        known_name(name, measured, "sensors:", then=" is not measured in the record:")
    if not levels:
        raise DataError(
            f"The record measures nothing that the model computes: it has {', '.join(data.signals)}. Name its "
            "columns after variables of the model, such as "
            f"ac.Data(time, {{'{system.states[0]}': ...}})."
        )
    return {n: _noise(data.signals[n]) if v is None else v for n, v in levels.items()}


def _bounds(
    given: Mapping[str, tuple[float | None, float | None]] | None,
    names: tuple[str, ...],
    deviation: Float[Array, " m"],
) -> Bounds | None:
    """The bounds of what is estimated.

    Raises:
        DataError: for an unknown name, or what is no interval.
    """
    if not given:
        return None
    low, high = np.full(len(names), -np.inf), np.full(len(names), np.inf)
    for name, interval in given.items():
        known_name(name, names, "bounds:", then=" is not estimated:")
        pair = interval if isinstance(interval, Sequence) else ()
        ends = [e for e in pair if e is not None]
        if len(pair) != 2 or not all(map(is_number, ends)) or ends != sorted(ends):
            raise DataError(
                f"bounds: '{name}' has {shown(interval)}; give two numbers that rise, None for none."
            )
        i, (least, most) = names.index(name), pair
        low[i], high[i] = -np.inf if least is None else least, np.inf if most is None else most
    return Bounds(
        jnp.asarray(low), jnp.asarray(high), SOFT * jnp.where(deviation > 0, deviation, 1)
    )


def _noise(signal: Float[np.ndarray, " n"]) -> float:
    """The noise of a signal; a little of its size where it shows none."""
    deviation = float(np.nanstd(signal)) or float(np.nanmax(np.abs(signal))) or 1.0
    return max(noise_level([signal]), FAINT * deviation)


def _lay_out(
    system: System,
    data: Data,
    known: Mapping[str, Any],
    drifting: tuple[str, ...],
    x0: Mapping[str, ArrayLike] | Literal["steady"] | None,
    params: Mapping[str, Any] | None,
    dt: float | None,
    solver: Any,
) -> tuple[AlongRecord, Measured, Values]:
    """The model along the rows, what is measured there, and the values at the start."""
    ts = rows_of(data.time)
    span = float(ts[0]), float(ts[-1])
    functions = functions_of_time(system, data, span)
    announce_inputs(system, data)
    steps = Steps(
        jnp.asarray(ts[:-1]), jnp.asarray(np.diff(ts)), polynomials_over_steps(functions, ts)
    )
    u = evaluate_all(functions, jnp.asarray(ts))
    seen = np.full((len(ts), len(known)), np.nan)
    seen[np.searchsorted(ts, data.time)] = data.columns(known, "a sensor")
    given = x0 if isinstance(x0, str) else dict(x0 or {})
    first = {} if isinstance(x0, str) else dict(zip(known, seen[0], strict=True))
    begun = {
        n: v for n, v in first.items() if n in system.states and np.isfinite(v) and n not in given
    }
    places = [system.states.index(n) for n in begun]
    close = not system.reduced.exact.all()  # states that are measured may be off their constraints

    def at(packed: Packed) -> Values:
        chosen: Any = given if isinstance(given, str) or close else {**begun, **given}
        x = system.initial_state(packed, chosen or None, inputs=u[0], t0=span[0])
        modes = system.initializer.discrete_starts(packed, chosen)
        start = system.values(span[0], x, u[0], packed)._replace(d=modes)
        if close and begun:
            x = x.at[np.asarray(places)].set(np.array([*begun.values()]))
            start = start._replace(x=system.closed(start._replace(x=x)))
        return system.modes(start)

    model = make_model(
        system, tuple(known), drifting, params, at, float(np.max(np.diff(ts))), dt, solver
    )
    path = AlongRecord(model, steps, jnp.asarray(ts), u)
    exist = np.isfinite(seen)
    measured = Measured(jnp.asarray(np.where(exist, seen, 0.0)), jnp.asarray(exist), jnp.zeros(0))
    return path, measured, at(model.packed)


@compiled
def _sizes(path: AlongRecord, start: Values, measured: Measured) -> Float[Array, " n_states"]:
    """Half of the range that each state passes without corrections; its nominal value where that tells nothing.

    Of states that run away it is the part that the sensors show of their range.
    """
    (x, shown), nominal = _open_loop(path, start), jnp.asarray(path.model.system.nominal)
    middle = len(x) // 2
    early, late, whole = (jnp.ptp(part, axis=0) for part in (x[: middle + 1], x[middle:], x))
    seen = jnp.max(jnp.abs(measured.y), axis=0)
    far = jnp.max(jnp.where(seen > 0, jnp.max(jnp.abs(shown), axis=0) / seen, 0.0))
    half = whole / 2 / jnp.where((far > RUN_AWAY) & (late > GROWS * early), far, 1.0)
    good = jnp.isfinite(half) & (half > 0)
    guesses = slice(path.model.system.reduced.n_independent, None)  # of loops: they follow
    return jax.lax.stop_gradient(jnp.where(good, half, nominal).at[guesses].set(0.0))


def _open_loop(path: AlongRecord, start: Values) -> tuple[Array, Array]:
    """States (n - 1, n_states) and what sensors would show, without corrections, from the first row on."""
    model, x = path.model, path.model.integrate(start, path.steps).x

    def shown(t: Array, x: Array, u: Array) -> Array:
        return model.system.read(model.sensors, Values(t, x, u, start.packed, start.d))

    return x, jax.vmap(shown)(path.t[:-1], x, path.u[:-1])


def _spread(
    system: System,
    data: Data,
    given: Mapping[str, float] | None,
    known: Mapping[str, Any],
    size: Float[Array, " n_states"],
) -> Float[Array, " n_states"]:
    """Standard deviations of the states at the start."""
    chosen = numbers_by_name(given, system.states, "states", "a state of the model")
    first = {n: v for n, v in known.items() if np.isfinite(data.signals[n][0])}
    return jnp.stack(
        [
            jnp.asarray(chosen.get(n, first.get(n, s)), float)
            for n, s in zip(system.states, size, strict=True)
        ]
    )


def belief_at(
    start: Values,
    spread: Float[Array, " n_states"],
    params: Mapping[str, Any],
    drift: Mapping[str, Any],
) -> Belief:
    """The states at the start, the parameters that drift, and discrete variables, which are known."""
    own = jnp.asarray([params[n] for n in drift], float)
    d = jnp.zeros(0) if start.d is None else start.d
    deviations = jnp.concatenate(
        [spread, jnp.asarray(list(drift.values()), float), jnp.zeros_like(d)]
    )
    return Belief(jnp.concatenate([start.x, own, d]), jnp.diag(deviations**2))


def _with_members(start: Belief, count: int, key: PRNGKeyArray) -> Belief:
    apart = jax.random.normal(jax.random.split(key)[0], (count, len(start.mean)))
    members = start.mean + apart * jnp.sqrt(jnp.diag(start.covariance))
    return start._replace(members=members)


@compiled
def _filtered(
    how: Filter | MovingHorizon,
    path: AlongRecord,
    start: Belief,
    measured: Measured,
    q: Float[Array, " m"],
    key: PRNGKeyArray,
) -> Filtered:
    sigma = q * jnp.sqrt(path.steps.h)[:, None]
    if isinstance(how, MovingHorizon):
        return how.run(path, start, measured, sigma)
    return run(how, path, start, measured, sigma, key, path.settled)


def _likelihood(filtered: Filtered) -> Float[Array, ""]:
    return jnp.sum(filtered.innovation.log_likelihood)


def _best_level(filtered: Callable[[Array], Filtered]) -> Float[Array, ""]:
    """The level of process noise with the highest likelihood, of those that are tried.

    Raises:
        DataError: if the model diverges over the record with all of them.
    """
    levels = jnp.asarray(LEVELS)
    tried = jax.lax.stop_gradient(jax.lax.map(lambda a: _likelihood(filtered(a)), levels))
    if not traced(tried) and not np.isfinite(tried).any():
        raise DataError(
            "The estimates diverge over the record: give x0= near the true state, a smaller dt, or noise= by state."
        )
    return levels[jnp.argmax(jnp.where(jnp.isfinite(tried), tried, -jnp.inf))]


def _fitted(
    likelihood: Callable[[Array, Array], Array],
    q: Float[Array, " m"],
    r: Float[Array, " p"],
    free: Bool[np.ndarray, " p"],
    *,
    forward: bool,
) -> tuple[Float[Array, " m"], Float[Array, " p"]]:
    """The most likely process noise, where there is some, and noise of the free sensors; by L-BFGS on logarithms."""
    moving = np.concatenate([np.asarray(q) > 0, free])

    def at(theta: Float[Array, " k"]) -> tuple[Array, Array]:
        factors = jnp.exp(jnp.zeros(len(moving)).at[np.flatnonzero(moving)].set(theta))
        return q * factors[: len(q)], r * factors[len(q) :]

    def less(theta: Float[Array, " k"]) -> Float[Array, ""]:
        return -likelihood(*at(theta))

    derived = partial(value_and_jacobian, less, axis=-1) if forward else jax.value_and_grad(less)
    cost = jax.jit(derived)

    def both(theta: Any) -> tuple[float, np.ndarray]:
        value, slope = cost(jnp.asarray(theta))
        finite = bool(np.isfinite(value)) and bool(np.isfinite(slope).all())
        return (float(value), np.asarray(slope)) if finite else (1e30, np.zeros(len(theta)))

    count = int(moving.sum())
    found = minimize(
        both, np.zeros(count), jac=True, method="L-BFGS-B", bounds=[(-FAR, FAR)] * count
    )
    return at(jnp.asarray(cast(Any, found).x))
