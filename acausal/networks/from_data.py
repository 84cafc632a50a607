"""Scales and a linear law from data, for networks that were made without scales."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import jax.numpy as jnp
from jax.typing import ArrayLike
from jaxtyping import Array

from acausal.data import like_saved
from acausal.networks.activations import ACTIVATIONS
from acausal.networks.energy_parts import BesideQuadratic, WithMinCurvature
from acausal.networks.extrapolation import Continued, ContinuedEnergy
from acausal.networks.law_parts import BesideLinear, OffsetCorrected, WithMinSlope, start_at
from acausal.networks.mlp import MLP
from acausal.networks.monotone_and_convex import Convex, Monotone
from acausal.networks.promises import kept_promises
from acausal.networks.scaled import EnergyLaw, Scaled

SCALES = ("input_scale", "output_scale")

LEAST = 1e-3
"""Least slope of a law that must not fall, relative to its scales."""


class Affine(NamedTuple):
    """A law ``offset + Σ slope_i x_i`` in physical units."""

    slope: tuple[float, ...]
    offset: float = 0.0


class Scales(NamedTuple):
    """What the inputs of a law are about: ``centre ± reach``; and the magnitude of the law."""

    centre: tuple[float, ...]
    reach: tuple[float, ...]
    output: float


class LawShape(NamedTuple):
    """What a linear law must be like to stand beside a network without breaking its promises.

    Attributes:
        inputs: how many of the first inputs have a slope.
        every: how many inputs there are.
        rising: whether the slope must not be negative.
        through_zero: whether it must vanish at zero.
        energy: whether the network is an energy, whose derivative is the law.
        divides: whether the model is likely to divide by the slope, which has a start of its own.
        positive: whether it must not be negative; then it is a constant.
    """

    inputs: int
    every: int
    rising: bool
    through_zero: bool
    energy: bool
    divides: bool
    positive: bool = False

    @property
    def has_constant(self) -> bool:
        """Whether it has a constant that may be any number."""
        return not self.through_zero and not self.energy and not self.positive


def lacks_scales(network: object) -> bool:
    """Whether a network was made without scales, which a training can choose."""
    return any(name in getattr(network, "left_open", ()) for name in SCALES)


def linear_shape(network: Any) -> LawShape:
    """What linear law can stand beside a network that lacks scales."""
    promised = kept_promises(network)
    energy = isinstance(network, EnergyLaw)
    zero, rising = bool(promised & {"zero", "odd"}), bool(promised & {"passive", "monotone"})
    inner = network
    while not hasattr(inner, "in_size"):
        inner = inner.net
    every = int(inner.in_size)
    if "positive" in promised:
        return LawShape(0, every, False, False, False, False, positive=True)
    inputs = network.inputs if energy else (1 if zero or rising else every)
    return LawShape(inputs, every, rising, zero, energy, _own_start(network) is not None)


def with_scales(
    network: Any, scales: Scales, law: Affine, *, without_constant: bool = False
) -> Scaled | EnergyLaw | OffsetCorrected:
    """A network that lacks scales, with scales and beside a linear law; scales that it has stay as they are.

    Arguments:
        network: one of which `lacks_scales` is true; its weights stay.
        scales: of its arguments and results.
        law: the linear law.
        without_constant: whether the law's value at zero is subtracted from it, for one of one input.
    """
    if without_constant:
        around = tuple(abs(c) + r for c, r in zip(scales.centre, scales.reach, strict=True))
        zero = (0.0,) * len(around)
        return OffsetCorrected(with_scales(network, Scales(zero, around, scales.output), law))
    shape, open_ = linear_shape(network), network.left_open
    centred = not (shape.through_zero or shape.energy or "input_scale" not in open_)
    centre = scales.centre if centred else (0.0,) * shape.every
    far = [max(abs(c) + r, 1e-300) for c, r in zip(scales.centre, scales.reach, strict=True)]
    reach = tuple(scales.reach) if centred else tuple(far)
    if "input_scale" not in open_:
        given = network.input_scale
        reach = given if isinstance(given, tuple) else (given,) * shape.every
    output = scales.output if "output_scale" in open_ else network.output_scale
    if shape.divides and "output_scale" in open_:
        output = max(abs(law.slope[0]) * reach[0], 1e-300)
    if shape.positive and "output_scale" in open_:
        output = max(law.offset, LEAST * scales.output)
    slope = [s * r / output for s, r in zip(law.slope, reach, strict=False)]
    if shape.energy:
        slope = [s * r / reach[0] for s, r in zip(slope, reach, strict=False)]
    offset = law.offset + sum(s * c for s, c in zip(law.slope, centre, strict=False))
    inner = network if isinstance(network, MLP) else network.net
    if "activation" in open_:
        inner = _with_layers(inner, _smooth)
    inner = _with_layers(inner, _spread)
    if isinstance(inner, MLP):
        inner = _unscaled(inner)
    if isinstance(inner, Continued | ContinuedEnergy):
        limits = (inner.low, inner.high)
        if "limits" not in open_ and "input_scale" in open_:
            limits = (inner.low / reach[0], inner.high / reach[0])
        beside = _beside(inner.net, shape, slope, offset / output)
        inner = replace(inner, net=beside, low=limits[0], high=limits[1])
    else:
        inner = _beside(inner, shape, slope, offset / output)
    if isinstance(network, EnergyLaw):
        return EnergyLaw(inner, reach, output * reach[0], network.inputs)
    return Scaled(inner, reach, output, centre if any(centre) else 0.0)


@like_saved.register(MLP)
@like_saved.register(Scaled)
@like_saved.register(EnergyLaw)
def _(network: Any, settings: Mapping[str, str]) -> Any:
    """A network of the model that lacks scales, with those of a saved one, as texts by field; any other as it is."""
    if not lacks_scales(network):
        return network
    if "left_open" not in settings and "net.left_open" in settings:
        inner = {name.removeprefix("net."): value for name, value in settings.items()}
        return OffsetCorrected(like_saved(network, inner))
    if settings.get("left_open") != "()":
        return network
    known = ("input_scale", "output_scale", "energy_scale", "centre")
    values = {name: ast.literal_eval(settings[name]) for name in known if name in settings}
    reach = values["input_scale"]
    if not isinstance(reach, tuple):
        return network
    energy = values.get("energy_scale")
    output = values["output_scale"] if energy is None else energy / reach[0]
    shape = linear_shape(network)
    centre = values.get("centre", 0.0)
    middle = centre if isinstance(centre, tuple) else (0.0,) * len(reach)
    slope = tuple(output / r for r in reach[: shape.inputs])
    return replace(with_scales(network, Scales(middle, reach, output), Affine(slope)), **values)


def _beside(net: Any, shape: LawShape, slope: list[float], offset: float) -> Any:
    """The network beside a linear law, in numbers about one."""
    if shape.positive:
        return net
    if shape.rising and shape.has_constant:
        net = _with_layers(net, partial(_raised, offset - net(*(0.0,) * shape.every)))
    if shape.divides:
        return net
    if shape.rising:
        start = start_at(max(slope[0], LEAST))
        if shape.energy:
            return WithMinCurvature(net, 0.0, start, shape.inputs)
        return WithMinSlope(net, 0.0, start)
    beside = BesideQuadratic if shape.energy else BesideLinear
    level = None if shape.through_zero else jnp.asarray(offset, float)
    return beside(net, jnp.asarray(slope[: shape.inputs], float), level)


def _raised(by: ArrayLike, net: Layered) -> Layered:
    """The same network with a result that is larger by a constant; one without layers of biases as it is."""
    if isinstance(net, MLP):
        return net
    return _with(net, biases=(*net.biases[:-1], net.biases[-1] + by))


def _own_start(network: Any) -> Array | None:
    """The start of the slope that a network has in itself."""
    part = network
    while part is not None:
        if isinstance(part, WithMinSlope | WithMinCurvature) and part.more is not None:
            return part.more
        part = getattr(part, "net", None)
    return None


Layered = MLP | Monotone | Convex


def _with_layers(net: Any, change: Callable[[Any], Any]) -> Any:
    """The same parts around a network of layers that is changed."""
    if isinstance(net, Layered):
        return change(net)
    return replace(net, net=_with_layers(net.net, change)) if hasattr(net, "net") else net


def _smooth(net: Layered) -> Layered:
    """The same weights with tanh in place of ReLU."""
    if net.activation != "relu":
        return net
    unscaled = _unscaled(net, SCALES) if isinstance(net, MLP) else net
    return _with(unscaled, activation="tanh")


def _spread(net: Layered) -> Layered:
    """The same weights, with biases by which neurons bend apart in deeper layers of a monotone or convex network.

    Sums with positive weights all rise through zero together: neurons without biases would all saturate outwards alike,
    and one cannot turn into a law that grows outwards without losing all of them first. Those of a convex network would
    all be beyond where they bend, as what they add up is positive.
    """
    if isinstance(net, MLP):
        return net
    activation, biases = ACTIVATIONS[net.activation], list(net.biases)
    before = activation(biases[0])
    for k, weight in enumerate(net.weights[1:-1], start=1):
        positive = jnp.abs(weight)
        reach = jnp.sum(positive, axis=1)
        biases[k] += reach * jnp.linspace(-1, 1, len(reach))
        before, at_rest = activation(biases[k]), positive @ before
        if isinstance(net, Convex):
            biases[k] -= at_rest
    return _with(net, biases=tuple(biases))


def _unscaled(net: MLP, left_open: tuple[str, ...] = ()) -> MLP:
    """The same weights without scales."""
    return _with(net, input_scale=1.0, output_scale=1.0, left_open=left_open)


def _with(net: Any, **settings: Any) -> Any:
    """The same network with other settings."""
    found = object.__new__(type(net))
    for name, value in vars(net).items():
        object.__setattr__(found, name, settings.get(name, value))
    return found
