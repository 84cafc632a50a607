"""Mathematical blocks: each output is a function of the inputs at the same time."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

import acausal as ac
from acausal.components import icons

from .conventions import truth
from .interfaces import MIMO, MISO, SI2SO, SISO, SO, Switching

__modelica__ = "Modelica.Blocks.Math"


class InverseBlockConstraints(ac.Component):
    """Sets two signals equal, to invert a block between them: ``u1 = u2``, ``y1 = y2``."""

    ICON = icons.block("inverse")

    u1 = ac.Input(doc="input signal 1")
    u2 = ac.Input(doc="input signal 2, equal to u1")
    y1 = ac.Output(doc="output signal 1")
    y2 = ac.Output(doc="output signal 2, equal to y1")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.u1, self.u2)
        yield ac.Eq(self.y1, self.y2)


class Gain(SISO):
    """``y = k u``."""

    ICON = icons.GAIN

    k = ac.Parameter(doc="gain")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.k * self.u)


class MatrixGain(MIMO):
    """``y = K u`` with a matrix ``K``."""

    ICON = replace(icons.GAIN, text="K")

    K = ac.Parameter([[1.0, 0.0], [0.0, 1.0]], shape=(":", ":"), doc="gain matrix")

    @property
    def nin(self) -> int:
        """Number of inputs: columns of ``K``."""
        return len(self.K[0])

    @property
    def nout(self) -> int:
        """Number of outputs: rows of ``K``."""
        return len(self.K)

    def equations(self) -> Iterator[ac.Eq]:
        for y, row in zip(self.y, self.K, strict=True):
            yield ac.Eq(y, sum(k * u for k, u in zip(row, self.u, strict=True)))


class MultiSum(SO):
    """``y = k[1] u[1] + ... + k[nu] u[nu]``."""

    ICON = icons.marked(icons.SUM, "n")

    nu = ac.Option(0, doc="number of inputs")
    k = ac.Parameter(1.0, shape="nu", doc="gains")
    u = ac.Input(shape="nu", doc="input signals")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, sum(k * u for k, u in zip(self.k, self.u, strict=True)))


class MultiProduct(SO):
    """``y = u[1] ... u[nu]``; 0 without inputs."""

    ICON = icons.marked(icons.PRODUCT, "n")

    nu = ac.Option(0, doc="number of inputs")
    u = ac.Input(shape="nu", doc="input signals")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, np.prod(self.u) if len(self.u) else 0)


class Sum(MISO):
    """``y = k[1] u[1] + ... + k[nin] u[nin]``."""

    ICON = icons.SUM

    k = ac.Parameter(1.0, shape="nin", doc="gains")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, sum(k * u for k, u in zip(self.k, self.u, strict=True)))


class Feedback(SI2SO):
    """``y = u1 - u2``."""

    ICON = icons.FEEDBACK

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.u1 - self.u2)


class Add(SI2SO):
    """``y = k1 u1 + k2 u2``."""

    ICON = icons.ADD

    k1 = ac.Parameter(1.0, doc="gain of u1")
    k2 = ac.Parameter(1.0, doc="gain of u2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.k1 * self.u1 + self.k2 * self.u2)


class Add3(SI2SO):
    """``y = k1 u1 + k2 u2 + k3 u3``."""

    ICON = icons.marked(icons.ADD, "3")

    k1 = ac.Parameter(1.0, doc="gain of u1")
    k2 = ac.Parameter(1.0, doc="gain of u2")
    k3 = ac.Parameter(1.0, doc="gain of u3")
    u3 = ac.Input(doc="third input signal")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.k1 * self.u1 + self.k2 * self.u2 + self.k3 * self.u3)


class LinearDependency(SI2SO):
    """``y = y0 + k1 u1 + k2 u2``."""

    ICON = icons.block("a + bu")

    y0 = ac.Parameter(0.0, doc="constant")
    k1 = ac.Parameter(0.0, doc="gain of u1")
    k2 = ac.Parameter(0.0, doc="gain of u2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.y0 + self.k1 * self.u1 + self.k2 * self.u2)


class Product(SI2SO):
    """``y = u1 u2``."""

    ICON = icons.PRODUCT

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.u1 * self.u2)


class Division(SI2SO):
    """``y = u1/u2``."""

    ICON = icons.DIVISION

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, self.u1 / self.u2)


class Polynomial(SISO):
    """``y = c[1] u**n + ... + c[n] u + c[n+1]``: coefficients from the highest power down."""

    ICON = icons.block("p(u)")

    __modelica__ = None

    c = ac.Parameter(shape=":", doc="coefficients, highest power first")

    def equations(self) -> Iterator[ac.Eq]:
        value: Any = 0
        for c in self.c:
            value = value * self.u + c
        yield ac.Eq(self.y, value)


class MultiSwitch(Switching):
    """The value in ``expr`` that belongs to the first input that is true, else ``y_default``."""

    ICON = icons.marked(icons.SWITCHED, "n")

    y_default = ac.Parameter(0.0, doc="output where no input is true")
    precision = ac.Option(3, doc="without effect")
    y = ac.Output(doc="output signal")

    def equations(self) -> Iterator[Any]:
        yield from super().equations()
        yield ac.Eq(self.y, self._chosen(self.y_default))


class _Function(SISO):
    """``y = function(u)``."""

    function: ClassVar[Callable[[Any], Any]]

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, type(self).function(self.u))


class Abs(_Function):
    """``y = |u|``; ``generateEvent`` has no effect."""

    ICON = icons.block("abs")

    generateEvent = ac.Option(False, doc="without effect")
    function = staticmethod(ac.Abs)


class Sign(_Function):
    """``y = sign(u)``; ``generateEvent`` has no effect."""

    ICON = icons.block("sign")

    generateEvent = ac.Option(False, doc="without effect")
    function = staticmethod(ac.sign)


class Sqrt(_Function):
    """``y = sqrt(u)``, ``u >= 0``."""

    ICON = icons.block("√")

    function = staticmethod(ac.sqrt)


class Sin(_Function):
    """``y = sin(u)``."""

    ICON = icons.block("sin")

    function = staticmethod(ac.sin)


class Cos(_Function):
    """``y = cos(u)``."""

    ICON = icons.block("cos")

    function = staticmethod(ac.cos)


class Tan(_Function):
    """``y = tan(u)``."""

    ICON = icons.block("tan")

    function = staticmethod(ac.tan)


class Asin(_Function):
    """``y = asin(u)``, ``-1 <= u <= 1``."""

    ICON = icons.block("asin")

    function = staticmethod(ac.asin)


class Acos(_Function):
    """``y = acos(u)``, ``-1 <= u <= 1``."""

    ICON = icons.block("acos")

    function = staticmethod(ac.acos)


class Atan(_Function):
    """``y = atan(u)``."""

    ICON = icons.block("atan")

    function = staticmethod(ac.atan)


class Atan2(SI2SO):
    """``y = atan2(u1, u2)``: the angle whose tangent is ``u1/u2``, in the right quadrant."""

    ICON = icons.block("atan2")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.atan2(self.u1, self.u2))


class Sinh(_Function):
    """``y = sinh(u)``."""

    ICON = icons.block("sinh")

    function = staticmethod(ac.sinh)


class Cosh(_Function):
    """``y = cosh(u)``."""

    ICON = icons.block("cosh")

    function = staticmethod(ac.cosh)


class Tanh(_Function):
    """``y = tanh(u)``."""

    ICON = icons.block("tanh")

    function = staticmethod(ac.tanh)


class Exp(_Function):
    """``y = exp(u)``."""

    ICON = icons.block("exp")

    function = staticmethod(ac.exp)


class Log(SISO):
    """``y = log(u)/log(base)``, ``u > 0``: the natural logarithm by default."""

    ICON = icons.block("log")

    base = ac.Parameter(2.718281828459045, min=0, doc="base of the logarithm")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.log(self.u) / ac.log(self.base))


class Log10(SISO):
    """``y = log10(u)``, ``u > 0``."""

    ICON = icons.block("log10")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.log(self.u) / ac.log(10.0))


class Power(SISO):
    """``y = base**u``, computed as ``exp(u log(base))``; ``useExp`` has no effect."""

    ICON = icons.block("bᵘ")

    base = ac.Parameter(2.718281828459045, min=0, doc="base of the power")
    useExp = ac.Option(True, doc="without effect")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.exp(self.u * ac.log(self.base)))


class Exponentiation(SISO):
    """``y = u**exponent``; ``u > 0`` unless the exponent is a whole number."""

    ICON = icons.block("uⁿ")

    exponent = ac.Option(2, doc="exponent")

    def equations(self) -> Iterator[ac.Eq]:
        whole = float(self.exponent).is_integer()
        yield ac.Eq(self.y, self.u ** (int(self.exponent) if whole else self.exponent))


class WrapAngle(SISO):
    """The angle ``u`` [rad] in ``]-pi, pi]``, or in ``[0, 2 pi[`` with ``positiveRange``."""

    ICON = icons.block("±π")

    positiveRange = ac.Option(False, doc="whether to wrap to [0, 2 pi[")
    u = ac.Input(unit="rad", doc="angle")
    y = ac.Output(unit="rad", doc="angle wrapped")

    def equations(self) -> Iterator[ac.Eq]:
        turn = 2 * ac.pi
        turns = (
            ac.floor(self.u / turn) if self.positiveRange else -ac.floor((ac.pi - self.u) / turn)
        )
        yield ac.Eq(self.y, self.u - turn * turns)


class RectangularToPolar(ac.Component):
    """``y_abs = sqrt(u_re**2 + u_im**2)``, ``y_arg = atan2(u_im, u_re)`` [rad]."""

    ICON = icons.block("xy → ∠")

    u_re = ac.Input(doc="real part")
    u_im = ac.Input(doc="imaginary part")
    y_abs = ac.Output(doc="length")
    y_arg = ac.Output(unit="rad", doc="angle")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y_abs, ac.sqrt(self.u_re**2 + self.u_im**2))
        yield ac.Eq(self.y_arg, ac.atan2(self.u_im, self.u_re))


class PolarToRectangular(ac.Component):
    """``y_re = u_abs cos(u_arg)``, ``y_im = u_abs sin(u_arg)``, the angle in rad."""

    ICON = icons.block("∠ → xy")

    u_abs = ac.Input(doc="length")
    u_arg = ac.Input(unit="rad", doc="angle")
    y_re = ac.Output(doc="real part")
    y_im = ac.Output(doc="imaginary part")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y_re, self.u_abs * ac.cos(self.u_arg))
        yield ac.Eq(self.y_im, self.u_abs * ac.sin(self.u_arg))


class Pythagoras(SI2SO):
    """``y = sqrt(u1**2 + u2**2)``; with ``u1IsHypotenuse`` ``sqrt(u1**2 - u2**2)``, 0 if negative."""

    ICON = icons.block("√Σu²")

    u1IsHypotenuse = ac.Option(False, doc="whether u1 is the hypotenuse")
    valid = ac.Output(doc="whether the output is valid, 1 or 0")
    y2 = ac.Variable(doc="square of the output")

    def equations(self) -> Iterator[ac.Eq]:
        if self.u1IsHypotenuse:
            yield ac.Eq(self.y2, self.u1**2 - self.u2**2)
            yield ac.Eq(self.valid, truth(self.y2 >= 0, events=None))
            yield ac.Eq(self.y, ac.sqrt(ac.maximum(self.y2, 0)))
        else:
            yield ac.Eq(self.y2, self.u1**2 + self.u2**2)
            yield ac.Eq(self.valid, 1)
            yield ac.Eq(self.y, ac.sqrt(self.y2))


class Max(SI2SO):
    """``y = max(u1, u2)``."""

    ICON = icons.block("max")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.maximum(self.u1, self.u2))


class Min(SI2SO):
    """``y = min(u1, u2)``."""

    ICON = icons.block("min")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.y, ac.minimum(self.u1, self.u2))


class MinMax(ac.Component):
    """``yMax`` and ``yMin`` are the greatest and the smallest of the ``nu`` inputs ``u``."""

    ICON = icons.block("min max")

    nu = ac.Option(0, doc="number of inputs")
    u = ac.Input(shape="nu", doc="input signals")
    yMax = ac.Output(doc="greatest input")
    yMin = ac.Output(doc="smallest input")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(self.yMax, ac.maximum(*self.u))
        yield ac.Eq(self.yMin, ac.minimum(*self.u))
