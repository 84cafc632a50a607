"""One FMU in a model: which of its variables are known to the model, and what is fixed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from typing import Any

from acausal.fmu.description import REAL, Description, Interface, timed_clocks


@dataclass(frozen=True)
class Part:
    """An FMU with what a model fixes of it.

    Attributes:
        path: of the archive, as the user gave it. digest: of its content. description: of the FMU.
        settings: values that are fixed and no real parameters, by name.
        parameters, inputs, results: names of what a model gives, and of what it reads.
        kind: model exchange or co-simulation. step: the communication step [s].
        open_loop: whether gradients take the inputs of a co-simulation as they are.
        memory: the communication steps over which gradients go through these inputs.
    """

    path: str
    digest: str
    description: Description
    settings: tuple[tuple[str, Any], ...]
    parameters: tuple[str, ...]
    inputs: tuple[str, ...]
    results: tuple[str, ...]
    kind: Interface = "me"
    step: float = 0.0
    open_loop: bool = False
    memory: int = 0

    # -- sizes -----------------------------------------------------------------------------------

    def elements(self, names: tuple[str, ...]) -> list[str]:
        """The elements of some variables."""
        return [e for n in names for e in self.description.variables[n].names]

    @cached_property
    def n(self) -> int:
        """How many states there are that the model integrates."""
        return len(self.elements(self.description.states)) if self.kind == "me" else 0

    @cached_property
    def n_inputs(self) -> int:
        """How many inputs there are."""
        return len(self.elements(self.inputs))

    @cached_property
    def n_parameters(self) -> int:
        """How many parameters there are."""
        return len(self.elements(self.parameters))

    @cached_property
    def n_values(self) -> int:
        """How many numbers an evaluation gives: rates, results, indicators."""
        indicators = self.description.indicators if self.kind == "me" else 0
        return self.n + len(self.elements(self.results)) + indicators

    @cached_property
    def n_next(self) -> int:
        """How many times of events are known: that of the FMU's next time event, and those of clocks."""
        return 1 + len(timed_clocks(self.description, [name for name, _ in self.settings]))

    @cached_property
    def behind(self) -> list[bool]:
        """Which results of a co-simulation are read behind the inputs of a communication point, where clocks tick."""
        known = [self.description.variables[n] for n in self.results]
        return [self.description.is_of_ticks(v) for v in known for _ in range(v.size)]

    @cached_property
    def sampled(self) -> dict[int, bool]:
        """The places of inputs that are taken at events, ticks or communication points alone; whether each is real."""
        known, first = self.description.variables, 2 + self.n
        inputs = [v for v in (known[n] for n in self.inputs) for _ in range(v.size)]
        held = [self.kind == "cs" or v.is_clocked or v.is_discrete_input for v in inputs]
        return {first + i: v.type in REAL for i, v in enumerate(inputs) if held[i]}

    @cached_property
    def key(self) -> str:
        """It stands for all that the part is."""
        of = {**self.__getstate__(), "path": "", "description": ""}
        return sha256(repr(of).encode()).hexdigest()

    def __getstate__(self) -> dict[str, Any]:
        """Without what was computed."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}
