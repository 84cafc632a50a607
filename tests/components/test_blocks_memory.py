"""Logical blocks that remember, and networks of truth values and integers."""

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.components.blocks import math_boolean, math_integer

STEP = 0.05
TIMES = STEP / 2 + STEP * np.arange(200)  # never at an event
END = 10.0


class Memory(ac.Component):
    """Blocks that remember, driven by a sine of 0.5 Hz, and by pulses that are on during 1 of 2.5 s."""

    def __init__(self) -> None:
        super().__init__()
        self.sine, self.pulse = blocks.Sine(f=0.5), blocks.BooleanPulse(period=2.5, width=40.0)
        self.true, self.zero = blocks.BooleanConstant(), blocks.Constant(k=0)
        self.hysteresis = blocks.Hysteresis(uLow=-0.5, uHigh=0.5)
        self.control = blocks.OnOffController(bandwidth=1.0, pre_y_start=True)
        self.trapezoid = blocks.TriggeredTrapezoid(
            amplitude=2.0, rising=0.4, falling=2.0, offset=1.0
        )
        self.timer, self.delay = blocks.Timer(), blocks.LogicalDelay(delayTime=0.3)
        self.onDelay = math_boolean.OnDelay(delayTime=0.3)
        self.edges = [blocks.Edge(), blocks.FallingEdge(), blocks.Change(), blocks.ZeroCrossing()]
        self.counters = [math_integer.TriggeredAdd(y_start=10) for _ in self.edges]
        self.one = blocks.IntegerConstant(k=1)
        self.flipflop, self.flip, self.flop = (
            blocks.RSFlipFlop(),
            self._above(0.5),
            self._above(0.5),
        )
        self.minus = blocks.Gain(k=-1)
        self.end = blocks.TerminateSimulation(condition=ac.time > 3)
        for part in (self.hysteresis, self.control, self.edges[3], self.flip, self.minus):
            self.connect(self.sine.y, part.u)
        self.connect(self.zero.y, self.control.reference)
        self.connect(self.true.y, self.edges[3].enable)
        for part in (self.trapezoid, self.timer, self.delay, self.onDelay, *self.edges[:3]):
            self.connect(self.pulse.y, part.u)
        for edge, counter in zip(self.edges, self.counters, strict=True):
            self.connect(edge.y, counter.trigger)
            self.connect(self.one.y, counter.u)
        self.connect(self.minus.y, self.flop.u)
        self.connect(self.flip.y, self.flipflop.S)
        self.connect(self.flop.y, self.flipflop.R)

    @staticmethod
    def _above(threshold: float) -> ac.Component:
        return blocks.GreaterThreshold(threshold=threshold)


@pytest.fixture(scope="module")
def sol() -> ac.Solution:
    return ac.simulate(ac.compile(Memory()), (0.0, END), saveat=TIMES)


SINE = np.sin(np.pi * TIMES)
PHASE = TIMES % 2.5
ON = PHASE < 1.0


def switched(on: np.ndarray, off: np.ndarray, start: bool) -> np.ndarray:
    """On where the first holds, off where the second does, else as before."""
    values, value = [], start
    for yes, no in zip(on, off, strict=True):
        value = (value or yes) and not no
        values.append(value)
    return np.array(values)


@pytest.mark.slow
def test_two_point_blocks(sol):
    np.testing.assert_array_equal(sol["hysteresis.y"], switched(SINE > 0.5, SINE < -0.5, False))
    np.testing.assert_array_equal(sol["control.y"], switched(SINE < -0.5, SINE > 0.5, True))


def test_a_flip_flop(sol):
    expected = switched(SINE > 0.5, SINE < -0.5, False)
    np.testing.assert_array_equal(sol["flipflop.Q"], expected)
    np.testing.assert_array_equal(sol["flipflop.QI"], ~expected)


def test_timers_and_delays(sol):
    np.testing.assert_allclose(sol["timer.y"], np.where(ON, PHASE, 0), atol=1e-12)
    np.testing.assert_array_equal(sol["delay.y1"], ON | ((PHASE < 1.3) & (TIMES > 1)))
    late_first = np.where(TIMES < 1, True, PHASE > 0.3)
    np.testing.assert_array_equal(sol["delay.y2"], ON & late_first)
    np.testing.assert_array_equal(sol["onDelay.y"], ON & late_first)


def test_a_trapezoid_rises_from_where_it_is(sol):
    y, expected, target = 3.0, [], 3.0  # it starts high, without a rise
    fine = 50
    for k in range(len(TIMES) * fine):
        t = k * STEP / fine
        if k % fine == fine // 2:
            expected.append(y)
        target = 3.0 if (t + STEP / fine / 2) % 2.5 < 1 else 1.0
        rate = 2.0 / 0.4 if target == 3.0 else -2.0 / 2.0
        y = min(max(y + rate * STEP / fine, 1.0), 3.0) if y != target else y
    np.testing.assert_allclose(sol["trapezoid.y"], expected, atol=0.011)


def test_edges_are_counted(sol):
    rises, falls = np.floor(TIMES / 2.5), np.floor((TIMES + 1.5) / 2.5)
    np.testing.assert_array_equal(sol["counters[1].y"], 10 + rises)
    np.testing.assert_array_equal(sol["counters[2].y"], 10 + falls)
    np.testing.assert_array_equal(sol["counters[3].y"], 10 + rises + falls)
    np.testing.assert_array_equal(sol["counters[4].y"], 10 + np.floor(TIMES))


def test_an_end_is_told(sol):
    np.testing.assert_array_equal(sol["end.terminated"], TIMES > 3)


class Network(ac.Component):
    """Operations on three truth values, switches, counters, buttons."""

    def __init__(self) -> None:
        super().__init__()
        tables = [[0.5, 1.5, 4.0], [1.0, 2.0, 3.0], [2.5, 3.5]]
        self.inputs = [blocks.BooleanTable(table=table) for table in tables]
        names = ("And", "Or", "Xor", "Nand", "Nor")
        self.operations = [getattr(math_boolean, name)(nu=3) for name in names]
        self.real = blocks.MultiSwitch(nu=3, expr=[1.5, ac.time, 3.5], y_default=-1.0)
        self.whole = math_integer.MultiSwitch(nu=3, expr=[4, 6, 8], y_default=2)
        self.truth = math_boolean.MultiSwitch(
            nu=3, expr=[True, False, True], use_pre_as_default=False
        )
        self.sum, self.product = math_integer.Sum(nu=3, k=[1, 2, 4]), math_integer.Product(nu=3)
        self.count = math_integer.TriggeredAdd(use_reset=True, use_set=True)
        for i, source in enumerate(self.inputs):
            for part in (
                *self.operations,
                self.real,
                self.whole,
                self.truth,
                self.sum,
                self.product,
            ):
                self.connect(source.y, part.u[i])
        self.connect(self.inputs[1].y, self.count.trigger)
        self.connect(self.inputs[2].y, self.count.reset)
        self.connect(self.sum.y, self.count.u)
        self.connect(self.whole.y, self.count.set)
        self.start = blocks.RadioButtonSource(buttonTimeTable=[1.0, 3.0])
        self.stop = blocks.RadioButtonSource(buttonTimeTable=[2.0, 4.0], reset=[False])
        self.shown, self.bit = (
            blocks.RealValue(),
            blocks.BooleanValue(use_activePort=False, active=True),
        )
        self.connect(self.real.y, self.shown.numberPort)

    def equations(self):
        yield ac.Eq(self.start.reset[0], self.stop.on)


@pytest.mark.slow
def test_networks():
    sol = ac.simulate(ac.compile(Network()), (0.0, 5.0), saveat=TIMES[TIMES < 5])
    t = np.asarray(sol.t)
    a, b, c = (
        ((t > 0.5) & (t < 1.5)) | (t > 4),
        ((t > 1) & (t < 2)) | (t > 3),
        (t > 2.5) & (t < 3.5),
    )
    n = a.astype(int) + b + c
    for i, expected in enumerate((n == 3, n > 0, n == 1, n < 3, n == 0)):
        np.testing.assert_array_equal(sol[f"operations[{i + 1}].y"], expected)
    real = np.select([a, b, c], [1.5, t, 3.5], -1.0)
    np.testing.assert_allclose(sol["real.y"], real)
    np.testing.assert_allclose(sol["shown.showNumber"], real)
    np.testing.assert_array_equal(sol["bit.showActive"], 1)
    np.testing.assert_array_equal(sol["truth.y"], np.select([a, b, c], [1, 0, 1], 0))
    first = np.select([a, b, c], [4, 6, 8], 0)
    held = [2]
    for value in first:
        held.append(value or held[-1])
    np.testing.assert_array_equal(sol["whole.y"], held[1:])
    np.testing.assert_array_equal(sol["sum.y"], a + 2 * b + 4 * c)
    np.testing.assert_array_equal(sol["product.y"], 0)
    counted = np.select([t < 1, t < 2.5, t < 3], [0, 3, 8], 6)  # at 3 s the reset is still true
    np.testing.assert_array_equal(sol["count.y"], counted)
    np.testing.assert_array_equal(sol["start.on"], ((t > 1) & (t < 2)) | (t > 3))
    np.testing.assert_array_equal(sol["stop.on"], t > 2)


def test_a_switch_needs_a_value_for_each_input():
    with pytest.raises(ac.DeclarationError, match="expr has 1 values for nu=2 inputs"):
        blocks.MultiSwitch(nu=2, expr=[1.0])
