"""An FMU as a component: its states among the model's, its inputs and outputs as signals."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from acausal.errors import DeclarationError, nearest, shown
from acausal.fmu.archive import read
from acausal.fmu.description import NUMBERS, REAL, Description, FMUVariable, read_description
from acausal.fmu.fmu_view import as_html, as_text
from acausal.fmu.function import FMUFunction
from acausal.fmu.part import NEVER, Part
from acausal.modeling import (
    HALF,
    Component,
    Declaration,
    Discrete,
    Eq,
    GivenModule,
    Input,
    Module,
    Output,
    Parameter,
    Reinit,
    Variable,
    When,
    der,
    pre,
    time,
    where,
)

HISTORY, NEXT, INDICATORS = "fmu.history", "fmu.next", "fmu.indicators"
"""Names of what the model knows of the FMU's events."""


class FMU(Component):
    """A part that somebody else made: an FMU for model exchange, by FMI 2.0 or 3.0.

    Its continuous states are states of the model. Inputs and outputs are signals, ``plant.f`` or ``plant["mass.s"]``.
    Its real parameters are parameters of the component, by the FMU's names. **To simulate an FMU runs native code that
    it brings along.**

    Arguments:
        path: of the file.
        values: by the FMU's names, values of parameters; of inputs, which are then parameters, too; and of variables
            whose start value the FMU takes as it is, which become parameters ``"mass.s.start"``.
        observe: names of further variables that the model reads.

    Raises:
        DeclarationError: for a file that is not a sound FMU, an unknown name, or what is not supported.
    """

    values = Module(doc="what the FMU computes between events")
    event = Module(doc="what the FMU computes at an event")

    def __init__(
        self,
        path: str | Path,
        values: Mapping[str, Any] | None = None,
        *,
        observe: Sequence[str] = (),
    ) -> None:
        digest, folder = read(path)
        description = read_description(folder, path)
        chosen = _Chosen(description, dict(values or {}), tuple(observe))
        part = Part(
            str(Path(path).resolve()),
            digest,
            description,
            tuple(sorted(chosen.settings.items())),
            tuple(v.name for v in chosen.parameters),
            tuple(v.name for v in chosen.inputs),
            tuple(v.name for v in chosen.results),
        )
        super().__init__(values=FMUFunction(part, "evaluate"), event=FMUFunction(part, "event"))
        self._node.title = description.model
        self._part = part
        self._has_events = part.has_events()
        self._names: dict[str, str] = {}
        self._declare(chosen)

    @property
    def description(self) -> Description:
        """What the FMU says of itself."""
        return self._part.description

    def __getitem__(self, name: str) -> Any:
        """A variable of the FMU that the model knows, by the FMU's name.

        Raises:
            DeclarationError: for any other name.
        """
        if name not in self._names:
            raise DeclarationError(
                f"{self._node.label} has no '{name}': {nearest(name, list(self._names))}"
            )
        return vars(self)[self._names[name]]

    def __repr__(self) -> str:
        return as_text(self._part)

    def _repr_html_(self) -> str:
        """For notebooks."""
        return as_html(self._part)

    # -- declarations ------------------------------------------------------------------------------

    def _declare(self, chosen: _Chosen) -> None:
        constant = [v for v in chosen.inputs if v.name in chosen.values]
        for v in (*chosen.parameters, *constant):
            name = _name(v)
            low, high = (None if np.isinf(limit) else limit for limit in (v.minimum, v.maximum))
            declared = Parameter(unit=v.unit, min=low, max=high, shape=v.shape, doc=v.text)
            self._add_declaration(name, declared)
            given = chosen.values.get(v.name, v.starts if v.shape is not None else v.starts[0])
            self.modify(**{self._names[name]: given})
        for v in chosen.inputs:
            if v.name not in chosen.values:
                kind = "bool" if v.type == "Boolean" else "real" if v.type in REAL else "int"
                self._add_declaration(
                    v.name, Input(kind=kind, unit=v.unit, shape=v.shape, doc=v.text)
                )
        known = self.description.variables
        first, seen = 0, {v.name for v in chosen.results}
        for v in (known[n] for n in self.description.states):
            start = f"fmu_start_{first}"
            vars(self)[start] = self._starts(first, v)
            kind = Output if v.name in seen else Variable
            declared = kind(
                start=start,
                unit=v.unit,
                nominal=v.nominal,
                state="always",
                shape=v.shape,
                doc=v.text,
            )
            self._add_declaration(v.name, declared)
            first += v.size
        for v in chosen.results:
            if v.name not in self._names:
                self._add_declaration(v.name, Output(unit=v.unit, shape=v.shape, doc=v.text))
        if self._has_events:
            self._add_declaration(
                HISTORY, Discrete(0, kind="int", doc="number of the FMU's history")
            )
            self._add_declaration(NEXT, Discrete(NEVER, unit="s", doc="the FMU's next time event"))
            n = self.description.indicators
            self._add_declaration(
                INDICATORS, Variable(shape=(n,), doc="the FMU's event indicators")
            )

    def _add_declaration(self, name: str, declared: Declaration) -> None:
        taken = hasattr(Component, name) or hasattr(FMU, name) or name == "time"
        own = f"{name}_" if taken else name
        self._names[name] = own
        self._node.declare(own, declared)

    # -- equations ---------------------------------------------------------------------------------

    def _elements(self, names: Iterable[str]) -> list[Any]:
        return [e for n in names for e in np.ravel(np.asarray(self[n], dtype=object)).tolist()]

    def _arguments(self, history: Any, inputs: list[Any]) -> list[Any]:
        known, part = self.description.variables, self._part
        names = [_name(known[n]) for n in part.parameters]
        return [
            time,
            history,
            *self._elements(self.description.states),
            *inputs,
            *self._elements(names),
        ]

    def equations(self) -> Iterable[Any]:
        """Rates of states, outputs, and what happens at events."""
        part, known = self._part, self.description.variables
        inputs = self._elements(part.inputs)
        history = self[HISTORY] if self._has_events else 0
        states = self._elements(self.description.states)
        arguments = self._arguments(history, inputs)
        for i, state in enumerate(states):
            yield Eq(der(state), self.values(i, *arguments))
        place = len(states)
        for name in part.results:
            given = self._arguments(history, self._needed(name, inputs))
            for i, result in enumerate(self._elements([name])):
                if known[name].name not in self.description.states:
                    yield Eq(result, self.values(place + i, *given))
            place += known[name].size
        if self._has_events:
            yield from self._events(place, arguments, states, inputs)

    def _needed(self, result: str, inputs: list[Any]) -> list[Any]:
        """The inputs with a number for those on which a result does not depend: so there is no algebraic loop."""
        known, depends = self.description.variables, self.description.depends.get(result)
        if depends is None:
            return inputs
        starts = [(n, s) for n in self._part.inputs for s in known[n].starts]
        return [u if n in depends else s for u, (n, s) in zip(inputs, starts, strict=True)]

    def _events(
        self, place: int, arguments: list[Any], states: list[Any], inputs: list[Any]
    ) -> Iterable[Eq | When]:
        indicators = list(self[INDICATORS])
        for i, indicator in enumerate(indicators):
            yield Eq(indicator, self.values(place + i, *arguments))
        signs = [where(z > 0, 1, 0, events=True) for z in indicators]
        due = where(time >= self[NEXT], 1, 0, events=True)
        given = [*self._arguments(pre(self[HISTORY]), inputs), *signs, due]
        yield Eq(self[HISTORY], self.event(0, *given))
        yield Eq(self[NEXT], self.event(1, *given))
        if states:
            jumps = [Reinit(x, self.event(2 + i, *given)) for i, x in enumerate(states)]
            yield When(abs(self[HISTORY] - pre(self[HISTORY])) > HALF, *jumps)

    def _starts(self, first: int, variable: FMUVariable) -> Any:
        """The start values of a state, which the FMU's own initialization finds, by expressions of parameters."""
        part, known = self._part, self.description.variables
        zeros = [0.0] * (2 + part.n + part.n_inputs)
        parameters = self._elements(_name(known[n]) for n in part.parameters)
        function = GivenModule(f"start#{part.key}", FMUFunction(part, "begin"))
        places = range(1 + first, 1 + first + variable.size)
        each = [function(place, *zeros, *parameters) for place in places]
        if not parameters:  # they are numbers
            each = part.first_states()[first : first + variable.size]
        return _nested(each, variable.shape or ())


def _nested(values: list[Any], shape: tuple[int, ...]) -> Any:
    """The values of an array as tuples of tuples."""
    size = len(values) // shape[0] if shape else 1
    parts = (values[i : i + size] for i in range(0, len(values), size))
    return tuple(_nested(part, shape[1:]) for part in parts) if shape else values[0]


class _Chosen:
    """What a user wants of an FMU, sorted.

    Attributes:
        values: by name. settings: those of no real parameters. parameters, inputs, results: variables, in order.
    """

    def __init__(
        self, description: Description, values: dict[str, Any], observe: tuple[str, ...]
    ) -> None:
        known = description.variables
        for name in (*values, *observe):
            if name not in known:
                raise DeclarationError(
                    f"FMU: '{description.model}' has no variable {shown(name)}: {nearest(str(name), list(known))}"
                )
        if not description.exchange:
            raise DeclarationError(
                f"FMU: '{description.model}' is for co-simulation only, which is not supported yet; export it for "
                "model exchange."
            )
        self.values = values
        self.settings = {n: v for n, v in values.items() if _is_setting(known[n])}
        starts = [known[n] for n in values if known[n] not in description.parameters]
        starts = [v for v in starts if v.name not in self.settings and v.causality != "input"]
        for v in starts:
            if v.initial != "exact" or v.type not in REAL[:2] or v.variability == "constant":
                raise DeclarationError(
                    f"FMU: '{v.name}' of '{description.model}' is computed by the FMU and takes no value."
                )
        self.parameters = [*description.parameters, *starts]
        self.inputs = sorted(description.of("input"), key=lambda v: NUMBERS.index(v.type))
        results = [known[n] for n in dict.fromkeys((*description.outputs, *observe))]
        self.results = [v for v in results if v.type in NUMBERS]


def _is_setting(variable: FMUVariable) -> bool:
    """Whether a value is fixed when the FMU is made."""
    if variable.causality == "structuralParameter":
        raise DeclarationError(
            f"FMU: '{variable.name}' is a structural parameter, which is not supported yet."
        )
    return variable.causality == "parameter" and variable.type not in REAL[:2]


def _name(variable: FMUVariable) -> str:
    """The name of a value that a model gives: a start value is not the variable itself."""
    own = variable.causality in ("parameter", "input")
    return variable.name if own else f"{variable.name}.start"
