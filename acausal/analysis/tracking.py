"""A model along a record, in its own fixed steps, as filters see it: states, and parameters that drift."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from acausal._jax import is_number, known, traced
from acausal.analysis.filtering import Belief, Function, gathered
from acausal.codegen import Packed, Values
from acausal.errors import DataError, ModelError, known_name, shown
from acausal.events import fire
from acausal.modeling import by_name
from acausal.simulation import (
    Adaptive,
    Integrated,
    Scheme,
    Steps,
    for_fixed_steps,
    integrate,
    integrate_in_steps,
    modes,
    solver_named,
)

if TYPE_CHECKING:
    from acausal.system import System

RESOLVED = 0.5
"""Steps times the rate of the fastest mode, so that classical Runge-Kutta steps follow it to about 1e-4."""

MOST_PARTS = 20
"""Where more parts of a step were needed for that, steps are implicit."""

LIKE_THE_STEPS, MANY = 10, 24
"""How often a short step is doubled for noise along the model, beside the number of substeps, or for stiff models."""

LONGER = 1e-6
"""Rows are added where samples are further apart than is usual, by more than this part of it."""


class TrackedModel(eqx.Module):
    """A model whose states and drifting parameters are estimated from sensors.

    An estimate ``z`` has the states, then these parameters, then the discrete variables of a model with events: what a
    controller has sampled is uncertain as the states are, whole numbers and truth values are taken as known.

    Attributes:
        system: the model.
        sensors: names of what is measured.
        drifting: names of the parameters that are estimated, too.
        params: all parameters; those that drift are replaced.
        solver, substeps: the scheme, and its steps from row to row; adaptive steps where a model with events asks for
            no others.
    """

    system: System = eqx.field(static=True)
    sensors: tuple[str, ...] = eqx.field(static=True)
    drifting: tuple[str, ...] = eqx.field(static=True)
    params: dict[str, Any]
    packed: Packed
    solver: Scheme | Adaptive = eqx.field(static=True)
    substeps: int = eqx.field(static=True)

    def values(self, t: Array, z: Float[Array, " m"], u: Float[Array, " n_inputs"]) -> Values:
        """The values of the model at an estimate."""
        x, _, d = self.parts(z)
        if (events := self.system.events) is not None:
            d = jnp.where(events.exact, jax.lax.stop_gradient(jnp.round(d)), d)
        return Values(t, x, u, self.packed_at(z), None if events is None else d)

    def parts(self, z: Float[Array, "*n m"]) -> tuple[Array, Array, Array]:
        """States, parameters that drift, and discrete variables."""
        n = len(self.system.states)
        first, rest = z[..., :n], z[..., n:]
        return first, rest[..., : len(self.drifting)], rest[..., len(self.drifting) :]

    @property
    def certain(self) -> Bool[np.ndarray, " m"]:
        """What of an estimate is taken as known."""
        own = np.zeros(len(self.system.states) + len(self.drifting), bool)
        events = self.system.events
        return own if events is None else np.concatenate([own, events.exact])

    def packed_at(self, z: Float[Array, " m"]) -> Packed:
        """The parameters at an estimate."""
        own = zip(self.drifting, self.parts(z)[1], strict=True)
        return self.system.pack({**self.params, **dict(own)}) if self.drifting else self.packed

    def closed(self, t: Array, z: Float[Array, " m"], u: Float[Array, " n_inputs"]) -> Array:
        """An estimate whose guesses of closed loops are the solutions, and whose conditions agree with it.

        A correction moves them there but nearly.
        """
        z = self.agreeing(t, z, u)
        if self.system.reduced.exact.all():
            return z
        x = self.system.initializer.closed(self.values(t, z, u))
        return jnp.concatenate([x, *self.parts(z)[1:]])

    def after(self, z: Float[Array, " m"], step: Steps) -> Float[Array, " m"]:
        """The estimate after a step, without noise."""
        z = self.agreeing(step.t, z, step.inputs.start)
        start = self.values(step.t, z, step.inputs.start)
        found = self.integrate(start, jax.tree.map(lambda a: a[None], step), direct=True)
        _, own, d = self.parts(z)
        return jnp.concatenate([found.end, own, d if found.d_end is None else found.d_end])

    def noise(
        self, z: Float[Array, " m"], step: Steps, sigma: Float[Array, " m"]
    ) -> Float[Array, "m m"]:
        """The covariance that random walks, of these deviations over a step, add to an estimate."""

        def rates(z: Float[Array, " m"]) -> Float[Array, " m"]:
            dx = self.system.rates(self.values(step.t, z, step.inputs.start))
            return jnp.concatenate([dx, jnp.zeros(len(z) - len(dx))])

        slope = jax.jacfwd(rates)(z) * step.h
        is_known = self.certain[:, None] | self.certain
        return gathered(jnp.where(is_known, 0.0, slope), sigma, self.doublings)

    @property
    def doublings(self) -> int:
        """For `gathered`: explicit steps follow the fastest mode, implicit ones may be a million times longer."""
        is_explicit = not isinstance(self.solver, dfx.AbstractImplicitSolver | Adaptive)
        return LIKE_THE_STEPS + self.substeps.bit_length() if is_explicit else MANY

    def integrate(self, start: Values, steps: Steps, *, direct: bool = False) -> Integrated:
        """The model over some rows; arguments as of `acausal.simulation.integrate`."""
        over: Any = integrate if self.system.events is None else integrate_in_steps
        return over(self.system, start, steps, self.solver, substeps=self.substeps, direct=direct)

    def agreeing(
        self, t: Array, z: Float[Array, " m"], u: Float[Array, " n_inputs"]
    ) -> Float[Array, " m"]:
        """An estimate whose conditions agree with its states: where one has changed, its event happens."""
        if (events := self.system.events) is None:
            return z
        after = fire(events, self.values(t, z, u), -jnp.ones(events.n_guards, z.dtype))
        return jnp.concatenate([after.x, self.parts(z)[1], after.d])

    def read(self, z: Float[Array, " m"], t: Array, u: Float[Array, " n_inputs"]) -> Array:
        """What the sensors show."""
        return self.system.read(self.sensors, self.values(t, self.agreeing(t, z, u), u))


class AlongRecord(eqx.Module):
    """A model along the n rows of a record, a `Path`.

    Attributes:
        model: the model.
        steps: from row to row.
        t, u: times and inputs at the rows.
    """

    model: TrackedModel
    steps: Steps
    t: Float[Array, " n"]
    u: Float[Array, "n n_inputs"]

    def step(self, row: Array) -> Function:
        """From a row to the next one."""
        one = jax.tree.map(lambda a: a[row], self.steps)
        return lambda z: self.model.after(z, one)

    def noise(
        self, row: Array, z: Float[Array, " m"], sigma: Float[Array, " m"]
    ) -> Float[Array, "m m"]:
        """What random walks add from a row to the next one."""
        return self.model.noise(z, jax.tree.map(lambda a: a[row], self.steps), sigma)

    def observe(self, row: Array) -> Function:
        """What is measured at a row."""
        return lambda z: self.model.read(z, self.t[row], self.u[row])

    def settled(self, belief: Belief, before: Belief | None) -> Belief:
        """A belief in which whole numbers and truth values are certain: those before its correction."""
        certain = self.model.certain
        if not certain.any():
            return belief
        known = belief if before is None else before
        kept = jax.tree.map(lambda a, b: jnp.where(certain, jnp.round(b), a), belief, known)
        covariance = jnp.where(certain[:, None] | certain, 0.0, belief.covariance)
        return kept._replace(covariance=covariance)


def rows_of(time: Float[np.ndarray, " n_samples"]) -> Float[np.ndarray, " n"]:
    """The times of samples, and further ones where these are further apart than usual."""
    lengths = np.diff(time)
    counts = np.maximum(1, np.ceil(lengths / np.median(lengths) - LONGER)).astype(int)
    within = [t + h * np.arange(c) / c for t, h, c in zip(time, lengths, counts, strict=False)]
    return np.append(np.concatenate(within), time[-1])


def make_model(
    system: System,
    sensors: tuple[str, ...],
    drifting: tuple[str, ...],
    params: Mapping[str, Any] | None,
    at: Callable[[Packed], Values],
    longest: float,
    dt: float | None,
    solver: Any,
) -> TrackedModel:
    """A model with steps that follow it.

    Arguments:
        system, sensors, drifting: as of `TrackedModel`.
        params: what differs from the model's own parameters.
        at: the values at the start, by parameters.
        longest: the longest way from row to row.
        dt, solver: as of `acausal.estimate`.

    Raises:
        DataError: for what is not a step.
    """
    every = {**system.parameters(), **by_name(params, "params", "values by name")}
    packed = system.pack(every)
    if dt is not None and not (is_number(dt) and dt > 0):
        raise DataError(f"dt={shown(dt)} is not a step; give a positive time in seconds.")
    parts = None if dt is None else max(1, int(np.ceil(longest / dt - LONGER)))
    own = sensors, drifting, every, packed
    if isinstance(solver, str) and solver == "auto" and dt is None and system.events is not None:
        return TrackedModel(system, *own, Adaptive(), 1)
    if isinstance(solver, str) and solver == "auto":
        found = parts_of_steps(system, at(packed), longest if dt is None else min(dt, longest))
        solver = "kvaerno3" if found is None else "rk4"
        parts = (parts or 1) * (found or 1) if dt is None else parts
    scheme = for_fixed_steps(solver_named(solver, fixed=True))
    return TrackedModel(system, *own, scheme, parts or 1)


def check_model(system: System, what: str, *, events: bool) -> None:
    """Refuse a model that ``what`` cannot follow: one without states, or with events that it does not follow.

    Raises:
        ModelError: for such a model.
    """
    if system.events is not None and not events:
        raise ModelError(
            f"{what} does not follow events, and '{system.flat.name}' has some: take ac.estimate with method='ekf', "
            "'ukf' or 'enkf', smooth laws, or ac.compile(model, inputs=[...]) with measured modes."
        )
    if not system.states:
        raise ModelError(f"{what}: '{system.flat.name}' has no states to estimate.")


def numbers_by_name(
    given: Any, known_names: tuple[str, ...], argument: str, kind: str
) -> dict[str, Any]:
    """Numbers by name that are not negative, such as standard deviations; they may be traced.

    Raises:
        DataError: for an unknown name, or what is not such a number.
    """
    first = known_names[0] if known_names else "name"
    found = by_name(given, argument, f"{argument}={{'{first}': ...}}")
    for name, value in found.items():
        known_name(name, known_names, f"{argument}:", then=f" is not {kind}:")
        if not traced(value) and not (is_number(value) and value >= 0):
            raise DataError(
                f"{argument}: '{name}' is {shown(value)}; give a finite number that is not negative."
            )
    return found


def to_estimate(system: System, given: Any) -> dict[str, Any]:
    """Parameters to estimate, with the deviations of what is known of them; errors as of `numbers_by_name`."""
    for name in by_name(given, "parameters", "deviations by name"):
        if reason := system.layout.why_not_free(name):
            raise DataError(f"parameters: {reason}.")
    return numbers_by_name(given, system.layout.names, "parameters", "a parameter of the model")


def parts_of_steps(system: System, at: Values, h: float) -> int | None:
    """Into how many parts a step of length h is divided so that it is accurate; ``None`` for implicit steps."""
    point = known(at)
    if point is None:
        return 1
    one = point._replace(**{n: np.asarray(getattr(point, n))[None] for n in ("t", "x", "u")})
    rates = modes(system, one)
    count = 1 if rates is None else int(np.ceil(h * float(np.max(np.abs(rates))) / RESOLVED))
    return max(count, 1) if count <= MOST_PARTS else None
