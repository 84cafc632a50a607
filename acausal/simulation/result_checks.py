"""What a finished simulation is looked at for: assertions, and results that mislead."""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from acausal._jax import known, traced
from acausal.codegen import asserted, check_assertions
from acausal.errors import SimulationError, warn
from acausal.events import PART_OF_PERIOD
from acausal.simulation.solution import Solution

FEWEST, JUMP = 10, 10.0
"""Points among which jumps are looked for, and how much larger a jump is than moves around it, and than rates allow."""


def check_result(solution: Solution) -> None:
    """Refuse a result that is not as the model asserts, and warn of what misleads.

    Raises:
        SimulationError: where an assertion does not hold.
    """
    _warn_of_another_solution(solution)
    _warn_of_fractions(solution)
    _check_assertions(solution)


def _check_assertions(solution: Solution) -> None:
    """Refuse a result in which an assertion of the model does not hold, or warn, as it says."""
    system = solution.system
    names = asserted(system.flat)
    if names is None or traced(solution.values) or solution.t.ndim != 1:
        return
    columns = solution.to_dict(names)
    value = system.layout.by_number(np.asarray(solution.packed.last.values))
    check_assertions(system.flat, value, SimulationError, columns)


def _warn_of_another_solution(solution: Solution) -> None:
    """Warn where positions that a nonlinear loop computes jump: a linkage has gone to its other assembly."""
    pairs = solution.system.reduced.solved_positions
    if not pairs or known((solution.t, solution.x)) is None or len(solution.t) < FEWEST:
        return
    names, derivatives = zip(*pairs, strict=True)
    found = known((solution.t, solution[[*names, *derivatives]]))
    if found is None:
        return
    t, (positions, rates) = np.asarray(found[0]), np.split(np.asarray(found[1]).T, 2)
    moves = np.abs(np.diff(positions))
    fastest = np.maximum(np.abs(rates[:, :-1]), np.abs(rates[:, 1:])) * np.diff(t)
    around = sliding_window_view(np.pad(moves, ((0, 0), (4, 4)), "edge"), 9, 1)
    usual = np.maximum(np.median(around, -1), fastest)
    flat = solution.system.flat
    nominal = np.asarray([flat.nominal[flat.layout.find_variable(name)] for name in names])
    size = np.maximum(
        np.max(np.abs(positions), 1), 1e-3 * nominal
    )  # what is zero moves by rounding
    jumps = moves > JUMP * usual + 1e-6 * size[:, None]
    if jumps.any():
        k, row = np.argwhere(jumps.T)[0]
        warn(
            f"'{names[row]}' jumps from {positions[row, k]:.4g} to {positions[row, k + 1]:.4g} between t = "
            f"{t[k]:.4g} and {t[k + 1]:.4g} s: its equations have several solutions, and there it is another one. "
            'Give ac.Start values nearer to the motion, or choose other states (stateSelect="always").'
        )


def _warn_of_fractions(solution: Solution) -> None:
    """Warn where a discrete variable that was declared as a whole number, or as 1 or 0, is none."""
    system = solution.system
    found = known((solution.t, solution.d)) if system.wholes and solution.t.ndim == 1 else None
    if found is None:
        return
    names, kinds = zip(*system.wholes.items(), strict=True)
    values = np.abs(np.asarray(found[1])[:, [system.discrete[n][0] for n in names]])
    truth = np.asarray(kinds) == "bool"
    wrong = np.isfinite(values) & ((values != np.round(values)) | (truth & (values > 1)))
    if wrong.any():
        row, i = np.argwhere(wrong)[0]
        t, wanted = float(np.asarray(found[0])[row]), "1 or 0" if truth[i] else "whole numbers"
        warn(
            f"'{names[i]}' is declared with kind='{kinds[i]}', but is {values[row, i]:g} at t = {t:g} s: give it "
            f"{wanted}, or leave kind out."
        )


def warn_of_few_points(solution: Solution, span: float) -> None:
    """Warn where a source repeats between two points of the default output: curves do not show what it does."""
    made = solution.statistics
    counts = None if made is None else known((made.steps, made.edges, solution.t[0]))
    if counts is None or np.ndim(counts[0]):
        return
    steps, edges, start = (float(count) for count in counts)
    count, system = len(solution.t), solution.system
    apart = span / count
    period = np.inf if system.inputs or not edges else 2 * span / edges  # inputs bend at samples
    if steps > count / PART_OF_PERIOD and system.edges:
        step = system.edges.ahead(solution.values.packed, start, 1e-9 * span).longest
        period = min(period, float(step) / PART_OF_PERIOD)
    if period < apart:
        warn(
            f"The {count} points of the output are {apart:.3g} s apart, and a source has a period of about "
            f"{period:.3g} s, which curves do not show. Give saveat=..., or a shorter span."
        )
