"""Battery elements: declarations, diffusion into a sphere, resistances, and where the power goes."""

import inspect
from itertools import pairwise

import jax
import numpy as np
import pytest

import acausal as ac
from acausal.components import battery, electrical as el, nature, thermal
from acausal.flattening.flat_model import flatten

Q, TAU, T_REF = 3600.0, 900.0, 298.15


def minimal(cls, **given):
    """An instance with the value 1 for all that must be given."""
    declared = cls._declared.items()
    needed = {n: 1.0 for n, d in declared if isinstance(d, ac.Parameter) and d.default is None}
    return cls(**{**needed, **given})


CONCRETE = [n for n in battery.__all__ if not n.startswith(("Partial", "ChargePort"))]


@pytest.mark.parametrize("name", CONCRETE)
def test_every_class_is_documented_and_has_as_many_equations_as_unknowns(name):
    assert inspect.getdoc(getattr(battery, name))
    model = flatten(minimal(getattr(battery, name)))
    assert model.n_equations == model.n_variables - len(model.inputs)


class Cell(ac.Component):
    """A cell of all elements in a room, charged by a given current."""

    def __init__(self, n=3):
        super().__init__()
        hot = {"useHeatPort": True}
        self.source, self.ground = el.SignalCurrent(), el.Ground()
        self.ocv = battery.OpenCircuitVoltage(**hot)
        self.transfer = battery.ChargeTransfer(I_0=2.0, E_a=50e3, **hot)
        self.resistance = battery.SeriesResistance(R=0.02, E_a=15e3, **hot)
        self.relaxation = battery.Relaxation(R=0.03, tau=60.0, learned=False, **hot)
        self.particle = battery.Particle(Q=Q, tau=TAU, n=n, E_a=30e3, soc_start=0.6, **hot)
        self.body = thermal.HeatCapacitor(C=50.0, T=ac.Start(310.0, fixed=True))
        series = (self.relaxation, self.transfer, self.resistance, self.ocv)
        for upper, lower in pairwise(series):
            self.connect(upper.n, lower.p)
        self.connect(self.source.n, self.relaxation.p)
        self.connect(self.ocv.n, self.source.p, self.ground.p)
        self.connect(self.ocv.surface, self.particle.surface)
        self.connect(self.particle.soc, self.ocv.soc)
        self.connect(self.ocv.soc_surface, self.transfer.soc, self.resistance.soc)
        parts = (*series, self.particle)
        self.connect(self.body.port, *(element.heatPort for element in parts))


@pytest.fixture(scope="module")
def system():
    return ac.compile(Cell())


@pytest.fixture(scope="module")
def run(system):
    """A discharge and a charge."""
    params = system.parameters(1)

    def current(t):
        return -2.0 * jax.numpy.sin(t / 200.0)

    inputs = {"source.i": current}
    return ac.simulate(system, (0.0, 1200.0), dt=1.0, inputs=inputs, params=params)


@pytest.mark.slow
def test_current_counts_charge(run):
    counted = 0.6 - 400.0 / Q * (1 - np.cos(np.asarray(run.t) / 200.0))
    assert np.asarray(run["particle.soc"]) == pytest.approx(counted, abs=1e-9)


@pytest.mark.slow
def test_what_goes_in_is_stored_or_lost(run):
    """Power in, less heat, is the rate of the energy at the mean charge: ``i (U - T dU/dT)``."""
    power = np.asarray(run["source.i"]) * -np.asarray(run["source.v"])
    heat = 50.0 * np.asarray(run["body.der_T"])
    entropy = np.asarray(jax.vmap(run.system.parameters(1)["ocv.entropy"])(run["particle.soc"]))
    T = np.asarray(run["body.T"])
    stored = np.asarray(run["source.i"]) * (np.asarray(run["ocv.U_mean"]) - T * entropy)
    v = np.asarray(run["relaxation.v"])
    held = v * (np.asarray(run["source.i"]) - v / np.asarray(run["relaxation.R_actual"]))
    assert power == pytest.approx(stored + heat + held, abs=1e-6)


def test_losses_heat(run):
    for name in ("transfer", "resistance", "relaxation"):
        assert np.all(np.asarray(run[f"{name}.LossPower"]) >= 0)


def test_at_rest_the_voltage_is_that_of_the_charge(system):
    params = system.parameters(2)
    x = system.initial_state(params)
    u = np.zeros(1)
    volts, mean = system.observe(["ocv.v", "ocv.U_mean"], 0.0, x, u, params)
    outside = system.observe("source.v", 0.0, x, u, params)
    assert float(volts) == pytest.approx(float(mean), abs=1e-12)
    assert float(outside) == pytest.approx(-float(volts), abs=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_the_open_circuit_voltage_rises_whatever_the_weights(seed):
    net = battery.OpenCircuitVoltage()._fresh(jax.random.key(seed))
    wild = jax.tree.map(lambda w: 3 * w if isinstance(w, jax.Array) else w, net)
    soc = np.linspace(-0.2, 1.2, 141)
    assert np.all(np.diff(jax.vmap(wild)(soc)) >= 0)


class Sphere(ac.Component):
    """A particle that is charged by a constant current."""

    def __init__(self, n):
        super().__init__()
        self.inflow = Inflow()
        self.particle = battery.Particle(Q=Q, tau=TAU, n=n, learned=False, soc_start=0.2)
        self.connect(self.inflow.port, self.particle.surface)


class Inflow(ac.Component):
    """A constant charging current."""

    port = battery.ChargePort()

    def equations(self):
        yield ac.Eq(self.port.i, -1.0)


@pytest.mark.slow
def test_a_constant_current_leaves_a_parabola_in_the_sphere():
    """Surface less mean is ``tau i/(15 Q)`` after a while (J. Crank: The mathematics of diffusion, 1975)."""
    lead = {}
    for n in (4, 24):
        system = ac.compile(Sphere(n))
        x = ac.simulate(system, (0.0, 600.0), dt=0.2 if n == 24 else 1.0)
        surface = np.asarray(x[f"particle.shell[{n}].soc"])[-1]
        lead[n] = surface - float(x["particle.soc"][-1])
        assert float(x["particle.soc"][-1]) == pytest.approx(0.2 + 600 / Q, rel=1e-9)
    exact = TAU / (15 * Q)
    assert lead[24] == pytest.approx(exact, rel=5e-3)
    assert lead[4] == pytest.approx(exact, rel=0.1)


class Bench(ac.Component):
    """Resistive elements in series, each at its own temperature."""

    def __init__(self):
        super().__init__()
        self.source, self.ground = el.ConstantCurrent(I=-3.0), el.Ground()
        self.cold = battery.SeriesResistance(R=0.1, E_a=20e3, T=278.15, learned=False)
        self.warm = battery.SeriesResistance(R=0.1, E_a=20e3, learned=False)
        self.slow = battery.ChargeTransfer(I_0=1e3, learned=False)
        self.fast = battery.ChargeTransfer(I_0=1e-3, learned=False)
        self.late = battery.Relaxation(R=0.2, tau=10.0, learned=False)
        parts = (self.cold, self.warm, self.slow, self.fast, self.late)
        for upper, lower in pairwise(parts):
            self.connect(upper.n, lower.p)
        self.connect(self.source.p, self.cold.p)
        self.connect(self.late.n, self.source.n, self.ground.p)


def test_resistances_follow_their_formulas():
    system = ac.compile(Bench())
    assert not system.inputs
    done = ac.simulate(system, (0.0, 20.0), dt=0.1)
    volts = {n: float(done[f"{n}.v"][-1]) for n in ("cold", "warm", "slow", "fast", "late")}
    thermal_volts = nature.R * T_REF / nature.F
    factor = np.exp(20e3 / nature.R * (1 / 278.15 - 1 / T_REF))
    assert volts["warm"] == pytest.approx(0.3)
    assert volts["cold"] == pytest.approx(0.3 * factor)
    assert volts["slow"] == pytest.approx(thermal_volts * 3 / 1e3, rel=1e-6)
    assert volts["fast"] == pytest.approx(2 * thermal_volts * np.log(3 / 1e-3), rel=1e-6)
    assert volts["late"] == pytest.approx(0.6 * (1 - np.exp(-2)), rel=1e-3)
