"""Confidence: what is known of learned laws and parameters, and what it says in words."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from itertools import starmap

import numpy as np
from jaxtyping import Float

from acausal.errors import listing, percent
from acausal.reporting import Band, Curve, Html, View, small_plot
from acausal.training.objective.prior import Prior

BAND_POINTS = 201
"""Points of a band over the argument of a law."""

INDISTINGUISHABLE = 0.98
"""The data can hardly distinguish two parameters with a correlation above this, or a parameter from a law."""

CORRELATED = 2.0
"""Residuals are called correlated if more samples than this are worth one independent sample."""

BAD = 0.05
"""Residuals are bad if they leave more than this part of a target unexplained beside noise."""

SIZE = (420, 150)
"""Of a band in a row of a view, in pixels."""

MOVED = 1.0
"""So many standard deviations are too much to move by the error of the integration's steps."""


@dataclass(frozen=True, eq=False)
class Confidence:
    """How well a record determines laws and parameters.

    Attributes:
        laws: by network, the law and its standard deviation.
        parameters: by name, the standard deviation of trained parameters, relative to their values; absolute if
            their change in `Fit.modifiers` is absolute. Laws may change by more here than their bands count, as a
            prior of their shape says nothing about a parameter.
        correlation: between the parameters, in their order.
        with_laws: by parameter and law, the multiple correlation of what the parameter changes with what the weights
            of the law's network can change: 1 where the law can take any part of the parameter.
        per_record: by parameter that differs between records, the standard deviation of each record's deviation from
            the common value.
        noise: standard deviation of the residuals, by target; as given to the loss, or as estimated by it.
        alike: by target, how many neighbouring residuals are worth one independent sample; 1 for white noise.
        unexplained: by target, what its residuals have beside white noise, relative to the target's deviation.
        step_move: by how many standard deviations the error of the integration's steps moves laws and parameters at
            most; the deviations do not count it.
        about: how well each parameter is known, one sentence each.
        taken: by parameter that the data do not determine beside laws, the laws that can take any part of it.
        starts: by state whose start is not measured, the laws that can take any part of it; their bands count that,
            ``prior`` does not.
        prior: the same as the prior of a later training, which `acausal.fit` takes from ``prior=fit``.
    """

    laws: dict[str, Band]
    parameters: dict[str, float]
    correlation: Float[np.ndarray, "n_parameters n_parameters"]
    with_laws: dict[str, dict[str, float]]
    per_record: dict[str, Float[np.ndarray, " R"]]
    noise: dict[str, float]
    alike: dict[str, float]
    unexplained: dict[str, float]
    step_move: float
    about: tuple[str, ...]
    taken: dict[str, tuple[str, ...]]
    starts: dict[str, tuple[str, ...]]
    prior: Prior

    def _repr_html_(self) -> str:
        view = View("Confidence", "How well the records determine what was trained.")
        if self.parameters:
            deviations = list(self.parameters.items())
            view.table(("parameter", "standard deviation of its change"), deviations)
        if self.laws:
            drawn = {
                n: small_plot([Curve("", band.x, band.law, bounds=band.bounds)], size=SIZE)
                for n, band in self.laws.items()
            }
            rows = [(n, Html(plot), float(np.max(self.laws[n].sigma))) for n, plot in drawn.items()]
            view.table(
                ("law", "over its argument, two standard deviations to either side", "largest one"),
                rows,
            )
        rows = [(n, level, self.alike.get(n, 1.0)) for n, level in self.noise.items()]
        view.table(("target", "noise", "samples that count as one"), rows)
        for sentence in self.summary():
            view.text(sentence)
        return str(view)

    def summary(self) -> list[str]:
        """What all this means, as a list of sentences."""
        slow = [
            f"Residuals of '{n}' are correlated over {count:.0f} samples, which count as one here. If the "
            "model lacks something, it is further off than its deviations say: see fit.residuals()."
            for n, count in self.alike.items()
            if count > CORRELATED
        ]
        return [
            *self.about,
            *self.unknown_parameters(),
            *self.unknown_starts(self.laws),
            *slow,
            *self._ignored(),
        ]

    def unknown_parameters(self) -> list[str]:
        """Which parameters the data can hardly tell from others or from laws, a sentence each."""
        names = list(self.parameters)
        confused = [
            f"The data can hardly tell '{names[i]}' from '{names[j]}' (correlation {self.correlation[i, j]:+.3f}): "
            "only a combination of the two is known well; fix one, or measure more."
            for i in range(len(names))
            for j in range(i)
            if abs(self.correlation[i, j]) > INDISTINGUISHABLE
        ]
        taken = [
            f"The data can hardly tell '{name}' from the law '{law}', which can take any part of it: only the two "
            "together are known well; fix one, or measure more."
            for name, laws in self.taken.items()
            for law in laws
        ]
        return [*confused, *taken]

    def unknown_starts(self, of: Collection[str]) -> list[str]:
        """Which starts of states the data hardly determine beside some laws, a sentence each."""
        return [
            f"The data hardly determine where '{state}' starts: {listing(laws)} can take any part of that. Say where "
            f"(x0={{'{state}': ...}}, or x0='model' for where the model starts), or measure it from the start."
            for state, laws in self.starts.items()
            if not set(of).isdisjoint(laws)
        ]

    def _ignored(self) -> list[str]:
        """What the deviations do not count."""
        bad = [
            f"The residuals of '{n}' leave {percent(left)} of it unexplained beside noise: the deviations tell "
            "how well the data determine a model that does not follow them, not how far it is from the truth."
            for n, left in self.unexplained.items()
            if left > BAD
        ]
        if self.step_move > MOVED:
            bad.append(
                f"The error of the integration's steps moves laws and parameters by up to {self.step_move:.2g} "
                "standard deviations, which do not count it: take a smaller dt, or solver='rk4' if it is another."
            )
        return bad

    def __repr__(self) -> str:
        head = "Confidence of " + ", ".join((*self.laws, *self.parameters))
        return "\n".join((head, *starmap(_law_known, self.laws.items()), *self.summary()))


def _law_known(name: str, band: Band) -> str:
    """How well a law is known, in a sentence."""
    doubt = 2 * band.sigma / (np.ptp(band.law) or 1.0)
    worst, usual = int(np.argmax(doubt)), float(np.median(doubt))
    return (
        f"'{name}' is known to {percent(usual)} of its range, at worst to {percent(doubt[worst])} near "
        f"{band.x[worst]:.3g} (two sigma)."
    )
