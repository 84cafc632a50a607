"""A model whose friction sticks, which is too fast for explicit steps of a usual length."""

import functools

import acausal as ac
from tests.support.parts import Equations


def _inertias(s):
    friction = s.limit * ac.tanh((s.v - s.w) / 1e-3)
    return [
        ac.Eq(ac.der(s.v), s.push - s.f),
        ac.Eq(2 * ac.der(s.w), s.f),
        ac.Eq(s.f, friction),
    ]


@functools.cache
def sticking() -> ac.System:
    """Two inertias and a friction clutch that sticks, a mode at -7.5e4 1/s, or slips under a large push."""
    return ac.compile(Equations("v w f", _inertias, inputs="push", limit=50.0))
