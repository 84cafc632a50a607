"""Alias elimination: variables that are equal up to sign become one, and equations shrink accordingly.

``x = y``, ``x = -y`` and ``x = 0`` need no solver. A union-find with signs merges such variables; where
``x`` and ``y`` are merged so are their derivatives. Derivatives form chains, which stay chains: an
equation such as ``der(x) = -x`` remains one. Equations are then *specialised*: rewritten once per
pattern of merged, negated and vanished slots, which may reveal further aliases.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from acausal.errors import StructureError
from acausal.flattening import EquationGroup, FlatModel, Integers

MAX_DOUBLINGS = 64


@dataclass(frozen=True)
class AliasFree:
    """A flat model after alias elimination.

    Nodes are the flat variables, then `zero`, then derivatives that no variable stands for.

    Attributes:
        representative, sign: (n_nodes,) node ``i`` equals ``sign[i] * representative[i]``.
        derivative, derivative_sign: (n_nodes,) of a representative: its derivative's node (-1: none) and sign.
        base: (n_nodes,) of a derivative node: the node it differentiates (-1: a variable).
        groups: the remaining equations over representatives.
        redundant: (origin, component) of the equations that became ``0 = 0``.
    """

    zero: int
    representative: Integers
    sign: Integers
    derivative: Integers
    derivative_sign: Integers
    base: Integers
    groups: tuple[EquationGroup, ...]
    redundant: tuple[tuple[str, int], ...]


def eliminate_aliases(model: FlatModel) -> AliasFree:
    """Merge aliased variables of a flat model and specialise its equations."""
    classes = _Classes.of(model.n_variables)
    parameters = parameter_aliases(model)
    pending = [
        classes.with_derivative_nodes(piece)
        for group in model.groups
        for piece in _fold(group, parameters, model.folded)
    ]
    redundant: list[tuple[str, int]] = []
    changed = True
    while changed:
        classes.update_roots()
        pieces = [
            p for group in pending for p in specialise(group, classes, parameters, model.folded)
        ]
        pending, changed = [], False
        for piece in pieces:
            alias = piece.template.alias()
            if piece.template.is_void:
                redundant += [(piece.template.origin, int(c)) for c in piece.components]
            elif alias is None:
                pending.append(piece)
            else:
                outcome = classes.merge(piece, alias)
                known = np.flatnonzero(outcome == _KNOWN)
                redundant += [(piece.template.origin, int(piece.components[i])) for i in known]
                if (outcome == _REFUSED).any():
                    pending.append(piece.rows(outcome == _REFUSED))
                changed = changed or bool((outcome == _MERGED).any())
    _check_inputs(model, classes)
    return _result(model, classes, pending, tuple(redundant))


def _check_inputs(model: FlatModel, classes: _Classes) -> None:
    """Inputs are free: no equation may tie one to zero, to another input or to its derivative."""
    seen = {classes.zero: "zero"}
    for variable in model.inputs.tolist():
        root, name = int(classes.root[variable]), model.layout.variable(variable)
        if root in seen:
            raise StructureError(
                f"overdetermined: the equations tie the input '{name}' to {seen[root]}; "
                "connect the input to a source, or remove the equation that prescribes it"
            )
        seen[root] = f"the input '{name}'"
    for root, text in list(seen.items())[1:]:
        below = classes.bottom(root)
        if below != root and below in seen:
            raise StructureError(
                f"overdetermined: {text} is made a derivative of {seen[below]}; one of them cannot be free"
            )


def parameter_aliases(model: FlatModel) -> Integers:
    """Parameters bound to nothing but another parameter are that parameter."""
    target = np.arange(len(model.value))
    for binding in model.bindings:
        if binding.expression in binding.symbols:
            target[binding.target] = binding.arguments[0]
    for _ in range(MAX_DOUBLINGS):
        further = target[target]
        if np.array_equal(further, target):
            return target
        target = further
    circular = np.flatnonzero(target[target] != target)  # refused when parameters are laid out
    target[circular] = circular
    return target


_KNOWN, _MERGED, _REFUSED = 0, 1, 2


@dataclass
class _Classes:
    """The union-find: parents and signs of all nodes, and the derivative of every class.

    ``antecedent`` leads from a class to the one that it is the derivative of. A class has at most one derivative and is
    the derivative of at most one; zero is its own derivative.
    """

    zero: int
    parent: list[int]
    sign: list[int]
    derivative: dict[int, tuple[int, int]]
    antecedent: dict[int, int]
    base: list[int]
    root: Integers = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    root_sign: Integers = field(default_factory=lambda: np.empty(0, dtype=np.int64))

    @staticmethod
    def of(n_variables: int) -> _Classes:
        n = n_variables + 1
        return _Classes(n_variables, list(range(n)), [1] * n, {}, {}, [-1] * n)

    def with_derivative_nodes(self, group: EquationGroup) -> EquationGroup:
        """The group with nodes in the slots of derivatives."""
        if not any(group.template.orders):
            return group
        variables = group.variables.copy()
        for column, order in enumerate(group.template.orders):
            for _ in range(order):
                variables[:, column] = [self._node(int(v)) for v in variables[:, column]]
        return EquationGroup(
            group.template, variables, group.parameters, group.modules, group.components
        )

    def _node(self, variable: int) -> int:
        if variable not in self.derivative:
            node = len(self.parent)
            self.parent.append(node)
            self.sign.append(1)
            self.base.append(variable)
            self.derivative[variable] = node, 1
            self.antecedent[node] = variable
        return self.derivative[variable][0]

    def find(self, node: int) -> tuple[int, int]:
        """Root of a node's class and the node's sign in it; paths are compressed."""
        path: list[int] = []
        while self.parent[node] != node:
            path.append(node)
            node = self.parent[node]
        sign = 1
        for step in reversed(path):
            sign *= self.sign[step]
            self.parent[step], self.sign[step] = node, sign
        return node, sign

    def merge(self, group: EquationGroup, relative: tuple[int, ...]) -> Integers:
        """Merge the two slots of every row (or one slot with zero); returns the outcome for every row."""
        outcome: list[int] = []
        for row in group.variables.tolist():
            a, b, sign = (*row, *relative) if len(row) == 2 else (*row, self.zero, 1)
            (ra, _), (rb, _) = self.find(a), self.find(b)
            if ra != rb and not self._may_join(ra, rb):
                outcome.append(_REFUSED)
            else:
                outcome.append(_MERGED if self._union(a, b, sign) else _KNOWN)
        return np.asarray(outcome)

    def _may_join(self, a: int, b: int) -> bool:
        """Whether derivatives still form chains after two classes are merged: no rings, no branches."""
        if self.zero in (a, b):
            return True
        if a in self.antecedent and b in self.antecedent:
            return False
        return self.bottom(a) != self.bottom(b)

    def bottom(self, root: int) -> int:
        """The lowest class of the chain of derivatives that a class is in."""
        while root in self.antecedent and root != self.zero:
            root = self.find(self.antecedent[root])[0]
        return root

    def _union(self, a: int, b: int, relative: int) -> bool:
        """State ``a = relative * b``; False if it was known."""
        queue = [(a, b, relative)]
        new = False
        while queue:
            a, b, relative = queue.pop()
            (ra, sa), (rb, sb) = self.find(a), self.find(b)
            relative *= sa * sb  # ra = relative * rb
            if ra == rb:
                if relative == 1 or ra == self.zero:
                    continue
                rb, relative = self.zero, 1
            if ra == self.zero or (rb != self.zero and rb > ra):
                ra, rb = rb, ra
            new = True
            self.parent[ra], self.sign[ra] = rb, relative
            if (antecedent := self.antecedent.pop(ra, None)) is not None and rb != self.zero:
                self.antecedent.setdefault(rb, antecedent)
            queue += self._join_derivatives(ra, rb, relative)
        return new

    def _join_derivatives(self, child: int, root: int, relative: int) -> list[tuple[int, int, int]]:
        """The relations between derivatives that follow from ``child = relative * root``."""
        of_child = self.derivative.pop(child, None)
        if of_child is None:
            return []
        node, sign = of_child
        if root == self.zero:
            return [(node, self.zero, 1)]
        if root in self.derivative:
            other, other_sign = self.derivative[root]
            return [(node, other, sign * relative * other_sign)]
        self.derivative[root] = node, sign * relative
        return []

    def update_roots(self) -> None:
        """Roots and signs of all nodes as arrays."""
        found = [self.find(i) for i in range(len(self.parent))]
        self.root = np.asarray([r for r, _ in found], dtype=np.int64)
        self.root_sign = np.asarray([s for _, s in found], dtype=np.int64)


# -- specialising -------------------------------------------------------------------------------------


def specialise(
    group: EquationGroup, classes: _Classes, parameters: Integers, folded: np.ndarray
) -> list[EquationGroup]:
    """Rewrite a group over representatives, one piece for every pattern of equal, negated and zero slots."""
    roots = classes.root[group.variables]
    arguments = parameters[group.parameters]
    first = _first_equal(roots) + 1
    pattern = np.where(roots == classes.zero, 0, first * classes.root_sign[group.variables])
    pattern = np.concatenate([pattern, folded[arguments].astype(np.int64)], axis=1)
    if len(group) == 1 or (pattern == pattern[0]).all():
        kinds, which = pattern[:1], np.zeros(len(group), dtype=np.int64)
    else:
        kinds, index, which = np.unique(pattern, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(index)  # in order of appearance
        kinds, which = kinds[order], np.argsort(order)[which.ravel()]
    pieces: list[EquationGroup] = []
    for number, kind in enumerate(kinds):
        template, columns = group.template.specialised(tuple(int(k) for k in kind))
        rows = np.flatnonzero(which == number)
        pieces.append(
            EquationGroup(
                template,
                roots[rows][:, columns[0]],
                arguments[rows][:, columns[1]],
                group.modules[rows][:, columns[2]],
                group.components[rows],
            )
        )
    return pieces


def _fold(group: EquationGroup, parameters: Integers, folded: np.ndarray) -> list[EquationGroup]:
    """A group with derivatives rewritten without the folded parameters: some derivatives may vanish with them."""
    is_zero = folded[parameters[group.parameters]]
    if not any(group.template.orders) or not is_zero.any():
        return [group]
    kinds, which = np.unique(is_zero, axis=0, return_inverse=True)
    as_it_is = tuple(range(1, len(group.template.variables) + 1))
    pieces: list[EquationGroup] = []
    for number, kind in enumerate(kinds):
        template, columns = group.template.specialised((*as_it_is, *(int(k) for k in kind)))
        orders = tuple(group.template.orders[c] for c in columns[0])
        rows = group.rows(which.ravel() == number)
        pieces.append(
            EquationGroup(
                template.with_orders(orders),
                rows.variables[:, columns[0]],
                rows.parameters[:, columns[1]],
                rows.modules[:, columns[2]],
                rows.components,
            )
        )
    return pieces


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
    classes: _Classes,
    groups: Sequence[EquationGroup],
    redundant: tuple[tuple[str, int], ...],
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
            renamed.append(
                EquationGroup(
                    piece.template,
                    best[piece.variables],
                    piece.parameters,
                    piece.modules,
                    piece.components,
                )
            )
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


def _best_members(model: FlatModel, classes: _Classes) -> Integers:
    """For every root the member that gives the class its name.

    An input, else the most preferred state, else the one nearest to the top of the hierarchy, else the first declared.
    """
    n, total = model.n_variables, len(classes.root)
    order = np.arange(total)
    wanted = np.zeros(total)
    wanted[:n] = model.state - 2.0
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


def _negated(group: EquationGroup, flips: Integers) -> list[EquationGroup]:
    """Split a group by which slots change sign, and change it."""
    if (flips == 1).all():
        return [group]
    kinds, which = np.unique(flips, axis=0, return_inverse=True)
    pieces: list[EquationGroup] = []
    for number, kind in enumerate(kinds):
        pattern = tuple(int(s) * (j + 1) for j, s in enumerate(kind)) + (0,) * len(
            group.template.parameters
        )
        template, _ = group.template.specialised(pattern)
        rows = group.rows(which.ravel() == number)
        pieces.append(
            EquationGroup(template, rows.variables, rows.parameters, rows.modules, rows.components)
        )
    return pieces
