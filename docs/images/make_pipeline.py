"""Draw docs/images/pipeline.svg: python docs/images/make_pipeline.py. Its numbers are those of the quarter vehicle."""

import sys
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

import acausal as ac  # noqa: E402
from examples.qvm.model import with_networks  # noqa: E402

WIDTH, ROW, TOP = 860, 62, 66
LEFT, FORM, VALUE = 24, 150, 430
BOX = (104, 44)

STYLE = """
.panel { fill: #fbfcfd; stroke: #d5dde4 }
.box { fill: #e3ebf3; stroke: #44525f }
.side { fill: #fdebd0; stroke: #a6762d }
.stripe { fill: #f0f4f8 }
text { font: 14px system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; fill: #22303c }
.verb { font-weight: 600; text-anchor: middle }
.head { font-size: 12px; fill: #5c6b78 }
.note { font-size: 12px; fill: #5c6b78 }
.code { font: 12.5px ui-monospace, "SF Mono", "DejaVu Sans Mono", monospace }
path { stroke: #44525f; fill: none; stroke-width: 1.4 }
.dash { stroke: #a6762d; stroke-dasharray: 4 3 }
@media (prefers-color-scheme: dark) {
  .panel { fill: #1d242b; stroke: #3a4753 }
  .box { fill: #2f3f4e; stroke: #8fa3b5 }
  .side { fill: #4a3a1e; stroke: #d9a860 }
  .stripe { fill: #232c35 }
  text { fill: #e4eaf0 }
  .head, .note { fill: #9fb0bf }
  path { stroke: #8fa3b5 }
  .dash { stroke: #d9a860 }
}
"""


TIP = """<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">
<path d="M0.5,0.5 L7,4 L0.5,7.5"/></marker></defs>"""


def rows(system: ac.System) -> list[tuple[str, str, str, str, str]]:
    """Verb, room, form and its size, and what the suspension's force is in it."""
    flat, reduced, program = system.flat, system.reduced, system.program
    number = flat.layout.find_variable("suspension.f")
    group = next(g for g in flat.groups if number in g.variables and "c*" in str(g.origins[0]))
    suspension, tyre = group.variables.tolist()
    step = next(i for i in program.instructions if "c*s_rel" in str(getattr(i, "expression", "")))
    return [
        (
            "declare",
            "modeling/",
            "Component",
            "a tree of components and connections",
            "f = c (s_rel − s_rel0) + d v_rel",
        ),
        (
            "flatten",
            "flattening/",
            "FlatModel",
            f"{flat.n_variables} variables, {flat.n_equations} equations of {len(flat.groups)} templates",
            f"one template; rows {suspension}, {tyre}",
        ),
        (
            "reduce",
            "structure/",
            "ReducedModel",
            f"{len(reduced.states)} states, {len(reduced.steps)} steps in solving order",
            "f ← c s_rel + d v_rel",
        ),
        (
            "generate",
            "codegen/",
            "Program",
            f"{len(program.instructions)} array instructions, as data that JAX runs",
            f"one f64[{step.size}], with tyre.f",
        ),
        (
            "initialize",
            "initialization/",
            "x(0)",
            "consistent start values",
            "its start may be fixed",
        ),
        (
            "simulate",
            "simulation/",
            "Solution",
            "any variable by its name",
            'solution["suspension.f"]',
        ),
        (
            "fit",
            "training/",
            "Fit",
            "trained networks and parameters",
            "suspension.c and .d may be trained",
        ),
    ]


def draw(system: ac.System) -> str:
    """The figure as SVG."""
    table = rows(system)
    height = TOP + ROW * len(table) + 14
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" role="img">',
        "<title>The pipeline: declare, flatten, reduce, generate, initialize, simulate, fit</title>",
        f"<style>{STYLE}</style>",
        TIP,
        f'<rect class="panel" x="1" y="1" width="{WIDTH - 2}" height="{height - 2}" rx="10"/>',
    ]
    for x, head in ((FORM, "its result"), (VALUE, "the suspension's force in it")):
        parts.append(f'<text class="head" x="{x}" y="{TOP - 24}">{escape(head)}</text>')
    parts.append(
        f'<text class="head" x="{LEFT + BOX[0] / 2}" y="{TOP - 24}" text-anchor="middle">stage, room</text>'
    )
    centre = LEFT + BOX[0] / 2
    for i, (verb, room, form, note, value) in enumerate(table):
        y = TOP + ROW * i
        if i % 2 == 0:
            size = f'width="{WIDTH - FORM - 6}" height="{ROW}"'
            parts.append(f'<rect class="stripe" x="{FORM - 14}" y="{y - 9}" {size} rx="6"/>')
        parts.append(
            f'<rect class="box" x="{LEFT}" y="{y}" width="{BOX[0]}" height="{BOX[1]}" rx="7"/>'
        )
        parts.append(f'<text class="verb" x="{centre}" y="{y + 20}">{verb}</text>')
        parts.append(
            f'<text class="note" x="{centre}" y="{y + 36}" text-anchor="middle">{room}</text>'
        )
        if i + 1 < len(table):
            parts.append(
                f'<path d="M{centre},{y + BOX[1]} V{y + ROW - 2}" marker-end="url(#tip)"/>'
            )
        parts.append(f'<text x="{FORM}" y="{y + 19}">{escape(form)}</text>')
        parts.append(f'<text class="note" x="{FORM}" y="{y + 37}">{escape(note)}</text>')
        parts.append(f'<text class="code" x="{VALUE}" y="{y + 27}">{escape(value)}</text>')
    parts += _derive(TOP + ROW * 2, TOP + ROW * 3)
    return "\n".join([*parts, "</svg>", ""])


def _derive(reduce: int, generate: int) -> list[str]:
    """The box beside reduce and generate: both ask sympy, once per template."""
    x, y, width = 696, (reduce + generate) // 2 - 4, 146
    parts = [
        f'<rect class="side" x="{x}" y="{y}" width="{width}" height="46" rx="7"/>',
        f'<text class="verb" x="{x + width / 2}" y="{y + 20}">derive</text>',
        f'<text class="note" x="{x + width / 2}" y="{y + 37}" text-anchor="middle">sympy, per template</text>',
    ]
    for target, side in ((reduce + 22, y + 14), (generate + 22, y + 32)):
        parts.append(
            f'<path class="dash" d="M{x},{side} H{x - 18} V{target} H{x - 34}" marker-end="url(#tip)"/>'
        )
    return parts


if __name__ == "__main__":
    text = draw(ac.compile(with_networks()))
    Path(__file__).with_name("pipeline.svg").write_text(text, encoding="utf-8")
