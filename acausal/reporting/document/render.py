"""Render what a page tells as one HTML file: no server, and nothing is loaded from anywhere."""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from itertools import count, groupby
from typing import Any

from acausal.reporting.document.content import (
    Animation,
    Block,
    Card,
    Drawing,
    EquationList,
    PageContent,
    Plot,
    Section,
    Table,
    Text,
)
from acausal.reporting.document.library import INSTALL, plot_library
from acausal.reporting.document.motion import stage, still
from acausal.reporting.document.numbers import Pool, Raw, as_json, numbers
from acausal.reporting.document.picture import colors, picture
from acausal.reporting.mathml import mathml, named, names_in
from acausal.reporting.short_names import Short, shorten, with_owners

POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"
"""What browsers may load: nothing."""

PLAIN = (
    "Plots are plain pictures here, without zoom and cursors: the plot library was not installed "
    f"when this page was written ({INSTALL})."
)
SIZE, LOW = (760, 270), (760, 150)
"""Width and height of a plain picture, in pixels, and those of a low one."""

MARKS = {True: ' class="hit"', False: ' class="miss"', None: ""}
"""Of rows of a table, by whether a target is hit."""

NUMERIC = frozenset("0123456789.+-−±%einfna ")


def render(content: PageContent, library: str | None = None) -> str:
    """The page as a text, with the plot library that is installed; an empty text stands for none."""
    found = library
    if library is None:
        found = plot_library() if content.plots else ""
    writer = _Writer(interactive=bool(found), specs=[], motions=[], pool=Pool())
    parts = [("Model", "".join(writer.model(content)))] if content.cards else []
    for tab in content.tabs:
        parts.append((tab.title, "".join(writer.section(s, "h2") for s in tab.sections)))
    tabs = [
        f'<section role="tabpanel" id="part{i}" aria-labelledby="tab{i}"{" hidden" if i else ""}>{part}</section>'
        for i, (_, part) in enumerate(parts)
    ]
    buttons = "".join(
        f'<button type="button" role="tab" id="tab{i}" aria-controls="part{i}" '
        f'aria-selected="{str(i == 0).lower()}" tabindex="{0 if i == 0 else -1}">{_safe(t)}</button>'
        for i, (t, _) in enumerate(parts)
    )
    alone = " hidden" if len(parts) == 1 and not content.cards else ""
    first = content.cards[0].path if content.cards else ""
    told = {
        "arrays": writer.pool.written(),
        "plots": writer.specs,
        "motions": writer.motions,
        "first": first,
    }
    lead = f'<p class="lead">{_safe(content.lead)}</p>' if content.lead else ""
    note = "" if found or not content.plots else f'<p class="note">{_safe(PLAIN)}</p>'
    return "".join(
        (
            '<!doctype html><html lang="en"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
            f'<title>{_safe(content.title)}</title><link rel="icon" href="data:,">',
            f"<style>{_own('page.css')}</style></head><body>",
            f"<header><div><h1>{_safe(content.title)}</h1>{lead}{note}</div>",
            '<button type="button" id="theme" aria-label="Light or dark">◐</button></header>',
            f'<nav role="tablist" aria-label="Parts of the page"{alone}>{buttons}</nav>',
            f"<main>{''.join(tabs)}</main>",
            f"<footer>{_safe(content.footer)}</footer>" if content.footer else "",
            f'<script type="application/json" id="data">{as_json(told)}</script>',
            f"<script>{_in_script(found)}</script>" if found else "",
            f"<script>{_in_script(_own('page.js'))}</script></body></html>",
        )
    )


@dataclass(frozen=True)
class _Writer:
    """Writes blocks as HTML, and collects the plots for the script."""

    interactive: bool
    specs: list[dict[str, Any]]
    motions: list[dict[str, Any]]
    pool: Pool
    serial: Iterable[int] = field(default_factory=count)

    def model(self, content: PageContent) -> Iterable[str]:
        """The schematic, the names of the components and their cards."""
        yield _schematic(content.schematic)
        if len(content.cards) > 1:
            yield '<p class="note">Click a component: its equations, parameters and trajectories appear below.</p>'
        chips = "".join(map(_chip, content.cards))
        yield f'<ul class="chooser" aria-label="Components">{chips}</ul>'
        yield from map(self.card, content.cards)

    def card(self, card: Card) -> str:
        inside = "".join(self.section(s, "h3") for s in card.sections)
        about = f'<p class="lead">{_prose(card.doc)}</p>' if card.doc else ""
        return (
            f'<article class="card" data-card="{_safe(card.path)}" hidden><h2>{_safe(card.path or "the model")} '
            f"<small>{_safe(card.kind)}</small></h2>{about}{_schematic(card.schematic)}{inside}</article>"
        )

    def section(self, section: Section, level: str) -> str:
        heading = f"<{level}>{_safe(section.title)}</{level}>" if section.title else ""
        runs = groupby(section.blocks, key=lambda b: isinstance(b, Plot) and level == "h3")
        parts = (("".join(map(self.block, run)), beside) for beside, run in runs)
        return heading + "".join(f'<div class="plots">{p}</div>' if b else p for p, b in parts)

    def block(self, block: Block) -> str:
        match block:
            case Text():
                return f"<p>{_prose(block.text)}</p>"
            case Table():
                return _table(block)
            case EquationList():
                return f'<div class="equations">{"".join(_equations(block))}</div>'
            case Drawing():
                caption = f"<figcaption>{_prose(block.caption)}</figcaption>"
                return f"<figure>{_drawn(block)}{caption}</figure>"
            case Plot():
                return self.plot(block)
            case Animation():
                return self.animation(block)

    def animation(self, block: Animation) -> str:
        """A still frame; the script of the page sets it in motion."""
        self.motions.append(
            {
                "time": self.pool.add(block.time, fine=True),
                "trace": block.trace,
                "mark": stage(block).mark,
                "shapes": [
                    {
                        "name": one.name,
                        "traced": one.traced,
                        "pose": [
                            self.pool.add(v, fine=True)
                            for v in (one.x, one.y, one.phi, one.along, one.across)
                        ],
                    }
                    for one in block.shapes
                ],
            }
        )
        caption = f"<figcaption>{_prose(block.caption)}</figcaption>"
        return f'<figure class="motion" data-motion="{len(self.motions) - 1}">{still(block, 0)}{caption}</figure>'

    def plot(self, plot: Plot) -> str:
        caption = f"<figcaption>{_prose(plot.caption)}</figcaption>"
        if not self.interactive:
            keys = "".join(
                f'<span class="key {color}">{_safe(c.label)}</span>'
                for c, (color, _) in zip(plot.curves, colors(plot.curves), strict=True)
            )
            drawn = picture(plot, LOW if plot.low else SIZE)
            return f'<figure class="plot"><div class="bar">{keys}</div>{drawn}{caption}</figure>'
        self.specs.append(
            {
                "caption": plot.caption,
                "xlabel": plot.xlabel,
                "ylabel": plot.ylabel,
                "group": plot.group,
                "guides": plot.guides,
                "trusted": plot.trusted,
                "samples": Raw(numbers(plot.samples, 5)),
                "limits": plot.limits,
                "log": plot.log,
                "low": plot.low,
                "curves": [
                    {
                        "label": curve.label,
                        "color": color,
                        "x": self.pool.add(curve.x, fine=True),
                        "y": self.pool.add(curve.y),
                        "sigma": self.pool.add(curve.sigma),
                        "band": [self.pool.add(end) for end in curve.band or ()],
                        "dots": curve.dots,
                        "steps": curve.steps,
                    }
                    for curve, (color, _) in zip(plot.curves, colors(plot.curves), strict=True)
                ],
            }
        )
        return f'<figure class="plot" data-plot="{len(self.specs) - 1}">{caption}</figure>'


def _equations(block: EquationList) -> Iterable[str]:
    shortest = {} if block.names is None else _shortest(block.equations, block.names)
    for equation in block.equations:
        if isinstance(equation, str):
            yield f"<code>{_safe(equation)}</code>"
        elif block.names is None:
            yield mathml(*equation, with_owners(names_in([equation])))
        else:
            yield mathml(*equation, named(shortest))


def _shortest(
    equations: Iterable[tuple[Any, Any] | str], given: Mapping[str, str]
) -> dict[str, Short]:
    """The shortest names that tell all apart, and those that are given."""
    chosen = {name: Short.of(other) for name, other in given.items()}
    names = names_in([e for e in equations if not isinstance(e, str)])
    return shorten(n for n in names if n not in chosen) | chosen


def _drawn(drawing: Drawing) -> str:
    """SVG as it is, or a PNG within the page."""
    if isinstance(drawing.drawn, str):
        return drawing.drawn
    data = base64.b64encode(drawing.drawn).decode()
    return f'<img alt="{_safe(drawing.caption)}" src="data:image/png;base64,{data}">'


def _schematic(svg: str) -> str:
    """A drawing, which a narrow window scales down a little and then scrolls."""
    if not svg:
        return ""
    found = re.search(r'<svg[^>]*? width="([\d.]+)"', svg)
    natural = f' style="--natural:{found[1]}px"' if found else ""
    return f'<div class="schematic"{natural}>{svg}</div>'


def _chip(card: Card) -> str:
    """A button with which a component is chosen."""
    kind = ' class="learns"' if card.learns else ""
    return (
        f'<li><button type="button" data-component="{_safe(card.path)}" title="{_safe(card.kind)}"{kind}>'
        f"{_safe(card.path or 'the model')}</button></li>"
    )


def _table(table: Table) -> str:
    columns = list(zip(*table.rows, strict=True)) if table.rows else [()] * len(table.header)
    kinds = [' class="number"' if _is_numeric(column) else "" for column in columns]

    def row(cells: Iterable[str], tag: str, mark: str = "") -> str:
        pairs = zip(cells, kinds, strict=True)
        return f"<tr{mark}>{''.join(f'<{tag}{kind}>{_safe(c)}</{tag}>' for c, kind in pairs)}</tr>"

    marks = (MARKS[hit] for hit in table.passed)
    body = "".join(row(cells, "td", next(marks, "")) for cells in table.rows)
    return f'<div class="scroll"><table>{row(table.header, "th")}{body}</table></div>'


def _is_numeric(column: Iterable[str]) -> bool:
    cells = [c for c in column if c]
    return bool(cells) and all(set(c) <= NUMERIC for c in cells)


def _in_script(text: str) -> str:
    """A script that cannot end the element that it stands in."""
    return text.replace("</script", "<\\/script").replace("<!--", "<\\!--")


def _own(name: str) -> str:
    return (files("acausal.reporting.document") / name).read_text(encoding="utf-8")


def _prose(text: str) -> str:
    """A text in which what stands between double backticks is code."""
    parts = _safe(text).split("``")
    return "".join(f"<code>{p}</code>" if i % 2 else p for i, p in enumerate(parts))


def _safe(text: str) -> str:
    return html.escape(text, quote=True)
