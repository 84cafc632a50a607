"""Wires end at the strokes of a picture, not at the edge of its box."""

import pytest

import acausal as ac
from acausal.components import electrical as el, icons, rotational as rot, thermal as th
from acausal.drawing.reach import reach
from acausal.drawing.svg import _turn, to_pin


@pytest.mark.parametrize(
    ("icon", "start", "way", "length"),
    [
        (icons.MASS, (-30, 0), (1, 0), 10.0),
        (icons.RESISTOR, (0, 16), (0, -1), 9.0),
        (icons.PLANETARY, (30, 0), (-1, 0), 10.0),
        (icons.SENSOR, (0, -16), (0, 1), 2.0),
        (icons.SENSOR, (14, 0), (-1, 0), 0.0),
        (icons.IDLE, (0, -16), (0, 1), None),
        (icons.CONVECTION, (0, -16), (0, 1), 9.0),
    ],
)
def test_how_far_it_is_to_the_strokes(icon, start, way, length) -> None:
    found = reach(icon.strokes, start, way)
    assert found is None if length is None else found == pytest.approx(length, abs=0.7)


class Wired(ac.Component):
    """Ports beside the middle of a picture, below and above it, and of a turned one."""

    def __init__(self) -> None:
        super().__init__()
        self.gear, self.torque = rot.IdealPlanetary(ratio=2.0), rot.Torque()
        self.ring, self.carrier = rot.Inertia(J=1.0), rot.Inertia(J=1.0)
        self.source, self.load = el.SineVoltage(V=1.0, f=50.0), el.Resistor(R=1.0, useHeatPort=True)
        self.other, self.ground = el.Resistor(R=2.0), el.Ground()
        self.meter, self.store = el.VoltageSensor(), th.HeatCapacitor(C=1.0)
        self.connect(self.torque.flange, self.gear.sun)
        self.connect(self.gear.ring, self.ring.flange_a)
        self.connect(self.gear.carrier, self.carrier.flange_a)
        self.connect(self.source.p, self.load.p, self.meter.p)
        self.connect(self.load.n, self.other.p)
        self.connect(self.other.n, self.source.n, self.meter.n, self.ground.p)
        self.connect(self.load.heatPort, self.store.port)
        self.connect(self.meter.v, self.torque.tau)


def test_no_wire_ends_in_the_air() -> None:
    pytest.importorskip("graphlay")
    drawing = ac.diagram(Wired())
    for placed in drawing.placed.boxes:
        icon, (a, b, c, d) = placed.box.icon, _turn(placed)[1]
        for number in placed.ports if not icon.frame else ():
            x, y = to_pin(placed, number)[-1]
            p, q = x - placed.icon.x, y - placed.icon.y
            start = a * p + c * q, b * p + d * q
            ways = ((1, 0), (-1, 0), (0, 1), (0, -1))
            found = [reach(icon.strokes + icon.fills, start, way) for way in ways]
            assert any(length is not None for length in found), (placed.box.path, number)
