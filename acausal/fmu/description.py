"""What an FMU says of itself: its variables and their units, its structure, and what it can do."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal
from xml.etree.ElementTree import Element, fromstring

from acausal.errors import DeclarationError, need_package, need_whole, shortened
from acausal.fmu.archive import DESCRIPTION, Folder
from acausal.modeling import element_names
from acausal.units import InSI, in_si

BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
NAMED = ("N", "Pa", "W", "V")
"""Units that are shown by their own name."""


@dataclass(frozen=True)
class Conversion:
    """A value v of the FMU is ``factor * v + offset`` in the model, which has it in ``unit``."""

    unit: str = ""
    factor: float = 1.0
    offset: float = 0.0

    def to_model(self, value: Any) -> Any:
        """A value of the FMU in the model's unit."""
        value = value if self.factor == 1.0 else self.factor * value
        return value if self.offset == 0.0 else value + self.offset

    def to_fmu(self, value: Any) -> Any:
        """A value of the model in the FMU's unit."""
        value = value if self.offset == 0.0 else value - self.offset
        return value if self.factor == 1.0 else value / self.factor


def definitions(units: Any) -> dict[str, InSI]:
    """The units that an FMU defines by base units, by name.

    Raises:
        ValueError: for a factor that is no number above or below zero.
    """
    found: dict[str, InSI] = {}
    for unit in units:
        if (base := unit.baseUnit) is not None:
            factor, offset = float(base.factor), float(base.offset)
            if factor == 0.0 or not math.isfinite(factor) or not math.isfinite(offset):
                raise ValueError(f"the unit '{unit.name}' has the factor {factor:g}")
            exponents = {s: int(e) for s in BASE if (e := getattr(base, s))}
            found[unit.name] = InSI(exponents, factor, offset)
    return found


def conversion(unit: str, known: Mapping[str, InSI], *, is_difference: bool) -> Conversion:
    """From a unit of an FMU to that of the model: as the FMU defines it, else as its text says.

    Arguments:
        is_difference: whether the variable is a difference, of two temperatures for example: it has no offset.
    """
    si = known.get(unit) or (in_si(unit) if unit else None)
    offset = 0.0 if si is None or is_difference else si.offset
    if si is None or (si.factor == 1.0 and offset == 0.0):
        return Conversion(unit)
    return Conversion(_spelled(si.exponents), si.factor, offset)


def _spelled(exponents: Mapping[str, int]) -> str:
    for name in NAMED:
        named = in_si(name)
        if named is not None and named.exponents == exponents:
            return name
    parts = (f"{s}{'' if e == 1 else e}" for s, e in exponents.items())
    return ".".join(parts) or "1"


Interface = Literal["me", "cs"]
"""Model exchange, or co-simulation."""

REAL = ("Real", "Float64", "Float32")
WHOLE = (
    "Integer", "Enumeration", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64",
)  # fmt: skip
NUMBERS = (*REAL, *WHOLE, "Boolean")

STRUCTURAL = "structuralParameter"
"""The causality of what sizes of arrays follow from."""

STEPS = 500
"""Communication steps in an experiment of which only the length is known."""

CLOCK, COUNTDOWN, TRIGGERED = "Clock", "countdown", "triggered"


@dataclass(frozen=True)
class FMUClock:
    """How a clock of FMI 3.0 ticks.

    Attributes:
        kind: its ``intervalVariability``. interval: between two ticks [s], None where the FMU finds it.
        shift: from the start to the first tick [s].
    """

    kind: str = ""
    interval: float | None = None
    shift: float = 0.0

    @property
    def is_periodic(self) -> bool:
        """Whether its interval does not change."""
        return self.kind not in ("changing", COUNTDOWN)

    @property
    def takes_interval(self) -> bool:
        """Whether a user may say how often it ticks."""
        known = self.kind in ("fixed", "tunable") and self.interval is not None
        return known or self.kind == TRIGGERED


@dataclass(frozen=True)
class FMUVariable:
    """A variable of an FMU.

    Attributes:
        type: as FMI calls it. causality, variability, initial: as FMI has them; ``initial`` may be empty.
        conversion: to the unit that it has in a model; all else is in its own ``unit``.
        clocks: names of those at whose ticks alone it is read and set. clock: how it ticks, if it is one.
        start: as a text, or None. shape: of an array. minimum, maximum: infinite where none is given.
    """

    name: str
    type: str
    reference: int
    causality: str
    variability: str
    initial: str
    start: str | None
    unit: str
    conversion: Conversion
    shape: tuple[int, ...] | None
    minimum: float
    maximum: float
    nominal: float
    text: str
    clocks: tuple[str, ...] = ()
    clock: FMUClock = FMUClock()

    @property
    def is_clocked(self) -> bool:
        """Whether it can be read only while a clock ticks."""
        return bool(self.clocks) or self.type == CLOCK

    @property
    def is_discrete_input(self) -> bool:
        """Whether it is an input that model exchange sets at events alone, and no clock or clocked one."""
        return self.causality == "input" and self.variability == "discrete" and not self.is_clocked

    @property
    def names(self) -> list[str]:
        """Of its elements, as Modelica has them."""
        return element_names(self.name, self.shape)

    @property
    def size(self) -> int:
        """How many elements there are."""
        return math.prod(self.shape or ())

    @property
    def starts(self) -> list[float]:
        """The start values of the elements, 0 where none is given."""
        if self.start is None:
            return [0.0] * self.size
        values = [_number(v) for v in self.start.split()]
        return values * self.size if len(values) == 1 else values


@dataclass(frozen=True)
class Description:
    """What an FMU says of itself.

    Attributes:
        version: of FMI, "2.0" or "3.0". token: its GUID. tool: that made it.
        exchange, cosimulation: the name of its library for either, empty where it has none.
        variables: all of them, by name. states, rates, outputs: names of variables, in the FMU's order.
        depends: for outputs and rates the variables that each depends on; None: all.
        indicators: how many event indicators there are.
        once: whether it can be instantiated only once in a process. directional: whether it has derivatives.
        step: the size of communication steps that it suggests for co-simulation.
        returns_early: whether a communication step may end before its end.
        keeps_state: whether an instance can go back to a state that it had.
        completes: whether model exchange is told of completed steps. event_mode: whether co-simulation
            has event mode, and steps that may end at events. evaluates: whether clocked equations are evaluated by
            a function of their own.
    """

    version: str
    model: str
    token: str
    tool: str
    text: str
    exchange: str
    cosimulation: str
    variables: dict[str, FMUVariable]
    states: tuple[str, ...]
    rates: tuple[str, ...]
    outputs: tuple[str, ...]
    depends: dict[str, tuple[str, ...] | None]
    indicators: int
    once: bool
    directional: bool
    step: float
    returns_early: bool
    keeps_state: bool
    completes: bool
    event_mode: bool
    evaluates: bool

    def __hash__(self) -> int:
        return hash((self.token, self.model, self.version))

    def library(self, kind: Interface) -> str:
        """The name of its library for model exchange or for co-simulation; empty where it has none."""
        return self.exchange if kind == "me" else self.cosimulation

    def of(self, causality: str, types: Sequence[str] = NUMBERS) -> list[FMUVariable]:
        """The variables of a causality and of some types."""
        found = self.variables.values()
        return [v for v in found if v.causality == causality and v.type in types]

    @cached_property
    def clocks(self) -> list[FMUVariable]:
        """Its clocks."""
        return [v for v in self.variables.values() if v.type == CLOCK]

    def is_of_ticks(self, v: FMUVariable) -> bool:
        """Whether the ticks of clocks may change a variable."""
        ticks = any(c.causality == "input" for c in self.clocks)
        return v.is_clocked or (ticks and v.variability == "discrete")

    @cached_property
    def parameters(self) -> list[FMUVariable]:
        """The real parameters, which a model may change and train."""
        return [v for v in self.of("parameter", REAL[:2]) if v.variability in ("fixed", "tunable")]


def timed_clocks(description: Description, intervals: Container[str]) -> list[FMUVariable]:
    """Clocks that tick at times that are known: by themselves, or with an interval that a user gives."""
    asked = [v for v in description.clocks if v.causality == "input"]
    return [v for v in asked if v.clock.kind != TRIGGERED or v.name in intervals]


def read_description(folder: Folder, file: object, values: Mapping[str, Any]) -> Description:
    """The description in the folder of an FMU.

    Arguments:
        values: what a user gives; sizes of arrays follow from those of structural parameters.

    Raises:
        DeclarationError: for one that is not sound, or that this package cannot use.
    """
    content = (folder.path / DESCRIPTION).read_bytes()
    if b"\0" in content or b"<!DOCTYPE" in content or b"<!ENTITY" in content:
        raise DeclarationError(
            f"FMU: the {DESCRIPTION} of '{file}' has entities or is not in UTF-8; it is not read."
        )
    fmpy = need_package("fmpy.model_description", "FMU", "fmu", DeclarationError)
    try:
        read = fmpy.read_model_description(folder.path)
        _resize(read, values)
        return _described(read, fromstring(content))
    except DeclarationError:
        raise
    except Exception as error:  # the reader of another, on a file of a third
        why = getattr(error, "problems", [error])[0]
        raise DeclarationError(
            f"FMU: the {DESCRIPTION} of '{file}' is not sound: {shortened(' '.join(str(why).split()), 160)}"
        ) from None


def _resize(read: Any, values: Mapping[str, Any]) -> None:
    """Give arrays the sizes that follow from structural parameters; start values of others than these are not kept."""
    structural = {v.name: v for v in read.modelVariables if v.causality == STRUCTURAL}
    for name in structural.keys() & values.keys():
        what = f"FMU: of '{read.modelName}' the structural parameter {name}"
        structural[name].start = str(need_whole(values[name], what, DeclarationError, 0))
    for v in read.modelVariables:
        shape = [int(d.variable.start if d.start is None else d.start) for d in v.dimensions]
        if tuple(shape) != v.shape:
            v.shape, v.start = tuple(shape), None


def _described(read: Any, root: Element) -> Description:
    if not read.fmiVersion.startswith(("2.", "3.")):
        raise DeclarationError(
            f"FMU: FMI {read.fmiVersion} is not supported; export it by FMI 2.0 or 3.0."
        )
    units = definitions(read.unitDefinitions)
    clocks = {e.get("name"): _clock(e) for e in root.iter(CLOCK)}
    variables = {
        v.name: _variable(v, units, clocks.get(v.name, FMUClock())) for v in read.modelVariables
    }
    if len(variables) != len(read.modelVariables):
        raise ValueError("two variables have one name")
    exchange, cosimulation = read.modelExchange, read.coSimulation
    can = exchange or cosimulation
    if can is None:
        raise DeclarationError(
            f"FMU: '{read.modelName}' has neither model exchange nor co-simulation, and scheduled execution is not "
            "supported; export it for one of these."
        )
    derived = {v.name: v.derivative.name for v in read.modelVariables if v.derivative is not None}
    rates = tuple(u.variable.name for u in read.derivatives)
    if missing := [r for r in rates if r not in derived]:
        raise ValueError(f"'{missing[0]}' is a derivative of no variable")
    states = tuple(derived[r] for r in rates)
    for rate, state in zip(rates, states, strict=True):
        if variables[rate].type not in REAL[:2] or variables[state].shape != variables[rate].shape:
            raise ValueError(f"'{state}' and its derivative '{rate}' do not fit each other")
    indicators = read.numberOfEventIndicators
    if read.fmiVersion.startswith("3."):
        indicators = sum(variables[u.variable.name].size for u in read.eventIndicators)
    of_exchange = root.find("ModelExchange")
    directional = of_exchange is not None and _is_true(
        of_exchange, "providesDirectionalDerivatives"
    )
    experiment = read.defaultExperiment
    return Description(
        version=read.fmiVersion[:1] + ".0",
        model=read.modelName or "",
        token=read.guid or "",
        tool=read.generationTool or "",
        text=read.description or "",
        exchange=exchange.modelIdentifier if exchange else "",
        cosimulation=cosimulation.modelIdentifier if cosimulation else "",
        variables=variables,
        states=states,
        rates=rates,
        outputs=tuple(u.variable.name for u in read.outputs),
        depends={
            u.variable.name: None
            if u.dependencies is None
            else tuple(d.name for d in u.dependencies)
            for u in (*read.outputs, *read.derivatives)
        },
        indicators=indicators,
        once=bool(can.canBeInstantiatedOnlyOncePerProcess),
        directional=directional or bool(exchange and exchange.providesDirectionalDerivative),
        step=_step(experiment, cosimulation, clocks.values()),
        returns_early=bool(getattr(cosimulation, "mightReturnEarlyFromDoStep", False)),
        keeps_state=bool(can.canGetAndSetFMUstate),
        completes=bool(exchange and exchange.needsCompletedIntegratorStep),
        event_mode=bool(getattr(cosimulation, "hasEventMode", False))
        and (bool(clocks) or cosimulation.canHandleVariableCommunicationStepSize),
        evaluates=any(_is_true(e, "providesEvaluateDiscreteStates") for e in root),
    )


def _is_true(element: Element, name: str) -> bool:
    """A truth value that fmpy does not read."""
    return element.get(name) in ("true", "1")


def _clock(element: Element) -> FMUClock:
    """A clock, of which fmpy reads no numbers."""
    get = element.get
    interval, shift = (
        float(decimal) if (decimal := get(f"{n}Decimal")) else
        int(counter) / int(get("resolution") or 1) if (counter := get(f"{n}Counter")) else None
        for n in ("interval", "shift")
    )  # fmt: skip
    return FMUClock(get("intervalVariability") or TRIGGERED, interval, shift or 0.0)


def _step(experiment: Any, cosimulation: Any, clocks: Iterable[FMUClock]) -> float:
    """The communication step: as the FMU suggests, else its own, its clock's, a part of its experiment, or of 1 s."""
    begin, end, step = (
        float(getattr(experiment, name, None) or 0.0)
        for name in ("startTime", "stopTime", "stepSize")
    )
    own = float(getattr(cosimulation, "fixedInternalStepSize", None) or 0.0)
    tick = min((c.interval for c in clocks if c.interval), default=0.0)
    found = step or own or tick or (end - begin) / STEPS
    return found if 0 < found < math.inf else 1 / STEPS


def _variable(read: Any, units: Mapping[str, InSI], clock: FMUClock) -> FMUVariable:
    declared = read.declaredType
    unit = read.unit or (declared.unit if declared is not None else None) or ""
    is_difference = read.relativeQuantity
    if is_difference is None:
        is_difference = declared is not None and declared.relativeQuantity
    limits = [read.min, read.max, read.nominal]
    if declared is not None:
        of_type = (declared.min, declared.max, declared.nominal)
        limits = [b if a is None else a for a, b in zip(limits, of_type, strict=True)]
    is_real = read.type in REAL
    low, high, nominal = (_number(v) if v is not None and is_real else None for v in limits)
    shape = tuple(int(n) for n in read.shape) if read.dimensions else None
    if not isinstance(read.name, str) or read.valueReference is None:
        raise ValueError("a variable has no name or no reference")
    found = FMUVariable(
        name=read.name,
        type=read.type,
        reference=int(read.valueReference),
        causality=read.causality or "local",
        variability=read.variability or ("continuous" if is_real else "discrete"),
        initial=read.initial or "",
        start=read.start,
        unit=unit,
        conversion=conversion(unit if is_real else "", units, is_difference=bool(is_difference)),
        shape=shape,
        minimum=-math.inf if low is None else low,
        maximum=math.inf if high is None else high,
        nominal=abs(nominal) if nominal else 1.0,
        text=read.description or "",
        clocks=tuple(c.name for c in read.clocks or ()),
        clock=clock,
    )
    if found.type in NUMBERS and len(found.starts) != found.size:
        raise ValueError(f"'{found.name}' has {len(found.starts)} start values, not {found.size}")
    return found


def _number(text: Any) -> float:
    """A number, or a truth value as 1 or 0."""
    return {"true": 1.0, "false": 0.0}.get(text) if text in ("true", "false") else float(text)  # pyright: ignore[reportReturnType]
