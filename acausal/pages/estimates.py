"""Estimates on a page: what sensors showed beyond what was expected."""

from __future__ import annotations

import numpy as np

from acausal.analysis import Estimation
from acausal.pages.trajectories import labelled
from acausal.reporting import Curve, Plot, Section, Tab, Text, broken_at_gaps, kept_rows, table
from acausal.simulation import Solution

POINTS = 4000
"""Points in a plot."""

WIDE, MARGIN = 2.5, 1.05
"""So many typical deviations of a sensor are in its plot, and around all of it is a margin."""


def sensors(found: Solution) -> tuple[Tab, ...]:
    """Of estimates, the innovations of every sensor over time, with their expected band; of others nothing."""
    if not isinstance(found, Estimation):
        return ()
    t, expected = np.asarray(found.t), np.diagonal(found.innovation_covariance, axis1=1, axis2=2)
    rows, plots = [], list[Plot]()
    for (name, values), variance in zip(found.innovations.items(), expected.T, strict=True):
        known, unit = np.isfinite(innovation := np.asarray(values)), found.unit(name)
        sizes = [np.sqrt(np.mean(a[known])) for a in (innovation**2, variance)]
        numbers = [f"{size:.4g}" for size in (float(found.sensors[name]), *sizes)]
        rows.append((name, int(known.sum()), *numbers, unit))
        kept = kept_rows([innovation], POINTS)
        curves = (
            Curve("innovation", *broken_at_gaps(t[kept], innovation[kept]), "measured"),
            Curve("expected", t[known], np.zeros(known.sum()), sigma=np.sqrt(variance[known])),
        )
        tall = max(np.abs(innovation[known]).max(), WIDE * np.sqrt(np.median(variance[known])))
        limits = (-MARGIN * tall, MARGIN * tall)
        plots.append(
            Plot("", "time [s]", labelled(name, unit), curves, group="sensors", limits=limits)
        )
    header = ("sensor", "samples", "noise", "RMS innovation", "RMS expected", "unit")
    lead = Text(f"Log likelihood {float(found.log_likelihood):.6g}; {found.consistency}.")
    innovations = Section(
        "Measured less expected, two standard deviations to either side", (*plots,)
    )
    return (Tab("Sensors", (Section("", (table(header, rows), lead)), innovations)),)
