"""Start values in C: of states, from time, inputs and parameters; of discrete variables, from parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import jax.numpy as jnp

from acausal.errors import ExportError, listing, warn
from acausal.export.c_text.functions import CArgument, CFunction, mentions, write_function
from acausal.export.c_text.lowering import Workspace
from acausal.export.c_text.statements import Buffer
from acausal.export.traced import trace
from acausal.export.vector import ParameterVector
from acausal.system import System

STARTS, GUESSES, DISCRETE_STARTS = "starts", "guesses", "discrete_starts"
"""Functions that give states at the start, where these are sought from, and what discrete variables begin with."""

MOST_FOR_STARTS = 10_000
"""Most numbers of working memory that start values may take."""


Write = Callable[[Callable[..., Any], Sequence[str], Buffer], CFunction]
"""Writes a function of some arguments by name, which fills a buffer."""


def start_functions(
    vector: ParameterVector, given: Mapping[str, CArgument], memory: Workspace
) -> dict[str, CFunction]:
    """Functions for start values that depend on what may change; those of states take discrete variables as given.

    Start values without C, or that need much memory, have none and are named in a warning.

    Arguments:
        vector: the parameters. given: the arguments of the model's functions by name.
        memory: shared by the functions of a file.
    """
    write = partial(_written, given, memory)
    found = _of_states(vector, write) | _of_discrete(vector, write)
    return {name: f for name, f in found.items() if name == GUESSES or _reads(f)}


def _of_states(vector: ParameterVector, write: Write) -> dict[str, CFunction]:
    """States at the start; if they depend on discrete variables, also where they are sought from."""
    system, initial = vector.system, vector.system.initializer
    modes = () if system.events is None else ("d",)
    into = Buffer("x", "real", len(system.states))

    def states(t: Any, u: Any, p: Any, d: Any = None) -> Any:
        return initial.start_or_nan(vector.packed(p), u, t, d)

    def guesses(p: Any) -> Any:
        return initial.conditions.starts(vector.packed(p))

    try:
        found = {STARTS: write(states, ("t", "u", "p", *modes), into)}
        if _reads(found[STARTS], modes):
            found[GUESSES] = write(guesses, ("p",), into)
    except ExportError as error:
        _warn(_computed(system), error, "set them with the parameters and inputs")
        return {}
    return found


def _of_discrete(vector: ParameterVector, write: Write) -> dict[str, CFunction]:
    """What discrete variables begin with."""
    system = vector.system
    if system.events is None:
        return {}

    def discrete(p: Any) -> Any:
        return system.initializer.conditions.discrete_start(vector.packed(p))

    into = Buffer("next_d", "real", len(system.reduced.discrete))
    try:
        return {DISCRETE_STARTS: write(discrete, ("p",), into)}
    except ExportError as error:
        _warn(_computed_discrete(system), error, "export again with other parameters")
        return {}


def _written(
    given: Mapping[str, CArgument],
    memory: Workspace,
    function: Callable[..., Any],
    names: Sequence[str],
    into: Buffer,
) -> CFunction:
    """A function in C of some arguments.

    Raises:
        ExportError: for an operation without C, or much memory.
    """
    arguments = [given[name] for name in names]
    block = trace(lambda *now: (function(*now),), *(jnp.zeros(a.shape) for a in arguments))
    found = write_function(block, arguments, [(into, 0)], memory)
    if found.real > MOST_FOR_STARTS and _reads(found):
        raise ExportError(
            f"C: {found.real} numbers of working memory are needed, more than {MOST_FOR_STARTS}."
        )
    return found


def _reads(function: CFunction, names: Sequence[str] | None = None) -> bool:
    """Whether a function reads any of its arguments, or some of them."""
    wanted = function.arguments if names is None else names
    return any(mentions(function.lines, name) for name in wanted)


def _warn(names: Sequence[str], error: ExportError, remedy: str) -> None:
    if not names:
        return
    reason = str(error).removeprefix("C: ").rstrip(".")
    warn(
        f"export: the start values of {listing(names, 6)} follow from parameters or inputs, but stay as exported when "
        f"these change ({reason}); {remedy}."
    )


def _computed(system: System) -> list[str]:
    """States whose start values follow from parameters, or from conditions that must hold."""
    initial, bound = system.initializer, _bound(system)
    solved = initial.solves(None, False, False)
    fixed = initial.conditions.fixed.tolist()
    each = zip(system.states, initial.conditions.start_of, fixed, strict=True)
    return [name for name, (v, _), held in each if v in bound or (solved and not held)]


def _computed_discrete(system: System) -> list[str]:
    """Discrete variables whose start values follow from parameters."""
    reduced, bound = system.reduced, _bound(system)
    members = reduced.start_members[0]
    return [reduced.name(i) for i in reduced.discrete.tolist() if int(members[i]) in bound]


def _bound(system: System) -> frozenset[int]:
    """Variables whose start value is a formula."""
    return frozenset(binding.target for binding in system.flat.starts)
