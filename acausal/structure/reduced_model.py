"""Reduce: aliases, index reduction, state selection and solving order of a flat model.

The result lists the states, and in which order and from which equations all other variables follow.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from acausal.errors import StructureError
from acausal.flattening import FlatModel, Integers, LeavesCaches
from acausal.modeling import time
from acausal.structure import graph
from acausal.structure.algebraic_loops import TornLoop
from acausal.structure.aliases import AliasFree, eliminate_aliases
from acausal.structure.blocks import SolvingStep, order_steps
from acausal.structure.discrete import check_jumps, followed
from acausal.structure.equations import Equations
from acausal.structure.hidden_constraints import expose_constraints
from acausal.structure.projected_states import Projection
from acausal.structure.singularity import explain_singularity
from acausal.structure.sparse_loops import SparseLoop
from acausal.structure.state_selection import select_states

OFF_ZERO = 1e-3
AUXILIARY = "auxiliary"
"""What a node is called that stands for no variable, such as a multiplier."""


@dataclass(frozen=True)
class ReducedModel(LeavesCaches):
    """A model ready for code: states, inputs and the steps that compute everything else.

    Nodes are those of `AliasFree`, then further derivatives that index reduction introduced.

    Attributes:
        states: nodes of the states, in order of declaration.
        rates, rate_signs: for every state the node of its derivative, and its sign.
        inputs: nodes of the inputs; derivatives of inputs, where the equations need them, follow.
        input_orders: for every input, the one that it is a derivative of, and how often it is differentiated.
        input_signs: for every input the sign of its node.
        discrete: nodes of what changes at events only; first those of watched conditions.
        followed: nodes of the inputs that discrete variables follow by equations.
        base: (n_nodes,) of a derivative without a name of its own: the node it differentiates, else -1.
        derivative, derivative_sign: as in `AliasFree`, extended.
        steps: in solving order.
        guessed: unknowns of nonlinear loops; the last states are the guesses from which Newton's method finds them.
        close: by node without a name, the variable that it is called as and close to.
        projections: of the states that are such nodes.
    """

    model: FlatModel
    aliases: AliasFree
    states: Integers
    rates: Integers
    rate_signs: Integers
    inputs: Integers
    input_orders: tuple[tuple[int, int], ...]
    input_signs: Integers
    discrete: Integers
    followed: Integers
    base: Integers
    derivative: Integers
    derivative_sign: Integers
    steps: tuple[SolvingStep, ...]
    guessed: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    close: Mapping[int, int] = field(default_factory=dict)
    projections: tuple[Projection, ...] = ()

    @property
    def n_independent(self) -> int:
        """How many states there are without the guesses of loops, which follow from the others."""
        return len(self.states) - len(self.guessed)

    @property
    def guesses(self) -> Integers:
        """The nodes of the guesses of loops."""
        return self.states[self.n_independent :]

    @cached_property
    def meant(self) -> Integers:
        """For every node itself; for a guess, or a state that is projected, the variable that it is close to."""
        nodes = np.arange(len(self.derivative))
        nodes[list(self.close)] = list(self.close.values())
        nodes[self.guesses] = self.guessed
        return nodes

    def resolve(self, node: int) -> tuple[int, int]:
        """Representative of a node and the node's sign relative to it."""
        if node < len(self.aliases.representative):
            return int(self.aliases.representative[node]), int(self.aliases.sign[node])
        return node, 1

    def resolve_derivative(self, node: int, order: int) -> tuple[int, int] | None:
        """As `resolve`, of a node's derivative; None where the model does not differentiate so often."""
        node, sign = self.resolve(node)
        for _ in range(order):
            if (derivative := int(self.derivative[node])) < 0:
                return None
            sign *= int(self.derivative_sign[node])
            node, own = self.resolve(derivative)
            sign *= own
        return node, sign

    @cached_property
    def exact(self) -> np.ndarray:
        """For every state whether it is the variable that it is called as, and not just close to it."""
        return self.meant[self.states] == self.states

    @cached_property
    def gaps(self) -> list[int]:
        """The nodes that are zero where states are on the constraints that they are projected on."""
        return [gap for p in self.projections for gap in p.gaps]

    @cached_property
    def start_members(self) -> tuple[Integers, Integers]:
        """For every node the variable whose start it takes (itself if it has no name), and the sign."""
        aliases, order = self.aliases, self.aliases.start_order(self.model)
        member = np.arange(len(self.derivative))
        member_sign = np.ones(len(member), dtype=np.int64)
        member[aliases.representative[order]] = order
        member_sign[aliases.representative[order]] = aliases.sign[order]
        return member[self.meant], member_sign[self.meant]

    def start_values(self, nodes: Integers) -> np.ndarray:
        """Start values of nodes, as far as they are numbers; zero for those without names."""
        member, sign = (a[nodes] for a in self.start_members)
        named = member < self.model.n_variables
        return sign * np.where(named, self.model.start[np.where(named, member, 0)], 0.0)

    def start_guess(self, nodes: Integers) -> np.ndarray:
        """Start values of nodes as far as they are numbers; a little off zero where none was given.

        At zero itself many derivatives vanish, and Newton's method would stall.
        """
        model = self.model
        member, sign = (a[nodes] for a in self.start_members)
        named = member < model.n_variables
        v = np.where(named, member, 0)
        start = np.where(named, model.start[v], 0.0)
        unknown = ~(named & model.start_given[v]) & (start == 0)
        unknown &= ~np.isin(nodes, [m for p in self.projections for m in p.multipliers])
        return sign * np.where(unknown, OFF_ZERO * np.where(named, model.nominal[v], 1.0), start)

    def nominal(self, nodes: Integers) -> np.ndarray:
        """Typical magnitudes of nodes; 1 for derivatives without a name."""
        nodes = self.meant[nodes]
        named = nodes < self.model.n_variables
        return np.where(named, self.model.nominal[np.where(named, nodes, 0)], 1.0)

    @cached_property
    def solved_positions(self) -> tuple[tuple[str, str], ...]:
        """Names of variables that nonlinear loops compute, such as the angles of a linkage, and of their derivatives.

        There may be several solutions, of which only one goes on from that of the moment before.
        """
        nodes: set[int] = set()
        for step in self.steps:
            if isinstance(step, TornLoop) and not step.shape.is_linear:
                nodes |= set(step.unknowns.ravel().tolist())
            if isinstance(step, SparseLoop) and not step.is_linear:
                nodes |= set(step.unknowns.tolist())
        named = [n for n in sorted(nodes) if n < self.model.n_variables]
        pairs = [(n, self.resolve_derivative(n, 1)) for n in named]
        known = [(n, rate[0]) for n, rate in pairs if rate and rate[0] < self.model.n_variables]
        return tuple((self.name(position), self.name(rate)) for position, rate in known)

    def name(self, node: int) -> str:
        """Dotted name of a node; derivatives without one are called ``der(...)``, guesses as what they guess."""
        node = int(self.meant[node])
        if node < self.model.n_variables:
            return self.model.layout.variable(node)
        base = int(self.base[node])
        return f"der({self.name(base)})" if base >= 0 else AUXILIARY


def reduce(model: FlatModel) -> ReducedModel:
    """Turn a flat model into an ordered set of assignments and loops.

    Raises:
        StructureError: if the model is singular, over- or underdetermined.
    """
    aliases = eliminate_aliases(model)
    system = Equations.of(model, aliases)
    combined = expose_constraints(system)
    problem = explain_singularity(system, combined)
    if problem is not None:
        raise StructureError(problem)
    system.reduce_index()
    system.insert_signals()
    return _order(system, *select_states(system))


# -- solving order ------------------------------------------------------------------------------------


def _order(system: Equations, states: list[int], projections: list[Projection]) -> ReducedModel:
    solved = set(states)
    check_jumps(system.model, system.aliases, solved)
    unknowns = [v for v in system.unknowns() if v not in solved]
    incidence = [[v for v in row if v not in solved] for row in system.incidence]
    n_nodes = len(system.structure.derivative)
    variable_of = graph.match(incidence, n_nodes)
    if len(incidence) != len(unknowns) or min(variable_of, default=0) < 0:
        raise StructureError(
            f"after index reduction {len(incidence)} equations remain for {len(unknowns)} unknowns; "
            "the model has constraints that contradict or repeat each other"
        )
    inputs, orders, signs = _inputs(system)
    moving = {*solved, *(i for i, (_, order) in zip(inputs, orders, strict=True) if order)}
    equation_of = {v: e for e, v in enumerate(variable_of)}

    def reads(node: int) -> Sequence[int | str]:
        if node in moving:
            return (system.name(node),)
        if (e := equation_of.get(node)) is None:
            return ()
        return (
            *system.variables[e],
            *((str(time),) if system.template[e].depends_on_time() else ()),
        )

    stops = followed(system.model, system.aliases, reads)
    blocks = graph.order_blocks(incidence, variable_of, n_nodes)
    steps = order_steps(system, incidence, variable_of, blocks)
    return ReducedModel(
        model=system.model,
        aliases=system.aliases,
        states=np.asarray(states, dtype=np.int64),
        rates=np.asarray([system.structure.derivative[v] for v in states], dtype=np.int64),
        rate_signs=np.asarray([system.sign[v] for v in states], dtype=np.int64),
        inputs=np.asarray(inputs, dtype=np.int64),
        input_orders=tuple(orders),
        input_signs=np.asarray(signs, dtype=np.int64),
        discrete=np.asarray(list(system.discrete), dtype=np.int64),
        followed=np.asarray([i for i in inputs if i in stops], dtype=np.int64),
        base=np.asarray(system.base, dtype=np.int64),
        derivative=np.asarray(system.structure.derivative, dtype=np.int64),
        derivative_sign=np.asarray(system.sign, dtype=np.int64),
        steps=steps,
        close=system.meant,
        projections=tuple(projections),
    )


def _inputs(system: Equations) -> tuple[list[int], list[tuple[int, int]], list[int]]:
    """Nodes of the inputs and of their derivatives; (input, order) and sign of each."""
    nodes = [int(system.aliases.representative[i]) for i in system.model.inputs]
    orders = [(i, 0) for i in range(len(nodes))]
    signs = [1] * len(nodes)
    for i, node in enumerate(tuple(nodes)):
        order, sign = 0, 1
        while system.structure.derivative[node] >= 0:
            sign *= system.sign[node]
            node = system.structure.derivative[node]
            order += 1
            nodes.append(node)
            orders.append((i, order))
            signs.append(sign)
    return nodes, orders, signs
