"""What the page of a training tells: the model with what it has learned, the records, and how sure all of it is."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from acausal.errors import DataError, shown
from acausal.pages import Known, labelled
from acausal.reporting import (
    Block,
    Curve,
    PageContent,
    Plot,
    Table,
    Text,
    table,
    thinned,
)
from acausal.training.auto.verdict import Verdict
from acausal.training.history import History
from acausal.training.presentation.fit_view import loss_curves, loss_rows, parameter_rows
from acausal.training.presentation.page_laws import Sections, content_with_laws
from acausal.training.presentation.page_records import record_blocks, runs_of
from acausal.training.profile import Profile
from acausal.training.trained_model import TrainedModel, out_of_range
from acausal.training.uncertainty.confidence import Confidence
from acausal.training.uncertainty.residuals import Residuals

LOSSES = 2000
"""Losses that are drawn."""

NOT_SURE = "The trained model diverges over the record; what it has learned cannot be assessed."

DIVERGENCES_SHOWN = 50
"""Divergences that are listed."""


def fit_content(
    fit: TrainedModel, verdict: Verdict | None, title: str, profiles: Sequence[Profile] = ()
) -> PageContent:
    """All that the page of a training shows; profiles show whether parameters are identifiable.

    Raises:
        DataError: for what is not a list of profiles.
    """
    if not (isinstance(profiles, list | tuple) and all(isinstance(p, Profile) for p in profiles)):
        raise DataError(f"profiles={shown(profiles)}; give a list of those of fit.profile(...).")
    sure = fit.confidence() if np.isfinite(fit.loss) else None
    rows = parameter_rows(fit, sure)
    known = Known(
        fit.system.pack(fit.params),
        changes={name: (change, deviation) for name, _, change, deviation in rows},
        runs=runs_of(fit),
        over=f"Over the record '{next(iter(fit.records))}', before and after training.",
    )
    remarks = {n: out_of_range(record, fit) for n, record in fit.held_out.items()}
    losses = [(what, f"{before:.4g}", f"{after:.4g}") for what, before, after in loss_rows(fit)]
    header = ("parameter", "value", "change", "one sigma")
    tabs: dict[str, Sections] = {
        "Records": {
            "Measured and simulated": list(record_blocks(fit, fit.records, fit.before)),
            "Held out": list(record_blocks(fit, fit.held_out, {}, "held out, ", remarks)),
        },
        "Training": {
            "Losses": [table(("figure", "before", "after"), losses), *_losses(fit)],
            "Stages": _stages(fit),
            "Trained parameters": [table(header, rows)] if rows else [],
            "Parameters of records": [_own(fit, sure)],
        },
        "Trust": {
            "How sure it is": [Text(s) for s in ([NOT_SURE] if sure is None else sure.summary())],
            "Profiles": [block for p in profiles for block in _profile(p)],
            "Residuals": [] if sure is None else [b for r in fit.residuals() for b in _residuals(r)],
            "What diverged": list(_diverged(fit.history)),
        },
    }  # fmt: skip
    lead = (
        f"{', '.join((*fit.seen, *fit.modifiers))} trained on {fit.samples_trained} samples of "
        f"{', '.join(fit.problem.targets)} in {fit.seconds:.3g} s, {fit.history.epochs} updates"
        f"{', ended by the user' * fit.interrupted}."
    )
    lead += "" if verdict is None else f" The model {verdict}"
    return content_with_laws(fit, title, lead, known, {} if sure is None else sure.laws, tabs)


# -- training ------------------------------------------------------------------------------------------------


def _stages(fit: TrainedModel) -> list[Block]:
    rows = [(s.title, f"{s.loss:.4g}", str(s.updates)) for s in fit.stages]
    return [table(("stage", "loss reached", "updates"), rows)] if rows else []


def _losses(fit: TrainedModel) -> Iterable[Block]:
    """The losses and the changes of parameters over the updates, and what several starts reached."""
    history = fit.history
    curves = tuple(c for curve in loss_curves(history) for c in thinned([curve], LOSSES))
    lowest = min((float(np.min(c.y, initial=np.inf)) for c in curves), default=0.0)
    yield Plot(
        "The loss, update by update: of the batches and over the whole record.",
        "epoch", "loss", curves, log=lowest > 0,
    )  # fmt: skip
    if history.modifiers and history.epochs > 1:
        epochs = np.arange(history.epochs, dtype=float)
        moved = [Curve(n, epochs[: len(v)], np.asarray(v)) for n, v in history.modifiers.items()]
        yield Plot("Changes of the trained parameters.", "epoch", "change", thinned(moved, LOSSES))
    if fit.starts is not None:
        yield Text(fit.starts.summary())
        yield table(fit.starts.header, fit.starts.rows())


def _own(fit: TrainedModel, sure: Confidence | None) -> Table | None:
    """The parameters that differ between records."""
    names = fit.problem.per_record.names
    if not names or sure is None:
        return None
    header = ("record", *(f"{n} [{fit.system.unit(n)}]" for n in names))
    rows = [
        (name, *(f"{r.parameters[n]:.5g} ± {sure.per_record[n][k]:.2g}" for n in names))
        for k, (name, r) in enumerate(fit.records.items())
    ]
    return table(header, rows)


# -- trust ---------------------------------------------------------------------------------------------------


def _profile(profile: Profile) -> Iterable[Block]:
    """A likelihood ratio over a parameter, with the bound of its interval."""
    yield Text(profile.summary())
    level = np.full(2, profile.bound)
    ends = np.array([profile.values.min(), profile.values.max()])
    finite = profile.ratio[np.isfinite(profile.ratio)]
    top = 1.1 * max(min(float(finite.max(initial=0.0)), 4 * profile.bound), profile.bound)
    yield Plot(
        f"The profile of '{profile.name}'. Everything else is trained again where it is held; where the curve stays "
        "below the bound, the values agree with the data.",
        labelled(profile.name, profile.unit),
        "likelihood ratio",
        (
            Curve("profile", profile.values, profile.ratio, "after", dots=True),
            Curve("bound", ends, level, "measured"),
        ),
        guides=(profile.value,),
        limits=(-0.05 * profile.bound, top),
    )


def _residuals(found: Residuals) -> Iterable[Block]:
    """Correlations of a target's residuals with themselves and with inputs."""
    yield Text(found.summary())
    rows = {"itself": (found.own, found.bound)}
    rows |= {n: (c, found.bounds[n]) for n, c in found.inputs.items()}
    curves: list[Curve] = []
    for label, (values, _) in rows.items():
        lags = np.arange(len(values), dtype=float) + (
            1 if label == "itself" else -(len(values) // 2)
        )
        curves.append(Curve(f"with {label}", lags, np.asarray(values)))
    ends = np.array([min(c.x.min() for c in curves), max(c.x.max() for c in curves)])
    bound = max(bound for _, bound in rows.values())
    for name, side in (("at most by chance", bound), ("at least by chance", -bound)):
        curves.append(Curve(name, ends, np.full(2, side), "measured"))
    yield Plot(
        f"Correlations of the residuals of '{found.target}', and what chance reaches.",
        "lag [samples]", "correlation", tuple(curves),
    )  # fmt: skip


def _diverged(history: History) -> Iterable[Block]:
    """The divergences of a training."""
    found = history.divergences
    if found:
        yield Text(f"{len(found)} times; the first {DIVERGENCES_SHOWN} at most:")
        yield table(("epoch", "what"), [(d.epoch, str(d)) for d in found[:DIVERGENCES_SHOWN]])
