"""Statements of C: assignments, loops, conditions; what they read and write; how they are printed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from acausal.export.c_text.expressions import Expr, Read, reads, text


@dataclass
class Buffer:
    """An array or a number that statements write.

    Attributes:
        name: as C calls it. kind: "real", "int" or "bool". size: how many elements; None for a single number.
        table: values of a constant array.
    """

    name: str
    kind: str
    size: int | None
    table: Sequence[float] | None = None


@dataclass(frozen=True)
class Assign:
    """An assignment; one that ``declares`` makes a constant."""

    target: Read
    value: Expr
    declares: bool = False
    op: str = "="


@dataclass(frozen=True)
class For:
    """A loop over an index from 0 to below an extent."""

    index: str
    extent: int
    body: list[Statement] = field(default_factory=list["Statement"])


@dataclass(frozen=True)
class Repeat:
    """``for (;;)``, ended by a `BreakUnless`."""

    body: list[Statement] = field(default_factory=list["Statement"])


@dataclass(frozen=True)
class BreakUnless:
    """The end of a `Repeat`, unless a condition holds."""

    unless: Expr


@dataclass(frozen=True)
class Choose:
    """One block or another."""

    condition: Expr
    yes: list[Statement] = field(default_factory=list["Statement"])
    no: list[Statement] = field(default_factory=list["Statement"])


@dataclass(frozen=True)
class Call:
    """A function of the prelude, called for what it writes."""

    function: str
    args: tuple[Expr | str, ...]


@dataclass(frozen=True)
class Declare:
    """A small array of this block."""

    buffer: Buffer


@dataclass(frozen=True)
class Comment:
    """Where the statements after it come from."""

    words: str


Statement: TypeAlias = Assign | For | Repeat | BreakUnless | Choose | Call | Declare | Comment


def inner(statement: Statement) -> Iterator[list[Statement]]:
    """The blocks within a statement."""
    match statement:
        case For(_, _, body) | Repeat(body):
            yield body
        case Choose(_, yes, no):
            yield yes
            yield no
        case _:
            pass


def names(statement: Statement) -> set[str]:
    """The names of all that a statement reads or writes."""
    found: set[str] = set()
    match statement:
        case Assign(target, value):
            found |= reads(target) | reads(value)
        case BreakUnless(condition) | Choose(condition):
            found |= reads(condition)
        case Call(_, args):
            for arg in args:
                found |= {arg} if isinstance(arg, str) else reads(arg)
        case _:
            pass
    for block in inner(statement):
        for each in block:
            found |= names(each)
    return found


TYPES = {"real": "real", "int": "int", "bool": "int"}


def written(statements: Sequence[Statement], depth: int = 1) -> Iterator[str]:
    """The lines of a block."""
    pad = "    " * depth
    for statement in statements:
        match statement:
            case Assign(target, value, declares, op):
                before = f"const {TYPES[target.kind]} " if declares else ""
                yield f"{pad}{before}{text(target)} {op} {text(value)};"
            case For(index, extent, body):
                head = f"{pad}for (int {index} = 0; {index} < {extent}; {index}++)"
                yield from _body(head, body, depth)
            case Repeat(body):
                yield f"{pad}for (;;) {{"
                yield from written(body, depth + 1)
                yield f"{pad}}}"
            case BreakUnless(condition):
                yield f"{pad}if (!({text(condition)})) break;"
            case Choose(condition, yes, no):
                yield f"{pad}if ({text(condition)}) {{"
                yield from written(yes, depth + 1)
                if no:
                    yield f"{pad}}} else {{"
                    yield from written(no, depth + 1)
                yield f"{pad}}}"
            case Call(function, args):
                inside = ", ".join(a if isinstance(a, str) else text(a) for a in args)
                yield f"{pad}{function}({inside});"
            case Declare(buffer):
                length = "" if buffer.size is None else f"[{buffer.size}]"
                yield f"{pad}{TYPES[buffer.kind]} {buffer.name}{length};"
            case Comment(words):
                yield f"{pad}/* {words.replace('*/', '* /')} */"


def _body(head: str, body: list[Statement], depth: int) -> Iterator[str]:
    if len(body) == 1 and isinstance(body[0], Assign):
        (line,) = written(body, 0)
        yield f"{head} {line}"
        return
    if len(body) == 1 and isinstance(body[0], For):
        yield head
        yield from written(body, depth + 1)
        return
    yield f"{head} {{"
    yield from written(body, depth + 1)
    yield "    " * depth + "}"
