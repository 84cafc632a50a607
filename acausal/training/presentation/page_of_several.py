"""The page of several trainings of one model: an ensemble, or the folds of a cross-validation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from acausal.pages import Known, labelled
from acausal.reporting import (
    Band,
    Block,
    Curve,
    PageContent,
    Plot,
    Table,
    broken_at_gaps,
    kept_rows,
)
from acausal.training.history import History
from acausal.training.presentation.page_laws import Sections, content_with_laws
from acausal.training.presentation.page_records import RECORDS_SHOWN
from acausal.training.record_fit import RecordFit
from acausal.training.trained_model import TrainedModel

POINTS = 4000
"""Points in a plot."""


def several_content(
    fit: TrainedModel,
    title: str,
    lead: str,
    overview: Table,
    records: Sections,
    laws: Mapping[str, Band],
    histories: Mapping[str, History],
    parameters: Table | None,
) -> PageContent:
    """All that the page shows.

    Arguments:
        fit: the training with whose values the model is shown.
        title, lead: headline, and a sentence below it.
        overview: a row for each training.
        records: sections on records, by title.
        laws: by network, what was learned on average.
        histories: by training.
        parameters: that were trained.
    """
    tabs: dict[str, Sections] = {
        "Result": {"": [overview], "Trained parameters": [parameters]},
        "Records": records,
        "Training": {"Losses": [_losses(histories)]},
    }
    known = Known(fit.system.pack(fit.params))
    return content_with_laws(fit, title, lead, known, laws, tabs)


def _losses(histories: Mapping[str, History]) -> Plot:
    curves = [
        Curve(label, *history.full_loss.T.astype(float), dots=True)
        for label, history in histories.items()
    ]
    positive = all(bool((curve.y > 0).all()) for curve in curves)
    caption = "The losses over the whole record, update by update."
    return Plot(caption, "epoch", "loss", tuple(curves), log=positive)


def prediction_blocks(
    records: Mapping[str, RecordFit],
    predicted: Mapping[str, Mapping[str, Band]],
    units: Mapping[str, str],
    what: str = "mean of the members",
    whose: str = "of the members ",
) -> Iterable[Block]:
    """Targets as measured, and by record as the members of an ensemble predict them on average.

    Captions say what is predicted, and whose the standard deviations are.
    """
    for record, bands in list(predicted.items())[:RECORDS_SHOWN]:
        where = "" if len(predicted) == 1 else f" of '{record}'"
        for i, (name, band) in enumerate(bands.items()):
            measured = records[record].measured[:, i]
            low, high = band.bounds
            rows = kept_rows([measured, low, high], POINTS)
            samples = broken_at_gaps(records[record].time[rows], measured[rows])
            mean = Curve(what, band.x[rows], band.law[rows], "after", band.sigma[rows])
            yield Plot(
                f"'{name}'{where}, two standard deviations {whose}to either side.",
                "time [s]",
                labelled(name, units[name]),
                (Curve("measured", *samples, "measured"), mean),
            )
