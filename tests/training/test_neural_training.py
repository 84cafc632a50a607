"""Promises hold at every step of a training, however hard it pushes."""

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.components import neural, translational as tl
from acausal.networks import law_of
from acausal.training.build_problem import build_problem
from acausal.training.objective.regularizers import Context
from acausal.training.optimizers.trainer import Trainer, advance, begin
from acausal.training.options import FitOptions
from tests.support.oscillator import M, record

UPDATES = 12
PLACES = jnp.asarray(np.concatenate([np.linspace(-3, 3, 61), [1e-30, -1e-30, 1e6, -1e6]]))


class Learner(ac.Component):
    """The oscillator, with nothing in it but what is learned."""

    def __init__(self) -> None:
        super().__init__()
        self.fixed, self.push = tl.Fixed(), tl.Force()
        self.mass = tl.Mass(m=M, s=ac.Start(0.0, fixed=True), v=ac.Start(0.0, fixed=True))
        scales: dict[str, Any] = {"input_scale": 0.5, "output_scale": 20.0, "width": 6, "depth": 1}
        self.spring = neural.Compliance(energy=True, convex=True, passive=True, **scales)
        self.damper = neural.Resistance(passive=True, monotone=True, odd=True, **scales)
        self.hysteresis = neural.Hysteresis(**scales)
        for part in (self.spring, self.damper, self.hysteresis):
            self.connect(self.fixed.flange, part.flange_a)
            self.connect(part.flange_b, self.mass.flange_a)
        self.connect(self.push.flange, self.mass.flange_b)


@eqx.filter_jit
def looked_at(params: dict[str, Any]) -> dict[str, tuple[jax.Array, ...]]:
    """Law, derivative and value of every network."""
    found: dict[str, tuple[jax.Array, ...]] = {}
    for name in ("spring.net", "damper.net", "hysteresis.net", "hysteresis.memory"):
        net = params[name]
        others = (jnp.ones(()),) if name == "hysteresis.memory" else ()
        found[name] = _mapped(net, others)
    return found


def _mapped(net: Any, others: tuple[jax.Array, ...]) -> tuple[jax.Array, ...]:
    def law(x: Any) -> Any:
        return law_of(net)(x, *others)

    functions = (law, jax.grad(law), lambda x: net(x, *others))
    return tuple(jax.vmap(f)(PLACES) for f in functions)


def check(params: dict[str, Any]) -> None:
    """What the elements of `Learner` promise."""
    found = jax.tree.map(np.asarray, looked_at(params))
    assert all(np.isfinite(a).all() for arrays in found.values() for a in arrays)
    for name in ("spring.net", "hysteresis.net"):
        law, derivative, energy = found[name]
        assert (derivative >= 0).all()
        assert (energy >= -1e-12 * (1 + PLACES**2)).all()
        assert (law * PLACES >= -1e-12 * (1 + PLACES**2)).all()
    law, derivative, _ = found["damper.net"]
    assert (derivative >= 0).all()
    assert (law * PLACES >= 0).all()
    assert (np.abs(law[:61] + law[60::-1]) <= 1e-12).all()
    assert (found["hysteresis.memory"][2] >= 0.1).all()


@pytest.mark.slow
def test_promises_hold_before_during_and_after_training() -> None:
    system = ac.compile(Learner())
    data = record(end=2.0).for_system(system)
    options = FitOptions(x0="model")  # the memory of the hysteresis is not measured
    problem = build_problem(system, {"record": data}, ("mass.a",), system.parameters(0), options)
    trainer = Trainer(
        optax.with_extra_args_support(optax.adam(0.3)), np.inf, lambda problem, trainable: {}
    )
    state = begin(trainer, problem.start(), jax.random.key(0))
    check(problem.assemble(state.trainable))
    seen = [state.trainable]
    for update in range(UPDATES):
        state, entry = advance(problem, trainer, state, jnp.asarray(update + 1))
        assert not bool(entry.rejected[0])
        check(problem.assemble(state.trainable))
        seen.append(state.trainable)
    moved = [
        float(jnp.max(jnp.abs(a - b)))
        for a, b in zip(jax.tree.leaves(seen[0]), jax.tree.leaves(seen[-1]), strict=True)
    ]
    assert max(moved) > 1


@pytest.mark.slow
def test_regularizers_look_at_the_law_of_an_energy() -> None:
    energy = ac.networks.Energy(secondary=1, input_scale=0.5, output_scale=20.0)(0)
    seen = jnp.asarray([[0.3, 1.0], [-0.2, 2.0]])
    params, context = {"net": energy}, Context(("net",), {"net": seen})
    at_zero = [float(energy.law(0.0, T)) / 20 for T in (1.0, 2.0)]
    penalty = ac.ZeroCrossing(1.0)(params, context)
    np.testing.assert_allclose(float(penalty), np.mean(np.square(at_zero)))
    everywhere = [float(energy.law(*row)) / 20 for row in seen.tolist()]
    penalty = ac.SmallCorrection(1.0)(params, context)
    np.testing.assert_allclose(float(penalty), np.mean(np.square(everywhere)))
    corrected = ac.remove_offset(params)["net"]
    assert float(corrected.law(0.0, 1.5)) == 0
    np.testing.assert_allclose(
        float(corrected.law(0.3, 1.5)),
        float(energy.law(0.3, 1.5) - energy.law(0.0, 1.5)),
        rtol=1e-12,
    )


def test_a_network_that_no_equation_calls_is_not_trained() -> None:
    """An option left it out, as ``learned=False`` of a battery's elements does."""

    class Half(ac.Component):
        x = ac.Variable(start=1.0, fixed=True)
        used = ac.Module(lambda key: ac.MLP(1, 2, 1, "tanh", key=key), takes=("1",))
        spare = ac.Module(lambda key: ac.MLP(1, 2, 1, "tanh", key=key), takes=("1",))

        def equations(self) -> Any:
            yield ac.Eq(ac.der(self.x), self.used(self.x))

    t = np.linspace(0, 1, 11)
    data = ac.Data(t, {"x": np.exp(-t)})
    with pytest.warns(UserWarning, match="no better than the targets' mean"):
        fit = ac.fit(
            ac.compile(Half()), data, ["x"], strategy="sequences", epochs=2, progress=False
        )
    assert list(fit.seen) == ["used"]
