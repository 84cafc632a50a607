"""The flange of translational mechanics.

Along one axis of movement: a positive position, speed or force points in its positive direction. A
flange's force ``f`` is positive where it pushes the component that way.
"""

import acausal as ac

__modelica__ = "Modelica.Mechanics.Translational.Interfaces"


class Flange(ac.Connector):
    """Position ``s`` [m] and cut force ``f`` [N], positive into the component."""

    s = ac.Potential(unit="m", doc="absolute position of the flange")
    f = ac.Flow(unit="N", doc="cut force in the flange")

    pair = ("flange_a", "flange_b")
    across = "s_rel"
    through = "f"
    rate = "v_rel"
    second_minus_first = True
    COLOR = "#3f9b57"


Flange_a = Flange
Flange_b = Flange
Support = Flange
