"""The law of friction that wheels share: it rises to adhesion, and falls to sliding."""

from typing import Any

import acausal as ac

__modelica__ = None


def s_form(x: Any, x_min: Any, x_max: Any, y_min: Any, y_max: Any) -> Any:
    """A smooth transition from ``y_min`` at ``x_min`` to ``y_max`` at ``x_max``, constant beyond: a cubic."""
    u = (2 * x - x_max - x_min) / (x_max - x_min)
    u = ac.maximum(ac.minimum(u, 1), -1)
    return (y_max + y_min) / 2 + (y_max - y_min) / 2 * (3 * u - u**3) / 2


def striple(x: Any, x_max: Any, x_sat: Any, y_max: Any, y_sat: Any) -> Any:
    """Three such transitions, an odd function: it is ``y_max`` at ``x_max``, and ``y_sat`` from ``x_sat`` on."""
    fall = y_sat - y_max
    rise = s_form(x, -x_max, x_max, -y_max, y_max)
    return rise + s_form(x, x_max, x_sat, 0, fall) - s_form(-x, x_max, x_sat, 0, fall)
