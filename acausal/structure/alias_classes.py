"""Classes of variables that are equal up to sign: a union-find with signs, in which derivatives stay chains."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from acausal.flattening import EquationGroup, Integers

KNOWN, MERGED, REFUSED = 0, 1, 2
"""What came of an alias that was stated."""


@dataclass
class AliasClasses:
    """The union-find: parents and signs of all nodes, and the derivative of every class.

    ``antecedent`` leads from a class to the one that it is the derivative of. But for zero, which is its own
    derivative, a class has at most one derivative and is the derivative of at most one.
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
    def of(n_variables: int) -> AliasClasses:
        """One class for every variable, and one for zero."""
        n = n_variables + 1
        return AliasClasses(n_variables, list(range(n)), [1] * n, {}, {}, [-1] * n)

    def with_derivative_nodes(self, group: EquationGroup) -> EquationGroup:
        """The group with nodes in the slots of derivatives."""
        if not any(group.template.orders):
            return group
        variables = group.variables.copy()
        for column, order in enumerate(group.template.orders):
            for _ in range(order):
                variables[:, column] = [self._node(int(v)) for v in variables[:, column]]
        return replace(group, variables=variables)

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
        """Merge the two slots of every row (or one slot with zero); returns what came of every row."""
        outcome: list[int] = []
        for row in group.variables.tolist():
            a, b, sign = (*row, *relative) if len(row) == 2 else (*row, self.zero, 1)
            (ra, _), (rb, _) = self.find(a), self.find(b)
            if ra != rb and not self._may_join(ra, rb):
                outcome.append(REFUSED)
            else:
                outcome.append(MERGED if self._union(a, b, sign) else KNOWN)
        return np.asarray(outcome)

    def _may_join(self, a: int, b: int) -> bool:
        """Whether derivatives form chains also where two classes are one: no rings, no branches."""
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
        """``child = relative * root``: what follows for their derivatives."""
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
