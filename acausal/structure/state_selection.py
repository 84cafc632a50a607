"""State selection: after index reduction, which variables are states and which are dummy derivatives."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.sparse import csr_array

from acausal.errors import StructureError, listing
from acausal.modeling import STATE_SELECT
from acausal.structure.equations import Equations
from acausal.structure.jacobian import Point, random_values
from acausal.structure.rank import choose_columns

DEFAULT = float(STATE_SELECT.index("default"))


def select_states(system: Equations) -> list[int]:
    """Choose dummy derivatives (Mattsson & Soderlind 1993) and keep the most preferred variables as states.

    The differentiated constraints determine the dummies if their Jacobian has full rank. This is decided numerically:
    at the model's start values; where these are a singular point, as angles of zero often are, or one that keeps less
    preferred variables, at those that modifiers give, and random values for the others; at last at random values.

    Raises:
        StructureError: if the constraints depend on each other.
    """
    derivative = system.structure.derivative
    antecedent = {d: v for v, d in enumerate(derivative) if d >= 0 and v not in system.known}
    wanted = _preference(system, antecedent)
    dummies: set[int] = set()
    constraints = [e for e in system.derived_from if system.structure.successor[e] < 0]
    candidates = [v for v in antecedent if derivative[v] < 0]
    points = _points(system) if constraints else ()
    while constraints:
        ranks = {v: wanted(antecedent[v]) for v in candidates}
        preferences = {v: ranks[v][0] for v in sorted(candidates, key=ranks.__getitem__)}
        dummy = _independent(system, constraints, preferences, points)
        dummies.update(dummy)
        constraints = [
            system.derived_from[e]
            for e in constraints
            if system.derived_from[e] in system.derived_from
        ]
        candidates = [antecedent[v] for v in dummy if antecedent[v] in antecedent]
    return [
        v for v, d in enumerate(derivative) if d >= 0 and d not in dummies and v not in system.known
    ]


def _independent(
    system: Equations,
    constraints: list[int],
    preferences: dict[int, float],
    points: Sequence[Point],
) -> list[int]:
    """Candidates that the constraints determine, as many as there are constraints: those with the least preference.

    Arguments:
        preferences: by candidate, the least first.
        points: the first one decides, or the second where that leaves less; the others where both are singular.
    """
    candidates, left, found = [*preferences], list[int](), dict[float, list[int]]()
    least = sum([*preferences.values()][: len(constraints)])
    for k, point in enumerate(points):
        rows, columns, values = system.jacobian(constraints, point)
        shape = len(constraints), len(system.structure.derivative)
        chosen, left = choose_columns(csr_array((values, (rows, columns)), shape=shape), candidates)
        if not left:
            found.setdefault(sum(preferences[v] for v in chosen), chosen)
        if found and (k > 0 or least in found):
            return found[min(found)]
    names = listing(dict.fromkeys(system.describe(constraints[row]) for row in left), 6)
    raise StructureError(
        f"constraints between states repeat or contradict others: {names}. "
        "Are parts joined rigidly along two ways?"
    )


def _points(system: Equations) -> list[Point]:
    """Where the Jacobian is evaluated: at all starts, at those that are given, and at random values."""
    model, aliases = system.model, system.aliases
    anywhere = random_values(len(system.structure.derivative))
    order = aliases.start_order(model)
    start, partly = np.zeros_like(anywhere), np.array(anywhere)
    for point, members in ((start, order), (partly, order[model.start_given[order]])):
        point[aliases.representative[members]] = aliases.sign[members] * model.start[members]
    return [Point(values, system.parameter_values) for values in (start, partly, anywhere)]


def _preference(
    system: Equations, antecedent: dict[int, int]
) -> Callable[[int], tuple[float, int, int]]:
    """How much a node is preferred as a state: by `stateSelect`, then by a fixed start, then by order of declaration.

    The variables that it is a derivative of become states with it, so the average along that chain counts; of a node's
    names, the one with the highest preference counts.
    """
    n = system.model.n_variables
    representative = system.aliases.representative
    preference = np.full(len(system.structure.derivative), DEFAULT)
    preference[representative[:n]] = 0.0
    np.maximum.at(preference, representative[:n], system.model.state)
    fixed = np.zeros(len(preference), bool)
    fixed[representative[:n][system.model.fixed]] = True

    def wanted(node: int) -> tuple[float, int, int]:
        chain = [node]
        while chain[-1] in antecedent:
            chain.append(antecedent[chain[-1]])
        return float(preference[chain].mean()), int(fixed[chain].sum()), -node

    return wanted
