"""HTML views of objects, for notebooks: a headline, tables, equations and small plots that fit light and dark pages."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from typing import Any

STYLE = """
.acausal{font:14px/1.5 system-ui,sans-serif;max-width:60rem;color:inherit}
.acausal .about{opacity:.75;margin:0 0 .5em}
.acausal h4{font-size:1.05em;margin:0 0 .1em}
.acausal table{border-collapse:collapse;font-variant-numeric:tabular-nums;margin:.3em 0 .6em;color:inherit}
.acausal th,.acausal td{padding:.15em .8em .15em 0;text-align:left;border-bottom:1px solid rgba(128,128,128,.3);
vertical-align:middle;color:inherit;background:none}
.acausal th{opacity:.75;font-weight:600}
.acausal td.number,.acausal th.number{text-align:right}
.acausal details{margin:.2em 0}.acausal summary{cursor:pointer;font-weight:600}
.acausal .wide{overflow-x:auto}.acausal math[display=block]{display:block math;width:fit-content;margin:.5em 0}
.acausal mfrac>:first-child{padding-bottom:.15em}.acausal mfrac>:last-child{padding-top:.15em}
.acausal svg{display:block;max-width:100%;height:auto}
""".replace("\n", "")
"""Colours are the page's own: a view takes text colour and background from the notebook around it."""

ROWS = 30
"""Rows of a table that are shown at most."""


class View:
    """A view under construction; every method appends to it, and ``str(view)`` is the HTML.

    Arguments:
        title: what it shows.
        about: a sentence below the title.
    """

    def __init__(self, title: str, about: str = "") -> None:
        self._parts = [f"<h4>{html.escape(title)}</h4>"]
        if about:
            self.text(about)

    def text(self, text: str) -> None:
        """A sentence."""
        self._parts.append(f'<p class="about">{html.escape(text)}</p>')

    def table(self, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
        """A table. A cell is a text, a number, or HTML as an `Html`; a column of numbers is set to the right."""
        self._parts.append(f'<div class="wide">{html_table(header, rows)}</div>')

    def html(self, content: str) -> None:
        """Something that is HTML already, such as a plot; it scrolls where it is wider than the page."""
        if content:
            self._parts.append(f'<div class="wide">{content}</div>')

    def folded(self, summary: str, content: str, *, opened: bool = False) -> None:
        """HTML below a heading that opens and closes it."""
        state = " open" if opened else ""
        self._parts.append(
            f"<details{state}><summary>{html.escape(summary)}</summary>"
            f'<div class="wide">{content}</div></details>'
        )

    def __str__(self) -> str:
        return f'<div class="acausal"><style>{STYLE}</style>{"".join(self._parts)}</div>'


class Html(str):
    """Text that is HTML already."""

    __slots__ = ()


def html_table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A ``<table>`` of at most `ROWS` rows; a last row counts the others."""
    found = list(rows)
    numbers = [bool(found) and all(_is_number(row[i]) for row in found) for i in range(len(header))]
    head = "".join(_cell("th", h, n) for h, n in zip(header, numbers, strict=True))
    lines = [f"<tr>{head}</tr>"]
    for row in found[:ROWS]:
        cells = "".join(_cell("td", value, n) for value, n in zip(row, numbers, strict=True))
        lines.append(f"<tr>{cells}</tr>")
    if len(found) > ROWS:
        lines.append(f'<tr><td colspan="{len(header)}">... and {len(found) - ROWS} more</td></tr>')
    return f"<table>{''.join(lines)}</table>"


def number(value: Any) -> str:
    """A number in few digits; None and NaN are not shown."""
    return "" if value is None or value != value else f"{float(value):.5g}"


def _is_number(value: Any) -> bool:
    return not isinstance(value, str)


def _cell(tag: str, value: Any, is_number: bool) -> str:
    kind = ' class="number"' if is_number else ""
    text = (
        value
        if isinstance(value, Html)
        else html.escape(number(value) if _is_number(value) else value)
    )
    return f"<{tag}{kind}>{text}</{tag}>"
