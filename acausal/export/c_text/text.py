"""What the files of a model in C say: names, sizes and functions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np

from acausal.export.c_text.code import EXCESS, Code
from acausal.export.c_text.starts import DISCRETE_STARTS, GUESSES, STARTS
from acausal.export.names import NameRange
from acausal.export.vector import ParameterVector
from acausal.simulation import Tableau


@dataclass(frozen=True, eq=False)
class ModelText:
    """What is written about a model.

    Attributes:
        name: of the functions and the struct. title: of the model. precision: "double" or "float".
        code: its functions. solver: of the steps. scheme: its coefficients. vector: its parameters.
        states, inputs, outputs, parameters: names in groups, with units.
        start: states at the start, shape (n_states,). limits: magnitudes beyond which they have run away.
        discrete: names of discrete variables, the conditions first. discrete_start: their values before the start.
    """

    name: str
    title: str
    precision: str
    code: Code
    solver: str
    scheme: Tableau
    vector: ParameterVector
    states: Sequence[tuple[NameRange, str]]
    inputs: Sequence[tuple[NameRange, str]]
    outputs: Sequence[tuple[NameRange, str]]
    parameters: Sequence[tuple[NameRange, str]]
    start: np.ndarray
    limits: np.ndarray
    discrete: Sequence[str]
    discrete_start: np.ndarray

    @property
    def has_events(self) -> bool:
        """Whether the model has events."""
        return self.code.events is not None

    @property
    def has_edges(self) -> bool:
        """Whether the rates jump or bend at times that are known."""
        return "ahead" in self.code.functions

    @property
    def has_starts(self) -> bool:
        """Whether start values follow from time, inputs and parameters."""
        return STARTS in self.code.functions

    @property
    def starts_in_modes(self) -> bool:
        """Whether start values depend on discrete variables, too."""
        return GUESSES in self.code.functions

    @property
    def has_discrete_starts(self) -> bool:
        """Whether start values of discrete variables follow from parameters."""
        return DISCRETE_STARTS in self.code.functions

    @property
    def of_start(self) -> str:
        """What is said of start values."""
        if self.has_starts:
            return "m.x at the start, from m.time, m.u, m.p"
        return "m.x at the start, as exported: whatever m.p"

    @property
    def watches(self) -> bool:
        """Whether it tells that a network leaves the range in which it was trained."""
        return EXCESS in self.code.functions

    @property
    def has_tangent(self) -> bool:
        """Whether there are directional derivatives."""
        return "tangent" in self.code.functions

    def tables(self) -> list[tuple[str, Sequence[tuple[NameRange, str]]]]:
        """Names and units in groups, by kind."""
        return [
            ("states", self.states),
            ("inputs", self.inputs),
            ("outputs", self.outputs),
            ("parameters", self.parameters),
        ]


def least(size: int) -> int:
    """C has no empty arrays."""
    return max(size, 1)


def c_file(file: str, name: str) -> list[str]:
    """The lines of a file of C in this folder, with the names of a model in the place of ``model_`` and others."""
    words = {"model_": f"{name}_", "MODEL_": f"{name.upper()}_", "STATUS_": f"{name.upper()}_"}
    text = files("acausal.export.c_text").joinpath(file).read_text("utf-8")
    return re.sub(rf"\b({'|'.join(words)})", lambda word: words[word[0]], text).splitlines()


def opening(name: str, precision: str) -> Iterator[str]:
    """The types of a source, and how it writes numbers."""
    yield f"typedef {name}_real real;"
    yield f"typedef {name} Model;"
    yield f"#define R(number) number{'##f' if precision == 'float' else ''}"


@cache
def prelude() -> dict[str, str]:
    """Helper functions of C by name; ``real`` is the model's type of number."""
    functions = "\n".join(c_file("prelude.c", "")).split("\n\n")
    return {re.findall(r"static .*?(\w+)\(", function)[0]: function for function in functions}
