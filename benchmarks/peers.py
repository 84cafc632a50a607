"""Others on one and the same chain: n masses from rest, all a tenth of a metre off, for ten seconds.

Each runs in a process of its own, from its objects or text to the first result, then again, then the gradient of
where the last mass ends by all stiffnesses. `benchmarks.qvm` has the gradient of the quarter vehicle.
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

from benchmarks.chain import Chain, by_hand, by_hand_values

END, START = 10.0, 0.1
TOLERANCES = {"rtol": 1e-6, "atol": 1e-8}
PATIENCE = 200
"""Seconds for one peer."""
AGREE = 1e-4
"""How far positions [m] of the last mass may be apart."""


class Ready(NamedTuple):
    """A chain that can be simulated.

    Attributes:
        simulate: gives the last mass's position at the end [m].
        gradient: its derivatives by all stiffnesses, or a word on why there are none.
    """

    simulate: Callable[[], Any]
    gradient: Callable[[], Any] | str


def acausal(n: int) -> Ready:
    import jax

    import acausal as ac

    system = ac.compile(Chain(n))
    own = system.parameters()
    x0 = dict.fromkeys((s for s in system.states if s.endswith(".s")), START)

    @jax.jit
    def end(stiffness: Any) -> Any:
        given = {f"leg[{i + 1}].c": c for i, c in enumerate(stiffness)}
        params = {**own, **given}
        run = ac.simulate(
            system, (0, END), saveat=[END], params=params, x0=x0, solver="tsit5", **TOLERANCES
        )
        return run[f"mass[{n}].s"][-1]

    return _with_jax(end, n)


def diffrax(n: int) -> Ready:
    """The equations by hand."""
    import diffrax as dfx
    import jax
    import jax.numpy as jnp

    import acausal as _  # noqa: F401 (double precision, and loops compiled whole)

    values = by_hand_values(n)

    @jax.jit
    def end(stiffness: Any) -> Any:
        solution = dfx.diffeqsolve(
            dfx.ODETerm(lambda t, x, c: by_hand(x, {**values, "c": c})),
            dfx.Tsit5(),
            0.0,
            END,
            None,
            {"s": jnp.full(n, START), "v": jnp.zeros(n)},
            stiffness,
            stepsize_controller=dfx.PIDController(**TOLERANCES),
            max_steps=100_000,
        )
        return solution.ys["s"][-1, -1]

    return _with_jax(end, n)


def _with_jax(end: Callable[[Any], Any], n: int) -> Ready:
    import jax

    stiffness = by_hand_values(n)["c"]
    gradient = jax.jit(jax.grad(end))
    return Ready(lambda: float(end(stiffness)), lambda: jax.block_until_ready(gradient(stiffness)))


def torchdiffeq(n: int) -> Ready:
    """The equations by hand."""
    import torch
    from torchdiffeq import odeint

    values = {k: torch.tensor(v, dtype=torch.float64) for k, v in by_hand_values(n).items()}
    stiffness = values["c"].requires_grad_()
    zero = torch.zeros(1, dtype=torch.float64)
    start = torch.cat([torch.full((n,), START, dtype=torch.float64), torch.zeros(n)])

    def field(t: Any, x: Any) -> Any:
        s, v = x[:n], x[n:]
        f = stiffness * torch.diff(s, prepend=zero) + values["d"] * torch.diff(v, prepend=zero)
        return torch.cat([v, (torch.cat([f[1:], zero]) - f) / values["m"]])

    def end() -> Any:
        times = torch.tensor([0.0, END], dtype=torch.float64)
        return odeint(field, start, times, method="dopri5", **TOLERANCES)[-1, n - 1]

    return Ready(lambda: end().item(), lambda: torch.autograd.grad(end(), stiffness))


def pathsim(n: int) -> Ready:
    """The equations by hand, in one block."""
    from pathsim import Connection, Simulation
    from pathsim.blocks import ODE, Scope
    from pathsim.solvers import RKDP54

    p = by_hand_values(n)

    def field(x: Any, u: Any, t: Any) -> Any:
        s, v = x[:n], x[n:]
        f = p["c"] * np.diff(s, prepend=0.0) + p["d"] * np.diff(v, prepend=0.0)
        return np.concatenate([v, (np.append(f[1:], 0.0) - f) / p["m"]])

    def end() -> float:
        block, scope = ODE(field, np.append(np.full(n, START), np.zeros(n))), Scope()
        connected = [Connection(block[n - 1], scope)]
        simulation = Simulation(
            [block, scope],
            connected,
            Solver=RKDP54,
            log=False,
            tolerance_lte_rel=TOLERANCES["rtol"],
            tolerance_lte_abs=TOLERANCES["atol"],
        )
        simulation.run(END)
        return float(scope.read()[1][0, -1])

    return Ready(end, "has none")


def rumoca(n: int) -> Ready:
    """Modelica's text of the equations."""
    import rumoca

    p = by_hand_values(n)
    lists = {k: "{" + ", ".join(map(repr, v.tolist())) + "}" for k, v in p.items()}
    source = f"""model Chain
      parameter Real c[{n}] = {lists["c"]}, d[{n}] = {lists["d"]}, m[{n}] = {lists["m"]};
      Real s[{n}](each start = {START}, each fixed = true), v[{n}](each start = 0, each fixed = true), f[{n}];
    equation
      f[1] = c[1] * s[1] + d[1] * v[1];
      for i in 2:{n} loop f[i] = c[i] * (s[i] - s[i-1]) + d[i] * (v[i] - v[i-1]); end for;
      for i in 1:{n} loop der(s[i]) = v[i]; end for;
      for i in 1:{n - 1} loop m[i] * der(v[i]) = f[i+1] - f[i]; end for;
      m[{n}] * der(v[{n}]) = -f[{n}];
    end Chain;"""
    model = rumoca.Session().loads(source, model="Chain")
    config = rumoca.SimConfig(**TOLERANCES)

    return Ready(
        lambda: float(model.simulate(END, config=config)[f"s[{n}]"][-1]), "of steady states only"
    )


def jaxonomy(n: int) -> Ready:
    import jaxonomy
    from jaxonomy.acausal import AcausalCompiler, AcausalDiagram, EqnEnv
    from jaxonomy.acausal import translational as tr

    p, env, diagram = by_hand_values(n), EqnEnv(), AcausalDiagram()
    below = tr.FixedPosition(env, name="wall")
    for i, (c, d, m) in enumerate(zip(p["c"], p["d"], p["m"], strict=True)):
        starts = {"initial_position": START, "initial_velocity": 0.0}
        fixed = {f"{k}_fixed": True for k in starts}
        mass = tr.Mass(env, name=f"mass{i}", M=m, **starts, **fixed)
        for leg in (tr.Spring(env, name=f"spring{i}", K=c), tr.Damper(env, name=f"damper{i}", D=d)):
            diagram.connect(below, "flange", leg, "flange_a")
            diagram.connect(leg, "flange_b", mass, "flange")
        below = mass
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
    whole = builder.build()
    context = whole.create_context()
    options = jaxonomy.SimulatorOptions(**TOLERANCES)
    signals = {"x": system.output_ports[0]}

    def end() -> float:
        run = jaxonomy.simulate(
            whole, context, (0.0, END), options=options, recorded_signals=signals
        )
        return float(run.outputs["x"][-1])

    return Ready(end, "not tried")


PEERS: dict[str, Callable[[int], Ready]] = {
    peer.__name__: peer for peer in (acausal, diffrax, torchdiffeq, pathsim, rumoca, jaxonomy)
}


def measured(name: str, n: int) -> dict[str, Any]:
    """Seconds of one peer, and the last mass's position; the import of packages is not counted."""
    for package in (name, "jax") if name in ("acausal", "diffrax") else (name,):
        __import__(package)
    clock = time.perf_counter()
    ready = PEERS[name](n)
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
    parser = argparse.ArgumentParser(description="A chain of n masses, by others, too.")
    parser.add_argument("--n", type=int, default=10, help="masses")
    parser.add_argument("--one", choices=PEERS, help="measure only this, and print it as JSON")
    asked = parser.parse_args()
    if asked.one:
        print(json.dumps(measured(asked.one, asked.n)))
        return
    table = Table("", "first result [s]", "again [s]", "gradient [s]", title=f"{asked.n} masses")
    found: dict[str, Any] = {}
    for name in PEERS:
        found[name] = _apart(name, asked.n)
        cells = found[name]
        row = (
            [cells]
            if isinstance(cells, str)
            else [cells[k] for k in ("first", "again", "gradient")]
        )
        table.add_row(name, *(v if isinstance(v, str) else f"{v:.3g}" for v in row))
    Console().print(table)
    print(json.dumps({"n": asked.n, **found}))
    _check(found)


def _apart(name: str, n: int) -> dict[str, Any] | str:
    """What a process of its own measures, or why it does not."""
    command = [sys.executable, "-m", "benchmarks.peers", "--one", name, "--n", str(n)]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=PATIENCE, env=dict(os.environ)
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
