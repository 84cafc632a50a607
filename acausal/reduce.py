"""Reduce: aliases, index reduction, state selection and solving order of a flat model.

The result says which variables are states, and in which order and from which equations all others follow.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from acausal import derive, graph
from acausal.aliases import AliasFree, eliminate_aliases, specialised
from acausal.diagnose import explain_singularity
from acausal.errors import StructureError
from acausal.flatten import FlatModel
from acausal.template import Integers, Template


@dataclass(frozen=True)
class Assignment:
    """Instances of one template, all solved for the same slot: ``variables[:, column]`` follow from the rest."""

    template: Template
    column: int
    variables: Integers
    parameters: Integers
    modules: Integers

    @property
    def unknowns(self) -> Integers:
        return self.variables[:, self.column]


@dataclass(frozen=True)
class BlockEquation:
    """An equation of an algebraic block: its slots name the block's unknowns (>= 0) or externals (-1 - i)."""

    template: Template
    variables: tuple[int, ...]
    parameters: tuple[int, ...]
    modules: tuple[int, ...]


@dataclass(frozen=True)
class BlockShape:
    """What equal algebraic loops share: equations over local numbers, and how they are torn."""

    equations: tuple[BlockEquation, ...]
    n_unknowns: int
    torn: graph.Torn

    @property
    def is_linear(self) -> bool:
        return all(
            derive.is_linear(e.template, tuple(c for c, v in enumerate(e.variables) if v >= 0))
            for e in self.equations
        )


@dataclass(frozen=True)
class Loop:
    """Algebraic loops of one shape, side by side: (n, m) unknowns follow from externals together."""

    shape: BlockShape
    unknowns: Integers
    externals: Integers
    parameters: Integers
    modules: Integers


Step = Assignment | Loop


@dataclass(frozen=True)
class ReducedModel:
    """A model ready for code: states, inputs and the steps that compute everything else.

    Nodes are those of `AliasFree`, then further derivatives that index reduction introduced.

    Attributes:
        states: nodes of the states, in order of declaration.
        rates, rate_signs: for every state the node of its derivative, and its sign.
        inputs: nodes of the inputs; derivatives of inputs, where the equations need them, follow.
        input_orders: for every input, which one it derives from and how often it is differentiated.
        base: (n_nodes,) of a derivative without a name of its own: the node it differentiates, else -1.
        derivative, derivative_sign: as in `AliasFree`, extended.
        steps: in solving order.
    """

    model: FlatModel
    aliases: AliasFree
    states: Integers
    rates: Integers
    rate_signs: Integers
    inputs: Integers
    input_orders: tuple[tuple[int, int], ...]
    base: Integers
    derivative: Integers
    derivative_sign: Integers
    steps: tuple[Step, ...]

    def resolve(self, node: int) -> tuple[int, int]:
        """Representative of a node and the node's sign relative to it."""
        if node < len(self.aliases.representative):
            return int(self.aliases.representative[node]), int(self.aliases.sign[node])
        return node, 1

    @cached_property
    def start_members(self) -> tuple[Integers, Integers]:
        """For every node the variable whose start it takes (itself if it has no name), and the sign.

        Of a node's names a fixed one counts most, then one whose start somebody gave, then the node's own.
        """
        model, n = self.model, self.model.n_variables
        node, sign = self.aliases.representative[:n], self.aliases.sign[:n]
        own = node == np.arange(n)
        order = np.lexsort((-np.arange(n), own, model.start_given, model.fixed))
        member = np.arange(len(self.derivative))
        member_sign = np.ones(len(member), dtype=np.int64)
        member[node[order]] = order
        member_sign[node[order]] = sign[order]
        return member, member_sign

    def name(self, node: int) -> str:
        """Dotted name of a node; derivatives without one are called ``der(...)``."""
        if node < self.model.n_variables:
            return self.model.layout.variable(node)
        return f"der({self.name(int(self.base[node]))})"


def reduce(model: FlatModel) -> ReducedModel:
    """Turn a flat model into an ordered set of assignments and loops.

    Raises:
        StructureError: if the model is singular, over- or underdetermined.
    """
    aliases = eliminate_aliases(model)
    system = _Equations.of(model, aliases)
    problem = explain_singularity(
        model, aliases, system.incidence, system.chains(), system.origins()
    )
    if problem is not None:
        raise StructureError(problem)
    system.reduce_index()
    states = _select_states(system)
    return _order(system, states)


# -- equations, growing under index reduction ----------------------------------------------------------


@dataclass
class _Equations:
    """All equations by number, and the graph of their unknowns; index reduction extends both."""

    model: FlatModel
    aliases: AliasFree
    template: list[Template]
    variables: list[list[int]]
    parameters: list[list[int]]
    modules: list[list[int]]
    component: list[int]
    known: set[int]
    structure: graph.DifferentialStructure
    sign: list[int]
    base: list[int]
    derived_from: dict[int, int] = field(default_factory=dict)

    @staticmethod
    def of(model: FlatModel, aliases: AliasFree) -> _Equations:
        template: list[Template] = []
        variables: list[list[int]] = []
        parameters: list[list[int]] = []
        modules: list[list[int]] = []
        component: list[int] = []
        for group in aliases.groups:
            template += [group.template] * len(group)
            variables += group.variables.tolist()
            parameters += group.parameters.tolist()
            modules += group.modules.tolist()
            component += group.components.tolist()
        known = {aliases.zero, *(int(aliases.representative[i]) for i in model.inputs)}
        derivative = aliases.derivative.tolist()
        for node in sorted(known):
            while derivative[node] >= 0:
                node = derivative[node]
                known.add(node)
        structure = graph.DifferentialStructure(
            incidence=[[v for v in row if v not in known] for row in variables],
            derivative=derivative,
            successor=[-1] * len(variables),
            differentiate=lambda e, s: system.differentiate(e),
        )
        system = _Equations(
            model,
            aliases,
            template,
            variables,
            parameters,
            modules,
            component,
            known,
            structure,
            aliases.derivative_sign.tolist(),
            aliases.base.tolist(),
        )
        return system

    @property
    def incidence(self) -> list[list[int]]:
        return self.structure.incidence

    def unknowns(self) -> list[int]:
        """All representatives that are not known."""
        n = len(self.aliases.representative)
        own = np.flatnonzero(self.aliases.representative == np.arange(n)).tolist()
        return [v for v in (*own, *range(n, len(self.structure.derivative))) if v not in self.known]

    def chains(self) -> dict[int, int]:
        """Every unknown -> the variable at the bottom of its chain of derivatives.

        Chains that end in a known derivative (the integral of an input, say) need no equation and are left out.
        """
        unknowns = self.unknowns()
        bottom = {v: v for v in unknowns}
        derivatives = set(self.structure.derivative)
        for v in unknowns:
            if v not in derivatives:
                chain = [v]
                while (node := self.structure.derivative[chain[-1]]) in bottom:
                    chain.append(node)
                for node_of_chain in chain:
                    if node >= 0:
                        del bottom[node_of_chain]
                    else:
                        bottom[node_of_chain] = v
        return bottom

    def origins(self) -> list[tuple[str, int]]:
        return [(t.origin, c) for t, c in zip(self.template, self.component, strict=True)]

    def reduce_index(self) -> None:
        """Differentiate what Pantelides' algorithm asks for."""
        try:
            graph.pantelides(self.structure)
        except RecursionError as error:
            origin = self.template[int(error.args[0])].origin
            raise StructureError(f"index reduction does not end at: {origin}") from None
        self.derived_from = {d: e for e, d in enumerate(self.structure.successor) if d >= 0}
        first_new = len(self.base)
        new = len(self.structure.derivative) - first_new
        self.sign += [1] * new
        self.base += [-1] * new
        for node, derivative in enumerate(self.structure.derivative):
            if derivative >= first_new:
                self.base[derivative] = node

    def differentiate(self, equation: int) -> list[int]:
        """Append the derivative of an equation; returns its unknowns."""
        template, sources = derive.differentiate(self.template[equation])
        row = self.variables[equation]
        nodes: list[int] = []
        codes: list[int] = []
        for column, raised in sources:
            node, sign = (self._derivative(row[column])) if raised else (row[column], 1)
            nodes.append(node)
            codes.append(0 if node == self.aliases.zero else sign * (nodes.index(node) + 1))
        special, (columns, kept, used) = specialised(
            template, (*codes, *[0] * len(template.parameters))
        )
        self.template.append(special)
        self.variables.append([nodes[c] for c in columns])
        self.parameters.append([self.parameters[equation][c] for c in kept])
        self.modules.append([self.modules[equation][c] for c in used])
        self.component.append(self.component[equation])
        return [v for v in self.variables[-1] if v not in self.known]

    def _derivative(self, node: int) -> tuple[int, int]:
        """Node and sign of a node's derivative."""
        if node == self.aliases.zero:
            return node, 1
        derivative = self.structure.derivative_of(node)
        if node in self.known:
            self.known.add(derivative)
        return derivative, self.sign[node] if node < len(self.sign) else 1


# -- state selection --------------------------------------------------------------------------------


def _select_states(system: _Equations) -> list[int]:
    """Choose dummy derivatives (Mattsson & Soderlind 1993), sparing the variables most wanted as states."""
    derivative = system.structure.derivative
    antecedent = {d: v for v, d in enumerate(derivative) if d >= 0 and v not in system.known}
    wanted = _preference(system)
    dummies: set[int] = set()
    constraints = [e for e in system.derived_from if system.structure.successor[e] < 0]
    candidates = [v for v in antecedent if derivative[v] < 0]
    while constraints:
        rows = [[v for v in system.incidence[e] if v in antecedent] for e in constraints]
        candidates.sort(key=lambda v: wanted(antecedent[v]))
        chosen = graph.choose_variables(rows, candidates, len(derivative))
        if len(chosen) < len(constraints):
            names = [system.template[e].origin for e in constraints]
            raise StructureError(
                f"index reduction finds no states; the constraints are: {'; '.join(names[:6])}"
            )
        dummies.update(chosen)
        constraints = [
            system.derived_from[e]
            for e in constraints
            if system.derived_from[e] in system.derived_from
        ]
        candidates = [antecedent[v] for v in chosen if antecedent[v] in antecedent]
    return [
        v for v, d in enumerate(derivative) if d >= 0 and d not in dummies and v not in system.known
    ]


def _preference(system: _Equations) -> Any:
    """How much a node is wanted as a state: the class's highest wish, then the earlier declared."""
    n = system.model.n_variables
    representative = system.aliases.representative
    wish = np.zeros(len(representative)) + 2.0
    wish[representative[:n]] = 0.0
    np.maximum.at(wish, representative[:n], system.model.state)

    def wanted(node: int) -> tuple[float, int]:
        return (float(wish[node]) if node < len(wish) else 2.0, -node)

    return wanted


# -- solving order ------------------------------------------------------------------------------------


def _order(system: _Equations, states: list[int]) -> ReducedModel:
    solved = set(states)
    unknowns = [v for v in system.unknowns() if v not in solved]
    incidence = [[v for v in row if v not in solved] for row in system.incidence]
    n_nodes = len(system.structure.derivative)
    variable_of = graph.match(incidence, n_nodes)
    if len(incidence) != len(unknowns) or min(variable_of, default=0) < 0:
        raise StructureError(
            f"after index reduction {len(incidence)} equations face {len(unknowns)} unknowns; "
            "the model has constraints that contradict or repeat each other"
        )
    blocks = graph.order_blocks(incidence, variable_of, n_nodes)
    inputs, orders = _inputs(system)
    return ReducedModel(
        model=system.model,
        aliases=system.aliases,
        states=np.asarray(states, dtype=np.int64),
        rates=np.asarray([system.structure.derivative[v] for v in states], dtype=np.int64),
        rate_signs=np.asarray([system.sign[v] for v in states], dtype=np.int64),
        inputs=np.asarray(inputs, dtype=np.int64),
        input_orders=tuple(orders),
        base=np.asarray(system.base, dtype=np.int64),
        derivative=np.asarray(system.structure.derivative, dtype=np.int64),
        derivative_sign=np.asarray(system.sign, dtype=np.int64),
        steps=_steps(system, incidence, variable_of, blocks),
    )


def _inputs(system: _Equations) -> tuple[list[int], list[tuple[int, int]]]:
    """Nodes of the inputs and of their derivatives, and (input, order) of each."""
    nodes = [int(system.aliases.representative[i]) for i in system.model.inputs]
    orders = [(i, 0) for i in range(len(nodes))]
    for i, node in enumerate(tuple(nodes)):
        order = 0
        while (node := system.structure.derivative[node]) >= 0:
            order += 1
            nodes.append(node)
            orders.append((i, order))
    return nodes, orders


def _steps(
    system: _Equations, incidence: list[list[int]], variable_of: list[int], blocks: graph.Blocks
) -> tuple[Step, ...]:
    """Group what can be computed at the same level by the same formula."""
    order = np.lexsort((np.arange(len(incidence)), blocks.block, blocks.level[blocks.block]))
    bounds = np.flatnonzero(np.diff(blocks.block[order], prepend=-1, append=-1))
    found: dict[Hashable, list[Any]] = {}
    for a, b in zip(bounds, bounds[1:], strict=False):
        equations = order[a:b].tolist()
        level = int(blocks.level[blocks.block[equations[0]]])
        if (
            len(equations) == 1
            and (column := _explicit(system, equations[0], variable_of)) is not None
        ):
            key: Hashable = (level, system.template[equations[0]], column)
            found.setdefault(key, []).append(equations[0])
        else:
            shape, members = _loop(system, equations, [variable_of[e] for e in equations])
            found.setdefault((level, *shape), []).append((equations, members))
    return tuple(_step(system, key, members) for key, members in found.items())


def _explicit(system: _Equations, equation: int, variable_of: list[int]) -> int | None:
    column = system.variables[equation].index(variable_of[equation])
    return column if derive.solve(system.template[equation], column) is not None else None


def _step(system: _Equations, key: Any, members: list[Any]) -> Step:
    if len(key) == 3 and isinstance(key[1], Template):
        _, template, column = key
        return Assignment(
            template,
            column,
            _matrix([system.variables[e] for e in members]),
            _matrix([system.parameters[e] for e in members]),
            _matrix([system.modules[e] for e in members]),
        )
    equations, n_unknowns = key[1], key[2]
    incidence = [[v for v in e.variables if v >= 0] for e in equations]

    def solvable(equation: int, unknown: int) -> bool:
        stated = equations[equation]
        return derive.is_safely_solvable(stated.template, stated.variables.index(unknown))

    shape = BlockShape(equations, n_unknowns, graph.tear(incidence, solvable, n_unknowns))
    columns = zip(*(m for _, m in members), strict=True)
    return Loop(shape, *(_matrix(list(c)) for c in columns))


def _loop(
    system: _Equations, equations: list[int], unknowns: list[int]
) -> tuple[tuple[Any, ...], tuple[list[int], ...]]:
    """A block in local numbers: its shape (shared by equal blocks) and what fills it."""
    local = {v: i for i, v in enumerate(unknowns)}
    externals: dict[int, int] = {}
    parameters: list[int] = []
    modules: list[int] = []
    stated: list[BlockEquation] = []
    for e in equations:
        codes = tuple(
            local[v] if v in local else -1 - externals.setdefault(v, len(externals))
            for v in system.variables[e]
        )
        first, first_module = len(parameters), len(modules)
        parameters += system.parameters[e]
        modules += system.modules[e]
        stated.append(
            BlockEquation(
                system.template[e],
                codes,
                tuple(range(first, len(parameters))),
                tuple(range(first_module, len(modules))),
            )
        )
    return (tuple(stated), len(unknowns)), (unknowns, list(externals), parameters, modules)


def _matrix(rows: list[list[int]]) -> Integers:
    return np.asarray(rows, dtype=np.int64).reshape(len(rows), -1)
