"""The source of a model in C: its functions, from the struct and back.

What is the same for all models is in the `.c` files here; in them a name begins with ``model_`` where the model's own
name belongs.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator

import numpy as np

from acausal.export.c_text import events
from acausal.export.c_text.code import EXCESS
from acausal.export.c_text.expressions import literal
from acausal.export.c_text.functions import CFunction, mentioned, without_comments
from acausal.export.c_text.lowering import Workspace
from acausal.export.c_text.starts import DISCRETE_STARTS, GUESSES, STARTS
from acausal.export.c_text.steps import attempt_lines, step_lines
from acausal.export.c_text.text import ModelText, c_file, least, opening, prelude
from acausal.simulation import (
    GROWS,
    KAPPA,
    LEAST,
    OF_STALL,
    SLOW,
    STAGE_STEPS,
    STAGE_TOLERANCE,
    STALLS,
)

FIELDS = ("p", "known", "d")
"""Arrays that functions take from the struct."""


def source(text: ModelText) -> str:
    """The text of the source."""
    return "\n".join(_lines(text)) + "\n"


def _lines(text: ModelText) -> Iterator[str]:
    name, sizes = text.name, text.code.sizes
    yield f'#include "{name}.h"'
    if text.has_events or text.has_edges:
        yield "#include <float.h>"
    yield from ("#include <stddef.h>", "#include <tgmath.h>", "")
    yield from opening(name, text.precision)
    yield f"typedef {name}_status Status;"
    for word, is_there in (
        ("EVENTS", text.has_events),
        ("EDGES", text.has_edges),
        ("STARTS", text.has_starts),
        ("STARTS_IN_MODES", text.starts_in_modes),
        ("DISCRETE_STARTS", text.has_discrete_starts),
        ("TANGENT", text.has_tangent),
        ("WATCHES", text.watches),
    ):
        yield f"#define {word} {int(is_there)}"
    yield f"enum {{ STATES = {sizes.states}, INPUTS = {sizes.inputs}, OUTPUTS = {sizes.outputs} }};"
    yield f"enum {{ KNOWN = {sizes.known} }};"
    yield ""
    yield from helpers(text.code.functions.values(), text.code.memory)
    for function in ("rates", "outputs", "tangent", "recalibrate", STARTS, GUESSES, EXCESS):
        if function in text.code.functions:
            yield from _function(text, function)
    yield from _edges(text)
    if text.scheme.is_implicit:
        yield from _implicit(text)
    yield from _variables(text)
    yield from _filling("p", text.vector.values)
    yield from _filling("x", text.start)
    if text.has_events:
        yield from _filling("d", text.discrete_start)
    yield from c_file("model.c", name)
    yield from _steps(text)


def helpers(functions: Iterable[CFunction], memory: Workspace) -> Iterator[str]:
    """Helper functions, and tables, that some functions need."""
    bodies = "\n".join(without_comments(f.lines) for f in functions)
    for helper, lines in sorted(prelude().items()):
        if helper == "all_finite" or (helper in memory.prelude and mentioned(bodies, helper)):
            yield from (lines, "")
    for table in memory.tables:
        if mentioned(bodies, table.name):
            yield from _table(table.name, np.asarray(table.table), table.kind)
    yield ""


def _function(text: ModelText, name: str, left_out: Collection[str] = ()) -> Iterator[str]:
    """A function of the file: arguments, pointers to what it reads of the struct, statements."""
    function = text.code.functions[name]
    body = without_comments(function.lines)
    given = [a for a in function.arguments if a not in (*FIELDS, *left_out)]
    filled = [r for r in function.results if r not in FIELDS]
    head = [f"{text.name} *m"]
    head += [f"const real {'' if function.arguments[a] is None else '*'}{a}" for a in given]
    head += [f"real *restrict {r}" for r in filled]
    yield f"static void {name}({', '.join(head)}) {{"
    for field in FIELDS:
        if mentioned(body, field):
            const = "" if name == "recalibrate" and field == "known" else "const "
            yield f"    {const}real *const {field} = m->{field};"
    unused = [a for a in (*given, *filled) if not mentioned(body, a)]
    if not re.search(r"\bm\b", body) and not any(mentioned(body, f) for f in FIELDS):
        unused.append("m")
    if unused:
        yield "    " + " ".join(f"(void){a};" for a in unused)
    yield from function.lines
    yield "}"
    yield ""


def _steps(text: ModelText) -> Iterator[str]:
    """The step of a model, which may be divided at events or at edges."""
    found, name = text.code.events, text.name
    yield from _limits(text)
    if found is not None:
        limits = "FLT" if text.precision == "float" else "DBL"
        yield from (f"#define TINY {limits}_MIN", f"#define ROUNDING {limits}_EPSILON")
        yield from events.constants("float32" if text.precision == "float" else "float64")
        yield from events.tables(found)
        yield ""
        for function in (*events.ARGUMENTS, DISCRETE_STARTS):
            if function in text.code.functions:
                yield from _function(text, function)
        yield "static Status attempt(Model *m, const real t, const real h) {"
        yield from attempt_lines(text.scheme, name)
        yield from ("}", "")
        yield from c_file("events.c", name)
        if text.starts_in_modes:
            yield from ("", *c_file("starts_in_modes.c", name))
        return
    head = "static Status piece" if text.has_edges else f"Status {name}_step"
    yield f"{head}(Model *m, const real h, const real *u_end) {{"
    yield from step_lines(text.scheme, name)
    yield "}"
    if text.has_edges:
        yield ""
        yield from c_file("pieces.c", name)


def _limits(text: ModelText) -> Iterator[str]:
    """Whether states are finite, and have not run away."""
    limits, limit = text.limits, "limits[i]"
    if limits.size and (limits != limits[0]).any():
        yield from _table("limits", limits, "real")
    else:
        limit = literal(float(limits[0]) if limits.size else 0.0, "real")
    yield f"#define LIMIT(i) {limit}"
    yield from c_file("limits.c", text.name)
    yield ""


def _implicit(text: ModelText) -> Iterator[str]:
    precision = "float64" if text.precision == "double" else "float32"
    yield f"#define TOLERANCE R({STAGE_TOLERANCE[precision]!r})"
    yield f"#define LEAST R({LEAST[precision]!r})"
    yield f"#define KAPPA R({KAPPA!r})"
    yield f"#define STALLS R({STALLS!r})"
    yield f"#define GROWS R({GROWS!r})"
    yield f"#define OF_STALL R({OF_STALL!r})"
    yield f"#define SLOW R({SLOW!r})"
    yield f"enum {{ STAGE_STEPS = {STAGE_STEPS} }};"
    yield from _function(text, "jacobian_column")
    yield from c_file("newton.c", text.name)
    yield ""


def _edges(text: ModelText) -> Iterator[str]:
    """The next time at which the rates jump or bend, and on which side of it they are evaluated."""
    if not text.has_edges:
        yield "#define SIDED(t) (t)"
        return
    limits = "FLT" if text.precision == "float" else "DBL"
    yield f"#define APART(size) (16 * {limits}_EPSILON * (size))"
    yield from _function(text, "ahead", left_out=("x", "u"))
    yield from c_file("edges.c", text.name)
    yield ""


def _variables(text: ModelText) -> Iterator[str]:
    """Names and units, in groups."""
    for kind, groups in text.tables():
        yield f"const {text.name}_variable {text.name}_{kind}_table[{least(len(groups))}] = {{"
        for run, unit in groups:
            yield f'    {{"{_c(run.name)}", "{_c(unit)}", {run.first}, {run.stride}, {run.count}}},'
        if not groups:
            yield '    {"", "", 0, 1, 0}'
        yield "};"
    yield ""


def _c(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _table(name: str, values: np.ndarray, kind: str) -> list[str]:
    """A constant array, eight numbers a line."""
    written = [literal(v, kind) for v in values.reshape(-1).tolist()]
    rows = [", ".join(written[i : i + 8]) for i in range(0, len(written), 8)]
    what = "real" if kind == "real" else "int"
    return [f"static const {what} {name}[] = {{", *(f"    {row}," for row in rows), "};"]


def _filling(field: str, values: np.ndarray) -> Iterator[str]:
    """The function that gives an array of the struct its first values; one number for many that are equal."""
    value = f"start_{field}[i]"
    if values.size and (values == values[0]).all():
        value = literal(float(values[0]), "real")
    elif values.size:
        yield from _table(f"start_{field}", values, "real")
    yield f"static void fill_{field}(real *{field}) {{"
    if values.size:
        yield f"    for (int i = 0; i < {values.size}; i++) {field}[i] = {value};"
    else:
        yield f"    (void){field};"
    yield from ("}", "")
