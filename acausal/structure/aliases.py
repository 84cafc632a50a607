"""Alias elimination: variables that are equal up to sign become one, and equations shrink accordingly.

``x = y``, ``x = -y`` and ``x = 0`` need no solver. A union-find with signs merges such variables; where
``x`` and ``y`` are merged so are their derivatives. Derivatives form chains, which stay chains: an
equation such as ``der(x) = -x`` remains one. Equations are then *specialised*: rewritten once per
pattern of merged, negated and vanished slots, which may reveal further aliases.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from acausal.errors import StructureError
from acausal.flattening import EquationGroup, FlatModel, Integers, Origin, Statement, join_groups
from acausal.structure.alias_classes import KNOWN, MERGED, REFUSED, AliasClasses


@dataclass(frozen=True)
class AliasFree:
    """A flat model after alias elimination.

    Nodes are the flat variables, then `zero`, then derivatives that no variable stands for.

    Attributes:
        representative, sign: (n_nodes,) node ``i`` equals ``sign[i] * representative[i]``.
        derivative, derivative_sign: (n_nodes,) of a representative: its derivative's node (-1: none) and sign.
        base: (n_nodes,) of a derivative node: the node it differentiates (-1: a variable).
        groups: the remaining equations over representatives.
        redundant: what vanished: (origin, component) of equations that became ``0 = 0``.
    """

    zero: int
    representative: Integers
    sign: Integers
    derivative: Integers
    derivative_sign: Integers
    base: Integers
    groups: tuple[EquationGroup, ...]
    redundant: tuple[tuple[Origin, int], ...]

    def start_order(self, model: FlatModel) -> Integers:
        """The variables, such that of those that a node stands for the last one's start is the node's.

        One with a fixed start takes precedence, then one whose start was given, then the node's own.
        """
        variables = np.arange(model.n_variables)
        own = self.representative[: model.n_variables] == variables
        return np.lexsort((-variables, own, model.start_given, model.fixed))


def eliminate_aliases(model: FlatModel) -> AliasFree:
    """Merge aliased variables of a flat model and specialise its equations."""
    classes = AliasClasses.of(model.n_variables)
    parameters = model.parameter_aliases
    pending = _by_template(
        classes.with_derivative_nodes(piece)
        for group in model.groups
        for piece in _fold(group, parameters, model.folded)
    )
    order = {group.origins[0]: i for i, group in enumerate(model.groups)}
    redundant: list[tuple[Origin, int]] = []
    changed = True
    while changed:
        classes.update_roots()
        pieces = [
            p for group in pending for p in _specialise(group, classes, parameters, model.folded)
        ]
        pending = [p for p in pieces if not _says_alias(p.template)]
        changed = False
        for piece in _in_order((p for p in pieces if _says_alias(p.template)), order):
            alias = piece.template.alias()
            if alias is None:
                redundant += piece.stated(range(len(piece)))
                continue
            outcome = classes.merge(piece, alias)
            redundant += piece.stated(np.flatnonzero(outcome == KNOWN).tolist())
            if (outcome == REFUSED).any():
                pending.append(piece.rows(outcome == REFUSED))
            changed = changed or bool((outcome == MERGED).any())
    _check_inputs(model, classes)
    return _result(model, classes, _in_order(pending, order), tuple(redundant))


def _check_inputs(model: FlatModel, classes: AliasClasses) -> None:
    """Inputs are free: no equation may tie one to zero, to another input or to its derivative."""
    seen = {classes.zero: "zero"}
    for variable in model.inputs.tolist():
        root, name = int(classes.root[variable]), model.layout.variable(variable)
        if root in seen:
            raise StructureError(
                f"overdetermined: the equations tie the input '{name}' to {seen[root]}; "
                "connect the input to a source, or remove what prescribes it"
            )
        seen[root] = f"the input '{name}'"
    for root, text in list(seen.items())[1:]:
        below = classes.bottom(root)
        if below != root and below in seen:
            raise StructureError(
                f"overdetermined: {text} is made a derivative of {seen[below]}; one of them cannot be free"
            )


def _says_alias(template: Statement) -> bool:
    """Whether an equation only says that variables are equal up to sign, or zero, or nothing."""
    return template.is_void or template.alias() is not None


# -- grouping -----------------------------------------------------------------------------------------


def _by_template(groups: Iterable[EquationGroup]) -> list[EquationGroup]:
    """The groups with all instances of one template in one, whatever classes state them."""
    found: dict[Statement, list[EquationGroup]] = {}
    for group in groups:
        found.setdefault(group.template, []).append(group)
    return [same[0] if len(same) == 1 else join_groups(same) for same in found.values()]


def _in_order(groups: Iterable[EquationGroup], order: dict[Origin, int]) -> list[EquationGroup]:
    """The groups split by origin, in the order in which the model states them."""
    parts: list[tuple[int, EquationGroup]] = []
    for group in groups:
        origins = group.origins.tolist()
        if len(set(origins)) == 1:
            parts.append((order[origins[0]], group))
            continue
        place = np.fromiter(map(order.__getitem__, origins), np.int64, len(group))
        rows = np.argsort(place, kind="stable")
        for own in np.split(rows, np.flatnonzero(np.diff(place[rows])) + 1):
            parts.append((int(place[own[0]]), group.rows(own)))
    return [group for _, group in sorted(parts, key=lambda part: part[0])]


# -- specialising -------------------------------------------------------------------------------------


def _specialise(
    group: EquationGroup, classes: AliasClasses, parameters: Integers, folded: np.ndarray
) -> list[EquationGroup]:
    """Rewrite a group over representatives, one piece for every pattern of equal, negated and zero slots."""
    roots = classes.root[group.variables]
    arguments = parameters[group.parameters]
    first = _first_equal(roots) + 1
    codes = np.where(roots == classes.zero, 0, first * classes.root_sign[group.variables])
    merged = replace(group, variables=roots, parameters=arguments)
    return [piece for piece, _ in _by_pattern(merged, codes, folded[arguments])]


def _fold(
    group: EquationGroup, parameters: Integers, folded: np.ndarray
) -> Iterator[EquationGroup]:
    """A group with derivatives rewritten without the folded parameters: some derivatives may vanish with them."""
    is_zero, orders = folded[parameters[group.parameters]], group.template.orders
    if not any(orders) or not is_zero.any():
        yield group
        return
    as_it_is = np.arange(1, len(orders) + 1)
    for piece, kept in _by_pattern(group, as_it_is, is_zero):
        template = piece.template.with_orders(tuple(orders[c] for c in kept))
        yield replace(piece, template=template)


def _negated(group: EquationGroup, flips: Integers) -> list[EquationGroup]:
    """Split a group by which slots change sign, and change it."""
    if (flips == 1).all():
        return [group]
    codes = flips * np.arange(1, flips.shape[1] + 1)
    is_zero = np.zeros_like(group.parameters, dtype=bool)
    return [piece for piece, _ in _by_pattern(group, codes, is_zero)]


def _by_pattern(
    group: EquationGroup, codes: Integers, is_zero: np.ndarray
) -> Iterator[tuple[EquationGroup, list[int]]]:
    """A group split by pattern and specialised, in order of appearance, and the slots of variables that remain.

    Arguments:
        codes: by instance and slot of a variable, as for `Template.specialised`. is_zero: of a parameter.
    """
    pattern = np.concatenate([np.broadcast_to(codes, group.variables.shape), is_zero], axis=1)
    kinds, which = pattern[:1], np.zeros(len(group), dtype=np.int64)
    if (pattern != pattern[0]).any():
        kinds, index, which = np.unique(pattern, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(index)
        kinds, which = kinds[order], np.argsort(order)[which.ravel()]
    for number, kind in enumerate(kinds):
        own = group.rows(which == number)
        template, columns = own.specialised(tuple(int(k) for k in kind))
        piece = EquationGroup(
            template,
            own.variables[:, columns[0]],
            own.parameters[:, columns[1]],
            own.modules[:, columns[2]],
            own.components,
            own.origins,
        )
        yield piece, columns[0]


def _first_equal(rows: Integers) -> Integers:
    """For every entry, the first column of its row that holds the same value."""
    n, k = rows.shape
    if k <= 12:
        first = np.tile(np.arange(k), (n, 1))
        for j in range(k):
            for i in range(j - 1, -1, -1):
                first[:, j] = np.where(rows[:, i] == rows[:, j], i, first[:, j])
        return first
    order = np.argsort(rows, axis=1, kind="stable")
    ordered = np.take_along_axis(rows, order, axis=1)
    starts = np.ones_like(rows, dtype=bool)
    starts[:, 1:] = ordered[:, 1:] != ordered[:, :-1]
    position = np.maximum.accumulate(np.where(starts, np.arange(k), 0), axis=1)
    first = np.empty_like(rows)
    np.put_along_axis(first, order, np.take_along_axis(order, position, axis=1), axis=1)
    return first


# -- result -------------------------------------------------------------------------------------------


def _result(
    model: FlatModel,
    classes: AliasClasses,
    groups: Sequence[EquationGroup],
    redundant: tuple[tuple[Origin, int], ...],
) -> AliasFree:
    """Name every class by its best member and express everything in these."""
    root, root_sign, zero = classes.root, classes.root_sign, classes.zero
    best = _best_members(model, classes)
    representative = best[root]
    sign = root_sign * root_sign[representative]
    representative[root == zero] = zero
    n = len(root)
    derivative = np.full(n, -1, dtype=np.int64)
    derivative_sign = np.ones(n, dtype=np.int64)
    for r, (node, s) in classes.derivative.items():
        owner = int(representative[r])
        if r != zero:
            derivative[owner] = representative[node]
            derivative_sign[owner] = root_sign[owner] * s * sign[node]
    renamed: list[EquationGroup] = []
    for group in groups:
        flips = root_sign[best[group.variables]]
        for piece in _negated(group, flips):
            renamed.append(replace(piece, variables=best[piece.variables]))
    return AliasFree(
        zero,
        representative,
        sign,
        derivative,
        derivative_sign,
        np.asarray(classes.base),
        tuple(renamed),
        redundant,
    )


def _best_members(model: FlatModel, classes: AliasClasses) -> Integers:
    """For every root the member that gives the class its name.

    An input, else a discrete variable, else the most wanted state, else the one nearest to the top of the hierarchy,
    else the first declared.
    """
    n, total = model.n_variables, len(classes.root)
    order = np.arange(total)
    wanted = np.zeros(total)
    wanted[:n] = model.state - 2.0
    wanted[model.discrete] = 50.0
    wanted[model.inputs] = 100.0
    differentiated = np.zeros(total, dtype=bool)
    differentiated[[b for b in classes.base if b >= 0]] = True
    derived = np.asarray(classes.base) >= 0
    depth = np.zeros(total, dtype=np.int64)
    depth[:n] = _depths(model)
    rank = np.lexsort((order, depth, ~differentiated, -wanted, derived, classes.root))
    first = np.ones(total, dtype=bool)
    ordered = classes.root[rank]
    first[1:] = ordered[1:] != ordered[:-1]
    best = np.arange(total)
    best[ordered[first]] = rank[first]
    best[classes.zero] = classes.zero
    return best


def _depths(model: FlatModel) -> Integers:
    """How many dots each variable's name has."""
    layout = model.layout
    own = [
        np.asarray([path.count(".") for path, _ in form.variables], dtype=np.int64)
        for form in layout.forms
    ]
    above = [0 if not path else path.count(".") + 1 for path in layout.paths]
    pieces = [own[f] + above[i] for i, f in enumerate(layout.form_of)]
    return np.concatenate(pieces) if pieces else np.empty(0, dtype=np.int64)
