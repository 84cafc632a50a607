"""Shapes that many pictures are made of, and what tells classes with one shape apart."""

from dataclasses import replace

import acausal as ac

LYING = (60.0, 32.0)
"""Size of an element with two ends."""


def block(text: str = "", strokes: str = "", *, source: bool = False, wide: float = 0.0) -> ac.Icon:
    """A signal block: a frame with a text or a curve."""
    width = max(44.0, 6.6 * len(text) + 14.0, wide)
    return ac.Icon(strokes, text=text, size=(width, 36.0), frame=True, source=source)


def element(strokes: str, text: str = "", *, fills: str = "", source: bool = False) -> ac.Icon:
    """An element with two ends."""
    return ac.Icon(strokes, fills, text, LYING, source=source)


def marked(icon: ac.Icon, mark: str) -> ac.Icon:
    """A picture with a few letters at its upper right, for a class that differs from others in its law only."""
    return replace(icon, mark=mark)


def truths(icon: ac.Icon, names: str) -> ac.Icon:
    """A picture some of whose signals are truth values, which are computed as 1 and 0."""
    return replace(icon, kinds={**icon.kinds, **dict.fromkeys(names.split(), "bool")})


def integers(icon: ac.Icon, names: str) -> ac.Icon:
    """A picture some of whose signals are whole numbers, which are computed as real ones."""
    return replace(icon, kinds={**icon.kinds, **dict.fromkeys(names.split(), "int")})


def boxed(icon: ac.Icon, mark: str = "") -> ac.Icon:
    """An element in a frame: one with signals in place of connectors, or with parts of its own."""
    return replace(icon, size=(88.0, 56.0), frame=True, source=False, mark=mark)


def variable(icon: ac.Icon, mark: str = "") -> ac.Icon:
    """An element that a signal varies: with an arrow across."""
    arrow = icon.fills + "M16 -15L14 -8L9 -12Z"
    return replace(icon, strokes=icon.strokes + "M-14 13L14 -13", fills=arrow, mark=mark)


ROUND = "M-14 0a14 14 0 1 0 28 0a14 14 0 1 0 -28 0"
