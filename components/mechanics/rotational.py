"""The flange of rotational mechanics.

Along one axis of rotation: a positive angle, speed or torque points in its direction. A flange's
torque ``tau`` is positive where it turns the component that way.
"""

import acausal as ac

__modelica__ = "Modelica.Mechanics.Rotational.Interfaces"


class Flange(ac.Connector):
    """Angle ``phi`` [rad] and cut torque ``tau`` [N.m], positive into the component."""

    phi = ac.Potential(unit="rad", doc="absolute angle of the flange")
    tau = ac.Flow(unit="N.m", doc="cut torque in the flange")

    pair = ("flange_a", "flange_b")
    across = "phi_rel"
    through = "tau"
    rate = "w_rel"
    second_minus_first = True
    COLOR = "#7d8590"


Flange_a = Flange
Flange_b = Flange
Support = Flange
