"""What ``--verbose`` shows: the library's log, on the standard error."""

from __future__ import annotations

import logging
from collections.abc import Generator
from contextlib import contextmanager

LEVELS = {0: logging.WARNING, 1: logging.INFO}
"""Levels by how often ``-v`` was given; more gives all."""


@contextmanager
def logging_to_stderr(verbose: int) -> Generator[None]:
    """Show what the logger ``acausal`` is told, while a command runs."""
    logger, handler = logging.getLogger("acausal"), logging.StreamHandler()
    handler.setFormatter(logging.Formatter("%(relativeCreated)7.0f ms  %(name)s: %(message)s"))
    before = logger.level
    logger.setLevel(LEVELS.get(verbose, logging.DEBUG))
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.setLevel(before)
