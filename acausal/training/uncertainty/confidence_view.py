"""The view of a confidence, in a notebook: bands of laws, standard deviations, and what they mean."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from acausal.reporting import Curve, Html, UncertainCurve, View, small_plot

SIZE = (420, 150)
"""Of a band in a row, in pixels."""


def confidence_view(
    parameters: Mapping[str, float],
    laws: Mapping[str, UncertainCurve],
    noise: Mapping[str, float],
    alike: Mapping[str, float],
    sentences: Sequence[str],
) -> str:
    """HTML of a confidence; arguments as the attributes of `Confidence`, and its summary."""
    view = View("Confidence", "How well the records determine what was trained.")
    if parameters:
        view.table(("parameter", "standard deviation of its change"), list(parameters.items()))
    if laws:
        rows = [(n, Html(_drawn(band)), float(np.max(band.sigma))) for n, band in laws.items()]
        header = ("law", "over its argument, two standard deviations to either side", "largest one")
        view.table(header, rows)
    rows = [(n, level, alike.get(n, 1.0)) for n, level in noise.items()]
    view.table(("target", "noise", "samples that count as one"), rows)
    for sentence in sentences:
        view.text(sentence)
    return str(view)


def _drawn(band: UncertainCurve) -> str:
    return small_plot([Curve("", band.x, band.law, bounds=band.bounds)], size=SIZE)
