"""XLA is asked to compile small loops as a whole, and does."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal._jax import batching
from acausal._jax.scan import stored_scan
from acausal._jax.xla import choose_options, compiles_small_loops
from acausal.components import translational as tl

EMITTERS = "--xla_cpu_use_fusion_emitters=false"
LOOPS = "--xla_backend_extra_options=xla_cpu_small_while_loop_byte_threshold=1048576"
PASSES = "--xla_disable_hlo_passes=while-loop-invariant-code-motion,while-loop-constant-sinking"
ASKED = f"{LOOPS} {EMITTERS} {PASSES}"
OTHER = "--xla_cpu_enable_fast_math=false"
OWN = "--xla_backend_extra_options=xla_cpu_other=1"


@pytest.mark.parametrize("version", ["0.7.0", "0.10.2", "0.10.3.dev20261101"])
@pytest.mark.parametrize(
    ("before", "after"),
    [
        ({}, ASKED),
        ({"XLA_FLAGS": OTHER}, f"{OTHER} {ASKED}"),
        ({"XLA_FLAGS": OWN}, f"{OWN} {EMITTERS} {PASSES}"),
    ],
    ids=["nothing", "other flags", "own options"],
)
def test_the_flag_is_added(version, before, after):
    environment = dict(before)
    for _ in range(2):
        choose_options(environment, version)
        assert environment["XLA_FLAGS"] == after


@pytest.mark.parametrize("version", ["0.6.2", "0.11.0", "1.0"])
def test_a_version_that_may_not_know_the_flag_is_not_asked(version):
    environment = {"XLA_FLAGS": OTHER}
    choose_options(environment, version)
    assert environment == {"XLA_FLAGS": OTHER}


def test_the_steps_of_a_simulation_are_one_function():
    """Both loops of a gradient; if this fails, a new version of XLA calls the option something else."""

    class Oscillator(ac.Component):
        def __init__(self):
            super().__init__()
            self.mass, self.spring, self.wall = tl.Mass(m=1.0), tl.Spring(c=1.0), tl.Fixed()
            self.connect(self.mass.flange_a, self.spring.flange_b)
            self.connect(self.spring.flange_a, self.wall.flange)

    system = ac.compile(Oscillator())

    @jax.jit
    @jax.grad
    def by_stiffness(c):
        params = {**system.parameters(), "spring.c": c}
        run = ac.simulate(system, (0, 1), dt=1e-3, params=params, x0=[1.0, 0.0], solver="heun")
        return jnp.sum(run["mass.s"] ** 2)

    assert compiles_small_loops()
    program = by_stiffness.lower(2.0).compile().as_text()
    assert (
        sum(" call(" in line and "xla_cpu_small_call" in line for line in program.split("\n")) == 2
    )


def test_where_xla_does_not_the_results_are_the_same(monkeypatch):
    """Loops are plain scans then, mapped by JAX."""

    def step(gain, x, u):
        return jnp.tanh(gain * x) + u, jnp.sum(x)

    def loss(x0, gain):
        _, end, sums = stored_scan(step, gain, x0, jnp.linspace(0.0, 1.0, 9))
        return jnp.sum(end) + jnp.sum(sums**2)

    def gradients():
        x0s = jnp.linspace(0.0, 1.0, 33).reshape(11, 3)
        return jax.jit(jax.vmap(jax.grad(loss, (0, 1)), (0, None)))(x0s, jnp.asarray(0.7))

    expected = gradients()
    asked = []
    monkeypatch.setattr(batching, "compiles_small_loops", lambda: asked.append(True))
    for own, wanted in zip(gradients(), expected, strict=True):
        np.testing.assert_allclose(own, wanted, rtol=1e-12)
    assert asked
