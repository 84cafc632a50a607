"""Assertions: whether what must hold does, for values of parameters and over a trajectory."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from acausal.errors import AcausalError, warn
from acausal.flattening import AssertionGroup, FlatModel, dotted
from acausal.modeling import as_written, references, time
from acausal.structure import numeric_function

Numbers = Float[np.ndarray, " n_values"]
"""Values of all parameters, and behind them the numbers of equations."""

Columns = Mapping[str, Float[np.ndarray, " n_points"]]


def asserted(flat: FlatModel) -> list[str] | None:
    """The variables that assertions of what varies in a simulation read; None where there is no such assertion."""
    own = [one for one in flat.assertions if _varies(one)]
    every = {i for one in own for i in one.group.variables.ravel().tolist()}
    return [flat.layout.variable(i) for i in sorted(every)] if own else None


def failures(flat: FlatModel, value: Numbers, columns: Columns | None = None) -> dict[str, str]:
    """What does not hold: by a sentence on where that is first, its level.

    What is not a number is taken to hold: others say more of it.

    Arguments:
        columns: by name, ``time`` and the variables of `asserted` at some points. Then assertions of what varies are
            looked at, else those of parameters.
    """
    points = {"time": np.zeros(1)} if columns is None else columns
    own = [one for one in flat.assertions if _varies(one) == (columns is not None)]
    found = {_failure(one, flat, value, points): one.stated.level for one in own}
    return {text: level for text, level in found.items() if text}


def check_assertions(
    flat: FlatModel, value: Numbers, error: type[AcausalError], columns: Columns | None = None
) -> None:
    """Refuse values for which an assertion does not hold, or warn, as it says; see `failures`.

    Raises:
        AcausalError: of the class that is given.
    """
    found = failures(flat, value, columns)
    for text in (t for t, level in found.items() if level == "warning"):
        warn(text)
    for text in (t for t, level in found.items() if level == "error"):
        raise error(text)


def _varies(one: AssertionGroup) -> bool:
    template = one.group.template
    return bool(template.variables) or time in template.residual.free_symbols


def _failure(one: AssertionGroup, flat: FlatModel, value: Numbers, columns: Columns) -> str:
    """A sentence on where it first does not hold; empty where it does."""
    group, names, t = one.group, flat.layout, columns["time"]
    template, shape = group.template, (len(group), len(t))
    given = [np.stack([columns[names.variable(i)] for i in slot]) for slot in group.variables.T]
    given += [value[slot][:, None] for slot in group.parameters.T]
    known = [np.broadcast_to(each, shape) for each in (t, *given)]
    function = numeric_function(template.residual, (*template.variables, *template.parameters))
    with np.errstate(all="ignore"):
        holds = np.broadcast_to(function(*known), shape) == 1
    failing = np.argwhere(~(holds | np.isnan(known).any(axis=0)).T)
    if not len(failing):
        return ""
    point, row = failing[0].tolist()
    component = int(group.components[row])
    [(origin, _)] = group.stated([row])
    condition = one.stated.condition
    if origin.owner is not None:
        condition = condition.xreplace(dotted(references(condition), origin.owner))
    own = [i for i in group.parameters[row].tolist() if i < flat.n_parameters]
    called = [*map(names.variable, group.variables[row].tolist()), *map(names.parameter, own)]
    numbers = [known[1 + i][row, point] for i in range(len(group.variables[row]))]
    prefix = f"{names.paths[component]}."
    reads = [
        f"{name.removeprefix(prefix)} = {number:.6g}"
        for name, number in zip(called, [*numbers, *value[own]], strict=True)
    ]
    when = f" at t = {t[point]:.6g} s" if _varies(one) else ""
    shown = f" ({', '.join(reads)})" if reads else ""
    more = len(np.unique(failing[:, 1])) - 1
    also = f", nor in {more} other{'s' * (more > 1)}" if more else ""
    label = names.components[component]._node.label
    return f"{label}: {as_written(condition)} does not hold{when}{shown}{also}: {one.stated.text}"
