"""Measure one model of one size: seconds and memory of the stages, size of the program, speed beside code by hand."""

from __future__ import annotations

import cProfile
import pstats
import resource
import statistics
import sys
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import sympy

import acausal as ac
from acausal.codegen.generator import generate
from acausal.codegen.parameters import lay_out_parameters
from acausal.flattening.flat_model import flatten
from acausal.flattening.template import Template
from acausal.initialization.initialize import initializer
from acausal.structure.reduced_model import reduce
from benchmarks.case import Case

ROUNDS, TURN = 31, 0.02
"""How often the two right-hand sides take turns, and how many seconds a turn lasts, about."""
DERIVE = ("differentiated", "is_linear", "is_safely_solvable", "partial", "solved")


class Stopwatch:
    """Seconds by name; what is measured within a measurement counts for the inner one only."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._inner = [0.0]

    def __call__(self, name: str, function: Callable[..., Any], *args: Any) -> Any:
        self._inner.append(0.0)
        start = time.perf_counter()
        result = function(*args)
        passed = time.perf_counter() - start
        self.seconds[name] = self.seconds.get(name, 0.0) + passed - self._inner.pop()
        self._inner[-1] += passed
        return result


def _watched(watch: Stopwatch, function: Callable[..., Any]) -> Callable[..., Any]:
    """A method whose time counts as ``derive``."""
    return lambda *args: watch("derive", function, *args)


@contextmanager
def watched(watch: Stopwatch):
    """While this lasts, the calculus of templates counts as ``derive``."""
    plain = {name: vars(Template)[name] for name in DERIVE}
    for name, function in plain.items():
        setattr(Template, name, _watched(watch, function))
    yield
    for name, function in plain.items():
        setattr(Template, name, function)


def build(case: Case, n: int, watch: Stopwatch) -> tuple[ac.System, Any, Any]:
    """The system of a case, and its right-hand side and gradient as compiled programs."""
    with watched(watch):
        model = watch("declare", case.model, n)
        flat = watch("flatten", flatten, model)
        reduced = watch("reduce", reduce, flat)
        parameters = watch("generate", lay_out_parameters, flat)
        program = watch("generate", generate, reduced, parameters)
        initial = watch("generate", initializer, reduced, program, parameters)
        system = ac.System(model, flat, reduced, parameters, program, initial)
        packed = watch("generate", system.pack)
        x = jnp.zeros(len(reduced.states))

        def rhs(x: Any, packed: Any) -> Any:
            return system.vector_field(0.0, x, None, packed)

        def loss(x: Any, packed: Any) -> Any:
            return jnp.sum(rhs(x, packed) ** 2)

        gradient = jax.jit(jax.grad(loss, argnums=(0, 1)))
        lowered = watch("generate", jax.jit(rhs).lower, x, packed)
        lowered_gradient = watch("generate", gradient.lower, x, packed)
    programs = watch("xla_rhs", lowered.compile), watch("xla_gradient", lowered_gradient.compile)
    return system, *programs


def measured(case: Case, n: int) -> dict[str, Any]:
    """Everything but what needs a profiler."""
    watch, processor = Stopwatch(), time.process_time()
    system, rhs, gradient = build(case, n, watch)
    total, processor = sum(watch.seconds.values()), time.process_time() - processor
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    found = {
        "unknowns": system.flat.n_variables,
        "states": len(system.states),
        **{f"{name}_seconds": seconds for name, seconds in watch.seconds.items()},
        "total_seconds": total,
        "processor_seconds": processor,
        "memory_gb": memory / (1e9 if sys.platform == "darwin" else 1e6),
        "hlo_rhs": instructions(rhs),
        "hlo_gradient": instructions(gradient),
    }
    return found | compared(case, n, system, rhs)


def instructions(program: Any) -> int:
    """HLO instructions of a compiled program."""
    return sum(" = " in line for line in program.as_text().splitlines())


def compared(case: Case, n: int, system: ac.System, rhs: Any) -> dict[str, float]:
    """Seconds of one right-hand side and of the hand-written one, and how far their results differ."""
    own, by_hand, difference = beside_code_by_hand(case, n, system, rhs)
    ours, theirs = in_turns(own, by_hand)
    return {
        "rhs_seconds": ours,
        "by_hand_seconds": theirs,
        "rhs_ratio": ours / theirs,
        "rhs_error": difference,
    }


def beside_code_by_hand(
    case: Case, n: int, system: ac.System, rhs: Any
) -> tuple[Callable[[], Any], Callable[[], Any], float]:
    """The two right-hand sides at one point, and the largest relative difference of their results.

    Both map one vector to one vector; the hand-written one's holds the states group by group.
    """
    values = {k: jnp.asarray(v) for k, v in case.values(n).items()}
    names, packed = case.states(n), system.pack()
    ends = np.cumsum([len(group) for group in names.values()])[:-1]
    at = {name: i for i, name in enumerate(system.states)}
    order = np.asarray([at[name] for group in names.values() for name in group])

    def flat(x: Any, values: Any) -> Any:
        rates = case.by_hand(dict(zip(names, jnp.split(x, ends), strict=True)), values)
        return jnp.concatenate([rates[k] for k in names])

    x = jnp.asarray(np.random.default_rng(0).normal(size=len(at)))
    own = x[order]
    by_hand = jax.jit(flat).lower(own, values).compile()
    pairs = [jnp.split(v, ends) for v in (rhs(x, packed)[order], by_hand(own, values))]
    errors = [float(jnp.abs(a - b).max() / jnp.abs(b).max()) for a, b in zip(*pairs, strict=True)]
    return lambda: rhs(x, packed), lambda: by_hand(own, values), max(errors)


def in_turns(*functions: Callable[[], Any]) -> list[float]:
    """Median seconds of a call, all functions measured in turns so that they share what disturbs."""
    once = [_seconds(function, 3) for function in functions]
    times = [max(1, int(TURN / seconds)) for seconds in once]
    rounds = [
        [_seconds(f, k) for f, k in zip(functions, times, strict=True)] for _ in range(ROUNDS)
    ]
    return [statistics.median(column) for column in zip(*rounds, strict=True)]


def _seconds(function: Callable[[], Any], times: int) -> float:
    start = time.perf_counter()
    for _ in range(times):
        jax.block_until_ready(function())
    return (time.perf_counter() - start) / times


def calls(case: Case, n: int) -> dict[str, int]:
    """How often a compilation calls functions of acausal, and how often it enters sympy.

    What JAX and sympy do from there depends on their caches and on addresses, and is not counted.
    """
    profile = cProfile.Profile()
    profile.runcall(build, case, n, Stopwatch())
    home = str(Path(sympy.__file__).parent)
    found = pstats.Stats(profile).stats
    entered = sum(
        times[0]
        for (file, *_), (*_, callers) in found.items()
        if file.startswith(home)
        for (caller, *_), times in callers.items()
        if not caller.startswith(
            (home, "~", "<")
        )  # "<string>": dataclasses compare from Python 3.13 on
    )
    ours = str(Path(ac.__file__).parent)
    called = sum(own[1] for (file, *_), own in found.items() if file.startswith(ours))
    return {"sympy_calls": entered, "calls": called}
