"""States between the steps of a stiff model with events, where its fast mode follows a sine."""

import numpy as np

import acausal as ac

W, TAU = 2 * np.pi * 50, 1e-6


class Following(ac.Component):
    """A fast lag behind a sine, and an event that has nothing to do with it."""

    x = ac.Variable(start=0.0, fixed=True)
    on = ac.Discrete(kind="bool")

    def equations(self):
        yield ac.Eq(ac.der(self.x), (ac.sin(W * ac.time) - self.x) / TAU)
        yield ac.Eq(self.on, ac.time > 0.013)


def test_outputs_are_as_exact_as_the_steps():
    t = np.linspace(0.0, 0.04, 401)
    run = ac.simulate(ac.compile(Following()), t[-1], saveat=t)
    amplitude = 1 / (1 + 1j * W * TAU)
    x = np.imag(amplitude * np.exp(1j * W * t)) - np.imag(amplitude) * np.exp(-t / TAU)
    assert "Kvaerno5" in run.statistics.solver
    np.testing.assert_allclose(run["x"], x, atol=5e-6)
