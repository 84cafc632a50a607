"""A training in the log: how far it is, and what diverged."""

from __future__ import annotations

import logging

from acausal.training.progress import Progress

LOGGER = logging.getLogger(__name__)


def log_progress(progress: Progress) -> None:
    """An observer that writes what is reported into the log."""
    for divergence in progress.divergences:
        LOGGER.info("%s", divergence)
    LOGGER.debug(
        "epoch %d of %d: loss %.4g, best %.4g, %.3g s",
        progress.epoch,
        progress.epochs,
        progress.loss,
        progress.best,
        progress.seconds,
    )
