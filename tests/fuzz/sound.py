"""Sound models of every domain, as netlist documents: what the mutants are made from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import acausal as ac
from acausal.components import (
    blocks,
    electrical,
    fluid,
    hydraulic,
    magnetic,
    neural,
    rotational,
    thermal,
    translational,
)
from tests.support.parts import endpoint

Document = dict[str, Any]

LIBRARIES = {
    "translational": translational,
    "rotational": rotational,
    "electrical": electrical,
    "thermal": thermal,
    "fluid": fluid,
    "hydraulic": hydraulic,
    "magnetic": magnetic,
    "blocks": blocks,
    "neural": neural,
}
PREFIX = "acausal.components."


def part(cls: str, **given: Any) -> Document:
    """A component; ``cls`` is ``domain.Class``."""
    return {"class": PREFIX + cls, "with": given}


def document(*connections: str, parameters: Document, **components: Document) -> Document:
    """A document; a connection is ``"a.flange_b - b.flange_a"``."""
    pairs = [[end.strip() for end in line.split(" - ")] for line in connections]
    return {"parameters": parameters, "components": components, "connections": pairs}


def start(value: float) -> Document:
    return {"start": value, "fixed": True}


SOUND: dict[str, Document] = {
    "translational": document(
        "wall.flange - spring.flange_a",
        "spring.flange_b - mass.flange_a",
        "mass.flange_b - gap.flange_a",
        "gap.flange_b - second.flange_a",
        "push.y - force.f",
        "force.flange - second.flange_b",
        parameters={"c": 50.0, "d": 2.0},
        wall=part("translational.Fixed", s0=0.5),
        spring=part("translational.SpringDamper", c="c", d="d", s_rel0=0.1),
        mass=part("translational.Mass", m=1.0, L=0.2, s=start(0.7), v=start(0.0)),
        gap=part("translational.Spring", c="2*c"),
        second=part("translational.Mass", m=2.0, s=start(0.9), v=start(0.1)),
        push=part("blocks.Sine", f=0.5, amplitude=3.0),
        force=part("translational.Force"),
    ),
    "rotational": document(
        "drive.flange - motor.flange_a",
        "motor.flange_b - gear.flange_a",
        "gear.flange_b - shaft.flange_a",
        "shaft.flange_b - load.flange_a",
        "load.flange_b - brake.flange_a",
        "brake.flange_b - wall.flange",
        parameters={"J": 0.5, "ratio": 3.0},
        drive=part("rotational.ConstantTorque", tau_constant=2.0),
        motor=part("rotational.Inertia", J="J", phi=start(0.0), w=start(1.0)),
        gear=part("rotational.IdealGear", ratio="ratio"),
        shaft=part("rotational.SpringDamper", c=100.0, d=1.0),
        load=part("rotational.Inertia", J="J*ratio^2", phi=start(0.0), w=start(0.0)),
        brake=part("rotational.Damper", d=0.4),
        wall=part("rotational.Fixed", phi0=0.0),
    ),
    "electrical": document(
        "source.p - resistor.p",
        "resistor.n - coil.p",
        "coil.n - capacitor.p",
        "capacitor.p - load.p",
        "capacitor.n - source.n",
        "load.n - source.n",
        "source.n - ground.p",
        parameters={"R": 10.0, "C": 1e-3},
        source=part("electrical.SineVoltage", V=5.0, f=20.0),
        resistor=part("electrical.Resistor", R="R", T=300.15),
        coil=part("electrical.Inductor", L=0.05, i=start(0.0)),
        capacitor=part("electrical.Capacitor", C="C", v=start(1.0)),
        load=part("electrical.Conductor", G="1/(10*R)"),
        ground=part("electrical.Ground"),
    ),
    "diodes": document(
        "source.p - diode.p",
        "diode.n - resistor.p",
        "resistor.n - capacitor.p",
        "capacitor.n - source.n",
        "source.n - ground.p",
        parameters={"C": 1e-3},
        source=part("electrical.SineVoltage", V=2.0, f=50.0),
        diode=part("electrical.Diode", Ids=1e-6, Vt=0.04, R=1e8),
        resistor=part("electrical.Resistor", R=20.0),
        capacitor=part("electrical.Capacitor", C="C", v=start(0.0)),
        ground=part("electrical.Ground"),
    ),
    "thermal": document(
        "heater.port - plate.port",
        "plate.port - wall.port_a",
        "wall.port_b - room.port",
        "room.port - rays.port_a",
        "rays.port_b - sky.port",
        parameters={"C": 15.0, "T0": 300.0},
        heater=part("thermal.FixedHeatFlow", Q_flow=20.0),
        plate=part("thermal.HeatCapacitor", C="C", T=start(320.0)),
        wall=part("thermal.ThermalConductor", G=0.5),
        room=part("thermal.HeatCapacitor", C="4*C", T=start(295.0)),
        rays=part("thermal.BodyRadiation", Gr=0.01),
        sky=part("thermal.FixedTemperature", T="T0 - 20"),
    ),
    "fluid": document(
        "inlet.flowPort - pump.flowPort_a",
        "pump.flowPort_b - pipe.flowPort_a",
        "pipe.flowPort_b - outlet.flowPort",
        "pipe.heatPort - plate.port",
        "heater.port - plate.port",
        parameters={"TAmb": 293.15, "medium": "Media.Water()"},
        inlet=part(
            "fluid.Ambient",
            constantAmbientTemperature="TAmb",
            constantAmbientPressure=0.0,
            medium="medium",
        ),
        pump=part("fluid.VolumeFlow", constantVolumeFlow=1e-4, m=0.0, T0="TAmb", medium="medium"),
        pipe=part(
            "fluid.Pipe",
            medium="medium",
            m=0.1,
            T0="TAmb",
            T0fixed=True,
            V_flowLaminar=1e-5,
            dpLaminar=10.0,
            V_flowNominal=1e-4,
            dpNominal=1000.0,
            h_g=0.0,
            useHeatPort=True,
        ),
        outlet=part(
            "fluid.Ambient",
            constantAmbientTemperature="TAmb",
            constantAmbientPressure=0.0,
            medium="medium",
        ),
        plate=part("thermal.HeatCapacitor", C=50.0, T={"fixed": False}),
        heater=part("thermal.FixedHeatFlow", Q_flow=20.0),
    ),
    "hydraulic": document(
        "pump.port - upper.topPort",
        "upper.port - hole.port_a",
        "hole.port_b - lower.topPort",
        "lower.port - drain.port_a",
        "drain.port_b - air.port",
        parameters={"A": 0.01},
        pump=part("hydraulic.MassFlowSource", m_flow=0.1),
        upper=part("hydraulic.OpenTank", crossArea="A", level=start(0.3)),
        hole=part("hydraulic.Orifice", area=1e-4),
        lower=part("hydraulic.OpenTank", crossArea="2*A", level=start(0.2)),
        drain=part("hydraulic.LinearResistance", k=1e-4),
        air=part("hydraulic.Boundary", p=0.0),
    ),
    "magnetic": document(
        "source.p - wire.p",
        "wire.n - coil.p",
        "coil.n - source.n",
        "source.n - ground.p",
        "coil.port_p - core.port_p",
        "core.port_n - gap.port_p",
        "gap.port_n - coil.port_n",
        "coil.port_n - earth.port",
        parameters={"N": 600.0},
        source=part("electrical.ConstantVoltage", V=10.0),
        wire=part("electrical.Resistor", R=7.5),
        coil=part("magnetic.ElectroMagneticConverter", N="N", i=start(0.0)),
        core=part("magnetic.ConstantReluctance", R_m=1.2e6),
        gap=part(
            "magnetic.Cuboid", nonLinearPermeability=False, mu_rConst=1.0, l=1e-4, a=0.025, b=0.025
        ),
        earth=part("magnetic.Ground"),
        ground=part("electrical.Ground"),
    ),
    "blocks": document(
        "setpoint.y - error.u1",
        "error.y - controller.u",
        "controller.y - limit.u",
        "limit.y - plant.u",
        "plant.y - filter.u",
        "plant.y - error.u2",
        "mix.u[1] - filter.y",
        "mix.u[2] - plant.y",
        parameters={"T": 0.2},
        setpoint=part("blocks.Step", height=1.0, startTime=0.1),
        error=part("blocks.Feedback"),
        controller=part("blocks.PI", k=2.0, T="T", initType="Init.InitialState", x_start=0.0),
        limit=part("blocks.Limiter", uMax=5.0, uMin=-5.0),
        plant=part("blocks.TransferFunction", b=[1.0], a=["T", 1.0], initType="Init.InitialOutput"),
        filter=part("blocks.LowpassButterworth", f=2.0, n=2),
        mix=part("blocks.Sum", nin=2, k=[1.0, -1.0]),
    ),
    "neural": document(
        "wall.flange - spring.flange_a",
        "wall.flange - damper.flange_a",
        "spring.flange_b - mass.flange_a",
        "damper.flange_b - mass.flange_a",
        "mass.flange_b - push.flange",
        parameters={"m": 1.5},
        wall=part("translational.Fixed"),
        spring=part("neural.Compliance", width=4, depth=1, input_scale=0.1, output_scale=5.0),
        damper=part("neural.Resistance", width=4, depth=1, passive=True),
        mass=part("translational.Mass", m="m", s=start(0.3), v=start(0.0)),
        push=part("translational.ConstantForce", f_constant=1.0),
    ),
    "motor": document(
        "battery.p - armature.p",
        "armature.n - coil.p",
        "coil.n - emf.p",
        "emf.n - battery.n",
        "battery.n - ground.p",
        "emf.flange - rotor.flange_a",
        "rotor.flange_b - friction.flange_a",
        "friction.flange_b - wall.flange",
        "armature.heatPort - housing.port",
        parameters={"k": 0.1},
        battery=part("electrical.ConstantVoltage", V=12.0),
        armature=part("electrical.Resistor", R=0.5, useHeatPort=True, alpha=0.004, T_ref=293.15),
        coil=part("electrical.Inductor", L=1e-2, i=start(0.0)),
        emf=part("electrical.RotationalEMF", k="k"),
        ground=part("electrical.Ground"),
        rotor=part("rotational.Inertia", J=0.01, w=start(0.0), phi=start(0.0)),
        friction=part("rotational.Damper", d=1e-3),
        wall=part("rotational.Fixed"),
        housing=part("thermal.HeatCapacitor", C=100.0, T=start(300.0)),
    ),
}
"""By domain; "diodes" has a nonlinear loop and "motor" three domains."""


def class_of(name: str) -> type[ac.Component]:
    """The class of a document's ``class``."""
    domain, _, cls = name.removeprefix(PREFIX).partition(".")
    return getattr(LIBRARIES[domain], cls)


class Built(ac.Component):
    """A model made by the Python API."""


def plain(document: Mapping[str, Any]) -> Document:
    """The document's parts with numbers in place of its expressions, for the Python API."""
    return {
        name: {
            "class": entry["class"],
            "with": {
                k: VALUES.get(v, v) if isinstance(v, str) else v for k, v in entry["with"].items()
            },
        }
        for name, entry in document["components"].items()
    }


VALUES: dict[str, Any] = {
    "c": 50.0,
    "2*c": 100.0,
    "d": 2.0,
    "J": 0.5,
    "ratio": 3.0,
    "J*ratio^2": 4.5,
    "R": 10.0,
    "C": 1e-3,
    "1/(10*R)": 0.01,
    "4*C": 60.0,
    "T0 - 20": 280.0,
    "TAmb": 293.15,
    "A": 0.01,
    "2*A": 0.02,
    "N": 600.0,
    "T": 0.2,
    "m": 1.5,
    "k": 0.1,
    "Init.InitialState": "InitialState",
    "Init.InitialOutput": "InitialOutput",
}
"""What the documents' expressions come to."""


def argument(value: Any) -> Any:
    """An argument of a class from what the document has there."""
    if isinstance(value, dict):
        return ac.Start(value.get("start"), fixed=value.get("fixed"))
    if isinstance(value, list):
        return [VALUES.get(v, v) if isinstance(v, str) else v for v in value]
    return fluid.Water() if value == "medium" else value


def build(parts: Mapping[str, Any], connections: list[list[str]]) -> ac.Component:
    """The same model by the Python API."""
    made = Built()
    for name, entry in parts.items():
        given = {k: argument(v) for k, v in entry["with"].items()}
        setattr(made, name, class_of(entry["class"])(**given))
    for ends in connections:
        made.connect(*(endpoint(made, end) for end in ends))
    return made
