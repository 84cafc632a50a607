"""The view of a compiled model: its equations in short names, its diagram, and what the names mean."""

from __future__ import annotations

import html
import inspect
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import sympy as sp

from acausal.drawing import diagram_svg
from acausal.errors import cut_short
from acausal.modeling import Component, sections, unit_and_doc, value_text
from acausal.reporting.mathml import latex, mathml, name_as_mathml, named, names_in
from acausal.reporting.short_names import Short, shorten
from acausal.reporting.view import Html, View, html_table

MOST_EQUATIONS = 40
"""Models of more differential equations are shown without them."""

MOST_OPERATIONS = 120
"""A longer right-hand side is not written out."""


class Quantity(NamedTuple):
    """A named quantity of a model.

    Attributes:
        name: dotted. value: of a parameter, or the start of a state; None for an input or a network.
    """

    name: str
    unit: str
    value: float | None
    doc: str


def system_view(
    model: Component,
    title: str,
    about: str,
    equations: Sequence[sp.Equality],
    quantities: Mapping[str, Sequence[Quantity]],
) -> str:
    """HTML that shows a compiled model, with its name and a sentence.

    There are no explicit equations where they are too many to show. Quantities come by heading: states, inputs,
    parameters, networks.
    """
    known = [quantity.name for group in quantities.values() for quantity in group]
    names = shorten([*known, *names_in((e.lhs, e.rhs) for e in equations)])
    view = View(title, about)
    if equations:
        written = "".join(_equation(e, names) for e in equations)
        view.folded(f"Equations ({len(equations)})", written, opened=True)
    drawing = diagram_svg(model)
    if drawing:
        view.folded("Diagram", drawing, opened=True)
    for heading, group in quantities.items():
        if group:
            content = _table(heading, group, names if equations else {})
            view.folded(f"{heading} ({len(group)})", content, opened=heading == "States")
    return str(view)


class Formulas(tuple[sp.Equality, ...]):
    """Equations of sympy that show as formulas, at the prompt and in a notebook."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "\n".join(cut_short(self, MOST_EQUATIONS, lambda e: f"{_left(e.lhs)} = {e.rhs}"))

    def _repr_html_(self) -> str:
        naming = named(shorten(names_in((e.lhs, e.rhs) for e in self)))
        view = View(f"Equations ({len(self)})")
        for equation in self[:MOST_EQUATIONS]:
            view.html(mathml(equation.lhs, equation.rhs, naming))
        return str(view)


def _left(side: Any) -> str:
    return f"der({side.expr})" if isinstance(side, sp.Derivative) else str(side)


def component_view(component: Component) -> str:
    """HTML of a component that is not compiled: its picture, parts, and what it declares with values and units."""
    node, doc = component._node, inspect.cleandoc(type(component).__doc__ or "")
    view = View(node.label, " ".join(doc.partition("\n\n")[0].split()).replace("``", ""))
    view.html(diagram_svg(component))
    for title, members in sections(dict(node.declarations())):
        rows = [(name, value_text(node, name, d), *unit_and_doc(d)) for name, d in members.items()]
        content = html_table(("name", "value", "unit", ""), rows)
        view.folded(f"{title} ({len(rows)})", content, opened=title == "Parameters")
    if node.children:
        parts = [(name, type(part).__name__) for name, part in node.children.items()]
        view.folded(f"Parts ({len(parts)})", html_table(("name", "class"), parts), opened=True)
    return str(view)


def equations_as_latex(equations: Sequence[sp.Equality]) -> str:
    """The equations in one block of LaTeX, with short names."""
    naming = named(shorten(names_in((e.lhs, e.rhs) for e in equations)))
    rows = [f"{latex(e.lhs, naming)} &= {latex(e.rhs, naming)}" for e in equations]
    return "$$\\begin{aligned}" + " \\\\ ".join(rows) + "\\end{aligned}$$"


def _equation(equation: Any, names: Mapping[str, Short]) -> str:
    operations = int(sp.count_ops(equation.rhs))
    if operations <= MOST_OPERATIONS or not isinstance(equation.lhs, sp.Derivative):
        return mathml(equation.lhs, equation.rhs, named(names))
    text = f" = ... ({operations} operations; see system.equations)"
    state: Any = equation.lhs.expr
    left = name_as_mathml(names[state.name].differentiated())
    return f"<p>{left}{html.escape(text)}</p>"


def _table(heading: str, group: Sequence[Quantity], names: Mapping[str, Short]) -> str:
    value = {"States": "start", "Parameters": "value"}.get(heading)
    header = (*(["symbol"] if names else []), "name", *([value] if value else []), "unit", "")
    rows = (
        (
            *([Html(name_as_mathml(names[q.name]))] if names else []),
            q.name,
            *([q.value] if value else []),
            q.unit,
            q.doc,
        )
        for q in group
    )
    return html_table(header, rows)
