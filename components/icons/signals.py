"""Pictures of sensors, networks and signal blocks."""

from dataclasses import replace
from itertools import pairwise

import acausal as ac

from .shapes import ROUND, block, element

SENSOR = ac.Icon(ROUND + "M0 6L7 -8M-9 -6L-7 -4M0 -11V-8M9 -6L7 -4", size=(28.0, 28.0))
SENSOR2 = element(ROUND + "M0 6L7 -8M-9 -6L-7 -4M0 -11V-8")


def meter(text: str) -> ac.Icon:
    """A sensor at one end, with the sign of what it measures."""
    return replace(SENSOR, strokes=ROUND, text=text)


SEVERAL = {"i": -0.35, "w": -0.35, "f": -0.35, "power": 0.0, "v": 0.35, "tau": 0.35}
"""Where signals of a sensor of several quantities leave it."""


def meter2(text: str) -> ac.Icon:
    """A sensor between two ends."""
    return replace(SENSOR2, strokes=ROUND, text=text)


def meters(text: str) -> ac.Icon:
    """A sensor of several quantities."""
    return replace(meter2(text), places=SEVERAL)


def network(mark: str = "") -> ac.Icon:
    """A small network; a mark is beside it."""
    x = -3.5 * len(mark)
    layers = ((x - 13, (-6, 6)), (x, (-10, 0, 10)), (x + 13, (0,)))
    lines = [
        f"M{a:g} {u}L{b:g} {v}"
        for (a, first), (b, second) in pairwise(layers)
        for u in first
        for v in second
    ]
    dots = [
        f"M{a - 2.5:g} {u}a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0" for a, us in layers for u in us
    ]
    width = 46.0 + 7 * len(mark)
    return ac.Icon("".join(lines), "".join(dots), size=(width, 32.0), frame=True, mark=mark)


NEURAL = network()


FAN_OUT = block("", "M-14 0H-2M-2 -10V10M-2 -10H14M-2 0H14M-2 10H14")
FAN_IN = block("", "M14 0H2M2 -10V10M2 -10H-14M2 0H-14M2 10H-14")
NOISE = block(
    "", "M-15 11V-12M-15 11H16M-14 2L-11 -6L-8 4L-5 -9L-2 6L1 -3L4 3L7 -8L10 5L13 -2", source=True
)
CROSSING = block("", "M-16 0H16M-14 9C-6 9 6 -9 14 -9M-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0")
GAIN = ac.Icon("M-20 -17L22 0L-20 17Z", text="k", size=(44.0, 36.0))
FEEDBACK = ac.Icon(
    "M-11 0a11 11 0 1 0 22 0a11 11 0 1 0 -22 0M-6 0H6M0 -6V6M5 15H11",
    size=(24.0, 24.0),
    sides={"u2": "bottom"},
)
ADD = block("+")
SUM = block("Σ")
PRODUCT = block("×")
DIVISION = block("÷")
INTEGRATOR = block("1/s")
DERIVATIVE = block("s")
LAG = block("", "M-15 11V-12M-15 11H16M-15 11C-8 -6 0 -8 15 -8")
OSCILLATION = block("", "M-15 11V-12M-15 11H16M-15 11C-9 -22 -5 -16 -1 -6S6 -8 15 -6")
TRANSFER = block("b(s)/a(s)")
STATE_SPACE = block("A,B,C,D")
PI = block("PI")
PID = block("PID")
LOOKUP = block("", "M-14 -11H14V11H-14ZM-14 -4H14M-14 4H14M-4 -11V11M5 -11V11")
LIMITER = block("", "M-16 0H16M0 -13V13M-15 9H-8L8 -9H15")
S_LIMITER = block("", "M-16 0H16M0 -13V13M-15 9H-9C-2 9 2 -9 9 -9H15")
DEAD_ZONE = block("", "M-16 0H16M0 -13V13M-15 10L-6 0H6L15 -10")
HYSTERESIS = block("", "M-15 10H6V-10M15 -10H-6V10")
SWITCHED = block("", "M-22 -9H-9L9 0H22M-22 9H-9")
DELAY = block("z⁻¹")
SAMPLER = block("", "M-20 0H-9L8 -9M9 0H20M-2 -10A14 14 0 0 1 6 2")
LINEAR_HOLD = block("", "M-15 9L-6 2L3 4L15 -9M-15 9V5M-6 2V-2M3 4V0")
HOLD = block("", "M-15 9H-8V3H0V-4H8V-10H15")
CONSTANT = block("", "M-15 11V-12M-15 11H16M-15 -4H15", source=True)
STEP = block("", "M-15 11V-12M-15 11H16M-15 8H-2V-8H15", source=True)
RAMP = block("", "M-15 11V-12M-15 11H16M-15 8H-8L6 -8H15", source=True)
LIGHTNING = block("", "M-15 11V-12M-15 11H16M-15 8L-12 -10C-8 -2 -2 6 15 8", source=True)
DOUBLE_RAMP = block("", "M-15 11V-12M-15 11H16M-15 -8H-9L-4 8H3L8 -8H15", source=True)
COSINE = block("", "M-16 0H16M-15 -10C-10 -10 -5 10 0 10S10 -10 15 -10", source=True)
DAMPED = block("", "M-16 0H16M-15 0C-12 -18 -8 -18 -5 0S1 11 5 0S11 -6 15 0", source=True)
SINC = block(
    "", "M-16 5H16M-16 6C-12 1 -10 10 -7 7C-4 2 -4 -11 0 -11S4 2 7 7C10 10 12 1 16 6", source=True
)
CHIRP = block(
    "", "M-16 0H16M-15 0C-11 -15 -7 -15 -3 0S2 12 4 0S7 -10 8 0S11 9 12 0S14 -7 15 0", source=True
)
DECAY = block("", "M-15 11V-12M-15 11H16M-15 8C-11 -12 -4 -10 -2 -10C0 4 6 8 15 8", source=True)
SAMPLES = block("", "M-15 11V-12M-15 11H16M-11 11V2M-5 11V-6M1 11V-2M7 11V5M13 11V-3", source=True)
SPIKES = block("", "M-15 9H-9V-9M-9 9H1V-9M1 9H11V-9M11 9H15", source=True)
POINT_TO_POINT = block("", "M-15 11V-12M-15 11H16M-15 3H-10V-8H-2V3H4V11H12V3H15", source=True)
S_CURVE = block("", "M-15 11V-12M-15 11H16M-15 8C-2 8 -2 -8 13 -8", source=True)
LOW_PASS = block("", "M-15 11V-12M-15 11H16M-15 -6H0C6 -6 8 0 13 9")
SLEW = block("", "M-16 0H16M0 -13V13M-12 10L12 -10M-12 -10H-7M7 10H12")
SINE = block("", "M-16 0H16M-15 0C-10 -16 -5 -16 0 0S10 16 15 0", source=True)
PULSE = block("", "M-15 11V-12M-15 11H16M-15 8H-10V-8H-3V8H4V-8H11V8H15", source=True)
SAWTOOTH = block("", "M-15 11V-12M-15 11H16M-15 8L-4 -8V8L7 -8V8L15 -3", source=True)
TRAPEZOID = block("", "M-15 11V-12M-15 11H16M-15 8H-11L-6 -8H3L8 8H15", source=True)
TABLE = block("", "M-14 -11H14V11H-14ZM-14 -4H14M-14 4H14M-4 -11V11M5 -11V11", source=True)
CLOCK = block("", "M-11 0a11 11 0 1 0 22 0a11 11 0 1 0 -22 0M0 -7V0L5 4", source=True)
EXPRESSION = block("f(t)", source=True)
