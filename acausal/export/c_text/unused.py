"""Leave out statements whose results nothing reads."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from acausal.export.c_text.expressions import reads
from acausal.export.c_text.statements import (
    Assign,
    BreakUnless,
    Call,
    Choose,
    Comment,
    Declare,
    For,
    Repeat,
    Statement,
    inner,
    names,
)


def without_unused(statements: Sequence[Statement], results: Collection[str]) -> list[Statement]:
    """The statements that a result depends on.

    Arguments:
        statements: of a function. results: the names of the arrays that it is to fill.
    """
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
