"""The source of a model in C: its functions, from the struct and back."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from acausal.export.c_text.event_functions import ARGUMENTS as OF_EVENTS
from acausal.export.c_text.event_lines import (
    EVENT,
    PUBLIC,
    SEARCH,
    STEP,
    constants,
    event_tables,
    filled,
)
from acausal.export.c_text.expressions import literal
from acausal.export.c_text.outside import (
    FUNCTION as EXCESS,
    outside_lines,
)
from acausal.export.c_text.prelude import PRELUDE
from acausal.export.c_text.steps import attempt_lines, step_lines
from acausal.export.c_text.text import Text, least, written
from acausal.simulation import KAPPA, SLOW, STAGE_STEPS, STAGE_TOLERANCE

IN_PIECES = """    const real begin = m->time, end = begin + h, apart = APART(fabs(end) > h ? fabs(end) : h);
    real from[INPUTS + 1], to[INPUTS + 1];
    for (int i = 0; i < INPUTS; i++) from[i] = m->u[i];
    while (m->time < end) {
        find_edge(m, apart);
        const real stop = m->until < end - apart ? m->until : end, share = (stop - begin) / h;
        for (int i = 0; i < INPUTS; i++) to[i] = from[i] + share * ((u_end ? u_end[i] : from[i]) - from[i]);
        const Status status = piece(m, stop - m->time, to);
        m->time = stop;
        if (status) return status;
    }
    return STATUS_OK;"""
"""A step that is divided at edges."""

NUMBERS = ("t", "seed_t", "initial", "apart")
"""Arguments that are single numbers."""


def source(text: Text) -> str:
    """The text of the source."""
    name, upper = text.name, text.name.upper()
    memory = text.code.memory
    bodies = "\n".join(_without_comments(f.lines) for f in text.code.functions.values())
    lines = [
        f'#include "{name}.h"',
        *(["#include <float.h>"] if text.has_events or text.has_edges else []),
        "#include <stddef.h>",
        "#include <tgmath.h>",
        "",
        f"typedef {name}_real real;",
        f"typedef {name} Model;",
        f"typedef {name}_status Status;",
        f"#define R(number) number{'##f' if text.precision == 'float' else ''}",
        f"enum {{ STATES = {text.code.sizes.states}, INPUTS = {text.code.sizes.inputs} }};",
        "",
        *(PRELUDE[k] for k in sorted(memory.prelude) if k in PRELUDE and _mentions(bodies, k)),
        "",
        "static int all_finite(const real *a, int n) {",
        "    for (int i = 0; i < n; i++)",
        "        if (!isfinite(a[i])) return 0;",
        "    return 1;",
        "}",
        "",
    ]
    for table in memory.tables:
        if _mentions(bodies, table.name):
            lines += _table(table.name, np.asarray(table.table), table.kind)
    lines += ["", *_function(text, "rates", ["t", "x", "u"], ["dx"])]
    lines += _function(text, "outputs", ["t", "x", "u"], ["y"])
    if text.has_tangent:
        seeds = ["seed_t", "seed_x", "seed_u", "seed_p"]
        lines += _function(text, "tangent", ["t", "x", "u", *seeds], ["ddx", "dy"])
    lines += _function(text, "recalibrate", [], [])
    if text.has_starts:
        lines += _function(text, "starts", ["t", "u"], ["x"])
    lines += _function(text, EXCESS, ["t", "x", "u"], [EXCESS]) if text.watches else []
    lines += _edges(text)
    if text.scheme.implicit:
        lines += _implicit(text)
    lines += _events(text)
    lines += _public(text, name, upper)
    lines += outside_lines(name) if text.watches else []
    return "\n".join(lines) + "\n"


def _function(
    text: Text, name: str, arguments: list[str], results: list[str], called: str = ""
) -> Iterator[str]:
    """A function of the file: arguments, pointers to what it reads of the struct, statements."""
    function = text.code.functions[name]
    body = _without_comments(function.lines)
    head = [f"{text.name} *m"]
    head += [f"const real {'' if a in NUMBERS else '*'}{a}" for a in arguments]
    head += [f"real *restrict {r}" for r in results]
    yield f"static void {called or name}({', '.join(head)}) {{"
    for field in ("p", "known", "d"):
        if _mentions(body, field):
            const = "" if name == "recalibrate" and field == "known" else "const "
            yield f"    {const}real *const {field} = m->{field};"
    unused = [a for a in (*arguments, *results) if not _mentions(body, a)]
    if not re.search(r"\bm\b", body) and not any(_mentions(body, f) for f in ("p", "known", "d")):
        unused.append("m")
    if unused:
        yield "    " + " ".join(f"(void){a};" for a in unused)
    yield from function.lines
    yield "}"
    yield ""


def _scheme_lines(text: Text, lines: Iterator[str]) -> Iterator[str]:
    return (line.replace("STATUS_", f"{text.name.upper()}_") for line in lines)


def _events(text: Text) -> Iterator[str]:
    """What a model with events needs to make steps."""
    events, inputs = text.code.events, bool(text.code.sizes.inputs)
    if events is None:
        return
    limits = "FLT" if text.precision == "float" else "DBL"
    yield from (f"#define TINY {limits}_MIN", f"#define ROUNDING {limits}_EPSILON")
    yield from constants()
    yield from event_tables(events)
    yield ""
    for function, (own, result) in OF_EVENTS.items():
        yield from _function(text, function, ["t", "x", "u", *own], [result])
    yield from filled(EVENT, text.name, inputs, text.has_edges)
    yield ""
    yield f"static {text.name}_status attempt({text.name} *m, const real t, const real h) {{"
    yield from _scheme_lines(text, attempt_lines(text.scheme, inputs))
    yield "}"
    yield ""
    yield from filled(SEARCH, text.name, inputs, text.has_edges)
    yield ""


def _implicit(text: Text) -> Iterator[str]:
    precision = "float64" if text.precision == "double" else "float32"
    yield f"#define TOLERANCE R({STAGE_TOLERANCE[precision]!r})"
    yield f"#define KAPPA R({KAPPA!r})"
    yield f"#define SLOW R({SLOW!r})"
    yield f"enum {{ STAGE_STEPS = {STAGE_STEPS} }};"
    yield from _function(text, "column", ["t", "x", "u", "seed_x"], ["ddx"], "jacobian_column")
    yield from written("newton.c")
    yield ""


def _edges(text: Text) -> Iterator[str]:
    """The next time at which the rates jump or bend, and on which side of it they are evaluated."""
    if not text.has_edges:
        yield "#define SIDED(t) (t)"
        return
    limits = "FLT" if text.precision == "float" else "DBL"
    yield f"#define APART(size) (16 * {limits}_EPSILON * (size))"
    yield from _function(text, "ahead", ["t", "apart"], ["edge"])
    yield from written("edges.c")
    yield ""


def _public(text: Text, name: str, upper: str) -> Iterator[str]:
    for kind, groups in text.tables():
        yield f"const {name}_variable {name}_{kind}_table[{least(len(groups))}] = {{"
        for run, unit in groups:
            yield f'    {{"{_c(run.name)}", "{_c(unit)}", {run.first}, {run.stride}, {run.count}}},'
        if not groups:
            yield '    {"", "", 0, 1, 0}'
        yield "};"
    yield ""
    lines: list[str] = []
    yield from _filling("default_p", text.vector.values, "m->p", lines)
    starts: list[str] = []
    yield from _filling("start_x", text.start, "m->x", starts)
    fill_d: list[str] = []
    yield from _filling("start_d", text.discrete_start, "m->d", fill_d)
    lines += fill_d
    yield f"void {name}_init({name} *m) {{"
    yield "    m->time = 0;"
    if text.has_edges:
        yield "    m->since = m->until = INFINITY;"
    yield from lines
    yield from starts
    if text.code.sizes.inputs:
        yield "    for (int i = 0; i < INPUTS; i++) m->u[i] = 0;"
    yield "    recalibrate(m);"
    yield "}"
    yield ""
    yield f"{name}_status {name}_start({name} *m) {{"
    if text.has_starts:
        yield "    starts(m, m->time, m->u, m->x);"
        yield f"    return all_finite(m->x, STATES) ? {upper}_OK : {upper}_NOT_FINITE;"
    else:
        yield from starts or ["    (void)m;"]
        yield f"    return {upper}_OK;"
    yield "}"
    yield ""
    finite = f"? {upper}_OK : {upper}_NOT_FINITE;"
    yield f"{name}_status {name}_recalibrate({name} *m) {{"
    yield "    recalibrate(m);"
    yield f"    return all_finite(m->known, {text.code.sizes.known}) {finite}"
    yield "}"
    yield ""
    for what, call, field, size in (
        ("derivatives", "rates", "dx", text.code.sizes.states),
        ("outputs", "outputs", "y", text.code.sizes.outputs),
    ):
        yield f"{name}_status {name}_{what}({name} *m) {{"
        time = "SIDED(m->time)" if call == "rates" else "m->time"
        yield f"    {call}(m, {time}, m->x, m->u, m->{field});"
        yield f"    return all_finite(m->{field}, {size}) {finite}"
        yield "}"
        yield ""
    inputs = bool(text.code.sizes.inputs)
    head = f"{name}_status {name}_step({name} *m, const real h, const real *u_end) {{"
    if text.has_events:
        yield head
        yield from filled(STEP, name, inputs, text.has_edges)
    elif text.has_edges:
        yield f"static {name}_status piece({name} *m, const real h, const real *u_end) {{"
        yield from _scheme_lines(text, step_lines(text.scheme, inputs))
        yield "}"
        yield ""
        yield head
        yield from _scheme_lines(text, iter(IN_PIECES.splitlines()))
    else:
        yield head
        yield from _scheme_lines(text, step_lines(text.scheme, inputs))
    yield "}"
    if text.has_edges and not text.has_events:
        yield ""
        yield f"{name}_real {name}_next_event({name} *m) {{"
        yield "    find_edge(m, APART(fabs(m->time)));"
        yield "    return m->until;"
        yield "}"
    if text.has_events:
        yield ""
        public = PUBLIC.replace("    START_D", "\n".join(fill_d))
        yield from filled(public, name, inputs, text.has_edges)
    if text.has_tangent:
        yield ""
        yield text.directional_head() + " {"
        yield (
            "    tangent(m, m->time, m->x, m->u, along_time, along_x, along_u, along_p, of_dx, of_y);"
        )
        yield f"    return all_finite(of_dx, STATES) && all_finite(of_y, {text.code.sizes.outputs}) {finite}"
        yield "}"


def mentions(lines: Sequence[str], name: str) -> bool:
    """Whether some lines of C read a variable."""
    return _mentions(_without_comments(lines), name)


def _without_comments(lines: Sequence[str]) -> str:
    return re.sub(r"/\*.*?\*/", "", "\n".join(lines))


def _mentions(body: str, name: str) -> bool:
    return re.search(rf"(?<![\w>.]){name}\b", body) is not None


def _c(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _table(name: str, values: np.ndarray, kind: str) -> list[str]:
    """A constant array, eight numbers a line."""
    written = [literal(v, kind) for v in values.reshape(-1).tolist()]
    rows = [", ".join(written[i : i + 8]) for i in range(0, len(written), 8)]
    what = "real" if kind == "real" else "int"
    return [f"static const {what} {name}[] = {{", *(f"    {row}," for row in rows), "};"]


def _filling(name: str, values: np.ndarray, target: str, lines: list[str]) -> Iterator[str]:
    """A table of values and, in ``lines``, the statements that copy them; one number for many that are equal."""
    if not values.size:
        return
    if (values == values[0]).all():
        value = literal(float(values[0]), "real")
        lines.append(f"    for (int i = 0; i < {values.size}; i++) {target}[i] = {value};")
        return
    yield from _table(name, values, "real")
    lines.append(f"    for (int i = 0; i < {values.size}; i++) {target}[i] = {name}[i];")
