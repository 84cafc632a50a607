"""Sharding: the sequences of a batch on several devices, of one machine or of many.

Every process runs the same program. Data and weights are on all devices; each device computes its share of the batch,
and their gradients are summed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.experimental import multihost_utils
from jax.sharding import Mesh, NamedSharding, PartitionSpec
from jaxtyping import Array, Float, PyTree, Shaped

from acausal.errors import TrainingError, shown

Tree = TypeVar("Tree")
Same = TypeVar("Same")
Rows = TypeVar("Rows")
Device = Any
"""A `jax.Device`, which type checkers do not accept as a type."""

SEQUENCES = "sequences"
ALL, SHARE = PartitionSpec(), PartitionSpec(SEQUENCES)


def device_mesh(devices: Sequence[Device] | None, batch_size: int) -> Mesh | None:
    """The devices in a row; ``None`` where JAX's default device does everything.

    Raises:
        TrainingError: if they cannot have equal shares of a batch.
    """
    if devices is None:
        return None
    if isinstance(devices, str) or not all(hasattr(d, "platform") for d in devices):
        raise TrainingError(
            f"devices={shown(devices)} are not JAX devices; give some of jax.devices()."
        )
    if not len(devices) or batch_size % len(devices):
        raise TrainingError(
            f"A batch of {batch_size} has no equal shares for {len(devices)} devices; "
            "let batch_size be a multiple of them."
        )
    if len(set(devices)) < len(devices):
        raise TrainingError(f"devices={shown(devices)} name one twice; give each once.")
    return Mesh(np.asarray(devices), (SEQUENCES,))


def replicate(tree: Tree, mesh: Mesh | None) -> Tree:
    """The tree with its arrays on all devices."""
    if mesh is None:
        return tree
    everywhere = NamedSharding(mesh, ALL)

    def put(array: Shaped[Array, " ..."]) -> Shaped[Array, " ..."]:
        if jnp.issubdtype(array.dtype, jax.dtypes.prng_key):
            data, kind = jax.random.key_data(array), jax.random.key_impl(array)
            return jax.random.wrap_key_data(put(data), impl=kind)
        return jax.device_put(np.asarray(array), everywhere)  # processes may share no jax.Array

    return jax.tree.map(lambda a: put(a) if eqx.is_array(a) else a, tree)


def on_default_device(tree: Tree, mesh: Mesh | None) -> Tree:
    """The tree with its arrays on the default device, for use in this process alone."""
    if mesh is None:
        return tree
    return jax.tree.map(lambda a: jnp.asarray(np.asarray(a)) if eqx.is_array(a) else a, tree)


def shard(
    function: Callable[[Same, Rows], Float[Array, " batch"]],
    mesh: Mesh | None,
    same: Same,
    rows: Rows,
) -> Float[Array, " batch"]:
    """The rows of a function (same, rows) -> results, of which each device computes its share; all get all rows.

    All devices have the arrays of ``same``; those of ``rows`` have a leading axis of the batch.
    """
    if mesh is None:
        return function(same, rows)
    sharded: Callable[[PyTree, PyTree], Array] = jax.shard_map(
        function, mesh=mesh, in_specs=(ALL, SHARE), out_specs=SHARE, check_vma=False
    )
    return jax.lax.with_sharding_constraint(sharded(same, rows), NamedSharding(mesh, ALL))


def of_first_process(value: float, mesh: Mesh | None) -> float:
    """A number in which processes may differ, as the first process has it."""
    if mesh is None or len({d.process_index for d in mesh.devices.flat}) == 1:
        return value
    return float(multihost_utils.broadcast_one_to_all(np.asarray(value)))
