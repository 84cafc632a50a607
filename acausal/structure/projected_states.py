"""Projected states: where no choice of states is regular everywhere, all candidates are states, near the constraints.

A pendulum in Cartesian coordinates has one degree of freedom, but neither ``x`` nor ``y`` determines the other one
where it turns. So each coordinate ``q`` that a nonlinear constraint ``g(q) = 0`` ties to equally preferred ones gets a
state ``s``, and the coordinates are the point of the constraints that is nearest to the states, but for terms of second
order (E. Eich: Convergence results for a coordinate projection method applied to mechanical systems with algebraic
constraints, SIAM J. Numer. Anal. 30, 1993):

    q = s + w**2 (dg/dq)(s)' lambda,   g(q) = 0,   der(s) = der(q) + |der(q)| (q - s) / w

with nominal values ``w``. The states follow the coordinates, and never leave the constraints by more than the errors of
a few steps. The same holds for speeds ``der(q)`` and the derivative of the constraint. Variables ``z`` that other
constraints give explicitly, ``h(z, q) = 0`` with constant ``dh/dz``, need no states: the derivatives of ``g`` through
them come from multipliers of ``h``. All of it is equations, so that loops, events, gradients and exports need no more.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp

from acausal.flattening import Template, interned
from acausal.structure.blocks import LARGE
from acausal.structure.equations import Equations
from acausal.structure.jacobian import Point, is_constant, partials
from acausal.structure.rank import connected_parts

ALWAYS = 2
"""The rank of what is torn in any case (`Equations.tear_ranks`)."""

SMALL = 1e-9
"""A difference of factors that is smaller, relative to these, is rounding."""

Row = dict[int, float | None]
"""The partial derivatives of a constraint by variable; None where one is not constant."""


@dataclass(frozen=True)
class Mechanism:
    """Constraints that no choice of states fulfils everywhere.

    Attributes:
        constraints: those between ``coordinates``, which may all become states.
        explicit: constraints that give the variables ``followers`` for given coordinates.
    """

    constraints: list[int]
    coordinates: list[int]
    explicit: list[int]
    followers: list[int]

    @property
    def equations(self) -> set[int]:
        """All of its constraints."""
        return {*self.constraints, *self.explicit}

    @property
    def variables(self) -> set[int]:
        """What they determine, near the states."""
        return {*self.coordinates, *self.followers}


def find_mechanisms(
    system: Equations, constraints: Sequence[int], preferences: Mapping[int, float]
) -> list[Mechanism]:
    """The connected parts of ``constraints`` that are not solved by constant factors, and prefer no states.

    Those that would become a loop which is too large to be torn are left out, and those whose variables jump at events.

    Arguments:
        preferences: of the variables that may be states, the least preferred first.
    """
    rows = {e: _partials(system, e, preferences) for e in constraints}
    if all(None not in row.values() for row in rows.values()):
        return []
    pivots = _eliminate(rows, preferences)
    jumps = system.model.events.jumps
    jumping = {int(system.aliases.representative[v]) for g in jumps for v in g.targets.tolist()}
    rank = {v: i for i, v in enumerate(preferences)}
    found: list[Mechanism] = []
    for part in _connected(rows, len(system.structure.derivative)):
        coordinates = sorted({v for e in part for v in rows[e]}, key=rank.__getitem__)
        free = len(coordinates) - len(part)
        ranks = [preferences[v] for v in coordinates]  # in rising order
        if free <= 0 or ranks[len(part) - 1] < ranks[len(part)] or jumping & {*coordinates}:
            continue
        followers = _closure(system, part, pivots)
        explicit = [pivots[v] for v in followers]
        mechanism = Mechanism(sorted(part), coordinates, explicit, followers)
        if len(mechanism.equations) + len(coordinates) <= LARGE:
            found.append(mechanism)
    return found


def _partials(system: Equations, equation: int, candidates: Mapping[int, float]) -> Row:
    template, variables = system.template[equation], system.variables[equation]
    row: Row = {}
    point = Point(np.ones(1), system.parameter_values)
    nowhere = np.zeros((1, len(variables)), dtype=np.int64)
    for column, v in enumerate(variables):
        if v not in candidates:
            continue
        if is_constant(template, column):
            own = np.asarray([system.parameters[equation]], dtype=np.int64)
            value = float(partials(template, column, nowhere, own, point)[0])
            if value:
                row[v] = value
        else:
            row[v] = None
    return row


def _eliminate(rows: dict[int, Row], order: Iterable[int]) -> dict[int, int]:
    """Take out of the rows, as far as factors are constant, each variable in turn; the row that gives it."""
    pivots: dict[int, int] = {}
    holders: dict[int, dict[int, None]] = {}
    for e, row in rows.items():
        for v in row:
            holders.setdefault(v, {})[e] = None
    for v in order:
        candidates = [e for e in holders.get(v, ()) if rows[e][v] is not None]
        if not candidates:
            continue
        e = min(candidates, key=lambda e: (len(rows[e]), e))
        row = rows.pop(e)
        for u in row:
            del holders[u][e]
        divisor = row.pop(v)
        pivots[v] = e
        for other in holders.pop(v):
            _subtract(rows[other], rows[other].pop(v), row, divisor)
            for u in row:
                if u in rows[other]:
                    holders[u][other] = None
                else:
                    holders[u].pop(other, None)
    return pivots


def _subtract(row: Row, factor: float | None, pivot: Row, divisor: float | None) -> None:
    for u, value in pivot.items():
        old = row.get(u, 0.0)
        if factor is None or value is None or old is None or divisor is None:
            row[u] = None
            continue
        change = factor * value / divisor
        if abs(old - change) > SMALL * max(abs(old), abs(change)):
            row[u] = old - change
        else:
            row.pop(u, None)


def _connected(rows: Mapping[int, Row], width: int) -> list[list[int]]:
    """Rows with common variables, together."""
    parts: dict[int, list[int]] = {}
    for e, part in zip(rows, connected_parts([*map(list, rows.values())], width), strict=False):
        parts.setdefault(int(part), []).append(e)
    return [*parts.values()]


def _closure(system: Equations, constraints: Sequence[int], pivots: Mapping[int, int]) -> list[int]:
    """The variables that are taken out of some constraints, directly or by way of others."""
    found: dict[int, None] = {}
    waiting = [*constraints]
    for e in waiting:  # which grows
        for v in system.variables[e]:
            if v in pivots and v not in found:
                found[v] = None
                waiting.append(pivots[v])
    return list(found)


# -- the equations of a projection ----------------------------------------------------------------


@dataclass(frozen=True)
class Projection:
    """What the projection of a mechanism adds: a state for each coordinate, and multipliers and gaps of constraints.

    Attributes:
        gaps: how far the states are off the constraints: they are zero at the start.
        constraints: where these are stated.
        dependent: states that the constraints determine at the start, if the others are known.
        is_linear: whether no slope of the constraints depends on what they determine.
    """

    states: list[int]
    multipliers: list[int]
    gaps: list[int]
    constraints: list[str]
    dependent: list[int]
    is_linear: bool


def project(
    system: Equations,
    mechanisms: Sequence[Mechanism],
    dependent: Container[int],
    points: Sequence[Point],
) -> list[Projection]:
    """Add states near which coordinates and followers fulfil the constraints, and the equations that say so.

    Arguments:
        mechanisms: a mechanism before what its derivatives constrain.
        dependent: coordinates that the constraints determine at the start, if the others are known.
    """
    near: dict[int, int] = {}
    return [_project(system, m, near, dependent, points) for m in mechanisms]


def _project(
    system: Equations,
    mechanism: Mechanism,
    near: dict[int, int],
    dependent: Container[int],
    points: Sequence[Point],
) -> Projection:
    """One of them; ``near`` says by variable what is close to it and follows from states alone, and is extended."""
    coordinates, constraints = mechanism.coordinates, mechanism.constraints
    add = _Writer(system, near, constraints[0])
    for v in (*coordinates, *mechanism.followers):
        near[v] = system.new_node(stands_for=v)
    states = [near[q] for q in coordinates]
    for e in mechanism.explicit:
        add.copy(e)
    weights = [_nominal(system, q) for q in coordinates]
    scales = _scales(system, mechanism, weights, points)
    multipliers = [system.new_node() for _ in constraints]
    system.tear_ranks.update(dict.fromkeys(multipliers, ALWAYS))
    slopes = _slopes(add, mechanism, scales)
    for q, s, w in zip(coordinates, states, weights, strict=True):
        pairs = zip(multipliers, slopes[q], strict=True)
        add.sum([(q, 1 / w**2), (s, -1 / w**2)], [_Term([m, slope]) for m, slope in pairs])
        add.rate(s, q, w)
    residuals = [c * system.template[e].residual for e, c in zip(constraints, scales, strict=True)]
    return Projection(
        states,
        multipliers,
        [add.value(e, r) for e, r in zip(constraints, residuals, strict=True)],
        [system.describe(e) for e in constraints],
        [s for q, s in zip(coordinates, states, strict=True) if q in dependent],
        _is_linear(system, mechanism),
    )


def _slopes(add: _Writer, mechanism: Mechanism, scales: Sequence[float]) -> dict[int, list[int]]:
    """For every coordinate the nodes of the derivatives of all constraints by it, through followers, at the states."""
    system = add.system
    terms: dict[int, dict[int, _Term]] = {
        v: {} for v in (*mechanism.followers, *mechanism.coordinates)
    }
    for e in (*mechanism.constraints, *mechanism.explicit):
        for column, v in enumerate(system.variables[e]):
            if v in terms:
                terms[v][e] = add.partial(e, column)
    slopes: dict[int, list[int]] = {q: [] for q in mechanism.coordinates}
    for constraint, scale in zip(mechanism.constraints, scales, strict=True):
        factors = {e: system.new_node() for e in mechanism.explicit}
        for v, own in terms.items():
            total = [own[e].times(factor) for e, factor in factors.items() if e in own]
            if constraint in own:
                total.append(own[constraint].scaled(scale))
            if v in slopes:
                slopes[v].append(system.new_node())
            add.sum([(slopes[v][-1], 1.0)] if v in slopes else [], total)
    return slopes


def _is_linear(system: Equations, mechanism: Mechanism) -> bool:
    """Whether no derivative of the constraints depends on what they determine."""
    variables = mechanism.variables
    for e in mechanism.equations:
        template, row = system.template[e], system.variables[e]
        inside = {s for s, v in zip(template.variables, row, strict=True) if v in variables}
        if any(template.partial(template.variables.index(s)).free_symbols & inside for s in inside):
            return False
    return True


@dataclass(frozen=True)
class _Term:
    """A product of nodes, and of a factor of parameters and numbers."""

    nodes: list[int]
    factor: sp.Expr = sp.S.One
    symbols: tuple[sp.Symbol, ...] = ()
    parameters: tuple[int, ...] = ()

    def times(self, node: int) -> _Term:
        return replace(self, nodes=[node, *self.nodes])

    def scaled(self, scale: float) -> _Term:
        return replace(self, factor=_number(scale) * self.factor)


@dataclass(frozen=True)
class _Writer:
    """Appends equations that are stated where ``like`` is, with what is ``near`` in the place of variables."""

    system: Equations
    near: Mapping[int, int]
    like: int

    def copy(self, equation: int) -> None:
        """The same equation between what is near."""
        system = self.system
        row = [self.near.get(v, v) for v in system.variables[equation]]
        system.append(
            equation,
            system.template[equation],
            row,
            system.parameters[equation],
            system.modules[equation],
        )

    def value(self, equation: int, expression: sp.Expr) -> int:
        """A node for an expression in the slots of an equation."""
        system, node = self.system, self.system.new_node()
        own = sp.Symbol("new value", real=True)  # no variable is called so
        template, present = system.template[equation], expression.free_symbols
        slots = (
            (template.variables, [self.near.get(v, v) for v in system.variables[equation]]),
            (template.parameters, system.parameters[equation]),
            (template.modules, system.modules[equation]),
        )
        kept = [[(s, v) for s, v in zip(*pair, strict=True) if s in present] for pair in slots]
        variables, parameters, modules = (tuple(s for s, _ in pairs) for pairs in kept)
        symbols = (own, *variables)
        definition = Template(own - expression, symbols, (0,) * len(symbols), parameters, modules)
        first, *rest = ([v for _, v in pairs] for pairs in kept)
        system.append(equation, interned(definition), [node, *first], *rest)
        return node

    def partial(self, equation: int, column: int) -> _Term:
        """The partial derivative of an equation."""
        template = self.system.template[equation]
        partial = template.partial(column)
        if not is_constant(template, column):
            return _Term([self.value(equation, partial)])
        pairs = zip(template.parameters, self.system.parameters[equation], strict=True)
        used = [(s, p) for s, p in pairs if s in partial.free_symbols]
        return _Term([], partial, tuple(s for s, _ in used), tuple(p for _, p in used))

    def sum(self, outside: list[tuple[int, float]], terms: list[_Term]) -> None:
        """Weighted nodes outside equal the sum of terms."""
        variables = [node for node, _ in outside]
        slots = [sp.Symbol(f"v{i}", real=True) for i in range(len(outside))]
        residual = sp.Add(*(_number(c) * s for (_, c), s in zip(outside, slots, strict=True)))
        parameters: list[int] = []
        named: list[sp.Symbol] = []
        for term in terms:
            own = [sp.Symbol(f"v{len(slots) + i}", real=True) for i in range(len(term.nodes))]
            new = [sp.Symbol(f"p{len(named) + i}", real=True) for i in range(len(term.symbols))]
            factor: Any = term.factor.xreplace(dict(zip(term.symbols, new, strict=True)))
            residual -= sp.Mul(factor, *own)
            slots += own
            named += new
            variables += term.nodes
            parameters += term.parameters
        template = Template(residual, tuple(slots), (0,) * len(slots), tuple(named), ())
        self.system.append(self.like, interned(template), variables, parameters)

    def rate(self, state: int, coordinate: int, nominal: float) -> None:
        """A state follows a coordinate."""
        structure, rate = self.system.structure, self.system.new_node()
        structure.derivative[state] = rate
        self.system.base[rate] = state
        template = following(self.system.sign[coordinate], nominal)
        row = [rate, structure.derivative[coordinate], coordinate, state]
        self.system.append(self.like, template, row)


def following(sign: int, nominal: float) -> Template:
    """``rate = sign der + |der| (z - g) / nominal``, with which ``g`` follows ``z``, over rate, der, z and g.

    The last term brings ``g`` back while ``z`` moves by its nominal value, at any speed: the errors of the steps do not
    add up.
    """
    rate, der, z, g = slots = tuple(sp.Symbol(n, real=True) for n in ("rate", "der", "z", "g"))
    back = sp.Abs(der) * (z - g) / _number(nominal)
    return interned(Template(rate - sign * der - back, slots, (0,) * len(slots), (), ()))


def _number(value: float) -> sp.Expr:
    return sp.nsimplify(value)


def _nominal(system: Equations, node: int) -> float:
    model = system.model
    return float(abs(model.nominal[node])) if node < model.n_variables else 1.0


def _scales(
    system: Equations, mechanism: Mechanism, weights: Sequence[float], points: Sequence[Point]
) -> list[float]:
    """Factors of the constraints after which they change by 1 where coordinates move by their nominal values.

    Rounded to powers of two.
    """
    equations = [*mechanism.constraints, *mechanism.explicit]
    places = {v: i for i, v in enumerate((*mechanism.coordinates, *mechanism.followers))}
    m, n = len(mechanism.constraints), len(mechanism.coordinates)
    sizes = np.zeros(m)
    for point in points:
        jacobian = np.zeros((len(equations), len(places)))
        for row, node, value in zip(*system.jacobian(equations, point), strict=True):
            if node in places:
                jacobian[row, places[node]] = value
        own, outer = jacobian[:m], jacobian[m:]
        through = np.linalg.lstsq(outer[:, n:], outer[:, :n])[0] if len(outer) else np.zeros((0, n))
        slopes = (own[:, :n] - own[:, n:] @ through) * weights
        sizes = np.linalg.norm(slopes, axis=1)
        if sizes.min() > SMALL * sizes.max():
            break
    return [2.0 ** -round(math.log2(size)) if size > 0 else 1.0 for size in sizes.tolist()]
