"""Constitutive laws that several domains share: friction, contact, brakes and tables of points."""

import itertools
from collections.abc import Sequence
from typing import Any, Literal

import acausal as ac

Regularization = Literal["Exp", "Sine", "Linear", "CoSine"]
REGULARIZATION: tuple[Regularization, ...] = ("Exp", "Sine", "Linear", "CoSine")

Smoothness = Literal["LinearSegments", "ConstantSegments"]
SMOOTHNESS: tuple[Smoothness, ...] = ("LinearSegments", "ConstantSegments")


def regularized_sign(v: Any, v0: Any, kind: Regularization) -> Any:
    """The sign of a speed ``v``, made continuous for ``|v| < v0``.

    ``Exp``: ``2/(1 + exp(-v/(0.01 v0))) - 1``, computed as the equal ``tanh(v/(0.02 v0))``;
    ``Sine``: ``sin(pi/2 v/v0)``; ``Linear``: ``v/v0``; ``CoSine``: ``sign(v) (1 - cos(pi/2 v/v0))``.
    """
    if kind == "Exp":
        return ac.tanh(v / (0.02 * v0))
    r = ac.maximum(ac.minimum(v / v0, 1), -1)
    if kind == "Sine":
        return ac.sin(ac.pi / 2 * r)
    if kind == "Linear":
        return r
    return ac.where(v < 0, -1, 1) * (1 - ac.cos(ac.pi / 2 * r))


def coulomb(v: Any, sliding: Any, excess: Any, v_small: Any) -> Any:
    """Smooth Coulomb friction: the force against a speed ``v``.

    ``sliding tanh(v/v_small) + excess r exp((1 - r**2)/2)`` with ``r = v/(3 v_small)``. The second
    term makes the force peak by ``excess`` at ``|v| = 3 v_small``. There is no locked state: under a
    load below the peak the contact creeps with a speed of the order of ``v_small``.

    Arguments:
        v: relative speed.
        sliding: force while sliding, as a function of ``|v|``.
        excess: how much the static force exceeds the sliding force at rest.
        v_small: speed at which 76 % of the sliding force are reached.
    """
    r = v / (3 * v_small)
    return sliding * ac.tanh(v / v_small) + excess * r * ac.exp((1 - r**2) / 2)


def contact(depth: Any, rate: Any, c: Any, d: Any, n: Any = 1) -> tuple[Any, Any]:
    """Elastic and damping force between two bodies that may lift off; both push, none pulls.

    ``f_c = c max(depth, 0)**n`` and ``f_d = d rate``, bounded to ``|f_d| <= f_c``: so the total is
    never negative and continuous at touch-down.

    Arguments:
        depth: how deep the bodies penetrate; negative where they are apart.
        rate: its derivative.
        c: stiffness.
        d: damping.
        n: exponent of the stiffness.
    """
    f_c = c * ac.maximum(depth, 0) ** n
    return f_c, bounded(d * rate, f_c)


def impact(depth: Any, rate: Any, c: Any, d: Any) -> Any:
    """Force of a stop that absorbs: ``c depth (1 + d rate)``, never pulling (Hunt and Crossley, 1975).

    The force begins at zero, and what was stopped leaves with at most ``1/d``.

    Arguments:
        depth: how deep the body penetrates the stop; negative where it is apart.
        rate: its derivative.
        c: stiffness.
        d: damping, the inverse of a speed.
    """
    return c * ac.maximum(depth, 0) * ac.maximum(1 + d * rate, 0)


def bounded(value: Any, limit: Any) -> Any:
    """``value`` between ``-limit`` and ``limit``."""
    return ac.maximum(ac.minimum(value, limit), -limit)


def inverse(v: Any, v_nominal: Any, v0: Any, *, one_way: bool) -> Any:
    """``v_nominal/|v|``, constant for ``|v| < v0``.

    Not ``one_way``, with the sign of ``v``: ``v_nominal/v``, and ``v/v0`` for ``|v| < v0``.
    """
    bounded = v_nominal / ac.maximum(ac.Abs(v), v0)
    if one_way:
        return bounded
    return ac.where(ac.Abs(v) < v0, v / v0, bounded * ac.where(v < 0, -1, 1))


def eddy_current(r: Any) -> Any:
    """Force of an eddy current brake over its greatest (Kloss): ``2 r/(1 + r**2)``.

    ``r`` is the speed over that of the greatest force.
    """
    return 2 * r / (1 + r**2)


def temperature_factor(T: Any, T_ref: Any, alpha20: Any) -> Any:
    """Resistance at ``T`` over that at ``T_ref``: ``1 + alpha (T - T_ref)``.

    ``alpha = alpha20/(1 + alpha20 (T_ref - 293.15))`` follows from the coefficient ``alpha20`` [1/K]
    at 20 degC.
    """
    return 1 + alpha20 / (1 + alpha20 * (T_ref - 293.15)) * (T - T_ref)


def lookup(x: Any, points: Sequence[Sequence[Any]], smoothness: Smoothness) -> Any:
    """Interpolate in rows ``(x_i, y_i)`` with ascending ``x_i``; a single row is a constant.

    ``LinearSegments`` continue beyond both ends, ``ConstantSegments`` take the row to the left.
    """
    if len(points) == 1:
        return points[0][1]
    if smoothness == "ConstantSegments":
        value = points[-1][1]
        for (_, y), (x_next, _) in zip(points[-2::-1], points[:0:-1], strict=True):
            value = ac.where(x < x_next, y, value)
        return value
    value = points[0][1]
    for i, ((x0, y0), (x1, y1)) in enumerate(itertools.pairwise(points)):
        within = x if i == 0 else ac.maximum(x, x0)
        within = within if i == len(points) - 2 else ac.minimum(within, x1)
        value += (y1 - y0) / (x1 - x0) * (within - x0)
    return value


def friction_over_speed(speed: Any, points: Sequence[Sequence[Any]], smoothness: Smoothness) -> Any:
    """Friction from a table: where one that falls ends, it goes on to zero, and does not drive."""
    found = lookup(speed, points, smoothness)
    return found if len(points) == 1 else ac.maximum(found, 0)
