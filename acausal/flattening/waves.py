"""Waves about a level: when one passes another level is known ahead."""

from __future__ import annotations

from typing import Any, NamedTuple

import sympy as sp

WAVES = (sp.sin, sp.cos, sp.tan)


class Swing(NamedTuple):
    """An expression that is ``middle + size * wave``."""

    middle: sp.Expr
    size: sp.Expr
    wave: Any


def swing(expression: sp.Expr) -> Swing | None:
    """An expression in which there is one wave, times a factor, as such; None for any other."""
    waves, level = expression.atoms(*WAVES), sp.Dummy()
    if len(waves) != 1:
        return None
    (wave,) = waves
    size = expression.subs(wave, level).diff(level)
    middle = expression.subs(wave, sp.S.Zero)
    return None if size == 0 or size.has(level) else Swing(middle, size, wave)
