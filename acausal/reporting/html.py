"""Self-contained HTML pages: text, tables, equations and figures in one file that can be sent to others."""

from __future__ import annotations

import base64
import html
import io
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import sympy as sp

from acausal.files import need_path, write_files
from acausal.reporting.mathml import mathml, named, names_in
from acausal.reporting.short_names import Short, shorten

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STYLE = """
:root { --ink: #1d2733; --soft: #5b6875; --line: #d9e0e7; --accent: #1f5c99; }
body { font: 16px/1.55 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; color: var(--ink);
       max-width: 62rem; margin: 2.5rem auto; padding: 0 1.25rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin-bottom: .3rem; }
h2 { font-size: 1.3rem; margin: 2.4rem 0 .6rem; padding-top: .6rem; border-top: 1px solid var(--line); }
p { margin: .6rem 0; max-width: 46rem; } .lead { color: var(--soft); font-size: 1.08rem; }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .35rem .9rem; border-bottom: 1px solid var(--line); text-align: right; }
th:first-child, td:first-child { text-align: left; } th { color: var(--soft); font-weight: 600; }
tr.hit td:last-child::before { content: "\\2713\\00a0"; color: #2e7d43; }
tr.miss td:last-child::before { content: "\\2717\\00a0"; color: #b0413e; }
figure { margin: 1.2rem 0; } figure img, figure svg { max-width: 100%; }
figcaption { color: var(--soft); font-size: .92rem; max-width: 46rem; }
.equations { overflow-x: auto; background: #f7f9fb; border-left: 3px solid var(--accent); padding: .6rem 1rem; }
.equations math { display: block; margin: .7rem 0; font-size: 1.08rem; text-align: left; }
footer { margin-top: 3rem; padding-top: .6rem; color: var(--soft); font-size: .85rem;
         border-top: 1px solid var(--line); }
"""


class Page:
    """An HTML page under construction; every method appends to it.

    Arguments:
        title: headline of the page. lead: a sentence or two below it.
    """

    def __init__(self, title: str, lead: str = "") -> None:
        self.title = title
        self._body = [f"<h1>{html.escape(title)}</h1>"]
        if lead:
            self._body.append(f'<p class="lead">{html.escape(lead)}</p>')

    def section(self, title: str) -> None:
        """A heading."""
        self._body.append(f"<h2>{html.escape(title)}</h2>")

    def text(self, text: str) -> None:
        """A paragraph."""
        self._body.append(f"<p>{html.escape(text)}</p>")

    def table(
        self,
        header: Sequence[str],
        rows: Iterable[Sequence[Any]],
        passed: Sequence[bool | None] | None = None,
    ) -> None:
        """A table; ``passed`` marks rows as a target hit (True) or missed (False)."""
        marks = {True: ' class="hit"', False: ' class="miss"', None: ""}
        lines = [f"<tr>{''.join(f'<th>{html.escape(str(h))}</th>' for h in header)}</tr>"]
        for number, row in enumerate(rows):
            mark = marks[passed[number]] if passed else ""
            lines.append(
                f"<tr{mark}>{''.join(f'<td>{html.escape(str(c))}</td>' for c in row)}</tr>"
            )
        self._body.append(f"<table>{''.join(lines)}</table>")

    def equations(
        self, equations: Sequence[sp.Equality], names: Mapping[str, str] | None = None
    ) -> None:
        """Equations as MathML in short names; ``names`` chooses some of them, such as ``{"body.m": "m_b"}``."""
        chosen = {name: Short.of(other) for name, other in (names or {}).items()}
        short = {**shorten(n for n in names_in(equations) if n not in chosen), **chosen}
        written = "".join(mathml(e.lhs, e.rhs, named(short)) for e in equations)
        self._body.append(f'<div class="equations">{written}</div>')

    def figure(self, figure: Figure, caption: str, save: Path | None = None) -> None:
        """A matplotlib figure, embedded, and also saved as PNG where a path is given."""
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=140, bbox_inches="tight")
        if save is not None:
            write_files({save: buffer.getvalue()})
        image = base64.b64encode(buffer.getvalue()).decode()
        alternative = html.escape(caption, quote=True)
        self._body.append(
            f'<figure><img alt="{alternative}" src="data:image/png;base64,{image}">'
            f"<figcaption>{html.escape(caption)}</figcaption></figure>"
        )

    def drawing(self, svg: str, caption: str) -> None:
        """An SVG drawing, such as that of `acausal.diagram`, and a caption."""
        self._body.append(f"<figure>{svg}<figcaption>{html.escape(caption)}</figcaption></figure>")

    def write(self, path: str | Path, footer: str = "") -> Path:
        """Write the page and create its folder.

        Raises:
            DataError: if it cannot be written.
        """
        path = need_path(path, "write")
        text = (
            '<!doctype html><html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<title>{html.escape(self.title)}</title><style>{STYLE}</style></head><body>"
            f"{''.join(self._body)}<footer>{html.escape(footer)}</footer></body></html>"
        )
        write_files({path: text}, make_folders=True)
        return path


def write_json(path: str | Path, content: Any) -> Path:
    """Write figures as JSON and create the folder.

    Raises:
        DataError: if the file cannot be written.
    """
    path = need_path(path, "write_json")
    write_files({path: json.dumps(content, indent=2) + "\n"}, make_folders=True)
    return path
