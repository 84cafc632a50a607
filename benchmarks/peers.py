"""Others on the same tasks: a chain of n masses, and the quarter vehicle as physics alone knows it.

Each runs in a process of its own, from its objects or text to the first result, then again, then the gradient of
where the last mass ends by all stiffnesses. `benchmarks.qvm` has the quarter vehicle with its networks, step for step.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.table import Table

TOLERANCES = {"rtol": 1e-6, "atol": 1e-8}
PATIENCE = 200
"""Seconds for one peer."""
AGREE = 1e-4
"""How far positions [m] of the last mass may be apart."""


class Task(NamedTuple):
    """Masses in a row, each on a spring and a damper on the one before it, the first on a wall.

    Attributes:
        c, d, m: stiffnesses, dampings and masses, from the wall on.
        start: where all masses are at first [m], at rest. end: time [s].
        waves: the wall's speed is the sum of ``amplitude * sin(2 pi frequency t)``, [m/s, Hz].
        model, legs, masses: the same for us; names of its elements.
    """

    c: np.ndarray
    d: np.ndarray
    m: np.ndarray
    start: float
    end: float
    waves: tuple[tuple[float, float], ...]
    model: Callable[[], Any]
    legs: tuple[str, ...]
    masses: tuple[str, ...]

    def speed(self, t: Any, sin: Callable[[Any], Any] = np.sin) -> Any:
        """Of the wall [m/s]."""
        return sum((a * sin(2 * np.pi * f * t) for a, f in self.waves), start=0.0)

    def position(self, t: Any, cos: Callable[[Any], Any] = np.cos) -> Any:
        """Of the wall [m]."""
        parts = (a / (2 * np.pi * f) * (1 - cos(2 * np.pi * f * t)) for a, f in self.waves)
        return sum(parts, start=0.0)


def chain(n: int) -> Task:
    """A free chain for ten seconds, all masses a tenth of a metre off."""
    from benchmarks.chain import Chain, by_hand_values

    legs, masses = (tuple(f"{k}[{i + 1}]" for i in range(n)) for k in ("leg", "mass"))
    return Task(**by_hand_values(n), start=0.1, end=10.0, waves=(),
                model=lambda: Chain(n), legs=legs, masses=masses)  # fmt: skip


def vehicle(_: int) -> Task:
    """The quarter vehicle for 42 seconds over waves of the road."""
    from examples.qvm import model

    return Task(
        c=np.array([model.TYRE_STIFFNESS, model.SUSPENSION_STIFFNESS]),
        d=np.array([model.TYRE_DAMPING, model.SUSPENSION_DAMPING]),
        m=np.array([model.WHEEL, model.BODY]),
        start=0.0,
        end=42.0,
        waves=((0.1, 0.7), (0.1, 2.3), (0.05, 9.1)),
        model=model.linear,
        legs=("tyre", "suspension"),
        masses=("wheel", "body"),
    )


TASKS = {task.__name__: task for task in (chain, vehicle)}


class Ready(NamedTuple):
    """A task that can be simulated.

    Attributes:
        simulate: gives the last mass's position at the end [m].
        gradient: its derivatives by all stiffnesses, or a word on why there are none.
    """

    simulate: Callable[[], Any]
    gradient: Callable[[], Any] | str


def acausal(task: Task) -> Ready:
    import jax
    import jax.numpy as jnp

    import acausal as ac

    system = ac.compile(task.model())
    own = system.parameters()
    x0 = {f"{name}.s": task.start for name in task.masses}
    inputs = dict.fromkeys(system.inputs, lambda t: task.speed(t, jnp.sin))

    @jax.jit
    def end(stiffness: Any) -> Any:
        given = {f"{leg}.c": c for leg, c in zip(task.legs, stiffness, strict=True)}
        run = ac.simulate(
            system,
            (0, task.end),
            saveat=[task.end],
            inputs=inputs,
            params={**own, **given},
            x0=x0,
            solver="tsit5",
            **TOLERANCES,
        )
        return run[f"{task.masses[-1]}.s"][-1]

    return _with_jax(end, task)


def diffrax(task: Task) -> Ready:
    """The equations by hand."""
    import diffrax as dfx
    import jax
    import jax.numpy as jnp

    import acausal as _  # noqa: F401 (double precision, and loops compiled whole)

    n = len(task.m)

    def field(t: Any, x: Any, c: Any) -> Any:
        stretch = jnp.diff(x["s"], prepend=task.position(t, jnp.cos))
        f = c * stretch + task.d * jnp.diff(x["v"], prepend=task.speed(t, jnp.sin))
        return {"s": x["v"], "v": (jnp.append(f[1:], 0.0) - f) / task.m}

    @jax.jit
    def end(stiffness: Any) -> Any:
        solution = dfx.diffeqsolve(
            dfx.ODETerm(field),
            dfx.Tsit5(),
            0.0,
            task.end,
            None,
            {"s": jnp.full(n, task.start), "v": jnp.zeros(n)},
            stiffness,
            stepsize_controller=dfx.PIDController(**TOLERANCES),
            max_steps=100_000,
        )
        return solution.ys["s"][-1, -1]

    return _with_jax(end, task)


def _with_jax(end: Callable[[Any], Any], task: Task) -> Ready:
    import jax

    gradient = jax.jit(jax.grad(end))
    return Ready(lambda: float(end(task.c)), lambda: jax.block_until_ready(gradient(task.c)))


def torchdiffeq(task: Task) -> Ready:
    """The equations by hand."""
    import torch
    from torchdiffeq import odeint

    n = len(task.m)
    stiffness, d, m = (torch.tensor(v, dtype=torch.float64) for v in (task.c, task.d, task.m))
    stiffness.requires_grad_()
    zero = torch.zeros(1, dtype=torch.float64)
    start = torch.cat([torch.full((n,), task.start, dtype=torch.float64), torch.zeros(n)])

    def field(t: Any, x: Any) -> Any:
        s, v = x[:n], x[n:]
        stretch = torch.diff(s, prepend=zero + task.position(t, torch.cos))
        f = stiffness * stretch + d * torch.diff(v, prepend=zero + task.speed(t, torch.sin))
        return torch.cat([v, (torch.cat([f[1:], zero]) - f) / m])

    def end() -> Any:
        times = torch.tensor([0.0, task.end], dtype=torch.float64)
        return odeint(field, start, times, method="dopri5", **TOLERANCES)[-1, n - 1]

    return Ready(lambda: end().item(), lambda: torch.autograd.grad(end(), stiffness))


def pathsim(task: Task) -> Ready:
    """The equations by hand, in one block."""
    from pathsim import Connection, Simulation
    from pathsim.blocks import ODE, Scope
    from pathsim.solvers import RKDP54

    n = len(task.m)

    def field(x: Any, u: Any, t: Any) -> Any:
        s, v = x[:n], x[n:]
        stretch = np.diff(s, prepend=task.position(t))
        f = task.c * stretch + task.d * np.diff(v, prepend=task.speed(t))
        return np.concatenate([v, (np.append(f[1:], 0.0) - f) / task.m])

    def end() -> float:
        block, scope = ODE(field, np.append(np.full(n, task.start), np.zeros(n))), Scope()
        connected = [Connection(block[n - 1], scope)]
        simulation = Simulation(
            [block, scope],
            connected,
            Solver=RKDP54,
            log=False,
            tolerance_lte_rel=TOLERANCES["rtol"],
            tolerance_lte_abs=TOLERANCES["atol"],
        )
        simulation.run(task.end)
        return float(scope.read()[1][0, -1])

    return Ready(end, "has none")


def rumoca(task: Task) -> Ready:
    """Modelica's text of the equations."""
    import rumoca

    n = len(task.m)
    c, d, m = ("{" + ", ".join(map(repr, v.tolist())) + "}" for v in (task.c, task.d, task.m))
    waves = [f"{a!r}*sin({2 * np.pi * f!r}*time)" for a, f in task.waves]
    source = f"""model Row
      parameter Real c[{n}] = {c}, d[{n}] = {d}, m[{n}] = {m};
      Real s[{n}](each start = {task.start}, each fixed = true), v[{n}](each start = 0, each fixed = true), f[{n}];
      Real wall(start = 0, fixed = true), w;
    equation
      w = {" + ".join(waves) or "0"};
      der(wall) = w;
      f[1] = c[1] * (s[1] - wall) + d[1] * (v[1] - w);
      for i in 2:{n} loop f[i] = c[i] * (s[i] - s[i-1]) + d[i] * (v[i] - v[i-1]); end for;
      for i in 1:{n} loop der(s[i]) = v[i]; end for;
      for i in 1:{n - 1} loop m[i] * der(v[i]) = f[i+1] - f[i]; end for;
      m[{n}] * der(v[{n}]) = -f[{n}];
    end Row;"""
    model = rumoca.Session().loads(source, model="Row")
    config = rumoca.SimConfig(**TOLERANCES)
    return Ready(
        lambda: float(model.simulate(task.end, config=config)[f"s[{n}]"][-1]),
        "of steady states only",
    )


def jaxonomy(task: Task) -> Ready:
    import jax.numpy as jnp
    import jaxonomy
    from jaxonomy.acausal import AcausalCompiler, AcausalDiagram, EqnEnv, translational as tr
    from jaxonomy.library import SourceBlock

    env, diagram = EqnEnv(), AcausalDiagram()
    driven = {"enable_speed_port": True, "enable_flange_b": False}
    wall = tr.SpeedSource(env, name="wall", **driven) if task.waves else None
    below, flange = wall or tr.FixedPosition(env, name="wall"), "flange_a" if wall else "flange"
    for i, (c, d, m) in enumerate(zip(task.c, task.d, task.m, strict=True)):
        starts = {"initial_position": task.start, "initial_velocity": 0.0}
        fixed = {f"{k}_fixed": True for k in starts}
        mass = tr.Mass(env, name=f"mass{i}", M=m, **starts, **fixed)
        for leg in (tr.Spring(env, name=f"spring{i}", K=c), tr.Damper(env, name=f"damper{i}", D=d)):
            diagram.connect(below, flange, leg, "flange_a")
            diagram.connect(leg, "flange_b", mass, "flange")
        below, flange = mass, "flange"
    sensor = tr.MotionSensor(
        env,
        name="sensor",
        enable_flange_b=False,
        enable_velocity_port=False,
        enable_position_port=True,
    )
    diagram.connect(below, "flange", sensor, "flange_a")
    builder = jaxonomy.DiagramBuilder()
    system = builder.add(AcausalCompiler(env, diagram)())
    if task.waves:
        road = builder.add(SourceBlock(lambda t: task.speed(t, jnp.sin)))
        builder.connect(road.output_ports[0], system.input_ports[0])
    whole = builder.build()
    context = whole.create_context()
    options = jaxonomy.SimulatorOptions(**TOLERANCES)
    signals = {"x": system.output_ports[0]}

    def end() -> float:
        run = jaxonomy.simulate(
            whole, context, (0.0, task.end), options=options, recorded_signals=signals
        )
        return float(run.outputs["x"][-1])

    return Ready(end, "not tried")


PEERS: dict[str, Callable[[Task], Ready]] = {
    peer.__name__: peer for peer in (acausal, diffrax, torchdiffeq, pathsim, rumoca, jaxonomy)
}


def measured(name: str, task: Task) -> dict[str, Any]:
    """Seconds of one peer, and the last mass's position; the import of packages is not counted."""
    for package in (name, "jax") if name in ("acausal", "diffrax") else (name,):
        __import__(package)
    clock = time.perf_counter()
    ready = PEERS[name](task)
    position = ready.simulate()
    found: dict[str, Any] = {"first": time.perf_counter() - clock, "position": position}
    clock = time.perf_counter()
    ready.simulate()
    found["again"] = time.perf_counter() - clock
    if isinstance(ready.gradient, str):
        return {**found, "gradient": ready.gradient}
    for _ in range(2):  # the first one compiles
        clock = time.perf_counter()
        ready.gradient()
    return {**found, "gradient": time.perf_counter() - clock}


def main() -> None:
    """Parse the command line and measure."""
    parser = argparse.ArgumentParser(description="The same tasks, by others, too.")
    parser.add_argument("--tasks", nargs="+", choices=TASKS, default=list(TASKS))
    parser.add_argument("--n", type=int, default=10, help="masses of the chain")
    parser.add_argument("--one", choices=PEERS, help="measure only this, and print it as JSON")
    asked = parser.parse_args()
    if asked.one:
        print(json.dumps(measured(asked.one, TASKS[asked.tasks[0]](asked.n))))
        return
    report = {task: _compare(task, asked.n) for task in asked.tasks}
    print(json.dumps({"n": asked.n, **report}))
    for found in report.values():
        _check(found)


def _compare(task: str, n: int) -> dict[str, dict[str, Any] | str]:
    """All peers on one task, as a table."""
    table = Table("", "first result [s]", "again [s]", "gradient [s]", title=task)
    found = {name: _apart(name, task, n) for name in PEERS}
    for name, figures in found.items():
        columns = ("first", "again", "gradient")
        row = [figures] if isinstance(figures, str) else [figures[k] for k in columns]
        table.add_row(name, *(v if isinstance(v, str) else f"{v:.3g}" for v in row))
    Console().print(table)
    return found


def _apart(name: str, task: str, n: int) -> dict[str, Any] | str:
    """What a process of its own measures, or why it does not."""
    asked = ["--one", name, "--tasks", task, "--n", str(n)]
    try:
        done = subprocess.run(
            [sys.executable, "-m", "benchmarks.peers", *asked],
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            env=dict(os.environ),
        )
    except subprocess.TimeoutExpired:
        return f"more than {PATIENCE} s"
    if done.returncode:
        error = done.stderr.strip().splitlines()[-1]
        return "not installed" if "ModuleNotFoundError" in error else f"failed ({error})"
    return json.loads(done.stdout.splitlines()[-1])


def _check(found: dict[str, Any]) -> None:
    ends = {name: f["position"] for name, f in found.items() if isinstance(f, dict)}
    for name, position in ends.items():
        if abs(position - ends["acausal"]) > AGREE:
            sys.exit(f"{name}: the last mass ends at {position} m, not {ends['acausal']} m.")


if __name__ == "__main__":
    main()
