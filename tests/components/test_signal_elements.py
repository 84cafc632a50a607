"""Elements with signals for flanges, pins and ports: joined by signals they do what their connected twins do."""

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical as el, thermal
from acausal.components.electrical import utilities


class Signals(ac.Component):
    """Two capacities, capacitors and inductors each, joined by signals; and a conductor of each kind between two."""

    def __init__(self):
        super().__init__()
        empty = ac.Start(0.0, fixed=True)
        room = ac.Start(293.15, fixed=True)
        self.watts, self.amperes, self.volts = (blocks.Sine(f=2.0, amplitude=3.0) for _ in range(3))

        self.warm = thermal.DirectCapacity(C=1.0)
        self.cold = thermal.InverseCapacity(C=2.0)
        self.connect(self.watts.y, self.warm.Q_flowDrive)
        self.connect(self.warm.T, self.cold.T)
        self.connect(self.warm.derT, self.cold.derT)
        self.connect(self.cold.Q_flow, self.warm.Q_flow)

        self.direct_c = utilities.DirectCapacitor(C=1.0)
        self.inverse_c = utilities.InverseCapacitor(C=2.0)
        self.connect(self.amperes.y, self.direct_c.iDrive)
        self.connect(self.direct_c.v, self.inverse_c.v)
        self.connect(self.direct_c.dv, self.inverse_c.dv)
        self.connect(self.inverse_c.i, self.direct_c.i)

        self.direct_l = utilities.DirectInductor(L=1.0)
        self.inverse_l = utilities.InverseInductor(L=2.0)
        self.connect(self.volts.y, self.direct_l.vDrive)
        self.connect(self.direct_l.i, self.inverse_l.i)
        self.connect(self.direct_l.di, self.inverse_l.di)
        self.connect(self.inverse_l.v, self.direct_l.v)

        self.hot, self.cool = (
            thermal.HeatCapacitor(C=1.0, T=room),
            thermal.HeatCapacitor(C=2.0, T=room),
        )
        self.source = thermal.PrescribedHeatFlow()
        self.hot_signals = thermal.GeneralHeatFlowToTemperatureAdaptor(use_pder=False)
        self.cool_signals = thermal.GeneralHeatFlowToTemperatureAdaptor(use_pder=False)
        self.conduction = thermal.Conduction(G=4.0)
        self.connect(self.watts.y, self.source.Q_flow)
        self.connect(self.source.port, self.hot.port, self.hot_signals.heatPort)
        self.connect(self.cool.port, self.cool_signals.heatPort)
        self.connect(self.hot_signals.p, self.conduction.T1)
        self.connect(self.conduction.Q_flow1, self.hot_signals.f)
        self.connect(self.cool_signals.p, self.conduction.T2)
        self.connect(self.conduction.Q_flow2, self.cool_signals.f)

        self.left, self.right = el.Capacitor(C=1.0, v=empty), el.Capacitor(C=2.0, v=empty)
        self.current, self.ground = el.SignalCurrent(), el.Ground()
        adaptor = {"use_pder": False, "use_fder": False}
        self.left_signals = el.GeneralCurrentToVoltageAdaptor(**adaptor)
        self.right_signals = el.GeneralCurrentToVoltageAdaptor(**adaptor)
        self.resistor = utilities.Resistor(R=0.25)
        self.connect(self.amperes.y, self.current.i)
        self.connect(self.current.n, self.left.p, self.left_signals.pin_p)
        self.connect(self.right.p, self.right_signals.pin_p)
        self.connect(
            self.ground.p,
            self.current.p,
            self.left.n,
            self.right.n,
            self.left_signals.pin_n,
            self.right_signals.pin_n,
        )
        self.connect(self.left_signals.p, self.resistor.v1)
        self.connect(self.resistor.i1, self.left_signals.f)
        self.connect(self.right_signals.p, self.resistor.v2)
        self.connect(self.resistor.i2, self.right_signals.f)

        self.up, self.down = el.Inductor(L=1.0, i=empty), el.Inductor(L=2.0, i=empty)
        self.voltage, self.ground_l = el.SignalVoltage(), el.Ground()
        self.up_signals = el.GeneralVoltageToCurrentAdaptor(**adaptor)
        self.down_signals = el.GeneralVoltageToCurrentAdaptor(**adaptor)
        self.conductor = utilities.Conductor(G=0.25)
        self.connect(self.volts.y, self.voltage.v)
        self.connect(self.voltage.p, self.up.p)
        self.connect(self.up.n, self.up_signals.pin_p)
        self.connect(self.down.p, self.down_signals.pin_p)
        self.connect(
            self.ground_l.p,
            self.voltage.n,
            self.down.n,
            self.up_signals.pin_n,
            self.down_signals.pin_n,
        )
        self.connect(self.conductor.v1, self.up_signals.p)
        self.connect(self.up_signals.f, self.conductor.i1)
        self.connect(self.conductor.v2, self.down_signals.p)
        self.connect(self.down_signals.f, self.conductor.i2)


@pytest.fixture(scope="module")
def solution():
    system = ac.compile(Signals())
    return ac.simulate(system, (0.0, 1.0), saveat=np.linspace(0, 1, 41), rtol=1e-9, atol=1e-10)


def _sum(t):
    """Integral of the sine, over the sum of both stores."""
    return 3 / (4 * np.pi) * (1 - np.cos(4 * np.pi * t)) / 3


def _difference(t):
    """Of two stores of 1 and 2 with a conductance of 4 between them: d' = 3 sin(4 pi t) - 6 d."""
    w, rate = 4 * np.pi, 6.0
    return 3 / (w**2 + rate**2) * (rate * np.sin(w * t) - w * np.cos(w * t) + w * np.exp(-rate * t))


@pytest.mark.slow
def test_two_stores_joined_by_signals_are_one(solution):
    t = np.asarray(solution.t)
    for name in ("warm.T", "cold.T"):
        np.testing.assert_allclose(solution[name] - 293.15, _sum(t), atol=1e-7, err_msg=name)
    for name in ("direct_c.v", "inverse_c.v", "direct_l.inductor.i", "inverse_l.inductor.i"):
        np.testing.assert_allclose(solution[name], _sum(t), atol=1e-7, err_msg=name)


def test_a_signal_element_conducts_between_two_stores(solution):
    t = np.asarray(solution.t)
    pairs = (("hot.T", "cool.T"), ("left.v", "right.v"))
    for one, other in pairs:
        difference = np.asarray(solution[one]) - np.asarray(solution[other])
        np.testing.assert_allclose(difference, _difference(t), atol=1e-7, err_msg=one)


def test_a_signal_conductor_stands_between_two_inductors(solution):
    t = np.asarray(solution.t)
    upper, lower = np.asarray(solution["up.i"]), np.asarray(solution["down.i"])
    np.testing.assert_allclose(upper - lower, _difference(t), atol=1e-7)
    np.testing.assert_allclose(upper + 2 * lower, 3 * _sum(t), atol=1e-7)
    np.testing.assert_allclose(solution["conductor.v1"], 4 * (upper - lower), atol=1e-7)
