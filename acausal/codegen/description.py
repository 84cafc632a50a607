"""What an instruction computes, in words: for comments in what is exported."""

from __future__ import annotations

from collections.abc import Callable

from acausal.codegen.instructions import ExplicitInstruction
from acausal.codegen.program import Program
from acausal.errors import listing
from acausal.flattening import Integers


def described(program: Program, number: int, name: Callable[[int], str]) -> str:
    """The variables that an instruction gives, and their formula.

    Arguments:
        number: of the instruction. name: of a node.
    """
    instruction, first = program.instructions[number], program.first[number]
    rows = program.nodes[first : first + instruction.outputs]
    names = [_all(name, row) for row in rows]
    if isinstance(instruction, ExplicitInstruction):
        return f"{names[0]}{instruction.text}"
    return f"{listing(names, 6)}: {'linear ' if instruction.is_linear else ''}equations"


def _all(name: Callable[[int], str], nodes: Integers) -> str:
    """The name of the only node, or the first and the last."""
    found = [int(node) for node in nodes if node >= 0]
    if not found:
        return "an auxiliary value"
    return name(found[0]) if len(found) == 1 else f"{name(found[0])} ... {name(found[-1])}"
