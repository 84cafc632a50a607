"""Ensembles: the same training from several seeds, and what their results disagree on."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import ArrayLike

from acausal.data import Data
from acausal.errors import TrainingError, nearest, need_compiled
from acausal.networks import law_of
from acausal.training.ensemble_page import write_ensemble_page
from acausal.training.fit import fit
from acausal.training.objective.build_problem import Start
from acausal.training.result import Fit
from acausal.training.train_from_starts import together
from acausal.training.uncertainty.confidence import POINTS, REACH, Band
from acausal.training.uncertainty.conformal import predicted

if TYPE_CHECKING:
    from acausal.system import System


@dataclass(frozen=True, eq=False)
class Ensemble:
    """The results of trainings that differ in their seed alone.

    Their spread shows what the record and the training leave open: standard deviations are those of trainings that one
    might add, estimated from those that there are. What is wrong for all of them, such as a law that follows the
    record's noise, it does not show: `Fit.confidence` tells of that.

    Attributes:
        fits: one for each member.
    """

    fits: tuple[Fit, ...]

    @cached_property
    def laws(self) -> dict[str, Band]:
        """By network, mean and standard deviation of what the members have learned.

        Over the first argument, over what all have seen of it; other arguments are held at their mean.
        """
        return {name: self._law(name) for name in self.fits[0].seen}

    def _law(self, name: str) -> Band:
        seen = np.concatenate([fit.arguments[name] for fit in self.fits])
        centre, spread = seen[:, 0].mean(), seen[:, 0].std() or 1.0
        x = np.linspace(centre - REACH * spread, centre + REACH * spread, POINTS)
        rest = seen[:, 1:].mean(axis=0)

        def values(network: Any) -> np.ndarray:
            law = np.asarray(jax.vmap(lambda v: law_of(network)(v, *rest))(jnp.asarray(x)))
            return law if law.ndim == 1 else law[:, 0]

        return _spread(x, [values(fit.params[name]) for fit in self.fits])

    @cached_property
    def predicted(self) -> dict[str, Band]:
        """By target, mean and standard deviation over the time of the record, in one simulation by each member."""
        time = np.asarray(self.fits[0].problem.record.steps.t)
        return self._predictions(time, [fit.predicted for fit in self.fits])

    def predict(
        self, data: Data | Mapping[str, ArrayLike], x0: Start | Mapping[str, float] = "data"
    ) -> dict[str, Band]:
        """The same over another record; arguments as those of `Fit.conformal`."""
        found = [predicted(fit.problem, fit.trained, data, x0) for fit in self.fits]
        return self._predictions(found[0][0], [y for _, y, _ in found])

    def _predictions(self, time: np.ndarray, ys: Sequence[np.ndarray]) -> dict[str, Band]:
        names = self.fits[0].problem.targets
        return {name: _spread(time, [y[:, i] for y in ys]) for i, name in enumerate(names)}

    @property
    def modifiers(self) -> dict[str, tuple[float, float]]:
        """By trained parameter, mean and standard deviation of its change."""
        found = {n: [fit.modifiers[n] for fit in self.fits] for n in self.fits[0].modifiers}
        return {n: (float(np.mean(v)), float(np.std(v, ddof=1))) for n, v in found.items()}

    @property
    def best(self) -> Fit:
        """The member with the lowest loss over what was held out, else over the whole record."""
        return min(self.fits, key=lambda fit: fit.score)

    def report(self, folder: str | Path, title: str = "Ensemble") -> Path:
        """Write a self-contained page, ``index.html`` in a folder; returns its path."""
        return write_ensemble_page(self, Path(folder) / "index.html", title)

    def __repr__(self) -> str:
        losses = ", ".join(f"{fit.score:.4g}" for fit in self.fits)
        first = self.fits[0]
        lines = [
            f"Ensemble of {len(self.fits)} for {', '.join((*first.seen, *first.modifiers))}",
            f"  losses    {losses}",
            f"  time      {first.seconds:.3g} s",
        ]
        changes = [f"{n} {mean:+.3f} ± {sigma:.3f}" for n, (mean, sigma) in self.modifiers.items()]
        return "\n".join([*lines, *([f"  modifiers {', '.join(changes)}"] if changes else [])])


def ensemble(
    system: System,
    data: Data | Mapping[str, ArrayLike],
    targets: str | Sequence[str],
    *,
    members: int = 5,
    params: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    seed: int = 0,
    **wishes: Any,
) -> Ensemble:
    """Train several times from different seeds, in one compiled program.

    Arguments:
        system, data, targets: as of `acausal.fit`.
        members: how many.
        params: where to start: the numbers of all members, whose networks come from their own seeds; or all
            parameters of each member, which then differ in nothing else than their networks.
        seed: of the first member; the others follow by one each.
        wishes: further arguments of `acausal.fit`, all but ``devices``.

    Raises:
        DataError, TrainingError: as `acausal.fit` does; if there are fewer than two members, or their networks are
            not alike.
        TypeError: for a wish that `acausal.fit` does not know.
    """
    need_compiled(system, "ensemble")
    if not isinstance(members, int | np.integer) or members < 2:
        raise TrainingError(f"members={members!r}; an ensemble has two at least.")
    unknown = [name for name in wishes if name not in _defaults()]
    if unknown:
        raise TypeError(
            f"ensemble has no argument '{unknown[0]}': {nearest(unknown[0], _defaults())}"
        )
    arguments = {**_defaults(), **wishes}
    if arguments["devices"] is not None:
        raise TrainingError("An ensemble is trained on one device: leave out devices=.")
    seeds = tuple(range(seed, seed + members))
    return Ensemble(
        together(system, data, targets, seeds=seeds, params=_starts(system, params, seeds), **arguments)
    )  # fmt: skip


def _starts(
    system: System,
    params: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None,
    seeds: Sequence[int],
) -> Sequence[Mapping[str, Any]]:
    if params is None or isinstance(params, Mapping):
        made = [system.parameters(seed) for seed in seeds]
        numbers = {n: leaf for n, leaf in (params or {}).items() if not callable(leaf)}
        return [{**own, **numbers} for own in made]
    if len(params) != len(seeds):
        raise TrainingError(f"There are {len(params)} params for {len(seeds)} members.")
    return [{**system.parameters(s), **own} for s, own in zip(seeds, params, strict=True)]


def _defaults() -> dict[str, Any]:
    """What `acausal.fit` takes by default, less what an ensemble says itself."""
    given = inspect.signature(fit).parameters.values()
    return {
        p.name: p.default
        for p in given
        if p.kind is p.KEYWORD_ONLY and p.name not in ("params", "seed")
    }


def _spread(x: np.ndarray, curves: Sequence[np.ndarray]) -> Band:
    return Band(x, np.mean(curves, axis=0), np.std(curves, axis=0, ddof=1))
