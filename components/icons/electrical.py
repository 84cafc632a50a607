"""Pictures of circuits."""

from dataclasses import replace

import acausal as ac

from .shapes import LYING, ROUND, element

GROUND = ac.Icon(
    "M0 -11V-1M-11 -1H11M-7 4H7M-3 9H3",
    size=(26.0, 22.0),
    sides={"p": "top"},
    reference=True,
)
RESISTOR = element("M-18 -7H18V7H-18Z")
POTENTIOMETER = replace(
    RESISTOR, fills="M0 -7L-4 -14H4Z", sides={"pin_p": "left", "pin_n": "right", "contact": "top"}
)
KNEE = replace(RESISTOR, strokes=RESISTOR.strokes + "M-18 13H-12L14 -13")
CAPACITOR = element("M-4 -13V13M4 -13V13")
INDUCTOR = element("M-20 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0")
SATURATING = element("M-20 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0a5 5 0 0 1 10 0M-20 4H20")
IDEAL_DIODE = element("M9 -10V10M-9 -10L9 0L-9 10Z")
DIODE = replace(IDEAL_DIODE, fills="M-9 -10L9 0L-9 10Z")
ZENER = element("M5 -10H9V10H13M-9 -10L9 0L-9 10Z", fills="M-9 -10L9 0L-9 10Z")
GATED = ac.Icon(sides={"Gate": "top", "g": "top", "fire1": "top", "fire2": "bottom"}).sides
IDEAL_THYRISTOR = element("M9 -10V10M-9 -10L9 0L-9 10ZM9 0L16 -11")
GTO = replace(IDEAL_THYRISTOR, strokes=IDEAL_THYRISTOR.strokes + "M9 -8L13 -9")
THYRISTOR = replace(IDEAL_THYRISTOR, fills=DIODE.fills, sides=GATED, places={"Gate": 0.53})
IDEAL_TRIAC = ac.Icon(
    "M-10 -13V13M10 -13V13M-10 -12L10 -6.5L-10 -1ZM10 1L-10 6.5L10 12Z", size=LYING, sides=GATED
)
TRIAC = replace(IDEAL_TRIAC, fills="M-10 -12L10 -6.5L-10 -1ZM10 1L-10 6.5L10 12Z")
POLES = ((-22.0, -9.0, "M-3 0H3M0 -3V3"), (22.0, -9.0, "M-3 0H3"))
CURVES = {
    "cosine": "M-9 -7C-6 -7 -3 7 0 7S6 -7 9 -7",
    "lightning": "M3 -9L-4 1H4L-3 9",
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
VOLTAGE = ac.Icon("M-14 0H14" + ROUND, size=LYING, source=True, upright=POLES)
SUPPLY = ac.Icon(
    ROUND, text="±", size=(60.0, 36.0), source=True,
    sides={"pin_p": "top", "pin_n": "bottom", "ground": "right"},
    places={"pin_p": 0.0, "pin_n": 0.0, "ground": 0.0},
)  # fmt: skip
SIGNAL_VOLTAGE = replace(VOLTAGE, fills="M-5 -13H5L0 -4Z")
CURRENT = element(ROUND + "M0 -14V14M-24 -8H-18", fills="M-16 -8L-22 -11.5V-4.5Z", source=True)
SIGNAL_CURRENT = replace(CURRENT, strokes=CURRENT.strokes + "M-5 0H5")


def voltage(curve: str) -> ac.Icon:
    """A source of voltage with one of `CURVES`."""
    return replace(VOLTAGE, strokes=ROUND, upright=(*POLES, (0.0, 0.0, CURVES[curve])))


def current(curve: str) -> ac.Icon:
    """A source of current with one of `CURVES`."""
    strokes = ROUND + "M-24 -8H-18"
    return replace(CURRENT, strokes=strokes, upright=((0.0, 0.0, CURVES[curve]),))


CELL = ac.Icon(
    "M-5 -13V13M5 -7V7M-14 -10H-8M-11 -13V-7", size=LYING, source=True,
    sides={"surface": "right", "soc": "top", "soc_surface": "top"},
    places={"soc": 0.167, "soc_surface": -0.167, "heatPort": -0.167},
)  # fmt: skip
DOTS = "M-14 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0M10 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0"
CLOSING = element("M-12 0L11 -11", fills=DOTS)
OPENING = element("M-12 0L14 -6M12 0V-9", fills=DOTS)
TWO_WAY = ac.Icon(
    "M-12 0L11 -8M-30 0H-12M12 -9H30M12 9H30",
    "M-14 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0M10 -9a2 2 0 1 0 4 0a2 2 0 1 0 -4 0M10 9a2 2 0 1 0 4 0a2 2 0 1 0 -4 0",
    size=(60.0, 36.0), sides={"p": "left", "n1": "right", "n2": "right", "control": "top"},
    places={"p": 0.0, "n1": -0.5, "n2": 0.5, "control": 0.0},
)  # fmt: skip
INTERMEDIATE = ac.Icon(
    "M-30 -9H-12L12 9H30M-30 9H-12L12 -9H30", size=(60.0, 36.0),
    sides={"p1": "left", "p2": "left", "n1": "right", "n2": "right", "control": "top"},
    places={"p1": -0.5, "p2": 0.5, "n1": -0.5, "n2": 0.5, "control": 0.0},
)  # fmt: skip


def arced(icon: ac.Icon) -> ac.Icon:
    """A contact with an arc."""
    return replace(icon, strokes=icon.strokes + "M11 -11L13 -14L13 -9L16 -12L16 -7L18 -9")


def ruled(icon: ac.Icon) -> ac.Icon:
    """A switch that a voltage rules: its contact is a connector."""
    return replace(icon, sides={**icon.sides, "control": "top"}, mark="V")


SHORT = element("M-14 0H14")
IDLE = element("M-12 -3V3M12 -3V3")
PAIRS = ac.Icon(sides={"p1": "left", "n1": "left", "p2": "right", "n2": "right"}).sides
PAIRED = {"p1": -0.5, "n1": 0.5, "p2": -0.5, "n2": 0.5}
DIAMOND = "M12 -11L22 0L12 11L2 0Z"


def controlled(sensed: str, made: str) -> ac.Icon:
    """A two-port with a ``voltage`` or ``current`` sensed at the left and made at the right."""
    left = "M-30 -18H-18V-10M-30 18H-18V10" if sensed == "voltage" else "M-30 -18H-14V18H-30"
    right = (
        "M12 -11V-18H30M12 11V18H30" + DIAMOND + ("M12 -11V11" if made == "voltage" else "M2 0H22")
    )
    return ac.Icon(
        left + right,
        size=(60.0, 44.0),
        sides=PAIRS,
        places={n: 1.64 * v for n, v in PAIRED.items()},
    )


TRANSFORMER = ac.Icon(
    "M-30 -9H-9a4.5 4.5 0 0 1 0 9a4.5 4.5 0 0 1 0 9H-30M30 -9H9a4.5 4.5 0 0 0 0 9a4.5 4.5 0 0 0 0 9H30"
    "M-1.5 -12V12M1.5 -12V12",
    size=(60.0, 36.0), sides=PAIRS, places=PAIRED,
)  # fmt: skip
OP_AMP = ac.Icon(
    "M-22 -22L22 0L-22 22Z",
    size=(44.0, 44.0),
    upright=((-15.0, -9.0, "M-3 0H3"), (-15.0, 9.0, "M-3 0H3M0 -3V3")),
    sides={
        "in_p": "left", "in_n": "left", "p1": "left", "n1": "left", "out": "right", "p2": "right", "outp": "right",
        "n2": "right", "s_p": "top", "s_n": "bottom", "VMax": "top", "VMin": "bottom", "p": "left", "m": "left",
        "n": "left", "n_supply": "bottom", "p_supply": "top", "m_supply": "bottom", "p1_2": "left",
    },
    places={
        "in_n": -0.41, "in_p": 0.41, "p1": -0.41, "n1": 0.41, "m": -0.41, "p": 0.41, "p1_2": 0.0,
        "VMax": 0.0, "VMin": 0.0, "s_p": 0.0, "s_n": 0.0, "p_supply": 0.0, "m_supply": 0.0, "n_supply": 0.0,
        "out": 0.0, "outp": 0.0,
    },
)  # fmt: skip


OP_AMP_OF_PAIRS = replace(
    OP_AMP, upright=((-15.0, -9.0, "M-3 0H3M0 -3V3"), (-15.0, 9.0, "M-3 0H3")), mark="∞"
)


def amplifier(text: str) -> ac.Icon:
    """A circuit round an operational amplifier."""
    return replace(OP_AMP, text=text, upright=())


BIPOLAR = "M-6 -12V12M-6 -5L12 -16M-6 5L12 16M12 -16V-22M12 16V22"
MOS = "M-12 -12V12M-6 -14V-6M-6 -4V4M-6 6V14M-6 -10H12V-22M-6 10H12V22M-6 0H12"
TRANSISTOR = ac.Icon(
    BIPOLAR, size=(60.0, 44.0),
    sides={"B": "left", "C": "top", "E": "bottom"}, places={"B": 0.0, "C": 0.4, "E": 0.4},
)  # fmt: skip
NPN = replace(TRANSISTOR, fills="M11 15.5L2.5 14L6 8Z")
PNP = replace(TRANSISTOR, fills="M-5 5.6L3.5 7L0 13Z")
NMOS = ac.Icon(
    MOS, "M-6 0L2 -4V4Z", size=(60.0, 44.0), sides={"G": "left", "D": "top", "S": "bottom", "B": "right"},
    places={"G": 0.0, "D": 0.4, "S": 0.4, "B": 0.0},
)  # fmt: skip
PMOS = replace(NMOS, fills="M6 0L-2 -4V4Z")
EMF = ac.Icon(
    "M-16 -18H16V18H-16ZM-12 0a12 12 0 1 0 24 0a12 12 0 1 0 -24 0", text="M", size=(32.0, 36.0),
    sides={"p": "left", "n": "left", "flange": "right"}, places={"p": -0.5, "n": 0.5, "flange": 0.0},
)  # fmt: skip
LINEAR_EMF = replace(EMF, strokes="M-16 -18H16V18H-16ZM-12 -8H12V8H-12ZM-12 12H12")
LINE = ac.Icon(
    "M-16 -8H14M-16 8H14M-16 -8a8 8 0 1 0 0 16a8 8 0 1 0 0 -16M14 -8a8 8 0 0 1 0 16",
    size=LYING, sides={"p1": "left", "p2": "right", "p3": "bottom"},
)  # fmt: skip
