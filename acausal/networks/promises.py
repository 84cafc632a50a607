"""What a network promises for all weights, read off the parts that it is made of."""

from __future__ import annotations

from collections.abc import Callable, Set
from typing import Any

import numpy as np

from acausal.networks.energy_parts import (
    BesideQuadratic,
    Bowl,
    Levelled,
    WithMinCurvature,
)
from acausal.networks.extrapolation import Continued, ContinuedEnergy
from acausal.networks.law_parts import (
    BesideLinear,
    Between,
    Even,
    Odd,
    OffsetCorrected,
    Passive,
    Positive,
    SameSign,
    ThroughZero,
    WithMinSlope,
)
from acausal.networks.monotone_and_convex import Convex, Monotone
from acausal.networks.scaled import EnergyLaw, Scaled

Promises = frozenset[str]

WORDS = {
    "energy": "conserves energy: it is the derivative of one",
    "passive": "passive: it never gives back more energy than it took",
    "monotone": "monotone: its derivative is nowhere negative",
    "odd": "odd",
    "even": "even",
    "zero": "zero at zero",
    "positive": "positive",
    "bounded": "between two bounds",
}
"""What promises are called in reports, in this order."""


def promises_of(network: object) -> tuple[str, ...]:
    """What a network's law promises for all weights, in words; nothing for a module of your own."""
    kept = kept_promises(network)
    return tuple(words for name, words in WORDS.items() if name in kept)


def kept_promises(net: Any) -> Promises:
    """What a network's law promises, by the names of `WORDS`."""
    if isinstance(net, EnergyLaw):
        return _of_derivative(_of_energy(net.net), net.inputs)
    rule = _LAWS.get(type(net))
    return (
        frozenset()
        if rule is None
        else frozenset(rule(net, kept_promises(getattr(net, "net", None))))
    )


def bounds_of(net: Any) -> tuple[float, float]:
    """The values between which a network's law is for all weights; infinite where none is promised."""
    if isinstance(net, Between):
        return net.low, net.high
    if isinstance(net, Positive):
        return net.least, np.inf
    if isinstance(net, Scaled):
        low, high = sorted(net.output_scale * bound for bound in bounds_of(net.net))
        return low, high
    return bounds_of(net.net) if isinstance(net, Even) else (-np.inf, np.inf)


def _of_energy(net: Any) -> Promises:
    rule = _ENERGIES.get(type(net))
    if rule is None:
        return frozenset()
    return frozenset(rule(net, _of_energy(getattr(net, "net", None))))


def _of_derivative(energy: Promises, inputs: int) -> Promises:
    """Of the derivative of an energy."""
    found = {"energy"} | (energy & {"passive", "zero"})
    found |= {"odd", "zero"} if "even" in energy else set()
    return frozenset(found | ({"monotone"} if "convex" in energy and inputs == 1 else set()))


def _product(net: Any, inside: Promises) -> Set[str]:
    """Of an odd factor and a network: odd where the network is even."""
    return {"zero", "odd"} if "even" in inside else {"zero"}


def _continued(net: Any, inside: Promises) -> Set[str]:
    """Beyond limits: odd and even ones need symmetric limits, and passive ones that no tangent falls."""
    lost = set() if net.low == -net.high else {"odd", "even"}
    lost |= set() if getattr(net, "rising", True) else {"passive"}
    return inside - lost - {"positive", "bounded"}


Rule = Callable[[Any, Promises], Set[str]]

_LAWS: dict[type, Rule] = {
    Scaled: lambda net, inside: inside,
    Continued: _continued,
    Monotone: lambda net, inside: {"monotone"},
    WithMinSlope: lambda net, inside: inside & {"monotone", "odd", "zero", "passive"},
    BesideLinear: lambda net, inside: inside & {"odd", "zero"} if net.offset is None else set(),
    Odd: lambda net, inside: (inside & {"monotone"}) | {"odd", "zero"},
    Even: lambda net, inside: (inside & {"positive", "bounded"}) | {"even"},
    Passive: lambda net, inside: _product(net, inside) | {"passive"},
    SameSign: lambda net, inside: inside | {"passive", "zero"},
    OffsetCorrected: lambda net, inside: (inside - {"positive", "bounded"}) | {"zero"},
    ThroughZero: _product,
    Positive: lambda net, inside: (inside & {"monotone", "even"}) | {"positive"},
    Between: lambda net, inside: (inside & {"monotone", "even"}) | {"bounded"},
}
"""What parts promise of a law, given what the network inside promises; others promise nothing."""

_ENERGIES: dict[type, Rule] = {
    ContinuedEnergy: _continued,
    Convex: lambda net, inside: {"convex"},
    WithMinCurvature: lambda net, inside: inside & {"convex", "even", "passive", "zero"},
    BesideQuadratic: lambda net, inside: inside & {"even", "zero"} if net.offset is None else set(),
    Even: lambda net, inside: inside | {"even"},
    Bowl: lambda net, inside: (inside & {"even"}) | {"passive", "zero"},
    OffsetCorrected: lambda net, inside: (
        inside | ({"passive"} if {"even", "convex"} <= inside else set())
    ),
    Levelled: lambda net, inside: (
        inside | ({"passive", "zero"} if "convex" in inside else {"zero"})
    ),
}
"""The same of an energy."""
