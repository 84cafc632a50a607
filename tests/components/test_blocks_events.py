"""Blocks in models that have events: sources that jump, integrators that are reset, means over periods."""

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.flattening.flat_model import flatten


class Sources(ac.Component):
    """Sources, their integrals, and a clock."""

    n = ac.Discrete(0, kind="int")

    def __init__(self) -> None:
        super().__init__()
        self.step = blocks.Step(startTime=0.37, height=2.0)
        self.pulse = blocks.Pulse(period=0.3, width=20.0, startTime=0.1)
        self.few = blocks.Pulse(period=0.3, width=20.0, startTime=0.15, nperiod=2)
        self.saw = blocks.SawTooth(period=0.3, amplitude=3.0)
        self.trapezoid = blocks.Trapezoid(
            period=1.0, rising=0.2, width=0.3, falling=0.1, startTime=-0.5
        )
        self.truth = blocks.BooleanPulse(period=0.4, width=25.0, startTime=0.2)
        self.table = blocks.IntegerTable(
            table=[[0, 1], [0.5, -4], [0.8, 2]], extrapolation="Periodic"
        )
        self.cosine = blocks.Cosine(f=1.3, startTime=0.4)
        self.nearest = blocks.RealToInteger()
        self.wave = blocks.Sine(f=0.5, amplitude=2.2)
        self.connect(self.wave.y, self.nearest.u)
        for name in (*EXACT, "nearest"):
            integrator = blocks.Integrator()
            setattr(self, f"{name}Integral", integrator)
            self.connect(getattr(self, name).y, integrator.u)

    def equations(self):
        yield ac.When(ac.sample(0.25, 0.5), ac.Eq(self.n, ac.pre(self.n) + 1))


def trapezoid(t):
    """One period of the trapezoid."""
    phase = (t + 0.5) % 1.0
    return np.interp(phase, [0, 0.2, 0.5, 0.6, 1.0], [0, 1, 1, 0, 0])


EXACT = {
    "step": lambda t: 2.0 * (t >= 0.37),
    "pulse": lambda t: ((t - 0.1) % 0.3 < 0.06) & (t > 0.1),
    "few": lambda t: ((t - 0.15) % 0.3 < 0.06) & (t > 0.15) & (t < 0.7),
    "saw": lambda t: 3.0 * (t % 0.3) / 0.3,
    "trapezoid": trapezoid,
    "truth": lambda t: ((t - 0.2) % 0.4 < 0.1) & (t > 0.2),
    "table": lambda t: np.where(t % 0.8 < 0.5, 1, -4),
    "cosine": lambda t: np.where(t > 0.4, np.cos(2 * np.pi * 1.3 * (t - 0.4)), 0),
}


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Sources())


@pytest.mark.machines
def test_sources_in_models_with_events(system):
    ts = np.arange(0.005, 2.0, 0.01)
    sol = ac.simulate(system, (0.0, 2.0), saveat=ts, rtol=1e-9, atol=1e-10)
    fine = (np.arange(400_000) + 0.5) * 5e-6
    for name, exact in EXACT.items():
        np.testing.assert_allclose(sol[f"{name}.y"], exact(ts), atol=1e-9, err_msg=name)
        whole = float(np.sum(np.asarray(exact(fine), float))) * 5e-6
        last = float(sol[f"{name}Integral.y"][-1]) + 0.005 * float(exact(ts[-1]))
        assert last == pytest.approx(whole, abs=2e-4), name
    np.testing.assert_array_equal(sol["nearest.y"], np.round(2.2 * np.sin(np.pi * ts)))
    np.testing.assert_array_equal(sol["pulse.count"], np.floor((ts - 0.1) / 0.3))
    np.testing.assert_allclose(
        sol["pulse.T_start"], 0.1 + 0.3 * np.floor((ts - 0.1) / 0.3), atol=1e-12
    )


class Pulses(ac.Component):
    """A step and pulses whose edges never coincide, their integrals, and a clock."""

    n = ac.Discrete(0, kind="int")

    def __init__(self) -> None:
        super().__init__()
        self.step, self.stepIntegral = blocks.Step(startTime=0.37, height=2.0), blocks.Integrator()
        self.pulse, self.pulseIntegral = (
            blocks.Pulse(period=0.3, width=20.0, startTime=0.1),
            blocks.Integrator(),
        )
        self.connect(self.step.y, self.stepIntegral.u)
        self.connect(self.pulse.y, self.pulseIntegral.u)

    def equations(self):
        yield ac.When(ac.sample(0.25, 0.5), ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
def test_times_of_jumps_have_gradients():
    system = ac.compile(Pulses())
    params = system.parameters()

    def integrals(moved):
        sol = ac.simulate(system, (0.0, 2.0), saveat=[2.0], params=params | moved)
        return sol["stepIntegral.y"][-1], sol["pulseIntegral.y"][-1]

    names = ("step.startTime", "pulse.width", "pulse.period")
    step, pulse = jax.jacrev(integrals)({n: params[n] for n in names})
    n_pulses = 7  # at 0.1, 0.4, ..., 1.9
    assert float(step["step.startTime"]) == pytest.approx(-2.0, abs=1e-9)
    assert float(pulse["pulse.width"]) == pytest.approx(n_pulses * 0.3 / 100, abs=1e-9)
    assert float(pulse["pulse.period"]) == pytest.approx(n_pulses * 0.2, abs=1e-9)


class Tables(ac.Component):
    """Tables over time, their integrals, and a clock."""

    n = ac.Discrete(0, kind="int")

    def __init__(self) -> None:
        super().__init__()
        ramp = [[0, 1], [1, 1], [1.23, 0], [9, 0]]
        steps = [[0, 1], [0.7, 1], [0.7, 3], [1.1, 2], [2, 2]]
        self.bent = blocks.TimeTable(table=ramp, shiftTime=0.5, startTime=0.1)
        self.held = blocks.CombiTimeTable(
            table=[[0.5, 1], [1.5, 2]], extrapolation="HoldLastPoint", timeScale=0.5
        )
        self.some = blocks.CombiTimeTable(table=steps, timeEvents="AtDiscontinuities")
        self.none = blocks.CombiTimeTable(table=steps, timeEvents="NoTimeEvents")
        self.constant = blocks.CombiTimeTable(
            table=[[0, 1, 4], [0.31, 1, 4], [0.62, 1, 5]], smoothness="ConstantSegments"
        )
        self.integral = blocks.Integrator()
        self.connect(self.bent.y, self.integral.u)

    def equations(self):
        yield ac.When(ac.sample(5, 5), ac.Eq(self.n, ac.pre(self.n) + 1))


@pytest.mark.slow
def test_steps_end_at_jumps_and_corners_of_tables():
    run = ac.simulate(ac.compile(Tables()), 2.0, saveat=[2.0])
    times = {
        name: [round(e.t, 12) for e in run.events if e.component == name]
        for name in ("bent", "held", "some", "none", "constant")
    }
    assert times == {
        "bent": [0.1, 1.5, 1.73],
        "held": [0.25, 0.75],
        "some": [0.7],
        "none": [],
        "constant": [0.62],
    }
    assert run["integral.y"][0] == pytest.approx(1.4 + 0.23 / 2, abs=1e-12)
    assert "none.passed" not in run.names


def test_without_other_events_sources_have_none():
    class Plain(ac.Component):
        def __init__(self):
            super().__init__()
            self.pulse, self.table = blocks.Pulse(period=0.3), blocks.BooleanTable()
            self.compare, self.nearest = blocks.Greater(), blocks.RealToInteger()

    assert not len(flatten(Plain()).discrete)


class Averages(ac.Component):
    """Means, root mean squares and distortions of a wave, integrators with a reset, extrema."""

    def __init__(self) -> None:
        super().__init__()
        self.fundamental = blocks.Sine(f=2.0, amplitude=2.0, phase=0.4, offset=0.5)
        self.third = blocks.Sine(f=6.0, amplitude=0.6)
        self.wave = blocks.Add()
        self.mean, self.rectified = blocks.Mean(f=2.0), blocks.RectifiedMean(f=2.0)
        self.rms, self.harmonic = blocks.RootMeanSquare(f=2.0), blocks.Harmonic(f=2.0, k=3)
        self.thd = blocks.TotalHarmonicDistortion(f=2.0)
        self.extrema = blocks.ContinuousSignalExtrema(T=1e-4)
        self.sampled = blocks.SignalExtrema(Ts=0.1)
        self.connect(self.fundamental.y, self.wave.u1)
        self.connect(self.third.y, self.wave.u2)
        for part in (self.mean, self.rms, self.harmonic, self.extrema, self.sampled):
            self.connect(self.wave.y, part.u)
        self.connect(self.fundamental.y, self.rectified.u)
        self.without_offset = blocks.Add(k2=-1)
        self.half = blocks.Constant(k=0.5)
        self.connect(self.wave.y, self.without_offset.u1)
        self.connect(self.half.y, self.without_offset.u2)
        self.connect(self.without_offset.y, self.thd.u)
        self.one, self.pulse = blocks.Constant(k=1.0), blocks.BooleanPulse(period=0.4)
        self.back = blocks.Integrator(use_reset=True, y_start=0.1)
        self.set = blocks.LimIntegrator(use_reset=True, use_set=True, outMax=0.35)
        for integrator in (self.back, self.set):
            self.connect(self.one.y, integrator.u)
            self.connect(self.pulse.y, integrator.reset)
        self.connect(self.wave.y, self.set.set)


@pytest.mark.machines
def test_means_over_periods_and_resets():
    ts = np.array([0.25, 0.45, 0.6, 0.9, 1.1])
    sol = ac.simulate(ac.compile(Averages()), (0.0, 1.2), saveat=ts, rtol=1e-9, atol=1e-11)
    later = ts > 0.5
    np.testing.assert_allclose(sol["mean.y"], np.where(later, 0.5, 0), atol=1e-8)
    fine = (np.arange(100_000) + 0.5) / 200_000
    wave = 0.5 + 2 * np.sin(4 * np.pi * fine + 0.4)
    np.testing.assert_allclose(
        sol["rectified.y"], np.where(later, np.abs(wave).mean(), 0), atol=1e-6
    )
    np.testing.assert_allclose(
        sol["rms.y"], np.where(later, np.sqrt(0.25 + 2 + 0.18), 0), atol=1e-7
    )
    np.testing.assert_allclose(sol["harmonic.y_rms"], np.where(later, 0.6 / 2**0.5, 0), atol=1e-7)
    np.testing.assert_allclose(sol["harmonic.y_arg"][later], np.pi / 2, atol=1e-6)
    np.testing.assert_allclose(sol["thd.y"][later], 0.3, atol=1e-6)
    np.testing.assert_array_equal(sol["thd.valid"], later)

    phase = ts % 0.4
    np.testing.assert_allclose(sol["back.y"], 0.1 + phase, atol=1e-8)

    def u(t):
        return 0.5 + 2 * np.sin(4 * np.pi * t + 0.4) + 0.6 * np.sin(12 * np.pi * t)

    first = np.clip(u(ts - phase), -0.35, 0.35)
    limited = np.where(ts < 0.4, np.minimum(ts, 0.35), np.minimum(first + phase, 0.35))
    np.testing.assert_allclose(sol["set.y"], limited, atol=1e-6)

    dense = np.linspace(0, 1.1, 110_001)
    assert float(sol["extrema.y_max"][-1]) == pytest.approx(u(dense).max(), abs=1e-4)
    assert float(sol["extrema.y_min"][-1]) == pytest.approx(u(dense).min(), abs=1e-4)
    samples = 0.1 * np.arange(12)
    assert float(sol["sampled.y_max"][-1]) == pytest.approx(u(samples).max(), abs=1e-9)
    assert float(sol["sampled.t_min"][-1]) == pytest.approx(samples[u(samples).argmin()], abs=1e-9)
