"""The function that tells whether a network is used outside of the ranges in which it was trained."""

from __future__ import annotations

from collections.abc import Iterator

FUNCTION = "excess"
"""Its name among the functions of the model: positive where an argument lies outside."""


def outside_help(name: str) -> str:
    """A line in the header's introduction."""
    return f"   {name}_outside(&m);            1 where a network's argument is outside of its range in training, else 0"


def outside_head(name: str) -> str:
    """Its declaration."""
    return f"int {name}_outside({name} *m)"


def outside_lines(name: str) -> Iterator[str]:
    """Its definition; what is no number lies outside."""
    yield ""
    yield outside_head(name) + " {"
    yield "    real found = 0;"
    yield f"    {FUNCTION}(m, m->time, m->x, m->u, &found);"
    yield "    return !(found <= 0);"
    yield "}"
