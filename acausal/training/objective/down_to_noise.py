"""How near to the noise a loss must be to count as down to it, where the noise is itself an estimate."""

from __future__ import annotations

import numpy as np

from acausal.training.objective.records import Records

MANY = 1.15
"""A loss of up to so many times that of the noise is down to it where many samples tell the noise,"""

SCATTER = 1.2
"""and where few do, of up to one and some standard deviations of the noise: this / √N for N samples. The value is
measured: of white noise, `acausal.data.noise_level` scatters by 1.07 / √N for 10 samples, 1.28 / √N for 40, and by
1.2 / √N for 1000."""

SURE = 3.3
"""The number of standard deviations. Of records of 10 to 60 samples, a right model with three parameters leaves more in
at most 2 %, and in fewer of longer ones."""


def is_down_to_noise(records: Records, loss: float, noise: float) -> bool:
    """Whether a loss over records is down to that of their noise, `noise_loss`."""
    return bool(loss <= down_to(records) * noise)


def down_to(records: Records) -> float:
    """The largest ratio of a loss over records to that of their noise, `noise_loss`, that is still down to the noise.

    By the mean number of samples of a target: several targets are taken as no surer than one.
    """
    return largest_ratio(float(np.mean(np.sum(np.asarray(records.weight) > 0, axis=0))))


def largest_ratio(samples: float) -> float:
    """The same for so many samples: 2.25 for 10, 1.4 for 100, 1.18 for 500, and 1.15 from 697 on.

    The noise is the least of several estimates, each of them from differences that overlap, so that it scatters more
    than the 1 / √(2 N) of independent samples.
    """
    return max(MANY, 1 + SURE * SCATTER / float(np.sqrt(max(samples, 1.0))))
