"""State selection: after index reduction, which variables are states and which are dummy derivatives."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.sparse import csr_array

from acausal.errors import StructureError, listing
from acausal.modeling import STATE_SELECT
from acausal.structure.equations import Equations
from acausal.structure.jacobian import Point, random_values
from acausal.structure.projected_states import Mechanism, Projection, find_mechanisms, project
from acausal.structure.rank import choose_columns

DEFAULT = float(STATE_SELECT.index("default"))


def select_states(system: Equations) -> tuple[list[int], list[Projection]]:
    """Choose dummy derivatives (Mattsson & Soderlind 1993) and keep the most preferred variables as states.

    Where equally preferred variables are tied by constraints that none of them fulfils everywhere, all are states; what
    that adds is the second result.

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
    mechanisms: list[Mechanism] = []
    dependent: set[int] = set()
    while constraints:
        ranks = {v: wanted(antecedent[v]) for v in candidates}
        preferences = {v: ranks[v][0] for v in sorted(candidates, key=ranks.__getitem__)}
        stated = {system.derived_from[e]: e for e in constraints}
        found = find_mechanisms(
            system,
            list(stated),
            {antecedent[v]: preference for v, preference in preferences.items()},
        )
        if found:
            chosen = _independent(system, constraints, preferences, points)
            dependent.update(antecedent[v] for v in chosen)
        mechanisms += found
        solved = {stated[e] for m in found for e in m.equations}
        inside = {v for m in found for v in m.variables}
        dummy = [v for v in candidates if antecedent[v] in inside]
        dummies.update(dummy)
        left = {v: p for v, p in preferences.items() if v not in dummies}
        rest = [e for e in constraints if e not in solved]
        dummy += _independent(system, rest, left, points) if rest else []
        dummies.update(dummy)
        constraints = [
            system.derived_from[e]
            for e in constraints
            if system.derived_from[e] in system.derived_from
        ]
        candidates = [antecedent[v] for v in dummy if antecedent[v] in antecedent]
    states = [
        v for v, d in enumerate(derivative) if d >= 0 and d not in dummies and v not in system.known
    ]
    projections = project(system, mechanisms[::-1], dependent, points)
    states += [s for p in projections for s in p.states]
    return sorted(states, key=lambda s: system.meant.get(s, s)), projections


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
