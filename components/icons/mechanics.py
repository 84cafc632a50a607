"""Pictures of mechanics."""

from dataclasses import replace

import acausal as ac

from .shapes import boxed, element

SPRING = element("M-18 0L-15 -9L-9 9L-3 -9L3 9L9 -9L15 9L18 0")
DAMPER = element("M-2 -7V7M-12 -11H12V11H-12")
SPRING_DAMPER = ac.Icon(
    "M-22 -9V10M-22 -9H-14L-11 -15L-6 -3L-1 -15L4 -3L9 -15L12 -9H22"
    "M-22 10H0M0 5V15M-8 3H9V17H-8M9 10H22M22 -9V10",
    size=(60.0, 38.0),
)
GAP = ac.Icon(
    "M-22 -9V10M-22 -9H-16L-13 -15L-8 -3L-3 -15L2 -3L5 -9H9M9 -15V-3M14 -15V-3M14 -9H22"
    "M-22 10H0M0 5V15M-8 3H9V17H-8M9 10H22M22 -9V10",
    size=(60.0, 38.0),
)
MASS = element("M-20 -13H20V13H-20Z")
INERTIA = element("M-9 -15H9V15H-9ZM-9 -9H9M-9 9H9")
ROD = element("", fills="M-26 -3H26V3H-26Z")
DISC = element("M-6 -14V14M6 -14V14M-6 -5H6M-6 5H6")
FIXED = ac.Icon(
    "M-14 0H-2M-2 -13V13M-2 -7L7 -13M-2 0L7 -6M-2 7L7 1M-2 13L7 7",
    size=(28.0, 28.0),
    reference=True,
)
GEAR = element("M-9 -8H-1V8H-9ZM-1 -15H8V15H-1Z")
PLANETARY = ac.Icon(
    "M-6 -5H6V5H-6ZM-6 -14H6V-7H-6ZM-10 -18H10V-14H-10ZM-6 7H6V14H-6ZM-10 14H10V18H-10Z"
    "M-30 -10H-6M-12 -10V10H-6M10 -16H20V16H10",
    size=(60.0, 40.0), sides={"carrier": "left", "sun": "left", "ring": "right"},
    places={"carrier": -0.5, "sun": 0.0, "ring": 0.0},
)  # fmt: skip
DIFFERENTIAL = ac.Icon(
    "M-10 -12H10V12H-10ZM-10 0L-2 -5V5ZM10 -8L2 -12M0 -12V-8H10M0 12V8H10M-2 0H4",
    size=(60.0, 40.0), sides={"flange_b": "left", "flange_left": "right", "flange_right": "right"},
    places={"flange_b": 0.0, "flange_left": -0.4, "flange_right": 0.4},
)  # fmt: skip
BACKLASH = element("M-22 0V-11H-14V4H-8V-11H4V4H10V-11M22 0V11H1V-4H-5V11H-14")
MAGNETIC_BRAKE = element("M-18 0H18M-5 -14V14M5 -14V14", fills="M-5 5H5V14H-5Z")
GEARBOX = boxed(GEAR)
STOPPED = element(
    "M-20 -10H20V10H-20ZM-26 -14V14M26 -14V14M-20 13L-14 10M-8 13L-2 10M4 13L10 10M16 13L20 11"
)
RACK = element(
    "M-12 -4a9 9 0 1 0 18 0a9 9 0 1 0 -18 0M-20 9H24V0M-16 9V6M-8 9V6M0 9V6M8 9V6M16 9V6"
)
CLUTCH = element(
    "M-4 -12V13M4 -12V13M-11 -13V-16H11V-13", fills="M-11 -13L-4 -10L-11 -7ZM11 -13L4 -10L11 -7Z"
)
ONE_WAY = replace(CLUTCH, strokes=CLUTCH.strokes + "M-4 -3L4 3L-4 9")
BRAKE = element("M-18 0H18M-4 -13H4V-3H-4ZM-4 3H4V13H-4ZM-14 -13H14M-14 13H14")
FRICTION = element(
    "M-16 0H16M-14 -8H14M-14 8H14"
    "M-14 -8L-10 -13M-6 -8L-2 -13M2 -8L6 -13M10 -8L14 -13M-14 13L-10 8M-6 13L-2 8M2 13L6 8M10 13L14 8"
)
REVOLUTE = ac.Icon(
    "M-12 0A12 12 0 1 0 12 0A12 12 0 1 0 -12 0M-4 0A4 4 0 1 0 4 0A4 4 0 1 0 -4 0",
    sides={"flange_a": "top", "support": "bottom"},
    places={"flange_a": 0.0, "support": 0.0},
)
PRISMATIC = ac.Icon(
    "M-14 -12H14V12H-14Z",
    sides={"flange_a": "top", "support": "bottom"},
    places={"flange_a": 0.0, "support": 0.0},
)
ROLLING = element("M-12 0a12 12 0 1 0 24 0a12 12 0 1 0 -24 0M-20 12H30M30 12V0")
VEHICLE = ac.Icon(
    "M-26 8V-2L-18 -4L-12 -13H10L18 -4L26 -2V8Z"
    "M-17 10a6 6 0 1 0 12 0a6 6 0 1 0 -12 0M7 10a6 6 0 1 0 12 0a6 6 0 1 0 -12 0",
    size=(60.0, 36.0),
)
WORLD = ac.Icon(
    "M-14 14V-14M-14 14H14", "M-14 -18L-17 -11H-11ZM18 14L11 11V17Z", size=(40.0, 40.0), frame=True
)
WHEEL = element("M-30 0H-5M-5 -15H5V15H-5ZM5 0H30M-5 -9H5M-5 -3H5M-5 3H5M-5 9H5")
FORCE = ac.Icon("M-20 0H14", "M22 0L10 -6V6Z", size=(48.0, 32.0), source=True)
FORCE2 = element("M-16 0H16", fills="M-22 0L-12 -5V5ZM22 0L12 -5V5Z")
TORQUE = ac.Icon("M-15 8A16 16 0 0 1 13 2", "M16 10L6 3L17 -1Z", size=(48.0, 36.0), source=True)
TORQUE2 = element("M-12 9A13 13 0 0 1 12 4", fills="M14 11L5 5L15 1Z")
MOVED = ac.Icon(
    "M-14 -12V12M-14 -6L-21 0M-14 0L-21 6M-14 6L-21 12M-14 0H10M-14 -12L-21 -6", "M20 0L8 -6V6Z",
    size=(48.0, 32.0), source=True,
)  # fmt: skip
