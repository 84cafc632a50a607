"""Options of XLA, the compiler of JAX.

On a CPU, XLA runs a loop operation by operation and passes every result through memory; for the few numbers of a
small model that costs ten times the arithmetic. XLA compiles a loop that touches little memory as a whole, to one
function of machine code; but "little" is a kibibyte. Here the limit is raised to the size of a processor's cache.

XLA's newer emitters of fused operations take longer to compile programs of many small operations, which then run no
faster, so they are off: `python -m benchmarks.startup` prints 6.6 s of processor time for a drive with clutches with
``XLA_FLAGS=--xla_cpu_use_fusion_emitters=true``, and 4.8 s without.

XLA moves what all iterations of a loop compute alike to before the loop, and carries it through. In a loop that holds
a model that makes many variables more, with which all later passes take longer, and the compiler of machine code would
have moved it as well. So these passes are off where there is but a CPU: the same command prints 5.4 s with
``XLA_FLAGS=--xla_disable_hlo_passes=none``, and 4.8 s without. The programs run as fast.

Everything that acausal relies on in XLA is in this file: the options, the versions that take it, and the name that such
a loop has in a compiled program. Where XLA does not compile small loops as a whole, because it does not know the
option or runs on another device, `compiles_small_loops` is false: then loops are plain `jax.lax.scan`s and batches
plain `jax.vmap`s, which is slower.
"""

from __future__ import annotations

import re
from collections.abc import MutableMapping
from functools import cache

import jax
import jax.numpy as jnp
from jax import lax

NEAR = 1 << 20
"""Bytes that an iteration of a loop may touch for the loop to be compiled as a whole: about a second-level cache."""

OPTIONS = "xla_backend_extra_options"
BOUND = "xla_cpu_small_while_loop_byte_threshold"
EMITTERS = "xla_cpu_use_fusion_emitters"
WITHOUT = "xla_disable_hlo_passes"
LOOP_PASSES = "while-loop-invariant-code-motion,while-loop-constant-sinking"

SINCE, BEFORE = (0, 7), (0, 11)
"""First version of jaxlib that takes the options, and the first that is untested. XLA aborts at an unknown option."""

COMPILED_LOOP = "xla_cpu_small_call"
"""How a compiled program names a loop that was compiled as a whole."""


def choose_options(
    environment: MutableMapping[str, str], jaxlib: str, *, other_devices: bool = False
) -> None:
    """Make XLA compile small programs well, by its environment variable; the user's own options are kept.

    XLA reads the variable when JAX computes for the first time in a process; later it has no effect.

    Arguments:
        environment: changed in place; `os.environ` outside of tests.
        jaxlib: its version; nothing is changed for a version that may not know the option.
        other_devices: whether JAX may compute on others than the CPU, where a loop is a sequence of programs.
    """
    release = tuple(int(n) for n in re.findall(r"\d+", jaxlib)[:2])
    if SINCE <= release < BEFORE:
        flags = environment.get("XLA_FLAGS", "")
        wanted = {OPTIONS: f"{BOUND}={NEAR}", EMITTERS: "false"}
        if not other_devices:
            wanted[WITHOUT] = LOOP_PASSES
        added = (f"--{name}={value}" for name, value in wanted.items() if name not in flags)
        environment["XLA_FLAGS"] = " ".join([flags, *added]).strip()


@cache
def compiles_small_loops() -> bool:
    """Whether XLA compiles small loops as a whole on the device that JAX computes on; one is compiled to find out."""
    if jax.default_backend() != "cpu":
        return False

    def loop(x: jax.Array) -> jax.Array:
        return lax.scan(lambda x, _: (jnp.sin(x) * jnp.sum(x), None), x, None, length=100)[0]

    loop_of_kibibytes = jax.jit(loop).lower(jax.ShapeDtypeStruct((500,), jnp.float32))
    return COMPILED_LOOP in (loop_of_kibibytes.compile().as_text() or "")
