"""The objective of a training: the loss of a model's predictions over sequences of its records, and penalties."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import Mesh
from jaxtyping import Array, Float, Int, PRNGKeyArray

from acausal._jax import compiled
from acausal.analysis import arguments
from acausal.codegen import Values
from acausal.simulation import inner_fractions
from acausal.training.objective.error_laws import LogLikelihood
from acausal.training.objective.initial_state import STEADY
from acausal.training.objective.losses import Loss, number
from acausal.training.objective.modifiers import Modifiers
from acausal.training.objective.parameter_spread import ParameterSpread
from acausal.training.objective.prior import Prior
from acausal.training.objective.records import Places
from acausal.training.objective.regularizers import Context, Regularizer
from acausal.training.objective.sequences import Batch, Sequences
from acausal.training.objective.sharding import shard
from acausal.training.objective.simulator import PackedRecords, Simulator
from acausal.training.objective.streamed import Streamed
from acausal.training.objective.trainable import Simulated, Trainable
from acausal.training.objective.weighting import Weighting


class Problem(Simulator):
    """A training problem. It is a pytree, and all of its functions are pure.

    Attributes, besides those of `Simulator`:
        params: all parameters where training starts.
        networks: names of the networks that are trained.
        modifiers: the parameters that are trained.
        parameter_spread: the parameters that differ from run to run.
        weighting: how much records, targets and times count.
        sequences: how batches are drawn from them.
        loss: compares a predicted with a measured sequence.
        prior: what an earlier training knew.
        regularizers: penalties by name.
        context: the arguments of regularizers besides the parameters.
        mesh: devices that share batches, if any.
        streamed: records of which only the beginnings are in memory, if that is so.
    """

    params: dict[str, Any]
    networks: tuple[str, ...] = eqx.field(static=True)
    modifiers: Modifiers
    parameter_spread: ParameterSpread
    weighting: Weighting = eqx.field(static=True)
    sequences: Sequences
    loss: Loss = eqx.field(static=True)
    prior: Prior | None
    regularizers: dict[str, Regularizer]
    context: Context
    mesh: Mesh | None = eqx.field(static=True)
    streamed: Streamed | None = eqx.field(static=True)

    # -- the data ------------------------------------------------------------------------------------

    @property
    def places(self) -> Places:
        """Where rows are that sequences start from."""
        return self.records.places if self.streamed is None else self.streamed.places

    def residuals(self, predicted: Float[Array, "N n_targets"]) -> Float[Array, "N n_targets"]:
        """The residuals of predictions of all records: measured less predicted; zero where nothing is measured."""
        records = self.records
        return jnp.where(records.weight > 0, records.y - predicted, 0.0)

    def compare(self, predicted: Float[Array, "N n_targets"]) -> Float[Array, ""]:
        """The loss of predictions of all records."""
        records = self.records
        return self.compare_some(predicted, records.y, records.weight)

    def compare_some(
        self,
        predicted: Float[Array, "M n_targets"],
        measured: Float[Array, "M n_targets"],
        weight: Float[Array, "M n_targets"],
    ) -> Float[Array, ""]:
        """The loss of predictions of some samples."""
        return number("The loss", self.loss, predicted, measured, self.records.scale, weight)

    def scaled(self, scale: Float[np.ndarray, " n_targets"]) -> Problem:
        """The same with other deviations by which the loss counts the targets; its program is that of this one."""
        return replace(self, records=replace(self.records, scale=jnp.asarray(scale)))

    @property
    def counts_as_logarithm(self) -> bool:
        """Whether the loss is a logarithm of a likelihood; others are like a root mean square."""
        return isinstance(self.loss, LogLikelihood)

    def curvature(
        self, predicted: Float[Array, "N n_targets"]
    ) -> Float[Array, "N n_targets"] | None:
        """The second derivative of the loss by each prediction, where the loss gives it."""
        if not isinstance(self.loss, LogLikelihood):
            return None
        records = self.records
        return self.loss.curvature(predicted, records.y, records.sigma, records.weight)

    # -- what is trained -----------------------------------------------------------------------------

    def start(self) -> Trainable:
        """What is trained, where training starts."""
        networks = {n: eqx.filter(self.params[n], eqx.is_inexact_array) for n in self.networks}
        states = None if self.shooting is None else jnp.zeros_like(self.shooting.start)
        own = self.per_record.start(self.records.count)
        prior = self.start_prior
        starts = None if prior is None else jnp.zeros_like(prior.scale)
        return Trainable(networks, self.modifiers.start(), own, states, starts)

    def check_rest(self) -> None:
        """Refuse records that are to start at rest where the model, as training starts, does not rest.

        Raises:
            InitializationError: for them; it names the fixed starts.
        """
        if STEADY in self.first_states.kinds:
            start = self.start()
            self.start_states(start, self.pack(self.assemble(start), start))

    def assemble(self, trainable: Trainable) -> dict[str, Any]:
        """Physical values, networks, delays and lags for some state of the training: those common to all records."""
        networks = {
            n: eqx.combine(arrays, self.params[n]) for n, arrays in trainable.networks.items()
        }
        start = {**self.params, **networks, **self.timing.values}
        return self.modifiers.apply(start, trainable.modifiers)

    def model_params(self, trainable: Trainable) -> dict[str, Any]:
        """The same without delays and lags: the parameters of the model."""
        return self.timing.split(self.assemble(trainable))[0]

    def changes(self, trainable: Trainable) -> dict[str, Float[Array, ""]]:
        """The changes of the trained parameters, each as its modifier counts them."""
        return self.modifiers.changes(trainable.modifiers)

    def unit(self, name: str) -> str:
        """The unit of something that is trained."""
        return "s" if name in self.timing.values else self.system.unit(name)

    def entry(self, best: Trainable) -> Trainable:
        """What another problem of this training has found, as a start of this one."""
        states, shooting = best.states, self.shooting
        if states is None or shooting is None or len(states) == len(shooting.parts):
            return best
        if len(states) > len(shooting.parts):
            return replace(best, states=states[shooting.parts])
        parts = jnp.zeros((len(shooting.parts), states.shape[1]), states.dtype)
        return replace(best, states=parts.at[shooting.first].set(states))

    def over_other_records(self, trainable: Trainable) -> Trainable:
        """What was trained, for these records: of others it knows neither their own parameters nor their states."""
        if self.records.known:
            return trainable
        own = self.per_record.expected(trainable.per_record, self.records.count)
        return replace(trainable, per_record=own, states=None, starts=None)

    def finer(self) -> Problem:
        """The same in steps of half the length."""
        return self.in_parts(2 * self.substeps)

    def in_parts(self, parts: int) -> Problem:
        """The same with so many steps from sample to sample."""
        fractions = inner_fractions(self.solver, parts)
        delayed = replace(self.records.delayed, fractions=fractions)
        return replace(self, records=replace(self.records, delayed=delayed), substeps=parts)

    def held_out_loss(self, trainable: Trainable) -> Float[Array, ""]:
        """The loss of these records, which were not trained on, in one simulation of each."""
        return self.simulate(self.over_other_records(trainable)).loss

    def weighed(self, loss: Float[Array, ""], trainable: Trainable) -> Float[Array, ""]:
        """The loss, and what is known without data: a loss ℓ of n samples counts as the likelihood ``ℓ^-n``.

        That is the likelihood of normal errors whose size is not known; its largest value is that of the root mean
        square. A loss that is a logarithm itself counts as ``e^-nℓ``.
        """
        if not self.per_record.names and self.prior is None and self.start_prior is None:
            return loss
        known = self.log_prior(trainable)
        if self.counts_as_logarithm:
            return loss + known
        return loss * jnp.exp(known)

    def log_prior(self, trainable: Trainable) -> Float[Array, ""]:
        """Minus the logarithm of the prior density of what is trained, for each measured sample."""
        streamed = self.streamed
        samples = jnp.sum(self.records.weight > 0) if streamed is None else streamed.samples
        known = self.per_record.log_prior(trainable.per_record)
        if self.start_prior is not None:
            known += self.start_prior.log_prior(trainable.starts)
        if self.prior is not None:
            known += self.prior.log_prior(self.assemble(trainable))
        return known / samples

    # -- losses of sequences -------------------------------------------------------------------------

    def draw(self, key: PRNGKeyArray, update: int | Int[Array, ""] = 0) -> Batch:
        """A random batch of sequences, see `Sequences.draw`."""
        batch = self.sequences.draw(key, update)
        return replace(batch, nudge=jnp.zeros((len(batch.start), len(self.system.states))))

    def losses(self, trainable: Trainable, batch: Batch) -> Float[Array, " batch"]:
        """The loss of every sequence of a batch."""
        arrays, rest = eqx.partition(self, eqx.is_array)

        def share(same: tuple[Problem, Trainable], batch: Batch) -> Float[Array, " share"]:
            arrays, trainable = same
            own: Problem = eqx.combine(arrays, rest)
            loss = partial(own._losses, trainable, batch)
            return own.parameter_spread.mean(loss, own.assemble(trainable))

        return shard(share, self.mesh, (arrays, trainable), batch)

    def _losses(
        self, trainable: Trainable, batch: Batch, params: dict[str, Any]
    ) -> Float[Array, " batch"]:
        packed = self.pack(params, trainable)
        if self.sequences.whole:
            return self._loss_of_all(packed, trainable, jax.tree.map(_first, batch))[None]
        records, shooting, sensors = self.records, self.shooting, self.sensors
        parts = None if shooting is None else self.part_states(trainable, packed)
        modes = self.discrete_starts(packed)

        def one(row: Batch) -> Float[Array, ""]:
            start, read = row.start, row.read
            window = records.window(start, self.sequences.length) if read is None else read
            if shooting is None or parts is None:
                assert window.x is not None
                x0 = window.x
            else:
                x0 = parts[shooting.part(start)]
            x0 = x0 if row.nudge is None else x0 + row.nudge
            own = self.packed_of(packed, window.of)
            steps = records.delayed(window.steps, window.of, packed.times)
            begun = None
            if modes is not None:  # those within a record begin as the model does
                usual: Any = self.system.initializer.discrete_starts(own)
                begun = jnp.where(start == records.first[window.of], modes[window.of], usual)[None]
            found = self.integrate_from(own, x0, steps, discrete=begun)
            assert found.y is not None
            seen, weight = sensors.over_window(found.y, window, records, start, packed.times)
            loss = self.compare_some(*row.compared(seen, window.y, weight))
            if shooting is None or parts is None:
                return loss
            return loss + shooting.gap(parts, shooting.part(start), found.end)

        if len(batch.start) == 1:
            return one(jax.tree.map(_first, batch))[None]
        return jax.vmap(one)(batch)

    def _loss_of_all(
        self, packed: PackedRecords, trainable: Trainable, row: Batch
    ) -> Float[Array, ""]:
        records = self.records
        found = self.integrate_all(packed, trainable, row.nudge)
        assert found.y is not None
        return self.compare_some(*row.compared(found.y, records.y, records.weight))

    def penalties(self, trainable: Trainable) -> dict[str, Float[Array, ""]]:
        """What every regularizer adds to the loss."""
        params = self.model_params(trainable)
        return {
            name: number(f"The regularizer '{name}'", r, params, self.context)
            for name, r in self.regularizers.items()
        }

    # -- all records -----------------------------------------------------------------------------------

    @compiled
    def simulate(self, trainable: Trainable) -> Simulated:
        """One simulation of every record."""
        params = self.assemble(trainable)
        found = self._all(params, trainable)

        def loss(p: dict[str, Any]) -> Float[Array, ""]:
            return self.compare((found if p is params else self._all(p, trainable)).y)

        total = self.parameter_spread.mean(loss, params)
        return found._replace(loss=total)

    def _all(self, params: dict[str, Any], trainable: Trainable) -> Simulated:
        """States and targets at every row, without a loss yet."""
        found = self.integrate_all(self.pack(params, trainable), trainable)
        assert found.y is not None
        return Simulated(jnp.zeros(()), found.x, found.y, found.log, found.d)

    @compiled
    def seen(
        self,
        trainable: Trainable,
        x: Float[Array, "N n_states"],
        d: Float[Array, "N n_discrete"] | None,
        rows: Int[Array, " n_rows"] | None = None,
    ) -> dict[str, Float[Array, "n_calls n_arguments"]]:
        """The arguments of every network in some states.

        Arguments:
            trainable: some state of the training.
            x, d: states and discrete variables at every row.
            rows: indices of rows; ``None`` for all.

        The calls of a network with several places in the model follow each other row by row. Those at events
        have what they would have at every row.
        """
        packed = self.pack(self.assemble(trainable), trainable)
        steps, of = self.steps(packed, rows), self.records.of
        if rows is not None:
            x, d, of = jax.tree.map(lambda a: a[rows], (x, d, of))
        points = (steps.t, x, steps.inputs.start, d, of)

        def at(name: str) -> Float[Array, "n_calls n_arguments"]:
            def one(t: Array, x: Array, u: Array, d: Array | None, record: Array) -> Array:
                own = self.packed_of(packed, record)
                return arguments(self.system, name, Values(t, x, u, own, d))

            values = jax.vmap(one)(*points)
            return values.reshape(-1, values.shape[-1])

        return {name: at(name) for name in self.networks}

    def predict(self, trainable: Trainable, params: dict[str, Any]) -> Float[Array, "N n_targets"]:
        """The targets at every row of one simulation with other parameters; ``trainable`` gives what differs by record.

        It can be differentiated in forward mode.
        """
        return replace(self, direct=True)._all(params, trainable).y

    def predictions(self, trainable: Trainable) -> Float[Array, "n_models N n_targets"]:
        """The same of every model of the parameter spread."""
        params = self.assemble(trainable)
        return self.parameter_spread.over_models(lambda p: self.predict(trainable, p), params)


def _first(rows: Array) -> Array:
    return rows[0]
