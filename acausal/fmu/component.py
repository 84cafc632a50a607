"""An FMU as a component: its states among the model's, its inputs and outputs as signals."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np

from acausal.errors import DeclarationError, known_name, need_flag
from acausal.fmu.archive import read
from acausal.fmu.description import (
    CLOCK,
    REAL,
    Conversion,
    Description,
    FMUVariable,
    read_description,
)
from acausal.fmu.fmu_view import as_html, as_text
from acausal.fmu.function import FMUFunction, evaluated, has_events
from acausal.fmu.model_exchange import NEVER
from acausal.fmu.part import Part
from acausal.fmu.selection import Chosen, communication_step, interface, memory_size, name_of
from acausal.modeling import (
    HALF,
    Component,
    Declaration,
    Discrete,
    DiscreteOutput,
    Eq,
    GivenModule,
    Input,
    Module,
    Output,
    Parameter,
    Reinit,
    Variable,
    When,
    by_name,
    der,
    initial,
    names_in,
    native_file,
    pre,
    sample,
    time,
    where,
)

HISTORY, NEXT, INDICATORS = "fmu.history", "fmu.next", "fmu.indicators"
REACHED, COMPLETED, TAKEN = "fmu.reached", "fmu.completed", "fmu.taken"
"""Names of what the model knows of the FMU's events."""

CHANGE = 1e-3
"""So large a change of a discrete real input, relative to its nominal value, is an event."""


class _Earlier(Component):
    """An input of a co-simulation as it was one communication point before."""

    u, history, y = Input(), Input(kind="int"), DiscreteOutput()

    def equations(self) -> Iterable[Eq]:
        """At a communication point the history changes."""
        now = abs(self.history - pre(self.history)) > HALF
        yield Eq(self.y, where(now, pre(self.u), pre(self.y), events=False))


class FMU(Component):
    """A part that somebody else made: an FMU for model exchange or co-simulation, by FMI 2.0 or 3.0.

    In model exchange its continuous states are states of the model. In co-simulation it is a sampled part, which goes
    from one communication point to the next by itself: inputs are set and held there, outputs are read there.
    Inputs and outputs are signals, ``plant.f`` or ``plant["mass.s"]``. Its real parameters are parameters of the
    component, by the FMU's names. **To simulate an FMU runs native code that it brings along.**

    Arguments:
        path: of the file.
        values: by the FMU's names, values of parameters; of inputs, which are then parameters, too; and of variables
            whose start value the FMU takes as it is, which become parameters ``"mass.s.start"``. For a clock, the
            interval between its ticks [s].
        observe: names of further variables that the model reads.
        kind: ``"me"``, model exchange, or ``"cs"``, co-simulation. By default the first of these that the FMU has.
        step: the communication step of co-simulation [s]; by default the one that the FMU suggests, the interval of
            its fastest clock, or 1/500 of its experiment. In model exchange, the time after which the FMU is told that
            a step is completed.
        open_loop: nothing that is trained acts on the inputs of a co-simulation, on those of clocks or on discrete
            ones: gradients take them as they are.
        memory: so many communication steps of a simulation gradients may go through inputs of a co-simulation. Each
            instant then costs the FMU a step for each input and each instant before.

    Raises:
        DeclarationError: for a file that is not a sound FMU, an unknown name, or what is not supported.
    """

    computed = Module(doc="what the FMU computes between events, or in a communication step")
    event = Module(doc="what the FMU does at an event, or with new inputs")

    def __init__(
        self,
        path: str | Path,
        values: Mapping[str, Any] | None = None,
        *,
        observe: Sequence[str] = (),
        kind: Literal["me", "cs"] | None = None,
        step: float | None = None,
        open_loop: bool = False,
        memory: int = 0,
    ) -> None:
        given, seen = (
            by_name(values, "FMU: values", "values by name"),
            names_in(observe, "FMU: observe"),
        )
        path = native_file(path)
        digest, folder = read(path)
        description = read_description(folder, path, given)
        of = interface(description, kind)
        chosen = Chosen(description, of, given, seen)
        clocked = any(map(description.is_of_ticks, chosen.results))
        part = Part(
            str(Path(path).resolve()),
            digest,
            description,
            tuple(sorted(chosen.settings.items())),
            tuple(v.name for v in chosen.parameters),
            tuple(v.name for v in chosen.inputs),
            tuple(v.name for v in chosen.results),
            of,
            communication_step(description, of, step),
            need_flag(open_loop, "FMU: open_loop", DeclarationError),
            memory_size(of, memory, open_loop=open_loop, clocked=clocked) if chosen.inputs else 0,
        )
        values_of, event = ("evaluate", "event") if of == "me" else ("step", "take")
        super().__init__(computed=FMUFunction(part, values_of), event=FMUFunction(part, event))
        self._node.title = description.model
        self._part = part
        self._has_events = part.kind == "me" and (part.step > 0 or has_events(part))
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
        known_name(name, self._names, f"{self._node.label} has no", DeclarationError)
        return vars(self)[self._names[name]]

    def __repr__(self) -> str:
        return as_text(self._part)

    def _repr_html_(self) -> str:
        """For notebooks."""
        return as_html(self._part)

    # -- declarations ------------------------------------------------------------------------------

    def _declare(self, chosen: Chosen) -> None:
        def starts(v: FMUVariable) -> Any:
            return _nested([v.conversion.to_model(s) for s in v.starts], v.shape or ())

        constant = [v for v in chosen.inputs if v.name in chosen.values]
        for v in (*chosen.parameters, *constant):
            name = name_of(v)
            limits = sorted(map(v.conversion.to_model, (v.minimum, v.maximum)))
            low, high = (None if np.isinf(limit) else limit for limit in limits)
            self._add_declaration(name, _declared(Parameter, v, min=low, max=high))
            self.modify(**{self._names[name]: chosen.values.get(v.name, starts(v))})
        for v in chosen.inputs:
            if v.name not in chosen.values:
                given = None if v.start is None and v.type != CLOCK else starts(v)
                held = True if v.variability == "discrete" else None
                declared = _declared(Input, v, kind=_kind(v), default=given, held=held)
                self._add_declaration(v.name, declared)
        if self._part.kind == "cs":
            self._declare_held(chosen.results)
        else:
            self._declare_continuous(chosen.results)

    def _declare_held(self, results: Iterable[FMUVariable]) -> None:
        for v in results:
            start = _nested(v.starts, v.shape or ())
            self._add_declaration(v.name, _declared(DiscreteOutput, v, start=start, kind=_kind(v)))
        kind = DiscreteOutput if self._part.memory else Discrete
        self._add_declaration(HISTORY, kind(0, kind="int", doc="number of the FMU's history"))
        self._add_declaration(REACHED, Discrete(0, kind="int", doc="the same before new inputs"))
        if self._part.memory:
            self._declare_memory(self._part.n_inputs)

    def _declare_memory(self, n: int) -> None:
        """Inputs at the last communication point, and one part for each at a point before: many, but of one form."""
        self._add_declaration(
            TAKEN, DiscreteOutput(shape=(n,), doc="inputs at the last communication point")
        )
        self.earlier = [_Earlier() for _ in range(n * (self._part.memory - 1))]
        for source, part in zip(
            [*self[TAKEN], *(p.y for p in self.earlier)], self.earlier, strict=False
        ):
            self.connect(self[HISTORY], part.history)
            self.connect(source, part.u)

    def _declare_continuous(self, results: Sequence[FMUVariable]) -> None:
        known = self.description.variables
        first, seen = 0, {v.name for v in results}
        for v in (known[n] for n in self.description.states):
            start = f"fmu_start_{first}"
            vars(self)[start] = self._starts(first, v)
            kind = Output if v.name in seen else Variable
            nominal = abs(v.conversion.factor) * v.nominal
            declared = _declared(kind, v, start=start, nominal=nominal, state="always")
            self._add_declaration(v.name, declared)
            first += v.size
        for v in results:
            if v.name not in self._names:
                self._add_declaration(v.name, _declared(Output, v))
        if self._has_events:
            self._add_declaration(
                HISTORY, Discrete(0, kind="int", doc="number of the FMU's history")
            )
            if self._part.step:
                doc = "how many steps the FMU was told to be completed"
                self._add_declaration(COMPLETED, Discrete(0, kind="int", doc=doc))
            n, doc = self._part.n_next, "the FMU's next time event"
            many, doc = ((n,), f"{doc}, and ticks of its clocks") if n > 1 else (None, doc)
            self._add_declaration(NEXT, Discrete(NEVER, unit="s", shape=many, doc=doc))
            if n := len(self._part.elements(self._discrete)):
                doc = "the FMU's discrete inputs as it has taken them, but for a small change"
                self._add_declaration(TAKEN, Discrete(shape=(n,), doc=doc))
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
        part = self._part
        states = self.description.states if part.n else ()
        return [time, history, *self._given(states), *inputs, *self._parameters()]

    def _units(self, names: Iterable[str]) -> list[Conversion]:
        known = self.description.variables
        return [v.conversion for v in (known[n] for n in names) for _ in range(v.size)]

    def _given(self, names: Sequence[str]) -> list[Any]:
        """The values that the FMU gets for some variables, in its own units."""
        each = zip(self._units(names), self._elements(names), strict=True)
        return [units.to_fmu(value) for units, value in each]

    def _parameters(self) -> list[Any]:
        known, names = self.description.variables, self._part.parameters
        values = self._elements(name_of(known[n]) for n in names)
        return [u.to_fmu(value) for u, value in zip(self._units(names), values, strict=True)]

    def equations(self) -> Iterable[Any]:
        """Rates of states, outputs, and what happens at events."""
        part, known = self._part, self.description.variables
        inputs = self._given(part.inputs)
        if part.kind == "cs":
            yield self._communication(inputs)
            return
        history = self[HISTORY] if self._has_events else 0
        states = self._elements(self.description.states)
        arguments = self._arguments(history, inputs)
        units = self._units(self.description.states)
        for i, (state, u) in enumerate(zip(states, units, strict=True)):
            yield Eq(
                der(state), Conversion(u.unit, u.factor).to_model(self.computed(i, *arguments))
            )
        place = len(states)
        for name in part.results:
            given = self._arguments(history, self._needed(name, inputs))
            for i, result in enumerate(self._elements([name])):
                if known[name].name not in self.description.states:
                    found = self.computed(place + i, *given)
                    yield Eq(result, known[name].conversion.to_model(found))
            place += known[name].size
        if self._has_events:
            yield from self._events(place, states, inputs)

    def _communication(self, inputs: list[Any]) -> When:
        """The step to a communication point, and the inputs that hold from there on."""
        part = self._part
        taken = self._elements([TAKEN] if part.memory else [])
        earlier = [held.y for held in self.earlier] if part.memory else []
        before = [pre(u) for u in (*taken, *earlier)]
        given = [*self._arguments(pre(self[HISTORY]), [0.0] * len(inputs)), *before]
        reached, names = self[REACHED], part.results
        results = zip(self._elements(names), self._units(names), part.behind, strict=True)
        behind = self._arguments(reached, inputs)  # clocks tick with the inputs there
        found = [
            Eq(y, u.to_model(self.event(i, *behind) if is_behind else self.computed(i, *given)))
            for i, (y, u, is_behind) in enumerate(results, 1)
        ]
        return When(
            initial() | sample(0, part.step),
            Eq(reached, self.computed(0, *given)),
            *found,
            Eq(self[HISTORY], self.event(0, *behind)),
            *[Eq(u, new) for u, new in zip(taken, inputs, strict=False)],
        )

    def _needed(self, result: str, inputs: list[Any]) -> list[Any]:
        """The inputs with a number for those on which a result does not depend: so there is no algebraic loop."""
        known, depends = self.description.variables, self.description.depends.get(result)
        if depends is None:
            return inputs
        starts = [(n, s) for n in self._part.inputs for s in known[n].starts]
        return [u if n in depends else s for u, (n, s) in zip(inputs, starts, strict=True)]

    def _events(self, place: int, states: list[Any], inputs: list[Any]) -> Iterable[Eq | When]:
        indicators = list(self[INDICATORS])
        before = self._arguments(pre(self[HISTORY]), inputs)
        for i, indicator in enumerate(indicators):  # an event is in the mode before it
            yield Eq(indicator, self.computed(place + i, *before))
        signs = [where(z > 0, 1, 0, events=True) for z in indicators]
        instants = self._elements([NEXT])
        known = [pre(instant) for instant in instants]
        due = sum(where(time >= instant, 1, 0, events=True) for instant in known)
        given = [*before, *signs, due, *known]
        yield Eq(self[HISTORY], self.event(0, *given))
        for i, instant in enumerate(instants, 1):
            yield Eq(instant, self.event(i, *given))
        if self._part.step:  # at an event, a step of the integration ends
            count = self[COMPLETED]
            yield When(sample(0, self._part.step), Eq(count, pre(count) + 1))
        taken = self._elements([TAKEN] if self._discrete else [])
        for u, kept, least in zip(
            self._elements(self._discrete), taken, self._changes(), strict=True
        ):
            yield When(initial() | (abs(u - pre(kept)) > least), Eq(kept, u))
        if states:
            each = enumerate(zip(states, self._units(self.description.states), strict=True))
            first = 1 + self._part.n_next
            jumps = [Reinit(x, u.to_model(self.event(first + i, *given))) for i, (x, u) in each]
            yield When(abs(self[HISTORY] - pre(self[HISTORY])) > HALF, *jumps)

    @property
    def _discrete(self) -> tuple[str, ...]:
        """The inputs that the FMU takes at events alone."""
        known = self.description.variables
        return tuple(n for n in self._part.inputs if known[n].is_discrete_input)

    def _changes(self) -> list[float]:
        """By how much each of these has changed where an event is made for it; one that jumps has one anyway."""
        found = list[float]()
        for v in map(self.description.variables.__getitem__, self._discrete):
            real = CHANGE * abs(v.conversion.factor) * v.nominal
            found += [real if v.type in REAL else 0.5] * v.size
        return found

    def _starts(self, first: int, variable: FMUVariable) -> Any:
        """The start values of a state, which the FMU's own initialization finds, by expressions of parameters."""
        part = self._part
        zeros = [0.0] * (2 + part.n + part.n_inputs)
        parameters = self._parameters()
        function = GivenModule(f"start#{part.key}", FMUFunction(part, "begin"))
        places = range(1 + first, 1 + first + variable.size)
        each = [function(place, *zeros, *parameters) for place in places]
        if not parameters:  # they are numbers
            found = evaluated(part)
            states = found.first_states if found is not None else [0.0] * part.n
            each = states[first : first + variable.size]
        return _nested([variable.conversion.to_model(e) for e in each], variable.shape or ())


def _declared(role: type[Declaration], v: FMUVariable, **more: Any) -> Declaration:
    """The declaration of a variable, in the model's unit."""
    return role(unit=v.conversion.unit, shape=v.shape, doc=v.text, **more)


def _kind(variable: FMUVariable) -> Literal["bool", "real", "int"]:
    return "bool" if variable.type == "Boolean" else "real" if variable.type in REAL else "int"


def _nested(values: list[Any], shape: tuple[int, ...]) -> Any:
    """The values of an array as tuples of tuples."""
    size = len(values) // shape[0] if shape else 1
    parts = (values[i : i + size] for i in range(0, len(values), size))
    return tuple(_nested(part, shape[1:]) for part in parts) if shape else values[0]
