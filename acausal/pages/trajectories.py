"""Trajectories as plots: what a model did, variable by variable, and what sensors showed beyond what was expected."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from jaxtyping import Float

from acausal.analysis import Estimation
from acausal.reporting import (
    Curve,
    Plot,
    Role,
    Section,
    Tab,
    Text,
    broken_at_gaps,
    kept_rows,
    table,
    thinned,
)
from acausal.simulation import Solution

CURVES_EACH = 6
"""Curves of one unit in one plot."""

Numbers = Float[np.ndarray, " n"]


def plots_by_unit(
    t: Numbers,
    columns: Mapping[str, Numbers],
    units: Mapping[str, str],
    *,
    group: str,
    most: int,
    steps: Collection[str] = (),
    sigma: Mapping[str, Numbers] | None = None,
) -> list[Plot]:
    """Variables of one run, by label with units, those of one unit in one plot of a group with about ``most`` points.

    Those of ``steps`` keep each value until the next; ``sigma`` has the standard deviations that are known.
    """
    known = sigma or {}
    found: dict[str, list[str]] = {}
    for name in columns:
        found.setdefault(units[name], []).append(name)
    plots: list[Plot] = []
    for unit, names in found.items():
        for i in range(0, len(names), CURVES_EACH):
            some = names[i : i + CURVES_EACH]
            curves = [Curve(n, t, columns[n], sigma=known.get(n), steps=n in steps) for n in some]
            label = some[0] if len(some) == 1 else ""
            plots.append(
                Plot(
                    "", "time [s]", labelled(label, unit),
                    thinned(curves, most), group=group,
                )
            )  # fmt: skip
    return plots


def plot_of_runs(
    name: str, unit: str, runs: Mapping[str, tuple[Numbers, Numbers]], *, group: str, most: int
) -> Plot:
    """One variable in several runs, by label: before and after training."""
    roles: dict[str, Role] = {"before training": "before", "after training": "after"}
    curves = [
        curve
        for label, (t, y) in runs.items()
        for curve in thinned(
            [Curve(label.removesuffix(" training"), t, y, roles.get(label, "other"))], most
        )
    ]
    return Plot("", "time [s]", labelled(name, unit), tuple(curves), group=group)


def labelled(name: str, unit: str) -> str:
    """A name with its unit, as axes have it."""
    return f"{name} [{unit or '1'}]".strip()


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
