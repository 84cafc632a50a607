"""Spread: the sequences of a batch on several devices, of one machine or of many.

Every process runs the same program. Data and weights lie on all devices; each computes its share of the batch, and
their gradients are summed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array
from jax.experimental import multihost_utils
from jax.sharding import Mesh, NamedSharding, PartitionSpec

from acausal.errors import TrainingError

Tree = TypeVar("Tree")
Device = Any
"""A `jax.Device`, which type checkers do not take for a type."""

SEQUENCES = "sequences"
ALL, SHARE = PartitionSpec(), PartitionSpec(SEQUENCES)


def mesh(devices: Sequence[Device] | None, batch_size: int) -> Mesh | None:
    """Devices in a row; none where all is left to JAX's default device.

    Raises:
        TrainingError: if they cannot have equal shares of a batch.
    """
    if devices is None:
        return None
    if not len(devices) or batch_size % len(devices):
        raise TrainingError(
            f"A batch of {batch_size} has no equal shares for {len(devices)} devices; "
            "let batch_size be a multiple of them."
        )
    return Mesh(np.asarray(devices), (SEQUENCES,))


def shared(tree: Tree, mesh: Mesh | None) -> Tree:
    """The tree with its arrays on all devices."""
    if mesh is None:
        return tree
    everywhere = NamedSharding(mesh, ALL)

    def put(array: Array) -> Array:
        if jnp.issubdtype(array.dtype, jax.dtypes.prng_key):
            data, kind = jax.random.key_data(array), jax.random.key_impl(array)
            return jax.random.wrap_key_data(put(data), impl=kind)
        return jax.device_put(np.asarray(array), everywhere)  # processes may share no jax.Array

    return jax.tree.map(lambda a: put(a) if eqx.is_array(a) else a, tree)


def local(tree: Tree, mesh: Mesh | None) -> Tree:
    """The tree with its arrays on the default device, for use in this process alone."""
    if mesh is None:
        return tree
    return jax.tree.map(lambda a: jnp.asarray(np.asarray(a)) if eqx.is_array(a) else a, tree)


def spread(function: Callable[[Any, Any], Array], mesh: Mesh | None, same: Any, rows: Any) -> Array:
    """The function's rows, each device computing its share; all devices get all of them.

    Arguments:
        function: (same, rows) -> results, shape (B,).
        mesh: the devices.
        same: arrays that all devices have.
        rows: arrays with a leading axis of B.
    """
    if mesh is None:
        return function(same, rows)
    parted = jax.shard_map(
        function, mesh=mesh, in_specs=(ALL, SHARE), out_specs=SHARE, check_vma=False
    )
    return jax.lax.with_sharding_constraint(parted(same, rows), NamedSharding(mesh, ALL))


def agreed(value: float, mesh: Mesh | None) -> float:
    """A number in which processes may differ, as the first process has it."""
    if mesh is None or len({d.process_index for d in mesh.devices.flat}) == 1:
        return value
    return float(multihost_utils.broadcast_one_to_all(np.asarray(value)))
