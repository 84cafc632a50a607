import itertools
from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.codegen import newton
from acausal.components import blocks as bl
from acausal.data.record import Data
from acausal.simulation.solvers import RK4, SOLVERS
from tests.support.counted import compilations
from tests.support.oscillator import C, M, force, plain, record, undamped
from tests.support.parts import Equations

OMEGA = np.sqrt(C / M)
AT_ONE = {"mass.s": 1.0}
NO_FORCE = {"push.f": 0.0}


def error(solver, dt):
    """Of an undamped oscillator's position and speed after 2 s."""
    end = ac.simulate(undamped(), (0, 2), dt=dt, inputs=NO_FORCE, x0=AT_ONE, solver=solver).x[-1]
    exact = jnp.asarray([np.cos(2 * OMEGA), -OMEGA * np.sin(2 * OMEGA)])
    return float(jnp.abs(end - exact).max())


# -- accuracy ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("solver", "order"),
    [
        ("euler", 1),
        ("heun", 2),
        ("midpoint", 2),
        ("bosh3", 3),
        ("rk4", 4),
        ("tsit5", 5),
        ("implicit_euler", 1),
    ],
)
def test_fixed_steps_converge_with_their_order(solver, order):
    coarse, fine = (0.02, 0.01) if order > 1 else (0.001, 0.0005)
    ratio = error(solver, coarse) / error(solver, fine)
    assert np.log2(ratio) == pytest.approx(order, abs=0.25 if order < 5 else 0.5)


def test_unrolled_steps_are_diffrax_own():
    ours = ac.simulate(undamped(), (0, 1), dt=0.01, inputs=NO_FORCE, x0=AT_ONE, solver="tsit5")
    theirs = diffrax.diffeqsolve(
        diffrax.ODETerm(lambda t, x, p: undamped().vector_field(t, x, jnp.zeros(1), p)),
        diffrax.Tsit5(), 0, 1, 0.01, jnp.asarray([1.0, 0.0]), undamped().pack(None),
        stepsize_controller=diffrax.ConstantStepSize(),
    )  # fmt: skip
    assert theirs.ys is not None
    np.testing.assert_allclose(ours.x[-1], theirs.ys[-1], rtol=1e-11)


def test_adaptive_steps_keep_the_energy():
    sol = ac.simulate(undamped(), (0, 20), inputs=NO_FORCE, x0=AT_ONE, rtol=1e-10, atol=1e-12)
    energy = M / 2 * sol["mass.v"] ** 2 + C / 2 * sol["mass.s"] ** 2
    np.testing.assert_allclose(energy, C / 2, rtol=1e-7)
    assert sol.t.shape == (500,)


@pytest.mark.parametrize("solver", ["dopri8", "kvaerno5", diffrax.Dopri5()])
def test_adaptive_solvers_agree(solver):
    sol = ac.simulate(
        plain(), (0, 2), inputs={"push.f": jnp.sin}, solver=solver, rtol=1e-9, atol=1e-11
    )
    reference = ac.simulate(plain(), (0, 2), dt=0.001, inputs={"push.f": jnp.sin})
    assert float(sol["mass.s"][-1]) == pytest.approx(float(reference["mass.s"][-1]), rel=1e-7)


@pytest.mark.slow
def test_auto_takes_an_implicit_solver_for_a_stiff_model():
    params = plain().parameters() | {"spring.d": 1e6, "mass.m": 1.0}  # modes at -1e6 and -5e-5 1/s
    run: dict[str, Any] = {"params": params, "inputs": NO_FORCE, "x0": AT_ONE}
    sol = ac.simulate(plain(), (0, 10), max_steps=1000, **run)
    assert float(sol["mass.s"][-1]) == pytest.approx(np.exp(-50e-6 * 10), rel=1e-6)
    with pytest.raises(ac.SimulationError, match=r"after max_steps=1000\. Perhaps it is stiff"):
        ac.simulate(plain(), (0, 10), max_steps=1000, solver="tsit5", **run)
    with pytest.raises(ac.SimulationError, match=r"after max_steps=5\. Perhaps it slides"):
        ac.simulate(plain(), (0, 10), max_steps=5, solver="stiff", **run)


# -- inputs ------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_sampled_inputs_equal_functions():
    ends = np.linspace(0, 3, 301)
    signal = ac.Signal(ends, force(ends))
    ways = {
        "samples": force(ends),
        "pair": (ends, force(ends)),
        "signal": signal,
        "function": lambda t: signal(t),
        "every second": (ends[::2], force(ends[::2])),
        "every second, function": lambda t: ac.Signal(ends[::2], force(ends[::2]))(t),
    }
    x = {
        n: ac.simulate(plain(), (0, 3), dt=0.01, inputs={"push.f": way}).x
        for n, way in ways.items()
    }
    for name in ("pair", "signal", "function"):
        np.testing.assert_allclose(x[name], x["samples"], rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(
        x["every second, function"], x["every second"], rtol=1e-9, atol=1e-11
    )


@pytest.mark.slow
def test_inputs_off_the_grid_are_read_at_stage_times():
    odd = (np.linspace(0, 3, 77), force(np.linspace(0, 3, 77)))
    fixed = ac.simulate(plain(), (0, 3), dt=1e-3, inputs={"push.f": odd})
    adaptive = ac.simulate(plain(), (0, 3), inputs={"push.f": odd}, rtol=1e-9, atol=1e-11)
    np.testing.assert_allclose(fixed.x[-1], adaptive.x[-1], rtol=1e-5)


@pytest.mark.slow
def test_held_inputs_jump_where_they_jump():
    """A step of the force at 1 s: the response is the shifted step response."""
    step = ac.Signal([0.0, 1.0, 9.0], [0.0, 5.0, 5.0], "previous")
    fixed = ac.simulate(undamped(), (0, 2), dt=0.01, inputs={"push.f": step})
    adaptive = ac.simulate(undamped(), (0, 2), inputs={"push.f": step}, rtol=1e-10, atol=1e-12)
    exact = 5 / C * (1 - np.cos(OMEGA))
    assert float(fixed["mass.s"][-1]) == pytest.approx(exact, rel=1e-7)
    assert float(adaptive["mass.s"][-1]) == pytest.approx(exact, rel=1e-8)
    assert float(fixed["push.f"][99]) == 0
    assert float(fixed["push.f"][100]) == 5


def test_a_record_gives_the_inputs():
    data = record(end=2.0)
    sol = ac.simulate(plain(), (0, 2), dt=0.01, inputs=data)
    np.testing.assert_allclose(sol["push.f"], data["push.f"])


# -- results -----------------------------------------------------------------------------------------


def test_any_variable_by_name(tmp_path):
    sol = ac.simulate(plain(), (0, 1), dt=0.01, inputs={"push.f": 3.0})
    np.testing.assert_allclose(sol["push.f"], 3)
    np.testing.assert_allclose(M * sol["mass.a"], 3 - sol["spring.f"], atol=1e-12)
    assert sol["mass.a"] is sol["mass.a"]
    assert repr(sol) == f"Solution(101 points from 0 to 1 s, {len(plain().variables)} variables)"
    with pytest.raises(ac.DataError, match=r"no variable 'mass\.b': did you mean 'mass"):
        sol["mass.b"]
    sol.to_csv(tmp_path / "run.csv", ["mass.s", "push.f"])
    again = Data.from_csv(tmp_path / "run.csv")
    assert again.units == {"mass.s": "m", "push.f": "N"}
    np.testing.assert_array_equal(again["mass.s"], sol["mass.s"])


def test_results_are_read_by_lists_of_names():
    sol = ac.simulate(plain(), (0, 1), dt=0.1, inputs={"push.f": 3.0})
    names = ["mass.a", "push.f", "mass.s"]
    expected = np.stack([sol[n] for n in names], axis=1)
    for form in (names, tuple(names), np.array(names), [np.str_(n) for n in names]):
        np.testing.assert_array_equal(sol[form], expected)
    assert sol[[]].shape == (11, 0)
    assert "mass.a" in sol
    assert np.str_("mass.a") in sol
    assert "mass.b" not in sol
    assert 0 not in sol
    assert list(sol) == list(sol.names)
    assert sol[np.str_("spring.f")].shape == (11,)
    assert list(sol.to_dict(np.array(names))) == ["time", *names]
    both = jax.jit(lambda f: ac.simulate(plain(), (0, 1), dt=0.1, inputs={"push.f": f})[names])(3.0)
    np.testing.assert_allclose(both, expected, atol=1e-12)
    observed = plain().observe(np.array(names), 0.0, sol.x[0], sol.u[0], sol.packed)
    np.testing.assert_allclose(observed, expected[0])
    with pytest.raises(ac.DataError, match=r"no variable 'mass\.b'"):
        sol[["mass.a", "mass.b"]]


@pytest.mark.parametrize("key", [0, None, 1.5, slice(2), ["mass.a", 1]])
def test_what_is_no_name(key):
    sol = ac.simulate(plain(), (0, 1), dt=0.1, inputs=NO_FORCE)
    with pytest.raises(
        ac.DataError, match=r" is not a name; give a text such as 'mass\.s', or a list"
    ):
        sol[key]


def test_saving_less():
    full = ac.simulate(plain(), (0, 1), dt=0.01, inputs={"push.f": jnp.sin})
    some = ac.simulate(plain(), (0, 1), dt=0.01, inputs={"push.f": jnp.sin}, saveat=[0, 0.25, 1])
    np.testing.assert_array_equal(some.x, full.x[np.array([0, 25, 100])])
    np.testing.assert_allclose(some["push.f"], np.sin([0, 0.25, 1]))


@pytest.mark.parametrize(
    ("write", "sentence"),
    [
        (lambda sol, folder: sol.to_csv(3.5), "to_csv: 3.5 is not a path; give a text such as"),
        (
            lambda sol, folder: sol.to_csv(folder / "none" / "x.csv", ["mass.s"]),
            r"'.*x\.csv' cannot be written: No such file or directory\.",
        ),
        (lambda sol, folder: sol.plot("mass.s", axes=["a"]), "axes='a' is not axes; give one of mat"),
        (lambda sol, folder: sol.plot("mass.s", axes=[]), "axes: there are 0; give one for each unit: 'm'"),
    ],
)  # fmt: skip
def test_where_nothing_can_be_written_or_drawn(write, sentence, tmp_path):
    sol = ac.simulate(plain(), (0, 0.3), dt=0.1, solver="heun", inputs=NO_FORCE)
    with pytest.raises(ac.DataError, match=f"^{sentence}"):
        write(sol, tmp_path)


def test_a_plot_has_units():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    sol = ac.simulate(plain(), (0, 1), dt=0.01, inputs=NO_FORCE, x0=AT_ONE)
    figure = sol.plot("mass.s", np.str_("spring.s_rel"), "mass.a")
    assert len(sol.plot(["mass.s", "mass.a"]).axes) == 2
    assert [ax.get_ylabel() for ax in figure.axes] == ["in m", "mass.a in m/s2"]
    assert figure.axes[-1].get_xlabel() == "time in s"
    pyplot.close(figure)


def test_a_data_frame_or_a_clear_word(monkeypatch):
    sol = ac.simulate(plain(), (0, 1), dt=0.1, inputs=NO_FORCE)
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with pytest.raises(ac.DataError, match=r"needs pandas: pip install 'acausal\[dataframe\]'"):
        sol.to_dataframe()


def test_a_data_frame():
    pytest.importorskip("pandas")
    sol = ac.simulate(plain(), (0, 1), dt=0.1, inputs=NO_FORCE, x0=AT_ONE)
    frame = sol.to_dataframe(["mass.s"])
    assert frame.index.name == "time"
    assert frame["mass.s"].iloc[0] == 1.0


# -- derivatives, jit, vmap --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "how",
    [
        {"dt": 0.01, "solver": "heun"},
        {"dt": 0.01, "solver": "implicit_euler"},
        {"solver": "tsit5", "rtol": 1e-12, "atol": 1e-12},
    ],
    ids=lambda how: how["solver"],
)
def test_gradients_by_parameters_and_starts(how):
    ends = np.linspace(0, 1, 101)
    push = (ends, force(ends)) if "dt" in how else jnp.cos  # kinks would make the difference rough
    base = plain().parameters()

    def loss(theta):
        params = base | {"spring.c": theta[0], "mass.m": theta[1]}
        sol = ac.simulate(
            plain(), (0, 1), inputs={"push.f": push}, params=params,
            x0={"mass.s": theta[2]}, saveat=[0.0, 0.5, 1.0], **how,
        )  # fmt: skip
        return jnp.sum(sol["mass.a"] ** 2)

    theta = jnp.asarray([C, M, 0.3])
    gradient = jax.grad(loss)(theta)
    step = 1e-5 * theta
    for i in range(3):
        moved = jnp.zeros(3).at[i].set(step[i])
        difference = (loss(theta + moved) - loss(theta - moved)) / (2 * step[i])
        assert float(gradient[i]) == pytest.approx(float(difference), rel=1e-6)


@pytest.mark.slow
def test_adaptive_steps_have_derivatives_in_both_modes():
    """Without a choice of diffrax's adjoint, alone and within `jax.jit` and `jax.vmap`."""

    def ends(theta):
        params = plain().parameters() | {"spring.c": theta[0]}
        return ac.simulate(
            plain(), (0, 1), inputs=NO_FORCE, params=params, x0={"mass.s": theta[1]}, saveat=[0, 1]
        ).x[-1]

    theta = jnp.asarray([C, 0.3])
    reverse = jax.jacrev(ends)(theta)
    np.testing.assert_allclose(jax.jacfwd(ends)(theta), reverse, rtol=1e-9)
    many = jax.jit(jax.vmap(jax.jacfwd(ends)))(jnp.stack([theta, 1.1 * theta]))
    np.testing.assert_allclose(many[0], reverse, rtol=1e-9)
    with pytest.raises(ac.DataError, match=r"^Adaptive steps have no second derivatives"):
        jax.jacfwd(jax.grad(lambda theta: ends(theta)[0]))(theta)


@pytest.mark.slow
def test_gradient_by_samples_of_the_input():
    def end(samples):
        return ac.simulate(plain(), (0, 1), dt=0.1, inputs={"push.f": samples})["mass.s"][-1]

    samples = jnp.ones(11)
    weights = jax.grad(end)(samples)
    assert float(weights @ samples) == pytest.approx(float(end(samples)))  # linear in the force


def test_jit_and_vmap():
    def end(c, s):
        params = plain().parameters() | {"spring.c": c}
        return ac.simulate(
            plain(), (0, 1), dt=0.01, inputs=NO_FORCE, params=params, x0={"mass.s": s}
        ).x[-1]

    c, s = jnp.asarray([40.0, 50.0]), jnp.asarray([0.1, 0.2])
    many = jax.jit(jax.vmap(end))(c, s)
    np.testing.assert_allclose(many[1], end(50.0, 0.2), rtol=1e-12)
    solution = jax.jit(
        lambda s: ac.simulate(plain(), (0, 1), dt=0.1, inputs=NO_FORCE, x0={"mass.s": s})
    )(0.5)
    assert float(solution["mass.s"][0]) == 0.5


def test_a_second_call_does_not_compile():
    def run(c):
        params = plain().parameters() | {"spring.c": c}
        sol = ac.simulate(plain(), (0, 1), dt=0.02, inputs={"push.f": np.ones(51)}, params=params)
        return sol["spring.f"].block_until_ready()

    run(40.0)
    with compilations() as compiled:
        run(60.0)
    assert not compiled


def test_what_a_variable_was_computed_with_is_not_computed_again():
    sol = ac.simulate(plain(), (0, 1), dt=0.02, inputs={"push.f": np.ones(51)})
    together = ac.simulate(plain(), (0, 1), dt=0.02, inputs={"push.f": np.ones(51)})
    sol["mass.a"].block_until_ready()
    names = ["mass.flange_a.f", "spring.f", "spring.flange_a.f"]
    with compilations() as compiled:
        one_by_one = np.stack([sol[n] for n in names], axis=1)
    assert not compiled
    np.testing.assert_allclose(one_by_one, together[names], rtol=1e-14)


# -- errors ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "kind", "sentence"),
    [
        ({}, ac.DataError, "No value for the model's input 'push.f': give inputs={'push.f': ...}."),
        (
            {"inputs": {"push.g": 1}},
            ac.DataError,
            "The model has no input 'push.g': did you mean 'push.f'?",
        ),
        (
            {"inputs": {"push.f": np.ones(3)}},
            ac.DataError,
            "Input 'push.f' has samples but no times: give (times, samples), or dt for fixed steps.",
        ),
        (
            {"inputs": {"push.f": np.ones(3)}, "dt": 0.1},
            ac.DataError,
            "Input 'push.f' has samples of shape (3,); the 10 steps from 0 to 1 s need 11.",
        ),
        (
            {"inputs": {"push.f": lambda t: jnp.ones(2)}},
            ac.DataError,
            "Input 'push.f' is a function that returns shape (2,), not a scalar.",
        ),
        (
            {"inputs": {"push.f": lambda t: "strong" if t >= 0 else 0.0}},
            ac.DataError,
            "Input 'push.f' is a function that returns 'strong' at 0 s, not a real number.",
        ),
        ({"inputs": {"push.f": np.nan}}, ac.DataError, "Input 'push.f' is nan."),
        (
            {"inputs": NO_FORCE, "params": {"mass.m": 10**400}},
            ac.DataError,
            f"params: 'mass.m' must be numbers, got {10**400!s:.77}...",
        ),
        (
            {"inputs": NO_FORCE, "dt": 0.3},
            ac.DataError,
            "Steps of dt=0.3 s do not divide the 1 s from 0 to 1 s; choose dt=1/3, or end at 0.9 s.",
        ),
        (
            {"inputs": NO_FORCE, "saveat": [0.5, 2]},
            ac.DataError,
            "saveat has 2 s; give times from 0 to 1 s.",
        ),
        (
            {"inputs": NO_FORCE, "dt": 0.1, "saveat": [0.25]},
            ac.DataError,
            "saveat has 0.25 s, not the end of a step; save multiples of dt, or leave dt out for adaptive steps.",
        ),
        (
            {"inputs": NO_FORCE, "solver": "tsit6"},
            ac.DataError,
            "No solver 'tsit6': did you mean 'tsit5'?",
        ),
        (
            {"inputs": NO_FORCE, "solver": RK4()},
            ac.DataError,
            "RK4 has no error estimate: give dt for fixed steps, or choose solver='tsit5'.",
        ),
        (
            {"inputs": NO_FORCE, "dt": 0.1, "solver": diffrax.LeapfrogMidpoint()},
            ac.DataError,
            f"LeapfrogMidpoint is not a one-step scheme for fixed steps; choose one of {', '.join(SOLVERS)}.",
        ),
        (
            {"inputs": NO_FORCE, "solver": "euler"},
            ac.DataError,
            "Euler has no error estimate: give dt for fixed steps, or choose solver='tsit5'.",
        ),
        (
            {"inputs": NO_FORCE, "solver": diffrax.Tsit5},
            ac.DataError,
            "solver=Tsit5 is a class: call it, Tsit5().",
        ),
        (
            {"inputs": NO_FORCE, "solver": None},
            ac.DataError,
            (
                f"solver=None is not a solver; choose one of {', '.join(SOLVERS)}, "
                "or a diffrax solver such as diffrax.Tsit5()."
            ),
        ),
        (
            {"inputs": NO_FORCE, "dtype": "banana"},
            ac.DataError,
            "dtype='banana': models compute in float64 or float32.",
        ),
        (
            {"inputs": NO_FORCE, "max_steps": 0},
            ac.DataError,
            "max_steps=0; give a whole number, 1 or more.",
        ),
        (
            {"inputs": NO_FORCE, "dt": 0.1, "saveat": np.nan},
            ac.DataError,
            "saveat has nan s; give times from 0 to 1 s.",
        ),
        (
            {"inputs": NO_FORCE, "saveat": []},
            ac.DataError,
            "saveat is empty; give the times to save, or leave it out.",
        ),
        (
            {"inputs": NO_FORCE, "saveat": "often"},
            ac.DataError,
            "saveat='often' are not times; give seconds.",
        ),
        (
            {"inputs": NO_FORCE, "adjoint": "reverse"},
            ac.DataError,
            (
                "adjoint='reverse' is not a way to differentiate; leave it out, or give one of diffrax's, such as "
                "diffrax.DirectAdjoint()."
            ),
        ),
        (
            {"inputs": {"push.f": lambda: 1.0}},
            ac.DataError,
            (
                "Input 'push.f' is a function that cannot be called with the time alone (<lambda>() takes 0 positional "
                "arguments but 1 was given); give one of a single argument: lambda t: ..."
            ),
        ),
        (
            {"inputs": {"push.f": lambda t: np.nan * t}},
            ac.SimulationError,
            "At the start, the input 'push.f' is nan.",
        ),
        (
            {"inputs": {3: 1.0}},
            ac.DataError,
            "inputs: 3 is not a name; give a text such as 'mass.s', or a list.",
        ),
        (
            {"inputs": NO_FORCE, "x0": {"mass.s": np.nan}},
            ac.DataError,
            "x0: 'mass.s' is nan; give a real number that is finite.",
        ),
    ],
)
def test_mistakes_get_one_sentence(arguments, kind, sentence):
    with pytest.raises(kind) as found:
        ac.simulate(plain(), (0, 1), **arguments)
    assert str(found.value) == sentence


def test_steps_that_no_memory_holds():
    sentence = r"^dt=1e-12 s makes 1e\+12 steps from 0 to 1 s, which need 50.9 TiB of memory where there are"
    with pytest.raises(ac.DataError, match=sentence):
        ac.simulate(plain(), (0, 1), inputs=NO_FORCE, dt=1e-12)
    with pytest.raises(ac.DataError, match=r"^dt=4.94066e-324 s makes inf steps"):
        ac.simulate(plain(), (0, 1), inputs=NO_FORCE, dt=5e-324)


@pytest.mark.parametrize(
    "t", [(1, 1), (0, np.nan), -3, 0.0, (0,), None, ("a", "b"), np.zeros((2, 2))]
)
def test_what_is_no_span(t):
    with pytest.raises(ac.DataError, match=r"^t=.* is not a span of time"):
        ac.simulate(plain(), t, inputs=NO_FORCE)


@pytest.mark.parametrize("given", [-1, np.nan, np.inf, "fine", [1e-6, -1e-6], np.ones(7)])
@pytest.mark.parametrize("name", ["rtol", "atol"])
def test_what_is_no_tolerance(name, given):
    with pytest.raises(ac.DataError, match=rf"^{name}=.* is not a tolerance; give a positive"):
        ac.simulate(plain(), (0, 1), inputs=NO_FORCE, **{name: given})
    with pytest.raises(ac.DataError, match=r"^atol=0 allows a state that is zero no error"):
        ac.simulate(plain(), (0, 1), inputs=NO_FORCE, atol=np.array([1e-8, 0.0]))


@pytest.mark.parametrize("dt", [0, -0.1, np.inf, "fast", True])
def test_what_is_no_step(dt):
    with pytest.raises(ac.DataError, match=r"^dt=.* is not a step"):
        ac.simulate(plain(), (0, 1), inputs=NO_FORCE, dt=dt)


@pytest.mark.parametrize(
    ("call", "function"),
    [
        (lambda m: ac.simulate(m, (0, 1)), "simulate"),
        (lambda m: ac.fit(m, {"time": [0, 1]}, ["x"]), "fit"),
        (ac.linearize, "linearize"),
    ],
)
def test_a_model_that_is_not_compiled(call, function):
    for what in (ac.Component(), ac.Component):
        with pytest.raises(
            ac.ModelError, match=f"^{function} needs a compiled model, got Component"
        ):
            call(what)


def test_what_is_no_mapping():
    with pytest.raises(ac.DataError, match=r"^params are numbers and networks by name"):
        ac.simulate(plain(), (0, 1), inputs=NO_FORCE, params=[1.0])
    with pytest.raises(ac.DataError, match=r"^Data are one record"):
        ac.fit(plain(), None, ["mass.s"])


def test_steps_too_long_are_named_as_the_cause():
    with pytest.raises(ac.SimulationError) as found:
        ac.simulate(plain(), (0, 1000), dt=1.0, inputs=NO_FORCE, x0=AT_ONE)
    message = str(found.value)
    assert message.startswith("The simulation broke down after t = ")
    assert "dt=1 s is too long for the model's fastest mode, 5 1/s at the start" in message


@pytest.mark.slow
def test_an_unstable_model_is_named_as_the_cause():
    unstable = Equations(
        "x v",
        lambda s: [ac.Eq(ac.der(s.x), s.v), ac.Eq(ac.der(s.v), 5000 * s.x - 0.5 * s.v)],
    )
    system, at_one = ac.compile(unstable), {"x": 1.0, "v": 0.0}
    with pytest.raises(ac.SimulationError, match=r"unstable: a mode grows by 70\.5 1/s"):
        ac.simulate(system, (0, 20), dt=0.01, x0=at_one)
    with pytest.raises(ac.SimulationError, match="stopped at t = "):
        ac.simulate(system, (0, 20), x0=at_one, max_steps=500)


@pytest.mark.slow
def test_a_model_without_a_real_solution_says_so_after_one_search(monkeypatch):
    """The adaptive solver gives up its steps, and no step is searched for long once a value is not finite."""
    evaluations, norm = itertools.count(), newton._norm

    def noted(residuals):
        jax.debug.callback(lambda _: next(evaluations), residuals)
        return norm(residuals)

    monkeypatch.setattr(newton, "_norm", noted)
    impossible = Equations(
        "x y", lambda s: [ac.Eq(ac.der(s.x), s.y), ac.Eq(s.y**2 + ac.exp(s.y) + s.x**2 + 1, 0)]
    )
    system, told = ac.compile(impossible), r"no solution of the equations for 'y'"
    for steps in ({}, {"dt": 0.001}):
        before = next(evaluations)
        with pytest.raises(ac.SimulationError, match=told):
            ac.simulate(system, (0, 1), solver="heun", **steps)
        jax.effects_barrier()
        assert 1000 < next(evaluations) - before < 100_000  # one search takes 25,000


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("source", [bl.Sine(f=1000.0), bl.Pulse(period=1e-3)])
def test_points_further_apart_than_a_period_are_warned_of(source: ac.Component) -> None:
    class Fast(ac.Component):
        def __init__(self) -> None:
            super().__init__()
            self.source, self.lag = source, bl.FirstOrder(T=0.01)
            self.connect(self.source.y, self.lag.u)

    system = ac.compile(Fast())
    with pytest.warns(
        UserWarning, match=r"points of the output are 0\.002 s apart.* about 0\.001 s"
    ):
        ac.simulate(system, 1.0)
    ac.simulate(system, 1.0, saveat=[1.0])


@pytest.mark.parametrize(
    ("law", "told"),
    [
        (ac.sign, r"There 'der\(x\)' = 0\.3 - sign\(x\) jumps from -0\.7 to 1\.3\. If the model slides"),
        (lambda x: ac.where(x > 0, 1, -1), r"There 'der\(x\)' = 0\.3 - where\(x > 0, 1, -1\) jumps"),
        (lambda x: ac.tanh(1e9 * x), "Perhaps it is stiff"),
    ],
)  # fmt: skip
def test_the_formula_along_which_a_model_without_events_slides_is_named(law, told):
    component = Equations("x", lambda s: [ac.Eq(ac.der(s.x), 0.3 - law(s.x))])
    component.modify(x=ac.Start(1.0, fixed=True))
    with pytest.raises(ac.SimulationError, match=told):
        ac.simulate(ac.compile(component), 2.0, solver="tsit5", max_steps=1000)
