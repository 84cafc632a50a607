"""Sets of things that are joined two by two."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Generic, TypeVar

T = TypeVar("T", bound=Hashable)


class UnionFind(Generic[T]):
    """Disjoint sets, in order of appearance."""

    def __init__(self) -> None:
        self.parent: dict[T, T] = {}

    def find(self, thing: T) -> T:
        """What stands for the set of a thing."""
        self.parent.setdefault(thing, thing)
        while self.parent[thing] != thing:
            self.parent[thing] = self.parent[self.parent[thing]]
            thing = self.parent[thing]
        return thing

    def join(self, a: T, b: T) -> None:
        """Unite two sets."""
        first, second = self.find(a), self.find(b)
        self.parent[second] = first

    def all(self) -> list[list[T]]:
        """The sets."""
        sets: dict[T, list[T]] = {}
        for thing in list(self.parent):
            sets.setdefault(self.find(thing), []).append(thing)
        return list(sets.values())
