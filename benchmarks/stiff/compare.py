"""One model, simulated by acausal and by CVODE in turns: seconds, differences, memory; and its gradient."""

from __future__ import annotations

import resource
import statistics
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import jax
import numpy as np
from jaxtyping import Float

import acausal as ac
from benchmarks.stiff.cvode import Cvode, pattern, right_hand_side

TOLERANCE, TIGHT = 1e-6, 1e-10
ROUNDS = 5


@dataclass(frozen=True)
class Task:
    """What is simulated.

    Attributes:
        name: in the table and in the JSON line.
        system: the compiled model.
        ts: times to save; the first and the last are the span.
        inputs: by name.
    """

    name: str
    system: ac.System
    ts: Float[np.ndarray, " n"]
    inputs: Mapping[str, Any] = field(default_factory=dict)

    def simulate(self, rtol: float = TOLERANCE, **options: Any) -> ac.Solution:
        """By ``solver="auto"``, ready."""
        span = float(self.ts[0]), float(self.ts[-1])
        chosen: dict[str, Any] = {"saveat": self.ts, "rtol": rtol, "atol": rtol, **options}
        return ac.simulate(self.system, span, inputs=self.inputs, **chosen)


def seconds(function: Callable[[], Any]) -> float:
    """That one call takes."""
    start = time.perf_counter()
    jax.block_until_ready(function())
    return time.perf_counter() - start


def in_turns(functions: Mapping[str, Callable[[], Any]], rounds: int) -> dict[str, list[float]]:
    """Seconds of each function, round by round: what disturbs disturbs all."""
    taken: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(rounds):
        for name, function in functions.items():
            taken[name].append(seconds(function))
    return taken


def ratio(ours: list[float], theirs: list[float]) -> float:
    """The median of the rounds' ratios."""
    return statistics.median(a / b for a, b in zip(ours, theirs, strict=True))


def peak_gigabytes() -> float:
    """The most memory that this process has taken so far."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1e9 if sys.platform == "darwin" else 1e6)


def against_cvode(task: Task, rounds: int = ROUNDS, *, reference: bool = True) -> dict[str, Any]:
    """Simulate a task by both, in turns.

    Arguments:
        task: what to simulate.
        rounds: how often.
        reference: whether to compare both with CVODE at tight tolerances, too.
    """
    system, ts = task.system, task.ts
    packed = system.pack()
    first = seconds(lambda: task.simulate(params=packed).x)
    sol = task.simulate(params=packed)
    found: dict[str, Any] = {"first_seconds": first, "statistics": str(sol.statistics)}
    found["memory_gb"] = peak_gigabytes()
    x0, sparsity = np.asarray(sol.x[0]), pattern(system)
    rates = right_hand_side(system, task.inputs)
    jax.block_until_ready(rates(0.0, x0))
    cvode = Cvode(rates, sparsity, rtol=TOLERANCE, atol=TOLERANCE)
    taken = in_turns(
        {"ours": lambda: task.simulate(params=packed).x, "cvode": lambda: cvode(ts, x0)[0]}, rounds
    )
    found |= {f"{name}_seconds": statistics.median(of) for name, of in taken.items()}
    found["ratio"] = ratio(taken["ours"], taken["cvode"])
    theirs, found["cvode_rates"] = cvode(ts, x0)
    if reference:
        exact, _ = Cvode(rates, sparsity, rtol=TIGHT, atol=TIGHT)(ts, x0)
        found["difference"] = difference(system, np.asarray(sol.x), exact)
        found["cvode_difference"] = difference(system, theirs, exact)
    told = f"{found['ratio']:6.2f} x CVODE ({found['ours_seconds']:.3f} s, {found['cvode_seconds']:.3f} s)"
    apart = (
        f"; off by {found['difference']:.1e}, CVODE {found['cvode_difference']:.1e}"
        if reference
        else ""
    )
    print(
        f"{task.name:12} {told}; first result {first:.1f} s{apart}; {found['memory_gb']:.2f} GB\n"
        f"{'':12} {found['statistics']}; CVODE {found['cvode_rates']} right-hand sides",
        flush=True,
    )
    return {f"{task.name}_{name}": value for name, value in found.items()}


def difference(
    system: ac.System,
    x: Float[np.ndarray, "n_ts n"],
    exact: Float[np.ndarray, "n_ts n"],
) -> float:
    """The largest difference of states, over the range of all states of the same name in other components."""
    kinds = np.array([name.rpartition(".")[2] for name in system.states])
    return max(
        float(np.abs(x - exact)[:, kinds == kind].max() / np.ptp(exact[:, kinds == kind]))
        for kind in sorted(set(kinds))
    )


def gradient_cost(
    name: str,
    value: Callable[..., Any],
    arguments: tuple[Any, ...],
    error: Callable[[], float] | None = None,
    rounds: int = ROUNDS,
) -> dict[str, Any]:
    """Seconds of the gradient of a number by all arguments, over those of the number itself.

    Arguments:
        name: in the table and in the JSON line.
        value: the number, of the arguments.
        arguments: of the number.
        error: of the gradient, beside differences.
        rounds: how often to measure.
    """
    run = jax.jit(value)
    gradient = jax.jit(jax.grad(value, tuple(range(len(arguments)))))
    run(*arguments)
    first = seconds(lambda: gradient(*arguments))
    found: dict[str, Any] = {"first_seconds": first, "memory_gb": peak_gigabytes()}
    taken = in_turns(
        {"value": lambda: run(*arguments), "gradient": lambda: gradient(*arguments)}, rounds
    )
    found["seconds"] = statistics.median(taken["gradient"])
    found["ratio"] = ratio(taken["gradient"], taken["value"])
    apart = ""
    if error is not None:
        found["error"] = error()
        apart = f"; {found['error']:.1e} from differences"
    print(
        f"{name:12} gradient {found['ratio']:.2f} x the simulation ({found['seconds']:.3f} s, "
        f"first {first:.1f} s){apart}; {found['memory_gb']:.2f} GB",
        flush=True,
    )
    return {f"{name}_gradient_{key}": value for key, value in found.items()}
