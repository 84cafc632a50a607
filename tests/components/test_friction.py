"""Friction that locks: analytic motions and gradients, energy, and clutches that lock at the same instant."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, rotational as rot, translational as tl
from acausal.flattening.flat_model import flatten

M, F, V0 = 2.0, 3.0, 4.0
REST = ac.Start(0.0, fixed=True)


def at(value):
    return ac.Start(value, fixed=True)


@pytest.mark.cases(fast=4)
@pytest.mark.parametrize(
    "element",
    [
        rot.BearingFriction, rot.Brake, rot.Clutch, rot.OneWayClutch, rot.LossyGear,
        tl.SupportFriction, tl.Brake, tl.MassWithStopAndFriction,
    ],
)  # fmt: skip
def test_smooth_elements_have_no_discrete_variables(element):
    names = "ratio fn_max m smax smin F_prop F_Coulomb F_Stribeck fexp"
    given = {n: 1.0 for n in names.split() if n in element._declared}
    if element is rot.LossyGear:
        given["lossTable"] = [[0, 0.9, 0.9, 1, 1]]
    exact, smooth = flatten(element(**given)), flatten(element(**given, smooth=True))
    for model in (exact, smooth):
        balance = model.n_variables - len(model.inputs) - len(model.discrete)
        assert model.n_equations == balance
    assert len(exact.discrete) > 0
    assert len(smooth.discrete) == 0


def test_users_may_state_their_own_friction():
    class Mine(rot.PartialFriction):
        flange = rot.Flange()

        def equations(self):
            yield from super().equations()
            yield ac.Eq(self.w_relfric, ac.der(self.flange.phi))
            yield ac.Eq(self.a_relfric, ac.der(self.w_relfric))
            yield ac.Eq(self.tau0, 2)
            yield ac.Eq(self.tau0_max, 3)
            yield ac.Eq(self.free, 0)
            yield ac.Eq(self.flange.tau, self._friction(2 * self._direction))

    model = flatten(Mine())
    assert model.n_equations == model.n_variables - len(model.discrete)


class Block(ac.Component):
    """A block that slides and comes to rest."""

    def __init__(self):
        super().__init__()
        self.mass = tl.Mass(m=M, s=REST, v=at(V0))
        self.friction = tl.SupportFriction(f_pos=[[0, F]])
        self.connect(self.mass.flange_b, self.friction.flange_a)


@pytest.mark.machines
@pytest.mark.parametrize(
    "steps",
    [
        pytest.param({}, marks=pytest.mark.machines),
        pytest.param({"dt": 0.01}, marks=pytest.mark.slow),
    ],
)
def test_a_block_stops_where_its_energy_is_spent(steps):
    system = ac.compile(Block())
    params = system.parameters()
    (force,) = (n for n, value in params.items() if n.startswith("friction.f_pos") and value == F)

    @jax.jit
    def end(v0, f):
        found = ac.simulate(
            system,
            (0, 5),
            x0={"mass.v": v0},
            params={**params, force: f},
            saveat=[1.0, 5.0],
            **steps,
        )
        return jnp.stack([found["mass.s"][-1], found["mass.v"][-1], found["mass.v"][0]])

    s, v, sliding = end(V0, F)
    assert s == pytest.approx(M * V0**2 / (2 * F), rel=1e-9)
    assert v == pytest.approx(0, abs=1e-12)
    assert sliding == pytest.approx(V0 - F / M, rel=1e-9)
    by_v0, by_f = jax.jacrev(end, argnums=(0, 1))(V0, F)
    np.testing.assert_allclose(by_v0, [M * V0 / F, 0, 1], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(by_f, [-M * V0**2 / (2 * F**2), 0, -1 / M], rtol=1e-9, atol=1e-9)


class Bench(ac.Component):
    """Elements side by side."""

    def __init__(self):
        super().__init__()
        # a block at rest is pushed harder and harder
        self.pushed = tl.Mass(m=1.0, s=REST, v=REST)
        self.support = tl.SupportFriction(f_pos=[[0, 2.0]], peak=1.5)
        self.push = tl.Force()
        self.connect(self.push.flange, self.pushed.flange_a)
        self.connect(self.pushed.flange_b, self.support.flange_a)

        # the middle of three inertias keeps its speed, so both clutches lock at once
        self.fast = rot.Inertia(J=1.0, phi=REST, w=at(2.0))
        self.middle = rot.Inertia(J=1.0, phi=REST, w=at(1.0))
        self.slow = rot.Inertia(J=1.0, phi=REST, w=REST)
        self.first, self.second = rot.Clutch(fn_max=2.0), rot.Clutch(fn_max=2.0)
        self.connect(self.fast.flange_b, self.first.flange_a)
        self.connect(self.first.flange_b, self.middle.flange_a)
        self.connect(self.middle.flange_b, self.second.flange_a)
        self.connect(self.second.flange_b, self.slow.flange_a)

        # a free wheel lets the hub run ahead of the crank
        self.pedal = rot.Torque()
        self.crank = rot.Inertia(J=1.0, phi=REST, w=REST)
        self.hub = rot.Inertia(J=1.0, phi=REST, w=REST)
        self.wheel = rot.OneWayClutch(fn_max=1.0)
        self.connect(self.pedal.flange, self.crank.flange_a)
        self.connect(self.crank.flange_b, self.wheel.flange_a)
        self.connect(self.wheel.flange_b, self.hub.flange_a)

        # a gear that cannot be driven from its output
        self.worm_in = rot.Inertia(J=1.0, phi=REST, w=at(1.0))
        self.worm = rot.LossyGear(ratio=2.0, lossTable=[[0, 0.6, 0.4, 1.5, 1.5]])
        self.worm_out = rot.Inertia(J=2.0)
        self.load = rot.Torque()
        self.connect(self.worm_in.flange_b, self.worm.flange_a)
        self.connect(self.worm.flange_b, self.worm_out.flange_a)
        self.connect(self.worm_out.flange_b, self.load.flange)

        # a mass meets its stop
        self.slider = tl.MassWithStopAndFriction(
            m=1, L=0.2, smax=1, smin=-1, F_prop=0, F_Coulomb=0.5, F_Stribeck=0, fexp=2,
            s=REST, v=at(1.2),
        )  # fmt: skip


@pytest.fixture(scope="module")
def bench():
    inputs = {
        "push.f": lambda t: 2 * t,
        "first.f_normalized": 1.0,
        "second.f_normalized": 1.0,
        "pedal.tau": lambda t: 2 - 2 * t,
        "wheel.f_normalized": 0.0,
        "load.tau": 1.0,
    }
    times = np.linspace(0, 3, 301)
    return ac.simulate(
        ac.compile(Bench()), (0, 3), inputs=inputs, saveat=times, rtol=1e-9, atol=1e-12
    )


@pytest.mark.machines
def test_a_block_breaks_away_at_the_peak(bench):
    t, v = np.asarray(bench.t), np.asarray(bench["pushed.v"])
    gone = np.maximum(t - 1.5, 0)  # then 2 t - 2 accelerates it
    np.testing.assert_allclose(v, gone + gone**2, atol=1e-8)
    held = t < 1.49
    np.testing.assert_allclose(bench["support.f"][held], 2 * t[held], atol=1e-9)
    assert set(bench["support.mode"][held].tolist()) == {0}
    assert set(bench["support.mode"][t > 1.51].tolist()) == {1}


@pytest.mark.slow
def test_clutches_lock_at_the_same_instant(bench):
    t = np.asarray(bench.t)
    np.testing.assert_allclose(bench["fast.w"], 1 + np.maximum(1 - t, 0), atol=1e-8)
    np.testing.assert_allclose(bench["middle.w"], 1, atol=1e-8)
    np.testing.assert_allclose(bench["slow.w"], np.minimum(t, 1), atol=1e-8)
    for clutch in ("first", "second"):
        assert bench[f"{clutch}.mode"][t < 0.99].tolist() == [-1] * int(np.sum(t < 0.99))
        assert bench[f"{clutch}.locked"][t > 1.01].tolist() == [1] * int(np.sum(t > 1.01))
    lost = np.trapezoid(bench["first.lossPower"] + bench["second.lossPower"], t)
    assert lost == pytest.approx(2.5 - 1.5, abs=1e-2)


@pytest.mark.slow
def test_a_free_wheel_drives_one_way_only(bench):
    t = np.asarray(bench.t)
    together = t <= 1
    w = (2 * t - t**2) / 2
    np.testing.assert_allclose(bench["hub.w"], np.where(together, w, 0.5), atol=1e-6)
    apart = 0.5 + (2 * t - t**2 - 1)
    np.testing.assert_allclose(bench["crank.w"], np.where(together, w, apart), atol=1e-6)
    assert set(bench["wheel.stuck"][t < 0.99].tolist()) == {1}
    assert set(bench["wheel.stuck"][t > 1.01].tolist()) == {0}


@pytest.mark.slow
def test_a_worm_gear_stops_and_holds_its_load(bench):
    t = np.asarray(bench.t)
    w, loss = np.asarray(bench["worm.w_a"]), np.asarray(bench["worm.lossPower"])
    # w' = -tau_a, w' = 1 - tau_b, tau_b = -2 (tau_a - loss), and rolling loss = 0.4 tau_a + 1.5
    np.testing.assert_allclose(w, np.maximum(1 - t * 2 / 2.2, 0), atol=1e-8)
    assert set(bench["worm.mode"][t > 1.2].tolist()) == {0}
    np.testing.assert_allclose(bench["worm.sa"][t > 1.2], 0.5, atol=1e-9)  # holds the load
    assert np.all(loss >= -1e-12)
    energy = (1 + 2 / 4) * w**2 / 2
    work = np.trapezoid(w / 2 * 1.0, t)  # of the load, at the output
    assert np.trapezoid(loss, t) == pytest.approx(energy[0] + work, abs=2e-3)


@pytest.mark.slow
def test_a_mass_stays_at_its_stop(bench):
    t, s = np.asarray(bench.t), np.asarray(bench["slider.s"])
    hit = 2 * (1.2 - np.sqrt(1.44 - 0.9))  # 0.9 = 1.2 t - t**2/4
    np.testing.assert_allclose(s, np.where(t < hit, 1.2 * t - t**2 / 4, 0.9), atol=1e-8)
    assert set(bench["slider.stopped"][t > hit].tolist()) == {1}
    assert np.all(bench["slider.v"][t > hit] == 0)


class Redundant(ac.Component):
    """Two friction elements beside each other, of which one would be enough to hold the shaft."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.fast = rot.Inertia(J=1.0, phi=REST, w=at(10.0))
        self.slow = rot.Inertia(J=1.0, phi=REST, w=REST)
        self.first, self.second = (getattr(rot, kind)(fn_max=f) for f in (10.0, 6.0))
        for element in (self.first, self.second):
            self.connect(self.fast.flange_b, element.flange_a)
            if kind == "Clutch":
                self.connect(element.flange_b, self.slow.flange_a)


FULL = {"first.f_normalized": 1.0, "second.f_normalized": 1.0}


@pytest.mark.slow
def test_clutches_that_lock_the_same_motion_share_its_torque():
    sol = ac.simulate(ac.compile(Redundant("Clutch")), 4.0, inputs=FULL, saveat=[0.5, 1.0, 4.0])
    np.testing.assert_allclose(sol["fast.w"], [6.0, 5.0, 5.0], atol=1e-8)
    np.testing.assert_allclose(sol["slow.w"], [4.0, 5.0, 5.0], atol=1e-8)
    np.testing.assert_allclose(sol["first.tau"], [-5.0, 0.0, 0.0], atol=1e-8)


class Held(ac.Component):
    """A shaft at a torque; frictions follow."""

    def __init__(self, amplitude: float, f: float) -> None:
        super().__init__()
        self.torque, self.sine = rot.Torque(), blocks.Sine(amplitude=amplitude, f=f)
        self.shaft = rot.Inertia(J=1.0, phi=REST, w=REST)
        self.connect(self.sine.y, self.torque.tau)
        self.connect(self.torque.flange, self.shaft.flange_a)


def bearing(torque):
    return rot.BearingFriction(tau_pos=[[0.0, torque]])


@pytest.mark.slow
def test_frictions_that_lock_one_motion_act_as_one_of_their_sum():
    several, one = Held(8.0, 0.2), Held(8.0, 0.2)
    several.left, several.right, several.gear = bearing(1.0), bearing(1.5), rot.IdealGear(ratio=2.0)
    several.far, one.all = bearing(3.0), bearing(4.0)
    several.connect(several.shaft.flange_b, several.left.flange_a)
    several.connect(several.left.flange_b, several.right.flange_a)
    several.connect(several.right.flange_b, several.gear.flange_a)
    several.connect(several.gear.flange_b, several.far.flange_a)
    one.connect(one.shaft.flange_b, one.all.flange_a)
    times = [0.1, 0.3, 1.5, 3.0, 7.0, 10.0]
    found, expected = (ac.simulate(ac.compile(m), 10.0, saveat=times) for m in (several, one))
    np.testing.assert_allclose(found["shaft.w"], expected["shaft.w"], atol=1e-7)
    np.testing.assert_allclose(found["shaft.phi"], expected["shaft.phi"], atol=1e-7)
    # at rest by the least squares of their torques: 1, 1 and 1/2 parts
    held = found["sine.y"][0] / 2.25
    shares = [found[f"{name}.tau"][0] for name in ("left", "right", "far")]
    np.testing.assert_allclose(np.abs(shares), held * np.array([1.0, 1.0, 0.5]), rtol=1e-9)


@pytest.mark.slow
def test_a_gear_with_losses_and_a_bearing_lock_one_motion():
    """The smooth laws tend to the locking ones."""

    def geared(**smooth):
        made = Held(10.0, 5.0)
        made.bearing = rot.BearingFriction(tau_pos=[[0.0, 0.5], [1.0, 1.0]], **smooth)
        made.gear = rot.LossyGear(ratio=2.0, lossTable=[[0, 0.5, 0.5, 0, 0]], **smooth)
        made.load, made.pull = rot.Inertia(J=1.5), rot.Torque()
        made.ramp = blocks.Ramp(height=20.0, offset=-10.0, duration=2.0)
        made.connect(made.shaft.flange_b, made.bearing.flange_a)
        made.connect(made.bearing.flange_b, made.gear.flange_a)
        made.connect(made.gear.flange_b, made.load.flange_a)
        made.connect(made.load.flange_b, made.pull.flange)
        made.connect(made.ramp.y, made.pull.tau)
        return ac.simulate(ac.compile(made), 0.5, saveat=0.05)["shaft.w"]

    np.testing.assert_allclose(geared(), geared(smooth=True, w_small=1e-5), atol=2e-4)


class Backstop(ac.Component):
    """A one-way clutch against the ground: a heavy shaft may turn forward alone."""

    def __init__(self):
        super().__init__()
        self.load, self.ground = rot.Torque(), rot.Fixed()
        self.wheel = rot.OneWayClutch(fn_max=1.0)
        self.shaft = rot.Inertia(J=5.0, phi=REST, w=REST)
        self.connect(self.ground.flange, self.wheel.flange_a)
        self.connect(self.wheel.flange_b, self.shaft.flange_a)
        self.connect(self.shaft.flange_b, self.load.flange)


@pytest.mark.slow
def test_a_backstop_lets_a_heavy_shaft_start():
    inputs = {"load.tau": lambda t: 2 * t - 1, "wheel.f_normalized": 0.0}
    run = ac.simulate(ac.compile(Backstop()), 2.0, inputs=inputs)
    started = np.maximum(np.asarray(run.t) - 0.5, 0)
    np.testing.assert_allclose(run["shaft.w"], started**2 / 5, atol=1e-5)


class Bearings(ac.Component):
    """A gear that loses torque in its bearings alone."""

    def __init__(self):
        super().__init__()
        self.drive = rot.Torque()
        self.input, self.output = rot.Inertia(J=1.0, phi=REST, w=REST), rot.Inertia(J=4.0)
        self.gear = rot.LossyGear(ratio=2.0, lossTable=[[0, 1, 1, 0.5, 0.5]])
        self.connect(self.drive.flange, self.input.flange_a)
        self.connect(self.input.flange_b, self.gear.flange_a)
        self.connect(self.gear.flange_b, self.output.flange_a)


@pytest.mark.slow
def test_a_gear_without_losses_of_teeth_has_no_undefined_conditions():
    """A warning of these would fail."""
    run = ac.simulate(ac.compile(Bearings()), 1.0, inputs={"drive.tau": 2.0})
    assert float(run["input.w"][-1]) == pytest.approx((2.0 - 0.5) / (1.0 + 4.0 / 2**2), rel=1e-6)


@pytest.mark.slow
def test_friction_that_falls_with_speed_does_not_drive():
    """By its table the bearing would drive from 60 rad/s on."""
    shaft = ac.Component()
    shaft.inertia = rot.Inertia(J=1.0, phi=REST, w=at(70.0))
    shaft.bearing = rot.BearingFriction(tau_pos=[[0.0, 1.0], [10.0, 0.5], [20.0, 0.4]])
    shaft.brake = rot.Torque()
    shaft.connect(shaft.inertia.flange_b, shaft.bearing.flange_a, shaft.brake.flange)
    found = ac.simulate(ac.compile(shaft), 30.0, inputs={"brake.tau": -1.0})
    assert float(jnp.max(jnp.diff(found["inertia.w"]))) < 0
    assert float(jnp.max(found["bearing.tau"])) > 0
    assert float(jnp.min(found["bearing.tau"])) == 0
