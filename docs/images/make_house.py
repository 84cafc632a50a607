"""Draw docs/images/house.svg, the rooms of acausal: python docs/images/make_house.py.

The floors are the layers of the import contract in pyproject.toml, and what goes in and out is what each room's
docstring says, so that the picture cannot go stale: tests/test_docs.py compares the file with what this script draws.
"""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from dataclasses import dataclass
from html import escape
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FILE = HERE / "house.svg"

WIDTH, SIDE, GAP = 860, 62, 8
"""Width of the picture, of the arrows on either side, and the gap between rooms."""
LINE, PAD, NAME = 16, 12, 118
"""Height of a line of text, space around the text of a room, width of a name beside its text."""
LETTER = 6.2
"""Width of a letter of the small text, on the safe side."""

STYLE = """
.panel { fill: #fbfcfd; stroke: #d5dde4 }
.box { fill: #e3ebf3; stroke: #44525f }
.jax { fill: #fdebd0; stroke: #a6762d }
.roof { fill: none; stroke: #44525f; stroke-width: 1.4 }
text { font: 14px system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; fill: #22303c }
.name { font-weight: 600 }
.note { font-size: 12px }
.dim { font-size: 12px; fill: #5c6b78 }
.code { font: 11.5px ui-monospace, "SF Mono", "DejaVu Sans Mono", monospace }
.arrow { stroke: #44525f; fill: none; stroke-width: 1.4 }
@media (prefers-color-scheme: dark) {
  .panel { fill: #1d242b; stroke: #3a4753 }
  .box { fill: #2f3f4e; stroke: #8fa3b5 }
  .jax { fill: #4a3a1e; stroke: #d9a860 }
  .roof { stroke: #8fa3b5 }
  text { fill: #e4eaf0 }
  .dim { fill: #9fb0bf }
  .arrow { stroke: #8fa3b5 }
}
"""

TIP = """<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">
<path class="arrow" d="M0.5,0.5 L7,4 L0.5,7.5"/></marker></defs>"""


@dataclass(frozen=True)
class Room:
    """A folder or file of the kernel: its name, what goes in and out, and whether it may import JAX."""

    name: str
    given: str
    made: str
    jax: bool


def floors() -> list[list[Room]]:
    """The rooms of each layer, from the top down, as the contracts in pyproject.toml have them."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    contracts = tomllib.loads(text)["tool"]["importlinter"]["contracts"]
    layers = next(c["layers"] for c in contracts if c["type"] == "layers")
    without_jax = {
        module.removeprefix("acausal.")
        for contract in contracts
        if contract["type"] == "forbidden" and "jax" in contract["forbidden_modules"]
        for module in contract["source_modules"]
    }
    return [[room(name, without_jax) for name in re.split(r"\s*[|:]\s*", row)] for row in layers]


def room(name: str, without_jax: set[str]) -> Room:
    """A room as its docstring describes it."""
    path = ROOT / "acausal" / name
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    docstring = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
    text = " ".join(docstring.split())
    found = re.search(r"\bIn: (.+?)\. Out: (.+?)\.(?= [A-Z]|$)", text)
    given, made = found.groups() if found else ("", text.partition(". ")[0].rstrip("."))
    label = f"{name}/" if path.is_dir() else f"{name}.py"
    return Room(label, given, made, jax=name not in without_jax and name != "errors")


def draw() -> str:
    """The picture as SVG."""
    left, right = SIDE, WIDTH - SIDE
    parts, y = _roof(left, right)
    top = y
    for floor in floors():
        width = (right - left - GAP * (len(floor) - 1)) / len(floor)
        texts = [_text(r, width, alone=len(floor) == 1) for r in floor]
        height = max(t[1] for t in texts)
        for i, (r, (lines, _)) in enumerate(zip(floor, texts, strict=True)):
            x = left + i * (width + GAP)
            kind = "jax" if r.jax else "box"
            parts.append(_rect(kind, x, y, width, height))
            parts += [_line(x + dx, y + dy, kind, text) for dx, dy, kind, text in lines]
        y += height + GAP
    parts += _arrows(top, y - GAP, left, right)
    parts += _legend(y + 6, left)
    height = y + 44
    head = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:g}" role="img">',
        "<title>The rooms of acausal in layers: each imports only those below it</title>",
        f"<style>{STYLE}</style>",
        TIP,
        f'<rect class="panel" x="1" y="1" width="{WIDTH - 2}" height="{height - 2:g}" rx="10"/>',
    ]
    return "\n".join([*head, *parts, "</svg>", ""])


Text = tuple[float, float, str, str]
"""Place within a room, class, and the text itself."""


def _text(r: Room, width: float, *, alone: bool) -> tuple[list[Text], float]:
    """The lines of a room and its height: in and out beside its name if it has the floor, below it if not."""
    lines: list[Text] = [(PAD, PAD + LINE - 4, "name", r.name)]
    if alone:
        out = PAD + NAME + 238
        ends = [(PAD + LINE, PAD + LINE)]
        if r.given:
            ends += [_said("in", r.given, PAD + NAME, PAD, out - 6, lines)]
            ends += [_said("out", r.made, out, PAD, width, lines)]
        else:
            ends += [_said("", r.made, PAD + NAME, PAD, width, lines)]
        return lines, max(max(end) for end in ends) + PAD - 2
    y = PAD + 21.0
    for word, text in (("in", r.given), ("out", r.made)):
        _, y = _said(word, text, PAD, y, width, lines)
    return lines, y + PAD - 2


def _said(
    word: str, text: str, x: float, y: float, right: float, lines: list[Text]
) -> tuple[float, float]:
    """Append a word and the text behind it, broken at the right; from where to where it reaches."""
    indent = 30 if word else 0
    top = y
    lines.append((x, y + LINE - 4, "dim", word))
    for line in _wrapped(text, (right - x - indent - PAD) / LETTER):
        lines.append((x + indent, y + LINE - 4, "note", line))
        y += LINE
    return top, y


def _wrapped(text: str, letters: float) -> list[str]:
    """Lines of a text; a pair of backticks is not counted, and closed where a line break parts it."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if len(longer.replace("`", "")) <= letters:
            lines[-1] = longer
        elif lines[-1].count("`") % 2:
            lines[-1] += "`"
            lines.append(f"`{word}")
        else:
            lines.append(word)
    return lines


def _line(x: float, y: float, kind: str, text: str) -> str:
    """A line of text; what stands between backticks is code."""
    spans = [
        f'<tspan class="code">{escape(part)}</tspan>' if i % 2 else escape(part)
        for i, part in enumerate(text.split("`"))
    ]
    return f'<text class="{kind}" x="{x:g}" y="{y:g}">{"".join(spans)}</text>'


def _rect(kind: str, x: float, y: float, width: float, height: float) -> str:
    return (
        f'<rect class="{kind}" x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="7"/>'
    )


def _roof(left: float, right: float) -> tuple[list[str], float]:
    """The public names, and those who use them; and where the floors begin."""
    top, eaves = 18, 84
    middle = (left + right) / 2
    lines = (
        (top + 26, "name", "import acausal as ac"),
        (top + 44, "dim", "the public names, for components/, examples/ and your own code"),
    )
    parts = [
        f'<path class="roof" d="M{left - 14},{eaves} L{left + 110},{top} H{right - 110} L{right + 14},{eaves} Z"/>'
    ]
    parts += [
        f'<text class="{kind}" x="{middle:g}" y="{y}" text-anchor="middle">{text}</text>'
        for y, kind, text in lines
    ]
    return parts, eaves + GAP


def _arrows(top: float, bottom: float, left: float, right: float) -> list[str]:
    """Imports point down, data moves up."""
    parts: list[str] = []
    middle = (top + bottom) / 2
    for x, start, end, text in (
        (left - 20, bottom, top + 2, "a model moves up: declared, reduced, simulated, trained"),
        (right + 20, top, bottom - 2, "imports point down, never up and never sideways"),
    ):
        away = -9 if x < WIDTH / 2 else 19
        turn = f"rotate(-90 {x + away:g} {middle:g})"
        parts.append(f'<path class="arrow" d="M{x:g},{start:g} V{end:g}" marker-end="url(#tip)"/>')
        parts.append(
            f'<text class="dim" x="{x + away:g}" y="{middle:g}" text-anchor="middle" transform="{turn}">{text}</text>'
        )
    return parts


def _legend(y: float, left: float) -> list[str]:
    parts: list[str] = []
    for x, kind, text in (
        (left, "box", "may not import JAX"),
        (left + 170, "jax", "may import JAX"),
    ):
        parts.append(f'<rect class="{kind}" x="{x:g}" y="{y:g}" width="22" height="14" rx="4"/>')
        parts.append(_line(x + 30, y + 11, "dim", text))
    return parts


if __name__ == "__main__":
    if sys.argv[1:]:
        raise SystemExit(__doc__)
    FILE.write_text(draw(), encoding="utf-8")
