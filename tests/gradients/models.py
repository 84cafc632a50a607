"""Forty models of all domains, smooth where they are simulated, to compare their gradients with differences."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

import jax.numpy as jnp
import numpy as np

import acausal as ac
from acausal.components import (
    blocks,
    electrical as el,
    hydraulic as hy,
    magnetic as mag,
    neural,
    rotational as rot,
    thermal,
    translational as tl,
)
from tests.fuzz.sound import SOUND, build, plain
from tests.support.parts import Equations

E, der = ac.Eq, ac.der


@dataclass(frozen=True)
class Case:
    """A model and how it is run.

    Attributes:
        make: makes it. ``end``: of the simulation in `STEPS` steps, in seconds.
        inputs: by name, numbers, functions or signals.
        x0: initial values that are no parameters' matter; they are differentiated, too.
        kept: parameters at which it is not smooth, or that are no numbers to move.
    """

    make: Callable[[], ac.Component]
    end: float
    inputs: dict[str, Any] = field(default_factory=dict)
    x0: dict[str, float] = field(default_factory=dict)
    kept: tuple[str, ...] = ()


def sound(name: str) -> Callable[[], ac.Component]:
    return lambda: build(plain(SOUND[name]), SOUND[name]["connections"])


def pendulum(s: Any) -> Iterable[ac.Eq]:
    """In Cartesian coordinates."""
    yield E(der(s.x), s.v)
    yield E(der(s.y), s.w)
    yield E(der(s.v), -s.f * s.x)
    yield E(der(s.w), -s.f * s.y - s.g)
    yield E(s.x**2 + s.y**2, s.L**2)


def control_loop() -> ac.Component:
    made = sound("blocks")()
    made.modify(setpoint={"startTime": -1.0})  # a step at the start is none
    return made


class Built(ac.Component):
    """A model whose parts and nodes are given."""

    def __init__(self, *nodes: str, **parts: Any) -> None:
        super().__init__()
        for name, part in parts.items():
            setattr(self, name, part)
        for node in nodes:
            self.connect(*(self._end(end) for end in node.split()))

    def _end(self, path: str) -> Any:
        found: Any = self
        for name in path.split("."):
            bare, _, index = name.partition("[")
            found = getattr(found, bare)
            found = found[int(index[:-1]) - 1] if index else found
        return found


def at(value: float) -> ac.Start:
    return ac.Start(value, fixed=True)


class CubicSpring(tl.PartialCompliant):
    c, k = ac.Parameter(40.0, unit="N/m"), ac.Parameter(90.0, unit="N/m3")

    def equations(self) -> Iterable[ac.Eq]:
        yield from super().equations()
        yield E(self.f, self.c * self.s_rel + self.k * self.s_rel**3)


class Cubic(el.OnePort):
    G, K = ac.Parameter(1.0, unit="S"), ac.Parameter(0.3, unit="A/V3")

    def equations(self) -> Iterable[ac.Eq]:
        yield from super().equations()
        yield E(self.i, self.G * self.v + self.K * self.v**3)


class Net(ac.Component):
    """A square of n by n nodes, with a capacitor at one corner and a source at the other."""

    def __init__(self, n: int, make: Callable[[int], ac.Component]) -> None:
        super().__init__()
        self.ground, self.source, self.c = (
            el.Ground(),
            el.SineVoltage(V=2.0, f=1.0, phase=1.0),
            el.Capacitor(C=0.5, v=at(0.2)),
        )
        pairs = [((i, j), (i, j + 1)) for i in range(n) for j in range(n - 1)]
        pairs += [((j, i), (j + 1, i)) for i in range(n) for j in range(n - 1)]
        self.edge = [make(k) for k in range(len(pairs))]
        node: dict[Any, list[Any]] = {(i, j): [] for i in range(n) for j in range(n)}
        for (a, b), edge in zip(pairs, self.edge, strict=True):
            node[a].append(edge.p)
            node[b].append(edge.n)
        node[0, n - 1].append(self.c.p)
        node[0, 0].append(self.source.p)
        for pins in node.values():
            self.connect(*pins)
        self.connect(self.source.n, self.c.n, self.ground.p)


class Bound(ac.Component):
    """Parameters that are given by each other, and by the model's own."""

    k = ac.Parameter(3.0)

    def __init__(self) -> None:
        super().__init__()
        self.a = Equations("x", lambda s: [E(der(s.x), s.p - s.q * s.x)], p=1.0, q=2.0)
        self.b = Equations("x", lambda s: [E(der(s.x), s.p - s.q * s.x**2)], p=1.0, q=2.0)
        self.a.modify(p=2 * self.k, q=ac.sqrt(self.k))
        self.b.modify(p=self.a.p / (1 + self.k), q=self.a.q * self.a.p)


class Initial(ac.Component):
    """Starts from rest in a nonlinear balance; one parameter is what the balance needs."""

    x, y = ac.Variable(start=0.7), ac.Variable(start=0.5)
    p, q = ac.Parameter(2.0), ac.Parameter(1.5)
    w = ac.InitialParameter(1.0)

    def equations(self) -> Iterable[ac.Eq]:
        yield E(der(self.x), self.p - self.q * self.x**3 + 0.3 * ac.sin(3 * ac.time))
        yield E(der(self.y), self.x - self.w * self.y)

    def initial_equations(self) -> Iterable[ac.Eq]:
        yield E(self.p, self.q * self.x**3)
        yield E(self.y, self.p / 4)
        yield E(der(self.y), 0.1)


class Tabulated(ac.Component):
    """A table of one's own, and a network of two arguments."""

    x = ac.Variable(start=0.3, fixed=True)
    table = ac.Module(
        lambda key: ac.Signal(np.linspace(0, 1, 6), [0.0, 0.3, 0.9, 1.0, 0.4, 0.1], "cubic")
    )
    net = ac.Module(ac.networks.Law(secondary=1, width=4, depth=1))
    k = ac.Parameter(0.8)

    def equations(self) -> Iterable[ac.Eq]:
        yield E(der(self.x), self.table(ac.time) - self.k * self.x + self.net(self.x, ac.time))


class Prescribed(ac.Component):
    """A network prescribes a motion: index reduction differentiates it twice."""

    def __init__(self) -> None:
        super().__init__()
        self.t = Path()
        self.move, self.mass, self.spring, self.end = (
            tl.Position(exact=True),
            tl.Mass(m=1.5),
            CubicSpring(),
            tl.Mass(m=0.5, s=at(0.2), v=at(0.0)),
        )
        self.connect(self.t.y, self.move.s_ref)
        self.connect(self.move.flange, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.spring.flange_a)
        self.connect(self.spring.flange_b, self.end.flange_a)


class Path(ac.Component):
    y = ac.Output(unit="m")
    net = ac.Module(ac.networks.Law(width=4, depth=1, activation="tanh"))

    def equations(self) -> Iterable[ac.Eq]:
        yield E(self.y, self.net(ac.time))


def drive(**options: Any) -> Callable[[], ac.Component]:
    return lambda: Built(
        "u.y torque.tau",
        "torque.flange inertia.flange_a",
        "inertia.flange_b element.flange_a",
        "element.flange_b load.flange_a",
        u=blocks.Sine(f=1.0, amplitude=4.0, phase=0.5),
        torque=rot.Torque(),
        inertia=rot.Inertia(J=0.4, phi=at(0.1), w=at(0.3)),
        load=rot.Inertia(J=0.7),
        **options,
    )


def one_port(
    element: Callable[[], ac.Component], current: float = 0.3
) -> Callable[[], ac.Component]:
    """A source, a resistor and a coil around an element."""
    return lambda: Built(
        "v.p r.p",
        "r.n l.p",
        "l.n x.p",
        "x.n v.n g.p",
        v=el.SineVoltage(V=3.0, f=1.0, phase=0.7),
        r=el.Resistor(R=2.0),
        l=el.Inductor(L=0.3, i=at(current)),
        x=element(),
        g=el.Ground(),
    )


def sledge(element: Callable[[], ac.Component]) -> Callable[[], ac.Component]:
    return lambda: Built(
        "u.y f.f",
        "f.flange m.flange_a",
        "m.flange_b x.flange_b",
        "x.flange_a wall.flange",
        u=blocks.Cosine(f=0.7, amplitude=5.0),
        f=tl.Force(),
        m=tl.Mass(m=1.2, s=at(0.2), v=at(0.4)),
        x=element(),
        wall=tl.Fixed(),
    )


CASES: dict[str, Case] = {
    # the sound models
    "translational": Case(sound("translational"), 0.5),
    "rotational": Case(sound("rotational"), 0.5),
    "electrical": Case(sound("electrical"), 0.02),
    "diode": Case(sound("diodes"), 0.004),
    "thermal": Case(sound("thermal"), 0.02),
    "fluid": Case(sound("fluid"), 5.0),
    "hydraulic": Case(sound("hydraulic"), 5.0),
    "magnetic": Case(sound("magnetic"), 0.05),
    "control loop": Case(control_loop, 0.3, kept=("setpoint.startTime",)),
    "neural": Case(sound("neural"), 0.5),
    "motor": Case(sound("motor"), 0.05),
    # mechanics
    "pendulum of index 3": Case(
        lambda: Equations("x y v w f", pendulum, L=1.0, g=9.81), 0.3, x0={"x": 0.6, "v": 0.1}
    ),
    "cubic spring": Case(sledge(CubicSpring), 0.5),
    "gap in contact": Case(sledge(lambda: tl.ElastoGap(c=100.0, d=5.0, s_rel0=1.0, n=1.5)), 0.1),
    "geared train": Case(drive(element=rot.IdealGear(ratio=2.0)), 0.4),
    "planetary": Case(
        lambda: Built(
            "u.flange a.flange_a",
            "a.flange_b p.sun",
            "p.carrier b.flange_a",
            "p.ring c.flange_a",
            u=rot.ConstantTorque(tau_constant=2.0),
            a=rot.Inertia(J=0.2),
            p=rot.IdealPlanetary(ratio=2.0),
            b=rot.Inertia(J=0.5, w=at(0.3)),
            c=rot.Inertia(J=0.3, w=at(0.1)),
        ),
        0.5,
    ),
    "bearing friction": Case(
        drive(element=rot.BearingFriction(tau_pos=[[0.0, 0.3], [2.0, 0.5]], peak=1.2, smooth=True)),
        0.2,
        kept=("element.tau_pos[1,1]", "element.tau_pos[2,1]"),
    ),
    "rolling vehicle": Case(
        lambda: Built(
            "f.flange m.flange_a",
            "m.flange_b r.flange",
            f=tl.ConstantForce(f_constant=30.0),
            m=tl.Mass(m=10.0, v=at(2.0), s=at(0.0)),
            r=tl.RollingResistance(fWeight=100.0, inclinationConstant=0.1),
        ),
        0.5,
    ),
    "prescribed by a network": Case(Prescribed, 0.4),
    # electronics
    "bridge of diodes": Case(
        lambda: Built(
            "v.p d1.p d3.n",
            "v.n d2.p d4.n g.p",
            "d1.n d2.n c.p r.p",
            "d3.p d4.p c.n r.n",
            v=el.SineVoltage(V=3.0, f=1.0, phase=1.0),
            g=el.Ground(),
            r=el.Resistor(R=5.0),
            c=el.Capacitor(C=0.1, v=at(0.5)),
            **{f"d{k}": el.Diode(Ids=1e-4, Vt=0.3, R=1e4) for k in (1, 2, 3, 4)},
        ),
        0.2,
    ),
    "transistor": Case(
        lambda: Built(
            "v.p rc.p rb.p",
            "rc.n q.C c.p",
            "rb.n q.B",
            "q.E v.n g.p c.n",
            v=el.ConstantVoltage(V=5.0),
            rc=el.Resistor(R=1000.0),
            rb=el.Resistor(R=1e5),
            q=el.NPN(),
            c=el.Capacitor(C=1e-6, v=at(4.0)),
            g=el.Ground(),
        ),
        2e-8,
    ),
    "saturating coil": Case(
        one_port(lambda: el.SaturatingInductor(Inom=1.0, Lnom=1.0, Lzer=2.0, Linf=0.5)), 0.2
    ),
    "switch": Case(
        lambda: Built(
            "v.p r.p",
            "r.n s.p c.p",
            "s.n c.n v.n g.p",
            "u.y s.control",
            v=el.ConstantVoltage(V=2.0),
            r=el.Resistor(R=3.0),
            s=el.IdealClosingSwitch(Ron=0.5, Goff=0.1),
            c=el.Capacitor(C=0.2, v=at(0.3)),
            u=blocks.Constant(k=1.0),
            g=el.Ground(),
        ),
        0.5,
        kept=("u.k",),
    ),
    "transformer": Case(
        lambda: Built(
            "v.p t.p1",
            "t.p2 r.p",
            "v.n t.n1 t.n2 r.n g.p",
            v=el.SineVoltage(V=3.0, f=1.0),
            t=el.Transformer(L1=1.0, L2=0.5, M=0.3),
            r=el.Resistor(R=2.0),
            g=el.Ground(),
        ),
        0.4,
    ),
    "op-amp": Case(
        lambda: Built(
            "v.p r.p",
            "r.n a.in_n c.p",
            "c.n a.out q.p",
            "a.in_p v.n q.n g.p",
            v=el.SineVoltage(V=1.0, f=1.0, phase=0.3),
            r=el.Resistor(R=2.0),
            c=el.Capacitor(C=0.3, v=at(0.1)),
            a=el.IdealOpAmp3Pin(),
            q=el.Resistor(R=4.0),
            g=el.Ground(),
        ),
        0.4,
    ),
    "sparse loop": Case(lambda: Net(6, lambda k: el.Conductor(G=1.0 + 0.05 * k)), 0.3),
    "sparse nonlinear loop": Case(
        lambda: Net(6, lambda k: Cubic(G=1.0 + 0.05 * k) if k % 5 == 0 else el.Conductor(G=1.0)),
        0.3,
    ),
    # heat and fluids
    "radiation": Case(
        lambda: Built(
            "h.port c.port",
            "c.port r.port_a",
            "r.port_b s.port",
            h=thermal.FixedHeatFlow(Q_flow=200.0),
            c=thermal.HeatCapacitor(C=20.0, T=at(500.0)),
            r=thermal.BodyRadiation(Gr=0.02),
            s=thermal.FixedTemperature(T=300.0),
        ),
        2.0,
    ),
    "weir": Case(
        lambda: Built(
            "u.port t.topPort",
            "t.port w.port_a o.port_a",
            "w.port_b o.port_b s.topPort",
            u=hy.MassFlowSource(m_flow=2.0),
            t=hy.OpenTank(crossArea=0.1, level=at(0.5)),
            w=hy.Weir(height=0.3, width=0.02),
            o=hy.Orifice(area=1e-4),
            s=hy.OpenTank(crossArea=0.2, level=at(0.1)),
        ),
        2.0,
    ),
    # magnetics
    "soft iron": Case(
        lambda: Built(
            "v.p r.p",
            "r.n coil.p",
            "coil.n v.n g.p",
            "coil.port_p core.port_p",
            "core.port_n coil.port_n m.port",
            v=el.ConstantVoltage(V=10.0),
            r=el.Resistor(R=7.5),
            coil=mag.ElectroMagneticConverter(N=600.0, i=at(0.1)),
            core=mag.Cuboid(material=mag.M350_50A(), l=0.26, a=0.025, b=0.025),
            m=mag.Ground(),
            g=el.Ground(),
        ),
        0.01,
    ),
    # blocks
    "lookup table": Case(
        lambda: Built(
            "i.y t.u",
            "t.y[1] i.u",
            t=blocks.CombiTable1Ds(
                table=[[0.0, 1.0], [1.0, 0.2], [2.0, -3.0], [4.0, -4.0]],
                smoothness="ContinuousDerivative",
            ),
            i=blocks.Integrator(k=1.0, initType="InitialState", y_start=0.2),
        ),
        0.3,
    ),
    "linear segments": Case(
        lambda: Built(
            "i.y t.u",
            "t.y[1] i.u",
            t=blocks.CombiTable1Ds(table=[[0.0, 1.0], [1.0, 0.2], [2.0, -3.0]]),
            i=blocks.Integrator(k=1.0, initType="InitialState", y_start=0.2),
        ),
        0.3,
    ),
    "delay": Case(
        lambda: Built(
            "u.y d.u",
            "d.y f.u",
            u=blocks.Sine(f=1.0, amplitude=2.0, phase=0.4),
            d=blocks.PadeDelay(delayTime=0.2, n=3),
            f=blocks.FirstOrder(T=0.3, k=2.0, initType="InitialState", y_start=0.1),
        ),
        0.3,
    ),
    "state space": Case(
        lambda: Built(
            "u.y s.u[1]",
            "s.y[1] f.u",
            u=blocks.ExpSine(f=1.0, damping=0.5),
            s=blocks.StateSpace(
                A=[[-1.0, 2.0], [-3.0, -0.5]],
                B=[[1.0], [0.5]],
                C=[[1.0, 0.3]],
                D=[[0.1]],
                initType="InitialState",
                x_start=[0.3, -0.2],
            ),
            f=blocks.LowpassButterworth(f=1.0, n=3),
        ),
        0.3,
    ),
    "limits": Case(
        lambda: Equations(
            "x y",
            lambda s: [
                E(
                    der(s.x),
                    ac.maximum(s.k * s.y, -5) - ac.Abs(s.x) + ac.where(s.x > 0.1, s.p, 0.5),
                ),
                E(der(s.y), ac.minimum(s.x, 3) - s.q * s.y),
            ],
            k=1.5,
            p=0.7,
            q=0.9,
        ),
        0.4,
        x0={"x": 0.8, "y": 0.5},
    ),
    # equations of one's own
    "bound parameters": Case(Bound, 0.5, x0={"a.x": 0.4, "b.x": 0.8}),
    "from rest": Case(Initial, 0.4),
    "table and network": Case(Tabulated, 0.6),
    "van der Pol": Case(
        lambda: Equations(
            "x y",
            lambda s: [E(der(s.x), s.y), E(der(s.y), s.mu * (1 - s.x**2) * s.y - s.x)],
            mu=3.0,
        ),
        0.5,
        x0={"x": 1.2, "y": 0.3},
    ),
    "implicit equation": Case(
        lambda: Equations(
            "x z",
            lambda s: [E(der(s.x), -s.z), E(s.z + s.k * s.z**3, s.x * ac.exp(0.1 * s.z))],
            k=0.6,
        ),
        0.5,
        x0={"x": 1.1},
    ),
    "torn loop of three": Case(
        lambda: Equations(
            "x a b c",
            lambda s: [
                E(der(s.x), s.a - s.x),
                E(s.a, s.k * ac.tanh(s.b) + s.x),
                E(s.b, 1 - 0.3 * s.c**2),
                E(s.c, ac.sin(s.a) + s.q * s.b),
            ],
            k=0.4,
            q=0.3,
        ),
        0.5,
        x0={"x": 0.6},
    ),
    "cubic record": Case(
        lambda: Equations("x", lambda s: [E(der(s.x), s.u**2 - s.k * s.x)], inputs="u", k=1.4),
        0.6,
        inputs={
            "u": ac.Signal(np.linspace(0, 1, 7), [0.3, 0.8, 1.1, 0.9, 0.2, -0.4, 0.1], "cubic")
        },
        x0={"x": 0.2},
    ),
    "forced by a function": Case(
        lambda: Equations(
            "x y",
            lambda s: [E(der(s.x), s.u - s.k * s.x * s.y), E(der(s.y), s.x - s.u * s.y)],
            inputs="u",
            k=1.1,
        ),
        0.6,
        inputs={"u": lambda t: jnp.exp(-t) * jnp.cos(5 * t)},
        x0={"x": 0.5, "y": 0.7},
    ),
    # neural elements of other domains
    "neural coil": Case(one_port(lambda: neural.Inductance(el.Pin, width=4, depth=1)), 0.3),
    "neural hysteresis": Case(
        sledge(lambda: neural.Hysteresis(width=4, depth=1, input_scale=0.3, output_scale=2.0)), 0.2
    ),
    "neural gear": Case(
        drive(element=neural.LossyTransformer(rot.Flange, rot.Flange, width=4, depth=1, ratio=1.3)),
        0.2,
    ),
    "neural heat": Case(
        lambda: Built(
            "c.port r.port_a",
            "r.port_b d.port",
            c=thermal.HeatCapacitor(C=10.0, T=at(330.0)),
            r=neural.Resistance(
                thermal.HeatPort,
                width=4,
                depth=1,
                passive=True,
                input_scale=20.0,
                output_scale=30.0,
            ),
            d=thermal.HeatCapacitor(C=20.0, T=at(300.0)),
        ),
        2.0,
    ),
    "neural promises": Case(
        sledge(
            lambda: neural.Compliance(
                width=4, depth=1, energy=True, convex=True, input_scale=0.5, output_scale=5.0
            )
        ),
        0.4,
    ),
}
"""By name."""
