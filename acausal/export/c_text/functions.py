"""A function of C from a block: arguments, memory, statements."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from acausal.export.c_text.arrays import CArray, stored
from acausal.export.c_text.expressions import reads
from acausal.export.c_text.lowering import Lowering, Workspace
from acausal.export.c_text.rules import RULES
from acausal.export.c_text.statements import (
    TYPES,
    Assign,
    BreakUnless,
    Buffer,
    Call,
    Choose,
    Comment,
    Declare,
    For,
    Repeat,
    Statement,
    inner,
    names,
    written,
)
from acausal.export.traced import TracedBlock


@dataclass(frozen=True)
class CArgument:
    """An array or a number that a function takes.

    Attributes:
        buffer: its name and size. shape: how it is read. c: the declaration in the function's head.
    """

    buffer: Buffer
    shape: tuple[int, ...]
    offset: int = 0

    @property
    def array(self) -> CArray:
        """As an array to be read."""
        return stored(self.buffer, self.shape, self.offset)


@dataclass(frozen=True)
class CFunction:
    """A function that is written.

    Attributes:
        arguments: what it reads: by name the length of an array, None for a number. results: arrays that it fills.
        lines: those of its body. real, whole: numbers of working memory, by kind.
    """

    arguments: dict[str, int | None]
    results: tuple[str, ...]
    lines: tuple[str, ...]
    real: int
    whole: int


def write_function(
    block: TracedBlock,
    arguments: Sequence[CArgument],
    results: Sequence[tuple[Buffer, int]],
    memory: Workspace,
) -> CFunction:
    """The body of a function.

    Arguments:
        block: its operations.
        arguments: one for each input of the block.
        results: for each output of the block the buffer that it is written to, and from which place on.
        memory: tables and helper functions, shared by the functions of a file.
    """
    statements: list[Statement] = []
    work = Workspace(tables=memory.tables, prelude=memory.prelude, describe=memory.describe)
    work.name = memory.name  # type: ignore[method-assign]
    low = Lowering(RULES, work, statements)
    found = low.lower(block, [a.array for a in arguments])
    for array, (buffer, offset) in zip(found, results, strict=True):
        low.store(array, buffer, offset)
    statements = without_unused(statements, {buffer.name for buffer, _ in results})
    offsets, real, whole = _places(work.work, statements)
    lines = [*_pointers(work.work, offsets), *written(statements)]
    sizes = {a.buffer.name: a.buffer.size for a in arguments}
    return CFunction(sizes, tuple(buffer.name for buffer, _ in results), tuple(lines), real, whole)


def mentions(lines: Sequence[str], name: str) -> bool:
    """Whether some lines of C read a variable."""
    return mentioned(without_comments(lines), name)


def mentioned(body: str, name: str) -> bool:
    """Whether a text without comments reads a variable."""
    return re.search(rf"(?<![\w>.]){name}\b", body) is not None


def without_comments(lines: Sequence[str]) -> str:
    """Lines of C as one text."""
    return re.sub(r"/\*.*?\*/", "", "\n".join(lines))


def _pointers(buffers: Sequence[Buffer], offsets: dict[str, int]) -> Iterator[str]:
    for buffer in buffers:
        if buffer.name in offsets:
            kind = TYPES[buffer.kind]
            pool = "work" if kind == "real" else "whole_work"
            yield f"    {kind} *const {buffer.name} = m->{pool} + {offsets[buffer.name]};"


def _places(
    buffers: Sequence[Buffer], statements: Sequence[Statement]
) -> tuple[dict[str, int], int, int]:
    """Where arrays lie in the working memory: two that are never needed together may share a place."""
    wanted = {b.name for b in buffers}
    first: dict[str, int] = {}
    last: dict[str, int] = {}
    for number, statement in enumerate(statements):
        for name in names(statement) & wanted:
            first.setdefault(name, number)
            last[name] = number
    offsets: dict[str, int] = {}
    ends = {"real": 0, "int": 0}
    for kind in ends:
        placed: list[Buffer] = []
        own = [b for b in buffers if b.name in first and TYPES[b.kind] == kind]
        for buffer in sorted(own, key=lambda b: first[b.name]):
            together = sorted(
                (offsets[p.name], p.size or 1) for p in placed if last[p.name] >= first[buffer.name]
            )
            place = 0
            for start, size in together:
                if place + (buffer.size or 1) <= start:
                    break
                place = max(place, start + size)
            offsets[buffer.name] = place
            placed.append(buffer)
            ends[kind] = max(ends[kind], place + (buffer.size or 1))
    return offsets, ends["real"], ends["int"]


def without_unused(statements: Sequence[Statement], results: Collection[str]) -> list[Statement]:
    """The statements of a function that its results depend on, by the names of the arrays that it is to fill."""
    kept = list(statements)
    while True:
        live = _live(kept, results)
        fewer = _kept(kept, live)
        if _count(fewer) == _count(kept):
            return fewer
        kept = fewer


def _live(statements: Sequence[Statement], results: Collection[str]) -> set[str]:
    """The names that results, or conditions of loops and choices, depend on."""
    needs: dict[str, set[str]] = {}
    live = set(results)
    for statement in _all(statements):
        match statement:
            case Assign(target, value):
                inside = set[str]() if target.index is None else reads(target.index)
                needs.setdefault(target.name, set()).update(reads(value) | inside)
            case Call():
                every = names(statement)
                for name in every:
                    needs.setdefault(name, set()).update(every)
            case BreakUnless(condition) | Choose(condition):
                live |= reads(condition)
            case _:
                pass
    waiting = list(live)
    while waiting:
        for name in needs.pop(waiting.pop(), ()):
            if name not in live:
                live.add(name)
                waiting.append(name)
    return live


def _kept(statements: Sequence[Statement], live: set[str]) -> list[Statement]:
    found: list[Statement] = []
    for statement in statements:
        match statement:
            case Assign(target) if target.name not in live:
                continue
            case Declare(buffer) if buffer.name not in live:
                continue
            case Call() if not names(statement) & live:
                continue
            case For(index, extent, body):
                inside = _kept(body, live)
                if inside:
                    found.append(For(index, extent, inside))
            case Choose(condition, yes, no):
                chosen = Choose(condition, _kept(yes, live), _kept(no, live))
                if chosen.yes or chosen.no:
                    found.append(chosen)
            case Repeat(body):
                found.append(Repeat(_kept(body, live)))
            case _:
                found.append(statement)
    return found


def _all(statements: Sequence[Statement]) -> Iterator[Statement]:
    for statement in statements:
        yield statement
        for block in inner(statement):
            yield from _all(block)


def _count(statements: Sequence[Statement]) -> int:
    return sum(not isinstance(s, Comment) for s in _all(statements))
