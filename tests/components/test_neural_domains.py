"""In every domain a neural element learns, inside a circuit of library components, a law that it does not know."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.components import (
    electrical,
    fluid,
    magnetic,
    neural,
    rotational,
    thermal,
    translational as tl,
)
from acausal.networks import law_of
from tests.support.slow import some_slow

STEPS = 200


class Known(eqx.Module):
    """A law or an energy that is known."""

    law: Callable[[Any], Any] = eqx.field(static=True)

    def __call__(self, x: Any) -> Any:
        return self.law(x)


class Loop(ac.Component):
    """Parts of one circuit; ``nodes`` name the connectors that meet."""

    def __init__(self, nodes: Sequence[Sequence[str]], **parts: ac.Component) -> None:
        super().__init__()
        for name, part in parts.items():
            setattr(self, name, part)
        for node in nodes:
            ends = [name.split(".") for name in node]
            self.connect(*(getattr(parts[part], end) for part, end in ends))


def sledge(element: ac.Component) -> Loop:
    """A mass that is pushed over a dry and viscous ground."""
    nodes = [("push.flange", "mass.flange_a"), ("mass.flange_b", "element.flange_b")]
    nodes.append(("element.flange_a", "ground.flange"))
    return Loop(nodes, push=tl.Force(), mass=tl.Mass(m=2.0), element=element, ground=tl.Fixed())


def pendulum(element: ac.Component) -> Loop:
    """An inertia on a spring that is not linear, and a damper."""
    parts = {"push": rotational.Torque(), "inertia": rotational.Inertia(J=0.5)}
    damper, wall = rotational.Damper(d=0.6), rotational.Fixed()
    nodes = [
        ("push.flange", "inertia.flange_a"),
        ("inertia.flange_b", "element.flange_b", "damper.flange_b"),
        ("wall.flange", "element.flange_a", "damper.flange_a"),
    ]
    return Loop(nodes, **parts, element=element, damper=damper, wall=wall)


def coil(element: ac.Component) -> Loop:
    """A coil whose iron saturates, behind a resistor."""
    nodes = [("source.p", "resistor.p"), ("resistor.n", "element.p")]
    nodes.append(("element.n", "source.n", "ground.p"))
    source, resistor = electrical.SignalVoltage(), electrical.Resistor(R=2.0)
    return Loop(
        nodes, source=source, resistor=resistor, element=element, ground=electrical.Ground()
    )


def core(element: ac.Component) -> Loop:
    """A core of unknown permeance in a winding of a hundred turns."""
    nodes = [
        ("source.p", "resistor.p"),
        ("resistor.n", "winding.p"),
        ("winding.n", "source.n", "ground.p"),
        ("winding.port_p", "element.port_p"),
        ("winding.port_n", "element.port_n", "reference.port"),
    ]
    return Loop(
        nodes,
        source=electrical.SignalVoltage(),
        resistor=electrical.Resistor(R=2.0),
        winding=magnetic.ElectroMagneticConverter(N=100.0),
        ground=electrical.Ground(),
        element=element,
        reference=magnetic.Ground(),
    )


def oven(element: ac.Component) -> Loop:
    """A heated body that loses heat to its surroundings."""
    nodes = [("heater.port", "body.port", "element.port_a"), ("element.port_b", "room.port")]
    body = thermal.HeatCapacitor(C=5.0, T=ac.Start(300.0, fixed=True))
    room = thermal.FixedTemperature(T=300.0)
    return Loop(nodes, heater=thermal.PrescribedHeatFlow(), body=body, element=element, room=room)


def tank(element: ac.Component) -> Loop:
    """A tank that a pump fills and that runs out at its bottom."""
    water = fluid.Water()
    nodes = [
        ("well.flowPort", "pump.flowPort_a"),
        ("pump.flowPort_b", "tank.flowPort", "element.flowPort_a"),
        ("element.flowPort_b", "drain.flowPort"),
    ]
    return Loop(
        nodes,
        well=fluid.Ambient(medium=water),
        pump=fluid.VolumeFlow(medium=water, m=0.0, useVolumeFlowInput=True),
        tank=fluid.OpenTank(medium=water, ATank=0.05, hTank=2.0, level=ac.Start(0.5, fixed=True)),
        element=element,
        drain=fluid.Ambient(medium=water),
    )


@dataclass(frozen=True)
class Case:
    """A circuit around an element, what drives and what is measured, and the law to learn.

    Attributes:
        end: of the record [s]. swing: of the input around ``offset``.
        true: the law or energy, of a physical input.
    """

    circuit: Callable[[ac.Component], ac.Component]
    element: Callable[..., ac.Component]
    inputs: str
    target: str
    true: Callable[[Any], Any]
    options: dict[str, Any]
    end: float
    swing: float
    offset: float = 0.0


CASES = {
    "translational": Case(
        sledge,
        neural.Resistance,
        "push.f",
        "mass.v",
        lambda v: 4 * jnp.tanh(v / 0.2) + 3 * v,
        {"passive": True, "odd": True, "input_scale": 0.5, "output_scale": 5.0},
        end=6.0,
        swing=10.0,
    ),
    "rotational": Case(
        pendulum,
        lambda **given: neural.Compliance(rotational.Flange, **given),
        "push.tau",
        "inertia.phi",
        lambda phi: 4 * phi + 3 * phi**3,
        {"monotone": True, "zero_crossing": "exact", "output_scale": 5.0},
        end=8.0,
        swing=3.0,
    ),
    "electrical": Case(
        coil,
        lambda **given: neural.Inductance(electrical.Pin, **given),
        "source.v",
        "element.i",
        lambda i: jnp.log(jnp.cosh(i)) + 0.05 * i**2,
        {"odd": True},
        end=6.0,
        swing=4.0,
    ),
    "magnetic": Case(
        core,
        lambda **given: neural.Resistance(magnetic.MagneticPort, **given),
        "source.v",
        "winding.i",
        lambda V_m: 0.01 * jnp.tanh(V_m / 100) + 1e-5 * V_m,
        {"monotone": True, "odd": True, "floor": 0.01, "input_scale": 100.0, "output_scale": 0.01,
         "activation": "tanh"},
        end=6.0,
        swing=4.0,
    ),
    "thermal": Case(
        oven,
        lambda **given: neural.Resistance(thermal.HeatPort, **given),
        "heater.Q_flow",
        "body.T",
        lambda dT: 0.4 * dT * (1 + dT / 40),
        {"passive": True, "input_scale": 20.0, "output_scale": 20.0},
        end=60.0,
        swing=12.0,
        offset=15.0,
    ),
    "fluid": Case(
        tank,
        lambda **given: neural.Resistance(fluid.FlowPort, **given),
        "pump.volumeFlow",
        "tank.level",
        lambda dp: 3.0 * dp / (dp**2 + 2000.0**2) ** 0.25 / 100,
        {"monotone": True, "zero_crossing": "exact", "input_scale": 1e4, "output_scale": 3.0},
        end=90.0,
        swing=0.002,
        offset=0.002,
    ),
}  # fmt: skip


def push(case: Case, t: np.ndarray) -> np.ndarray:
    """A slow and a quicker sine."""
    w = 2 * np.pi / case.end
    return case.offset + case.swing * (0.6 * np.sin(2 * w * t) + 0.4 * np.sin(7 * w * t + 0.3))


SLOW = ("rotational", "thermal")
LONG = [domain for domain in CASES if domain not in (*SLOW, "translational")]


@pytest.mark.slow
@pytest.mark.parametrize("domain", some_slow(CASES, SLOW, LONG))
def test_a_law_is_learned(domain: str) -> None:
    case = CASES[domain]
    t = np.linspace(0, case.end, STEPS + 1)
    known = ac.compile(case.circuit(case.element(net=Known(case.true))))
    inputs = {case.inputs: push(case, t)}
    run = ac.simulate(
        known, (0, case.end), dt=t[1], inputs=inputs, params=known.parameters(), solver="heun"
    )
    record = ac.Data(t, {case.inputs: inputs[case.inputs], case.target: run[case.target]})
    system = ac.compile(case.circuit(case.element(width=8, depth=1, **case.options)))
    fit = ac.fit(
        system,
        record,
        [case.target],
        x0="model",
        epochs=300,
        optimizer=optax.adam(0.03),
        progress=False,
    )
    net = fit.params["element.net"]
    true = jax.grad(case.true) if isinstance(net, ac.networks.EnergyLaw) else case.true
    low, high = fit.seen["element.net"].interval(1)
    x = jnp.linspace(low[0], high[0], 21)
    expected = jax.vmap(true)(x)
    error = jnp.abs(jax.vmap(law_of(net))(x) - expected).max()
    assert fit.loss < 0.05
    assert error < 0.05 * jnp.abs(expected).max()
