"""Names in groups: ``mass[1].s ... mass[10000].s`` is one entry, not ten thousand."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

INDEX = re.compile(r"\[(\d+)\]")


@dataclass(frozen=True)
class NameRange:
    """Variables that are alike and lie evenly in an array.

    Attributes:
        before, after: the name around the index; a single variable has no index, and all of its name in ``before``.
        index: of the first one, or None for a single variable.
        first: where it lies. stride: from each to the next. count: how many there are.
    """

    before: str
    first: int
    count: int = 1
    stride: int = 1
    after: str = ""
    index: int | None = None

    @property
    def name(self) -> str:
        """``mass[1:10000].s``, or the name of the only one."""
        if self.index is None:
            return self.before
        return f"{self.before}[{self.index}:{self.index + self.count - 1}]{self.after}"

    @property
    def names(self) -> tuple[str, ...]:
        """Of all variables, in order."""
        if self.index is None:
            return (self.before,)
        return tuple(f"{self.before}[{self.index + k}]{self.after}" for k in range(self.count))

    @property
    def places(self) -> range:
        """Where they lie."""
        return range(self.first, self.first + self.stride * self.count, self.stride)


def runs(names: Sequence[str]) -> list[NameRange]:
    """Groups of variables, which are named in the order in which they lie, in the order of their first ones."""
    groups: dict[tuple[str, str], list[tuple[int, int]]] = {}
    for place, name in enumerate(names):
        found = INDEX.search(name)
        if found is None:
            groups[(name, "")] = [(0, place)]
        else:
            key = (name[: found.start()], name[found.end() :])
            groups.setdefault(key, []).append((int(found[1]), place))
    result: list[NameRange] = []
    for (before, after), members in groups.items():
        if len(members) == 1 and before == names[members[0][1]]:
            result.append(NameRange(before, members[0][1]))
            continue
        result += _even(before, after, members)
    return sorted(result, key=lambda r: r.first)


def _even(before: str, after: str, members: list[tuple[int, int]]) -> list[NameRange]:
    """The longest runs whose indices count up one by one and whose places are evenly apart."""
    result: list[NameRange] = []
    start = 0
    while start < len(members):
        end, stride = start + 1, 1
        if end < len(members) and members[end][0] == members[start][0] + 1:
            stride = members[end][1] - members[start][1]
            while (
                end < len(members)
                and stride > 0
                and members[end][0] == members[end - 1][0] + 1
                and members[end][1] == members[end - 1][1] + stride
            ):
                end += 1
        index, first = members[start]
        if end - start == 1:
            result.append(NameRange(f"{before}[{index}]{after}", first))
        else:
            result.append(NameRange(before, first, end - start, stride, after, index))
        start = end
    return result
