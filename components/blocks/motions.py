"""Point-to-point motions as fast as limits on speed and acceleration allow.

All axes start and stop together: a path parameter goes from 0 to 1 with the greatest acceleration and
the greatest speed that no axis exceeds, so that one axis is at its limit.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import acausal as ac
from acausal.components import icons

from .interfaces import MO

__modelica__ = "Modelica.Blocks.Sources"


class _Path(NamedTuple):
    """A motion from 0 to 1: acceleration, time it lasts, time at which braking starts, end."""

    acceleration: Any
    speeding: Any
    braking: Any
    end: Any

    def position(self, t: Any) -> Any:
        a, rise, brake, end = self
        speed_up = a * t**2 / 2
        cruise = a * rise * (t - rise / 2)
        slow_down = 1 - a * (end - t) ** 2 / 2
        return _pieces(t, (0, rise, brake, end), (0, speed_up, cruise, slow_down, 1))

    def speed(self, t: Any) -> Any:
        a, rise, brake, end = self
        return _pieces(t, (0, rise, brake, end), (0, a * t, a * rise, a * (end - t), 0))

    def rate(self, t: Any) -> Any:
        a, rise, brake, end = self
        return _pieces(t, (0, rise, brake, end), (0, a, 0, -a, 0))


def _path(distances: Sequence[Any], speeds: Sequence[Any], accelerations: Sequence[Any]) -> _Path:
    slowness = ac.maximum(*(ac.Abs(q) / v for q, v in zip(distances, speeds, strict=True)))
    inertia = ac.maximum(*(ac.Abs(q) / a for q, a in zip(distances, accelerations, strict=True)))
    a = 1 / inertia
    rise = ac.minimum(ac.sqrt(inertia), inertia / slowness)
    brake = ac.maximum(ac.sqrt(inertia), slowness)
    return _Path(a, rise, brake, rise + brake)


def _pieces(t: Any, bounds: Sequence[Any], values: Sequence[Any]) -> Any:
    value = values[-1]
    for bound, piece in zip(reversed(bounds), reversed(values[:-1]), strict=True):
        value = ac.where(t < bound, piece, value, events=None)
    return value


def _spread(values: Sequence[Any], n: int) -> Sequence[Any]:
    return [values[0]] * n if len(values) == 1 else values


class KinematicPTP(MO):
    """Acceleration ``y`` of a motion over ``deltaq``, as fast as ``qd_max`` and ``qdd_max`` allow.

    Each of the three is a vector with one element per output, or with one element for all. At least
    one distance must not be zero.
    """

    ICON = icons.POINT_TO_POINT

    deltaq = ac.Parameter([1.0], shape=":", doc="distance to move")
    qd_max = ac.Parameter([1.0], shape=":", min=0, doc="greatest speed")
    qdd_max = ac.Parameter([1.0], shape=":", min=0, doc="greatest acceleration")
    startTime = ac.Parameter(0.0, unit="s", doc="start of the motion")

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return max(len(self.deltaq), len(self.qd_max), len(self.qdd_max))

    def equations(self) -> Iterator[ac.Eq]:
        limits = (self.deltaq, self.qd_max, self.qdd_max)
        distances, speeds, accelerations = (_spread(v, self.nout) for v in limits)
        rate = _path(distances, speeds, accelerations).rate(ac.time - self.startTime)
        for y, distance in zip(self.y, distances, strict=True):
            yield ac.Eq(y, distance * rate)


class KinematicPTP2(ac.Component):
    """Position ``q``, speed ``qd`` and acceleration ``qdd`` of a motion from ``q_begin`` to ``q_end``.

    As fast as ``qd_max`` and ``qdd_max`` allow; vectors as in `KinematicPTP`. ``endTime`` [s] is when
    the motion stops. The output ``moving`` of Modelica is Boolean and not there.
    """

    ICON = icons.S_CURVE

    q_begin = ac.Parameter([0.0], shape=":", doc="start position")
    q_end = ac.Parameter([1.0], shape=":", doc="end position")
    qd_max = ac.Parameter([1.0], shape=":", min=0, doc="greatest speed")
    qdd_max = ac.Parameter([1.0], shape=":", min=0, doc="greatest acceleration")
    startTime = ac.Parameter(0.0, unit="s", doc="start of the motion")
    endTime = ac.Output(unit="s", doc="end of the motion")
    q = ac.Output(shape="nout", doc="position")
    qd = ac.Output(shape="nout", doc="speed")
    qdd = ac.Output(shape="nout", doc="acceleration")

    @property
    def nout(self) -> int:
        """Number of axes."""
        return max(len(self.q_begin), len(self.q_end), len(self.qd_max), len(self.qdd_max))

    def equations(self) -> Iterator[ac.Eq]:
        given = (self.q_begin, self.q_end, self.qd_max, self.qdd_max)
        begins, ends, speeds, accelerations = (_spread(v, self.nout) for v in given)
        distances = [end - begin for begin, end in zip(begins, ends, strict=True)]
        path = _path(distances, speeds, accelerations)
        t = ac.time - self.startTime
        for i, (begin, distance) in enumerate(zip(begins, distances, strict=True)):
            yield ac.Eq(self.q[i], begin + distance * path.position(t))
            yield ac.Eq(self.qd[i], distance * path.speed(t))
            yield ac.Eq(self.qdd[i], distance * path.rate(t))
        yield ac.Eq(self.endTime, self.startTime + path.end)
