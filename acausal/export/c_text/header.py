"""The header of a model in C, which a person can read."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator, Sequence

from acausal.export.c_text.text import ModelText, c_file, least
from acausal.export.names import NameRange

_EVENT_HELP = """   NAME_begin(&m);                before the first step, after NAME_start: what holds at m.time
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

_STATUS = """    NAME_OK = 0,
    NAME_NOT_FINITE = 1,      /* a value is no finite number */
    NAME_SINGULAR = 2,        /* an implicit step has no unique solution */
    NAME_NO_CONVERGENCE = 3,  /* Newton's method found no solution of an implicit step */
    NAME_EVENT_ITERATION = 4, /* at an event discrete variables change each other without end */
    NAME_CHATTERING = 5,      /* events follow each other without end */
    NAME_RUN_AWAY = 6         /* a state is beyond all bounds */"""


def header(text: ModelText) -> str:
    """The text of the header."""
    guard, name = f"{text.name.upper()}_H", text.name
    lines = [
        *_help(text),
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        f"typedef {text.precision} {name}_real;",
        "",
        *_constants(text),
        *(c_file("events.h", name) if text.has_events else []),
        *_struct(text),
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
        *_functions(text),
        "",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def _help(text: ModelText) -> Iterator[str]:
    name = text.name
    yield from (
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
    )
    if text.watches:
        yield _OUTSIDE_HELP.replace("NAME", name)
    if text.has_events:
        yield _EVENT_HELP.replace("NAME", name)
    upper = name.upper()
    yield ""
    yield f"   Functions give {upper}_OK or why they failed. Models in several threads do not disturb each other. */"


def _constants(text: ModelText) -> Iterator[str]:
    """Sizes, and what functions give."""
    upper, sizes = text.name.upper(), text.code.sizes
    counts = {
        "STATES": sizes.states,
        "INPUTS": sizes.inputs,
        "OUTPUTS": sizes.outputs,
        "PARAMETERS": sizes.parameters,
    }
    if text.has_events:
        counts |= {"DISCRETE": sizes.discrete, "CONDITIONS": sizes.conditions}
    yield "enum {"
    yield ",\n".join(f"    {upper}_{word} = {count}" for word, count in counts.items())
    yield from ("};", "", "typedef enum {")
    yield from _STATUS.replace("NAME", upper).splitlines()
    yield from (f"}} {text.name}_status;", "")


def _struct(text: ModelText) -> Iterator[str]:
    name, sizes = text.name, text.code.sizes
    stages = len(text.scheme.rows) * sizes.states
    yield "typedef struct {"
    yield f"    {name}_real time;{' ' * max(1, 20 - len(name))}/* s */"
    yield from field_lines(name, "x", text.states, sizes.states, "states")
    yield from field_lines(name, "u", text.inputs, sizes.inputs, "inputs")
    yield from field_lines(name, "y", text.outputs, sizes.outputs, "outputs")
    about = "parameters; call recalibrate after a change"
    yield from field_lines(name, "p", text.parameters, sizes.parameters, about)
    yield f"    {name}_real dx[{least(sizes.states)}]; /* derivatives of the states */"
    if text.has_events:
        runs = [(NameRange(n, i), "") for i, n in enumerate(text.discrete)]
        about = "discrete variables, first the conditions"
        yield from field_lines(name, "d", runs, sizes.discrete, about)
        yield f"    {name}_events e;"
    yield f"    {name}_real known[{least(sizes.known)}]; /* what depends on parameters alone */"
    yield f"    {name}_real stages[{least(stages)}], stage[{least(sizes.states)}]; /* of a step */"
    if text.scheme.is_implicit:
        n = sizes.states
        yield f"    {name}_real matrix[{n**2}], from[{n}], scratch[{n}];"
        yield f"    {name}_real seed[{n}], remains;"
        yield f"    int pivots[{n}];"
    if text.has_edges:
        yield f"    {name}_real since, until; /* the edges around a step */"
    yield f"    {name}_real work[{least(sizes.work)}];"
    yield f"    int whole_work[{least(sizes.whole_work)}];"
    yield "    int broken; /* the state at which a step has failed */"
    yield from (f"}} {name};", "")


def _functions(text: ModelText) -> Iterator[str]:
    name = text.name
    yield f"void {name}_init({name} *m);"
    for function in ("recalibrate", "start", "derivatives", "outputs"):
        yield f"{name}_status {name}_{function}({name} *m);"
    yield f"{name}_status {name}_step({name} *m, {name}_real h, const {name}_real *u_end);"
    if text.has_tangent:
        yield _DIRECTIONAL.replace("NAME", name)
    if text.watches:
        yield f"int {name}_outside({name} *m);"
    if text.has_events:
        yield _EVENT_HEADS.replace("NAME", name)
    elif text.has_edges:
        about = "the next time at which the rates jump or bend"
        yield f"{name}_real {name}_next_event({name} *m); /* {about} */"


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


def _longest(text: ModelText, part: Callable[[NameRange, str], str]) -> int:
    """Room for the longest of some texts."""
    each = (len(part(run, unit).encode()) for _, groups in text.tables() for run, unit in groups)
    return max(each, default=0) + 1


def _places(run: NameRange) -> str:
    if run.count == 1:
        return str(run.first)
    last = run.places[-1]
    return f"{run.first}...{last}" + (f" by {run.stride}" if run.stride > 1 else "")
