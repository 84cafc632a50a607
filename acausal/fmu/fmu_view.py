"""What an FMU is, for the prompt and for notebooks."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from acausal.fmu.description import STRUCTURAL, WHOLE, FMUVariable
from acausal.fmu.part import Part

MOST = 12
"""Variables of a kind that are listed."""


def as_text(part: Part) -> str:
    """What an FMU is, a line for each kind of variables."""
    width = max(len(name) for name, _ in _lines(part))
    return "\n".join(f"{name:<{width}}  {text}" for name, text in _lines(part))


def as_html(part: Part) -> str:
    """The same as a table."""
    rows = (f"<tr><th>{escape(n)}</th><td>{escape(t)}</td></tr>" for n, t in _lines(part))
    return f"<table>{''.join(rows)}</table>"


def _lines(part: Part) -> Iterator[tuple[str, str]]:
    d = part.description
    kinds = [
        n for n, has in (("model exchange", d.exchange), ("co-simulation", d.cosimulation)) if has
    ]
    yield "FMU", f"{d.model}, FMI {d.version}, {' and '.join(kinds)}"
    if d.text:
        yield "about", " ".join(d.text.split())
    yield "tool", d.tool or "unknown"
    known = d.variables
    states = d.states if part.n else ()
    for what, names in (("states", states), ("inputs", part.inputs), ("outputs", part.results)):
        yield what, _listed([known[n] for n in names], with_values=what == "inputs")
    yield "parameters", _listed([known[n] for n in part.parameters], with_values=True)
    settings = [
        *d.of("parameter", ("String", "Boolean", "Float32", *WHOLE)),
        *d.of(STRUCTURAL),
    ]
    if settings:
        yield "settings", _listed(settings, with_values=True)
    if d.clocks:
        yield "clocks", ", ".join(map(_ticks, d.clocks[:MOST]))
    if d.indicators and part.kind == "me":
        yield "events", f"{d.indicators} event indicators"
    if part.step:
        how = (
            "co-simulation, in steps of"
            if part.kind == "cs"
            else "model exchange, with a completed step each"
        )
        yield "used by", f"{how} {part.step:g} s"
    yield "derivatives", _derivatives(part)


def _listed(variables: list[FMUVariable], *, with_values: bool) -> str:
    def one(v: FMUVariable) -> str:
        sizes = f"[{','.join(map(str, v.shape))}]" if v.shape is not None else ""
        starts = (v.start or "").split()[:4]
        if v.conversion.unit != v.unit:
            starts = [f"{v.conversion.to_model(float(s)):g}" for s in starts]
        value = f" = {' '.join(starts)}" if with_values and starts else ""
        unit = v.conversion.unit or v.unit
        return f"{v.name}{sizes}{value}{' ' * bool(unit)}{unit}"

    more = f", and {len(variables) - MOST} more" if len(variables) > MOST else ""
    return ", ".join(map(one, variables[:MOST])) + more or "none"


def _ticks(v: FMUVariable) -> str:
    """A clock, with its interval if it is known."""
    interval = "" if v.clock.interval is None else f" of {v.clock.interval:g} s"
    return f"{v.name} ({v.causality}, {v.clock.kind}{interval})"


def _derivatives(part: Part) -> str:
    if part.kind == "cs":
        inputs = f", and to inputs over {part.memory} steps," if part.memory else ""
        return f"with respect to parameters{inputs} by difference quotients of instances"
    own = (
        "the FMU's directional derivatives"
        if part.description.directional
        else "difference quotients"
    )
    return f"with respect to states and inputs by {own}, to parameters by difference quotients of instances"
