"""Simulation of records: a model from every record's start, with the record's inputs, parameters and sensors."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from acausal._jax import Restarts, cast
from acausal.codegen import Packed, Values
from acausal.simulation import (
    Adaptive,
    Integrated,
    Runs,
    Scheme,
    Steps,
    integrate,
    integrate_in_steps,
)
from acausal.training.objective.initial_state import FIT, FirstStates
from acausal.training.objective.multiple_shooting import ShootingStates
from acausal.training.objective.per_record import PerRecord, for_records
from acausal.training.objective.records import Records
from acausal.training.objective.sensors import Sensors
from acausal.training.objective.start_prior import StartPrior
from acausal.training.objective.timing import Timing
from acausal.training.objective.trainable import Trainable

if TYPE_CHECKING:
    from acausal.system import System


class PackedRecords(NamedTuple):
    """Parameters as the model's program reads them.

    Attributes:
        common: those of all records.
        own: of every record, the numbers in `PerRecord.places`; ``None`` where records do not differ.
        times: delays and lags, by name.
    """

    common: Packed
    own: Float[Array, "R n_places"] | None
    times: dict[str, Float[Array, ""]]


class Simulator(eqx.Module):
    """Simulates records with some state of a training. It is a pytree, and its functions are pure.

    Attributes:
        system: the model.
        targets: the variables that are compared.
        per_record: the parameters that have a value for each record.
        timing: delays and lags; those that are trained are among ``modifiers``.
        records: the data.
        first_states: the states at which records start, where they are not trained.
        start_prior: what is known of those that the training finds within that; ``None`` where all are known.
        shooting: the states at which sequences begin, where they are trained, too.
        solver, substeps: the scheme, and the number of its steps from sample to sample; or adaptive steps.
        dtype: the precision of steps; of weights and losses it is double.
        tries: steps and searches for events that a row may take on average before a simulation counts as diverged;
            ``None``: as many as it takes.
        direct: whether derivatives in forward mode must work, too.
    """

    system: System = eqx.field(static=True)
    targets: tuple[str, ...] = eqx.field(static=True)
    per_record: PerRecord
    timing: Timing
    records: Records
    first_states: FirstStates
    start_prior: StartPrior | None
    shooting: ShootingStates | None
    solver: Scheme | Adaptive = eqx.field(static=True)
    substeps: int = eqx.field(static=True)
    dtype: np.dtype = eqx.field(static=True)
    tries: int | None = eqx.field(static=True, default=None, kw_only=True)
    direct: bool = eqx.field(static=True, default=False, kw_only=True)

    @property
    def longest_step(self) -> float:
        """The longest step of the integration, in seconds."""
        return float(np.max(np.asarray(self.records.steps.h))) / self.substeps

    @property
    def inputs(self) -> Float[Array, "N n_inputs"]:
        """The model's inputs at every row, as they are measured."""
        return self.records.steps.inputs.start

    def steps(self, packed: PackedRecords, rows: Int[Array, " n"] | None = None) -> Steps:
        """The steps of all records, or of some rows, with inputs delayed."""
        steps, of = self.records.steps, self.records.of
        if rows is not None:
            steps, of = jax.tree.map(lambda a: a[rows] if a.ndim else a, (steps, of))
        return self.records.delayed(steps, of, packed.times)

    @property
    def sensors(self) -> Sensors:
        """What the targets' sensors do."""
        return Sensors.of(self.timing, self.targets)

    def pack(self, params: dict[str, Any], trainable: Trainable) -> PackedRecords:
        """Parameters as the model's program reads them."""
        params, times = self.timing.split(params)
        own = self.per_record.packed(self.system, params, trainable.per_record)
        return PackedRecords(self.system.pack(params), own, times)

    def start_states(
        self, trainable: Trainable, packed: PackedRecords
    ) -> Float[Array, "R n_states"]:
        """The states at which records start."""
        first = self.steps(packed, self.records.first)
        by_record = self._by_record(packed)
        states = self.first_states(self.system, by_record, first.t, first.inputs.start)
        if self.start_prior is not None:
            states = self.start_prior.moved(states, trainable.starts)
        if self.shooting is None:
            return states
        trained = self.shooting.of_first(trainable.states)
        return jnp.where((self.first_states.kind == FIT)[:, None], trained, states)

    def discrete_starts(self, packed: PackedRecords) -> Float[Array, "R n_discrete"] | None:
        """What discrete variables begin with in each record; None if all begin as the model starts."""
        return self.first_states.discrete_starts(self.system, self._by_record(packed))

    def _by_record(self, packed: PackedRecords) -> Packed:
        """Parameters with a row for each record."""
        return for_records(packed.common, self.per_record.places, packed.own, self.records.count)

    def part_states(
        self, trainable: Trainable, packed: PackedRecords
    ) -> Float[Array, "n_parts n_states"]:
        """The states at which the parts of records begin."""
        assert self.shooting is not None
        states = self.shooting.states(trainable.states)
        return states.at[self.shooting.first].set(self.start_states(trainable, packed))

    def packed_of(self, packed: PackedRecords, record: Int[Array, ""]) -> Packed:
        """The parameters of a record."""
        if packed.own is None:
            return packed.common
        return packed.common.replaced(self.per_record.places, packed.own[record])

    def integrate_all(
        self,
        packed: PackedRecords,
        trainable: Trainable,
        nudge: Float[Array, " n_states"] | None = None,
    ) -> Integrated:
        """States and targets at every row of all records, in one loop."""
        records = self.records
        x0 = self.start_states(trainable, packed)
        x0 = x0 if nudge is None else x0 + nudge
        own, steps = packed.own, self.steps(packed)
        discrete = self.discrete_starts(packed)
        if records.count == 1:
            one = self.packed_of(packed, jnp.asarray(0))
            found = self.integrate_from(one, x0[0], steps, discrete=discrete)
            return self._measured(found, packed)
        first = jnp.zeros((len(records), x0.shape[1]), x0.dtype).at[records.first].set(x0)
        runs = Runs(
            Restarts(records.begins, first),
            None if own is None else own[records.of],
            self.per_record.places,
            records.count,
        )
        found = self.integrate_from(packed.common, x0[0], steps, runs, discrete)
        return self._measured(found, packed)

    def _measured(self, found: Integrated, packed: PackedRecords) -> Integrated:
        """The same with targets as their sensors show them."""
        assert found.y is not None
        return found._replace(y=self.sensors.over_records(found.y, self.records, packed.times))

    def integrate_from(
        self,
        packed: Packed,
        x0: Float[Array, " n_states"],
        steps: Steps,
        runs: Runs | None = None,
        discrete: Float[Array, "R n_discrete"] | None = None,
    ) -> Integrated:
        """States and targets at every step, and the state at the end; discrete variables begin as of each run."""
        packed, x0, steps, runs = cast((packed, x0, steps, runs), self.dtype)
        first: Any = steps.t[0]
        start = Values(first, x0, steps.inputs.start[0], packed)
        in_steps = self.system.events is not None or isinstance(self.solver, Adaptive)
        over: Any = integrate
        if in_steps:
            over = partial(integrate_in_steps, tries=self.tries, discrete=discrete)
        found = over(
            self.system,
            start,
            steps,
            self.solver,
            substeps=self.substeps,
            outputs=self.targets,
            direct=self.direct,
            runs=runs,
        )
        return cast(found, float)
