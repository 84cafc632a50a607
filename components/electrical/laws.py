"""Laws that several elements share: contacts, and exponentials that never overflow."""

from typing import Any

import acausal as ac

TRUE = 0.5
"""A signal that stands for a truth value is true above this."""


def contact(open_: Any, v: Any, i: Any, Ron: Any, Goff: Any) -> ac.Eq:
    """A contact: ``i = Goff v`` while open, ``v = Ron i`` while closed. ``Ron`` or ``Goff`` may be 0.

    Steps end where it opens or closes.
    """
    return ac.Eq(
        v * ac.where(open_, Goff, 1, events=True), i * ac.where(open_, 1, Ron, events=True)
    )


def exlin(x: Any, high: Any) -> Any:
    """The exponential function, continued linearly above ``high``."""
    return ac.exp(ac.minimum(x, high)) * (1 + ac.maximum(x - high, 0))


def exlin2(x: Any, low: Any, high: Any) -> Any:
    """The exponential function, continued linearly below ``low`` and above ``high``."""
    inside = ac.maximum(ac.minimum(x, high), low)
    return ac.exp(inside) * (1 + x - inside)
