"""Semiconductors; each kind has a module of its own."""

from .bipolar import NPN, PNP
from .diodes import Diode, Diode2, ZDiode
from .mosfets import NMOS, PMOS
from .thyristors import SimpleTriac, Thyristor

__all__ = ["NMOS", "NPN", "PMOS", "PNP", "Diode", "Diode2", "SimpleTriac", "Thyristor", "ZDiode"]
