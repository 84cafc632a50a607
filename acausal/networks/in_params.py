"""The networks among a model's parameters, and their correction after training."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, TypeGuard

import equinox as eqx
import jax
from jaxtyping import Array

from acausal.data import Signal
from acausal.errors import DataError
from acausal.modeling import names_in
from acausal.networks.energy_parts import Levelled
from acausal.networks.law_parts import OffsetCorrected
from acausal.networks.scaled import EnergyLaw


def networks(params: Mapping[str, Any]) -> dict[str, eqx.Module]:
    """The modules that can be trained: those with floating-point arrays other than a time base or table."""
    return {name: leaf for name, leaf in params.items() if _trainable(leaf)}


def _trainable(module: Any) -> TypeGuard[eqx.Module]:
    if not isinstance(module, eqx.Module) or isinstance(module, Signal):
        return False
    return bool(jax.tree.leaves(eqx.filter(module, eqx.is_inexact_array)))


def remove_offset(
    params: Mapping[str, Any], names: tuple[str, ...] | None = None
) -> dict[str, Any]:
    """The parameters with networks wrapped in `OffsetCorrected` (all networks, or those named).

    For an energy the derivative at zero is removed, which is the offset of its law.
    """
    if not isinstance(params, Mapping):
        raise DataError(f"remove_offset needs a model's parameters, got {type(params).__name__}")
    chosen = networks(params) if names is None else names_in(names, "remove_offset: names")
    return {n: _corrected(leaf) if n in chosen else leaf for n, leaf in params.items()}


def _corrected(network: Callable[..., Array]) -> eqx.Module:
    if isinstance(network, EnergyLaw):
        return replace(network, net=Levelled(network.net, network.inputs))
    return OffsetCorrected(network)


def output_scale(module: object) -> float:
    """The typical output of a network's law: its ``output_scale`` if it has one, else 1."""
    if isinstance(module, OffsetCorrected):
        return output_scale(module.net)
    return float(getattr(module, "output_scale", 1.0))
