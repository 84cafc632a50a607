"""Sampled blocks (`Modelica.Blocks.Discrete`): they take their inputs at sample times, or at the times of a trigger."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .canonical import dot
from .conventions import TRUE, discrete_output
from .interfaces import SISO, DiscreteMIMO, DiscreteSISO

__modelica__ = "Modelica.Blocks.Discrete"


class Sampler(DiscreteSISO):
    """The input at sample times: ``y = u`` then, and at the start."""

    ICON = icons.SAMPLER

    y = discrete_output(doc="sampled signal")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.When(ac.initial() | self._sampling, ac.Eq(self.y, self.u))


class ZeroOrderHold(DiscreteSISO):
    """The input at sample times, held in between: ``y = pre(ySample)``.

    The output follows an instant after the sample, which breaks algebraic loops.
    """

    ICON = icons.HOLD

    ySample = ac.Discrete(doc="input at the last sample time")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.When(ac.initial() | self._sampling, ac.Eq(self.ySample, self.u))
        yield ac.Eq(self.y, ac.pre(self.ySample))


class FirstOrderHold(DiscreteSISO):
    """Straight on from the last two samples: ``y = pre_uSample + pre(c) (time - tSample)``."""

    ICON = icons.LINEAR_HOLD

    tSample = ac.Discrete(unit="s", doc="last sample time")
    uSample = ac.Discrete(doc="input at the last sample time")
    pre_uSample = ac.Discrete(doc="input at the sample time before")
    c = ac.Discrete(doc="slope between the two samples")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        slope = (self.uSample - self.pre_uSample) / self.samplePeriod
        yield ac.When(
            ac.initial(),
            ac.Eq(self.tSample, ac.time),
            ac.Eq(self.uSample, self.u),
            ac.Eq(self.pre_uSample, self.u),
            otherwise=ac.When(
                self._sampling,
                ac.Eq(self.tSample, ac.time),
                ac.Eq(self.uSample, self.u),
                ac.Eq(self.pre_uSample, ac.pre(self.uSample)),
                ac.Eq(self.c, ac.where(self.firstTrigger > TRUE, 0, slope)),
            ),
        )
        since = ac.time - self.tSample
        yield ac.Eq(self.y, self.pre_uSample + ac.pre(self.c) * since)


class UnitDelay(DiscreteSISO):
    """The previous sample: at sample times the input just before, from ``y_start`` on."""

    ICON = icons.DELAY

    y_start = ac.Parameter(0.0, doc="initial value of the output")
    y = discrete_output("y_start", doc="output signal")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.When(self._sampling, ac.Eq(self.y, ac.pre(self.u)))


class TransferFunction(DiscreteSISO):
    """``(b[1] z**m + ... + b[m+1])/(a[1] z**n + ... + a[n+1])`` with ``m <= n``, in controller canonical form.

    At sample times ``x1 = (u - a[2] pre(x[1]) - ... - a[n+1] pre(x[n]))/a[1]``, ``xext = [x1, pre(x)]``,
    ``x = xext[1:n]``, ``y = b xext``.
    """

    ICON = icons.block("b(z)/a(z)")

    b = ac.Parameter([1.0], shape=":", doc="numerator, highest power first")
    a = ac.Parameter([1.0], shape=":", doc="denominator, highest power first")
    y = discrete_output(doc="output signal")
    x = ac.Discrete(shape="nx", doc="states in controller canonical form")
    x1 = ac.Discrete(doc="the newest of them")
    xext = ac.Discrete(shape="na", doc="the newest and the previous states")

    @property
    def na(self) -> int:
        """Number of coefficients of the denominator."""
        return len(self.a)

    @property
    def nx(self) -> int:
        """Number of states."""
        return self.na - 1

    def equations(self) -> Iterator[Any]:
        if len(self.b) > self.na:
            raise ac.DeclarationError(
                f"TransferFunction: the numerator has {len(self.b)} coefficients, the denominator {self.na}; it must "
                "not have fewer"
            )
        yield from super().equations()
        before = [ac.pre(x) for x in self.x]
        extended = [self.x1, *before]
        b = [*[0] * (self.na - len(self.b)), *self.b]
        states = zip((*self.xext, *self.x), (*extended, *extended[:-1]), strict=True)
        yield ac.When(
            self._sampling,
            ac.Eq(self.x1, (self.u - dot(self.a[1:], before)) / self.a[0]),
            *(ac.Eq(x, value) for x, value in states),
            ac.Eq(self.y, dot(b, extended)),
        )


class StateSpace(DiscreteMIMO):
    """At sample times ``x = A pre(x) + B u``, ``y = C pre(x) + D u`` with matrices; ``D`` is zero by default."""

    ICON = icons.marked(icons.STATE_SPACE, "z")

    A = ac.Parameter([[1.0, 0.0], [0.0, 1.0]], shape=(":", ":"), doc="state matrix")
    B = ac.Parameter([[1.0], [1.0]], shape=(":", ":"), doc="input matrix")
    C = ac.Parameter([[1.0, 1.0]], shape=(":", ":"), doc="output matrix")
    D = ac.Parameter(0.0, shape=("nout", "nin"), doc="feedthrough matrix")
    y = discrete_output(shape="nout", doc="output signals")
    x = ac.Discrete(shape="nx", doc="states")

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.A)

    @property
    def nin(self) -> int:
        """Number of inputs."""
        return len(self.B[0])

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self.C)

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        before = [ac.pre(x) for x in self.x]
        rows = ((self.x, self.A, self.B), (self.y, self.C, self.D))
        yield ac.When(
            self._sampling,
            *(
                ac.Eq(target, dot(of_x, before) + dot(of_u, self.u))
                for targets, xs, us in rows
                for target, of_x, of_u in zip(targets, xs, us, strict=True)
            ),
        )


class _Triggered(SISO):
    """What blocks with a trigger share: the input counts where ``trigger`` becomes true."""

    trigger = ac.Input(doc="when the input is taken")


class TriggeredSampler(_Triggered):
    """The input at the times of a trigger: ``y = u`` then, and ``y_start`` before."""

    ICON = icons.truths(icons.marked(icons.SAMPLER, "trig"), "trigger")

    y_start = ac.Parameter(0.0, doc="initial value of the output")
    y = discrete_output("y_start", doc="sampled signal")

    def equations(self) -> Iterator[Any]:
        yield ac.When(self.trigger > TRUE, ac.Eq(self.y, self.u))


class TriggeredMax(_Triggered):
    """The greatest absolute value of the input at the times of a trigger so far."""

    ICON = icons.truths(icons.marked(icons.block("max"), "trig"), "trigger")

    y = discrete_output(doc="greatest absolute value")

    def equations(self) -> Iterator[Any]:
        greatest = ac.maximum(ac.pre(self.y), ac.Abs(self.u))
        yield ac.When(self.trigger > TRUE, ac.Eq(self.y, greatest))
