"""The variables of an FMU: what they are called, by which number they are reached, where they start."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np

from acausal.export.c_text.text import ModelText
from acausal.export.names import NameRange, runs
from acausal.system import System

PARAMETER, INPUT, STATE, DERIVATIVE, OUTPUT, INDICATOR, OUTSIDE = range(1, 8)
"""Kinds; a value reference is 2^24 times the kind plus a number. Time has the reference 0."""


@dataclass(frozen=True)
class WrittenVariable:
    """A number, or with FMI 3 an array of numbers.

    Attributes:
        name: as FMI allows it. kind, number: what its value reference is made of.
        causality, variability, initial: in FMI's words; inputs have no ``initial``.
        places: where its numbers lie in the array of their kind.
        shape: its lengths; () for a number.
        start: its values at the start, or None if they are computed.
        nominal: typical magnitudes of states, else empty.
        unit, doc: as declared.
    """

    name: str
    kind: int
    number: int
    causality: str
    variability: str
    initial: str
    places: range
    shape: tuple[int, ...]
    start: tuple[float, ...] | None
    nominal: tuple[float, ...]
    unit: str
    doc: str

    @property
    def reference(self) -> int:
        """The value reference."""
        return (self.kind << 24) + self.number


@dataclass(frozen=True)
class Group:
    """Variables that are alike, or an array of a network.

    Attributes:
        kind, number: as of a variable. run: names and places. label: the array's name. shape: its lengths.
        unit, doc: as declared. start: values of all variables of this kind, or None.
    """

    kind: int
    number: int
    run: NameRange
    label: str
    shape: tuple[int, ...]
    unit: str
    doc: str
    start: np.ndarray | None


def shown_by_others(system: System, outputs: Sequence[str], scalars: bool) -> tuple[str, ...]:
    """Those outputs that are states or their derivatives: these variables are the outputs.

    Arguments:
        scalars: whether every number is a variable of its own; else a group is an output only if all of it is.
    """
    wanted = set(outputs)
    found: list[str] = []
    for run in runs(system.states[: system.reduced.n_independent]):
        for names in (run.names, tuple(f"der({n})" for n in run.names)):
            if scalars or wanted >= set(names):
                found += [n for n in names if n in wanted]
    return tuple(found)


def variables(
    text: ModelText, system: System, inputs: Sequence[str], outputs: Sequence[str], scalars: bool
) -> list[WrittenVariable]:
    """All variables but time, in the order of their value references.

    Arguments:
        text: the model in C; its outputs are those that are neither states nor derivatives.
        inputs: those that the importer sets; the others are parameters.
        outputs: all of them.
        scalars: whether every number is a variable of its own, as in FMI 2.
    """
    nominal = np.abs(system.reduced.nominal(system.reduced.states))
    held = {system.reduced.name(i) for i in system.reduced.discrete.tolist()}
    found: list[WrittenVariable] = []
    used = {"time"}
    for group in _groups(text, system, scalars):
        for number, name, places, shape, members in _members(group, used, scalars):
            words = _words(
                group.kind, set(members), set(inputs), set(outputs), held, text.has_starts
            )
            start = None if group.start is None else tuple(group.start[places].tolist())
            usual = tuple(nominal[places].tolist()) if group.kind == STATE else ()
            found.append(
                WrittenVariable(
                    name, group.kind, number, *words, places, shape, start, usual, group.unit, group.doc
                )
            )  # fmt: skip
    if text.watches:
        name = unused(["outside_training_range"], used)
        words = ("output", "discrete", "calculated")
        doc = "an argument of a network lies outside of the range in which it was trained"
        found.append(WrittenVariable(name, OUTSIDE, 0, *words, range(1), (), None, (), "", doc))
    return sorted(found, key=lambda v: v.reference)


def event_indicators(text: ModelText) -> list[int]:
    """Of each event indicator, the number of its condition, from 1 on; negative for one that holds at zero, too.

    Conditions whose time is known have none: they are time events.
    """
    events = text.code.events
    if events is None:
        return []
    pairs = zip(events.timed.tolist(), events.strict.tolist(), strict=True)
    return [i if strict else -i for i, (timed, strict) in enumerate(pairs, 1) if not timed]


def _words(
    kind: int,
    members: set[str],
    inputs: set[str],
    outputs: set[str],
    held: set[str],
    computed: bool,
) -> tuple[str, str, str]:
    """Causality, variability and initial of a variable; start values may be ``computed`` from parameters."""
    if kind == PARAMETER or (kind == INPUT and not inputs & members):
        return ("parameter", "tunable", "exact")
    if kind == INPUT:
        return ("input", "continuous", "")
    if kind == INDICATOR:
        return ("local", "continuous", "calculated")
    shown = kind == OUTPUT or outputs >= members
    of_state = "approx" if computed else "exact"
    initial = of_state if kind == STATE else "calculated"
    varies = "discrete" if held >= members else "continuous"
    return ("output" if shown else "local", varies, initial)


def _groups(text: ModelText, system: System, scalars: bool) -> Iterator[Group]:
    """In the order of the tables in C."""
    entries = {e.first: e for e in text.vector.entries}
    modules = sorted(system.layout.module_names, key=len, reverse=True)
    for number, (run, unit) in enumerate(text.parameters):
        entry = entries[run.first]
        if entry.shape:
            module = next((m for m in modules if run.name.startswith(m)), "")
            label = leaf(run.name, module)
            yield Group(PARAMETER, number, run, label, entry.shape, unit, "", text.vector.values)
        else:
            yield _plain(PARAMETER, number, run, unit, entry.doc, text.vector.values)
    held = np.zeros(text.code.sizes.inputs)
    for number, (run, unit) in enumerate(text.inputs):
        yield _plain(INPUT, number, run, unit, "", held)
    for number, (run, unit) in enumerate(text.states):
        yield _plain(STATE, number, run, unit, "", text.start)
        before, after = f"der({run.before}", f"{run.after})"
        if run.index is None:
            before, after = before + after, ""
        rate = replace(run, before=before, after=after)
        per_second = system.unit(f"der({system.states[run.first]})")
        yield _plain(DERIVATIVE, number, rate, per_second, "", None)
    for number, (run, unit) in enumerate(text.outputs):
        yield _plain(OUTPUT, number, run, unit, "", None)

    if (count := len(event_indicators(text))) and not scalars:
        name = "'event indicators'"
        run = NameRange(name, 0, count)
        yield Group(INDICATOR, 0, run, name, (count,), "", "", None)


def _plain(
    kind: int, number: int, run: NameRange, unit: str, doc: str, start: np.ndarray | None
) -> Group:
    shape = () if run.index is None else (run.count,)
    return Group(kind, number, run, run.before + run.after, shape, unit, doc, start)


def _members(
    group: Group, used: set[str], scalars: bool
) -> Iterator[tuple[int, str, range, tuple[int, ...], tuple[str, ...]]]:
    """Of every variable of a group: number, name, places, lengths, and the names of its members in the model."""
    run, places = group.run, group.run.places
    if not places:
        return
    if not scalars:
        labels = [group.label, run.name]
        own = labels if group.kind == INDICATOR else [legal(label) for label in labels]
        name = unused(own, used)
        yield group.number, name, places, group.shape, run.names
    elif run.index is None and group.shape:
        whole = legal(group.label)
        for place, index in zip(places, np.ndindex(*group.shape), strict=True):
            name = unused([element(whole, index)], used)
            yield place, name, range(place, place + 1), (), (run.name,)
    else:
        for place, member in zip(places, run.names, strict=True):
            yield place, unused([legal(member)], used), range(place, place + 1), (), (member,)


_PART = r"[A-Za-z_][A-Za-z_0-9]*(?:\[\d+(?:,\d+)*\])?"
_IDENTIFIER = rf"{_PART}(?:\.{_PART})*"
LEGAL = re.compile(rf"{_IDENTIFIER}|der\({_IDENTIFIER}\)")


def legal(name: str) -> str:
    """A name as FMI allows it: as it is, or in quotes.

    ``cell[1][2].v`` becomes ``cell[1,2].v``; in quotes, letters beyond ASCII become their numbers, as in ``#3b1``.
    """
    name = name.replace("][", ",")
    return name if LEGAL.fullmatch(name) else quoted(name)


def quoted(name: str) -> str:
    """A name in quotes, which may hold almost any sign."""
    plain = name.replace("\\", "/").replace("'", "`").replace('"', "`")
    return "'" + "".join(c if " " <= c <= "~" else f"#{ord(c):x}" for c in plain) + "'"


def unused(candidates: Sequence[str], used: set[str]) -> str:
    """The first name that is not in use, or the last one in quotes with a number; it is in use from now on."""
    more = (quoted(f"{candidates[-1].strip(chr(39))} {k}") for k in count(2))
    name = next(n for names in (candidates, more) for n in names if n not in used)
    used.add(name)
    return name


def element(name: str, index: Sequence[int]) -> str:
    """An element of an array, counted from 1: ``weights[1,2,3]`` is that of ``weights[1]`` at ``2,3``."""
    numbers = ",".join(str(i + 1) for i in index)
    return f"{name[:-1]},{numbers}]" if name.endswith("]") else f"{name}[{numbers}]"


def leaf(name: str, module: str) -> str:
    """An array of a network, with its layers counted from 1: ``nn.net.weights[0]`` is ``nn.net.weights[1]``."""
    rest = re.sub(r"\['(\w+)'\]", r".\1", name[len(module) :])
    return module + re.sub(r"\[(\d+)\]", lambda m: f"[{int(m[1]) + 1}]", rest)
