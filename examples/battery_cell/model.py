"""A cell of connected components: open-circuit voltage, diffusion, kinetics, resistances, heat."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import acausal as ac
from acausal.components import battery, electrical as el, thermal
from examples.battery_cell.laws import RisingSteps

INPUTS = CURRENT, AMBIENT, START = "source.i", "ambient.T", "soc_guess"
TARGETS = VOLTAGE, TEMPERATURE = "voltmeter.v", "case.T"
NETS = ("ocv.net", "ocv.entropy", "resistance.net", "particle.diffusion[1].net")
"""The learned laws: over charge, that of the resistance and of the diffusion over temperature, too."""


def build() -> ac.System:
    """The compiled cell."""
    return ac.compile(Cell(soc_start=0.0, warmth_start=0.0))


class Cell(ac.Component):
    """A cell, charged by a given current in a chamber of a given temperature.

    The surfaces of the particles meet the electrolyte: their state of charge gives the open-circuit voltage. A slow
    reservoir, where the anode's coating overhangs the cathode's, exchanges charge with them within hours.
    """

    soc_guess = ac.Input(unit="1", doc="state of charge that the first voltage tells")
    soc_start = ac.Parameter(0.0, unit="1", doc="state of charge at the start above the guess")
    overhang_start = ac.Parameter(0.3, unit="1", doc="state of charge of the overhang at the start")
    warmth_start = ac.Parameter(0.0, unit="K", doc="temperature above the ambient at the start")

    def __init__(self, **modifiers: Any) -> None:
        super().__init__(**modifiers)
        hot: dict[str, Any] = {"useHeatPort": True}
        at_start = ac.Start(self.overhang_start, fixed=True)
        self.source, self.ground = el.SignalCurrent(), el.Ground()
        self.voltmeter = el.VoltageSensor()
        self.ocv = battery.OpenCircuitVoltage(net=_curve, **hot)
        self.transfer = battery.ChargeTransfer(I_0=30.0, E_a=50e3, learned=False, **hot)
        self.resistance = battery.SeriesResistance(R=1.2e-3, E_a=12e3, width=4, **hot)
        self.relaxation = battery.Relaxation(R=2e-3, tau=120.0, E_a=10e3, learned=False, **hot)
        self.fast = battery.Relaxation(R=3e-4, tau=10.0, E_a=20e3, learned=False, **hot)
        self.particle = battery.Particle(
            Q=31.0 * 3600, tau=600.0, E_a=33e3, n=2, fixed_start=False, **hot
        )
        self.overhang = battery.ChargeStorage(Q=1.0 * 3600, soc=at_start)
        self.creep = battery.Diffusion(Q=1.0 * 3600, tau=3e4, E_a=25e3, learned=False, **hot)
        self.core, self.case = thermal.HeatCapacitor(C=700.0), thermal.HeatCapacitor(C=100.0)
        self.conduction = thermal.ThermalConductor(G=4.0)
        self.convection, self.ambient = (
            thermal.ThermalConductor(G=0.6),
            thermal.PrescribedTemperature(),
        )
        self._connect_circuit()
        self._connect_charge_and_heat()

    def _connect_circuit(self) -> None:
        chain = (self.relaxation, self.fast, self.transfer, self.resistance, self.ocv)
        self.connect(self.source.n, chain[0].p)
        for upper, lower in pairwise(chain):
            self.connect(upper.n, lower.p)
        self.connect(self.ocv.n, self.source.p, self.ground.p, self.voltmeter.n)
        self.connect(self.source.n, self.voltmeter.p)

    def _connect_charge_and_heat(self) -> None:
        self.connect(self.ocv.surface, self.particle.surface, self.creep.port_a)
        self.connect(self.creep.port_b, self.overhang.port)
        self.connect(self.particle.soc, self.ocv.soc)
        self.connect(self.ocv.soc_surface, self.resistance.soc)
        heated = (
            *(self.ocv, self.transfer, self.resistance),
            *(self.relaxation, self.fast, self.particle),
        )
        self.connect(self.core.port, self.conduction.port_a, self.creep.heatPort)
        self.connect(self.core.port, *(element.heatPort for element in heated))
        self.connect(self.conduction.port_b, self.case.port, self.convection.port_a)
        self.connect(self.convection.port_b, self.ambient.port)

    def initial_equations(self) -> Iterator[ac.Eq]:
        """The cell starts at rest, near the temperature of the chamber."""
        for mass in (self.core, self.case):
            yield ac.Eq(mass.T, self.ambient.T + self.warmth_start)
        for shell in self.particle.shell:
            yield ac.Eq(shell.soc, self.soc_guess + self.soc_start)


def _curve(key: Any) -> RisingSteps:
    return RisingSteps(key=key)
