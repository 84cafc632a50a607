"""What a page may tell, made by hand."""

from __future__ import annotations

import numpy as np
import sympy as sp

from acausal.reporting import (
    Card,
    Curve,
    EquationList,
    PageContent,
    Plot,
    Section,
    Tab,
    Text,
    table,
)

EVIL = "</script><img src=x onerror=alert(1)>\"'&"
"""A name that is a text and nothing else."""

SCHEMATIC = """<svg viewBox="0 0 200 60" width="200" height="60" stroke="currentColor" fill="transparent">
<g data-component="spring"><rect x="10" y="10" width="60" height="40"/></g>
<g data-component="cells"><rect x="110" y="10" width="60" height="40"/></g></svg>"""


def content(name: str = "spring") -> PageContent:
    """A page of a model with a spring and two cells, trained on one record."""
    x = sp.Symbol("s_rel")
    cards = (
        _card("", [Text("The whole.")]),
        _card(
            name,
            [
                EquationList(((sp.Symbol("f"), 3 * x),)),
                table(("parameter", "value", "meaning"), [("c", "3", name)]),
                wave("card", name),
                wave("card", "other"),
            ],
        ),
        _card("cells[1]", [Text("The first.")]),
        _card("cells[2]", [Text("The second.")]),
    )
    records = Section("Measured and simulated", (wave("record"), wave("record", low=True)))
    laws = Section("Learned laws", (_law(name),))
    return PageContent(
        name, f"About {name}", SCHEMATIC, cards, (Tab("Records", (records,)), Tab("Laws", (laws,)))
    )


def _card(path: str, blocks: list) -> Card:
    return Card(path, "Kind", "A ``kind``.", path == "cells[2]", (Section("About", tuple(blocks)),))


def wave(group: str = "", name: str = "a", *, low: bool = False) -> Plot:
    """A wave that is measured, and what a simulation makes of it."""
    t = np.linspace(0.0, 10.0, 3001)
    curves = (
        Curve("measured", t, np.sin(t), "measured"),
        Curve("after", t, 0.9 * np.sin(t + 0.1), "after"),
    )
    return Plot(f"A wave of {name}.", "time [s]", f"{name} [m]", curves, group=group, low=low)


def _law(name: str) -> Plot:
    x = np.linspace(-1.0, 1.0, 201)
    return Plot(
        f"The law of '{name}'.",
        "v [m/s]",
        "f [N]",
        (Curve("learned", x, x**3, "after", sigma=0.1 + x**2), Curve("known", x, x, "known")),
        guides=(-0.5, 0.5),
        trusted=(-0.8, 0.8),
        samples=np.array([-0.3, 0.1, 0.2]),
        limits=(-2.0, 2.0),
    )
