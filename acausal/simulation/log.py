"""What has happened in a simulation with events."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import jax.numpy as jnp
import numpy as np
from jax import lax
from jax.typing import DTypeLike
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import array, known
from acausal.errors import DataError, cut_short

if TYPE_CHECKING:
    from acausal.system import System

LOG = 10_000
"""Events that a run remembers with their times."""

VALUES, FEW_VALUES = 2**21, 2**12
"""Numbers by which a run remembers what states and discrete variables were before and after events: 16 megabytes.

That is enough for all `LOG` events of models with up to 104 of them. There are fewer where JAX traces: a thousand runs
side by side need a thousand times the room.
"""

SOON, AT_ONCE, FASTER, LAST = 1e-6, 1e-9, 0.7, 8
"""Events of a condition have no end where three of the last follow sooner and sooner, by this factor: the first within
`SOON` of the run's span, the third and all behind it within `AT_ONCE`. Then rounding hides the others."""

LINES = 18
"""Events that a list of them shows."""

JUMP = "an input jumps"
"""What is said of an event that no condition made."""


EVENTS_UNKNOWN = """Events are not known while JAX traces, and have no derivatives; return the solution, and ask for \
them outside."""

CLOCK = re.compile(r"(?:([\w.\[\]]+) >=? time|time [<>]=? ([\w.\[\]]+))$")
"""A condition of the time, which is over once it has made its event."""


class Event(NamedTuple):
    """An event.

    Attributes:
        t: time [s]. condition: the one that changed first, with its component.
        component: dotted path of the component that states the condition; empty for the model itself.
        before, after: the discrete variables and states that changed, by name, with their values on either side;
            ``None`` where more events happened than a run remembers with values.
        grazes: whether the condition hardly changes at its instant. A little more or less, and there is no event: a
            gradient through it does not exist, or is huge.
        effect: what it did, such as ``"clutch: backward sliding begins"``; empty where that is not known.
    """

    t: float
    condition: str
    component: str
    before: Mapping[str, float] | None
    after: Mapping[str, float] | None
    grazes: bool = False
    effect: str = ""

    def __str__(self) -> str:
        """In words."""
        condition = CLOCK.sub(lambda one: f"time reaches {one[1] or one[2]}", self.condition)
        digits = 9 if abs(self.t) < 1e6 else 14  # seconds of a calendar
        words = f"t = {self.t:.{digits}g} s: {self.effect or condition}"
        if not self.grazes:
            return words
        return (
            f"{words} (it hardly changes there: a gradient through it does not exist, or is huge)"
        )


class EventList(tuple[Event, ...]):
    """Events in order of time, a line for each of the first."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "\n".join(cut_short(self, LINES)) or "no events"


class Log(NamedTuple):
    """What has happened, as arrays.

    Attributes:
        t: times of the first events, shape (n,), in seconds; NaN where there were fewer.
        which: the condition that changed first, by number, or -1 where inputs jumped.
        total: how many there were, perhaps more than n.
        before, after: states, then discrete variables on either side of the first events.
        grazes: whether that condition hardly changed at its instant.
    """

    t: Float[Array, " n"]
    which: Int[Array, " n"]
    total: Int[Array, ""]
    before: Float[Array, "m n_states_and_discrete"]
    after: Float[Array, "m n_states_and_discrete"]
    grazes: Bool[Array, " n"]

    @staticmethod
    def empty(n_columns: int, dtype: DTypeLike, *, events: int = LOG, values: int = VALUES) -> Log:
        """A log before the first event.

        Arguments:
            n_columns: states and discrete variables together.
            events: how many are remembered with their times. values: how many numbers on either side of them.
        """
        m = max(min(events, values // (2 * max(n_columns, 1))), 1)
        sides = array(np.full((m, n_columns), np.nan), dtype)
        which, total = array(np.full(events, -1), np.int32), array(0, np.int32)
        t, grazes = array(np.full(events, np.nan), dtype), array(np.zeros(events), bool)
        return Log(t, which, total, sides, sides, grazes)

    def with_event(
        self,
        happened: Array,
        t: Array,
        which: Array,
        before: tuple[Array, Array],
        after: tuple[Array, Array],
        grazes: Array,
    ) -> Log:
        """The log with one more event, if it has happened, with states and discrete variables before and after it."""
        t, before, after = lax.stop_gradient((t, before, after))
        k, m = jnp.where(happened, self.total, len(self.t)), len(self.before)
        row = jnp.minimum(k, m)
        return Log(
            self.t.at[k].set(t, mode="drop"),
            self.which.at[k].set(which.astype(jnp.int32), mode="drop"),
            self.total + happened,
            self.before.at[row].set(jnp.concatenate(before), mode="drop"),
            self.after.at[row].set(jnp.concatenate(after), mode="drop"),
            self.grazes.at[k].set(grazes, mode="drop"),
        )

    def short(self) -> Log:
        """The log with room for one event, for what does not read it."""
        one = Log(*(a[:1] for a in self._replace(total=self.t)))
        return one._replace(total=self.total)

    def kept(self) -> Log:
        """Only the events that are kept, as numbers.

        Raises:
            DataError: while JAX traces, and for runs side by side.
        """
        log = known(self)
        if log is None:
            raise DataError(EVENTS_UNKNOWN)
        if np.ndim(log.total):
            raise DataError(
                "These are runs side by side, each with events of its own; take one: "
                "jax.tree.map(lambda a: a[0], run)."
            )
        n = int(log.total)
        columns = (np.asarray(a)[:n] for a in log._replace(total=log.t))
        return Log(*columns)._replace(total=log.total)  # pyright: ignore[reportArgumentType]

    def without_end(self, span: float) -> tuple[float, int] | None:
        """Time and condition of the last event behind which none was told apart, as they followed ever sooner.

        A ball that bounces lower and lower comes to this: the model goes on as if the condition was not there.

        Arguments:
            span: of the run [s].
        """
        log = self.kept()
        if int(log.total) > len(log.t):
            return None
        for which in np.unique(log.which[log.which >= 0]).tolist():
            t = log.t[log.which == which][-LAST:]
            gaps = np.diff(t) / span
            sooner = gaps[1:] < FASTER * gaps[:-1]
            three = sooner[1:] & sooner[:-1] & (gaps[:-2] < SOON)
            if (three & (np.cumsum(gaps[::-1])[::-1][2:] < AT_ONCE)).any():
                return float(t[-1]), which
        return None

    def conditions(self, system: System) -> list[tuple[str, str]]:
        """The component and the condition that changed first, of each event that is kept."""
        events = system.events
        assert events is not None
        return [
            (events.component(w), events.describe(w)) if w >= 0 else ("", JUMP)
            for w in self.kept().which.tolist()
        ]

    def events(self, system: System) -> EventList:
        """The events, as far as they are kept."""
        log = self.kept()
        names, places, signs = _columns(system)
        m = len(log.before)
        sides = [np.asarray(side)[:, places] * signs for side in (log.before, log.after)]
        differs = (sides[0] != sides[1]) & ~(np.isnan(sides[0]) & np.isnan(sides[1]))
        found: list[Event] = []
        rows = zip(log.t.tolist(), self.conditions(system), strict=True)
        for k, (t, (component, condition)) in enumerate(rows):
            changed = np.flatnonzero(differs[k]).tolist() if k < m else None
            before, after = (
                None if changed is None else {names[i]: float(side[k, i]) for i in changed}
                for side in sides
            )
            effect = "" if before is None else _effect(system, before, after or {})
            grazes = bool(log.grazes[k])
            found.append(Event(t, condition, component, before, after, grazes, effect))
        return EventList(found)


def _effect(system: System, before: Mapping[str, float], after: Mapping[str, float]) -> str:
    """What an event did: the new values in the words of their declarations, such as ``0 stuck, 1 sliding``.

    Where the declarations have no words, what ceased to be true, or other changes.
    """
    layout = system.flat.layout
    begun, ended, changed = list[str](), list[str](), list[str]()
    for name, value in after.items():
        index = layout.find_variable(name)
        declared = None if index is None else layout.variable_declaration(index)
        doc = "" if declared is None else declared.doc
        words = dict(re.findall(r"(?:^|, )(-?\d+) (?!or \d)(?:where |while )?([^,]+)", doc))
        component = name.rpartition(".")[0]
        if (said := words.get(f"{value:g}")) is not None:
            begun.append(f"{component}: {said}" if component else said)
        elif words:
            ended.append(f"{name} becomes false")
        elif getattr(declared, "kind", "") == "bool":
            changed.append(f"{name} becomes {'true' if value else 'false'}")
        else:
            changed.append(f"{name} {before[name]:.4g} → {value:.4g}")
    return "; ".join(begun or ended or changed)


def _columns(system: System) -> tuple[list[str], list[int], np.ndarray]:
    """States and discrete variables that have names: their names, columns in a log, and signs there."""
    n = len(system.states)
    discrete = [(name, n + place, sign) for name, (place, sign) in system.discrete.items()]
    rows = [*((name, i, 1) for i, name in enumerate(system.states)), *discrete]
    return [r[0] for r in rows], [r[1] for r in rows], np.asarray([r[2] for r in rows], float)
