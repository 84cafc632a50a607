"""What derivatives and outputs depend on, from the model's structure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from acausal.export.c_text.code import EXCESS
from acausal.export.c_text.functions import mentions
from acausal.export.c_text.text import ModelText
from acausal.export.fmu_text.variables import (
    DERIVATIVE,
    INPUT,
    OUTPUT,
    OUTSIDE,
    STATE,
    WrittenVariable,
)
from acausal.structure import dependence_pattern
from acausal.system import System

MOST = 3_000_000
"""Most dependences that are listed, also of variables inside the model."""

FUNCTIONS = {DERIVATIVE: "rates", OUTPUT: "outputs", OUTSIDE: EXCESS}
"""Functions in C by the kinds of variables that they compute."""


def dependencies(
    text: ModelText, system: System, variables: Sequence[WrittenVariable], watched: np.ndarray
) -> dict[int, list[int]] | None:
    """For each derivative and each output the references of the states and inputs that it reads, and perhaps time.

    None if there are too many to be listed: then each depends on all. ``watched`` nodes tell whether networks leave
    their ranges.
    """
    outputs = _places(text.outputs)
    nodes, _ = system.nodes_of(outputs)
    reduced, n_states, n_inputs = system.reduced, len(system.states), len(system.inputs)
    sources = np.concatenate([reduced.states, reduced.inputs[:n_inputs]]).astype(np.int64)
    wanted = np.concatenate([reduced.rates, np.asarray(nodes), watched]).astype(np.int64)
    pattern = dependence_pattern(reduced, wanted, sources, MOST)
    if pattern is None:
        return None
    rows, columns = (np.asarray(a) for a in pattern)
    n_watched = len(watched)
    variable_of_row = _by_place(
        variables, {DERIVATIVE: 0, OUTPUT: n_states}, len(wanted) - n_watched
    )
    flag = [v.reference for v in variables if v.kind == OUTSIDE]
    variable_of_row = np.concatenate([variable_of_row, np.repeat(flag, n_watched).astype(np.int64)])
    variable_of_column = _by_place(variables, {STATE: 0, INPUT: n_states}, n_states + n_inputs)
    pairs = np.unique(np.stack([variable_of_row[rows], variable_of_column[columns]]), axis=1)
    found: dict[int, list[int]] = {}
    for v in variables:
        if v.kind in FUNCTIONS:
            found[v.reference] = []
            name = FUNCTIONS[v.kind]
            if mentions(text.code.functions[name].lines, "t"):
                found[v.reference].append(0)
        elif v.kind == STATE and v.causality == "output":
            found[v.reference] = [v.reference]
    free = {v.reference for v in variables if v.kind == STATE or v.causality == "input"}
    for row, column in pairs.T.tolist():
        if column in free:
            found[row].append(column)
    return {reference: sorted(read) for reference, read in found.items()}


def _places(groups: Sequence[tuple[object, str]]) -> list[str]:
    """Names of the variables of some groups, in the order in which they lie."""
    named: dict[int, str] = {}
    for run, _ in groups:
        named |= dict(zip(run.places, run.names, strict=True))  # type: ignore[attr-defined]
    return [named[place] for place in sorted(named)]


def _by_place(variables: Sequence[WrittenVariable], first: dict[int, int], size: int) -> np.ndarray:
    """For each place of some kinds, one behind the other, the reference of its variable."""
    found = np.zeros(size, dtype=np.int64)
    for v in variables:
        if v.kind in first:
            found[first[v.kind] + np.asarray(v.places)] = v.reference
    return found
