"""Check: the units of a flat model.

Each template is checked once, however many instances it has, with the units of the variables and parameters that fill
its slots. Values and starts given by expressions are checked, too, and connected signals.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import UnitError, shortened, shown, warn
from acausal.flattening import (
    HIDDEN,
    Binding,
    EquationGroup,
    FlatModel,
    Integers,
    Layout,
    Statement,
    Template,
    tiled,
)
from acausal.modeling import Declaration, Module
from acausal.units.dimensions import NUMBER, SECOND, Dimension, described, dimension
from acausal.units.infer import Finding, Signature, SlotDimensions, examine, is_small

MAX_LISTED = 12
TICKS = re.compile(rf"pre\({HIDDEN}\[\d+\]\)")
"""How often a clock has ticked."""


def check_dimensions(flat: FlatModel) -> None:
    """Refuse a model that adds, compares or equates quantities of unlike dimensions.

    A variable or parameter without a unit agrees with everything. Where the model's class says that units are not
    binding, as the language of Modelica does, there is a warning instead.

    Raises:
        UnitError: for text that is not a unit; for equations, values and connections of unlike dimensions. It names
            the components, the equations as they are written, and the unlike terms in them, at most a dozen.
    """
    _report(flat, [*_misspelt(flat.layout)])
    measures = _measure(flat)
    wrong = [*_equations(flat, measures)]
    wrong += _values(
        flat.bindings, measures.parameters, flat.layout.parameter, flat.layout, measures
    )
    wrong += _values(flat.starts, measures.variables, flat.layout.variable, flat.layout, measures)
    wrong += _joins(flat, measures)
    _report(flat, wrong)


def _report(flat: FlatModel, wrong: Sequence[str]) -> None:
    if wrong and not flat.layout.components[0]._units_bind:
        warn(_listed(wrong))
    elif wrong:
        raise UnitError(_listed(wrong))


def _listed(wrong: Sequence[str]) -> str:
    if len(wrong) == 1:
        return wrong[0]
    listed = " ".join(f"({i}) {w}" for i, w in enumerate(wrong[:MAX_LISTED], start=1))
    more = f" and {len(wrong) - MAX_LISTED} more" if len(wrong) > MAX_LISTED else ""
    return f"{len(wrong)} units are wrong: {listed}{more}"


# -- dimensions of variables, parameters and modules --------------------------------------------------


@dataclass(frozen=True)
class _Measures:
    """The dimensions of a model.

    Attributes:
        known: those that occur; the first is None, unknown.
        variables, parameters: for each, the index of its dimension in ``known``.
        modules: for each, the dimensions of its arguments and its result.
    """

    known: tuple[Dimension | None, ...]
    variables: Integers
    parameters: Integers
    modules: tuple[Signature, ...]


def _declarations(layout: Layout) -> Iterator[tuple[str, Declaration]]:
    for form in layout.forms:
        where = form.prototype._node.label
        for path, declaration in (*form.variables, *form.parameters, *form.modules):
            yield f"{where}.{path}", declaration


def _misspelt(layout: Layout) -> Iterator[str]:
    for name, declaration in _declarations(layout):
        takes = declaration.takes if isinstance(declaration, Module) else ()
        for unit in (declaration.unit, *takes):
            if not isinstance(unit, str):
                yield f"{name}: {shown(unit)} is not a unit; a text is needed"
                continue
            try:
                dimension(unit)
            except UnitError as e:
                yield f"{name}: {e}"


def _measure(flat: FlatModel) -> _Measures:
    layout = flat.layout
    indices: dict[Dimension | None, int] = {None: 0}

    def index(declaration: Declaration) -> int:
        return indices.setdefault(_dimension(declaration.unit), len(indices))

    variables = [[index(d) for _, d in form.variables] for form in layout.forms]
    parameters = [[index(d) for _, d in form.parameters] for form in layout.forms]
    modules = [
        [Signature(tuple(map(_dimension, d.takes)), _dimension(d.unit)) for _, d in form.modules]
        for form in layout.forms
    ]
    declared = tiled(layout, layout.parameter_base, parameters, np.int64)
    constants = np.zeros(len(flat.value) - flat.n_parameters, np.int64)
    return _Measures(
        variables=tiled(layout, layout.variable_base, variables, np.int64),
        parameters=np.concatenate([declared, constants]),
        modules=tuple(s for form in layout.form_of for s in modules[form]),
        known=tuple(indices),
    )


def _dimension(unit: str) -> Dimension | None:
    """The dimension of a unit; of one that is not known, where that is no more than a warning, None."""
    try:
        return dimension(unit)
    except UnitError:
        return None


# -- equations -----------------------------------------------------------------------------------------


def _equations(flat: FlatModel, measures: _Measures) -> Iterator[str]:
    found: dict[tuple[str, str], list[str]] = {}
    asserted = (one.group for one in flat.assertions)
    for stated in (*flat.equations(initial=True), *asserted):
        if stated.components[0] < 0 or _counts_ticks(stated):  # a connection
            continue
        group = _with_numbers(flat, stated, least=True)
        if examine(group.template.residual, _slots(group, measures)) is None:
            continue
        group = _with_numbers(flat, stated, least=False)
        slots = _slots(group, measures)
        finding = examine(group.template.residual, slots)
        if finding is not None:
            origin = group.origins[0]
            hint = _hint(group.template, slots, finding)
            reason = TICKS.sub("k", finding.reason)
            wrong = f"'{shortened(origin.text)}': {reason}{hint}"
            names = [flat.layout.paths[i] for i in group.components]
            found.setdefault((origin.cls, wrong), []).extend(names)
    for (cls, wrong), names in found.items():
        first = f"{cls} '{names[0]}'" if names[0] else cls
        more = f" and {len(names) - 1} more" if len(names) > 1 else ""
        yield f"{first}{more}: {wrong}"


def _counts_ticks(group: EquationGroup) -> bool:
    """Whether this counts the ticks of a clock, whose condition has its times."""
    first = str(group.template.variables[0]) if group.template.variables else ""
    return first.startswith(f"new {HIDDEN}") and group.origins[0].text.startswith("sample(")


def _with_numbers(flat: FlatModel, group: EquationGroup, least: bool) -> EquationGroup:
    """The group with its constants as numbers; with the ``least`` of them where others may have any dimension.

    Only a small number is a pure number. Without the others many groups have one residual, which is examined once.
    """
    template, values = group.template, flat.value[group.parameters[0]].tolist()
    constant = (group.parameters[0] >= flat.n_parameters).tolist()
    slots = zip(template.parameters, values, constant, strict=True)
    numbers = {symbol: sp.Float(value) for symbol, value, is_number in slots if is_number}
    numbers = {s: n for s, n in numbers.items() if not least or is_small(n)}
    if not numbers or not isinstance(template, Template):
        return group
    kept = [i for i, s in enumerate(template.parameters) if s not in numbers]
    plain = replace(
        template,
        residual=template.residual.xreplace(numbers),
        parameters=tuple(template.parameters[i] for i in kept),
    )
    return replace(group, template=plain, parameters=group.parameters[:, kept])


def _slots(group: EquationGroup, measures: _Measures) -> SlotDimensions:
    """The slots of a template with their dimensions; all instances of a group have the same units."""
    template = group.template
    slots: list[tuple[sp.Symbol, Dimension | Signature | None]] = []
    row = measures.variables[group.variables[0]]
    for symbol, order, index in zip(template.variables, template.orders, row, strict=True):
        known = measures.known[index]
        slots.append((symbol, known / SECOND**order if known is not None and order else known))
    row = measures.parameters[group.parameters[0]]
    slots += [(s, measures.known[i]) for s, i in zip(template.parameters, row, strict=True)]
    modules = zip(template.modules, group.modules[0], strict=True)
    slots += [(s, measures.modules[i]) for s, i in modules]
    return tuple(slots)


def _hint(template: Statement, slots: SlotDimensions, finding: Finding) -> str:
    """A likely remedy for the equation: another unit of a parameter, or a derivative."""
    own = [(s, d) for s, d in slots if s in template.parameters and "." not in str(s)]
    found: list[str] = []
    if finding.excess.exponents == NUMBER.exponents:
        return "; equations do not convert units: declare both in one, or write the conversion as a number"
    for (symbol, given), power in product(own, (1, -1)):
        if not isinstance(given, Dimension):
            continue
        meant = given * finding.excess**power
        if examine(template.residual, tuple({**dict(slots), symbol: meant}.items())) is None:
            found = [f"should '{symbol}' be in {described(meant)}"]
            break
    if finding.excess.exponents in (SECOND.exponents, (SECOND**-1).exponents):
        found.append("is a der(...) missing or one too many")
    return f"; {', or '.join(found)}?" if found else ""


# -- values and connections ----------------------------------------------------------------------------


def _values(
    bindings: Sequence[Binding],
    targets: Integers,
    name: Callable[[int], str],
    layout: Layout,
    measures: _Measures,
) -> Iterator[str]:
    """Parameters or starts given by expressions of parameters; equal ones are checked once."""
    right: set[tuple[Any, ...]] = set()
    for binding in bindings:
        arguments = measures.parameters[list(binding.arguments)].tolist()
        key = binding.expression, int(targets[binding.target]), *arguments
        if key in right:
            continue
        names = [sp.Symbol(layout.parameter(i)) for i in binding.arguments]
        value = binding.expression.xreplace(dict(zip(binding.symbols, names, strict=True)))
        target = sp.Symbol(name(binding.target))
        slots = zip((target, *names), (measures.known[i] for i in key[1:]), strict=True)
        finding = examine(target - value, tuple(slots))
        if finding is None:
            right.add(key)
        else:
            yield f"'{target} = {shortened(str(value))}': {finding.reason}"


def _joins(flat: FlatModel, measures: _Measures) -> Iterator[str]:
    """Signals that are connected (connected connectors are of one kind, with the same units)."""
    least = np.full(flat.n_variables, len(measures.known))
    greatest = np.zeros(flat.n_variables, dtype=np.int64)
    joined = [g.variables for g in flat.groups if g.components[0] < 0]
    for variables in joined:
        index = measures.variables[variables]
        node = variables[:, 0]
        np.minimum.at(least, node, np.where(index > 0, index, len(measures.known)).min(axis=1))
        np.maximum.at(greatest, node, index.max(axis=1))
    for node in np.flatnonzero(least < greatest):
        members = np.unique(np.concatenate([v[v[:, 0] == node].ravel() for v in joined]))
        first: dict[Dimension, str] = {}
        for member in members:
            known = measures.known[measures.variables[member]]
            if known is not None:
                first.setdefault(
                    known, f"'{flat.layout.variable(int(member))}' in {described(known)}"
                )
        one, *others = first
        if not all(one.agrees(other) and one.is_on_scale_of(other) for other in others):
            yield f"{' and '.join(first.values())} are connected"
