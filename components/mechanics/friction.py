"""Dry friction that locks: the finite state machine that friction elements share, in any domain.

Its names and laws are those of the Modelica Standard Library (Otter, Elmqvist and Mattsson: Hybrid Modeling in Modelica
based on the Synchronous Data Flow Principle, CACSD 1999).
"""

from collections.abc import Iterator
from typing import Any

import acausal as ac

__modelica__ = None

UNKNOWN, FREE, FORWARD, STUCK, BACKWARD = 3, 2, 1, 0, -1
"""Modes of a friction element."""

AWAKE = 1e-10
"""A contact that starts to slide moves from this speed on; it is beyond what rounding adds to that of a stuck one."""

STARTED = 1e-6
"""By so much less friction a contact that has started to slide, but does not move yet, locks again: beyond rounding."""


class Locking(ac.Component):
    """A contact that slides or is locked; or creeps by a smooth law, with ``smooth``.

    ``sa`` is the path parameter of the friction characteristic: the friction while the contact is ``locked``, and the
    acceleration, shifted by the friction at which sliding begins, while it slides. It is found from the balance of
    torques or forces.
    """

    UNUSED = ("mode", "startForward", "startBackward", "locked", "free", "stuck")

    smooth = ac.Option(False, doc="whether a smooth law creeps at rest instead of locking")
    sa = ac.Variable(when="_locks", doc="path parameter: friction while locked, else acceleration")
    startForward = ac.Discrete(kind="bool", when="_locks", doc="1 where forward sliding begins")
    locked = ac.Discrete(kind="bool", when="_locks", doc="1 where the contact does not slide")

    @property
    def _locks(self) -> bool:
        """Whether the contact locks."""
        return not self.smooth


class Moded(Locking):
    """A contact that slides forward, slides backward, or is stuck, as ``mode`` says."""

    startBackward = ac.Discrete(kind="bool", when="_locks", doc="1 where backward sliding begins")
    mode = ac.Discrete(
        UNKNOWN,
        kind="int",
        when="_locks",
        doc="-1 sliding backward, 0 stuck, 1 sliding forward, 2 free, 3 unknown",
    )

    def _was(self, mode: int) -> Any:
        """Whether the mode just before the event was this one."""
        return self._count(mode) > 0.5

    def _count(self, mode: int) -> Any:
        """1 where the mode just before the event was this one, else 0."""
        return ac.maximum(1 - ac.Abs(ac.pre(self.mode) - mode), 0)

    @property
    def _slides(self) -> Any:
        """Whether it slides, or starts to."""
        goes_on = self._was(FORWARD) | self._was(BACKWARD)
        return goes_on | self.startForward | self.startBackward

    def _gives_way(self, started: Any, friction: Any, held: Any) -> Any:
        """Whether a stuck contact that is locked, or has ``started`` already, does not hold any more.

        Elsewhere nothing is watched: ``sa`` means something else while the contact slides. A contact that has started
        does not lock again at once where another one holds what it has let go.

        Arguments:
            friction: in the direction of sliding. held: what the contact holds.
        """
        beyond = friction - (1 - STARTED * started) * held
        return self._count(STUCK) * (self.locked + started) * beyond > 0

    def _goes_forward(self, speed: Any) -> Any:
        """Whether a contact moves forward that slid forward just before, was free, or starts.

        Elsewhere nothing is watched: the speed of a stuck contact is zero but for rounding.
        """
        before = ac.minimum(ac.maximum(ac.pre(self.mode), 0), 1)
        return _moves(speed, before, self.startForward)

    def _goes_backward(self, speed: Any) -> Any:
        """Whether a contact moves backward that slid backward just before, was free, or starts."""
        mode = ac.pre(self.mode)
        before = ac.minimum(ac.maximum(-mode, 0) + ac.maximum(mode - FORWARD, 0), 1)
        return _moves(-speed, before, self.startBackward)


def _moves(speed: Any, before: Any, starts: Any) -> Any:
    """Whether a contact is faster than 0; one that ``starts``, and did not move ``before``, than `AWAKE`."""
    return before * speed + (1 - before) * starts * (speed - AWAKE) > 0


class Contact(Moded):
    """A contact of given sliding and static friction, which a subclass states, and where it is ``free``."""

    free = ac.Discrete(kind="bool", when="_locks", doc="1 where nothing presses the contact")

    @property
    def _bounds(self) -> tuple[Any, Any]:
        """Whether it may move forward and backward."""
        return True, True

    def _contact(
        self, speed: Any, acceleration: Any, sliding: Any, static: Any, small: Any
    ) -> Iterator[ac.Eq]:
        """When it slides, and how it accelerates.

        Arguments:
            speed, acceleration: of the surfaces against each other.
            sliding, static: friction at rest when it begins to slide, and at most while it is locked.
            small: greatest speed against its direction that a sliding contact keeps.
        """
        forward = self._goes_forward((1 - self.free) * speed)
        backward = self._goes_backward((1 - self.free) * speed)
        to_move = [
            static - ac.pre(s) * (static - sliding) for s in (self.startForward, self.startBackward)
        ]
        ahead, back = self._bounds
        started_forward = self._gives_way(self.startForward, self.sa, to_move[0]) & ahead
        started_backward = self._gives_way(self.startBackward, -self.sa, to_move[1]) & back
        turned_forward = self._count(BACKWARD) * (speed - small) > 0
        turned_backward = self._count(FORWARD) * (-speed - small) > 0
        begins = ac.initial()
        yield ac.Eq(self.startForward, started_forward | turned_forward | (begins & forward))
        yield ac.Eq(self.startBackward, started_backward | turned_backward | (begins & backward))
        yield ac.Eq(self.locked, ~(self.free | self._slides))
        shifted = self.sa - self._direction * static
        yield ac.Eq(acceleration, ac.where(self.locked, 0, ac.where(self.free, self.sa, shifted)))
        moving = ac.where(forward & ahead, FORWARD, ac.where(backward & back, BACKWARD, STUCK))
        yield ac.Eq(self.mode, ac.where(self.free, FREE, moving))

    @property
    def _direction(self) -> Any:
        """1 where it slides forward, else -1."""
        forward = ac.where(self._was(FORWARD), 1, -1)
        return ac.where(self.startForward, 1, ac.where(self.startBackward, -1, forward))

    def _friction(self, sliding: Any) -> Any:
        """The friction: what holds a locked contact, nothing where it is free, else ``sliding``."""
        return ac.where(self.locked, self.sa, ac.where(self.free, 0, sliding))
