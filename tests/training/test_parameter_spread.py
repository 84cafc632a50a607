"""Parameter spread: parameters that differ from run to run, and a training that bears it."""

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import neural, translational as tl
from acausal.training.objective.parameter_spread import parameter_spread


class Pushed(ac.Component):
    """A mass that is pushed against a friction and an offset, and nothing holds it but a spring, if it learns one."""

    def __init__(self) -> None:
        super().__init__()
        self.wall, self.damper, self.mass = tl.Fixed(), tl.Damper(d=2.0), tl.Mass(m=1.0)
        self.spring = neural.Compliance(width=4, depth=1, activation="tanh", zero_crossing="exact")
        self.push, self.offset = tl.Force(), tl.ConstantForce(f_constant=0.1)
        for element in (self.damper, self.spring):
            self.connect(self.wall.flange, element.flange_a)
            self.connect(element.flange_b, self.mass.flange_a)
        self.connect(self.mass.flange_b, self.push.flange, self.offset.flange)


def free(name: str) -> tuple[float, float]:
    return -np.inf, np.inf


@pytest.fixture(scope="module")
def pushed() -> tuple[ac.System, ac.Data]:
    system = ac.compile(Pushed())
    t = np.linspace(0, 8, 161)
    s = 0.5 - 0.5 * np.cos(2 * np.pi * t / 8)
    v, a = np.gradient(s, t), np.gradient(np.gradient(s, t), t)
    force = a + 2 * v - 0.1
    return system, ac.Data(t, {"push.f": force, "mass.s": s, "mass.v": v})


def test_the_mean_is_over_the_model_and_both_sides_of_each_parameter() -> None:
    params = {"a": jnp.asarray(1.0), "b": jnp.asarray(10.0), "c": jnp.asarray(5.0)}
    given = parameter_spread({"a": 0.5, "b": 2.0}, params, free)
    found = given.mean(lambda p: p["c"] + (p["a"] - 1) ** 2 + p["b"] ** 2, params)
    assert float(found) == pytest.approx(5 + (0.25 + 0.25) / 5 + (3 * 100 + 144 + 64) / 5)
    assert parameter_spread(None, params, free).mean(lambda p: p["a"], params) == params["a"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"offset.f_const": 1.0}, "no parameter 'offset.f_const'"),
        ({"offset.f_constant": 0.0}, "'offset.f_constant' is 0.0; give a positive deviation"),
        ({"offset.f_constant": "x"}, "'offset.f_constant' is 'x'; give a positive deviation"),
        ({"spring.net": 1.0}, "no parameter 'spring.net'"),
    ],
)
def test_what_is_no_spread_is_refused(pushed, given, message: str) -> None:
    system, record = pushed
    with pytest.raises(ac.TrainingError, match=message):
        ac.fit(system, record, ["mass.s"], parameter_spread=given, epochs=1, progress=False)


@pytest.mark.slow
def test_a_model_with_a_spread_bears_another_offset(pushed) -> None:
    system, record = pushed
    loss = {}
    for name, given in {"exact": None, "tolerant": {"offset.f_constant": 0.2}}.items():
        fit = ac.fit(
            system, record, ["mass.s"], parameter_spread=given, strategy="whole_record", epochs=40, progress=False
        )  # fmt: skip
        other = {**fit.params, "offset.f_constant": 0.3}
        start = {n: record[n][0] for n in system.states}
        inputs = {"push.f": record.signal("push.f")}
        ran = ac.simulate(system, (0.0, 8.0), dt=0.05, inputs=inputs, params=other, x0=start)
        loss[name] = float(np.mean((np.asarray(ran["mass.s"]) - record["mass.s"]) ** 2))
    assert loss["tolerant"] < 0.7 * loss["exact"]


def test_no_model_leaves_the_bounds_that_a_parameter_declares(pushed) -> None:
    system, record = pushed
    with pytest.raises(
        ac.TrainingError, match=r"'mass.m' is 5 about 1, which leaves its bounds, 0 to inf"
    ):
        ac.fit(
            system, record, ["mass.s"], parameter_spread={"mass.m": 5.0}, epochs=1, progress=False
        )
    given = parameter_spread({"m": 0.5}, {"m": 1.0}, lambda _: (0.0, 9.0))
    moved = given.over_models(lambda p: p["m"], {"m": jnp.asarray(0.2)})  # trained down to there
    np.testing.assert_allclose(moved, [0.2, 0.7, 0.0])
