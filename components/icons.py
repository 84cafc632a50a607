"""The pictures of the library's classes, in a few strokes each; a class states its own as ``ICON``."""

from dataclasses import replace

import acausal as ac

LYING = (60.0, 32.0)
"""Size of an element with two ends."""


def block(text: str = "", strokes: str = "", *, source: bool = False, wide: float = 0.0) -> ac.Icon:
    """A signal block: a frame with a text or a curve."""
    width = max(44.0, 6.6 * len(text) + 14.0, wide)
    return ac.Icon(strokes, text=text, size=(width, 36.0), frame=True, source=source)


def element(strokes: str, text: str = "", *, fills: str = "", source: bool = False) -> ac.Icon:
    """An element with two ends."""
    return ac.Icon(strokes, fills, text, LYING, source=source)


ROUND = "M-14 0a14 14 0 1 0 28 0a14 14 0 1 0 -28 0"
ENDS = "M-30 0H-14M14 0H30"

# -- mechanics -------------------------------------------------------------------------------------

SPRING = element("M-30 0H-18L-15 -9L-9 9L-3 -9L3 9L9 -9L15 9L18 0H30")
DAMPER = element("M-30 0H-2M-2 -7V7M-12 -11H12V11H-12M12 0H30")
SPRING_DAMPER = ac.Icon(
    "M-30 0H-22M-22 -9V10M-22 -9H-14L-11 -15L-6 -3L-1 -15L4 -3L9 -15L12 -9H22"
    "M-22 10H0M0 5V15M-8 3H9V17H-8M9 10H22M22 -9V10M22 0H30",
    size=(60.0, 38.0),
)
GAP = ac.Icon(
    "M-30 0H-22M-22 -9V10M-22 -9H-16L-13 -15L-8 -3L-3 -15L2 -3L5 -9H9M9 -15V-3M14 -15V-3M14 -9H22"
    "M-22 10H0M0 5V15M-8 3H9V17H-8M9 10H22M22 -9V10M22 0H30",
    size=(60.0, 38.0),
)
MASS = element("M-30 0H-20M-20 -13H20V13H-20ZM20 0H30")
INERTIA = element("M-30 0H-9M-9 -15H9V15H-9ZM9 0H30M-9 -9H9M-9 9H9")
ROD = element("M-30 0H30", fills="M-26 -3H26V3H-26Z")
DISC = element("M-30 0H-6M-6 -14V14M6 -14V14M6 0H30M-6 -5H6M-6 5H6")
FIXED = ac.Icon(
    "M-14 0H-2M-2 -13V13M-2 -7L7 -13M-2 0L7 -6M-2 7L7 1M-2 13L7 7",
    size=(28.0, 28.0),
    reference=True,
)
GEAR = element("M-30 0H-9M-9 -8H-1V8H-9ZM-1 -15H8V15H-1ZM8 0H30")
PLANETARY = ac.Icon(
    "M-30 0H-8M-8 -5H8V5H-8ZM-8 -14H8V-7H-8ZM-12 -18H12V-14H-12ZM-8 7H8V14H-8ZM-12 14H12V18H-12Z",
    size=(60.0, 40.0),
)
BACKLASH = element("M-30 0H-22V-11H-14V4H-8V-11H4V4H10V-11M30 0H22V11H1V-4H-5V11H-14")
CLUTCH = element(
    "M-30 0H-4M-4 -13V13M4 -13V13M4 0H30", fills="M-11 -18L-4 -15L-11 -12ZM11 -18L4 -15L11 -12Z"
)
BRAKE = element("M-30 0H30M-4 -13H4V-3H-4ZM-4 3H4V13H-4ZM-14 -13H14M-14 13H14")
FRICTION = element(
    "M-30 0H30M-14 -8H14M-14 8H14"
    "M-14 -8L-10 -13M-6 -8L-2 -13M2 -8L6 -13M10 -8L14 -13M-14 13L-10 8M-6 13L-2 8M2 13L6 8M10 13L14 8"
)
REVOLUTE = ac.Icon(
    "M-30 0H-12M12 0H30M-12 0A12 12 0 1 0 12 0A12 12 0 1 0 -12 0M-4 0A4 4 0 1 0 4 0A4 4 0 1 0 -4 0",
    sides={"flange_a": "top", "support": "bottom"},
)
PRISMATIC = ac.Icon("M-30 0H30M-14 -12H14V12H-14Z", sides={"flange_a": "top", "support": "bottom"})
ROLLING = element("M-30 0H-12M-12 0a12 12 0 1 0 24 0a12 12 0 1 0 -24 0M-20 12H30M30 12V0")
VEHICLE = ac.Icon(
    "M-26 8V-2L-18 -4L-12 -13H10L18 -4L26 -2V8Z"
    "M-17 10a6 6 0 1 0 12 0a6 6 0 1 0 -12 0M7 10a6 6 0 1 0 12 0a6 6 0 1 0 -12 0",
    size=(60.0, 36.0),
)
FORCE = ac.Icon("M-20 0H14", "M22 0L10 -6V6Z", size=(48.0, 28.0), source=True)
FORCE2 = element("M-30 0H-22M22 0H30M-16 0H16", fills="M-22 0L-12 -5V5ZM22 0L12 -5V5Z")
TORQUE = ac.Icon("M-15 8A16 16 0 0 1 13 2", "M16 10L6 3L17 -1Z", size=(48.0, 28.0), source=True)
TORQUE2 = element("M-30 0H-20M20 0H30M-12 9A13 13 0 0 1 12 4", fills="M14 11L5 5L15 1Z")
MOVED = ac.Icon(
    "M-14 -12V12M-14 -6L-21 0M-14 0L-21 6M-14 6L-21 12M-14 0H10M-14 -12L-21 -6", "M20 0L8 -6V6Z",
    size=(48.0, 28.0), source=True,
)  # fmt: skip

# -- electrical ------------------------------------------------------------------------------------

GROUND = ac.Icon(
    "M0 -11V-1M-11 -1H11M-7 4H7M-3 9H3",
    size=(26.0, 22.0),
    sides={"p": "top"},
    reference=True,
)
RESISTOR = element("M-30 0H-18M-18 -7H18V7H-18ZM18 0H30")
VARIABLE_RESISTOR = element(
    "M-30 0H-18M-18 -7H18V7H-18ZM18 0H30M-14 13L14 -13", fills="M16 -15L14 -8L9 -12Z"
)
CAPACITOR = element("M-30 0H-4M-4 -13V13M4 -13V13M4 0H30")
INDUCTOR = element("M-30 0H-20a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0H30")
SATURATING = element(
    "M-30 0H-20a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0H30M-20 4H20"
)
DIODE = element("M-30 0H-9M9 0H30M9 -10V10M-9 -10L9 0L-9 10Z")
ZENER = element("M-30 0H-9M9 0H30M5 -10H9V10H13M-9 -10L9 0L-9 10Z")
THYRISTOR = element("M-30 0H-9M9 0H30M9 -10V10M-9 -10L9 0L-9 10ZM9 0L17 12")
POLES = ((-22.0, -9.0, "M-3 0H3M0 -3V3"), (22.0, -9.0, "M-3 0H3"))
CURVES = {
    "sine": "M-9 0C-6 -10 -3 -10 0 0S6 10 9 0",
    "damped": "M-10 0C-8 -12 -5 -12 -3 0S1 8 3 0S7 -4 9 0",
    "pulse": "M-9 5H-5V-5H1V5H7V-5H9",
    "step": "M-8 5H0V-5H8",
    "ramp": "M-9 5H-5L5 -5H9",
    "sawtooth": "M-9 5L-3 -5V5L3 -5V5L9 -5",
    "trapezoid": "M-10 5H-7L-4 -5H3L6 5H10",
    "exponential": "M-9 5C-6 -8 -1 -6 0 -6C1 3 5 5 9 5",
    "table": "M-7 -6H7V6H-7ZM-7 0H7M-1 -6V6",
}
"""Small curves over time, for sources."""
VOLTAGE = ac.Icon("M-30 0H30" + ROUND, size=LYING, source=True, upright=POLES)
SIGNAL_VOLTAGE = replace(VOLTAGE, fills="M-5 -13H5L0 -4Z")
CURRENT = element(
    ENDS + ROUND + "M0 -14V14M-24 -8H-18", fills="M-16 -8L-22 -11.5V-4.5Z", source=True
)
SIGNAL_CURRENT = replace(CURRENT, strokes=CURRENT.strokes + "M-5 0H5")


def voltage(curve: str) -> ac.Icon:
    """A source of voltage with one of `CURVES`."""
    return replace(VOLTAGE, strokes=ENDS + ROUND, upright=(*POLES, (0.0, 0.0, CURVES[curve])))


def current(curve: str) -> ac.Icon:
    """A source of current with one of `CURVES`."""
    strokes = ENDS + ROUND + "M-24 -8H-18"
    return replace(CURRENT, strokes=strokes, upright=((0.0, 0.0, CURVES[curve]),))


CELL = element("M-30 0H-5M-5 -13V13M5 -7V7M5 0H30M-14 -10H-8M-11 -13V-7", source=True)
SWITCH = element(
    "M-30 0H-12L11 -11M12 0H30",
    fills="M-14 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0M10 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0",
)
SHORT = element("M-30 0H30")
IDLE = element("M-30 0H-14M14 0H30")
TRANSFORMER = ac.Icon(
    "M-30 -9H-9a4.5 4.5 0 0 1 0 9a4.5 4.5 0 0 1 0 9H-30M30 -9H9a4.5 4.5 0 0 0 0 9a4.5 4.5 0 0 0 0 9H30"
    "M-1.5 -12V12M1.5 -12V12",
    size=(60.0, 36.0), sides={"p1": "left", "n1": "left", "p2": "right", "n2": "right"},
)  # fmt: skip
OP_AMP = ac.Icon(
    "M-22 -22L22 0L-22 22Z",
    size=(44.0, 44.0),
    sides={
        "in_p": "left", "in_n": "left", "p1": "left", "n1": "left", "out": "right", "p2": "right",
        "n2": "right", "s_p": "top", "s_n": "bottom", "VMax": "top", "VMin": "bottom", "p": "left",
        "n": "left", "n_supply": "bottom", "p_supply": "top",
    },
)  # fmt: skip
TRANSISTOR = ac.Icon(
    "M-30 0H-6M-6 -12V12M-6 -5L12 -16M-6 5L12 16M12 -16V-22M12 16V22", size=(60.0, 44.0),
    sides={"B": "left", "C": "top", "E": "bottom", "G": "left", "D": "top", "S": "bottom"},
)  # fmt: skip
EMF = ac.Icon(
    "M-16 -18H16V18H-16ZM-12 0a12 12 0 1 0 24 0a12 12 0 1 0 -24 0", text="M", size=(32.0, 36.0),
    sides={"p": "left", "n": "left", "flange": "right"},
)  # fmt: skip

# -- heat, fluids, magnets -------------------------------------------------------------------------

HEAT_CAPACITY = ac.Icon(
    "M-14 13C-28 13 -26 -3 -15 -5C-15 -19 9 -19 12 -8C26 -10 28 13 14 13Z",
    text="C",
    size=(49.0, 32.0),
)
CONDUCTION = element("M-30 0H-18M-18 -11H18V11H-18ZM18 0H30M-9 -11V11M0 -11V11M9 -11V11")
CONVECTION = element(
    "M-30 0H-18M-18 -13V13M18 0H30M-14 -7C-8 -12 -6 -2 0 -7S8 -2 14 -7"
    "M-14 1C-8 -4 -6 6 0 1S8 6 14 1M-14 9C-8 4 -6 14 0 9S8 14 14 9M18 -13V13"
)
RADIATION = element(
    "M-30 0H-18M-18 -12V12M18 -12V12M18 0H30M-14 -5H6M-14 5H6", fills="M14 -5L5 -9V-1ZM14 5L5 1V9Z"
)
TEMPERATURE = ac.Icon("M-18 -13H18V13H-18Z", text="T", size=(36.0, 28.0), source=True)
HEAT_FLOW = ac.Icon("M-20 -4H8M-20 4H8", "M22 0L6 -9V9Z", size=(48.0, 28.0), source=True)
PIPE = element("M-30 0H-24M24 0H30M-24 -7H24V7H-24ZM-12 0H8M8 0L3 -3M8 0L3 3")
VALVE = element("M-30 0H-15M15 0H30M-15 -10V10L15 -10V10Z")
ORIFICE = element("M-30 0H30M-10 -12C-4 -5 4 -5 10 -12M-10 12C-4 5 4 5 10 12")
TANK = ac.Icon("M-18 -18V16H18V-18M-18 -6H18M-18 16V18M18 16V18", size=(44.0, 38.0))
PUMP = element(ENDS + ROUND + "M-7 -12L14 0L-7 12", source=True)
AMBIENT = ac.Icon("M-16 -14H16V14H-16Z", text="p", size=(36.0, 30.0), source=True)
CYLINDER = element("M-30 0H-18M-18 -12H16M-18 12H16M-18 -12V12M4 -11V11M4 0H30")
HEAD = element("M-30 0H-16V10H0V-10H16V0H30")
RELUCTANCE = element("M-30 0H-18M18 0H30M-18 -6H18V6H-18Z", fills="M-18 -6H18V6H-18Z")
CONVERTER = ac.Icon(
    "M-30 -9H-9a4.5 4.5 0 0 1 0 9a4.5 4.5 0 0 1 0 9H-30M30 -9H4V9H30", size=(60.0, 36.0),
    sides={"p": "left", "n": "left", "port_p": "right", "port_n": "right"},
)  # fmt: skip
MAGNET = element("M-30 0H-18M18 0H30M-18 -9H18V9H-18ZM0 -9V9", fills="M-18 -9H0V9H-18Z")
CHARGE = ac.Icon("M-14 -10H14V10H-14ZM14 -4H18V4H14M-8 0H0M-4 -4V4M4 0H10", size=(44.0, 28.0))

# -- sensors, networks -----------------------------------------------------------------------------

SENSOR = ac.Icon(ROUND + "M0 6L7 -8M-9 -6L-7 -4M0 -11V-8M9 -6L7 -4", size=(28.0, 28.0))
SENSOR2 = element(ENDS + ROUND + "M0 6L7 -8M-9 -6L-7 -4M0 -11V-8")


def meter(text: str) -> ac.Icon:
    """A sensor at one end, with the sign of what it measures."""
    return replace(SENSOR, strokes=ROUND, text=text)


def meter2(text: str) -> ac.Icon:
    """A sensor between two ends."""
    return replace(SENSOR2, strokes=ENDS + ROUND, text=text)


NEURAL = ac.Icon(
    "M-13 -6L0 -10M-13 -6L0 0M-13 -6L0 10M-13 6L0 -10M-13 6L0 0M-13 6L0 10M0 -10L13 0M0 0H13M0 10L13 0",
    "M-15.5 -6a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0M-15.5 6a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0"
    "M-2.5 -10a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0M-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0"
    "M-2.5 10a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0M10.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0",
    size=(46.0, 32.0), frame=True,
)  # fmt: skip

# -- blocks ----------------------------------------------------------------------------------------

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
DEAD_ZONE = block("", "M-16 0H16M0 -13V13M-15 10L-6 0H6L15 -10")
HYSTERESIS = block("", "M-15 10H6V-10M15 -10H-6V10")
SWITCHED = block("", "M-22 -9H-9L9 0H22M-22 9H-9")
DELAY = block("z⁻¹")
HOLD = block("", "M-15 9H-8V3H0V-4H8V-10H15")
CONSTANT = block("", "M-15 11V-12M-15 11H16M-15 -4H15", source=True)
STEP = block("", "M-15 11V-12M-15 11H16M-15 8H-2V-8H15", source=True)
RAMP = block("", "M-15 11V-12M-15 11H16M-15 8H-8L6 -8H15", source=True)
SINE = block("", "M-16 0H16M-15 0C-10 -16 -5 -16 0 0S10 16 15 0", source=True)
PULSE = block("", "M-15 11V-12M-15 11H16M-15 8H-10V-8H-3V8H4V-8H11V8H15", source=True)
SAWTOOTH = block("", "M-15 11V-12M-15 11H16M-15 8L-4 -8V8L7 -8V8L15 -3", source=True)
TRAPEZOID = block("", "M-15 11V-12M-15 11H16M-15 8H-11L-6 -8H3L8 8H15", source=True)
TABLE = block("", "M-14 -11H14V11H-14ZM-14 -4H14M-14 4H14M-4 -11V11M5 -11V11", source=True)
CLOCK = block("", "M-11 0a11 11 0 1 0 22 0a11 11 0 1 0 -22 0M0 -7V0L5 4", source=True)
EXPRESSION = block("f(t)", source=True)
