"""Pictures of heat, liquids, magnets and batteries."""

from dataclasses import replace

import acausal as ac

from .electrical import INTERMEDIATE
from .shapes import ROUND, element, marked

HEAT_CAPACITY = ac.Icon(
    "M-14 13C-28 13 -26 -3 -15 -5C-15 -19 9 -19 12 -8C26 -10 28 13 14 13Z",
    text="C",
    size=(49.0, 32.0),
)
CONDUCTION = element("M-18 -11H18V11H-18ZM-9 -11V11M0 -11V11M9 -11V11")
CONVECTION = element(
    "M-18 -13V13M-14 -7C-8 -12 -6 -2 0 -7S8 -2 14 -7"
    "M-14 1C-8 -4 -6 6 0 1S8 6 14 1M-14 9C-8 4 -6 14 0 9S8 14 14 9M18 -13V13"
)
RADIATION = element("M-18 -12V12M18 -12V12M-14 -5H6M-14 5H6", fills="M14 -5L5 -9V-1ZM14 5L5 1V9Z")


def temperature(unit: str) -> ac.Icon:
    """A given temperature in a unit."""
    return ac.Icon("M-18 -13H18V13H-18Z", text=unit, size=(36.0, 28.0), source=True)


TEMPERATURE = temperature("T")
HEAT_FLOW = ac.Icon("M-20 -4H8M-20 4H8", "M22 0L6 -9V9Z", size=(48.0, 36.0), source=True)
PIPE = element("M-24 -7H24V7H-24ZM-12 0H8M8 0L3 -3M8 0L3 3")
VALVE = element("M-15 -10V10L15 -10V10Z")
CHECK_VALVE = replace(VALVE, fills="M-15 -10V10L0 0Z")
ORIFICE = element("M-16 0H16M-10 -12C-4 -5 4 -5 10 -12M-10 12C-4 5 4 5 10 12")
TEE = ac.Icon("M-30 -9H-6M-30 9H-6M-6 -13V13M-6 0H30", size=(60.0, 32.0))
TANK = ac.Icon("M-18 -18V16H18V-18M-18 -6H18M-18 16V18M18 16V18", size=(44.0, 38.0))
PUMP = element(ROUND + "M-7 -12L14 0L-7 12", source=True)
AMBIENT = ac.Icon("M-16 -14H16V14H-16Z", text="p", size=(36.0, 30.0), source=True)
CYLINDER = element("M-18 -12H16M-18 12H16M-18 -12V12M4 -11V11")
HEAD = element("M-16 0V10H0V-10H16V0")
VESSEL = ac.Icon("M-16 -8a16 16 0 0 1 32 0V8a16 16 0 0 1 -32 0Z", size=(36.0, 50.0))
PISTON = ac.Icon("M-18 -12H18M-18 12H18M-18 -12V12M4 -12V12M4 0H22", size=(44.0, 30.0))
WEIR = element("M-16 -10V10H16V-10M-16 -4H-4M-2 10V-2H2V10M2 4H16")
SPOOL = ac.Icon(
    "M-22 -11H22V11H-22ZM-8 -11V11M8 -11V11M-15 7V-7L-18 -3M-15 -7L-12 -3M15 -7V7L12 3M15 7L18 3",
    size=(60.0, 44.0),
)
SPOOL_4 = replace(
    SPOOL, mark="4", places={"port_s": -0.5, "port_r": 0.5, "port_a": -0.5, "port_b": 0.5, "flange": 0.0},
    sides={"port_s": "bottom", "port_r": "bottom", "port_a": "top", "port_b": "top", "flange": "right"},
)  # fmt: skip
RELUCTANCE = element("M-18 -6H18V6H-18Z", fills="M-18 -6H18V6H-18Z")
CONVERTER = ac.Icon(
    "M-30 -9H-9a4.5 4.5 0 0 1 0 9a4.5 4.5 0 0 1 0 9H-30M30 -9H4V9H30", size=(60.0, 36.0),
    sides={"p": "left", "n": "left", "port_p": "right", "port_n": "right"},
)  # fmt: skip
MAGNET = element("M-18 -9H18V9H-18ZM0 -9V9", fills="M-18 -9H0V9H-18Z")
RING = "M-13 0a13 13 0 1 0 26 0a13 13 0 1 0 -26 0M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0"
FLUX_TUBES = {
    "cuboid": "M-14 -4H8V10H-14ZM-14 -4L-8 -11H14L8 -4M14 -11V3L8 10",
    "axial": "M-14 -9H14M-14 9H14M-14 -9a9 9 0 1 0 0 18M14 -9a9 9 0 0 1 0 18"
    "M14 -9a9 9 0 0 0 0 18M10 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0",
    "radial": RING + "M5 0H13M-13 0H-5M0 -13V-5M0 5V13",
    "around": RING + "M-9 0a9 9 0 0 1 9 -9",
    "toroid": "M-14 -6H14a6 6 0 0 1 0 12H-14a6 6 0 0 1 0 -12M-8 0a8 8 0 0 0 16 0M-6 2a7 7 0 0 1 12 0",
    "quarter": "M-11 10V-10A20 20 0 0 1 9 10Z",
    "half": "M-15 8A15 15 0 0 1 15 8Z",
    "quarter ring": "M-11 10V-10A20 20 0 0 1 9 10H0A11 11 0 0 0 -11 -1",
    "half ring": "M-15 8A15 15 0 0 1 15 8H6A6 6 0 0 0 -6 8Z",
    "quarter ball": "M-11 10V-10A20 20 0 0 1 9 10ZM-11 -10A28 28 0 0 1 -2 10",
    "quarter shell": "M-11 10V-10A20 20 0 0 1 9 10H0A11 11 0 0 0 -11 -1M-7 -9.5A26 26 0 0 1 5 10",
    "eighth": "M-11 -10L-11 6L7 10A20 20 0 0 0 -11 -10M-11 6A30 30 0 0 0 7 10",
    "eighth shell": "M-11 -10V-2L1 8L7 10A20 20 0 0 0 -11 -10M-11 -2A12 12 0 0 1 1 8",
    "coaxial": "M-14 -12V12M-14 -12H-2V12H-14M2 -12H14V12H2ZM-14 -4H-2M2 -4H14M-14 4H-2M2 4H14",
    "poles": "M-16 -12H-6V12H-16M16 -12H6V12H16M-6 -8A10 10 0 0 1 6 -8M-6 8A10 10 0 0 0 6 8",
    "force": "M-16 -9H-4V9H-16ZM4 -9H16V9H4ZM-4 0H4",
}
"""Shapes of magnetic flux tubes."""


def tube(shape: str, mark: str = "") -> ac.Icon:
    """A flux tube of one of `FLUX_TUBES`."""
    return marked(element(FLUX_TUBES[shape]), mark)


CROSSED = replace(
    INTERMEDIATE,
    sides={"port_p1": "left", "port_n1": "left", "port_p2": "right", "port_n2": "right"},
    places={"port_p1": -0.5, "port_n1": 0.5, "port_p2": 0.5, "port_n2": -0.5},
)
EDDY = replace(
    RELUCTANCE, fills="", strokes=RELUCTANCE.strokes + "M-12 0a12 12 0 1 0 24 0a12 12 0 1 0 -24 0"
)
LOOP = "M-12 9C-2 9 -4 -9 12 -9M-12 9C4 9 2 -9 12 -9"
HYSTERETIC = element("M-15 -12H15V12H-15Z" + LOOP)
PARTICLE = ac.Icon(
    "M-12 0a12 12 0 1 0 24 0a12 12 0 1 0 -24 0M-7 0a7 7 0 1 0 14 0a7 7 0 1 0 -14 0M-2 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0",
    size=(44.0, 28.0),
)
CHARGE = ac.Icon("M-14 -10H14V10H-14ZM14 -4H18V4H14M-8 0H0M-4 -4V4M4 0H10", size=(44.0, 28.0))
