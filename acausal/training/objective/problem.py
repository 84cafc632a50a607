"""What training minimises: the loss of a model's predictions over sequences of a record, and penalties."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array
from jax.sharding import Mesh

from acausal._jax import cast
from acausal.codegen import Values
from acausal.simulation import Solver, integrate
from acausal.training.objective.arguments import arguments
from acausal.training.objective.losses import Loss
from acausal.training.objective.modifiers import Modifiers
from acausal.training.objective.multiple_shooting import Nodes
from acausal.training.objective.parameter_spread import Tolerances
from acausal.training.objective.record import Batch, Record, Sequences
from acausal.training.objective.regularizers import Context, Regularizer
from acausal.training.objective.sharding import spread

if TYPE_CHECKING:
    from acausal.system import System


class Trainable(eqx.Module):
    """What an optimizer moves: a pytree of floating-point arrays.

    Attributes:
        networks: the arrays of every network that is trained, by name.
        modifiers: the free variable δ of every parameter that is trained, by name.
        states: where sequences begin, in the units of `Nodes`, shape (parts, number of states); ``None`` where
            that is not trained.
    """

    networks: dict[str, Any]
    modifiers: dict[str, Array]
    states: Array | None = None


class Simulated(NamedTuple):
    """One simulation of the whole record.

    Attributes:
        loss: over every point of it.
        x: the states at every sample, shape (N, number of states).
        y: the targets at every sample, shape (N, number of targets).
    """

    loss: Array
    x: Array
    y: Array


class Problem(eqx.Module):
    """A training problem. It is a pytree, and all of its functions are pure.

    Attributes:
        system: the model.
        params: all parameters where training starts.
        networks: names of the networks that are trained.
        modifiers: the parameters that are trained.
        tolerances: the parameters that differ from run to run.
        targets: the variables that are compared.
        record: the data.
        sequences: how batches are drawn from it.
        x0: the state at the record's start, shape (number of states,), or ``None`` for the model's start values.
        nodes: the states at which sequences begin, where they are trained, too.
        loss: compares a predicted with a measured sequence.
        regularizers: penalties by name.
        context: what regularizers may know.
        solver, substeps: how a step from sample to sample is made.
        dtype: the precision of steps; of weights and losses it is double.
        mesh: devices that batches are spread over, if any.
    """

    system: System = eqx.field(static=True)
    params: dict[str, Any]
    networks: tuple[str, ...] = eqx.field(static=True)
    modifiers: Modifiers
    tolerances: Tolerances
    targets: tuple[str, ...] = eqx.field(static=True)
    record: Record
    sequences: Sequences
    x0: Array | None
    nodes: Nodes | None
    loss: Loss = eqx.field(static=True)
    regularizers: dict[str, Regularizer]
    context: Context
    solver: Solver = eqx.field(static=True)
    substeps: int = eqx.field(static=True)
    dtype: Any = eqx.field(static=True)
    mesh: Mesh | None = eqx.field(static=True)

    def start(self) -> Trainable:
        """What is trained, where training starts."""
        networks = {n: eqx.filter(self.params[n], eqx.is_inexact_array) for n in self.networks}
        states = None if self.nodes is None else jnp.zeros_like(self.nodes.start)
        return Trainable(networks, self.modifiers.start(), states)

    def assemble(self, trainable: Trainable) -> dict[str, Any]:
        """The model's parameters, with physical values, for some state of the training."""
        networks = {
            n: eqx.combine(arrays, self.params[n]) for n, arrays in trainable.networks.items()
        }
        return self.modifiers.apply({**self.params, **networks}, trainable.modifiers)

    def draw(self, key: Array) -> Batch:
        """A random batch of sequences."""
        return self.sequences.draw(key)

    def losses(self, trainable: Trainable, batch: Batch) -> Array:
        """The loss of every sequence of a batch, shape (B,)."""
        arrays, rest = eqx.partition(self, eqx.is_array)

        def share(same: tuple[Problem, Trainable], rows: Any) -> Array:
            arrays, trainable = same
            return eqx.combine(arrays, rest)._losses(trainable, *rows)

        return spread(share, self.mesh, (arrays, trainable), (batch.start, batch.points))

    def _losses(self, trainable: Trainable, starts: Array, points: Array | None) -> Array:
        params = self.assemble(trainable)
        return self.tolerances.mean(
            lambda p: self._losses_with(p, trainable, starts, points), params
        )

    def _losses_with(
        self, params: dict[str, Any], trainable: Trainable, starts: Array, points: Array | None
    ) -> Array:
        packed = self.system.pack(params)

        def one(start: Array, points: Array | None) -> Array:
            steps, measured = self.record.window(start, self.sequences.length)
            x0 = self._start_of(trainable, packed, start)
            _, predicted, end = self._integrate(packed, x0, steps)
            if points is not None:
                predicted, measured = predicted[points], measured[points]
            loss = self.loss(predicted, measured, self.record.sigma)
            if self.nodes is None:
                return loss
            return loss + self.nodes.gap(trainable.states, start // self.nodes.length, end)

        if starts.shape[0] == 1:
            first = jax.tree.map(lambda a: a[0], (starts, points))
            return one(*first)[None]
        return jax.vmap(one)(starts, points)

    def penalties(self, trainable: Trainable) -> dict[str, Array]:
        """What every regularizer adds to the loss."""
        params = self.assemble(trainable)
        return {name: jnp.asarray(r(params, self.context)) for name, r in self.regularizers.items()}

    @eqx.filter_jit
    def simulate(self, trainable: Trainable) -> Simulated:
        """One simulation of the whole record."""
        params = self.assemble(trainable)
        x, predicted = self._whole(params, trainable)

        def loss(p: dict[str, Any]) -> Array:
            y = predicted if p is params else self._whole(p, trainable)[1]
            return self.compare(y)

        return Simulated(self.tolerances.mean(loss, params), x, predicted)

    def _whole(self, params: dict[str, Any], trainable: Trainable) -> tuple[Array, Array]:
        """States and targets at every sample."""
        packed = self.system.pack(params)
        return self._integrate(packed, self.first_state(trainable, packed), self.record.steps)[:2]

    @eqx.filter_jit
    def seen(self, trainable: Trainable, x: Array, rows: Array | None = None) -> dict[str, Array]:
        """What every network is called with in the states ``x`` of the record, shape (N, number of arguments).

        Arguments:
            trainable: some state of the training.
            x: states at every sample, shape (N, number of states).
            rows: indices of samples; ``None`` for all.

        A network with several places in the model is taken in all of them, one after the other.
        """
        packed = self.system.pack(self.assemble(trainable))
        steps = self.record.steps
        points = (steps.t, x, steps.inputs.start)
        if rows is not None:
            points = jax.tree.map(lambda a: a[rows], points)

        def at(name: str) -> Array:
            def one(t: Array, x: Array, u: Array) -> Array:
                return arguments(self.system, name, t, x, u, packed)

            values = jax.vmap(one)(*points)
            return values.reshape(-1, values.shape[-1])

        return {name: at(name) for name in self.networks}

    def predict(self, trainable: Trainable, params: dict[str, Any]) -> Array:
        """The targets at every sample of one simulation with other parameters, shape (N, number of targets).

        It can be differentiated in forward mode.

        Arguments:
            trainable: gives the state at the start, where that is trained.
            params: physical values and networks.
        """
        packed = self.system.pack(params)
        x0 = self.first_state(trainable, packed)
        return self._integrate(packed, x0, self.record.steps, direct=True)[1]

    def predictions(self, trainable: Trainable) -> Array:
        """The same of every model that tolerances ask for, shape (models, N, number of targets)."""
        params = self.assemble(trainable)
        return self.tolerances.each(lambda p: self.predict(trainable, p), params)

    def compare(self, predicted: Array) -> Array:
        """The loss of predictions of the whole record, shape (N, number of targets)."""
        return self.loss(predicted, self.record.y, self.record.sigma)

    def first_state(self, trainable: Trainable, packed: Any) -> Array:
        """The state at the record's start, shape (number of states,)."""
        if self.nodes is not None:
            return self.nodes.state(trainable.states, 0)
        if self.x0 is not None:
            return self.x0
        steps = self.record.steps
        t0: Any = steps.t[0]
        return self.system.initial_state(packed, None, steps.inputs.start[0], t0)

    def _start_of(self, trainable: Trainable, packed: Any, start: Array) -> Array:
        """The state at which the sequence from a sample on begins."""
        if self.sequences.whole:
            return self.first_state(trainable, packed)
        if self.nodes is not None:
            return self.nodes.state(trainable.states, start // self.nodes.length)
        assert self.record.x is not None
        return self.record.x[start]

    def _integrate(
        self, packed: Any, x0: Array, steps: Any, *, direct: bool = False
    ) -> tuple[Array, Array, Array]:
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


def modified(objective: Any, trainable: Trainable) -> Mapping[str, Array]:
    """The changes of the parameters that are trained, each as its modifier counts them."""
    return objective.modifiers.changes(trainable.modifiers)
