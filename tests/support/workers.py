"""Workers for the tests: two spawned processes, and tasks that end the process they run in."""

from __future__ import annotations

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path


def spawned() -> ProcessPoolExecutor:
    """Two processes that share nothing with this one."""
    return ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))


def killed_once(common: Path, task: int) -> int:
    """Twice the task; the first worker that has task 3 is killed, and leaves a file that says so."""
    if task == 3 and not common.exists():
        common.touch()
        os._exit(9)
    return 2 * task
