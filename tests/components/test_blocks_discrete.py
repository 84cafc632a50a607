"""Sampled blocks, against the same computed by hand."""

import numpy as np
import pytest
from scipy import signal

import acausal as ac
from acausal.components import blocks
from acausal.components.blocks import discrete

PERIOD = 0.1
SAMPLES = PERIOD * np.arange(11)
BETWEEN = SAMPLES[:-1] + PERIOD / 2

A, B, C, D = [[0.5, 1.0], [0.0, -0.3]], [[0.0], [1.0]], [[1.0, 2.0]], [[0.1]]


class Sampling(ac.Component):
    """Sampled blocks side by side, all fed with one signal."""

    def __init__(self) -> None:
        super().__init__()
        self.source = blocks.Cosine(f=0.7, phase=0.3, offset=0.2)
        self.clock = blocks.SampleTrigger(period=2 * PERIOD, startTime=PERIOD)
        self.sampler = discrete.Sampler(samplePeriod=PERIOD)
        self.late = discrete.Sampler(samplePeriod=PERIOD, startTime=3 * PERIOD)
        self.hold = discrete.ZeroOrderHold(samplePeriod=PERIOD)
        self.line = discrete.FirstOrderHold(samplePeriod=PERIOD)
        self.delay = discrete.UnitDelay(samplePeriod=PERIOD, y_start=7.0)
        self.filter = discrete.TransferFunction(
            samplePeriod=PERIOD, b=[1.0, 0.5], a=[2.0, -1.0, 0.3]
        )
        self.states = discrete.StateSpace(samplePeriod=PERIOD, A=A, B=B, C=C, D=D)
        self.triggered = discrete.TriggeredSampler(y_start=-5.0)
        self.greatest = discrete.TriggeredMax()
        parts = (self.sampler, self.late, self.hold, self.line, self.delay, self.filter)
        for part in (*parts, self.triggered, self.greatest):
            self.connect(self.source.y, part.u)
        self.connect(self.source.y, self.states.u[0])
        self.connect(self.clock.y, self.triggered.trigger)
        self.connect(self.clock.y, self.greatest.trigger)


@pytest.fixture(scope="module")
def sol() -> ac.Solution:
    return ac.simulate(ac.compile(Sampling()), (0.0, 1.0), saveat=BETWEEN)


def source(t: np.ndarray) -> np.ndarray:
    return 0.2 + np.cos(2 * np.pi * 0.7 * t + 0.3)


U = source(SAMPLES[:-1])


@pytest.mark.slow
def test_samples_and_holds(sol):
    np.testing.assert_allclose(sol["sampler.y"], U, rtol=1e-12)
    np.testing.assert_allclose(sol["late.y"], np.where(BETWEEN < 3 * PERIOD, U[0], U), rtol=1e-12)
    np.testing.assert_allclose(sol["hold.y"], U, rtol=1e-12)
    np.testing.assert_allclose(sol["delay.y"], U, rtol=1e-12)
    np.testing.assert_array_equal(sol["hold.firstTrigger"], BETWEEN < PERIOD)
    np.testing.assert_array_equal(sol["hold.sampleTrigger"], 0)


def test_a_first_order_hold_goes_on_from_the_sample_before(sol):
    before = np.append(U[0], U[:-1])
    np.testing.assert_allclose(sol["line.y"], before + (U - before) / 2, rtol=1e-9)


def test_a_transfer_function_filters_the_samples(sol):
    np.testing.assert_allclose(
        sol["filter.y"], signal.lfilter([0.0, 1.0, 0.5], [2.0, -1.0, 0.3], U), atol=1e-12
    )


def test_a_state_space_system_computes_with_the_states_before(sol):
    x, ys = np.zeros(2), []
    for u in U:
        ys.append((np.array(C) @ x + np.array(D) @ [u])[0])
        x = np.array(A) @ x + np.array(B) @ [u]
    np.testing.assert_allclose(sol["states.y[1]"], ys, atol=1e-12)


def test_triggers(sol):
    odd = np.arange(10) % 2 == 1
    last = np.array([U[: k + 1][odd[: k + 1]][-1] if k else -5.0 for k in range(10)])
    most = np.array([np.abs(U[: k + 1][odd[: k + 1]]).max() if k else 0.0 for k in range(10)])
    np.testing.assert_allclose(sol["triggered.y"], last, rtol=1e-12)
    np.testing.assert_allclose(sol["greatest.y"], most, rtol=1e-12)


def test_every_sample_is_one_event(sol):
    times = np.unique(np.round([e.t for e in sol.events], 9))
    np.testing.assert_allclose(times, SAMPLES[1:], atol=1e-9)


def test_a_period_of_zero_is_refused():
    with pytest.raises(ac.DeclarationError, match=r"Sampler\.samplePeriod=0 is out of range"):
        discrete.Sampler(samplePeriod=0)
    with pytest.raises(
        ac.DeclarationError, match="the numerator has 2 coefficients, the denominator 1"
    ):
        ac.compile(discrete.TransferFunction(samplePeriod=1, b=[1.0, 2.0]))
