"""One MLIR context for many of the programs that JAX compiles in tests.

JAX lowers each program in a new context and loads all dialects of MLIR into it, which takes a third of the time to
compile a program of one operation. A context locks what it holds, so threads may share it; as it keeps what its
programs consisted of, it is replaced now and then.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import count
from typing import Any

PROGRAMS = 200
"""Programs that share a context."""


def share_contexts() -> None:
    """Share contexts from now on, where JAX has the function that makes one."""
    from jax._src.interpreters import mlir

    make: Any = getattr(mlir, "make_ir_context", None)
    if make is not None:
        number, held = count(), lru_cache(maxsize=1)(lambda _: make())
        vars(mlir)["make_ir_context"] = lambda: held(next(number) // PROGRAMS)
