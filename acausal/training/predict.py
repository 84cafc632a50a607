"""Predict other records: what each has for itself is found as in the training, all else is as it was learned."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from acausal._jax import compiled, is_number, levenberg_marquardt, value_and_jacobian
from acausal.data import Data, RecordsLike, records_of
from acausal.errors import DataError, known_name, listing, percent, shown, warn
from acausal.jobs import Workers, blocks, need_workers, on_workers
from acausal.modeling import by_name
from acausal.reporting import Band
from acausal.simulation import Adaptive
from acausal.training.auto.sensitive import OFF, SENSITIVE, sensitivity_of_each
from acausal.training.conformal import Conformal
from acausal.training.objective.held_out import over
from acausal.training.objective.initial_state import InitialState, by_record, check_records
from acausal.training.objective.problem import Problem
from acausal.training.objective.start_modes import with_start_modes
from acausal.training.objective.start_prior import StartPrior, start_prior
from acausal.training.objective.start_sizes import found_starts, with_sizes
from acausal.training.objective.trainable import Simulated, Trainable
from acausal.training.prediction import Prediction, Predictions
from acausal.training.record_fit import RecordFit, of_records
from acausal.training.trained_model import TrainedModel, out_of_range
from acausal.training.uncertainty.bumps import Bumped, bumped_law, with_changes
from acausal.training.uncertainty.confidence import Confidence

IN_NOISE, TINY, MUCH, FINEST = 0.3, 1e-4, 5.0, 64
"""What half as long steps may change, relative to the noise or at least the signal; a change to warn of where the steps
of the fit were as long; most steps between two samples."""

MISSED, SEEN = 3.0, 0.05
"""A target is missed where the error is more than so many times its noise, and more than this part of its deviation."""

UPDATES = 50
"""At most so many steps find what a record has for itself."""

OwnParameters = Mapping[str, float] | Mapping[str, Mapping[str, float]]
"""Values of parameters that differ between records, by name: the same for all records, or by record."""


class Own(eqx.Module):
    """What R records have for themselves: m numbers, parameters first, then the moves of their initial states.

    Attributes:
        problem: the records, and what is known of their starts.
        trainable: what was trained.
        values: where the numbers begin, in the units of `Trainable`.
        free: those that the records' targets may move.
        information: the inverse of their prior variances.
    """

    problem: Problem
    trainable: Trainable
    values: Float[Array, "R m"]
    free: Bool[Array, "R m"]
    information: Float[Array, "R m"]

    def moved(self, values: Float[Array | np.ndarray, "R m"]) -> Trainable:
        """The training's result with other values of these numbers."""
        names, values = self.problem.per_record.names, jnp.asarray(values)
        own = {n: values[:, i] for i, n in enumerate(names)}
        starts = None if self.problem.start_prior is None else values[:, len(names) :]
        return replace(self.trainable, per_record=own, starts=starts)


class _Some(NamedTuple):
    """Some records, with what was given for them."""

    records: Mapping[str, Data]
    x0: InitialState
    params: Mapping[str, Mapping[str, float]]


def predict(
    fit: TrainedModel,
    data: RecordsLike,
    x0: InitialState,
    params: OwnParameters | None,
    conformal: Conformal | None,
    executor: Workers | None = None,
) -> Predictions:
    """Predict records; arguments and errors as those of `Fit.predict`."""
    records = {n: d.for_system(fit.system) for n, d in records_of(data).items()}
    check_records(x0, records)
    # the start of a prediction is found beside nothing else
    starts = dict(zip(records, by_record(records, x0), strict=True))
    x0 = {name: "auto" if of == "fit" else of for name, of in starts.items()}
    own = _own_given(params, records)
    if executor is None:
        return Predictions(_predicted((fit, conformal), _Some(records, x0, own)), fit.system)
    need_workers(executor, "predict")
    fit.confidence()  # workers receive it

    def some(block: range) -> _Some:
        names = list(records)[block.start : block.stop]
        given = {n: own[n] for n in names if n in own}
        return _Some({n: records[n] for n in names}, {n: x0[n] for n in names}, given)

    tasks = [some(block) for block in blocks(len(records))]
    parts = on_workers(executor, _predicted, (fit, conformal), tasks, "predict")
    return Predictions({n: one for part in parts for n, one in part.items()}, fit.system)


def _own_given(
    params: OwnParameters | None, records: Mapping[str, Data]
) -> dict[str, Mapping[str, float]]:
    """What a user gives for each record.

    Raises:
        DataError: for a name that is no record.
    """
    given = by_name(params, "params", "values by name, or by record")
    if not any(isinstance(v, Mapping) for v in given.values()):
        return dict.fromkeys(records, given)
    for record in given:
        known_name(record, records, "params: there is no record")
    return dict(given)


def _predicted(shared: tuple[TrainedModel, Conformal | None], some: _Some) -> dict[str, Prediction]:
    """Predictions of some records in one program; they do not know of each other."""
    fit, conformal = shared
    system, targets = fit.system, fit.problem.targets
    confidence = fit.confidence()
    alike = np.array([confidence.noise[n] * np.sqrt(confidence.alike[n]) for n in targets])
    least = np.maximum(alike, 1e-300)
    own, values, simulated = _in_fine_steps(fit, _own(fit, some), least)
    problem, trainable = own.problem, own.moved(values)
    if conformal is None:
        sigma = _deviations(own, values, _certainty(own, least), fit, confidence)
    else:
        sigma = np.tile([conformal.width[n] / 2 for n in targets], (len(problem.records), 1))
    made = of_records(problem, trainable, simulated)
    units = {n: system.unit(n) for n in targets}

    sensitive = sensitivity_of_each(problem, trainable, simulated)

    def one(k: int, record: RecordFit) -> Prediction:
        rows = problem.records.rows_of(k)
        bands = {
            n: Band(record.time, record.predicted[:, i], sigma[rows, i])
            for i, n in enumerate(targets)
        }
        every = {f.name: getattr(record, f.name) for f in fields(RecordFit)}
        return Prediction(
            **every,
            bands=bands,
            outside=out_of_range(record, fit),
            doubts=tuple(_doubts(record, sensitive[k], confidence.noise)),
            found=found_starts(problem, slice(k, k + 1)),
            units=units,
        )

    named = zip(some.records, made.values(), strict=True)
    return {n: one(k, replace(r, name=n)) for k, (n, r) in enumerate(named)}


def _doubts(record: RecordFit, sensitive: float, noise: Mapping[str, float]) -> Iterator[str]:
    """See `Prediction`."""
    if sensitive > SENSITIVE:
        yield (
            f"Starts that are off by {percent(OFF)} change it by {percent(OFF * sensitive)}: the model is unstable or "
            "chaotic, and one simulation does not follow it. Predict shorter parts (data.between), or follow what is "
            "measured by ac.estimate."
        )
    for (name, error), size in zip(record.rms.items(), record.sigma.tolist(), strict=True):
        if error > max(MISSED * noise[name], SEEN * size):
            yield (
                f"'{name}' is missed by {error / noise[name]:.2g} times its noise: the model does not hold here, or "
                "starts in another state (x0=) or with other discrete variables than its own."
            )


def _in_fine_steps(
    fit: TrainedModel, own: Own, noise: Float[np.ndarray, " n_targets"]
) -> tuple[Own, Float[np.ndarray, "R m"], Simulated]:
    """What records have for themselves, and their simulations, in steps whose errors stay below a part of the noise.

    The steps of a training were right for its records; others may move faster. Where they were not even that, a
    warning says so.
    """
    values = _found(own, _certainty(own, noise))
    simulated = own.problem.simulate(own.moved(values))
    if isinstance(own.problem.solver, Adaptive) or own.problem.system.events is not None:
        return own, values, simulated
    while own.problem.substeps < FINEST:
        finer = own.problem.finer()
        change = _change(simulated, finer.simulate(own.moved(values)))
        allowed = np.maximum(IN_NOISE * noise, TINY * np.asarray(own.problem.records.sigma))
        if (change <= allowed).all():
            break
        if own.problem.substeps == fit.problem.substeps:
            trained = fit.problem.simulate(fit.trained)
            of_fit = _change(trained, fit.problem.finer().simulate(fit.trained))
            if (of_fit > allowed).any():
                if (change > MUCH * noise).any():
                    _warn_of_steps(fit, change, of_fit, noise)
                break
        own = replace(own, problem=finer)
        values = _found(own, _certainty(own, noise))
        simulated = finer.simulate(own.moved(values))
    return own, values, simulated


def _warn_of_steps(
    fit: TrainedModel,
    change: Float[np.ndarray, " n_targets"],
    of_fit: Float[np.ndarray, " n_targets"],
    noise: Float[np.ndarray, " n_targets"],
) -> None:
    i = int(np.argmax(change / noise))
    name = fit.problem.targets[i]
    is_auto = fit.settings.get("strategy") == "auto"
    chosen = "" if is_auto else ", or by strategy='auto', which chooses them"
    warn(
        f"predict: steps of half the length change '{name}' by up to {change[i]:.3g} {fit.system.unit(name)}, and by "
        f"{of_fit[i]:.3g} in the records of the fit; the noise is {noise[i]:.2g}. The fit's steps are too long: fit "
        f"with a smaller dt={chosen}."
    )


def _change(simulated: Simulated, finer: Simulated) -> Float[np.ndarray, " n_targets"]:
    """How much finer steps change each target, at most; infinite where they end what diverges."""
    coarse, fine = np.asarray(simulated.y), np.asarray(finer.y)
    change = np.where(np.isfinite(coarse), np.abs(coarse - fine), np.inf)
    return np.max(np.where(np.isfinite(fine), change, 0.0), axis=0, initial=0.0)


def _certainty(
    own: Own, noise: Float[np.ndarray, " n_targets"]
) -> Float[np.ndarray, "N n_targets"]:
    """What a deviation of each sample is divided by the noise with; zero where nothing is measured."""
    return np.sqrt(np.asarray(own.problem.records.weight)) / noise


def _own(fit: TrainedModel, some: _Some) -> Own:
    """What the records have for themselves, before their targets have told of it."""
    records, x0, params = some
    # no record counts for more because of others, which are not predicted along with it
    alike = replace(fit.problem, weighting=replace(fit.problem.weighting, records="samples"))
    problem = over(alike, records, x0, measured=False)
    # numbers for names, which compiled programs know: they serve other records of that length
    numbers = tuple(map(str, range(problem.records.count)))
    problem = replace(problem, records=replace(problem.records, names=numbers))
    trainable = problem.over_other_records(fit.trained)
    problem = with_start_modes(problem, trainable, records, x0, trained=True)
    laid, names = problem.records, problem.per_record.names
    measured = np.isfinite(laid.measured)
    has = np.array([measured[laid.rows_of(k)].any() for k in range(laid.count)])
    prior = start_prior(problem.system, records, x0)
    if prior is not None:
        known = StartPrior(jnp.where(has[:, None], prior.scale, 0.0))
        problem = with_sizes(replace(problem, start_prior=known), trainable)
    moves = np.zeros((laid.count, 0 if prior is None else len(problem.system.states)))
    own = np.zeros((laid.count, len(names)))
    for i, name in enumerate(names):
        own[:, i] = trainable.per_record[name]
    own, given = _given(fit, own, records, params)
    spread = [float(np.std(np.asarray(fit.trained.per_record[n]))) or 1.0 for n in names]
    tied = np.asarray(problem.per_record.tied) > 0
    free = np.concatenate([has[:, None] & ~given, np.broadcast_to(has[:, None], moves.shape)], 1)
    loose = np.where(has[:, None], 0.0, np.asarray(spread) ** -2.0)
    information = np.concatenate([np.where(tied, 1.0, loose), np.ones_like(moves)], 1)
    information[:, : len(names)][given] = np.inf
    values = np.concatenate([own, moves], 1)
    return Own(problem, trainable, *map(jnp.asarray, (values, free, information)))


def _given(
    fit: TrainedModel,
    own: Float[np.ndarray, "R n_own"],
    records: Mapping[str, Data],
    params: Mapping[str, Mapping[str, float]],
) -> tuple[Float[np.ndarray, "R n_own"], Bool[np.ndarray, "R n_own"]]:
    """Parameters of records with those that a user gives, and which these are.

    Raises:
        DataError: for a name that is no such parameter, or what is not a number.
    """
    known, given = fit.problem.per_record, np.zeros(own.shape, bool)
    common = fit.problem.assemble(fit.trained)
    for record, values in params.items():
        for name, value in values.items():
            if name not in known.names:
                only = f", but {listing(known.names)}" if known.names else ""
                raise DataError(
                    f"params: '{name}' does not differ between records{only}: train with "
                    f"per_record={{'{name}': None}}."
                )
            if not is_number(value):
                raise DataError(f"params: '{name}' is {shown(value)}; give a finite number.")
            place = list(records).index(record), known.names.index(name)
            own[place] = (value - float(common[name])) / float(known.scale[place[1]])
            given[place] = True
    return own, given


def _found(own: Own, certainty: Float[np.ndarray, "N n_targets"]) -> Float[np.ndarray, "R m"]:
    """The most likely numbers of every record, by damped Gauss-Newton steps of all records side by side."""
    if not own.free.any():
        return np.asarray(own.values)
    params, known = own.problem.assemble(own.trainable), jnp.asarray(certainty)
    z = own.values
    state: Any = jax.vmap(levenberg_marquardt().init)(z)
    for _ in range(UPDATES):
        z, state = _update(own, params, known, z, state)
        if bool(state.converged.all()):
            break
    return np.asarray(state.point)


@compiled
def _update(
    own: Own,
    params: dict[str, Any],
    certainty: Float[Array, "N n_targets"],
    z: Float[Array, "R m"],
    state: Any,
) -> tuple[Float[Array, "R m"], Any]:
    problem, method, (count, m) = own.problem, levenberg_marquardt(), own.values.shape
    free = own.free.astype(z.dtype)
    information = jnp.where(own.free, own.information, 1.0)

    def each(a: Float[Array, "N n_targets ..."]) -> Float[Array, "R ..."]:
        return jax.ops.segment_sum(jnp.sum(a, axis=1), problem.records.of, count)

    def advance(
        state: Any, z: Array, gradient: Array, value: Array, hessian: Array
    ) -> tuple[Array, Any]:
        step: Any
        step, state = method.update(gradient, state, z, value=value, hessian=hessian)
        return z + step, state

    def predicted(w: Float[Array, " m"]) -> Float[Array, "N n_targets"]:
        return problem.predict(own.moved(z + w * free), params)

    y, jacobian = value_and_jacobian(predicted, jnp.zeros(m), axis=-1)
    left = problem.residuals(y) * certainty
    jacobian, off = jacobian * certainty[..., None], z - own.values
    value = 0.5 * (each(left**2) + jnp.sum(information * off**2, axis=1))
    gradient = information * off - each(jacobian * left[..., None])
    hessian = each(jacobian[..., None] * jacobian[..., None, :])
    hessian += information[:, :, None] * jnp.eye(m)
    return jax.vmap(advance)(state, z, gradient, value, hessian)


def _deviations(
    own: Own,
    values: Float[np.ndarray, "R m"],
    certainty: Float[np.ndarray, "N n_targets"],
    fit: TrainedModel,
    confidence: Confidence,
) -> Float[np.ndarray, "N n_targets"]:
    """The standard deviation of every target at every row.

    Laws and parameters have the covariance of the training. Where they were different, what is found for a record
    would be, too; so their effects are less what the record's own numbers take over.
    """
    problem, prior = own.problem, confidence.prior
    params = problem.assemble(own.trainable)
    bumped = {n: bumped_law(params[n], fit.arguments[n]) for n in problem.networks}
    root = jnp.linalg.inv(prior.root)
    jacobian = _effects(own, params, bumped, root, jnp.asarray(values))
    jacobian, noise = np.asarray(jacobian), [confidence.noise[n] for n in problem.targets]
    variance = np.full(certainty.shape, np.nan)
    for k in range(problem.records.count):
        rows = np.asarray(problem.records.of) == k
        common, alone = np.split(jacobian[rows], [len(root)], axis=-1)
        if not np.isfinite(common).all() or not np.isfinite(alone).all():
            continue
        weighted = certainty[rows][..., None] * alone
        counted = np.where(np.isfinite(own.information[k]), own.information[k], 1.0)
        covariance = np.linalg.pinv(
            np.einsum("rti,rtj->ij", weighted, weighted) + np.diag(counted), hermitian=True
        )
        taken = np.einsum("rti,rtj->ij", weighted, certainty[rows][..., None] * common)
        effect = common - alone @ (covariance @ taken)
        variance[rows] = np.sum(effect**2, axis=-1) + np.einsum(
            "rti,ij,rtj->rt", alone, covariance, alone
        )
    return np.sqrt(variance + np.square(noise))


@compiled
def _effects(
    own: Own,
    params: dict[str, Any],
    bumped: dict[str, Bumped],
    root: Float[Array, "n n"],
    values: Float[Array, "R m"],
) -> Float[Array, "N n_targets n+m"]:
    """How the targets move with laws and parameters, by one deviation of each, and with a record's own numbers."""
    scale = jnp.where(own.free | jnp.isfinite(own.information), 1.0, 0.0)

    def predicted(w: Float[Array, " n+m"]) -> Float[Array, "N n_targets"]:
        moved = with_changes(own.problem, params, bumped, root @ w[: len(root)])
        return own.problem.predict(own.moved(values + w[len(root) :] * scale), moved)

    return value_and_jacobian(predicted, jnp.zeros(len(root) + values.shape[1]), axis=-1)[1]
