"""`observer`: one compiled step of a Kalman filter, for a bench that runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, cast

import jax
import jax.numpy as jnp
import numpy as np
from jax.flatten_util import ravel_pytree
from jax.typing import ArrayLike
from jaxtyping import Array, Bool, Float

from acausal._jax import check_time, is_number, is_real
from acausal.analysis.estimate import belief_at, filter_for
from acausal.analysis.filtering import Belief, Linearized, Measured
from acausal.analysis.tracking import (
    LONGER,
    TrackedModel,
    make_model,
    numbers_by_name,
    to_estimate,
)
from acausal.codegen import Packed, Values
from acausal.errors import DataError, shown
from acausal.modeling import ByName, by_name
from acausal.simulation import Samples, Steps

if TYPE_CHECKING:
    from acausal.system import System


MOST = 1_000_000
"""A pause is so many steps at most."""

ROUNDING = 1e-9
"""Measurements may be later than allowed by this part of it."""


class ObserverMemory(NamedTuple):
    """What an observer remembers of its last step: time and inputs, NaN before the first, and what it believes."""

    t: Float[Array, ""]
    u: Float[Array, " n_inputs"]
    mean: Float[Array, " m"]
    covariance: Float[Array, "m m"]


@dataclass(frozen=True, eq=False)
class ObserverStep:
    """The step of an observer, a function of arrays alone.

    Attributes:
        model: with its sensors.
        how: the filter.
        sigma, walk: noise of the sensors and of the process.
        sample_time: the usual time from step to step; a longer pause is several such steps [s].
        start: what it remembers before the first step.
    """

    model: TrackedModel
    how: Linearized
    sigma: Float[Array, " p"]
    walk: Float[Array, " m"]
    sample_time: float
    start: ObserverMemory

    @property
    def names(self) -> tuple[str, ...]:
        """What is estimated: the states, and parameters."""
        return (*self.model.system.states, *self.model.drifting)

    @property
    def held(self) -> Bool[np.ndarray, " n_inputs"]:
        """Which inputs are held, and jump at the end of a step."""
        system = self.model.system
        return np.array([n in system.held_inputs for n in system.inputs], bool)

    def after(
        self, memory: ObserverMemory, t: Float[Array, ""], u: Float[Array, " n_inputs"], y: Array
    ) -> ObserverMemory:
        """What is remembered after a time, with inputs and measurements there; y is NaN where nothing is measured."""
        is_first = jnp.isnan(memory.t)
        since, low = jnp.where(is_first, t, memory.t), jnp.where(is_first, u, memory.u)
        n = jnp.ceil((t - since) / self.sample_time - LONGER)
        n = jnp.clip(n, 1, MOST).astype(jnp.int32)
        h, change = (t - since) / n, (jnp.where(self.held, low, u) - low) / n
        sigma = self.walk * jnp.sqrt(h)

        def forecast(k: Array, belief: Belief) -> Belief:
            step = Steps(since + k * h, h, Samples(low + k * change, low + (k + 1) * change))
            noise = self.model.noise(belief.mean, step, sigma)
            return self.how.forecast(belief, lambda z: self.model.after(z, step), noise, None)[0]

        belief = jax.lax.fori_loop(0, n, forecast, Belief(memory.mean, memory.covariance))
        known = ~jnp.isnan(y)
        measured = Measured(jnp.where(known, y, 0.0), known, self.sigma)
        belief, _ = self.how.correct(belief, lambda z: self.model.read(z, t, u), measured, None)
        return ObserverMemory(t, u, self.model.closed(t, belief.mean, u), belief.covariance)

    def read(self, names: tuple[str, ...], memory: ObserverMemory) -> Float[Array, " n_names"]:
        """Variables of the model as they are estimated."""
        values = self.model.values(memory.t, memory.mean, memory.u)
        return self.model.system.read(names, values)


class Observer(ByName):
    """Estimates of a model's states while measurements come in.

    ``observer["wheel.v"]`` is a variable of the model as it is estimated now.

    Attributes:
        t: time of the last step; ``None`` before the first.
        mean, covariance: of the states, and of the parameters that are estimated.
        step_of_arrays: the step as a function of arrays, which `acausal.export` writes.
    """

    def __init__(self, step: ObserverStep, late: float = 0.0) -> None:
        """Arguments: the step, at whose start the observer begins; how late measurements may come [s]."""
        system, sensors = step.model.system, step.model.sensors
        n, m = 1 + len(system.inputs), len(step.names)
        self.step_of_arrays, self.t = step, cast("float | None", None)
        self._places = {name: n + i for i, name in enumerate(sensors)}
        self._row = np.full(n + len(sensors), np.nan)
        self._mean, self._covariance = slice(n, n + m), slice(n + m, None)
        self._memory, unravel = ravel_pytree(step.start)
        self._late, self._past = late, list[tuple[Array, Float[np.ndarray, " n"]]]()

        def advance(memory: Array, row: Array) -> Array:
            """One round of a loop, which XLA compiles as a whole (`acausal._jax.xla`); one array costs least time."""

            def after(memory: Array) -> Array:
                return ravel_pytree(step.after(unravel(memory), row[0], row[1:n], row[n:]))[0]

            return jax.lax.while_loop(lambda memory: ~(memory[0] >= row[0]), after, memory)

        self._advance = jax.jit(advance)
        self._read = jax.jit(lambda names, v: step.read(names, unravel(v)), static_argnums=0)

    def step(
        self,
        t: float,
        u: Mapping[str, float] | ArrayLike | None = None,
        y: Mapping[str, float] | None = None,
    ) -> dict[str, float]:
        """Go on to a time, and correct by what is measured there.

        Arguments:
            t: the time [s], later than that of the last step, or of a measurement that comes late.
            u: the inputs then, by name (the rest zero) or as an array; in between they are on a line, and those that
                are held jump at its end.
            y: measurements then, by name; those that are missing or NaN are left out.

        Returns:
            The states and the estimated parameters at the latest time, by name.

        Raises:
            DataError: for a time that is not later, and earlier than ``late`` allows, or later than a million times
                ``sample_time``; for names and values that do not fit.
        """
        system = self.step_of_arrays.model.system
        check_time(t)
        is_late = self.t is not None and not t > self.t
        longest = MOST * self.step_of_arrays.sample_time
        if self.t is not None and t - self.t > longest:
            raise DataError(
                f"t={t:g} s: a pause of {t - self.t:g} s is more than {MOST} times sample_time; "
                "make a new observer that starts there (states=)."
            )
        if is_late and self._late and u is not None:
            raise DataError(f"t={t:g} s: inputs are known up to {self.t:g} s; leave u out.")
        now = u if isinstance(u, np.ndarray) else system.input_values(u)
        if np.shape(now) != (len(system.inputs),):
            raise DataError(
                f"u has shape {np.shape(now)}; the model has {len(system.inputs)} inputs."
            )
        row = self._row.copy()
        row[0], row[1 : 1 + len(system.inputs)] = t, now
        if not (is_known := np.isfinite(row[1 : 1 + len(system.inputs)])).all():
            name = system.inputs[int(np.argmin(is_known))]
            raise DataError(
                f"u: '{name}' is not finite at t={t:g} s; give a number, such as the last one."
            )
        for name, value in by_name(y, "y", "measurements by name").items():
            if name not in self._places:
                known = ", ".join(self._places)
                raise DataError(f"y: '{name}' is not a sensor; the observer has {known}.")
            if not (is_real(value) and np.ndim(value) == 0) or np.isinf(value):
                raise DataError(f"y: '{name}' is {shown(value)}; give a finite number, or NaN.")
            row[self._places[name]] = value
        for each in self._back_to(row) if is_late else [row]:
            if self._late:
                self._past.append((self._memory, each))
            self._memory, self.t = self._advance(self._memory, each), float(each[0])
        early = cast("float", self.t) - self._late * (1 + ROUNDING)
        while len(self._past) > 1 and self._past[1][1][0] <= early:
            del self._past[0]
        return self._by_name(self.mean)

    def _back_to(self, row: Float[np.ndarray, " n"]) -> list[Float[np.ndarray, " n"]]:
        """The rows to step through again, with a late one; what is remembered goes back to before them."""
        times, n = [r[0] for _, r in self._past], self._mean.start
        k, last = int(np.searchsorted(times, row[0])), cast("float", self.t)
        if k == len(times) or row[0] < times[0]:
            raise DataError(
                f"t={row[0]:g} s is not later than the last step, at {last:g} s; for measurements that come late, "
                "make the observer with late= seconds."
            )
        again = [r for _, r in self._past[k:]]
        if times[k] == row[0]:
            old = again.pop(0)
            row[n:], row[1:n] = np.where(np.isnan(row[n:]), old[n:], row[n:]), old[1:n]
        else:
            low, high = self._past[k - 1][1], again[0]
            share = (row[0] - low[0]) / (high[0] - low[0])
            row[1:n] = np.where(
                self.step_of_arrays.held, low[1:n], low[1:n] + share * (high - low)[1:n]
            )
        self._memory = self._past[k][0]
        del self._past[k:]
        return [row, *again]

    @property
    def mean(self) -> Float[np.ndarray, " m"]:
        """The states, and the parameters that are estimated."""
        return np.asarray(self._memory)[self._mean]

    @property
    def covariance(self) -> Float[np.ndarray, "m m"]:
        """Their covariance."""
        return np.asarray(self._memory)[self._covariance].reshape(len(self.mean), -1)

    @property
    def deviations(self) -> dict[str, float]:
        """Their standard deviations, by name."""
        return self._by_name(np.sqrt(np.diag(self.covariance)))

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        step = self.step_of_arrays
        return tuple(dict.fromkeys((*step.model.system.variables, *step.names)))

    def _by_name(self, values: Float[np.ndarray, " m"]) -> dict[str, float]:
        return dict(zip(self.step_of_arrays.names, values.tolist(), strict=True))

    def _column(self, name: str) -> float:
        return float(self._side_by_side((name,))[0])

    def _side_by_side(self, names: tuple[str, ...]) -> Float[np.ndarray, " n_names"]:
        known, memory = self._by_name(self.mean), self._memory
        read = tuple(n for n in names if n not in known)
        if read:
            if self.t is None:
                memory = memory.at[: self._mean.start].set(0.0)
            known |= dict(zip(read, np.asarray(self._read(read, memory)).tolist(), strict=True))
        return np.array([known[n] for n in names])

    def __repr__(self) -> str:
        sizes, unit = self.deviations, self.step_of_arrays.model.system.unit
        head = "Observer, not yet stepped" if self.t is None else f"Observer at t = {self.t:g} s"
        rows = self._by_name(self.mean).items()
        return "\n".join(
            [head, *(f"  {n} {v:.5g} ± {sizes[n]:.2g} {unit(n)}".rstrip() for n, v in rows)]
        )


def observer(
    system: System,
    sensors: Mapping[str, float],
    noise: Mapping[str, float],
    sample_time: float,
    *,
    method: Literal["ekf", "ukf"] = "ekf",
    dt: float | None = None,
    states: Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    x0: Mapping[str, ArrayLike] | Literal["steady"] | None = None,
    params: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    solver: Any = "auto",
    late: float = 0.0,
) -> Observer:
    """An observer for a bench that runs: `acausal.estimate`, one measurement after the other.

    Arguments:
        system: a compiled model without events.
        sensors: what is measured, and the standard deviation of its noise.
        noise: of the process, by state or estimated parameter: the deviation of a random walk after one second. Those
            that `acausal.estimate` has found for a record are ``found.sensors`` and ``found.noise``.
        sample_time: the usual time from step to step, for which the steps of the integration are chosen; a longer
            pause is several such steps [s].
        method: ``"ekf"`` or ``"ukf"``.
        dt, states, parameters, x0, params, solver: as of `acausal.estimate`; without ``states`` each has its nominal
            value as its standard deviation at the start.
        inputs: with which the initial state is consistent, by name; by default zero.
        late: how many seconds late measurements may come: `Observer.step` then goes back to their time, and makes the
            steps since then again.

    Raises:
        DataError: if an argument does not fit.
        ModelError: for a model that is not compiled, or that has events or no states.
    """
    how = filter_for(system, method, "observer")
    if not isinstance(how, Linearized):
        raise DataError(f"observer: method='{method}' has no single step; take 'ekf' or 'ukf'.")
    if not (is_number(sample_time) and sample_time > 0):
        raise DataError(
            f"sample_time={shown(sample_time)} is not the time of a step; give seconds."
        )
    if not (is_number(late) and late >= 0):
        raise DataError(f"late={shown(late)} is not a time; give seconds, 0 for none.")
    computed = tuple(n for n in system.variables if n not in system.inputs)
    known = numbers_by_name(sensors, computed, "sensors", "a variable that the model computes")
    if not known:
        raise DataError("sensors={} measure nothing; name at least one, with its noise.")
    drift = to_estimate(system, parameters)
    order = (*system.states, *drift)
    walks = numbers_by_name(noise, order, "noise", "a state, nor a parameter to estimate")
    given = numbers_by_name(states, system.states, "states", "a state of the model")
    u0: Any = system.inputs_at(0.0, inputs)
    begun: Any = x0

    def at(packed: Packed) -> Values:
        return system.values(0.0, system.initial_state(packed, begun, inputs=u0), u0, packed)

    model = make_model(system, tuple(known), tuple(drift), params, at, sample_time, dt, solver)
    usual = system.nominal * (np.arange(len(system.states)) < system.reduced.n_independent)
    spread = [given.get(n, s) for n, s in zip(system.states, usual.tolist(), strict=True)]
    start = belief_at(at(model.packed), jnp.asarray(spread, float), model.params, drift)
    r = jnp.asarray([float(v) for v in known.values()])
    q = jnp.asarray([float(walks.get(n, 0.0)) for n in order])
    nothing = jnp.full(len(system.inputs), jnp.nan)
    begin = ObserverMemory(jnp.asarray(jnp.nan), nothing, start.mean, start.covariance)
    return Observer(ObserverStep(model, how, r, q, float(sample_time), begin), float(late))
