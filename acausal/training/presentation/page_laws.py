"""Learned laws on the page of a training: with their bands, as they were before, and with what is known beside them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from acausal.analysis import labels
from acausal.networks import law_at
from acausal.pages import (
    Known,
    LearnedLaw,
    component_cards,
    motion,
    parallel_law,
    schematic,
    summary,
)
from acausal.reporting import Band, Block, Curve, PageContent, Plot, Tab, Text, titled_sections
from acausal.training.trained_model import TrainedModel

SURE = (
    "The band is two standard deviations wide to either side. Dashed lines mark one standard deviation of what the "
    "network has seen; beyond two, shaded, it extrapolates. Ticks are samples."
)


Sections = Mapping[str, Sequence[Block | None]]
"""Sections of a tab by title; what is None is left out."""


def content_with_laws(
    fit: TrainedModel,
    title: str,
    lead: str,
    known: Known,
    bands: Mapping[str, Band],
    tabs: Mapping[str, Sections],
) -> PageContent:
    """All that a page on a training shows, with learned laws after its records and in the cards of their components.

    Arguments:
        fit: the training with whose values the model is shown.
        title, lead: headline, and what stands below it.
        known: of the model, besides the laws.
        bands: by network, what was learned.
        tabs: sections by tab.
    """
    laws = {name: law_blocks(fit, name, band) for name, band in bands.items()}
    blocks = [Text(SURE), *(block for law in laws.values() for block in law)] if laws else []
    every: dict[str, Sections] = {}
    for name, sections in tabs.items():
        every |= {name: sections} | (
            {"Laws": {"Learned laws": blocks}} if name == "Records" else {}
        )
    found = [Tab(name, titled_sections(sections)) for name, sections in every.items()]
    moving = motion([*known.runs.values()][-1]) if known.runs else ()
    known = replace(known, laws=[LearnedLaw(n, tuple(law)) for n, law in laws.items()])
    return PageContent(
        title,
        lead,
        schematic(fit.system.model),
        component_cards(fit.system, known),
        (*(tab for tab in found if tab.sections), *moving),
        f"{fit.system.flat.name}: {summary(fit.system)}",
    )


def law_blocks(fit: TrainedModel, name: str, band: Band) -> list[Block]:
    """A learned law with its band, before training, and with the known elements beside it, as the model has it."""
    packed = fit.system.pack(fit.params)
    label = labels(fit.system, name, packed)
    band, seen = band.times(label.factor), fit.seen[name]
    mean, sigma = float(seen.mean[0]), float(seen.sigma[0])
    trusted = (mean - 2 * sigma, mean + 2 * sigma)
    rest = np.asarray(band.held)
    first = fit.problem.model_params(fit.problem.start())[name]
    curves = [
        Curve("before", band.x, label.factor * np.asarray(law_at(first, band.x, rest)), "before"),
        Curve("learned", band.x, band.law, "after", sigma=band.sigma, bounds=band.bounds),
    ]
    beside = parallel_law(fit.system, name, packed)
    remark = f"The law of '{name}' and how sure it is."
    if beside is not None:
        known = beside.value(band.x)
        low, high = band.bounds
        curves += [
            Curve("known", band.x, known, "known"),
            Curve(
                "sum",
                band.x,
                known + band.law,
                "sum",
                band.sigma,
                bounds=(known + low, known + high),
            ),
        ]
        held = f" at {beside.held} = 0" if beside.held else ""
        others = ", ".join(f"'{n}'" for n in beside.names)
        remark += f" Known is the part of {others} beside it{held}; the sum is what acts."
    plot = Plot(
        remark,
        label.arguments[0] if label.arguments else "argument",
        label.result or name,
        tuple(curves),
        guides=(mean - sigma, mean + sigma),
        trusted=trusted,
        samples=fit.samples(name),
        limits=_informative(curves, trusted),
    )
    if len(rest):
        values = ", ".join(f"{v:.4g}" for v in rest)
        return [plot, Text(f"Other arguments of '{name}' are held near their means: {values}.")]
    return [plot]


def _informative(curves: Sequence[Curve], trusted: tuple[float, float]) -> tuple[float, float]:
    """What the vertical axis shows: the laws where there were data, with room; wide bands are cut there."""
    inside = [c.y[(c.x >= trusted[0]) & (c.x <= trusted[1])] for c in curves if c.role != "before"]
    values = np.concatenate([*inside, *(c.y for c in curves if c.role == "after")])
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if len(values) else (-1.0, 1.0)
    room = 0.15 * (high - low) + 1e-12
    return low - room, high + room
