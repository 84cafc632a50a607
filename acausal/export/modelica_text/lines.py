"""Values of a block: texts of elements, that get a name and an equation where they need one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any

import numpy as np

from acausal.export.modelica_text.spelling import array

Index = tuple[str, ...]
LETTERS = "ijkl"
LARGE = 1e300
"""In the place of infinity."""


@dataclass
class Body:
    """Declarations and equations of a block, as they are found."""

    declarations: list[str] = field(default_factory=list)
    equations: list[str] = field(default_factory=list)
    counts: dict[str, count[int]] = field(default_factory=dict)

    def declare(self, shape: Sequence[int], kind: str = "Real", value: str = "") -> str:
        """The name of a new variable or constant."""
        letter = "c" if value else {0: "s", 1: "h"}.get(len(shape), "m")
        name = f"{letter}{next(self.counts.setdefault(letter, count(1)))}"
        binding = f" = {value}" if value else ""
        self.declarations.append(f"{kind} {name}{sizes(shape)}{binding};")
        return name

    def assign(
        self, name: str, shape: Sequence[int], element: Callable[[Index], str], at: int = 0
    ) -> None:
        """An equation for each element, in loops; ``at`` is added to the first index."""
        letters = [LETTERS[d] if n > 1 else "1" for d, n in enumerate(shape)]
        left = [shifted(i, at) if d == 0 else i for d, i in enumerate(letters)]
        target = f"{name}[{', '.join(left)}]" if shape else name
        line = f"{target} = {bare(element(tuple(letters)))};"
        for letter, n in reversed(list(zip(letters, shape, strict=True))):
            if n > 1:
                line = f"for {letter} in 1:{n} loop {line} end for;"
        self.equations.append(line)


def sizes(shape: Sequence[int]) -> str:
    """Sizes behind a name."""
    return f"[{', '.join(map(str, shape))}]" if shape else ""


def shifted(index: str, by: int, step: int = 1) -> str:
    """``step (index - 1) + 1 + by``, a number where the index is one."""
    if index.lstrip("-").isdigit():
        return str(step * (int(index) - 1) + 1 + by)
    if step == 1:
        return index if by == 0 else f"{index} {'+' if by > 0 else '-'} {abs(by)}"
    return f"{step}*({index}) + {1 + by - step}".replace("+ -", "- ")


def bare(text: str) -> str:
    """Without parentheses around all of it."""
    if not (text.startswith("(") and text.endswith(")")):
        return text
    depth = 0
    for place, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if depth == 0 and place < len(text) - 1:
            return text
    return text[1:-1]


class BlockTerm:
    """An array, or a number, of a block.

    Attributes:
        shape: its sizes. whole: its text as a whole, if it has one. truth: whether it is a condition.
        value: its value, if that is known.
    """

    def __init__(
        self,
        block: Body,
        shape: Sequence[int],
        element: Callable[[Index], str] | None,
        *,
        whole: str | None = None,
        truth: bool = False,
        plain: bool = False,
        value: np.ndarray | None = None,
    ) -> None:
        self.block, self.shape, self.truth = block, tuple(map(int, shape)), truth
        self.whole, self._element, self._plain = whole, element, plain
        self.value = value

    def at(self, index: Index) -> str:
        """The text of an element."""
        if self._element is None:
            self.name()
        assert self._element is not None
        return self._element(index)

    @property
    def is_product(self) -> bool:
        """Whether it is known as a whole only."""
        return self._element is None

    @property
    def is_plain(self) -> bool:
        """Whether its elements cost nothing to write again: names and numbers."""
        return self._plain

    def name(self) -> str:
        """Its name, with an equation where it has none yet."""
        if self._plain and self.whole is not None:
            return self.whole
        if self.truth:
            return self.at(())
        if self._element is not None:
            self._element(("1",) * len(self.shape))  # what it needs gets its name first
        new = self.block.declare(self.shape)
        if self._element is None:
            self.block.equations.append(f"{new} = {bare(self.whole or '')};")
        else:
            self.block.assign(new, self.shape, self._element)
        self.whole, self._plain, self._element = new, True, elements(new)
        return new


def elements(name: str) -> Callable[[Index], str]:
    """The elements of what has a name."""
    return lambda index: f"{name}[{', '.join(index)}]" if index else name


def named(block: Body, name: str, shape: Sequence[int]) -> BlockTerm:
    """What has a name."""
    return BlockTerm(block, shape, elements(name), whole=name, plain=True)


def known(block: Body, value: np.ndarray) -> BlockTerm:
    """A number, or an array of numbers, which becomes a constant."""
    truth = value.dtype == bool
    spelled = _truth if truth else _number
    if value.size and (value == value.flat[0]).all():
        same = spelled(value.flat[0])
        whole = None if value.ndim else same
        return BlockTerm(
            block, value.shape, lambda _: same, whole=whole, truth=truth, plain=True, value=value
        )
    kind = "constant Boolean" if truth else "constant Real"
    name = block.declare(value.shape, kind, array(value, spelled))
    return BlockTerm(
        block, value.shape, elements(name), whole=name, truth=truth, plain=True, value=value
    )


def _truth(value: Any) -> str:
    return "true" if value else "false"


def _number(value: Any) -> str:
    number = float(value)
    if not np.isfinite(number):  # Modelica's numbers are finite
        number = float(np.nan_to_num(number, nan=0.0, posinf=LARGE, neginf=-LARGE))
    text = array(np.asarray(number))
    return f"({text})" if text.startswith("-") else text
