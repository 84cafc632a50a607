"""Adders of binary numbers, made of gates (`Modelica.Electrical.Digital.Examples.Utilities`)."""

from itertools import pairwise
from typing import Any

import acausal as ac
from acausal.components import icons

from .delayed_gates import AndGate, XorGate
from .gates import Or
from .logic import DigitalInput, DigitalOutput

__modelica__ = "Modelica.Electrical.Digital.Examples.Utilities"


class HalfAdder(ac.Component):
    """Two bits: ``s`` is their sum without carry, ``c`` the carry; both ``delayTime`` [s] late."""

    ICON = icons.block("½ +")

    delayTime = ac.Parameter(0.0, unit="s", min=0, doc="delay of the gates")
    a = DigitalInput(doc="first bit")
    b = DigitalInput(doc="second bit")
    s = DigitalOutput(doc="sum")
    c = DigitalOutput(doc="carry")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.AND = AndGate(tLH=self.delayTime, tHL=self.delayTime)
        self.XOR = XorGate(tLH=self.delayTime, tHL=self.delayTime)
        for gate, output in ((self.AND, self.c), (self.XOR, self.s)):
            self.connect(self.a, gate.x[0])
            self.connect(self.b, gate.x[1])
            self.connect(gate.y, output)


class FullAdder(ac.Component):
    """Two bits and a carry: ``s`` is their sum without the new carry ``c_out``; half adders of 1 ms."""

    ICON = icons.block("1 +")

    a = DigitalInput(doc="first bit")
    b = DigitalInput(doc="second bit")
    c_in = DigitalInput(doc="carry from the bit before")
    s = DigitalOutput(doc="sum")
    c_out = DigitalOutput(doc="carry to the next bit")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.Adder1, self.Adder2 = HalfAdder(delayTime=0.001), HalfAdder(delayTime=0.001)
        self.OR = Or()
        self.connect(self.b, self.Adder1.b)
        self.connect(self.a, self.Adder1.a)
        self.connect(self.Adder1.s, self.Adder2.a)
        self.connect(self.c_in, self.Adder2.b)
        self.connect(self.Adder2.s, self.s)
        self.connect(self.Adder2.c, self.OR.x[0])
        self.connect(self.Adder1.c, self.OR.x[1])
        self.connect(self.OR.y, self.c_out)


class Adder(ac.Component):
    """Two numbers of ``n`` bits, the least first, and a carry: ``n`` full adders ``FullAdder[i]`` in a chain."""

    ICON = icons.block("+")

    n = ac.Option(2, min=1, doc="number of bits")
    a = DigitalInput(shape="n", doc="first number")
    b = DigitalInput(shape="n", doc="second number")
    c_in = DigitalInput(doc="carry")
    s = DigitalOutput(shape="n", doc="sum")
    c_out = DigitalOutput(doc="carry of the last bit")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        self.FullAdder: Any = [FullAdder() for _ in range(int(self.n))]
        for i, adder in enumerate(self.FullAdder):
            self.connect(self.a[i], adder.a)
            self.connect(self.b[i], adder.b)
            self.connect(adder.s, self.s[i])
        self.connect(self.c_in, self.FullAdder[0].c_in)
        for before, after in pairwise(self.FullAdder):
            self.connect(before.c_out, after.c_in)
        self.connect(self.FullAdder[-1].c_out, self.c_out)
