"""What blocks share: how a truth value is a number, how a state starts, how short an instant is."""

from typing import Any

import acausal as ac

TRUE = 0.5
"""All signals are real. One that stands for a truth value is true above this: blocks give 1 or 0."""


INIT = ("NoInit", "SteadyState", "InitialState", "InitialOutput")
"""How a block with states starts: the choices of ``initType``, as in `Modelica.Blocks.Types.Init`."""


INSTANT = 1e-15
"""Shortest duration [s]: it stands for a duration of zero in a quotient."""


def truth(condition: Any) -> Any:
    """1 where a condition holds, else 0."""
    return ac.where(condition, 1, 0)
