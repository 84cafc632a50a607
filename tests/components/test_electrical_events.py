"""Electrical elements with events, against what can be calculated by hand."""

from typing import Any

import jax
import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal.components import blocks, electrical as el

OMEGA = 2 * np.pi * 50


class Circuit(ac.Component):
    """Parts with a ground; a net is a line of the pins and signals that it joins."""

    def __init__(self, *nets: str, **parts: ac.Component) -> None:
        super().__init__()
        for name, part in {**parts, "ground": el.Ground()}.items():
            setattr(self, name, part)
        for net in nets:
            self.connect(*(self._end(path) for path in net.split()))

    def _end(self, path: str) -> Any:
        end: Any = self
        for name in path.split("."):
            end = getattr(end, name)
        return end


def bridge(*nets: str, **parts: ac.Component) -> Circuit:
    """A full bridge of ideal diodes behind 10 V, 50 Hz, with a load of 10 Ohm."""
    diodes = {f"d{k}": el.IdealDiode(Ron=1e-3) for k in range(1, 5)}
    return Circuit(
        "source.p d1.p d2.n",
        "source.n d3.p d4.n",
        "d1.n d3.n load.p",
        "d2.p d4.p load.n ground.p",
        *nets,
        source=el.SineVoltage(V=10, f=50),
        load=el.Resistor(R=10),
        **diodes,
        **parts,
    )


# -- diodes and thyristors ---------------------------------------------------------------------------


@pytest.mark.slow
def test_a_bridge_rectifies() -> None:
    ts = np.linspace(0, 0.04, 81)
    found = ac.simulate(ac.compile(bridge()), (0.0, 0.04), saveat=ts)
    assert np.asarray(found["load.v"]) == pytest.approx(10 * abs(np.sin(OMEGA * ts)), abs=2.1e-3)
    assert [e.t for e in found.events][1:] == pytest.approx([0.01, 0.02, 0.03])
    inside = np.sin(OMEGA * ts) > 1e-9
    assert (np.asarray(found["d1.off"])[inside] == 0).all()
    assert (np.asarray(found["d3.off"])[inside] == 1).all()


@pytest.mark.machines
def test_a_bridge_charges_a_capacitor() -> None:
    smoothing = el.Capacitor(C=1e-3, v=ac.Start(0.0, fixed=True))
    model = bridge("c.p load.p", "c.n load.n", c=smoothing)
    ts = np.linspace(0, 0.02, 201)
    found = ac.simulate(ac.compile(model), (0.0, 0.02), saveat=ts, rtol=1e-8, atol=1e-10)
    # the current into capacitor and load ends where tan(wt) = -w R C, and begins where the sine meets the discharge
    end = (np.pi - np.arctan(OMEGA * 10 * 1e-3)) / OMEGA
    last = 10 * np.sin(OMEGA * end)
    begin = brentq(
        lambda t: last * np.exp(-(t - end) / 0.01) - 10 * abs(np.sin(OMEGA * t)), 0.0101, 0.0149
    )
    assert [e.t for e in found.events][1:3] == pytest.approx([end, begin], abs=2e-5)
    free = (ts > end) & (ts < begin)
    wanted = np.where(free, last * np.exp(-(ts - end) / 0.01), 10 * abs(np.sin(OMEGA * ts)))
    early = ts < 0.015
    assert np.asarray(found["load.v"])[early] == pytest.approx(wanted[early], abs=0.02)


def fired(time: float, period: float = 1.0) -> blocks.BooleanPulse:
    """A short pulse in every period."""
    return blocks.BooleanPulse(width=1, period=period, startTime=time)


@pytest.mark.slow
def test_a_thyristor_conducts_from_its_firing_until_the_current_vanishes() -> None:
    model = Circuit(
        "source.p thyristor.p",
        "thyristor.n load.p",
        "source.n load.n ground.p",
        "gate.y thyristor.fire",
        source=el.SineVoltage(V=10, f=1),
        load=el.Resistor(R=1),
        thyristor=el.IdealThyristor(),
        gate=fired(0.125),
    )
    found = ac.simulate(ac.compile(model), (0.0, 1.5), saveat=np.linspace(0, 1.5, 301))
    ts, off = np.asarray(found.t), np.asarray(found["thyristor.off"])
    conducts = ((ts > 0.126) & (ts < 0.499)) | ((ts > 1.126) & (ts < 1.499))
    blocks_ = (ts < 0.124) | ((ts > 0.501) & (ts < 1.124))
    assert (off[conducts] == 0).all()
    assert (off[blocks_] == 1).all()


@pytest.mark.machines
def test_a_triac_conducts_in_both_directions() -> None:
    model = Circuit(
        "source.p triac.n",
        "triac.p load.p",
        "source.n load.n ground.p",
        "gate.y triac.fire1",
        source=el.SineVoltage(V=10, f=1),
        load=el.Resistor(R=1),
        triac=el.IdealTriac(Cdis=1e-6, Vknee=0.5),
        gate=fired(0.25, period=0.5),
    )
    found = ac.simulate(ac.compile(model), (0.0, 1.0), saveat=[0.2, 0.3, 0.45, 0.6, 0.8, 0.95])
    sine = 10 * np.sin(2 * np.pi * np.asarray(found.t))
    wanted = np.where([False, True, True, False, True, True], sine - 0.5 * np.sign(sine), 0)
    assert np.asarray(found["load.v"]) == pytest.approx(wanted, abs=2e-3)


# -- switches ----------------------------------------------------------------------------------------


def arc(switch: el.IdealSwitchWithArc) -> Circuit:
    """An inductor at 50 V, which a contact with an arc separates for the second half of a second."""
    return Circuit(
        "source.p switch.p",
        "switch.n inductor.p",
        "inductor.n resistor.p",
        "resistor.n source.n ground.p",
        "pulse.y switch.control",
        source=el.ConstantVoltage(V=50),
        inductor=el.Inductor(L=0.1, i=ac.Start(0.0, fixed=True)),
        resistor=el.Resistor(R=1),
        pulse=blocks.BooleanPulse(period=1.0),
        switch=switch,
    )


@pytest.mark.slow
def test_an_arc_burns_until_the_current_is_weak() -> None:
    made = el.CloserWithArc(Ron=1e-9, V0=30, dVdt=1e4, Vmax=60, off=ac.Start(1.0, fixed=True))
    times = np.asarray([0.5, 0.502, 0.6, 0.7])
    found = ac.simulate(ac.compile(arc(made)), (0.0, 0.8), saveat=times, rtol=1e-9, atol=1e-11)
    # L di/dt = 50 - R i - v: with v = 30 + 1e4 s until 60 V, then constant
    start = 50 * (1 - np.exp(-5.0))
    slope = 1e4
    growing = lambda s: 20 + slope * 0.1 - slope * s + (start - 20 - slope * 0.1) * np.exp(-s / 0.1)  # noqa: E731
    at_most = growing(0.003)
    falling = lambda s: -10 + (at_most + 10) * np.exp(-(s - 0.003) / 0.1)  # noqa: E731
    i = np.asarray(found["inductor.i"])
    assert i[:3] == pytest.approx([start, growing(0.002), falling(0.1)], rel=1e-5)
    assert i[3] == pytest.approx(50e-5, rel=1e-3)
    quenched = 0.503 + 0.1 * np.log((at_most + 10) / (10 + 60e-5))
    assert [e.t for e in found.events][-1] == pytest.approx(quenched, abs=1e-5)
    assert np.asarray(found["switch.off"]).tolist() == [1, 1, 1, 1]
    assert np.asarray(found["switch.quenched"]).tolist() == [0, 0, 0, 1]
    assert float(found["switch.tSwitch"][-1]) == pytest.approx(0.5)


@pytest.mark.slow
def test_a_converter_steps_down() -> None:
    """At 10 kHz with half of the time on; the ripple's mean is half of the input."""
    model = Circuit(
        "source.p switch.p",
        "switch.n diode.n inductor.p",
        "inductor.n c.p load.p",
        "source.n diode.p c.n load.n ground.p",
        "pulse.y switch.control",
        source=el.ConstantVoltage(V=20),
        switch=el.IdealClosingSwitch(),
        diode=el.IdealDiode(),
        inductor=el.Inductor(L=1e-3, i=ac.Start(1.0, fixed=True)),
        c=el.Capacitor(C=1e-4, v=ac.Start(10.0, fixed=True)),
        load=el.Resistor(R=10),
        pulse=blocks.BooleanPulse(period=1e-4),
    )
    found = ac.simulate(ac.compile(model), (0.0, 0.02), saveat=np.linspace(0.01, 0.02, 1001))
    assert len(found.events) >= 399
    assert np.mean(np.asarray(found["load.v"])) == pytest.approx(10, abs=0.1)
    i = np.asarray(found["inductor.i"])
    assert np.ptp(i[-100:]) == pytest.approx(10 * 5e-5 / 1e-3, rel=0.05)
    assert np.mean(i[-100:]) == pytest.approx(1, rel=0.05)


# -- amplifiers --------------------------------------------------------------------------------------


def trigger(amplifier: ac.Component, *nets: str, **parts: ac.Component) -> Circuit:
    """A Schmitt trigger with thresholds at +-1 V, at a slow sine of 5 V."""
    return Circuit(
        "amplifier.in_n ground.p source.n",
        "amplifier.out r2.n",
        "r2.p r1.n amplifier.in_p",
        "r1.p source.p",
        *nets,
        source=el.SineVoltage(V=5, f=1, phase=np.pi / 2),
        r1=el.Resistor(R=1e3),
        r2=el.Resistor(R=15e3),
        amplifier=amplifier,
        **parts,
    )


@pytest.mark.parametrize("ideal", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_a_trigger_keeps_its_branch(ideal: bool) -> None:
    if ideal:
        supply = el.SupplyVoltage()
        nets = (
            "supply.pin_p amplifier.VMax",
            "supply.pin_n amplifier.VMin",
            "supply.ground ground.p",
        )
        model = trigger(el.IdealOpAmpLimited(), *nets, supply=supply)
    else:
        model = trigger(el.IdealizedOpAmpLimited(V0=1e6))
    found = ac.simulate(ac.compile(model), (0.0, 2.0), saveat=np.linspace(0, 2, 401))
    down = np.arccos(-0.2) / (2 * np.pi)
    wanted = [down, 0.5 + down, 1 + down, 1.5 + down]
    assert [e.t for e in found.events] == pytest.approx(wanted, abs=1e-5)
    phase = (np.asarray(found.t) - down) % 1
    clear = (abs(phase - 0.5) > 1e-3) & (phase > 1e-3) & (phase < 0.999)
    out = np.asarray(found["amplifier.out.v"])
    assert out[clear] == pytest.approx(np.where(phase < 0.5, -15, 15)[clear])


@pytest.mark.parametrize("gain", [1.5e4, pytest.param(1e6, marks=pytest.mark.slow)])
def test_negative_feedback_leaves_a_limit(gain: float) -> None:
    model = Circuit(
        "source.p r1.p",
        "r1.n r2.p amplifier.in_n",
        "r2.n amplifier.out",
        "amplifier.in_p source.n ground.p",
        source=el.SineVoltage(V=5, f=1),
        r1=el.Resistor(R=1e3),
        r2=el.Resistor(R=6e3),
        amplifier=el.IdealizedOpAmpLimited(V0=gain, homotopyType="UpperLimit"),
    )
    ts = np.linspace(0, 1.2, 241)
    found = ac.simulate(ac.compile(model), (0.0, 1.2), saveat=ts)
    wanted = np.clip(-30 * np.sin(2 * np.pi * ts), -15, 15)
    assert np.asarray(found["amplifier.out.v"]) == pytest.approx(wanted, abs=150 / gain)
    times = np.array([1, 5, 7, 11, 13]) / 12  # where the sine is at half of its amplitude
    assert [e.t for e in found.events] == pytest.approx(times, abs=1 / gain)


# -- many --------------------------------------------------------------------------------------------


class Branches(ac.Component):
    """Diodes in parallel branches, each with a capacitor, at one source."""

    def __init__(self, n: int) -> None:
        super().__init__()
        self.ground, self.source = el.Ground(), el.SineVoltage(V=10, f=50)
        self.connect(self.source.n, self.ground.p)
        for k in range(n):
            parts = (
                el.IdealDiode(Ron=0.1, Vknee=0.5 + k / n),
                el.Capacitor(C=1e-3, v=ac.Start(0.0, fixed=True)),
            )
            for name, part in zip(("diode", "c"), parts, strict=True):
                setattr(self, f"{name}{k}", part)
            self.connect(self.source.p, parts[0].p)
            self.connect(parts[0].n, parts[1].p)
            self.connect(parts[1].n, self.ground.p)


def test_the_program_does_not_grow_with_the_number_of_diodes() -> None:
    sizes: list[int] = []
    for n in (10, 100):
        system = ac.compile(Branches(n))

        def end(voltage: Any, system: ac.System = system) -> Any:
            return ac.simulate(system, 0.04, dt=1e-4, params={"source.V": voltage}).x[-1]

        sizes.append(len(jax.jit(end).lower(1.0).as_text().splitlines()))
    assert sizes[0] == sizes[1]
