"""A neural characteristic between signals: its promises, a map, files, refusals."""

from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, neural


class Sensor(ac.Component):
    """What is measured goes through a sensor's curve, which may depend on the temperature."""

    def __init__(self, curve: ac.Component) -> None:
        super().__init__()
        self.measured, self.curve = blocks.Gain(k=1.0), curve
        self.connect(self.measured.y, curve.u)


def read(system: ac.System, params: dict, *inputs: float) -> float:
    """What the sensor says."""
    return float(system.observe("curve.y", 0.0, jnp.zeros(0), jnp.asarray(inputs), params))


def test_a_monotone_characteristic_rises_whatever_its_weights() -> None:
    options = {"monotone": True, "activation": "tanh", "extrapolation": "linear", "limits": 2.0}
    system = ac.compile(Sensor(neural.Characteristic(width=4, depth=1, **options)))
    for seed in range(5):
        net = system.parameters(seed)["curve.net"]
        wild = jax.tree.map(lambda w: 5 * w if jnp.ndim(w) else w, net)
        y = jax.vmap(wild)(jnp.linspace(-4.0, 4.0, 81))
        assert np.all(np.diff(y) >= -1e-12)
        np.testing.assert_allclose(np.diff(y[-15:], 2), 0, atol=1e-9)


def test_a_fresh_characteristic_may_start_with_a_derivative() -> None:
    options = {"monotone": True, "activation": "tanh", "input_scale": 0.5, "output_scale": 2.0}
    system = ac.compile(Sensor(neural.Characteristic(width=4, depth=1, start=3.0, **options)))
    net = system.parameters(0)["curve.net"]
    assert float(net(1e5) - net(0.0)) / 1e5 == pytest.approx(3.0 * 2.0 / 0.5, rel=1e-3)


def test_a_map_has_secondary_inputs_and_goes_through_files(tmp_path: Path) -> None:
    model = Sensor(neural.Characteristic(secondary=("T",), zero_crossing="exact", width=4))
    system = ac.compile(model)
    assert system.inputs == ("measured.u", "curve.T")
    params = system.parameters(3)
    assert read(system, params, 0.0, 0.7) == 0
    assert read(system, params, 0.3, 0.7) != read(system, params, 0.3, -0.7)
    ac.save(model, tmp_path / "sensor.json")
    again = ac.compile(ac.load(tmp_path / "sensor.json"))
    assert read(again, again.parameters(3), 0.3, 0.7) == read(system, params, 0.3, 0.7)


@pytest.mark.slow
def test_a_curve_is_learned() -> None:
    t = np.linspace(0, 1, 101)
    u = np.sin(6 * t)
    system = ac.compile(Sensor(neural.Characteristic(width=6, depth=1, activation="tanh")))
    record = ac.Data(t, {"measured.u": u, "curve.y": np.arctan(2 * u)})
    fit = ac.fit(system, record, ["curve.y"], strategy="whole_record", epochs=200, progress=False)
    assert fit.loss < 0.01


def test_promises_that_do_not_go_together_are_refused() -> None:
    with pytest.raises(ac.DeclarationError, match=r"Characteristic: .*monotone=True"):
        neural.Characteristic(floor=0.1)
