"""The ride of the quarter vehicle, cut into records of unequal lengths."""

from __future__ import annotations

import numpy as np

import acausal as ac

SHARES = (0.4, 0.8, 1.2, 1.6)
"""Lengths of records, relative to their mean; they occur equally often."""


def pieces(record: ac.Data, count: int) -> dict[str, ac.Data]:
    """``count`` records of unequal lengths that make up all of a record; every one has its own clock."""
    if count == 1:
        return {"run 1": record}
    shares = np.tile(SHARES, count)[:count]
    ends = np.round(np.cumsum(shares) / shares.sum() * len(record)).astype(int)
    starts = np.append(0, ends[:-1])
    return {
        f"run {i}": ac.Data(
            record.time[a:b] - record.time[a], {n: v[a:b] for n, v in record.signals.items()}
        )
        for i, (a, b) in enumerate(zip(starts, ends, strict=True), 1)
    }


def thinned(
    record: ac.Data, targets: tuple[str, ...], states: tuple[str, ...] = (), *, seed: int = 0
) -> ac.Data:
    """A record as a rig may write it: the second target at a tenth of the rate, 20 % of all samples missing at random,
    and all of them in a gap of a tenth of the time.

    Arguments:
        record: as measured.
        targets: what is thinned.
        states: what else loses samples, at random and in the gap.
        seed: of what is missing.
    """
    generator = np.random.default_rng(seed)
    n = len(record)
    signals = {name: values.copy() for name, values in record.signals.items()}
    for name in (*targets, *states):
        signals[name][generator.random(n) < 0.2] = np.nan
        signals[name][int(0.5 * n) : int(0.6 * n)] = np.nan
    slow = np.arange(n) % 10 != 0
    signals[targets[1]][slow] = np.nan
    return ac.Data(record.time, signals, missing="nan")
