"""What is known ahead of an expression of time: whether it consists of lines, and when it bends or jumps."""

from __future__ import annotations

from itertools import combinations, product
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

WAVES = (sp.sin, sp.cos, sp.tan)
STEPS = (sp.floor, sp.ceiling, sp.Mod)
SIGNS = (sp.Abs, sp.sign, sp.Heaviside)
EXTREMES = (sp.Max, sp.Min)

CHOOSING = (Relational, sp.sign, sp.Heaviside)
"""What stays as it is between two edges."""

BENT = (Relational, *STEPS, *SIGNS, *EXTREMES)
"""What bends or jumps where its arguments are variables."""


def is_straight(node: Any, timed: set[sp.Symbol]) -> bool:
    """Whether an expression is a line between any two edges, by what changes with time."""
    if not node.free_symbols & timed or node in timed:
        return True
    if isinstance(node, CHOOSING):
        return is_foreseen(node, timed)
    if isinstance(node, sp.Mul) and sum(bool(a.free_symbols & timed) for a in node.args) > 1:
        return False
    kinds = (sp.Add, sp.Mul, sp.Piecewise, sp.Tuple, sp.And, sp.Or, sp.Not, *BENT)
    return isinstance(node, kinds) and all(is_straight(a, timed) for a in node.args)


def is_foreseen(node: Any, timed: set[sp.Symbol]) -> bool:
    """Whether all edges of what bends or jumps are known ahead, by what changes with time."""
    if isinstance(node, STEPS):
        return all(is_straight(one, timed) for one in node.args)
    return all(is_straight(one, timed) or _is_wave(one, timed) for one in compared(node))


def _is_wave(node: Any, timed: set[sp.Symbol]) -> bool:
    """Whether an expression is a wave of a line about a level that does not move."""
    if isinstance(node, WAVES):
        return is_straight(node.args[0], timed)
    moving = [a for a in node.args if a.free_symbols & timed]
    return isinstance(node, sp.Add | sp.Mul) and len(moving) == 1 and _is_wave(moving[0], timed)


def compared(node: Any) -> list[Any]:
    """What is zero where an expression bends or jumps."""
    if isinstance(node, SIGNS):
        return [node.args[0]]
    is_relation = isinstance(node, Relational)
    pairs = product(*map(_ends, node.args)) if is_relation else combinations(_ends(node), 2)
    return [one - other for one, other in pairs]


def _ends(node: Any) -> list[Any]:
    """What an extreme or a size chooses its value from, of extremes within it too; itself, for anything else."""
    if isinstance(node, sp.Abs):
        return [node.args[0], -node.args[0]]
    return [end for a in node.args for end in _ends(a)] if isinstance(node, EXTREMES) else [node]
