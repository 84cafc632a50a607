"""The objective of a training: the loss of a model's predictions over sequences of its records, and penalties.

A training has records; today there is one. Only this room indexes them; other files use the problem's methods.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import Mesh
from jaxtyping import Array, Float, Int, PRNGKeyArray

from acausal._jax import cast
from acausal.codegen import Packed, Values
from acausal.simulation import Solver, Steps, integrate
from acausal.training.objective.arguments import arguments
from acausal.training.objective.losses import Loss, number
from acausal.training.objective.modifiers import Modifiers
from acausal.training.objective.multiple_shooting import ShootingStates
from acausal.training.objective.parameter_spread import ParameterSpread
from acausal.training.objective.record import Batch, Record, Sequences
from acausal.training.objective.regularizers import Context, Regularizer
from acausal.training.objective.sharding import shard
from acausal.training.objective.trainable import Simulated, Trainable

if TYPE_CHECKING:
    from acausal.system import System


class Problem(eqx.Module):
    """A training problem. It is a pytree, and all of its functions are pure.

    Attributes:
        system: the model.
        params: all parameters where training starts.
        networks: names of the networks that are trained.
        modifiers: the parameters that are trained.
        parameter_spread: the parameters that differ from run to run.
        targets: the variables that are compared.
        records: the data.
        sequences: how batches are drawn from them.
        x0: the state at the record's start, or ``None`` for the model's start values.
        shooting: the states at which sequences begin, where they are trained, too.
        loss: compares a predicted with a measured sequence.
        regularizers: penalties by name.
        context: the arguments of regularizers besides the parameters.
        solver, substeps: the scheme, and the number of its steps from sample to sample.
        dtype: the precision of steps; of weights and losses it is double.
        mesh: devices that share batches, if any.
    """

    system: System = eqx.field(static=True)
    params: dict[str, Any]
    networks: tuple[str, ...] = eqx.field(static=True)
    modifiers: Modifiers
    parameter_spread: ParameterSpread
    targets: tuple[str, ...] = eqx.field(static=True)
    records: tuple[Record, ...]
    sequences: Sequences
    x0: Float[Array, " n_states"] | None
    shooting: ShootingStates | None
    loss: Loss = eqx.field(static=True)
    regularizers: dict[str, Regularizer]
    context: Context
    solver: Solver = eqx.field(static=True)
    substeps: int = eqx.field(static=True)
    dtype: np.dtype = eqx.field(static=True)
    mesh: Mesh | None = eqx.field(static=True)

    # -- the data ------------------------------------------------------------------------------------

    @property
    def _record(self) -> Record:
        """The one record. To support several, start here."""
        (record,) = self.records
        return record

    @property
    def samples(self) -> int:
        """How many samples are trained on."""
        return len(self._record)

    @property
    def times(self) -> Float[Array, " n_samples"]:
        """The time of every sample, in seconds."""
        return self._record.steps.t

    @property
    def inputs(self) -> Float[Array, "n_samples n_inputs"]:
        """The model's inputs at every sample."""
        return self._record.steps.inputs.start

    @property
    def measured(self) -> Float[Array, "n_samples n_targets"]:
        """The measured targets at every sample."""
        return self._record.y

    @property
    def measured_states(self) -> Float[Array, "n_samples n_states"] | None:
        """The measured states at every sample; ``None`` unless all of them are measured."""
        return self._record.x

    @property
    def sigma(self) -> Float[Array, " n_targets"]:
        """The standard deviations of the measured targets."""
        return self._record.sigma

    @property
    def is_uniform(self) -> bool:
        """Whether samples are evenly spaced."""
        return self._record.steps.h.ndim == 0

    @property
    def longest_step(self) -> float:
        """The longest step of the integration, in seconds."""
        return float(np.max(np.asarray(self._record.steps.h))) / self.substeps

    def residuals(
        self, predicted: Float[Array, "n_samples n_targets"]
    ) -> Float[Array, "n_samples n_targets"]:
        """The residuals of predictions of the whole record: measured less predicted."""
        return self.measured - predicted

    def compare(
        self, predicted: Float[Array, "n_samples n_targets"], rows: slice = slice(None)
    ) -> Float[Array, ""]:
        """The loss of predictions of the whole record, over some of its samples."""
        return number("The loss", self.loss, predicted[rows], self.measured[rows], self.sigma)

    # -- what is trained -----------------------------------------------------------------------------

    def start(self) -> Trainable:
        """What is trained, where training starts."""
        networks = {n: eqx.filter(self.params[n], eqx.is_inexact_array) for n in self.networks}
        states = None if self.shooting is None else jnp.zeros_like(self.shooting.start)
        return Trainable(networks, self.modifiers.start(), states)

    def assemble(self, trainable: Trainable) -> dict[str, Any]:
        """The model's parameters, with physical values, for some state of the training."""
        networks = {
            n: eqx.combine(arrays, self.params[n]) for n, arrays in trainable.networks.items()
        }
        return self.modifiers.apply({**self.params, **networks}, trainable.modifiers)

    # -- losses of sequences -------------------------------------------------------------------------

    def draw(self, key: PRNGKeyArray) -> Batch:
        """A random batch of sequences."""
        batch = self.sequences.draw(key)
        return batch.nudged(jnp.zeros((len(batch.start), len(self.system.states))))

    def losses(self, trainable: Trainable, batch: Batch) -> Float[Array, " batch"]:
        """The loss of every sequence of a batch."""
        arrays, rest = eqx.partition(self, eqx.is_array)

        def share(same: tuple[Problem, Trainable], rows: Any) -> Float[Array, " share"]:
            arrays, trainable = same
            return eqx.combine(arrays, rest)._losses(trainable, *rows)

        return shard(
            share, self.mesh, (arrays, trainable), (batch.start, batch.points, batch.nudge)
        )

    def _losses(
        self,
        trainable: Trainable,
        starts: Int[Array, " batch"],
        points: Int[Array, "batch n_points"] | None,
        nudges: Float[Array, "batch n_states"] | None,
    ) -> Float[Array, " batch"]:
        params = self.assemble(trainable)
        return self.parameter_spread.mean(
            lambda p: self._losses_with(p, trainable, starts, points, nudges), params
        )

    def _losses_with(
        self,
        params: dict[str, Any],
        trainable: Trainable,
        starts: Int[Array, " batch"],
        points: Int[Array, "batch n_points"] | None,
        nudges: Float[Array, "batch n_states"] | None,
    ) -> Float[Array, " batch"]:
        packed = self.system.pack(params)

        def one(
            start: Int[Array, ""],
            points: Int[Array, " n_points"] | None,
            nudge: Float[Array, " n_states"] | None,
        ) -> Float[Array, ""]:
            steps, measured = self._record.window(start, self.sequences.length)
            x0 = self._start_of(trainable, packed, start)
            x0 = x0 if nudge is None else x0 + nudge
            _, predicted, end = self._integrate(packed, x0, steps)
            if points is not None:
                predicted, measured = predicted[points], measured[points]
            loss = number("The loss", self.loss, predicted, measured, self.sigma)
            if self.shooting is None:
                return loss
            return loss + self.shooting.gap(trainable.states, start // self.shooting.length, end)

        if starts.shape[0] == 1:
            first = jax.tree.map(lambda a: a[0], (starts, points, nudges))
            return one(*first)[None]
        return jax.vmap(one)(starts, points, nudges)

    def penalties(self, trainable: Trainable) -> dict[str, Float[Array, ""]]:
        """What every regularizer adds to the loss."""
        params = self.assemble(trainable)
        return {
            name: number(f"The regularizer '{name}'", r, params, self.context)
            for name, r in self.regularizers.items()
        }

    # -- the whole record ----------------------------------------------------------------------------

    @eqx.filter_jit
    def simulate(self, trainable: Trainable) -> Simulated:
        """One simulation of the whole record."""
        params = self.assemble(trainable)
        x, predicted = self._whole(params, trainable)

        def loss(p: dict[str, Any]) -> Float[Array, ""]:
            y = predicted if p is params else self._whole(p, trainable)[1]
            return self.compare(y)

        return Simulated(self.parameter_spread.mean(loss, params), x, predicted)

    def _whole(
        self, params: dict[str, Any], trainable: Trainable
    ) -> tuple[Float[Array, "n_samples n_states"], Float[Array, "n_samples n_targets"]]:
        """States and targets at every sample."""
        packed = self.system.pack(params)
        return self._integrate(packed, self.first_state(trainable, packed), self._record.steps)[:2]

    @eqx.filter_jit
    def seen(
        self,
        trainable: Trainable,
        x: Float[Array, "n_samples n_states"],
        rows: Int[Array, " n_rows"] | None = None,
    ) -> dict[str, Float[Array, "n_calls n_arguments"]]:
        """The arguments of every network in the states ``x`` of the record.

        Arguments:
            trainable: some state of the training.
            x: states at every sample.
            rows: indices of samples; ``None`` for all.

        The calls of a network with several places in the model follow each other sample by sample.
        """
        packed = self.system.pack(self.assemble(trainable))
        points = (self.times, x, self.inputs)
        if rows is not None:
            points = jax.tree.map(lambda a: a[rows], points)

        def at(name: str) -> Float[Array, "n_calls n_arguments"]:
            def one(t: Array, x: Array, u: Array) -> Array:
                return arguments(self.system, name, Values(t, x, u, packed))

            values = jax.vmap(one)(*points)
            return values.reshape(-1, values.shape[-1])

        return {name: at(name) for name in self.networks}

    def predict(
        self, trainable: Trainable, params: dict[str, Any]
    ) -> Float[Array, "n_samples n_targets"]:
        """The targets at every sample of one simulation with other parameters.

        It can be differentiated in forward mode.

        Arguments:
            trainable: gives the state at the start, where that is trained.
            params: physical values and networks.
        """
        packed = self.system.pack(params)
        x0 = self.first_state(trainable, packed)
        return self._integrate(packed, x0, self._record.steps, direct=True)[1]

    def predictions(self, trainable: Trainable) -> Float[Array, "n_models n_samples n_targets"]:
        """The same of every model of the parameter spread."""
        params = self.assemble(trainable)
        return self.parameter_spread.over_models(lambda p: self.predict(trainable, p), params)

    # -- simulation ----------------------------------------------------------------------------------

    def first_state(self, trainable: Trainable, packed: Packed) -> Float[Array, " n_states"]:
        """The state at the record's start."""
        if self.shooting is not None:
            return self.shooting.state(trainable.states, 0)
        if self.x0 is not None:
            return self.x0
        t0: Any = self.times[0]
        return self.system.initial_state(packed, None, self.inputs[0], t0)

    def _start_of(
        self, trainable: Trainable, packed: Packed, start: Int[Array, ""]
    ) -> Float[Array, " n_states"]:
        """The state at which the sequence begins that starts at a sample."""
        if self.sequences.whole:
            return self.first_state(trainable, packed)
        if self.shooting is not None:
            return self.shooting.state(trainable.states, start // self.shooting.length)
        assert self.measured_states is not None
        return self.measured_states[start]

    def _integrate(
        self, packed: Packed, x0: Float[Array, " n_states"], steps: Steps, *, direct: bool = False
    ) -> tuple[
        Float[Array, "n_samples n_states"],
        Float[Array, "n_samples n_targets"],
        Float[Array, " n_states"],
    ]:
        """States and targets at every sample, and the state at the end."""
        packed, x0, steps = cast((packed, x0, steps), self.dtype)
        first: Any = steps.t[0]
        x, predicted, end = integrate(
            self.system,
            Values(first, x0, steps.inputs.start[0], packed),
            steps,
            self.solver,
            outputs=self.targets,
            substeps=self.substeps,
            direct=direct,
        )
        assert predicted is not None
        return cast((x, predicted, end), float)
