"""Equations by number, each a template with its slots filled; index reduction reads and extends them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from acausal.errors import StructureError, listing, warn
from acausal.flattening import (
    FEW_VARIANTS,
    FlatModel,
    Integers,
    Origin,
    Statement,
    Template,
    specialised,
)
from acausal.modeling import TEAR_SELECT
from acausal.structure import graph
from acausal.structure.aliases import AliasFree
from acausal.structure.discrete import discrete_nodes
from acausal.structure.impulses import jump_of
from acausal.structure.jacobian import Point, is_constant, parameter_values, partials


@dataclass
class Equations:
    """All equations by number, and the graph of their unknowns; index reduction extends both.

    ``meant`` gives the variable that a node without a name is called as, and close to.
    """

    model: FlatModel
    aliases: AliasFree
    template: list[Statement]
    variables: list[list[int]]
    parameters: list[list[int]]
    modules: list[list[int]]
    component: list[int]
    origin: list[Origin]
    known: set[int]
    structure: graph.DifferentialStructure
    sign: list[int]
    base: list[int]
    discrete: dict[int, None]
    derived_from: dict[int, int] = field(default_factory=dict)
    meant: dict[int, int] = field(default_factory=dict)

    @staticmethod
    def of(model: FlatModel, aliases: AliasFree) -> Equations:
        """Number the equations of a model without aliases."""
        template = [g.template for g in aliases.groups for _ in range(len(g))]
        columns = [[c.tolist() for c in g.columns] for g in aliases.groups]
        variables, parameters, modules, component, origin = (
            [row for own in columns for row in own[k]] for k in range(5)
        )
        discrete = dict.fromkeys(discrete_nodes(model, aliases).tolist())
        known = {aliases.zero, *discrete, *(int(aliases.representative[i]) for i in model.inputs)}
        derivative = aliases.derivative.tolist()
        for node in sorted(known):
            while derivative[node] >= 0:
                node = derivative[node]
                known.add(node)
        structure = graph.DifferentialStructure(
            incidence=[
                [v for v in _read(t, row) if v not in known]
                for t, row in zip(template, variables, strict=True)
            ],
            derivative=derivative,
            successor=[-1] * len(variables),
            differentiate=lambda e, s: system.differentiate(e),
        )
        system = Equations(
            model,
            aliases,
            template,
            variables,
            parameters,
            modules,
            component,
            origin,
            known,
            structure,
            aliases.derivative_sign.tolist(),
            aliases.base.tolist(),
            discrete,
        )
        return system

    @property
    def incidence(self) -> list[list[int]]:
        """The unknowns of every equation."""
        return self.structure.incidence

    @cached_property
    def parameter_values(self) -> np.ndarray:
        """The model's own values of all parameters."""
        return parameter_values(self.model)

    @cached_property
    def tear_ranks(self) -> dict[int, int]:
        """By node, how much it is preferred as a tearing variable: from -2 "never" to 2 "always", without those of 0.

        Of a node's names, the one whose preference is farthest from the default counts.
        """
        given = self.model.tear - TEAR_SELECT.index("default")
        stated = np.flatnonzero(given)
        order = stated[np.lexsort((given[stated], abs(given[stated])))]
        nodes = self.aliases.representative[order]
        return dict(zip(nodes.tolist(), given[order].tolist(), strict=True))

    @cached_property
    def started(self) -> set[int]:
        """The nodes of which the model's author has given a start value, by any of their names."""
        given = np.flatnonzero(self.model.start_given)
        return set(self.aliases.representative[given].tolist())

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

    @cached_property
    def apart(self) -> list[str | None]:
        """For every equation what keeps it apart from equal ones of other classes: its text; None if they are many.

        A program computes equal equations side by side. Those of few classes are rather computed where they are needed.
        """
        stating: dict[int, list[Origin]] = {}
        pairs = list(zip(map(id, self.template), self.origin, strict=True))
        for template, origin in dict.fromkeys(pairs):
            stating.setdefault(template, []).append(origin)
        text = {
            (t, o): str(o)
            for t, own in stating.items()
            if 1 < len(own) <= FEW_VARIANTS
            for o in own
        }
        return list(map(text.get, pairs))

    def slots(self, equations: Sequence[int]) -> tuple[Integers, Integers, Integers]:
        """What fills the slots of equations of one template: variables, parameters and modules, row by row."""
        tables = self.variables, self.parameters, self.modules
        of_variables, of_parameters, of_modules = (
            matrix([t[e] for e in equations]) for t in tables
        )
        return of_variables, of_parameters, of_modules

    def describe(self, equation: int) -> str:
        """Where an equation is stated, and its text (of a derivative, that of the original equation)."""
        while equation in self.derived_from:
            equation = self.derived_from[equation]
        return self.model.stated_at(self.component[equation], self.origin[equation])

    def singular_loop(
        self, equations: Sequence[int], unknowns: Sequence[int], hint: str = ""
    ) -> StructureError:
        """The error for a loop whose equations do not determine its unknowns."""
        names = listing(dict.fromkeys(map(self.describe, equations)), 6)
        return StructureError(
            "the equations of a loop repeat or contradict each other, so that they do not determine "
            f"{listing(map(self.name, unknowns))}: {names}{hint}"
        )

    def name(self, node: int) -> str:
        """Dotted name of a node; derivatives without one are called ``der(...)``."""
        node = self.meant.get(node, node)
        if node < self.model.n_variables:
            return self.model.layout.variable(node)
        return f"der({self.name(self.base[node])})"

    def jacobian(
        self, chosen: Sequence[int], point: Point
    ) -> tuple[Integers, Integers, np.ndarray]:
        """The Jacobian of some equations as a sparse matrix: row in ``chosen``, node, value."""
        entries: list[tuple[Integers, Integers, np.ndarray]] = []
        for template, members in self._by_template(chosen):
            variables = np.asarray([self.variables[chosen[i]] for i in members])
            parameters = np.asarray([self.parameters[chosen[i]] for i in members], dtype=np.int64)
            entries += [
                (np.asarray(members), nodes, partials(template, c, variables, parameters, point))
                for c, nodes in enumerate(variables.T)
            ]
        rows, columns, values = zip(*entries, strict=True)
        return np.concatenate(rows), np.concatenate(columns), np.concatenate(values)

    def vanishing(self, parameters: np.ndarray) -> set[tuple[int, int]]:
        """(equation, column) where a partial derivative is zero for these parameters, though not for others."""
        found: set[tuple[int, int]] = set()
        at = Point(np.ones(1), parameters)
        for template, members in self._by_template(range(len(self.template))):
            for column in range(len(template.variables)) if template.parameters else ():
                if is_constant(template, column) and not template.partial(column).is_Number:
                    own = np.asarray([self.parameters[e] for e in members], dtype=np.int64)
                    nowhere = np.zeros((len(members), len(template.variables)), dtype=np.int64)
                    zero = np.flatnonzero(partials(template, column, nowhere, own, at) == 0)
                    found.update((members[i], column) for i in zero.tolist())
        return found

    def divisors(self, equation: int, column: int) -> list[int]:
        """The parameters in the partial derivative by a slot."""
        template = self.template[equation]
        symbols = template.partial(column).free_symbols
        slots = zip(template.parameters, self.parameters[equation], strict=True)
        return [p for s, p in slots if s in symbols and p < self.model.n_parameters]

    def _by_template(self, chosen: Sequence[int]) -> list[tuple[Statement, list[int]]]:
        """Positions in ``chosen`` of the equations that share a template."""
        found: dict[int, list[int]] = {}
        for i, e in enumerate(chosen):
            found.setdefault(id(self.template[e]), []).append(i)
        return [(self.template[chosen[members[0]]], members) for members in found.values()]

    def reduce_index(self) -> None:
        """Differentiate the equations that Pantelides' algorithm selects."""
        try:
            graph.pantelides(self.structure)
        except RecursionError as error:
            origin = self.origin[int(error.args[0])]
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
        self._warn_of_impulse(equation)
        template, sources = self.template[equation].differentiated()
        row = self.variables[equation]
        nodes: list[int] = []
        codes: list[int] = []
        first: dict[int, int] = {}
        for column, raised in sources:
            node, sign = (self._derivative(row[column])) if raised else (row[column], 1)
            nodes.append(node)
            place = first.setdefault(node, len(nodes))
            codes.append(0 if node == self.aliases.zero else sign * place)
        pattern = (*codes, *[0] * len(template.parameters))
        origin = self.origin[equation].differentiated
        special, (columns, kept, used) = specialised(template, pattern, origin)
        self._state(
            equation,
            origin,
            special,
            [nodes[c] for c in columns],
            [self.parameters[equation][c] for c in kept],
            [self.modules[equation][c] for c in used],
        )
        return [v for v in _read(special, self.variables[-1]) if v not in self.known]

    def _warn_of_impulse(self, equation: int) -> None:
        """Warn if an equation that is differentiated jumps in time: its derivative is an impulse there."""
        template = self.template[equation]
        if not isinstance(template, Template) or template.modules or not template.depends_on_time():
            return
        own = self.parameter_values[np.asarray(self.parameters[equation], dtype=np.int64)]
        if (
            t := jump_of(template.residual, dict(zip(template.parameters, own, strict=True)))
        ) is not None:
            warn(
                f"The model needs the derivative of '{self.origin[equation]}', which jumps at t = {t:g} s: the impulse "
                "there is left out, with the energy that it brings. Put something between that gives way, such as a "
                "resistance or a spring, or take a source that does not jump."
            )

    def insert_signals(self) -> None:
        """Put signals in the place of `Prescribed`; nothing is differentiated after this."""
        for e, template in enumerate(self.template):
            if template.has_prescribed():
                self.template[e], columns = template.with_signals()
                self.variables[e] = [self.variables[e][c] for c in columns]

    def new_node(self, stands_for: int = -1) -> int:
        """A further variable, without a name or called as another one."""
        self.structure.derivative.append(-1)
        self.sign.append(1)
        self.base.append(-1)
        node = len(self.base) - 1
        if stands_for >= 0:
            self.meant[node] = stands_for
        return node

    def append(
        self,
        like: int,
        template: Statement,
        variables: list[int],
        parameters: Sequence[int] = (),
        modules: Sequence[int] = (),
    ) -> None:
        """Add an equation that is stated where another one is."""
        self._state(like, self.origin[like], template, variables, [*parameters], [*modules])
        self.structure.successor.append(-1)
        self.structure.incidence.append([v for v in variables if v not in self.known])

    def _state(
        self,
        like: int,
        origin: Origin,
        template: Statement,
        variables: list[int],
        parameters: list[int],
        modules: list[int],
    ) -> None:
        self.component.append(self.component[like])
        self.origin.append(origin)
        self.template.append(template)
        self.variables.append(variables)
        self.parameters.append(parameters)
        self.modules.append(modules)

    def _derivative(self, node: int) -> tuple[int, int]:
        """Node and sign of a node's derivative."""
        if node == self.aliases.zero or node in self.discrete:
            return self.aliases.zero, 1
        derivative = self.structure.derivative_of(node)
        if node in self.known:
            self.known.add(derivative)
        return derivative, self.sign[node] if node < len(self.sign) else 1


def matrix(rows: Sequence[Sequence[int]]) -> Integers:
    """Rows of equal length as an array, also where they are empty."""
    return np.asarray(rows, dtype=np.int64).reshape(len(rows), -1)


def _read(template: Statement, row: list[int]) -> list[int]:
    """The variables that an equation's value depends on."""
    if not template.has_prescribed():
        return row
    return [row[c] for c in template.with_signals()[1]]
