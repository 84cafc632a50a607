import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
import pytest

import acausal as ac
from acausal.simulation.fixed_steps import integrate
from acausal.training.build_problem import build_problem
from acausal.training.objective import losses
from acausal.training.objective.modifiers import modifiers
from acausal.training.objective.problem import Problem
from acausal.training.objective.regularizers import Context
from acausal.training.objective.sequences import Sequences
from acausal.training.optimizers.trainer import Trainer, advance, begin, evaluate_healthy
from acausal.training.options import FitOptions
from tests.support.oscillator import force, learned, plain, record
from tests.support.slow_machine import slow_down

CUBIC = 80.0


def problem(system=None, data=None, targets=("mass.a",), **chosen):
    system = learned() if system is None else system
    options = FitOptions(**({"sequence_length": 0.5, "batch_size": 4} | chosen))
    data = (record() if data is None else ac.Data.of(data)).for_system(system)
    return build_problem(system, {"record": data}, targets, system.parameters(0), options)


# -- the loss ----------------------------------------------------------------------------------------


def test_nrmse_is_the_papers():
    rng = np.random.default_rng(0)
    q, p, sigma = rng.normal(size=(50, 2)), rng.normal(size=(50, 2)), np.array([2.0, 3.0])
    expected = np.sqrt(np.sum(((q - p) / sigma) ** 2) / 50)
    assert float(losses.nrmse(jnp.asarray(p), jnp.asarray(q), jnp.asarray(sigma))) == pytest.approx(
        expected
    )


def test_nrmse_of_a_perfect_prediction_has_a_gradient():
    q = jnp.ones((5, 1))
    assert float(jax.grad(lambda p: losses.nrmse(p * q, q, jnp.ones(1)))(1.0)) == 0


@pytest.mark.slow
@pytest.mark.cases(fast=1)
@pytest.mark.parametrize(
    "chosen",
    [
        {},
        {"sequence_length": None, "batch_size": 1},
        {"subsample": 0.25, "dt": 0.005, "solver": "rk4", "modifiers": ["mass.m", "spring.c"]},
    ],
    ids=["sequences", "whole", "points, substeps, modifiers"],
)
def test_the_gradient_of_the_loss_is_that_of_differences(chosen):
    posed = problem(regularizers=(ac.ZeroCrossing(), ac.SmallCorrection()), **chosen)
    start, batch = posed.start(), posed.draw(jax.random.key(3))
    start = jax.tree.map(lambda a: a + 0.1, start)  # no modifier at zero

    def total(trainable):
        return jnp.mean(posed.losses(trainable, batch)) + sum(posed.penalties(trainable).values())

    total = eqx.filter_jit(total)
    gradient = jax.grad(total)(start)
    directions = [
        jax.tree.map(lambda a, k=k: jax.random.normal(jax.random.key(k), a.shape), start)
        for k in (0, 1)
    ]
    for direction in directions:
        along = sum(jax.tree.leaves(jax.tree.map(lambda g, d: jnp.sum(g * d), gradient, direction)))
        ends = [
            total(jax.tree.map(lambda a, d, e=e: a + e * d, start, direction))
            for e in (1e-6, -1e-6)
        ]
        assert float(along) == pytest.approx(float(ends[0] - ends[1]) / 2e-6, rel=1e-6)


@pytest.mark.slow
def test_the_loss_of_sequences_is_that_of_simulations():
    posed = problem(sequence_length=1.0, batch_size=2)
    batch = posed.draw(jax.random.key(1))
    values = posed.losses(posed.start(), batch)
    data, sigma = record(), record()["mass.a"].std()
    for i, start in enumerate(np.asarray(batch.start).tolist()):
        part = data.between(0.01 * start - 1e-6, 0.01 * start + 0.99 + 1e-6)
        sol = ac.simulate(
            learned(), (part.time[0], part.time[-1]), dt=0.01, solver="heun", params=posed.params,
            inputs={"push.f": part["push.f"]}, x0=[part["mass.s"][0], part["mass.v"][0]],
        )  # fmt: skip
        expected = np.sqrt(np.mean(((sol["mass.a"] - part["mass.a"]) / sigma) ** 2))
        assert float(values[i]) == pytest.approx(expected, rel=1e-8)


@pytest.mark.slow
def test_substeps_are_smaller_steps():
    fine, coarse = problem(dt=0.0025), problem()
    start = learned().values(0.0, jnp.zeros(2), jnp.zeros(1), learned().parameters(0))
    ends = [integrate(learned(), start, p.records.steps, p.solver, substeps=p.substeps)[2]
            for p in (fine, coarse)]  # fmt: skip
    sol = ac.simulate(
        learned(), (0, 20.0), dt=0.0025, solver="heun", params=learned().parameters(0),
        inputs=record(), saveat=record().time,
    )  # fmt: skip
    xs = integrate(learned(), start, fine.records.steps, fine.solver, substeps=4)[0]
    np.testing.assert_allclose(xs, sol.x, atol=1e-9)
    assert float(jnp.abs(ends[0] - ends[1]).max()) > 1e-6


@pytest.mark.slow
def test_uneven_records_are_integrated_from_sample_to_sample():
    time = np.sort(np.r_[0.0, np.random.default_rng(0).uniform(0, 5, 800), 5.0])
    true = ac.simulate(
        plain(), (0, 5), inputs={"push.f": (time, force(time))}, saveat=time, rtol=1e-9, atol=1e-11
    )
    data = ac.Data(time, {n: true[n] for n in ("mass.a", "push.f", "mass.s", "mass.v")})
    assert not data.uniform
    posed = problem(
        plain(), data, sequence_length=None, batch_size=1, modifiers=["mass.m"], solver="rk4"
    )
    assert float(posed.simulate(posed.start())[0]) < 1e-5


# -- training ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_hardening_spring_is_learned():
    fit = ac.fit(
        learned(), record(), ["mass.a"], sequence_length=0.5, batch_size=16, epochs=400,
        regularizers=[ac.ZeroCrossing()], progress=False,
    )  # fmt: skip
    assert fit.loss_before > 0.5
    assert fit.loss < 0.02
    low, high = fit.seen["extra.net"].interval(1)
    z = np.linspace(low[0], high[0], 50)
    spring = jax.vmap(fit.remove_offset()["extra.net"])(jnp.asarray(z))
    assert np.sqrt(np.mean((np.asarray(spring) - CUBIC * z**3) ** 2)) < 0.2  # newtons, of 2.3
    assert fit.seen["extra.net"].sigma[0] == pytest.approx(record()["mass.s"].std(), rel=0.02)
    sol = ac.simulate(
        learned(), (0, 20), dt=0.01, inputs=record(), params=fit.params, solver="heun"
    )
    error = np.sqrt(np.mean((sol["mass.a"] - record()["mass.a"]) ** 2)) / record()["mass.a"].std()
    assert error == pytest.approx(fit.loss, rel=1e-6)
    assert fit.history.loss.shape == fit.history.penalties["ZeroCrossing"].shape == (400,)
    assert fit.history.full_loss[:, 0].tolist() == list(range(0, 401, 40))
    assert fit.loss == fit.history.full_loss[:, 1].min()
    assert np.all(np.diff(fit.history.seconds) > 0)
    assert "Fit of extra.net" in repr(fit)
    assert 0 < fit.prepare_seconds < fit.seconds - fit.compile_seconds
    assert f"{fit.prepare_seconds:.3g} s to prepare" in repr(fit)


@pytest.mark.slow
def test_modifiers_find_a_mass_and_a_stiffness():
    true = record(cubic=0.0)
    params = plain().parameters() | {"mass.m": 2.0 * 1.1, "spring.c": 50 * 0.95}
    fit = ac.fit(
        plain(), true, ["mass.a"], params=params, modifiers={"mass.m": 0.2, "spring.c": 0.1},
        optimizer=optax.adam(0.05), epochs=200, dt=0.005, sequence_length=1.0, batch_size=4, progress=False,
    )  # fmt: skip
    assert fit.params["mass.m"] == pytest.approx(2.0, rel=2e-3)
    assert fit.params["spring.c"] == pytest.approx(50.0, rel=2e-3)
    assert fit.modifiers["mass.m"] == pytest.approx(1 / 1.1 - 1, abs=2e-3)
    assert fit.params["spring.d"] == params["spring.d"]
    assert fit.history.modifiers["mass.m"][0] == 0
    assert fit.seen == {}


def test_modifiers_stay_within_gamma():
    chosen = modifiers(
        {"mass.m": 0.3},
        0.2,
        plain().parameters(),
        plain().layout.why_not_free,
        plain().layout.range_of,
    )
    for delta in (-50.0, 50.0):
        assert abs(chosen.changes({"mass.m": jnp.asarray(delta)})["mass.m"]) <= 0.3


@pytest.mark.slow
def test_the_same_seed_gives_the_same_weights():
    def run(seed):
        fit = ac.fit(learned(), record(), "mass.a", sequence_length=0.2, batch_size=3, epochs=20,
                     subsample=0.5, seed=seed, progress=False)  # fmt: skip
        return fit.history.loss, eqx.filter(fit.params["extra.net"], eqx.is_inexact_array)

    a, b, c = run(0), run(0), run(1)
    np.testing.assert_array_equal(a[0], b[0])
    jax.tree.map(np.testing.assert_array_equal, a[1], b[1])
    assert not np.array_equal(a[0], c[0])


@pytest.mark.slow
def test_users_losses_regularizers_and_optimizers():
    def absolute(predicted, measured, sigma):
        assert predicted.shape == measured.shape in ((20, 1), (1001, 1))
        return jnp.mean(jnp.abs(predicted - measured) / sigma)

    def small_mass(params, context):
        assert context.networks == ("extra.net",)
        assert context.arguments["extra.net"].shape == (1000, 1)
        return 1e-3 * params["mass.m"] ** 2

    fit = ac.fit(
        learned(), record(end=10.0), "mass.a", loss=absolute,
        regularizers=[small_mass, ac.ZeroCrossing(), ac.ZeroCrossing(1.0)],
        sequence_length=0.2, batch_size=2, epochs=5, optimizer=optax.sgd(1e-3), evaluate_every=5, progress=False,
    )  # fmt: skip
    assert list(fit.history.penalties) == ["small_mass", "ZeroCrossing", "ZeroCrossing 2"]
    np.testing.assert_allclose(fit.history.penalties["small_mass"], 4e-3)


@pytest.mark.machines
def test_an_optimizer_with_a_line_search():
    fit = ac.fit(
        learned(), record(end=2.0), "mass.a", optimizer=optax.lbfgs(), epochs=10, progress=False
    )
    assert fit.loss < 0.3 * fit.loss_before


@pytest.mark.slow
def test_fixed_networks_stay():
    params = learned().parameters(0)
    fit = ac.fit(
        learned(), record(), "mass.a", params=params, train=[], modifiers=["mass.m"],
        sequence_length=0.2, epochs=3, progress=False,
    )  # fmt: skip
    assert fit.params["extra.net"](0.3) == params["extra.net"](0.3)


@pytest.mark.slow
def test_regularizers_formulas():
    net, two = ac.MLP(output_scale=5.0, key=0), ac.MLP(2, key=1)
    seen = {"a": jnp.asarray([[0.1], [0.2]]), "b": jnp.asarray([[0.1, 3.0], [0.2, 4.0]])}
    context = Context(("a", "b"), seen)
    params = {"a": net, "b": two}
    at_zero = (net(0.0) / 5) ** 2 + (two(0.0, 3.0) ** 2 + two(0.0, 4.0) ** 2) / 2
    assert float(ac.ZeroCrossing(0.3)(params, context)) == pytest.approx(float(0.3 * at_zero))
    given = ac.ZeroCrossing(1.0, ("b",), {"b": [7.0]})
    assert float(given(params, context)) == pytest.approx(float(two(0.0, 7.0) ** 2))
    size = ((net(0.1) / 5) ** 2 + (net(0.2) / 5) ** 2) / 2
    assert float(ac.SmallCorrection(2.0, ("a",))(params, context)) == pytest.approx(float(2 * size))
    with pytest.raises(ac.TrainingError, match="names the network 'c'"):
        ac.ZeroCrossing(1.0, ("c",))(params, context)


def cut(**chosen) -> Sequences:
    return problem(**chosen).sequences


# -- sequences ---------------------------------------------------------------------------------------


def test_batches():
    batch = cut(batch_size=64, subsample=0.2).draw(jax.random.key(0))
    assert batch.points is not None
    assert batch.points.shape == (64, 10)
    assert all(len(set(row)) == 10 for row in np.asarray(batch.points).tolist())
    assert int(batch.start.min()) >= 0
    assert int(batch.start.max()) <= 2001 - 50
    whole = cut(sequence_length=None, batch_size=1)
    assert whole.whole
    assert whole.draw(jax.random.key(0)).start.tolist() == [0]


def test_leaving_out_repeats_a_good_sequence():
    batch = cut(subsample=0.2).draw(jax.random.key(0))
    kept = batch.without(jnp.asarray([True, False, True, False]))
    assert kept.weight.tolist() == [0, 1, 0, 1]
    assert kept.start.tolist() == [batch.start[1], batch.start[1], batch.start[1], batch.start[3]]
    assert kept.points is not None
    np.testing.assert_array_equal(kept.points[0], kept.points[1])


# -- divergence and interruption ---------------------------------------------------------------------


def broken(where: slice, data: ac.Data | None = None) -> ac.Data:
    """A record whose states are absurd in a stretch, so that sequences that start there diverge."""
    data = record(end=10.0) if data is None else data
    speed = data["mass.v"].copy()
    speed[where] = 1e160
    return ac.Data(data.time, {**data.signals, "mass.v": speed})


class Explosive(eqx.Module):
    """A network that overflows at large arguments."""

    weight: jax.Array

    def __call__(self, x):
        return self.weight * x**3


def explosive():
    return learned().parameters() | {"extra.net": Explosive(jnp.asarray(0.0))}


@pytest.mark.slow
def test_a_diverging_sequence_is_left_out_and_told():
    data = broken(slice(400, 500))
    with pytest.warns(UserWarning, match="Something diverged in .* of 150 epochs"):
        fit = ac.fit(
            learned(), data, "mass.a", params=explosive(), sequence_length=0.5, batch_size=8, epochs=150,
            optimizer=optax.adam(1.0), x0={"mass.v": 0.0}, progress=False,
        )  # fmt: skip
    assert fit.history.divergences
    for divergence in fit.history.divergences:
        assert 4.0 - 1e-9 <= divergence.time < 5.0
        assert not divergence.rejected
        assert np.isfinite(fit.history.loss[divergence.epoch])
    assert float(fit.params["extra.net"].weight) == pytest.approx(CUBIC, rel=0.02)
    assert "diverged" in repr(fit)
    assert "s diverged; left out" in str(fit.history.divergences[0]) or "more diverged" in str(
        fit.history.divergences[0]
    )


@pytest.mark.slow
def test_the_good_sequences_give_the_gradient_they_give_alone():
    """With a bad sequence in the batch, the update is that of the others."""
    data = broken(slice(400, 500))
    posed = problem(data=data, batch_size=3)
    trainer = Trainer(optax.with_extra_args_support(optax.sgd(1.0)), 1e3, Problem.changes)
    state = begin(trainer, posed.start(), jax.random.key(0))
    bad = eqx.tree_at(
        lambda b: b.start, posed.draw(jax.random.key(0)), jnp.asarray([100, 450, 700])
    )
    good = jax.tree.map(lambda a: a[np.array([0, 2])], bad)
    _, mixed, mask, _ = evaluate_healthy(posed, trainer, state.trainable, bad)
    _, alone, _, _ = evaluate_healthy(posed, trainer, state.trainable, good)
    assert mask.tolist() == [False, True, False]
    jax.tree.map(
        lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-10, atol=1e-12),
        mixed.gradient,
        alone.gradient,
    )


@pytest.mark.slow
def test_too_many_rejections_end_the_training():
    data = broken(slice(0, 1001))
    with pytest.raises(ac.TrainingError) as error:
        ac.fit(
            learned(), data, "mass.a", sequence_length=0.5, batch_size=2, epochs=500,
            x0={"mass.v": 0.0}, progress=False,
        )  # fmt: skip
    message = str(error.value)
    assert "updates in a row were rejected from epoch 0 on: the sequence from t = " in message
    assert message.endswith("or a smaller dt.")


@pytest.mark.slow
def test_a_training_that_diverges_names_the_state_that_runs_away_and_the_scales():
    with pytest.raises(ac.TrainingError) as error:
        ac.fit(
            learned(),
            record(end=3.0),
            "mass.a",
            params={"mass.m": 1e-4},
            epochs=200,
            strategy="sequences",
            progress=False,
        )
    message = str(error.value)
    assert "diverges in steps of 0.01 s by Heun, and 'mass.v' runs away to " in message
    assert "input_scale= and output_scale=, which are now 0.5 and 20 of 'extra.net'" in message


@pytest.mark.slow
def test_a_fit_that_is_no_better_than_the_mean_says_so():
    expected = r"no better than the targets' mean: its error is [\d.]+, that of the mean 1.41, that of the noise"
    with pytest.warns(UserWarning, match=expected):
        fit = ac.fit(
            plain(), record(cubic=0.0), ["mass.s", "mass.v"], modifiers={"mass.m": 0.2}, epochs=1,
            params={"spring.c": 33.6, "spring.d": 0.0}, strategy="sequences", progress=False,
        )  # fmt: skip
    assert fit.loss > np.sqrt(2)


@pytest.mark.slow
def test_a_gradient_that_is_not_finite_is_rejected():
    def poison(params, context):
        m = params["mass.m"]
        return jnp.where(m > 1.99, jnp.sqrt(m - m), 0.0)  # zero, with an infinite derivative

    with pytest.raises(ac.TrainingError, match="the gradient is not finite"):
        ac.fit(plain(), record(), "mass.a", modifiers=["mass.m"], regularizers=[poison],
               sequence_length=0.2, epochs=500, progress=False)  # fmt: skip


@pytest.mark.slow
def test_a_rejected_update_leaves_everything_as_it_was():
    """One gradient in the middle is not finite: the weights and Adam's moments stay, and training goes on."""

    def poison(params, context):
        m = params["mass.m"]
        near = jnp.abs(m - 2.0) < 1e-9  # only before the first update
        return jnp.where(near, jnp.sqrt(jnp.maximum(m - 2.0, 0.0)), 0.0)

    posed = problem(plain(), modifiers=["mass.m"], regularizers=(poison,))
    trainer = Trainer(optax.with_extra_args_support(optax.adam(0.1)), 1e3, Problem.changes)
    state = begin(trainer, posed.start(), jax.random.key(0))
    after, log = advance(posed, trainer, state, jnp.asarray(1))
    assert bool(log.rejected[0])
    assert int(after.rejected) == int(after.epoch) == 1
    jax.tree.map(np.testing.assert_array_equal, after.trainable, state.trainable)
    jax.tree.map(np.testing.assert_array_equal, after.optimizer, state.optimizer)


@pytest.mark.slow
def test_ctrl_c_returns_the_best_so_far():
    def interrupt(progress):
        if progress.epoch >= 60:
            raise KeyboardInterrupt

    fit = ac.fit(
        learned(), record(), ["mass.a"], sequence_length=0.5, batch_size=4, epochs=100_000, evaluate_every=20,
        optimizer=optax.adam(1e-2), observers=[interrupt], progress=False,
    )  # fmt: skip
    assert fit.interrupted
    assert 60 <= fit.history.epochs < 300
    assert fit.loss == fit.history.full_loss[:, 1].min() < fit.loss_before
    assert "(interrupted)" in repr(fit)


@pytest.mark.slow
def test_progress_is_reported(capsys):
    seen = []
    ac.fit(learned(), record(), "mass.a", sequence_length=0.2, epochs=30, observers=[seen.append])
    assert [p.epoch for p in seen] == sorted(p.epoch for p in seen)
    assert seen[-1].epoch == seen[-1].epochs == 30
    assert capsys.readouterr().err == ""  # no terminal, no display


@pytest.mark.slow
def test_chunks_do_not_change_the_result(monkeypatch):
    def run():
        return ac.fit(
            learned(), record(), "mass.a", sequence_length=0.2, epochs=12, progress=False
        ).history.loss

    many = run()
    slow_down(monkeypatch)
    np.testing.assert_array_equal(run(), many)


# -- starts ------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_outputs_alone_suffice_for_the_whole_record():
    data = record(end=10.0).select(["mass.a", "push.f"])
    for x0 in ("model", {"mass.s": 0.0, "mass.v": 0.0}):
        fit = ac.fit(
            learned(),
            data,
            "mass.a",
            x0=x0,
            epochs=10,
            regularizers=[ac.SmallCorrection()],
            progress=False,
        )
        assert fit.loss < fit.loss_before


@pytest.mark.parametrize(
    ("chosen", "kind", "sentence"),
    [
        ({"data": ["mass.a", "push.f"]}, ac.DataError,
         ("The data lack 'mass.s', 'mass.v': sequences start from measured states. "
          "Let the training find where they start (x0='fit'), or train on the whole record "
          "(sequence_length=None) with x0='model' or x0={...}.")),
        ({"data": ["mass.a", "push.f", "mass.s"], "sequence_length": None, "batch_size": 1, "x0": "data"},
         ac.DataError,
         ("The data lack 'mass.v', with which the record starts: "
          "leave out x0='data' to have them found, or give x0={'mass.v': ...}.")),
        ({"x0": {"mass.x": 0.0}}, ac.DataError, "x0: 'mass.x' is not a state; did you mean 'mass.v'?"),
        ({"x0": {"mass.s": float("nan")}}, ac.DataError, "x0: 'mass.s' is nan; give a finite number."),
        ({"x0": {"mass.s": np.zeros(1)}}, ac.DataError, "x0: 'mass.s' is array([0.]); give a finite number."),
        ({"x0": {"mass.s": "rest"}}, ac.DataError, "x0: 'mass.s' is 'rest'; give a finite number."),
        ({"x0": "modle"}, ac.DataError, "x0='modle' is not an initial state: did you mean 'model'?"),
        ({"data": ["mass.a", "mass.s", "mass.v"]}, ac.DataError, "The data lack 'push.f', an input of the model."),
        ({"targets": ("spring.f",)}, ac.DataError,
         "The data lack 'spring.f', a target of the training: known are 'mass.s', 'mass.v', 'mass.a'."),
        ({"targets": ("mass.A",)}, ac.DataError,
         "The data lack 'mass.A', a target of the training: did you mean 'mass.a'?"),
        ({"sequence_length": 100.0}, ac.DataError,
         "sequence_length=100 s is 10000 samples; the record has 2001 at 0.01 s."),
        ({"sequence_length": float("nan")}, ac.TrainingError, "sequence_length=nan is not a number of seconds."),
        ({"batch_size": 2.5}, ac.TrainingError, "batch_size=2.5; give a whole number, 1 or more."),
        ({"sequence_length": None}, ac.DataError,
         "batch_size=4 needs a sequence_length in seconds, shorter than the record."),
        ({"subsample": 1.5}, ac.DataError, "subsample=1.5 is not a fraction of the points; give a number in (0, 1]."),
        ({"dt": 0.003}, ac.TrainingError,
         "dt=0.003 s does not divide the data's sample time, 0.01 s: choose 0.00333333 s, or resample the data."),
        ({"train": ["extra.nets"]}, ac.TrainingError,
         "There is no network 'extra.nets' to train: did you mean 'extra.net'?"),
        ({"train": ["mass.m"]}, ac.TrainingError,
         "'mass.m' is a parameter, no network: give modifiers=['mass.m'] to train it."),
        ({"modifiers": ["mass.k"]}, ac.TrainingError,
         "There is no parameter 'mass.k' to train: did you mean 'mass.m'?"),
        ({"modifiers": {"mass.m": 1.5}}, ac.TrainingError,
         "The modifier of 'mass.m' has gamma=1.5; choose it between 0 and 1."),
        ({"train": []}, ac.TrainingError,
         ("There is nothing to train: no network is in the model or chosen by train=[...]. "
          "Give modifiers=[...] to train parameters.")),
        ({"loss": "rmse"}, ac.TrainingError, "No loss 'rmse': did you mean 'nrmse'?"),
        ({"targets": ()}, ac.TrainingError, "There are no targets: name the variables to fit."),
        ({"targets": ("mass.a", "mass.a")}, ac.TrainingError,
         "A target is named twice in 'mass.a', 'mass.a'."),
        ({"targets": ("push.f",)}, ac.TrainingError,
         "'push.f': a target is what the model computes, not its input."),
    ],
)  # fmt: skip
def test_mistakes_get_one_sentence(chosen, kind, sentence):
    data = record().select(chosen.pop("data", record().signals))
    with pytest.raises(kind) as error:
        problem(data=data, **chosen)
    assert str(error.value) == sentence


def test_a_constant_target_is_refused():
    data = record()
    flat = ac.Data(data.time, {**data.signals, "mass.a": np.full(len(data), 3.0)})
    with pytest.raises(ac.DataError, match=r"^Target 'mass.a' is constant in the data"):
        problem(data=flat)


def test_a_parameter_at_zero_cannot_be_modified():
    params = plain().parameters() | {"spring.d": 0.0}
    with pytest.raises(
        ac.TrainingError, match=r"Parameter 'spring\.d' is 0, and a modifier multiplies"
    ):
        modifiers(["spring.d"], 0.2, params, plain().layout.why_not_free, plain().layout.range_of)


@pytest.mark.slow
def test_what_needs_numbers_says_so_where_jax_traces():
    system, data = plain(), record()
    calls = (
        lambda p: ac.fit(system, data, "mass.a", modifiers=["mass.m"], params={"mass.m": p}),
        lambda p: ac.Data([0.0, 1.0], {"mass.a": [p, p]}),
        lambda p: ac.export.c(system, "nowhere", params={"mass.m": p}),
        lambda p: ac.save_params({"mass.m": p}, "nowhere"),
    )
    for call in calls:
        with pytest.raises(ac.AcausalError, match=r"needs numbers, .*outside of jax\.jit"):
            jax.jit(call)(1.0)
