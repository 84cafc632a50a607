"""Tearing: which unknowns of a block to guess, so that all others follow one by one. This file knows integers only.

An equation with one open unknown, for which it can be solved, determines it. What follows from a set of guesses does
not depend on the order in which equations are used, and grows with the set: a guess that follows from the others
can be dropped. To find the smallest set is NP-hard. Here guesses are added greedily, by how much follows from each
(F. Cellier, E. Kofman: Continuous System Simulation, 2006, section 7.6; E. Carpanzano: Order reduction of general
nonlinear DAE systems by automatic tearing, 2000), then dropped and exchanged as long as that leaves fewer.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush

from acausal.structure.graph import equations_of

WORK = 250_000
"""The most entries of the incidence that each half of a search looks at; a tenth of a second or so."""


@dataclass(frozen=True)
class Torn:
    """A torn block: guess ``tears``, compute ``assigned`` in order as (equation, variable), check ``residuals``."""

    tears: tuple[int, ...]
    assigned: tuple[tuple[int, int], ...]
    residuals: tuple[int, ...]


@dataclass(frozen=True)
class Preference:
    """How much a variable is preferred as a tearing variable.

    Attributes:
        rank: those of a higher rank are torn before others, whatever follows from them.
        required: it is torn in any case.
        guessed: there is a good guess of it: of those from which equally many others follow, it is torn.
        better: it is torn where another one would do as well.
    """

    rank: int = 0
    required: bool = False
    guessed: bool = False
    better: bool = False


def tear(
    incidence: Sequence[Sequence[int]],
    solvable: Callable[[int, int], bool],
    n_variables: int,
    preference: Callable[[int], Preference] = lambda variable: Preference(),
) -> Torn:
    """Choose tearing variables of a block: few, and always the same ones.

    Arguments:
        incidence: the variables of every equation. ``solvable``: whether an equation can be solved for one of them.
        preference: of a variable.
    """
    block = _Block(incidence, solvable, n_variables)
    preferences = [preference(v) for v in range(n_variables)]
    found = _greedy(block, preferences)
    found = _pruned(block, preferences, found)
    while (better := _one_for_two(block, preferences, found)) is not None:
        found = better
    return block.torn(found)


class _Block:
    """The incidence, and which variables are known: `learn` adds one and all that follows from it."""

    def __init__(
        self,
        incidence: Sequence[Sequence[int]],
        solvable: Callable[[int, int], bool],
        n_variables: int,
    ) -> None:
        self.n = n_variables
        self.rows = [list(dict.fromkeys(row)) for row in incidence]
        self.solvable = [{v for v in row if solvable(e, v)} for e, row in enumerate(self.rows)]
        self.columns = equations_of(self.rows, n_variables)
        self.work = 0
        self.reset()

    def reset(self) -> None:
        """Forget everything, except for what equations of one variable determine."""
        self.known = [False] * self.n
        self.open = [len(row) for row in self.rows]
        for e, row in enumerate(self.rows):
            if len(row) == 1 and not self.known[row[0]] and row[0] in self.solvable[e]:
                self.learn(row[0])

    def learn(self, variable: int) -> list[int]:
        """All that becomes known with a variable."""
        known, still_open, columns = self.known, self.open, self.columns
        known[variable] = True
        found = [variable]
        for v in found:  # which grows
            self.work += len(columns[v])
            for e in columns[v]:
                still_open[e] -= 1
                if still_open[e] == 1:
                    rest = next((u for u in self.rows[e] if not known[u]), -1)
                    if rest in self.solvable[e]:
                        known[rest] = True
                        found.append(rest)
        return found

    def forget(self, variables: Iterable[int]) -> None:
        """Undo `learn`, given its result."""
        for v in variables:
            self.known[v] = False
            for e in self.columns[v]:
                self.open[e] += 1

    def learn_all(self, variables: Iterable[int]) -> bool:
        """Start again from these variables; whether all others follow."""
        self.reset()
        for v in variables:
            if not self.known[v]:
                self.learn(v)
        return all(self.known)

    def torn(self, tears: Sequence[int]) -> Torn:
        """In which order the other variables follow, from which equations."""
        known, still_open = [False] * self.n, [len(row) for row in self.rows]
        used = [False] * len(self.rows)
        ready = [e for e, count in enumerate(still_open) if count == 1]
        assigned: list[tuple[int, int]] = []

        def follow(variable: int) -> None:
            known[variable] = True
            for e in self.columns[variable]:
                still_open[e] -= 1
                if still_open[e] == 1:
                    heappush(ready, e)

        for v in tears:
            follow(v)
        while ready:
            e = heappop(ready)
            rest = next((v for v in self.rows[e] if not known[v]), -1)
            if rest in self.solvable[e]:
                used[e] = True
                assigned.append((e, rest))
                follow(rest)
        residuals = tuple(e for e, is_used in enumerate(used) if not is_used)
        return Torn(tuple(tears), tuple(assigned), residuals)


def _greedy(block: _Block, preferences: Sequence[Preference]) -> list[int]:
    """Tear what is required, then again and again the variable from which most others follow.

    Of equals, one with a good guess, then the one whose equations are nearest to be used.
    """
    block.reset()
    tears = [v for v, p in enumerate(preferences) if p.required]
    for v in tears:
        if not block.known[v]:
            block.learn(v)
    ranks = sorted({-p.rank for p in preferences})
    for rank in ranks:
        candidates = [v for v, p in enumerate(preferences) if -p.rank == rank]
        while candidates := [v for v in candidates if not block.known[v]]:
            candidates.sort(key=lambda v: _worse(block, preferences[v], v))
            chosen, most = candidates[0], 0
            for v in candidates if block.work < WORK else ():
                found = block.learn(v)
                block.forget(found)
                if len(found) > most:
                    chosen, most = v, len(found)
            tears.append(chosen)
            block.learn(chosen)
    return tears


def _worse(block: _Block, preference: Preference, variable: int) -> tuple[bool, float, bool, int]:
    """Puts candidates in order, the best one first.

    The nearer its equations are to have one open variable, the better; each more halves an equation's weight.
    """
    nearness = sum(0.5 ** block.open[e] for e in block.columns[variable])
    return not preference.guessed, -nearness, not preference.better, variable


def _pruned(block: _Block, preferences: Sequence[Preference], tears: list[int]) -> list[int]:
    """The tears without those that follow from the others; of the lowest rank first, then the earliest."""
    order = sorted(tears, key=lambda v: preferences[v].rank)
    for v in order if block.work < 2 * WORK else ():
        rest = [t for t in tears if t != v]
        if not preferences[v].required and block.learn_all(rest):
            tears = rest
    return tears


def _one_for_two(
    block: _Block, preferences: Sequence[Preference], tears: list[int]
) -> list[int] | None:
    free = [v for v in tears if not preferences[v].required]
    for pair in itertools.combinations(free, 2):
        if block.work > 2 * WORK:
            return None
        rest = [t for t in tears if t not in pair]
        block.learn_all(rest)
        missing = block.known.count(False)
        least = min(preferences[v].rank for v in pair)
        for v in range(block.n):
            if block.known[v] or preferences[v].rank < least:
                continue
            found = block.learn(v)
            block.forget(found)
            if len(found) == missing:
                return [*rest, v]
    return None
