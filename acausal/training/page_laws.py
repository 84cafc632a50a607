"""Learned laws on the page of a training: with their bands, as they were before, and with what is known beside them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from acausal.networks import law_of
from acausal.pages import parallel_law
from acausal.reporting import Block, Curve, Plot, Text
from acausal.training.page_subject import LearnedLaw, Trained

SURE = (
    "The band is two standard deviations wide to either side. Dashed lines mark one standard deviation of what the "
    "network has seen; beyond two, shaded, it extrapolates. Ticks are samples."
)


def law_blocks(fit: Trained, name: str, law: LearnedLaw) -> list[Block]:
    """A learned law with its band, before training, and with the known elements beside it."""
    band, seen = law.band, law.seen
    mean, sigma = float(seen.mean[0]), float(seen.sigma[0])
    trusted = (mean - 2 * sigma, mean + 2 * sigma)
    rest = np.asarray(seen.mean[1:])
    first = fit.problem.model_params(fit.problem.start())[name]
    curves = [
        Curve("before", band.x, law.factor * _values(first, band.x, rest), "before"),
        Curve("learned", band.x, band.law, "after", sigma=band.sigma, bounds=band.bounds),
    ]
    beside = parallel_law(fit.system, name, fit.system.pack(fit.params))
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
        law.argument,
        law.result or name,
        tuple(curves),
        guides=(mean - sigma, mean + sigma),
        trusted=trusted,
        samples=law.samples,
        limits=_informative(curves, trusted),
    )
    if len(rest):
        return [
            plot,
            Text(
                f"Other arguments of '{name}' are held at their means: {', '.join(f'{v:.4g}' for v in rest)}."
            ),
        ]
    return [plot]


def _values(
    network: Callable[..., Any], x: Float[np.ndarray, " points"], rest: Float[np.ndarray, " others"]
) -> Float[np.ndarray, " points"]:
    """A law over its first argument."""
    values = np.asarray(jax.vmap(lambda v: law_of(network)(v, *rest))(jnp.asarray(x)))
    return values if values.ndim == 1 else values[:, 0]


def _informative(curves: Sequence[Curve], trusted: tuple[float, float]) -> tuple[float, float]:
    """What the vertical axis shows: the laws where there were data, with room; wide bands are cut there."""
    inside = [c.y[(c.x >= trusted[0]) & (c.x <= trusted[1])] for c in curves if c.role != "before"]
    values = np.concatenate([*inside, *(c.y for c in curves if c.role == "after")])
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if len(values) else (-1.0, 1.0)
    room = 0.15 * (high - low) + 1e-12
    return low - room, high + room
