"""Continuous blocks with states; integrators, controllers, filters come from their own modules."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

import acausal as ac
from acausal.components import icons

from .canonical import canonical_form, dot
from .conventions import INIT
from .interfaces import MIMO, SISO, PartialStart

__modelica__ = "Modelica.Blocks.Continuous"


class FirstOrder(SISO, PartialStart):
    """Lag ``k/(T s + 1)``: ``der(y) = (k u - y)/T``."""

    ICON = icons.LAG

    k = ac.Parameter(1.0, doc="gain")
    T = ac.Parameter(unit="s", doc="time constant")
    y = ac.Output(start="y_start", doc="output signal")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.y), (self.k * self.u - self.y) / self.T)


class SecondOrder(SISO, PartialStart):
    """``k/((s/w)**2 + 2 D s/w + 1)``: ``der(y) = yd``, ``der(yd) = w (w (k u - y) - 2 D yd)``."""

    ICON = icons.OSCILLATION

    k = ac.Parameter(1.0, doc="gain")
    w = ac.Parameter(unit="rad/s", doc="angular frequency")
    D = ac.Parameter(doc="damping")
    yd_start = ac.Parameter(0.0, doc="initial or guess value of the output's derivative")
    y = ac.Output(start="y_start", doc="output signal")
    yd = ac.Variable(start="yd_start", doc="derivative of the output")

    def equations(self) -> Iterator[ac.Eq]:
        yield ac.Eq(ac.der(self.y), self.yd)
        pull = self.w * (self.k * self.u - self.y) - 2 * self.D * self.yd
        yield ac.Eq(ac.der(self.yd), self.w * pull)

    def initial_equations(self) -> Iterator[ac.Eq]:
        yield from super().initial_equations()
        if self.initType == "SteadyState":
            yield ac.Eq(ac.der(self.yd), 0)
        elif self.initType != "NoInit":
            yield ac.Eq(self.yd, self.yd_start)


def _unless_negligible(a: Sequence[Any]) -> Any:
    small = 100 * np.finfo(float).eps * ac.sqrt(dot(a, a))
    return ac.where(a[-1] > small, a[-1], 1)


class TransferFunction(SISO):
    """``(b[1] s**m + ... + b[m+1])/(a[1] s**n + ... + a[n+1])`` with ``m <= n``.

    In controller canonical form: ``a[1] der(x[1]) = u - a[2] x[1] - ... - a[n+1] x[n]``,
    ``der(x[i]) = x[i-1]``. ``x_scaled`` is ``a_end x``.
    """

    ICON = icons.TRANSFER

    b = ac.Parameter([1.0], shape=":", doc="numerator, highest power first")
    a = ac.Parameter([1.0], shape=":", doc="denominator, highest power first")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    x_start = ac.Parameter(0.0, shape="nx", doc="initial or guess values of the states")
    y_start = ac.Parameter(0.0, doc="initial value of the output")
    a_end = ac.Parameter(
        lambda self: _unless_negligible(self.a),
        doc="last coefficient of a, or 1 where it is next to nothing",
    )
    x = ac.Variable(shape="nx", start="x_start", doc="states in controller canonical form")
    x_scaled = ac.Variable(shape="nx", doc="states times the last coefficient of a")

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.a) - 1

    def equations(self) -> Iterator[ac.Eq]:
        if len(self.b) > len(self.a):
            raise ac.DeclarationError(
                f"TransferFunction: the numerator has {len(self.b)} coefficients, the denominator "
                f"{len(self.a)}; it must not have fewer"
            )
        yield from canonical_form(self.u, self.y, self.x, self.b, self.a)
        for x, scaled in zip(self.x, self.x_scaled, strict=True):
            yield ac.Eq(scaled, self.a_end * x)

    def initial_equations(self) -> Iterator[ac.Eq]:
        match self.initType:
            case "SteadyState":
                yield from (ac.Eq(ac.der(x), 0) for x in self.x)
            case "InitialState":
                yield from (ac.Eq(x, s) for x, s in zip(self.x, self.x_start, strict=True))
            case "InitialOutput":
                yield ac.Eq(self.y, self.y_start)
                yield from (ac.Eq(ac.der(x), 0) for x in self.x[1:])
            case _:
                pass


class StateSpace(MIMO):
    """``der(x) = A x + B u``, ``y = C x + D u`` with matrices; ``D`` is zero by default.

    ``initType``: ``NoInit``, ``SteadyState``, ``InitialState``, or ``InitialOutput``: ``y`` starts at ``y_start`` where
    ``|der(x)|`` is least. The condition of that is ``A' der(x) + C' multiplier = 0``; the multipliers are constant.
    """

    ICON = icons.STATE_SPACE

    A = ac.Parameter(shape=(":", ":"), doc="state matrix")
    B = ac.Parameter(shape=(":", ":"), doc="input matrix")
    C = ac.Parameter(shape=(":", ":"), doc="output matrix")
    D = ac.Parameter(0.0, shape=("nout", "nin"), doc="feedthrough matrix")
    initType = ac.Option("NoInit", choices=INIT, doc="type of initialization")
    x_start = ac.Parameter(0.0, shape="nx", doc="initial or guess values of the states")
    y_start = ac.Parameter(0.0, shape="nout", doc="initial values of the outputs")
    x = ac.Variable(shape="nx", start="x_start", doc="states")
    multiplier = ac.Variable(
        shape="nout", when="_starts_by_output", doc="of the conditions on the outputs at the start"
    )

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

    def equations(self) -> Iterator[ac.Eq]:
        for x, a, b in zip(self.x, self.A, self.B, strict=True):
            yield ac.Eq(ac.der(x), dot(a, self.x) + dot(b, self.u))
        for y, c, d in zip(self.y, self.C, self.D, strict=True):
            yield ac.Eq(y, dot(c, self.x) + dot(d, self.u))
        if self._starts_by_output:
            yield from (ac.Eq(ac.der(m), 0) for m in self.multiplier)

    @property
    def _starts_by_output(self) -> bool:
        return self.initType == "InitialOutput"

    def initial_equations(self) -> Iterator[ac.Eq]:
        if self.initType == "SteadyState":
            yield from (ac.Eq(ac.der(x), 0) for x in self.x)
        elif self.initType == "InitialState":
            yield from (ac.Eq(x, s) for x, s in zip(self.x, self.x_start, strict=True))
        elif self._starts_by_output:
            yield from (ac.Eq(y, s) for y, s in zip(self.y, self.y_start, strict=True))
            rates = [ac.der(x) for x in self.x]
            for a, c in zip(zip(*self.A, strict=True), zip(*self.C, strict=True), strict=True):
                yield ac.Eq(dot(a, rates) + dot(c, self.multiplier), 0)
