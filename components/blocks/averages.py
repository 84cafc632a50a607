"""Mean, root mean square and harmonics of a signal over each period."""

from collections.abc import Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .conventions import SMALL
from .interfaces import SISO
from .logical import And, GreaterThreshold, Switch
from .math import Abs, Division, Gain, MultiProduct, Pythagoras, RectangularToPolar, Sqrt
from .nonlinear import Limiter
from .truth_sources import BooleanExpression
from .waves import Cosine, Sine

__modelica__ = "Modelica.Blocks.Math"

_SMALLEST = 2.220446049250313e-16
"""What a total harmonic distortion is divided by at least, as in Modelica."""

_LARGEST = 1e60


class Mean(SISO):
    """Mean of the input over each period ``1/f``: the output changes at the end of a period.

    ``x``, the integral of the input, starts at ``x0`` and is 0 at the beginning of each further period. The output
    starts at ``y0``.
    """

    ICON = icons.block("mean")

    f = ac.Parameter(unit="Hz", min=SMALL, doc="base frequency, greater than zero")
    x0 = ac.Parameter(0.0, doc="initial value of the integral")
    y0 = ac.Parameter(0.0, doc="initial value of the output")
    yGreaterOrEqualZero = ac.Option(False, doc="whether a negative mean counts as zero")
    t0 = ac.Discrete(unit="s", doc="start of the simulation")
    x = ac.Variable(start="x0", fixed=True, state="always", doc="integral over the present period")
    y_last = ac.Discrete("y0", doc="mean over the last period")

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.t0, ac.where(ac.initial(), ac.time, ac.pre(self.t0)))
        yield ac.Eq(ac.der(self.x), self.u)
        mean = self.f * ac.pre(self.x)
        yield ac.When(
            ac.sample(self.t0 + 1 / self.f, 1 / self.f),
            ac.Eq(self.y_last, ac.maximum(mean, 0) if self.yGreaterOrEqualZero else mean),
            ac.Reinit(self.x, 0),
        )
        yield ac.Eq(self.y, self.y_last)


class RectifiedMean(SISO):
    """Mean of the absolute value of the input over each period ``1/f``."""

    ICON = icons.block("mean |u|")

    f = ac.Parameter(unit="Hz", min=SMALL, doc="base frequency, greater than zero")
    x0 = ac.Parameter(0.0, doc="initial value of the integral")
    y0 = ac.Parameter(0.0, min=0, doc="initial value of the output")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.abs1 = Abs()
        self.mean = Mean(f=self.f, x0=self.x0, y0=self.y0, yGreaterOrEqualZero=True)
        self.connect(self.u, self.abs1.u)
        self.connect(self.abs1.y, self.mean.u)
        self.connect(self.mean.y, self.y)


class _Root(Sqrt):
    """The square root, with a derivative of zero at zero: that is the output until the first period has ended."""

    def equations(self) -> Iterator[Any]:
        positive = self.u > 0
        yield ac.Eq(self.y, ac.where(positive, ac.sqrt(ac.where(positive, self.u, 1)), 0))


class RootMeanSquare(SISO):
    """Root of the mean square of the input over each period ``1/f``."""

    ICON = icons.block("rms")

    f = ac.Parameter(unit="Hz", min=SMALL, doc="base frequency, greater than zero")
    x0 = ac.Parameter(0.0, doc="initial value of the integral")
    y0 = ac.Parameter(0.0, min=0, doc="initial value of the output")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.product = MultiProduct(nu=2)
        self.mean = Mean(f=self.f, x0=self.x0, y0=self.y0**2, yGreaterOrEqualZero=True)
        self.sqrt1 = _Root()
        self.connect(self.u, self.product.u[0])
        self.connect(self.u, self.product.u[1])
        self.connect(self.product.y, self.mean.u)
        self.connect(self.mean.y, self.sqrt1.u)
        self.connect(self.sqrt1.y, self.y)


class Harmonic(ac.Component):
    """The ``k``-th harmonic of the input over each period ``1/f``: ``sqrt(2) y_rms cos(2 pi k f t - y_arg)``.

    With ``useConjugateComplex`` the sign of ``y_arg`` is the opposite.
    """

    ICON = icons.block("harm")

    f = ac.Parameter(unit="Hz", min=SMALL, doc="base frequency, greater than zero")
    k = ac.Parameter(1.0, doc="order of the harmonic")
    useConjugateComplex = ac.Option(False, doc="whether y_arg has the opposite sign")
    x0Cos = ac.Parameter(0.0, doc="initial value of the integral with the cosine")
    x0Sin = ac.Parameter(0.0, doc="initial value of the integral with the sine")
    y0Cos = ac.Parameter(0.0, doc="initial mean with the cosine")
    y0Sin = ac.Parameter(0.0, doc="initial mean with the sine")
    u = ac.Input(doc="input signal")
    y_rms = ac.Output(doc="root mean square of the harmonic")
    y_arg = ac.Output(unit="rad", doc="angle of the harmonic")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        f = self.k * self.f
        self.sin1, self.sin2 = Cosine(amplitude=2**0.5, f=f), Sine(amplitude=2**0.5, f=f)
        self.product1, self.product2 = MultiProduct(nu=2), MultiProduct(nu=2)
        self.mean1 = Mean(f=self.f, x0=self.x0Cos, y0=self.y0Cos)
        self.mean2 = Mean(f=self.f, x0=self.x0Sin, y0=self.y0Sin)
        self.rectangularToPolar = RectangularToPolar()
        self.gain = Gain(k=-1 if self.useConjugateComplex else 1)
        self.connect(self.sin1.y, self.product1.u[0])
        self.connect(self.u, self.product1.u[1])
        self.connect(self.u, self.product2.u[0])
        self.connect(self.sin2.y, self.product2.u[1])
        self.connect(self.product1.y, self.mean1.u)
        self.connect(self.product2.y, self.mean2.u)
        self.connect(self.mean1.y, self.rectangularToPolar.u_re)
        self.connect(self.mean2.y, self.rectangularToPolar.u_im)
        self.connect(self.rectangularToPolar.y_abs, self.y_rms)
        self.connect(self.rectangularToPolar.y_arg, self.gain.u)
        self.connect(self.gain.y, self.y_arg)


class TotalHarmonicDistortion(SISO):
    """All of the input but its first harmonic, relative to that, or without ``useFirstHarmonic`` to all of it.

    Both are root mean squares over each period ``1/f``. ``valid`` is false during the first period, and for an input
    of zero.
    """

    ICON = icons.block("THD")

    f = ac.Parameter(unit="Hz", min=SMALL, doc="base frequency, greater than zero")
    useFirstHarmonic = ac.Option(True, doc="whether the first harmonic is the reference")
    valid = ac.Output(doc="whether the output is valid, 1 or 0")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.harmonic, self.rootMeanSquare = Harmonic(f=self.f, k=1), RootMeanSquare(f=self.f)
        self.greaterThreshold, self.andValid = GreaterThreshold(), And()
        self.limiter = Limiter(uMin=_SMALLEST, uMax=_LARGEST)
        self.pythagoras, self.division = Pythagoras(u1IsHypotenuse=True), Division()
        self.booleanExpression = BooleanExpression(y=not self.useFirstHarmonic)
        self.switch1 = Switch()
        self.connect(self.u, self.rootMeanSquare.u)
        self.connect(self.u, self.harmonic.u)
        self.connect(self.rootMeanSquare.y, self.pythagoras.u1)
        self.connect(self.harmonic.y_rms, self.pythagoras.u2)
        self.connect(self.booleanExpression.y, self.switch1.u2)
        self.connect(self.rootMeanSquare.y, self.switch1.u1)
        self.connect(self.harmonic.y_rms, self.switch1.u3)
        self.connect(self.switch1.y, self.limiter.u)
        self.connect(self.pythagoras.y, self.division.u1)
        self.connect(self.limiter.y, self.division.u2)
        self.connect(self.division.y, self.y)
        self.connect(self.harmonic.y_rms, self.greaterThreshold.u)
        self.connect(self.pythagoras.valid, self.andValid.u1)
        self.connect(self.greaterThreshold.y, self.andValid.u2)
        self.connect(self.andValid.y, self.valid)
