"""The header of a model in C, which a person can read."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator, Sequence

from acausal.export.c_text.text import ModelText, c_file, least
from acausal.export.names import NameRange

_EVENT_HELP = """   NAME_begin(&m);                before the first step: what holds at the start, at m.time
   m.d holds the discrete variables; steps end at events, where they change. Who makes steps of his own uses
   NAME_conditions(&m);           m.e.number: an event is where one of these changes its sign
   NAME_next_event(&m);           or at this time
   NAME_completed(&m);            after each step
   NAME_event(&m);                at an event: m.d and m.x behind it"""

_EVENT_HEADS = """NAME_status NAME_begin(NAME *m);
NAME_status NAME_conditions(NAME *m);
NAME_real NAME_next_event(NAME *m);
void NAME_completed(NAME *m);
NAME_status NAME_event(NAME *m);"""

_OUTSIDE_HELP = (
    "   NAME_outside(&m);            1 where a network's argument is outside of its range in training, "
    "else 0"
)

_DIRECTIONAL = (
    "NAME_status NAME_directional(NAME *m, const NAME_real along_time, const NAME_real *along_x, "
    "const NAME_real *along_u,\n    const NAME_real *along_p, NAME_real *of_dx, NAME_real *of_y);"
)


def header(text: ModelText) -> str:
    """The text of the header."""
    guard, name, sizes = f"{text.name.upper()}_H", text.name, text.code.sizes
    upper = text.name.upper()
    stages = len(text.scheme.rows) * sizes.states
    implicit = text.scheme.is_implicit
    lines = [
        f"/* {text.title}: its differential equations in C99, made by acausal.",
        "",
        f"   {name} m;                      all that the model needs; nothing else is allocated or shared",
        f"   {name}_init(&m);               default parameters, start values",
        f"   {name}_recalibrate(&m);        after m.p was changed: what depends on them alone",
        f"   {name}_start(&m);              {text.of_start}",
        f"   {name}_derivatives(&m);        m.dx from m.time, m.x, m.u",
        f"   {name}_outputs(&m);            m.y from the same",
        f"   {name}_step(&m, h, NULL);      one step of '{text.solver}' with inputs held",
        f"   {name}_directional(&m, ...);   directional derivatives of m.dx and m.y",
        *([_OUTSIDE_HELP.replace("NAME", name)] if text.watches else []),
        *(_EVENT_HELP.replace("NAME", name).splitlines() if text.has_events else []),
        "",
        f"   Functions give {upper}_OK or why they failed. Models in several threads do not disturb each other. */",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        f"typedef {text.precision} {name}_real;",
        "",
        "enum {",
        f"    {upper}_STATES = {sizes.states},",
        f"    {upper}_INPUTS = {sizes.inputs},",
        f"    {upper}_OUTPUTS = {sizes.outputs},",
        f"    {upper}_PARAMETERS = {sizes.parameters}{',' if text.has_events else ''}",
        *(
            [
                f"    {upper}_DISCRETE = {sizes.discrete},",
                f"    {upper}_CONDITIONS = {sizes.conditions}",
            ]
            if text.has_events
            else []
        ),
        "};",
        "",
        "typedef enum {",
        f"    {upper}_OK = 0,",
        f"    {upper}_NOT_FINITE = 1,      /* a value is no finite number */",
        f"    {upper}_SINGULAR = 2,        /* an implicit step has no unique solution */",
        f"    {upper}_NO_CONVERGENCE = 3,  /* Newton's method found no solution of an implicit step */",
        f"    {upper}_EVENT_ITERATION = 4, /* at an event discrete variables change each other without end */",
        f"    {upper}_CHATTERING = 5,      /* events follow each other without end */",
        f"    {upper}_RUN_AWAY = 6         /* a state is beyond all bounds */",
        f"}} {name}_status;",
        "",
        *(c_file("events.h", name) if text.has_events else []),
        "typedef struct {",
        f"    {name}_real time;{' ' * max(1, 20 - len(name))}/* s */",
        *field_lines(name, "x", text.states, sizes.states, "states"),
        *field_lines(name, "u", text.inputs, sizes.inputs, "inputs"),
        *field_lines(name, "y", text.outputs, sizes.outputs, "outputs"),
        *field_lines(
            name,
            "p",
            text.parameters,
            sizes.parameters,
            "parameters; call recalibrate after a change",
        ),
        f"    {name}_real dx[{least(sizes.states)}]; /* derivatives of the states */",
        *_discrete_fields(text),
        f"    {name}_real known[{least(sizes.known)}]; /* what depends on parameters alone */",
        f"    {name}_real stages[{least(stages)}], stage[{least(sizes.states)}]; /* of a step */",
        *(
            [
                f"    {name}_real matrix[{sizes.states**2}], from[{sizes.states}], scratch[{sizes.states}];",
                f"    {name}_real seed[{sizes.states}], remains;",
                f"    int pivots[{sizes.states}];",
            ]
            if implicit
            else []
        ),
        *(
            [f"    {name}_real since, until; /* the edges around a step */"]
            if text.has_edges
            else []
        ),
        f"    {name}_real work[{least(sizes.work)}];",
        f"    int whole_work[{least(sizes.whole_work)}];",
        "    int broken; /* the state at which a step has failed */",
        f"}} {name};",
        "",
        "/* Variables that lie evenly in an array: m.x[first], m.x[first + stride], ... */",
        "typedef struct {",
        f"    char name[{_longest(text, lambda run, _: run.name)}];",
        f"    char unit[{_longest(text, lambda _, unit: unit)}];",
        "    int first, stride, count;",
        f"}} {name}_variable;",
        "",
        *(
            f"extern const {name}_variable {name}_{kind}_table[{least(len(groups))}]; /* {len(groups)} */"
            for kind, groups in text.tables()
        ),
        "",
        f"void {name}_init({name} *m);",
        f"{name}_status {name}_recalibrate({name} *m);",
        f"{name}_status {name}_start({name} *m);",
        f"{name}_status {name}_derivatives({name} *m);",
        f"{name}_status {name}_outputs({name} *m);",
        f"{name}_status {name}_step({name} *m, {name}_real h, const {name}_real *u_end);",
        *([_DIRECTIONAL.replace("NAME", name)] if text.has_tangent else []),
        *([f"int {name}_outside({name} *m);"] if text.watches else []),
        *(
            [
                f"{name}_real {name}_next_event({name} *m); /* the next time at which the rates jump or bend */"
            ]
            if text.has_edges and not text.has_events
            else []
        ),
        *(_EVENT_HEADS.replace("NAME", name).splitlines() if text.has_events else []),
        "",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def field_lines(
    name: str, field: str, groups: Sequence[tuple[NameRange, str]], size: int | None, what: str
) -> Iterator[str]:
    """A field of a struct and what it holds: names in groups, with units; a size of None is a single number."""
    shown = [f"[{_places(run)}] {run.name}{f' in {unit}' if unit else ''}" for run, unit in groups]
    if size is None:
        shown = [text.partition("] ")[2] for text in shown]
    line = f"{', '.join(shown[:40])}{', ...' if len(shown) > 40 else ''}"
    line = ": ".join(part for part in (what, line) if part).replace("*/", "* /")
    comment = textwrap.wrap(line, 100, break_long_words=False)
    length = "" if size is None else f"[{least(size)}]"
    yield (f"    {name}_real {field}{length}; /* " + "\n       ".join(comment) + " */")


def _discrete_fields(text: ModelText) -> Iterator[str]:
    if not text.has_events:
        return
    runs = [(NameRange(n, "", None, i, 1, 1), "") for i, n in enumerate(text.discrete)]
    what = "discrete variables, first the conditions"
    yield from field_lines(text.name, "d", runs, text.code.sizes.discrete, what)
    yield f"    {text.name}_events e;"


def _longest(text: ModelText, part: Callable[[NameRange, str], str]) -> int:
    """Room for the longest of some texts."""
    each = (len(part(run, unit).encode()) for _, groups in text.tables() for run, unit in groups)
    return max(each, default=0) + 1


def _places(run: NameRange) -> str:
    if run.count == 1:
        return str(run.first)
    last = run.places[-1]
    return f"{run.first}...{last}" + (f" by {run.stride}" if run.stride > 1 else "")
