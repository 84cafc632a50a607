"""Small models that the tests of simulation and training share."""

import functools

import numpy as np

import acausal as ac
from acausal.components import neural, translational as tl

M, C, D = 2.0, 50.0, 1.0


class Oscillator(ac.Component):
    """A mass on a spring and a damper, pushed by a force."""

    def __init__(self, *, d: float = D, cubic: float | None = None, learned: bool = False) -> None:
        super().__init__()
        self.fixed = tl.Fixed()
        self.spring = tl.SpringDamper(c=C, d=d)
        self.mass = tl.Mass(m=M, s=ac.Start(0.0, fixed=True), v=ac.Start(0.0, fixed=True))
        self.push = tl.Force()
        springs = [self.spring]
        if learned:
            self.extra = neural.Compliance(
                input_scale=0.5, output_scale=20.0, width=8, activation="tanh"
            )
            springs.append(self.extra)
        if cubic is not None:
            self.hard = Hardening(k=cubic)
            springs.append(self.hard)
        for spring in springs:
            self.connect(self.fixed.flange, spring.flange_a)
            self.connect(spring.flange_b, self.mass.flange_a)
        self.connect(self.push.flange, self.mass.flange_b)


class Hardening(tl.PartialCompliant):
    """``f = k s_rel^3``."""

    k = ac.Parameter(unit="N/m3")

    def equations(self):
        yield from super().equations()
        yield ac.Eq(self.f, self.k * self.s_rel**3)


@functools.cache
def plain() -> ac.System:
    """The linear oscillator."""
    return ac.compile(Oscillator())


@functools.cache
def undamped() -> ac.System:
    """The linear oscillator without damping."""
    return ac.compile(Oscillator(d=0.0))


@functools.cache
def learned() -> ac.System:
    """The oscillator with a network beside its spring."""
    return ac.compile(Oscillator(learned=True))


def force(t: np.ndarray) -> np.ndarray:
    """A push [N] that excites all amplitudes up to about 0.7 m."""
    return 12 * np.sin(4.1 * t) + 8 * np.sin(1.3 * t + 1) + 5 * np.sin(7.7 * t)


@functools.cache
def record(cubic: float = 80.0, end: float = 20.0, dt: float = 0.01) -> ac.Data:
    """What an oscillator with a hardening spring does under the force; it starts at rest."""
    time = np.linspace(0, end, round(end / dt) + 1)
    system = ac.compile(Oscillator(cubic=cubic))
    solution = ac.simulate(system, (0, end), dt=dt, inputs={"push.f": force(time)})
    return ac.Data(time, {n: solution[n] for n in ("mass.s", "mass.v", "mass.a", "push.f")})
