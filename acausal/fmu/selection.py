"""What a user wants of an FMU: which of its variables are parameters, inputs and results of the model."""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

from acausal.errors import DeclarationError, known_name, need_whole, shown
from acausal.fmu.description import (
    CLOCK,
    NUMBERS,
    REAL,
    STRUCTURAL,
    TRIGGERED,
    Description,
    FMUVariable,
    Interface,
)


def interface(description: Description, kind: Any) -> Interface:
    """Model exchange where the FMU has it, else co-simulation, or what the user wants.

    Raises:
        DeclarationError: for a kind that the FMU has not.
    """
    has: list[Interface] = [k for k in ("me", "cs") if description.library(k)]
    if kind is not None and not (isinstance(kind, str) and kind in has):
        raise DeclarationError(
            f"FMU: '{description.model}' has {' and '.join(map(repr, has))}, not kind={shown(kind)}; "
            "'me' is model exchange, 'cs' co-simulation."
        )
    return kind or has[0]


def communication_step(description: Description, kind: Interface, step: Any) -> float:
    """The communication step of co-simulation, or the time after which model exchange is told of a completed step [s].

    0 where nobody is told. FMI 3.0 says which FMUs need it; by FMI 2.0 nearly all say that they do.

    Raises:
        DeclarationError: for what is not a time above zero, or for model exchange that need not be told.
    """
    if step is None:
        told = description.completes and description.version == "3.0"
        return description.step if kind == "cs" or told else 0.0
    if kind == "me" and not description.completes:
        raise DeclarationError(
            f"FMU: '{description.model}' is used by model exchange, which has no communication step, and need not be "
            "told of completed steps; leave step= out, or give kind='cs'."
        )
    if not isinstance(step, Real) or not 0 < float(step) < math.inf:
        raise DeclarationError(f"FMU: step={shown(step)} must be a time above zero, in seconds.")
    return float(step)


def memory_size(kind: Interface, memory: Any, *, open_loop: bool, clocked: bool) -> int:
    """The number of communication steps over which gradients go through inputs.

    Raises:
        DeclarationError: for what is no such number, or where it means nothing.
    """
    memory = need_whole(memory, "FMU: memory", DeclarationError, 0)
    if memory and (kind == "me" or open_loop or clocked):
        why = (
            "model exchange, which has gradients"
            if kind == "me"
            else "open_loop=True, which has none"
            if open_loop
            else "one with outputs that clocks compute"
        )
        raise DeclarationError(
            f"FMU: memory={memory} is for gradients through inputs of a co-simulation, not {why}."
        )
    return memory


class Chosen:
    """The variables of an FMU, sorted.

    Attributes:
        values: by name. settings: those of no real parameters. parameters, inputs, results: variables, in order.
    """

    def __init__(
        self,
        description: Description,
        kind: Interface,
        values: dict[str, Any],
        observe: tuple[str, ...],
    ) -> None:
        known = description.variables
        refusal = f"FMU: '{description.model}' has no variable"
        for name in (*values, *observe):
            known_name(name, known, refusal, DeclarationError)
        self.values = values
        for clock in (known[n] for n in values if known[n].type == CLOCK):
            _need_interval(clock, values[clock.name], description)
        if kind == "cs" and description.clocks and not description.event_mode:
            raise DeclarationError(
                f"FMU: '{description.model}' has the clock '{description.clocks[0].name}', but its co-simulation has "
                "no event mode in which clocks tick; use kind='me' if it has that, or export it with event mode."
            )
        self.settings = {n: v for n, v in values.items() if _is_setting(known[n])}
        starts = [known[n] for n in values if known[n] not in description.parameters]
        starts = [v for v in starts if v.name not in self.settings and v.causality != "input"]
        for v in starts:
            if v.initial != "exact" or v.type not in REAL[:2] or v.variability == "constant":
                raise DeclarationError(
                    f"FMU: '{v.name}' of '{description.model}' is computed by the FMU and takes no value."
                )
        self.parameters = [*description.parameters, *starts]
        for v in self.parameters:
            if v.shape is not None and v.start is None and v.name not in values:
                raise DeclarationError(
                    f"FMU: '{description.model}' has no values for {v.size} elements of '{v.name}': give "
                    f"{{'{v.name}': ...}}, an array of shape {v.shape}."
                )
        inputs = sorted(description.of("input"), key=lambda v: NUMBERS.index(v.type))
        ticks = [v for v in description.of("input", (CLOCK,)) if v.clock.kind == TRIGGERED]
        self.inputs = [*inputs, *(v for v in ticks if v.name not in values)]
        if kind == "cs":  # an input with a value is what a parameter is: it holds from the start
            self.parameters += [v for v in self.inputs if v.name in values]
            self.inputs = [v for v in self.inputs if v.name not in values]
        results = [known[n] for n in dict.fromkeys((*description.outputs, *observe))]
        arrays = [known[n] for n in description.states if kind == "me" and known[n].size > 1]
        elements = {e for v in arrays for e in v.names}  # an output that is one stands twice
        results = [v for v in results if v.name not in elements]
        self.results = [v for v in results if v.type in (*NUMBERS, CLOCK)]


def _is_setting(variable: FMUVariable) -> bool:
    """Whether a value is fixed when the FMU is made."""
    return variable.causality == STRUCTURAL or (
        variable.type == CLOCK
        or (variable.causality == "parameter" and variable.type not in REAL[:2])
    )


def _need_interval(clock: FMUVariable, value: Any, description: Description) -> None:
    """Refuse what is no interval, or is for a clock that knows its own."""
    if clock.causality != "input" or not clock.clock.takes_interval:
        raise DeclarationError(
            f"FMU: the clock '{clock.name}' of '{description.model}' is {clock.clock.kind}: it takes no interval."
        )
    if not isinstance(value, Real) or not 0 < float(value) < math.inf:
        raise DeclarationError(
            f"FMU: the interval {shown(value)} of the clock '{clock.name}' must be a time above zero, in seconds."
        )


def name_of(variable: FMUVariable) -> str:
    """The name of a value that a model gives: a start value is not the variable itself."""
    own = variable.causality in ("parameter", "input")
    return variable.name if own else f"{variable.name}.start"
