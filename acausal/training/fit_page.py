"""What the page of a training tells: the model with what it has learned, the records, and how sure all of it is."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from acausal.pages import (
    Known,
    Law,
    component_cards,
    labelled,
    schematic,
    summary,
)
from acausal.reporting import (
    Block,
    Curve,
    PageContent,
    Plot,
    Profiled,
    Tab,
    Table,
    Text,
    table,
    thinned,
    titled_sections,
)
from acausal.training.history import History
from acausal.training.page_laws import SURE, law_blocks
from acausal.training.page_records import record_blocks, runs_of
from acausal.training.page_subject import Trained
from acausal.training.record_fit import RecordFit, out_of_range
from acausal.training.uncertainty.confidence import Confidence
from acausal.training.uncertainty.residuals import Residuals

LOSSES = 2000
"""Losses that are drawn."""

DIVERGENCES_SHOWN = 50
"""Divergences that are listed."""


def fit_content(
    fit: Trained,
    before: Mapping[str, RecordFit],
    title: str,
    lead: str,
    losses: Sequence[tuple[str, str, str]],
    profiles: Sequence[Profiled] = (),
) -> PageContent:
    """All that the page of a training shows.

    Arguments:
        fit: the result. before: the records before training.
        title, lead: headline, and a sentence below it.
        losses: rows of a table: what, before, after.
        profiles: to show whether parameters are identifiable.
    """
    sure = fit.confidence() if np.isfinite(fit.loss) else None
    laws = (
        {}
        if sure is None
        else {n: law_blocks(fit, n, law) for n, law in fit.with_bands(sure.laws).items()}
    )
    known = Known(
        fit.system.pack(fit.params),
        changes=_changes(fit, sure),
        runs=runs_of(fit),
        over=f"Over the record '{next(iter(fit.records))}', before and after training.",
        laws=[Law(n, tuple(blocks)) for n, blocks in laws.items()],
    )
    remarks = {n: out_of_range(record, fit) for n, record in fit.held_out.items()}
    parts: dict[str, Mapping[str, Sequence[Block | None]]] = {
        "Records": {
            "Measured and simulated": list(record_blocks(fit, fit.records, before)),
            "Held out": list(record_blocks(fit, fit.held_out, {}, "held out, ", remarks)),
        },
        "Laws": {"Learned laws": [Text(SURE), *(b for blocks in laws.values() for b in blocks)] if laws else []},
        "Training": {
            "Losses": [table(("figure", "before", "after"), losses), *_losses(fit)],
            "Stages": _stages(fit),
            "Trained parameters": _parameters(fit, sure),
            "Parameters of records": [_own(fit, sure)],
        },
        "Trust": {
            "How sure it is": [Text(s) for s in _sentences(sure)],
            "Profiles": [block for p in profiles for block in _profile(p)],
            "Residuals": [] if sure is None else [b for r in fit.residuals() for b in _residuals(r)],
            "What diverged": list(_diverged(fit.history)),
        },
    }  # fmt: skip
    tabs = [Tab(name, titled_sections(blocks)) for name, blocks in parts.items()]
    return PageContent(
        title,
        lead,
        schematic(fit.system.model),
        component_cards(fit.system, known),
        tuple(tab for tab in tabs if tab.sections),
        f"{fit.system.flat.name}: {summary(fit.system)}",
    )


# -- training ------------------------------------------------------------------------------------------------


def _stages(fit: Trained) -> list[Block]:
    rows = [(s.title, f"{s.loss:.4g}", str(s.updates)) for s in fit.stages]
    return [table(("stage", "loss reached", "updates"), rows)] if rows else []


def _losses(fit: Trained) -> Iterable[Block]:
    """The losses and the changes of parameters over the updates, and what several starts reached."""
    history = fit.history
    curves = [
        *thinned(
            [Curve("batches", np.arange(history.epochs, dtype=float), history.loss, "measured")],
            LOSSES,
        )
    ]
    epochs, losses = history.full_loss.T.astype(float)
    curves.append(Curve("whole record", epochs, losses, "after", dots=True))
    if len(history.validation_loss):
        epochs, losses = history.validation_loss.T.astype(float)
        curves.append(Curve("held out", epochs, losses, "before", dots=True))
    curves = [c for c in curves if len(c.x)]
    lowest = min((float(np.min(c.y, initial=np.inf)) for c in curves), default=0.0)
    yield Plot(
        "The loss, update by update: of the batches and over the whole record.",
        "epoch", "loss", tuple(curves), log=lowest > 0,
    )  # fmt: skip
    if history.modifiers and history.epochs > 1:
        epochs = np.arange(history.epochs, dtype=float)
        moved = [Curve(n, epochs[: len(v)], np.asarray(v)) for n, v in history.modifiers.items()]
        yield Plot("Changes of the trained parameters.", "epoch", "change", thinned(moved, LOSSES))
    if fit.starts is not None:
        yield Text(fit.starts.summary())
        yield table(fit.starts.header, fit.starts.rows())


def _changes(fit: Trained, sure: Confidence | None) -> dict[str, tuple[str, str]]:
    """The change of every trained parameter and its standard deviation, as texts."""
    written, unit = fit.problem.modifiers.written, fit.problem.unit
    return {
        name: (
            written(name, change, "+.3g", unit(name)),
            "" if sure is None else written(name, sure.parameters[name], ".2g", unit(name)),
        )
        for name, change in fit.modifiers.items()
    }


def _parameters(fit: Trained, sure: Confidence | None) -> list[Block]:
    """Value, change and standard deviation of every trained parameter."""
    params, unit = fit.problem.assemble(fit.trained), fit.problem.unit
    rows = [
        (n, f"{float(params[n]):.6g} {unit(n)}".removesuffix(" 1"), *texts)
        for n, texts in _changes(fit, sure).items()
    ]
    return [table(("parameter", "value", "change", "one sigma"), rows)] if rows else []


def _own(fit: Trained, sure: Confidence | None) -> Table | None:
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


def _sentences(sure: Confidence | None) -> list[str]:
    if sure is None:
        return [
            "The trained model diverges over the record; what it has learned cannot be assessed."
        ]
    return sure.summary()


def _profile(profile: Profiled) -> Iterable[Block]:
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
