"""Laws of flow: the root of a pressure drop that is smooth at zero, and the friction at a wall."""

from typing import Any

import acausal as ac

LAMINAR, TURBULENT = 2000.0, 4000.0
"""Reynolds numbers between which the friction factor changes from one law to the other."""


def signed_root(dp: Any, dp_small: Any) -> Any:
    """``sqrt(|dp|) sign(dp)``, as ``dp/(dp**2 + dp_small**2)**(1/4)`` with a finite derivative at zero."""
    return dp / (dp**2 + dp_small**2) ** 0.25


def wall_friction(velocity: Any, length: Any, diameter: Any, rho: Any, mu: Any, rough: Any) -> Any:
    """Pressure drop in a pipe (Darcy and Weisbach): ``(f Re) mu length velocity/(2 diameter**2)``.

    ``f Re = 64`` where it is laminar; where it is turbulent, ``f`` is Haaland's (1983), with the roughness ``rough``.
    """
    reynolds = rho * ac.Abs(velocity) * diameter / mu
    fast = ac.maximum(reynolds, LAMINAR)
    haaland = (-1.8 * ac.log((rough / diameter / 3.7) ** 1.11 + 6.9 / fast) / ac.log(10)) ** -2
    share = ac.minimum((fast - LAMINAR) / (TURBULENT - LAMINAR), 1)
    factor = 64 + share * (haaland * fast - 64)
    return factor * mu * length * velocity / (2 * diameter**2)
