"""Neural elements with promises, in every domain: energy balances, refusals, files, training."""

import functools
from pathlib import Path
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import (
    electrical,
    fluid,
    hydraulic,
    magnetic,
    neural,
    rotational,
    thermal,
    translational as tl,
)
from acausal.flattening.flat_model import flatten
from acausal.networks import Energy, Law, law_of
from tests.support.oscillator import force

DOMAINS = {
    "translational": tl.Flange,
    "rotational": rotational.Flange,
    "electrical": electrical.Pin,
    "thermal": thermal.HeatPort,
    "fluid": fluid.FlowPort,
    "hydraulic": hydraulic.FluidPort,
    "magnetic": magnetic.MagneticPort,
}
DT = 5e-4


class Node(ac.Component):
    """``c der(potential) = flow + u``; what the flow carries besides has a fixed potential."""

    c = ac.Parameter(1.0)
    u = ac.Input()

    def __init__(self, connector: type[ac.Connector]) -> None:
        super().__init__()
        self.port, self.kind = connector(), connector

    def equations(self) -> Any:
        kind, port = self.kind, self.port
        yield ac.Eq(
            self.c * ac.der(getattr(port, kind.potential())), getattr(port, kind.flow()) + self.u
        )
        yield from _carried(port)


class Ground(ac.Component):
    """Potential zero."""

    def __init__(self, connector: type[ac.Connector]) -> None:
        super().__init__()
        self.port, self.kind = connector(), connector

    def equations(self) -> Any:
        yield ac.Eq(getattr(self.port, self.kind.potential()), 0)
        yield from _carried(self.port)


def _carried(port: Any) -> Any:
    if isinstance(port, fluid.FlowPort):
        yield ac.Eq(port.h, 1e5)


class Circuit(ac.Component):
    """A node that elements connect with the ground."""

    def __init__(self, connector: type[ac.Connector]) -> None:
        super().__init__()
        self.node, self.ground = Node(connector), Ground(connector)
        sizes: dict[str, Any] = {"width": 4, "depth": 1, "input_scale": 0.5}
        self.resistance = neural.Resistance(connector, passive=True, odd=True, **sizes)
        self.compliance = neural.Compliance(
            connector, energy=True, convex=True, passive=True, **sizes
        )
        self.hysteresis = neural.Hysteresis(connector, **sizes)
        parts = [self.resistance, self.compliance, self.hysteresis]
        if connector is not thermal.HeatPort:
            self.inductance = neural.Inductance(connector, **sizes)
            parts.append(self.inductance)
        for part in parts:
            first, second = (getattr(part, name) for name in connector.pair)
            self.connect(self.node.port, first)
            if connector.rate is None or part is not parts[-1]:  # a body has one position
                self.connect(second, self.ground.port)


@functools.cache
def driven(domain: str) -> tuple[ac.System, ac.Solution]:
    """A circuit of that domain, pushed to and fro."""
    system = ac.compile(Circuit(DOMAINS[domain]))
    t = np.arange(0, 4, DT)
    run = ac.simulate(
        system,
        (0, t[-1]),
        dt=DT,
        inputs={"node.u": force(t) / 10},
        params=system.parameters(1),
        solver="heun",
    )
    return system, run


def power(domain: str, run: ac.Solution, part: str) -> np.ndarray:
    """What flows into an element: difference, or its rate, times flow."""
    kind = DOMAINS[domain]
    if part == "inductance" and kind.rate is not None:
        speed = kind.rate.removesuffix("_rel")
        flows = [run[f"{part}.{end}.{kind.flow()}"] for end in kind.pair]
        return np.asarray(run[f"{part}.{speed}"]) * np.sum(flows, axis=0)
    effort = run[f"resistance.{kind.rate}" if kind.rate is not None else f"{part}.{kind.across}"]
    return np.asarray(effort) * np.asarray(run[f"{part}.{kind.through}"])


@pytest.mark.slow
@pytest.mark.parametrize("domain", DOMAINS)
def test_energy_in_every_domain(domain: str) -> None:
    """What flows in is lost, and nowhere gained, or stored, and nowhere negative."""
    _, run = driven(domain)
    lost = power(domain, run, "resistance")
    assert lost.min() >= 0
    assert lost.max() > 1e-4
    parts = ["compliance", "hysteresis", *(["inductance"] if domain != "thermal" else [])]
    for part in parts:
        E = np.asarray(run[f"{part}.E"])
        loss = np.asarray(run["hysteresis.lossPower"]) if part == "hysteresis" else 0.0 * E
        assert E.min() >= -1e-15
        assert loss.min() >= 0
        into = power(domain, run, part) - loss
        taken = np.concatenate([[0.0], np.cumsum((into[1:] + into[:-1]) / 2) * DT])
        assert np.ptp(E) > 1e-5
        assert np.abs(taken - (E - E[0])).max() < 2e-3 * np.ptp(E)
    assert np.abs(np.asarray(run["hysteresis.z"])).max() <= 10


@pytest.mark.cases(fast=1)
@pytest.mark.parametrize(
    "element",
    [
        neural.Inductance(electrical.Pin, input_scale=2.0, output_scale=6.0),
        neural.Compliance(electrical.Pin, monotone=True, input_scale=2.0, output_scale=6.0),
        neural.Compliance(
            electrical.Pin, energy=True, convex=True, input_scale=2.0, output_scale=6.0
        ),
    ],
    ids=["inductance", "monotone capacity", "convex capacity"],
)
def test_what_is_divided_by_starts_near_its_scales(element: Any) -> None:
    """A fresh coil of almost no inductance would make its circuit stiff."""
    net = element._fresh(jax.random.key(0))
    derivatives = np.asarray(jax.jit(jax.vmap(jax.grad(law_of(net))))(np.linspace(-4, 4, 9)))
    assert (derivatives >= 3).all()
    assert (derivatives <= 6).all()


@pytest.mark.slow
def test_heat_flows_from_hot_to_cold() -> None:
    _, run = driven("thermal")
    assert (np.asarray(run["resistance.Q_flow"]) * np.asarray(run["resistance.dT"]) >= 0).all()


# -- losses and conversions --------------------------------------------------------------------------


class Motor(ac.Component):
    """A motor with an efficiency map, driven and then braking, in an insulated housing."""

    def __init__(self) -> None:
        super().__init__()
        self.source, self.ground = electrical.SignalVoltage(), electrical.Ground()
        self.resistor = electrical.Resistor(R=1.0)
        self.motor = neural.LossyTransformer(
            electrical.Pin, rotational.Flange, ratio=0.5, useHeatPort=True, input_scale=10.0
        )
        self.rotor = rotational.Inertia(J=0.05)
        self.housing = thermal.HeatCapacitor(C=2.0, T=ac.Start(300.0, fixed=True))
        self.connect(self.source.p, self.resistor.p)
        self.connect(self.resistor.n, self.motor.p)
        self.connect(self.motor.n, self.source.n, self.ground.p)
        self.connect(self.motor.flange, self.rotor.flange_a)
        self.connect(self.motor.heatPort, self.housing.port)


def test_losses_of_a_motor() -> None:
    system = ac.compile(Motor())
    t = np.arange(0, 2, DT)
    run = ac.simulate(
        system,
        (0, t[-1]),
        dt=DT,
        inputs={"source.v": 10 * np.sin(4 * t)},
        params=system.parameters(0),
        solver="heun",
    )
    names = ("P_a", "lossPower", "rate_b", "effort_b")
    into, loss, speed, torque = (np.asarray(run[f"motor.{name}"]) for name in names)
    out = -speed * torque
    assert into.min() < -1 < 1 < into.max()
    assert loss.min() >= 0
    np.testing.assert_allclose(into - out, loss, atol=1e-12)
    driving, braking = into > 0.1, into < -0.1
    for efficiency in (out[driving] / into[driving], into[braking] / out[braking]):
        assert (efficiency >= 0.15).all()
        assert (efficiency <= 1).all()
    heat = 2.0 * (np.asarray(run["housing.T"]) - 300)
    np.testing.assert_allclose(heat[-1], np.trapezoid(loss, dx=DT), rtol=1e-3)
    net = system.parameters(0)["motor.net"]
    assert float(net(1e9, 1.0)) <= 1
    assert float(net(jnp.asarray(20.0), 1.0)) != float(net(20.0, -1.0))


def test_ports_bear_their_domains_names() -> None:
    gear = neural.LossyTransformer()
    assert [*gear._node.own_declarations][:4] == ["flange_a", "rate_a", "effort_a", "flange_b"]
    converter = neural.LossyTransformer(electrical.Pin, electrical.Pin, secondary=("T",))
    assert [n for n in converter._node.own_declarations if "_" not in n] == [
        "p1",
        "n1",
        "p2",
        "n2",
        "T",
    ]
    rack = neural.LossyTransformer(rotational.Flange, tl.Flange)
    assert "flange_a" in rack._node.own_declarations
    assert "flange_a.phi = flange_b.s*ratio" in [str(e) for e in rack.equations()]


class Piezo(ac.Component):
    """A stack that exchanges energy between a mass and a coil, without any loss."""

    def __init__(self) -> None:
        super().__init__()
        self.stack = neural.MultiportCompliance(
            (tl.Flange, electrical.Pin),
            passive=True,
            convex=True,
            input_scale=(0.1, 0.01),
            output_scale=10.0,
            width=4,
        )
        self.wall, self.mass = tl.Fixed(), tl.Mass(m=1.0, s=ac.Start(0.1, fixed=True))
        self.ground, self.coil = electrical.Ground(), electrical.Inductor(L=1.0)
        mechanical, electric = self.stack.ports
        self.connect(self.wall.flange, mechanical.flange_a)
        self.connect(mechanical.flange_b, self.mass.flange_a)
        self.connect(electric.p, self.coil.p)
        self.connect(electric.n, self.coil.n, self.ground.p)


@pytest.mark.slow
def test_a_multiport_conserves_energy() -> None:
    system = ac.compile(Piezo())
    params = system.parameters(0)
    run = ac.simulate(system, (0, 4), dt=DT, params=params, solver="heun")
    v, i, E = (np.asarray(run[n]) for n in ("mass.v", "coil.i", "stack.E"))
    total = E + v**2 / 2 + i**2 / 2
    assert np.ptp(total) < 1e-5 * total[0]
    assert np.ptp(i**2 / 2) > 1e-5 * total[0]
    assert E.min() >= 0
    net = params["stack.net"]
    stiffness = jax.vmap(jax.hessian(lambda x: net(x[0], x[1])))(
        jax.random.normal(jax.random.key(1), (50, 2)) * jnp.asarray([0.3, 0.03])
    )
    assert (jnp.linalg.eigvalsh(stiffness) >= -1e-12).all()
    assert net.law(0.0, 0.0).shape == (2,)
    np.testing.assert_allclose(net.law(0.0, 0.0), 0, atol=1e-12)


def test_a_damper_warms_its_heat_port() -> None:
    class Warm(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.wall, self.mass = tl.Fixed(), tl.Mass(m=1.0, v=ac.Start(2.0, fixed=True))
            self.damper = neural.Resistance(passive=True, useHeatPort=True, width=4)
            self.body = thermal.HeatCapacitor(C=1.0, T=ac.Start(300.0, fixed=True))
            self.connect(self.wall.flange, self.damper.flange_a)
            self.connect(self.damper.flange_b, self.mass.flange_a)
            self.connect(self.damper.heatPort, self.body.port)

    system = ac.compile(Warm())
    run = ac.simulate(system, (0, 3), dt=DT, params=system.parameters(0), solver="heun")
    v, T = np.asarray(run["mass.v"]), np.asarray(run["body.T"])
    np.testing.assert_allclose(v**2 / 2 + (T - 300), 2.0, rtol=1e-6)
    assert T[-1] > 300.01
    assert (np.diff(T) >= 0).all()


# -- what does not go together -----------------------------------------------------------------------

REFUSED: dict[str, tuple[Any, str]] = {
    "odd and offset": (
        lambda: neural.Resistance(odd=True, zero_crossing="offset"),
        "Resistance: odd=True makes the law vanish at zero already; leave out zero_crossing='offset'",
    ),
    "passive and regularizer": (
        lambda: neural.Resistance(passive=True, zero_crossing="regularizer"),
        "passive=True makes the law vanish at zero already",
    ),
    "cube about zero": (
        lambda: neural.Compliance(extrapolation="cubic", limits=(0.0, 1.0)),
        "a cubic extrapolation is about zero, which must lie between its limits",
    ),
    "convex law": (lambda: neural.Compliance(convex=True), "say energy=True, too"),
    "monotone energy": (
        lambda: neural.Compliance(energy=True, monotone=True),
        "the law of an energy is monotone with convex=True",
    ),
    "stored, passive": (
        lambda: neural.Compliance(electrical.Pin, passive=True),
        "passive=True is for laws that rise where something is stored; say monotone=True, too",
    ),
    "limits alone": (lambda: neural.Resistance(limits=1.0), "such as extrapolation='linear'"),
    "limits without zero": (
        lambda: neural.Resistance(passive=True, extrapolation="linear", limits=(0.1, 1.0)),
        "needs zero between its limits",
    ),
    "odd limits": (
        lambda: neural.Resistance(odd=True, extrapolation="linear", limits=(-1.0, 2.0)),
        "an odd law needs symmetric limits; give limits=2",
    ),
    "no limits": (
        lambda: neural.Resistance(extrapolation="linear", limits=(1.0, -1.0)),
        "the first must be less than the second",
    ),
    "floor": (lambda: neural.Resistance(floor=0.1), "also give monotone=True"),
    "negative floor": (lambda: neural.Resistance(monotone=True, floor=-1), "give zero or more"),
    "activation": (
        lambda: neural.Resistance(monotone=True, activation="silu"),
        "activation 'silu' does not suit a monotone network; choose one of relu, tanh",
    ),
    "steps": (
        lambda: neural.Compliance(energy=True, activation="relu"),
        "'relu' does not suit an energy",
    ),
    "concave": (
        lambda: neural.Compliance(energy=True, convex=True, activation="tanh"),
        "'tanh' does not suit a convex energy; choose one of softplus, elu",
    ),
    "typing error": (
        lambda: neural.Resistance(activation="rely"),
        "no activation 'rely': did you mean 'relu'?",
    ),
    "bowl": (
        lambda: neural.Compliance(energy=True, passive=True, extrapolation="linear"),
        "a passive energy may decrease beyond its limits",
    ),
    "own network": (
        lambda: neural.Resistance(passive=True, odd=True, net=lambda key: None),
        "Resistance: odd=True, passive=True cannot be promised of a network of your own",
    ),
    "heat port": (lambda: neural.Resistance(useHeatPort=True), "useHeatPort=True needs passive"),
    "heat port of heat": (
        lambda: neural.Resistance(thermal.HeatPort, passive=True, useHeatPort=True),
        "useHeatPort=True needs a domain whose flow has a power",
    ),
    "hot inertia": (lambda: neural.Inductance(thermal.HeatPort), "heat has no inertia"),
    "no connector": (lambda: neural.Compliance(tl.Flange()), "is not a class of connectors"),
    "scales": (lambda: neural.Resistance(input_scale=0.0), "give positive numbers"),
    "scales of inputs": (
        lambda: neural.Resistance(secondary=("T",), input_scale=(1.0, 2.0, 3.0)),
        "3 input scales for 2 inputs",
    ),
    "size": (lambda: neural.Resistance(width=0), "width=0"),
    "flat energy": (
        lambda: neural.Inductance(electrical.Pin, depth=0)._fresh(0),
        "a convex network needs a hidden layer",
    ),
    "pseudo power": (
        lambda: neural.LossyTransformer(thermal.HeatPort, tl.Flange),
        "difference times flow is not a power for HeatPort",
    ),
    "shared energy": (
        lambda: neural.MultiportCompliance((tl.Flange, fluid.FlowPort)),
        "give ports of one domain",
    ),
    "recipe": (
        lambda: Law(extrapolation="square"),
        "'square' must be one of 'saturating', 'linear'",
    ),  # pyright: ignore[reportArgumentType]
    "curved": (lambda: Energy(floor=0.1), "also give convex=True"),
    "several inputs": (
        lambda: Energy(inputs=2, convex=True, extrapolation="linear"),
        "is for energies of one input",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_does_not_go_together_is_refused_in_a_sentence(name: str) -> None:
    make, message = REFUSED[name]
    with pytest.raises(ac.DeclarationError) as error:
        make()
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def test_a_later_change_is_checked_too() -> None:
    element = neural.Resistance(odd=True)
    with pytest.raises(ac.DeclarationError, match="leave out zero_crossing='offset'"):
        element.modify(zero_crossing="offset")


def test_networks_of_ones_own_take_promises_from_parts() -> None:
    class Own(eqx.Module):
        a: jax.Array

        def __call__(self, x: Any) -> Any:
            return jnp.sin(self.a * x)

    element = neural.Resistance(net=lambda key: ac.networks.Passive(Own(jnp.asarray(3.0))))

    class Model(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.wall, self.damper, self.mass = tl.Fixed(), element, tl.Mass(m=1.0)
            self.connect(self.wall.flange, self.damper.flange_a)
            self.connect(self.damper.flange_b, self.mass.flange_a)

    net = ac.compile(Model()).parameters(0)["damper.net"]
    v = jnp.linspace(-5, 5, 101)
    assert (jax.vmap(net)(v) * v >= 0).all()


# -- files -------------------------------------------------------------------------------------------


def test_elements_make_the_round_trip(tmp_path: Path) -> None:
    class Parts(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.damper = neural.Resistance(
                passive=True, odd=True, extrapolation="linear", limits=0.3, useHeatPort=True
            )
            self.resistor = neural.Resistance(
                electrical.Pin,
                monotone=True,
                zero_crossing="offset",
                extrapolation="saturating",
                limits=(-1.0, 2.0),
                secondary=1,
                input_scale=(1.0, 300.0),
            )
            self.spring = neural.Compliance(energy=True, convex=True, activation="elu")
            self.coil = neural.Inductance(electrical.Pin, floor=0.1)
            self.friction = neural.Hysteresis(rotational.Flange, odd=True)
            self.motor = neural.LossyTransformer(
                electrical.Pin, rotational.Flange, ratio=2.0, secondary=("T",)
            )
            self.stack = neural.MultiportCompliance(
                (tl.Flange, electrical.Pin), passive=True, input_scale=(0.1, 0.01)
            )

    model, file = Parts(), tmp_path / "parts.json"
    ac.save(model, file)
    again = ac.load(file)
    first = file.read_bytes()
    ac.save(again, file)
    assert file.read_bytes() == first
    old, new = (flatten(m) for m in (model, again))
    assert [str(e) for p in model._node.children.values() for e in p.equations()] == [
        str(e) for p in again._node.children.values() for e in p.equations()
    ]
    assert old.n_variables == new.n_variables
    for name in ("damper", "resistor", "spring", "coil", "friction", "stack"):
        specs = [getattr(m, name)._spec() for m in (model, again)]
        assert specs[0] == specs[1]
