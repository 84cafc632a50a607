"""Loops opened at connections, against transfer functions by hand."""

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, rotational as rot

OMEGA = np.logspace(-2, 2, 21)
S = 1j * OMEGA


class Drive(ac.Component):
    """A PI controller keeps the speed of a damped inertia."""

    def __init__(self) -> None:
        super().__init__()
        self.reference = blocks.Constant(k=3.0)
        self.error = blocks.Feedback()
        self.controller = blocks.PI(k=2.0, T=0.5)
        self.torque = rot.Torque()
        self.inertia = rot.Inertia(J=0.2)
        self.damper = rot.Damper(d=0.1)
        self.fixed = rot.Fixed()
        self.sensor = rot.SpeedSensor()
        self.connect(self.reference.y, self.error.u1)
        self.connect(self.error.y, self.controller.u)
        self.connect(self.controller.y, self.torque.tau)
        self.connect(self.torque.flange, self.inertia.flange_a)
        self.connect(self.inertia.flange_b, self.damper.flange_a, self.sensor.flange)
        self.connect(self.damper.flange_b, self.fixed.flange)
        self.connect(self.sensor.w, self.error.u2)


CONTROLLER = 2 * (1 + 1 / (0.5 * S))
PLANT = 1 / (0.2 * S + 0.1)
L = CONTROLLER * PLANT


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(Drive())


@pytest.mark.parametrize("point", ["torque.tau", "controller.u", "error.u2"])
def test_the_loop_is_the_same_wherever_it_is_opened(system: ac.System, point: str) -> None:
    loop = ac.open_loop(system, point, {"inertia.w": 1.0})
    for found, exact in (
        (loop.transfer, L),
        (loop.opened, -L),
        (loop.sensitivity, 1 / (1 + L)),
        (loop.complementary, L / (1 + L)),
    ):
        np.testing.assert_allclose(found.frequency_response(OMEGA)[:, 0, 0], exact, rtol=1e-9)
    assert loop.transfer.inputs == loop.sensitivity.outputs == (point,)
    assert loop.transfer.outputs == loop.complementary.outputs
    closed = ac.linearize(system).eigenvalues()
    np.testing.assert_allclose(loop.sensitivity.eigenvalues(), closed, rtol=1e-9)


def test_two_points_at_once(system: ac.System) -> None:
    loop = ac.open_loop(system, ["torque.tau", "error.u2"])
    G = loop.opened.frequency_response(OMEGA)
    assert loop.opened.outputs == ("controller.y", "sensor.w")
    np.testing.assert_allclose(G[:, 0, 1], -CONTROLLER, rtol=1e-9)
    np.testing.assert_allclose(G[:, 1, 0], PLANT, rtol=1e-9)
    np.testing.assert_allclose(G[:, 0, 0], 0, atol=1e-12)
    sensitivity = loop.sensitivity.frequency_response(OMEGA)
    np.testing.assert_allclose(sensitivity, np.linalg.inv(np.eye(2) - G), rtol=1e-8, atol=1e-12)
    assert "torque.tau" not in system.inputs


def test_what_no_connection_feeds_is_refused(system: ac.System) -> None:
    with pytest.raises(ac.DeclarationError, match=r"no connection feeds a signal 'torque.tua'"):
        ac.open_loop(system, "torque.tua")
    with pytest.raises(ac.DeclarationError, match=r"no connection feeds a signal 'inertia.w'"):
        ac.open_loop(system, "inertia.w")
