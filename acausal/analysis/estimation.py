"""The result of `estimate`: a solution with what is known of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from scipy.stats import chi2

from acausal._jax import compiled, traced
from acausal.analysis.filtering import Filtered, Measured, smoothed
from acausal.analysis.tracking import AlongRecord
from acausal.codegen import Packed, Values
from acausal.errors import DataError
from acausal.modeling import names_in
from acausal.simulation import Solution


@partial(
    jax.tree_util.register_dataclass,
    data_fields=[
        "values", "statistics", "log", "covariance", "innovations", "innovation_covariance",
        "log_likelihood", "noise", "sensors", "parameters", "filtered",
    ],
    meta_fields=["system"],
    drop_fields=["functions", "_observed", "_arrays", "path"],
)  # fmt: skip
@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class Estimation(Solution):
    """States over the rows of a record as they are estimated, and any variable of the model that follows from them.

    ``found["wheel.a"]`` is a variable, as of a `Solution`; ``found.deviation("wheel.a")`` its standard deviation.

    Attributes, besides those of `Solution`:
        covariance: of the states, the estimated parameters and the discrete variables of a model with events.
        innovations: by sensor, measured less expected from all before; NaN where nothing is measured.
        innovation_covariance: theirs, in the order of `sensors`.
        log_likelihood: of all measurements.
        noise: by state and parameter, the process noise that was used: the deviation of a random walk after a second.
        sensors: by sensor, the standard deviation of its noise that was used.
        parameters: by name, the estimated parameters over time.
        filtered: what the smoother needs; ``None`` in its result.
    """

    covariance: Float[Array, "n m m"]
    innovations: dict[str, Float[Array, " n"]]
    innovation_covariance: Float[Array, "n p p"]
    log_likelihood: Float[Array, ""]
    noise: dict[str, Float[Array, ""]]
    sensors: dict[str, Float[Array, ""]]
    parameters: dict[str, Float[Array, " n"]]
    filtered: Filtered | None
    path: AlongRecord | None = field(default=None, repr=False)

    @classmethod
    def of(
        cls,
        path: AlongRecord,
        filtered: Filtered,
        measured: Measured,
        noise: dict[str, Float[Array, ""]],
        sensors: dict[str, Float[Array, ""]],
    ) -> Estimation:
        """The result of a filter."""
        innovation = filtered.innovation
        known = jnp.where(measured.known, innovation.value, jnp.nan)
        values, own = _values(path, filtered.mean)
        return cls(
            values=values,
            system=path.model.system,
            covariance=filtered.covariance,
            innovations=dict(zip(sensors, known.T, strict=True)),
            innovation_covariance=innovation.covariance,
            log_likelihood=jnp.sum(innovation.log_likelihood),
            noise=noise,
            sensors=sensors,
            parameters=own,
            filtered=filtered,
            path=path,
        )

    def smooth(self) -> Estimation:
        """Estimates that use all measurements, also later ones (Rauch, Tung and Striebel); innovations stay.

        Raises:
            DataError: for estimates that JAX has returned.
        """
        if self.filtered is None:
            return self
        mean, covariance = _smoothed(self.filtered)
        values, own = _values(self._path("smooth"), mean)
        return replace(self, values=values, covariance=covariance, parameters=own, filtered=None)

    def deviation(self, name: str | Sequence[str]) -> Float[Array, "n ..."]:
        """The standard deviation of one variable or estimated parameter over time, or of several, one in each column.

        Raises:
            DataError: for estimates that JAX has returned.
            ModelError: for an unknown name.
        """
        names, path = names_in(name), self._path("deviation")
        own = tuple(self.parameters)
        d = self.values.d
        z = jnp.concatenate(
            [self.x, *(self.parameters[n][:, None] for n in own), *([] if d is None else [d])],
            axis=1,
        )
        read = tuple(n for n in names if n not in own)
        columns = dict(zip(read, _variances(path, read, z, self.covariance).T, strict=True))
        first = len(self.system.states)
        columns |= {n: self.covariance[:, first + i, first + i] for i, n in enumerate(own)}
        if not names:
            return jnp.zeros((len(self.t), 0))
        sigma = jnp.sqrt(jnp.maximum(jnp.stack([columns[n] for n in names], axis=1), 0.0))
        return sigma[:, 0] if isinstance(name, str) else sigma

    def deviations(self, names: Sequence[str]) -> dict[str, Float[np.ndarray, " n"]]:
        """The same by name, of those of some variables that are estimated; of estimates that JAX has returned, none."""
        computed = [n for n in names if n not in self.system.inputs]
        if not computed or self.path is None:
            return {}
        return dict(zip(computed, np.asarray(self.deviation(computed)).T, strict=True))

    @property
    def groups(self) -> dict[str, tuple[str, ...]]:
        """The variables that a page shows, by heading; states first."""
        estimated = {"Estimated parameters": tuple(self.parameters)} if self.parameters else {}
        states, inputs = super().groups.items()
        return dict([states, *estimated.items(), inputs])

    @property
    def nis(self) -> Float[Array, " n"]:
        """Squared innovations over their covariances: of a consistent filter χ², one degree for each sensor."""
        value = jnp.stack(list(self.innovations.values()), axis=1)
        value = jnp.where(jnp.isnan(value), 0.0, value)
        weighted = jnp.linalg.solve(self.innovation_covariance, value[..., None])[..., 0]
        return jnp.sum(value * weighted, axis=1)

    @property
    def consistency(self) -> str:
        """How large squared innovations are on average, and how large those of a consistent filter, in a sentence."""
        count = int(sum(np.isfinite(v).sum() for v in self.innovations.values()))
        low, high = chi2.ppf([0.025, 0.975], count) / count
        mean = float(jnp.sum(self.nis)) / count
        return (
            f"{count} innovations, squared over their variances {mean:.3g} on average (of a consistent filter "
            f"{low:.3g} to {high:.3g})"
        )

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        return tuple(dict.fromkeys((*super().names, *self.parameters)))

    def _observe(self, names: Sequence[str]) -> None:
        self._observed.update({n: v for n, v in self.parameters.items() if n in names})
        super()._observe(names)

    def _path(self, what: str) -> AlongRecord:
        if self.path is None:
            raise DataError(
                f"{what}: the model's path is not known of estimates that JAX has returned; ask inside of jit."
            )
        return self.path

    @property
    def _about(self) -> list[str]:
        return [f"log likelihood {float(self.log_likelihood):.6g}", self.consistency]

    def __repr__(self) -> str:
        if traced(self.t):
            return f"Estimation({len(self.names)} variables)"
        states = (*self.system.states, *self.parameters)
        last = np.sqrt(np.diagonal(np.asarray(self.covariance[-1])))[: len(states)]
        now = [*np.asarray(self.x[-1]), *(float(v[-1]) for v in self.parameters.values())]
        kind = "smoothed" if self.filtered is None else "filtered"
        span = f"{self.t.shape[0]} points from {float(self.t[0]):g} to {float(self.t[-1]):g} s"
        lines = [
            f"Estimation from {', '.join(self.sensors)}, {kind}: {span}",
            f"  log likelihood  {float(self.log_likelihood):.6g}",
            f"  consistency     {self.consistency}",
        ]
        rows = zip(states, now, last, strict=True)
        lines += [f"  {n} {v:.5g} ± {s:.2g} {self.unit(n)} at the end".rstrip() for n, v, s in rows]
        return "\n".join(lines)


def _values(
    path: AlongRecord, mean: Float[Array, "n m"]
) -> tuple[Values, dict[str, Float[Array, " n"]]]:
    """The values of the model along a path, and the parameters that drift."""
    model = path.model
    packed, mean = model.packed, _closed(path, mean)
    if model.drifting:
        rows = jax.vmap(lambda z: model.packed_at(z).values)(mean)
        packed = Packed(rows, packed.modules)
    x, own, d = model.parts(mean)
    found = dict(zip(model.drifting, own.T, strict=True))
    return Values(path.t, x, path.u, packed, None if model.system.events is None else d), found


@compiled
def _closed(path: AlongRecord, mean: Float[Array, "n m"]) -> Float[Array, "n m"]:
    return jax.vmap(path.model.closed)(path.t, mean, path.u)


@compiled
def _variances(
    path: AlongRecord,
    names: tuple[str, ...],
    z: Float[Array, "n m"],
    covariance: Float[Array, "n m m"],
) -> Float[Array, "n n_names"]:
    """The variances of some variables, by their derivatives at the estimates."""

    def one(t: Array, z: Array, u: Array, covariance: Array) -> Float[Array, " n_names"]:
        model = path.model
        slope = jax.jacfwd(lambda z: model.system.read(names, model.values(t, z, u)))(z)
        return jnp.einsum("ni,ij,nj->n", slope, covariance, slope)

    return jax.vmap(one)(path.t, z, path.u, covariance)


_smoothed = compiled(smoothed)
