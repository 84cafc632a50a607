"""Where parameters lie at run time: few arrays, in which equal parameters of equal components are neighbours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp
from jaxtyping import Float

from acausal.codegen.gather import Gather, gather
from acausal.codegen.instructions import Arguments, ArrayFormula
from acausal.errors import DataError, DeclarationError, listing, nearest
from acausal.flattening import Binding, FlatModel, Integers, LeavesCaches, binding_levels
from acausal.modeling import names_in


@dataclass(frozen=True, eq=False)
class ParameterLayout(LeavesCaches):
    """Where every parameter lies in `Packed`.

    Attributes:
        free: parameters that the user may change, in order of declaration.
        order: position of every free parameter in the vector, so that equal ones are neighbours.
        position: (n_parameters,) of a parameter in ``Packed.values`` (-1: folded).
        bound: those of bound parameters, in order of computation: array 0 holds the free parameters, array 1 + i the
            values of the i-th formula.
        constants: numbers of equations, which follow in ``Packed.values``.
        module_of: (n_modules,) the module that a module refers to, or itself.
    """

    model: FlatModel
    free: Integers
    order: Integers
    position: Integers
    bound: tuple[ArrayFormula, ...]
    constants: np.ndarray
    module_of: Integers

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the free parameters."""
        return tuple(self.model.layout.parameter(int(i)) for i in self.free)

    @cached_property
    def module_names(self) -> tuple[str, ...]:
        """Names of the modules that are not references to others, and that are parameters."""
        return tuple(self.model.layout.module(int(i)) for i in self.own_modules)

    @cached_property
    def all_names(self) -> frozenset[str]:
        """The names of both."""
        return frozenset((*self.names, *self.module_names))

    @cached_property
    def own_modules(self) -> list[int]:
        """The modules that are not references to others, and that are parameters."""
        fixed = self.fixed_modules
        return [i for i, m in enumerate(self.module_of) if m == i and i not in fixed]

    @cached_property
    def fixed_modules(self) -> dict[int, Any]:
        """Modules that are a part of the model and no parameters, as they say by ``is_fixed``: those of FMUs."""
        values = enumerate(self.model.module_values)
        return {i: value for i, value in values if getattr(value, "is_fixed", False)}

    def check_names(self, params: Mapping[str, Any]) -> None:
        """Refuse unknown names.

        Raises:
            DataError: that names the first.
        """
        if self.all_names.issuperset(params):
            return
        for name in names_in(params, "params"):
            if name not in self.all_names:
                reason = self.why_not_free(name)
                if reason is None:
                    hint = nearest(name, [*self.names, *self.module_names])
                    reason = f"the model has no parameter '{name}'; {hint}"
                raise DataError(f"params: {reason}")

    def need_modules(self, params: Mapping[str, Any]) -> None:
        """Refuse parameters without all networks, where fresh ones in their places would be taken for trained ones.

        Raises:
            DataError: that names them.
        """
        missing = [name for name in self.module_names if name not in params]
        if missing:
            raise DataError(f"params lacks {listing(missing)}; start from system.parameters(key)")

    def range_of(self, name: str) -> tuple[float, float]:
        """The least and the largest value of a free parameter, infinite where none is declared."""
        i = self.names.index(name)
        low, high = self._ranges
        return float(low[i]), float(high[i])

    def out_of_range(self, values: np.ndarray) -> str | None:
        """A clause on values of the free parameters, nan where one is not known, outside of their declared ranges.

        None if there are none; the model's own count as inside.
        """
        low, high = self._ranges
        outside = ((values < low) | (values > high)) & (values != self.model.value[self.free])
        if not outside.any():
            return None
        first, *others = np.flatnonzero(outside).tolist()
        value, unit = values[first], self.model.layout.parameter_declaration(self.free[first]).unit
        limit = f"at least {low[first]:g}" if value < low[first] else f"at most {high[first]:g}"
        clause = f"'{self.names[first]}' is {value:g}, but must be {limit} {unit}".rstrip()
        if not others:
            return clause
        also = listing(self.names[i] for i in others)
        return f"{clause}; {also} {'is' if len(others) == 1 else 'are'} out of range, too"

    @cached_property
    def _ranges(self) -> tuple[np.ndarray, np.ndarray]:
        """The least and the largest value of every free parameter."""
        declared = [self.model.layout.parameter_declaration(int(i)) for i in self.free]
        low = [-np.inf if d.min is None else d.min for d in declared]
        return np.asarray(low), np.asarray([np.inf if d.max is None else d.max for d in declared])

    def why_not_free(self, name: str) -> str | None:
        """A clause on a parameter of the model that cannot be changed; None for any other name."""
        index = self.model.layout.find_parameter(name)
        if index is None or name in self.names:
            return None
        if self.model.folded[index]:
            return (
                f"'{name}' was left at its default of zero and is folded out of the equations; "
                "give it where the component is made (0.0 will do) to keep it adjustable"
            )
        arguments = {b.target: b.arguments for b in self.model.bindings}
        reached = [index]
        for i in reached:
            reached += [a for a in arguments.get(i, ()) if a not in reached]
        sources = [self.model.layout.parameter(i) for i in reached if i not in arguments]
        return f"'{name}' is bound to an expression; change {listing(sources)} in its place"

    def by_number(self, values: Float[np.ndarray, " size"]) -> Float[np.ndarray, " n_values"]:
        """What lies in ``Packed.values`` by the numbers of parameters, those that are folded zero, and of constants."""
        return np.append(values, 0.0)[self.position]

    def gather(self, parameters: Integers) -> Gather:
        """How to read some parameters out of ``Packed.values``, and a zero behind it for those that are folded."""
        position = self.position[parameters]
        n = int(self.position.max(initial=-1)) + 1
        return gather((position < 0).astype(np.int64), np.maximum(position, 0), [n, 1])

    def depending(self, names: Sequence[str]) -> tuple[int, ...]:
        """Where some free parameters, and all that are bound to them, lie in ``Packed.values``."""
        sizes = [len(self.free), *(group.size for group in self.bound)]
        offsets = np.cumsum([0, *sizes])
        moved = np.zeros(offsets[-1], dtype=bool)
        own = self.free[[self.names.index(n) for n in names]] if names else []
        moved[self.position[own]] = True
        for group, offset in zip(self.bound, offsets[1:], strict=False):
            for _, argument in group.arguments.variables:
                source, index = argument.positions(sizes)
                moved[offset : offset + group.size] |= moved[offsets[source] + index]
        return tuple(np.flatnonzero(moved).tolist())

    @property
    def size(self) -> int:
        """The length of ``Packed.values``."""
        return len(self.free) + sum(group.size for group in self.bound) + len(self.constants)

    @cached_property
    def name_at(self) -> dict[int, str]:
        """By position in ``Packed.values`` the parameter that lies there."""
        n = self.model.n_parameters
        own = np.flatnonzero(self.model.parameter_aliases[:n] == np.arange(n))
        return {int(self.position[p]): self.model.layout.parameter(int(p)) for p in own}

    def symbol(self, position: int) -> sp.Expr:
        """What lies at a position in ``Packed.values``: a parameter by name, or a constant's number."""
        name = self.name_at.get(position)
        if name is not None:
            return sp.Symbol(name)
        return sp.Float(self.constants[position - self.size])

    def chosen(self, modules: Integers) -> tuple[int, ...]:
        """The modules that a column of module slots refers to."""
        return tuple(int(m) for m in self.module_of[modules])


def lay_out_parameters(model: FlatModel) -> ParameterLayout:
    """Decide which parameters are free and in which order all lie.

    Raises:
        DeclarationError: if parameters are bound in a circle.
    """
    target = model.parameter_aliases
    n = len(model.value)
    bound = np.zeros(n, dtype=bool)
    bound[[b.target for b in model.bindings]] = True
    free = np.flatnonzero((~bound & ~model.folded)[: model.n_parameters])
    rank = np.lexsort((free, *_kind(model, free)))
    source, index, position = (np.full(n, -1, dtype=np.int64) for _ in range(3))
    source[free] = 0
    index[free[rank]] = position[free[rank]] = np.arange(len(free))
    groups, sizes = list[ArrayFormula](), [len(free)]
    levels, circular = binding_levels(
        [b for b in model.bindings if target[b.target] == b.target and not model.folded[b.target]],
        target,
    )
    if circular:
        names = [model.layout.parameter(b.target) for b in circular]
        raise DeclarationError(
            f"parameters are bound in a circle: {listing(names)}; give one a number"
        )
    for ready in levels:
        for expression, members in _by_expression(ready, model, target):
            columns = np.asarray([[target[a] for a in b.arguments] for b in members]).T
            arguments = tuple(
                (s, gather(source[column], index[column], sizes))
                for s, column in zip(members[0].symbols, columns, strict=True)
            )
            groups.append(ArrayFormula(expression, Arguments(arguments), len(members)))
            own = [b.target for b in members]
            source[own], index[own] = len(groups), np.arange(len(members))
            position[own] = sum(sizes) + index[own]
            sizes.append(len(members))
    constants = model.value[model.n_parameters :]
    position[model.n_parameters :] = sum(sizes) + np.arange(len(constants))
    position = position[target]
    modules = _module_targets(model)
    return ParameterLayout(model, free, rank, position, tuple(groups), constants, modules)


def _kind(model: FlatModel, free: Integers) -> tuple[Integers, Integers]:
    """Sort keys (minor, major): local parameter, form of the component."""
    layout = model.layout
    component = np.searchsorted(layout.parameter_base, free, side="right") - 1
    return free - layout.parameter_base[component], layout.form_of[component]


def _by_expression(
    bindings: list[Binding], model: FlatModel, target: Integers
) -> list[tuple[sp.Expr, list[Binding]]]:
    found: dict[tuple[sp.Expr, tuple[sp.Symbol, ...]], list[Binding]] = {}
    for binding in bindings:
        zeros = {
            s: sp.S.Zero
            for s, a in zip(binding.symbols, binding.arguments, strict=True)
            if model.folded[target[a]]
        }
        expression: Any = binding.expression.xreplace(zeros)
        if expression.has(sp.zoo, sp.nan, sp.oo):
            name = model.layout.parameter(binding.target)
            raise DeclarationError(f"'{name}': its expression divides by a parameter that is zero")
        # without zeros, expressions of unlike arguments can be the same
        given = zip(binding.symbols, binding.arguments, strict=True)
        kept = [(s, a) for s, a in given if s in expression.free_symbols]
        symbols, arguments = tuple(s for s, _ in kept), tuple(a for _, a in kept)
        own = Binding(binding.target, expression, symbols, arguments)
        found.setdefault((expression, symbols), []).append(own)
    return [(expression, members) for (expression, _), members in found.items()]


def _module_targets(model: FlatModel) -> Integers:
    target: list[int] = []
    for i, value in enumerate(model.module_values):
        passed = [i]
        while isinstance(value, int):
            if value in passed:
                raise DeclarationError(
                    f"networks are given by each other in a circle: {listing(map(model.layout.module, passed))}; "
                    "give one a module"
                )
            passed.append(value)
            value = model.module_values[value]
        target.append(passed[-1])
    return np.asarray(target, dtype=np.int64)
