"""What becomes of a wrong model: a sentence, as it should, or something worse."""

from __future__ import annotations

import re
import resource
import signal
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jax.numpy as jnp
import numpy as np

import acausal as ac
from tests.support.interpret import in_numpy
from tests.support.paths import ROOT

OWN = (ROOT / "acausal", ROOT / "components")
"""Where the last frame of a traceback lies if acausal raised the error on purpose."""

LIMIT = 30.0
"""Seconds of processor time that a mutant may take; a busy machine does not lengthen them."""

MEMORY = 3 * 2**30
"""Bytes that a mutant may take beyond those that are taken when it starts."""

LENGTH = 1000
STEP = 1e-5
"""Seconds that a model which compiles is driven for, twice."""

GOOD = ("fine", "sentence", "warning")


@dataclass(frozen=True)
class Mutant:
    """A wrong model, or one that may be wrong.

    Attributes:
        seed: it is made from that number alone.
        domain: of the sound model that it was made from. ``kind``: what was done to it.
        detail: what was done, for a reader.
        places: texts of which a message must hold one.
        wrong: whether it is certainly wrong, so that it must not pass.
        make: makes the model and compiles it, or makes a call; a `System` that it returns is driven.
    """

    seed: int
    domain: str
    kind: str
    detail: str
    places: tuple[str, ...]
    wrong: bool
    make: Callable[[], Any]


@dataclass(frozen=True)
class Outcome:
    """How a mutant ended: one of `GOOD`, or traceback, hang, silent, or a sentence that is unclear; and the message."""

    mutant: Mutant
    sort: str
    message: str

    def __str__(self) -> str:
        m = self.mutant
        return f"seed {m.seed} ({m.domain}, {m.kind}): {self.sort}\n  {m.detail}\n  {self.message:.600}"


class Hang(BaseException):
    """The time is over; not an `Exception`, so that nothing catches it on its way."""


@contextmanager
def limited() -> Iterator[None]:
    """Limits of time and memory. They hold in Python code; what hangs in C is found by pytest's own limit."""

    def stop(*_: Any) -> None:
        raise Hang

    def settings(line: str) -> int:
        return int(re.search(rf"{line}:\s+(\d+) kB", status)[1]) * 1024  # type: ignore[index]

    status = Path("/proc/self/status").read_text(encoding="ascii")
    before = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (settings("VmData") + MEMORY, before[1]))
    old = signal.signal(signal.SIGPROF, stop)
    # again every second: some callbacks swallow what is raised in them
    signal.setitimer(signal.ITIMER_PROF, LIMIT, 1.0)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, old)
        resource.setrlimit(resource.RLIMIT_DATA, before)


def outcome(mutant: Mutant) -> Outcome:
    """Make a mutant, compile and drive it, and sort what comes of it."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            with limited():
                made = mutant.make()
                found = drive(made, mutant.seed) if isinstance(made, ac.System) else None
        except Hang:
            return Outcome(mutant, "hang", f"after {LIMIT:g} s")
        except Exception as error:
            return Outcome(mutant, *sort_of(error, mutant.places))
    said = [str(w.message) for w in told if issubclass(w.category, UserWarning)]
    if said:
        return Outcome(mutant, "warning", said[0])
    if found or mutant.wrong:
        return Outcome(mutant, "silent", found or "it is certainly wrong, and passes")
    return Outcome(mutant, "fine", "")


def sort_of(error: Exception, places: Sequence[str]) -> tuple[str, str]:
    """Whether an error is one clear sentence, and its message.

    It is one if acausal raises it on purpose: an `AcausalError`, or a ``TypeError`` or ``ValueError`` from a ``raise``
    of its own; if it does not drag another error behind it, unless by ``raise ... from``; if it is one line; and if it
    names the place. What Python raises in the user's own line, such as an unknown attribute, needs no words of ours.
    """
    message = f"{type(error).__name__}: {error}"
    frames = traceback.extract_tb(error.__traceback__)
    last = Path(frames[-1].filename).resolve()
    if last.is_relative_to(ROOT / "tests"):
        return "sentence", message
    raised = (frames[-1].line or "").startswith("raise") and any(map(last.is_relative_to, OWN))
    meant = raised and isinstance(error, ac.AcausalError | TypeError | ValueError)
    if not meant or (error.__context__ and not error.__suppress_context__):
        where = next((f for f in reversed(frames) if str(ROOT) in f.filename), frames[-1])
        return "traceback", f"{message} [{where.filename}:{where.lineno}]"
    text = str(error)
    if isinstance(error, ac.ModelicaError):  # its place is shown below the sentence
        text = text.partition("\n    ")[0]
    if "\n" in text or len(text) > LENGTH or " " not in text:
        return "unclear", message
    if not any(place in text for place in places):
        return "placeless", f"{message} [wanted one of {', '.join(places)[:200]}]"
    return "sentence", message


def drive(system: ac.System, seed: int) -> str:
    """Run a model a little, and read all of its variables; what is wrong with their values.

    A warning when they are read is as good as an error (see `outcome`).

    Every eighth is really simulated. The others are evaluated operation by operation, which saves compiling them, and
    are simulated if a value is not finite.
    """
    u = jnp.zeros(len(system.inputs))
    x = np.asarray(system.initial_state(inputs=u))
    finite = np.isfinite(x).all() and finite_at(system, x, u)
    if finite and seed % 8:
        return ""
    inputs = dict.fromkeys(system.inputs, 0.0)
    result = ac.simulate(system, (0.0, 2 * STEP), dt=STEP, solver="heun", inputs=inputs)
    named = list(system.variables)
    values = np.asarray(result[named]) if named else np.zeros((3, 0))
    bad = [n for n, v in zip(named, values.T, strict=True) if not np.isfinite(v).all()]
    return f"{', '.join(bad[:5])} not finite" if bad else ""


def finite_at(system: ac.System, x: Any, u: Any) -> bool:
    """Whether rates and variables are finite at the start and after a step of Euler's method."""
    packed = system.pack()

    def everything(t: Any, x: Any) -> Any:
        return system.vector_field_and_observe(system.variables, t, x, u, packed)

    evaluate = in_numpy(everything, 0.0, jnp.asarray(x))
    for t in (0.0, STEP):
        rates, values = evaluate(t, x)
        if not (np.isfinite(rates).all() and np.isfinite(values).all()):
            return False
        x = x + STEP * rates
    return True


def table(outcomes: Sequence[Outcome]) -> list[str]:
    """Counts by kind and by domain, then one line of all."""
    sorts = (*GOOD, "unclear", "placeless", "traceback", "hang", "silent")
    lines = []
    for title, key in (("kind", lambda o: o.mutant.kind), ("domain", lambda o: o.mutant.domain)):
        lines.append(f"{title:<28}" + "".join(f"{s:>11}" for s in sorts))
        for name in sorted({key(o) for o in outcomes}):
            counts = Counter(o.sort for o in outcomes if key(o) == name)
            lines.append(f"{name:<28}" + "".join(f"{counts[s] or '-':>11}" for s in sorts))
    total = Counter(o.sort for o in outcomes)
    lines.append(f"{len(outcomes)} mutants: " + ", ".join(f"{total[s]} {s}" for s in sorts))
    return lines
