"""The battery pack of `examples.battery_pack`: simulation and gradient."""

from __future__ import annotations

from typing import Any

from benchmarks.stiff.compare import Task, against_cvode, gradient_cost
from examples.battery_pack.cycle import HOUR
from examples.battery_pack.model import LAW
from examples.battery_pack.study import CELLS, ROWS, drive, warmth

ROUNDS = 3


def pack(rows: int = ROWS, cells: int = CELLS, seconds: float = HOUR) -> dict[str, Any]:
    """The drive, beside CVODE's, and the gradient of the final mean temperature by all weights."""
    driven = drive(rows, cells, seconds)
    task = Task("pack", driven.system, driven.t, driven.inputs)
    found = against_cvode(task, ROUNDS)
    law = driven.system.parameters()[LAW]
    return found | gradient_cost("pack", lambda law: warmth(driven, law), (law,), rounds=ROUNDS)
