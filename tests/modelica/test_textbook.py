"""Models of Modelica text with a known solution: those of connections, and those with equations of their own."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import acausal as ac

FILE = Path(__file__).with_name("Textbook.mo")
TIMES = np.linspace(0.0, 2.0, 41)


@pytest.fixture(scope="module")
def system() -> ac.System:
    return ac.compile(ac.load(FILE, "Textbook.Smooth"))


@pytest.fixture(scope="module")
def smooth(system: ac.System) -> ac.Solution:
    return ac.simulate(system, (0.0, 2.0), saveat=TIMES, rtol=1e-9, atol=1e-11)


@pytest.fixture(scope="module")
def events() -> ac.Solution:
    system = ac.compile(ac.load(FILE, "Events"))
    return ac.simulate(system, (0.0, 2.0), saveat=TIMES, rtol=1e-9, atol=1e-11)


def linear(A: Any, x0: Any, b: Any = 0.0) -> np.ndarray:
    """The solution of ``x' = A x + b``, a row for each state."""
    matrix, x0, b = np.array(A, float), np.array(x0, float), np.zeros(len(x0)) + b
    whole = np.block([[matrix, b[:, None]], [np.zeros((1, len(x0) + 1))]])
    return np.array([(expm(whole * t) @ [*x0, 1.0])[:-1] for t in TIMES]).T


def solved(f: Any, x0: Any) -> np.ndarray:
    return solve_ivp(f, (0, 2), x0, t_eval=TIMES, rtol=1e-10, atol=1e-12).y


def chain(c: float, d: float, s0: list[float]) -> np.ndarray:
    """Positions of masses of 1 kg in a row, the first held by a wall."""
    n = len(s0)
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    K[-1, -1] = 1
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-c * K, -d * K]])
    return linear(A, [*s0, *[0.0] * n])[:n]


def chua(t: float, x: Any) -> list[float]:
    i, v1, v2 = x
    ga, gb = -0.757576, -0.409091
    nr = gb * v1 + math.copysign(min(abs(v1), 1.0), v1) * (ga - gb)
    g = 0.565 * (v2 - v1)
    return [(v2 - 12.5e-3 * i) / 18, (g - nr) / 10, (-g - i) / 100]


def tank(t: float, x: Any) -> list[float]:
    level, integral = x
    error = 2 - level
    return [(2 * (error + integral) - 0.5 * math.sqrt(level)) / 1.5, error / 4]


def pendulum(t: float, x: Any) -> list[float]:
    return [x[1], -9.81 * math.sin(x[0])]


def expected() -> dict[str, Any]:
    n = 5
    rod = 25 * (np.eye(n, k=1) + np.eye(n, k=-1) - 2 * np.eye(n))
    rod[0, 0] = -25
    rods = linear(rod, np.ones(n))
    x = linear([[0, 1], [-4, -0.4]], [1, 0])
    powers = [x[0] ** i + x[1] ** i for i in range(1, 5)]
    motor = linear(
        [[-50, 0, -10], [0, 0, 1], [5, 0, -0.05]], [0, 0, 0], np.array([1200.0, 0.0, 0.0])
    )
    angle = solved(pendulum, [math.asin(0.6), 0.0])[0]
    circuit, level = solved(chua, [0, 4, 0]), solved(tank, [1, 0])
    cubic = solved(lambda t, x: [-(x[0] + 2 * x[0] ** 2)], [1])[0]
    first, second = chain(10, 1, [0.1, 0.2, 0.3]), chain(20, 0, [1, 2])
    C, ladder = np.array([0.1, 0.2, 0.3]), 2 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1)
    ladder[-1, -1] = 1
    x0 = 0.5 - TIMES / 8  # 2 x der(x) = -x/4
    return {
        "language.x": x0,
        "language.z": 4 * x0**2,
        "language.n": np.sqrt(x0**2 + (2 * x0 + 1) ** 2 + 16 * x0**4),
        "language.mv[1]": x0,
        "language.w": x0 + 3,
        "signals.i.y": 1 + 4.5 * TIMES**2,
        "signals.total": TIMES + 4 * TIMES + 3,
        "ladder.c[3].v": linear(-ladder / (2 * C[:, None]), [0, 0, 0], [25, 0, 0])[2],
        "rc.c.v": 10 * (1 - np.exp(-TIMES)),
        "rc.r.i": 5 * np.exp(-TIMES),
        "chua.L.i": circuit[0],
        "chua.C1.v": circuit[1],
        "pendulum.x": np.sin(angle),
        "control.tank.level": level[0],
        **{f"rod.T[{i + 1}]": rods[i] for i in range(n)},
        **{f"slices.y[{i + 1}]": powers[i] for i in range(4)},
        "slices.z": sum(a * b for a, b in zip(powers[1:], powers[:-1], strict=True)),
        **{f"chain.mass[{i + 1}].s": first[i] for i in range(3)},
        **{f"chain2.mass[{i + 1}].s": second[i] for i in range(2)},
        "functions.x": cubic,
        "functions.w": cubic + 3 * cubic**3,
        "records.y": np.exp(-6 * TIMES),
        "undamped.J.phi": np.cos(10 * TIMES),
        "damped.J.phi": linear([[0, 1], [-1, -1]], [1, 0])[0],
        "steady.x": TIMES + np.exp(-TIMES),
        "motor.load.phi": motor[1],
    }


@pytest.mark.slow
def test_models_begin_as_their_solution(system: ac.System) -> None:
    params = system.parameters()
    x = np.asarray(system.initial_state(params))
    rates = dict(
        zip(system.states, np.asarray(system.vector_field(0.0, x, None, params)), strict=True)
    )
    start = dict(zip(system.states, x, strict=True))
    for name in start.keys() & expected().keys():
        assert start[name] == pytest.approx(expected()[name][0], abs=1e-9), name
    known = {
        "rc.c.v": 10,
        "records.part.x": -6,
        "functions.x": -3,
        "language.x": -1 / 8,
        "motor.L.i": 1200,
    }
    known |= {
        "damped.J.w": -1,
        "undamped.J.w": -100,
        "rod.T[1]": 0,
        "rod.T[5]": -25,
        "slices.x[2]": -4,
    }
    assert {name: float(rates[name]) for name in known} == pytest.approx(known)


@pytest.mark.slow
def test_models_equal_their_solution(smooth: ac.Solution) -> None:
    errors = {
        name: float(np.max(np.abs(np.asarray(smooth[name]) - wanted)) / max(1, np.ptp(wanted)))
        for name, wanted in expected().items()
    }
    assert {n: e for n, e in errors.items() if not e < 2e-6} == {}


@pytest.mark.slow
def test_functions_of_the_language(smooth: ac.Solution) -> None:
    x = 0.5
    rounded = math.fmod(5.5, 2) + 3 + 1 + 2 + 1 + 2  # mod, div, rem, ceil, floor, integer
    wanted = 0.5 + x + x + 0.1 + 1 + math.atan2(x, 1) + math.exp(-x) + math.log(2) + rounded
    assert abs(float(smooth["language.s"][0]) - wanted) < 1e-9


def test_classes_share_their_form() -> None:
    system = ac.compile(ac.load(FILE, "Chain"))
    assert len(system.flat.layout.forms) == len({type(c) for c in system.flat.layout.components})


@pytest.mark.slow
def test_a_ball_bounces(events: ac.Solution) -> None:
    h, v, begin, height = [], 0.0, 0.0, 1.0
    for t in TIMES:
        while (
            height + v * (t - begin) - 9.81 / 2 * (t - begin) ** 2 < 0
        ):  # it has hit the ground meanwhile
            down = math.sqrt(v**2 + 2 * 9.81 * height)
            begin, v, height = begin + (v + down) / 9.81, 0.7 * down, 0.0
        h.append(height + v * (t - begin) - 9.81 / 2 * (t - begin) ** 2)
    assert np.allclose(events["ball.h"], h, atol=1e-6)


def test_a_thermostat_switches_with_hysteresis(events: ac.Solution) -> None:
    off = 5 * math.log((35 - 15) / (35 - 22))  # from 15 to 22 degrees, towards 35
    assert off > 2
    T = 35 - 20 * np.exp(-TIMES / 5)
    assert np.allclose(events["thermostat.T"], T, atol=1e-6)
    assert float(events["thermostat.switches"][-1]) == 0


def test_a_sampled_controller_holds_its_output(events: ac.Solution) -> None:
    k = np.floor(TIMES / 0.1 + 1e-9)
    rest = TIMES - 0.1 * k
    assert np.allclose(events["sampled.x"], 0.8**k * (1 - 2 * rest), atol=1e-6)


def test_an_algorithm_is_executed_in_order(events: ac.Solution) -> None:
    change = math.log(2) / 2
    x = np.where(change > TIMES, np.exp(-2 * TIMES), 0.5 - (TIMES - change))
    assert np.allclose(events["algorithmic.x"], x, atol=1e-6)
    assert float(events["algorithmic.n"][-1]) == 1


def test_arrays_move_at_events(events: ac.Solution) -> None:
    ends = [float(events[f"buffered.buffer[{i}]"][-1]) for i in (1, 2, 3)]
    assert np.allclose(ends, [1.95, 1.85, 1.75])
    assert float(events["buffered.count"][-1]) == 3
    assert float(events["buffered.full"][-1]) == 1
    assert float(events["buffered.full"][4]) == 0  # two samples at 0.2 s


def test_elsewhen_edge_and_initial(events: ac.Solution) -> None:
    y = np.asarray(events["hysteresis.y"])
    up, down = math.asin(0.5) / 6, (math.pi + math.asin(0.5)) / 6
    assert y[0] == 5
    assert np.all(y[(up < TIMES) & (down > TIMES)] == 1)
    assert y[np.searchsorted(TIMES, down + 0.01)] == -1
    assert float(events["hysteresis.edges"][-1]) == 2


def test_an_algorithm_with_when(events: ac.Solution) -> None:
    k, hold = np.asarray(events["queue.k"]), np.asarray(events["queue.hold"])
    between = (TIMES > 0.25) & (TIMES < 0.5)
    assert np.all(k[between] == 1)
    assert np.allclose(hold[between], -0.25)
    assert (k[-1], hold[-1]) == (2, pytest.approx(0.5))
