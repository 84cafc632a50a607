"""Work that is counted, and so is the same on every machine: calls of functions, and what XLA compiles."""

import cProfile
import pstats
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import jax

COMPILED = "/jax/core/compile/backend_compile_duration"


@contextmanager
def calls_below(most: int) -> Iterator[None]:
    """Fewer calls are made within, of functions in Python or C."""
    with cProfile.Profile() as profile:
        yield
    made = pstats.Stats(profile).total_calls
    assert made < most, f"{made:,} calls"


@contextmanager
def compilations() -> Iterator[list[str]]:
    """The names of the programs that XLA compiles within, such as ``jit(simulate)``.

    Raises:
        AssertionError: JAX no longer tells what it compiles.
    """
    found: list[str] = []
    heard: list[str] = found

    def listen(event: str, _: float, **about: Any) -> None:
        if event == COMPILED:
            heard.append(about["fun_name"])

    jax.monitoring.register_event_duration_secs_listener(listen)
    try:
        yield found
        heard = []
        jax.jit(lambda x: x + 1.0)(0.0)
        assert heard, "JAX does not tell that it compiles"
    finally:
        jax.monitoring.unregister_event_duration_listener(listen)
