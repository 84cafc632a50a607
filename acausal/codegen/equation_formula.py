"""Equations of the flat model as formulas over what a program computes: events, initial values, calls of networks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import sympy as sp

from acausal.codegen.gather import Gather, signed
from acausal.codegen.instructions import Arguments, ArrayFormula
from acausal.codegen.parameters import ParameterLayout
from acausal.codegen.program import Program
from acausal.errors import StructureError
from acausal.flattening import EquationGroup
from acausal.structure import ReducedModel


def formula_of(
    group: EquationGroup,
    reduced: ReducedModel,
    program: Program,
    layout: ParameterLayout,
    expression: sp.Expr | None = None,
    *,
    orders: Sequence[int] | None = None,
    copies: Sequence[int] | None = None,
) -> ArrayFormula:
    """A formula for the instances of a group of equations.

    Arguments:
        group: of the model's own equations, before its structure is looked at.
        expression: in the slots of its template; None: its residual.
        orders: how often the variable of each slot is differentiated; None: as the template says.
        copies: which of several copies of the program's arrays, one behind the other, each slot is read in: the second
            may hold what was before an event, or derivatives by time. None: the first.

    Raises:
        StructureError: for a derivative that the model does not compute.
    """
    template = group.template
    expression = template.residual if expression is None else expression
    orders = template.orders if orders is None else orders
    copies = (0,) * len(orders) if copies is None else copies
    present = expression.free_symbols
    slots = zip(template.variables, group.variables.T.tolist(), orders, copies, strict=True)
    variables = [
        (symbol, _gather(reduced, program, column, order, copy))
        for symbol, column, order, copy in slots
        if symbol in present
    ]
    if missing := [symbol for symbol, found in variables if found is None]:
        raise StructureError(
            f"an equation reads {missing[0]}, which the model does not compute; declare a variable for it, and give "
            "that by ac.Eq(variable, ac.der(...))"
        )
    parameters = zip(template.parameters, group.parameters.T, strict=True)
    modules = zip(template.modules, group.modules.T, strict=True)
    arguments = Arguments(
        tuple((s, found) for s, found in variables if found is not None),
        tuple((s, layout.gather(p)) for s, p in parameters if s in present),
        tuple((s, layout.chosen(m)) for s, m in modules if s in present),
    )
    return ArrayFormula(expression, arguments, len(group))


def _gather(
    reduced: ReducedModel, program: Program, variables: Sequence[int], order: int, copy: int
) -> Gather | None:
    """How some variables are read, or derivatives of them; None where one is not computed."""
    found = [reduced.resolve_derivative(variable, order) for variable in variables]
    pairs = [pair for pair in found if pair is not None]
    if len(pairs) < len(found):
        return None
    nodes, signs = zip(*pairs, strict=True)
    return signed(program.gather(nodes, copy), np.asarray(signs))
