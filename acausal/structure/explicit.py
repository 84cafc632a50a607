"""The explicit equations of a reduced model as sympy, for people to read.

Every derivative of a state is written in states, inputs and parameters; what cannot be written so, the unknowns
of nonlinear loops, keeps its name and its equations follow.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from acausal.flattening import Integers
from acausal.modeling import ModuleCall, primes, time as internal_time
from acausal.structure import symbolic as derive
from acausal.structure.reduced_model import Accumulation, Assignment, Loop, Mesh, ReducedModel, Step

MAX_LOOP = 6
time = sp.Symbol("time")


def explicit_equations(
    reduced: ReducedModel, parameter_target: Integers, module_target: Integers
) -> tuple[sp.Equality, ...]:
    """``der(state) = ...`` for every state, in order, then the equations of loops left implicit.

    Arguments:
        parameter_target: for every parameter the one by whose name it goes; ``module_target`` likewise.
    """
    writer = _Writer(reduced, parameter_target, module_target)
    rates: list[Any] = [
        sp.Eq(
            sp.Derivative(writer.symbol(int(s)), time), sign * writer.value(int(r)), evaluate=False
        )
        for s, r, sign in zip(reduced.states, reduced.rates, reduced.rate_signs, strict=True)
    ]
    return (*rates, *writer.implicit)


class _Writer:
    """Writes nodes as expressions, each once."""

    def __init__(
        self, reduced: ReducedModel, parameter_target: Integers, module_target: Integers
    ) -> None:
        self.reduced = reduced
        self.parameter_target = parameter_target
        self.module_target = module_target
        self.implicit: list[Any] = []
        self._values: dict[int, sp.Expr] = {reduced.aliases.zero: sp.S.Zero}
        self._known = {*reduced.states.tolist(), *reduced.inputs.tolist()}
        self._origin: dict[int, tuple[Step, int]] = {}
        for step in reduced.steps:
            rows = _rows(step)
            for i, row in enumerate(rows.tolist()):
                self._origin.update(dict.fromkeys(row, (step, i)))

    def symbol(self, node: int) -> sp.Symbol:
        return sp.Symbol(self.reduced.name(node))

    def value(self, node: int) -> sp.Expr:
        """The node in terms of states, inputs and parameters (without recursion: chains may be long)."""
        stack = [node]
        while stack:
            current = stack[-1]
            if current in self._values:
                stack.pop()
            elif current in self._known:
                self._values[current] = self.symbol(current)
            else:
                step, row = self._origin[current]
                missing = [v for v in self._needs(step, row) if v not in self._values]
                if missing:
                    stack += missing
                    continue
                match step:
                    case Assignment():
                        expression = derive.solve(step.template, step.column)
                        self._values[current] = self._fill(step, row, expression)
                    case Accumulation():
                        self._values[current] = self._sum(step, row)
                    case Loop():
                        self._write_loop(step, row)
                    case Mesh():
                        self._write_mesh(step)
        return self._values[node]

    def _needs(self, step: Step, row: int) -> list[int]:
        match step:
            case Assignment():
                return [v for i, v in enumerate(step.variables[row].tolist()) if i != step.column]
            case Accumulation():
                return step.terms[row].tolist()
            case Loop():
                return step.externals[row].tolist()
            case Mesh():
                return step.externals.tolist()

    def _sum(self, step: Accumulation, row: int) -> sp.Expr:
        pairs = zip(step.weights[row].tolist(), step.terms[row].tolist(), strict=True)
        return sp.Add(*(sp.nsimplify(w) * self._values[v] for w, v in pairs))

    def _fill(self, step: Assignment, row: int, expression: Any) -> sp.Expr:
        names = self._parameters(step.template, step.parameters[row], step.modules[row])
        for i, symbol in enumerate(step.template.variables):
            if i != step.column:
                names[symbol] = self._values[int(step.variables[row, i])]
        return _readable(expression.xreplace(names))

    def _parameters(self, template: Any, parameters: Any, modules: Any) -> dict[sp.Symbol, sp.Expr]:
        layout = self.reduced.model.layout
        names: dict[sp.Symbol, sp.Expr] = {internal_time: time}
        for symbol, p in zip(template.parameters, parameters, strict=True):
            names[symbol] = sp.Symbol(layout.parameter(int(self.parameter_target[p])))
        for symbol, m in zip(template.modules, modules, strict=True):
            names[symbol] = sp.Symbol(layout.module(int(self.module_target[m])))
        return names

    def _write_loop(self, loop: Loop, row: int) -> None:
        unknowns = loop.unknowns[row].tolist()
        own = [self.symbol(v) for v in unknowns]
        residuals: list[sp.Expr] = []
        for equation in loop.shape.equations:
            names = self._parameters(
                equation.template,
                loop.parameters[row][list(equation.parameters)],
                loop.modules[row][list(equation.modules)],
            )
            for symbol, code in zip(equation.template.variables, equation.variables, strict=True):
                names[symbol] = (
                    own[code] if code >= 0 else self._values[int(loop.externals[row, -1 - code])]
                )
            residuals.append(_readable(equation.template.residual.xreplace(names)))
        solved = (
            sp.solve(residuals, own, dict=True)
            if loop.shape.is_linear and len(own) <= MAX_LOOP
            else []
        )
        if solved:
            self._values.update({v: solved[0][s] for v, s in zip(unknowns, own, strict=True)})
        else:
            self._values.update(dict(zip(unknowns, own, strict=True)))
            self.implicit += [sp.Eq(r, 0, evaluate=False) for r in residuals]

    def _write_mesh(self, mesh: Mesh) -> None:
        self._values.update({v: self.symbol(v) for v in mesh.unknowns.tolist()})
        for g in mesh.groups:
            for row, own, called in zip(g.variables, g.parameters, g.modules, strict=True):
                names = self._parameters(g.template, own, called)
                slots = zip(g.template.variables, row.tolist(), strict=True)
                names |= {s: self._values[v] for s, v in slots}
                residual = _readable(g.template.residual.xreplace(names))
                self.implicit.append(sp.Eq(residual, 0, evaluate=False))
        sums = mesh.sums
        terms: dict[int, list[sp.Expr]] = {}
        for row, v, factor in zip(sums.rows, sums.nodes.tolist(), sums.factors, strict=True):
            terms.setdefault(int(row), []).append(sp.nsimplify(factor) * self._values[v])
        self.implicit += [sp.Eq(sp.Add(*parts), 0, evaluate=False) for parts in terms.values()]


def _rows(step: Step) -> Any:
    """The unknowns that are found together, row by row."""
    match step:
        case Loop():
            return step.unknowns
        case Mesh():
            return step.unknowns[None]
        case _:
            return step.unknowns[:, None]


def _readable(expression: Any) -> Any:
    """Modules as ordinary functions named by their parameter."""
    calls = {c: _function(c) for c in expression.atoms(ModuleCall)}
    return expression.xreplace(calls) if calls else expression


def _function(call: Any) -> Any:
    module, orders, *args = call.args
    plain = sp.Function(f"{module}{primes(orders)}")
    return plain(*(_readable(a) for a in args))
