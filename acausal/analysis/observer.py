"""`observer`: one compiled step of a Kalman filter, for a bench that runs."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import as_key, check_time, is_number
from acausal.analysis.estimate import belief_at, filter_for
from acausal.analysis.filtering import Belief, Filter, Linearized, Measured
from acausal.analysis.tracking import TrackedModel, make_model, numbers_by_name
from acausal.codegen import Packed, Values
from acausal.errors import DataError, shown
from acausal.modeling import ByName
from acausal.simulation import Samples, Steps

if TYPE_CHECKING:
    from acausal.system import System


class Observer(ByName):
    """Estimates of a model's states while measurements come in.

    ``observer["wheel.v"]`` is a variable of the model as it is estimated now.

    Attributes:
        t: time of the last step; ``None`` before the first.
        mean, covariance: of the states, and of the parameters that are estimated.
    """

    def __init__(
        self,
        model: TrackedModel,
        how: Filter,
        start: Belief,
        sigma: Float[Array, " p"],
        walk: Float[Array, " m"],
    ) -> None:
        """Arguments: the model, the filter, the first belief, and the noise of sensors and process."""
        self._model, self._belief, self.t = model, start, cast("float | None", None)
        self._u = np.zeros(len(model.system.inputs))
        self._held = np.array([n in model.system.held_inputs for n in model.system.inputs], bool)
        self._correct = jax.jit(partial(_correct, model, how, sigma))
        self._step = jax.jit(partial(_step, model, how, sigma, walk))

    def step(
        self,
        t: float,
        u: Mapping[str, float] | ArrayLike | None = None,
        y: Mapping[str, float] | None = None,
    ) -> dict[str, float]:
        """Go on to a time, and correct by what is measured there.

        Arguments:
            t: the time [s], later than that of the last step.
            u: the inputs then, by name (the rest zero) or as an array; in between they are on a line, and those that
                are held jump at its end.
            y: measurements then, by name; those that are missing or NaN are left out.

        Returns:
            The states and the estimated parameters, by name.

        Raises:
            DataError: for a time that is not later, or names and values that do not fit.
        """
        model, system = self._model, self._model.system
        check_time(t)
        if self.t is not None and not t > self.t:
            raise DataError(f"t={t:g} s is not later than the last step, at {self.t:g} s.")
        given = isinstance(u, np.ndarray)
        now = np.asarray(u if given else system.input_values(u), float)
        if now.shape != self._u.shape:
            raise DataError(f"u has shape {now.shape}; the model has {len(system.inputs)} inputs.")
        seen = np.full(len(model.sensors), np.nan)
        for name, value in (y or {}).items():
            if name not in model.sensors:
                known = ", ".join(model.sensors)
                raise DataError(f"y: '{name}' is not a sensor; the observer has {known}.")
            seen[model.sensors.index(name)] = value
        if self.t is None:
            self._belief = self._correct(self._belief, np.concatenate([[t], now, seen]))
        else:
            reached = np.where(self._held, self._u, now)
            row = np.concatenate([[self.t, t - self.t], self._u, reached, [t], now, seen])
            self._belief = self._step(self._belief, row)
        self.t, self._u = float(t), now
        return dict(zip(self._order, np.asarray(self._belief.mean).tolist(), strict=True))

    @property
    def mean(self) -> Float[np.ndarray, " m"]:
        """The states, and the parameters that are estimated."""
        return np.asarray(self._belief.mean)

    @property
    def covariance(self) -> Float[np.ndarray, "m m"]:
        """Their covariance."""
        return np.asarray(self._belief.covariance)

    @property
    def deviations(self) -> dict[str, float]:
        """Their standard deviations, by name."""
        return dict(zip(self._order, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))

    @property
    def _order(self) -> tuple[str, ...]:
        return (*self._model.system.states, *self._model.drifting)

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        return tuple(dict.fromkeys((*self._model.system.variables, *self._model.drifting)))

    def _column(self, name: str) -> float:
        return float(self._side_by_side((name,))[0])

    def _side_by_side(self, names: tuple[str, ...]) -> Float[np.ndarray, " n_names"]:
        known = dict(zip(self._order, self.mean.tolist(), strict=True))
        read = tuple(n for n in names if n not in known)
        if read:
            found = _read(self._model, read, self.t or 0.0, self._belief.mean, self._u)
            known |= dict(zip(read, np.asarray(found).tolist(), strict=True))
        return np.array([known[n] for n in names])

    def __repr__(self) -> str:
        rows = zip(self._order, self.mean.tolist(), self.deviations.values(), strict=True)
        head = "Observer, not yet stepped" if self.t is None else f"Observer at t = {self.t:g} s"
        unit = self._model.system.unit
        return "\n".join(
            [head, *(f"  {n} {v:.5g} ± {s:.2g} {unit(n)}".rstrip() for n, v, s in rows)]
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
) -> Observer:
    """An observer for a bench that runs: `acausal.estimate`, one measurement after the other.

    Arguments:
        system: a compiled model without events.
        sensors: what is measured, and the standard deviation of its noise.
        noise: of the process, by state or estimated parameter: the deviation of a random walk after one second. Those
            that `acausal.estimate` has found for a record are ``found.sensors`` and ``found.noise``.
        sample_time: the usual time from step to step, for which the steps of the integration are chosen [s].
        method: ``"ekf"`` or ``"ukf"``.
        dt, states, parameters, x0, params, solver: as of `acausal.estimate`; without ``states`` each has its nominal
            value as its standard deviation at the start.
        inputs: with which the initial state is consistent, by name; by default zero.

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
    computed = tuple(n for n in system.variables if n not in system.inputs)
    known = numbers_by_name(sensors, computed, "sensors", "a variable that the model computes")
    if not known:
        raise DataError("sensors={} measure nothing; name at least one, with its noise.")
    kind = "a parameter of the model"
    drift = numbers_by_name(parameters, system.layout.names, "parameters", kind)
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
    start = belief_at(at(model.packed).x, jnp.asarray(spread, float), model.params, drift)
    r = jnp.asarray([float(v) for v in known.values()])
    q = jnp.asarray([float(walks.get(n, 0.0)) for n in order])
    return Observer(model, how, start, r, q)


def _correct(
    model: TrackedModel,
    how: Filter,
    sigma: Float[Array, " p"],
    belief: Belief,
    row: Float[Array, " n"],
) -> Belief:
    """The belief after measurements; the row has time, inputs and measurements, NaN where there are none."""
    t, u, y = jnp.split(row, [1, 1 + len(model.system.inputs)])
    known = ~jnp.isnan(y)
    measured = Measured(jnp.where(known, y, 0.0), known, sigma)
    return how.correct(belief, lambda z: model.read(z, t[0], u), measured, as_key(0))[0]


def _step(
    model: TrackedModel,
    how: Filter,
    sigma: Float[Array, " p"],
    walk: Float[Array, " m"],
    belief: Belief,
    row: Float[Array, " n"],
) -> Belief:
    """The same after a step; its start, length and inputs at both ends come first in the row."""
    n = len(model.system.inputs)
    begin, low, high, row = jnp.split(row, [2, 2 + n, 2 + 2 * n])
    step, noise = Steps(begin[0], begin[1], Samples(low, high)), walk * jnp.sqrt(begin[1])
    belief, _ = how.forecast(belief, lambda z: model.after(z, step), noise, as_key(0))
    return _correct(model, how, sigma, belief, row)


@eqx.filter_jit
def _read(
    model: TrackedModel, names: tuple[str, ...], t: ArrayLike, z: Array, u: ArrayLike
) -> Float[Array, " n_names"]:
    return model.system.read(names, model.values(jnp.asarray(t, float), z, jnp.asarray(u, float)))
