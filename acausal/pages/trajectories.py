"""Trajectories as plots: what a model did, variable by variable."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from jaxtyping import Float

from acausal.reporting import Curve, Plot, Role, thinned

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
    """Variables of one run, those of one unit in one plot.

    Arguments:
        t: times. columns: by label.
        units: by label.
        group: of the plots.
        most: points in a plot.
        steps: the labels of what keeps each value until the next.
        sigma: standard deviations by label, where they are known.
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
