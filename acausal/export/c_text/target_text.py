"""A function of named arrays in C: a header and a source with one struct, which holds what it reads and remembers.

A result that has the name of an argument is what the function remembers from call to call.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import jax
import jax.numpy as jnp
import numpy as np

from acausal.export.c_text.expressions import literal
from acausal.export.c_text.functions import CArgument, CFunction, mentions, write_function
from acausal.export.c_text.header import field_lines
from acausal.export.c_text.lowering import Workspace
from acausal.export.c_text.source import helpers
from acausal.export.c_text.statements import Buffer
from acausal.export.c_text.text import least, opening
from acausal.export.names import runs
from acausal.export.target import Target, TargetPort
from acausal.export.traced import trace


@dataclass(frozen=True)
class TargetText:
    """What the files of a target say.

    Attributes:
        target: the function. name: of the struct, and before the names of functions.
        precision: "double" or "float".
        function: its body. memory: its tables and helper functions.
    """

    target: Target
    name: str
    precision: str
    function: CFunction
    memory: Workspace

    @property
    def results(self) -> Iterator[tuple[TargetPort, int]]:
        """The results, and where they begin in the array of all results."""
        first = 0
        for port in self.target.outputs:
            yield port, first
            first += _size(port)

    @property
    def length(self) -> int:
        """Of the array of all results."""
        return sum(map(_size, self.target.outputs))


def target_text(target: Target, name: str, precision: str) -> TargetText:
    """What is written about a target.

    Raises:
        ExportError: for an operation without C.
    """

    def flat(*arrays: jax.Array) -> tuple[jax.Array, ...]:
        return tuple(map(jnp.ravel, target.call(*arrays)))

    memory = Workspace(describe=lambda _: "")
    block = trace(flat, *(jnp.zeros(p.shape) for p in target.inputs))
    arguments = [
        CArgument(Buffer(p.name, "real", _size(p) if p.shape else None), p.shape)
        for p in target.inputs
    ]
    results = [(Buffer(f"next_{p.name}", "real", _size(p)), 0) for p in target.outputs]
    function = write_function(block, arguments, results, memory)
    return TargetText(target, name, precision, function, memory)


def target_header(text: TargetText) -> str:
    """The text of the header."""
    name, upper, target = text.name, text.name.upper(), text.target
    kept = {p.name for p in target.outputs}
    given = [p for p in target.inputs if p.name not in kept]
    remembered = [p.name for p in target.inputs if p.name in kept]
    return "\n".join(
        [
            f"/* {target.title} in C99, made by acausal.",
            "",
            f"   {name} m;         all that it needs; nothing is allocated or shared",
            f"   {name}_init(&m);  what it remembers, as at the beginning; the rest is no number",
            f"   {name}_step(&m);  from {', '.join(f'm.{p.name}' for p in given)}"
            + (f"; moves {', '.join(f'm.{n}' for n in remembered)} on" if remembered else ""),
            "",
            f"   It gives {upper}_NOT_FINITE, and changes nothing, where a result is no finite number. */",
            f"#ifndef {upper}_H",
            f"#define {upper}_H",
            "",
            f"typedef {text.precision} {name}_real;",
            f"typedef enum {{ {upper}_OK = 0, {upper}_NOT_FINITE = 1 }} {name}_status;",
            "",
            "typedef struct {",
            *(line for port in _fields(target) for line in _field(name, port)),
            f"    {name}_real next[{least(text.length)}]; /* all results */",
            f"    {name}_real work[{least(text.function.real)}];",
            f"    int whole_work[{least(text.function.whole)}];",
            f"}} {name};",
            "",
            f"void {name}_init({name} *m);",
            f"{name}_status {name}_step({name} *m);",
            "",
            "#endif",
            "",
        ]
    )


def target_source(text: TargetText) -> str:
    """The text of the source."""
    return "\n".join(_source(text)) + "\n"


def _source(text: TargetText) -> Iterator[str]:
    name, upper, target = text.name, text.name.upper(), text.target
    yield from (f'#include "{name}.h"', "#include <tgmath.h>", "")
    yield from opening(name, text.precision)
    yield ""
    yield from helpers([text.function], text.memory)
    defaults = {p.name: p.default for p in target.inputs if p.default is not None}
    yield f"void {name}_init(Model *m) {{"
    for port in _fields(target):
        yield from _filled(port, defaults.get(port.name))
    yield from ("}", "")
    yield f"{name}_status {name}_step(Model *m) {{"
    for port in target.inputs:
        if mentions(text.function.lines, port.name):
            star = "*const " if port.shape else ""
            yield f"    const real {star}{port.name} = m->{port.name};"
    for port, first in text.results:
        yield f"    real *const next_{port.name} = m->next + {first};"
    yield from text.function.lines
    yield f"    if (!all_finite(m->next, {text.length})) return {upper}_NOT_FINITE;"
    for port in target.outputs:
        if port.shape:
            yield f"    for (int i = 0; i < {_size(port)}; i++) m->{port.name}[i] = next_{port.name}[i];"
        else:
            yield f"    m->{port.name} = next_{port.name}[0];"
    yield from (f"    return {upper}_OK;", "}")


def _fields(target: Target) -> list[TargetPort]:
    """Arguments and results, each name once."""
    return list({p.name: p for p in (*target.outputs, *target.inputs)}.values())


def _field(name: str, port: TargetPort) -> Iterator[str]:
    units = dict(zip(port.elements, port.units, strict=True))
    groups = [(run, units[run.names[0]]) for run in runs(port.elements)]
    size = _size(port) if port.shape else None
    is_matrix = len(port.shape) > 1
    what = "row by row" if is_matrix else ""
    yield from field_lines(name, port.name, [] if is_matrix else groups, size, what)


def _filled(port: TargetPort, default: np.ndarray | None) -> Iterator[str]:
    """The first values of a field."""
    values = np.full(port.shape, np.nan) if default is None else default
    flat = np.ravel(values).tolist()
    if not port.shape:
        yield f"    m->{port.name} = {literal(flat[0], 'real')};"
    elif np.isnan(values).all():
        yield f"    for (int i = 0; i < {len(flat)}; i++) m->{port.name}[i] = NAN;"
    else:
        yield f"    for (int i = 0; i < {len(flat)}; i++) m->{port.name}[i] = 0;"
        for i, value in enumerate(flat):
            if value != 0:
                yield f"    m->{port.name}[{i}] = {literal(value, 'real')};"


def _size(port: TargetPort) -> int:
    return int(np.prod(port.shape, dtype=np.int64))
