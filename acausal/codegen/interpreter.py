"""Run a program with JAX: instruction by instruction while JAX traces, and only those that are needed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from acausal.codegen.dense_loop import matched_residuals_of_torn_loops, solve_torn_loops
from acausal.codegen.instructions import (
    Accumulate,
    ArrayFormula,
    Instruction,
    SolveSparseLoop,
    SolveTornLoop,
    UnlikeFormulas,
)
from acausal.codegen.program import DISCRETE, INPUTS, STATES, ZERO, Program
from acausal.codegen.reading import Arrays, add_up, compute, read_elements
from acausal.codegen.sparse_loop import (
    matched_residuals_of_sparse_loop,
    solve_sparse_loop,
)
from acausal.codegen.traces import with_kept_traces
from acausal.codegen.values import Values

INSTRUCTION = "instruction_"
"""What JAX calls the operations of an instruction, with its number: in profiles, and in what is exported."""


def rates(program: Program, values: Values) -> Float[Array, " n_states"]:
    """Derivatives of the states."""
    return rates_from(program, values, run(program, program.rate_sources, values))


def read(program: Program, nodes: Sequence[int], values: Values) -> Float[Array, " n_nodes"]:
    """Values of some nodes."""
    return read_and_keep(program, nodes, values, {}, ())[0]


def read_and_keep(
    program: Program,
    nodes: Sequence[int],
    values: Values,
    known: Mapping[int, Array],
    kept: Sequence[int],
) -> tuple[Float[Array, " n_nodes"], dict[int, Array]]:
    """Values of some nodes, and some of the arrays that are computed on the way, by number; others are known."""
    wanted = program.gather(nodes)
    arrays = run(program, wanted.sources, values, known)
    found = jnp.broadcast_to(read_elements(wanted, arrays), (len(nodes),))
    return found, {number: arrays[number] for number in kept}


def rates_and_read(
    program: Program, nodes: Sequence[int], values: Values
) -> tuple[Float[Array, " n_states"], Float[Array, " n_nodes"]]:
    """Derivatives of the states and values of some nodes; shared values are computed once."""
    wanted = program.gather(nodes)
    arrays = run(program, {*wanted.sources, *program.rate_sources}, values)
    found = jnp.broadcast_to(read_elements(wanted, arrays), (len(nodes),))
    return rates_from(program, values, arrays), found


def results(program: Program, values: Values, numbers: Sequence[int]) -> list[Array]:
    """The results of some instructions, one array after the other."""
    wanted = [program.first[i] + k for i in numbers for k in range(program.instructions[i].outputs)]
    arrays = run(program, wanted, values)
    return [arrays[array] for array in wanted]


def rates_and_residuals(
    program: Program, values: Values, given: Mapping[int, list[Array]]
) -> tuple[Float[Array, " n_states"], list[Array]]:
    """Derivatives of the states where the unknowns of some loops are given, and residuals of the loops' equations.

    The unknowns are given array by array, by the number of the instruction that solves for them otherwise.
    """
    arrays = _known(program, values)
    residuals: list[Array] = []
    for i in program.needed(program.rate_sources):
        instruction = program.instructions[i]
        if i in given:
            residuals += _RESIDUALS[type(instruction)](instruction, values, arrays, given[i])
        found = given[i] if i in given else execute(instruction, values, arrays)
        _fill(program, arrays, i, found)
    return rates_from(program, values, arrays), residuals


def steps(
    program: Program, values: Values, wanted: Iterable[int]
) -> Iterator[tuple[int, Instruction, list[Array], Arrays]]:
    """Run what the wanted arrays depend on; gives number, instruction, results, and the arrays before it."""
    arrays = _known(program, values)
    for i in program.needed(wanted):
        instruction = program.instructions[i]
        results = execute(instruction, values, arrays)
        yield i, instruction, results, arrays
        _fill(program, arrays, i, results)


def execute(instruction: Instruction, values: Values, arrays: Arrays) -> list[Array]:
    """The results of an instruction, one array each, from the arrays filled before."""
    return _EXECUTE[type(instruction)](instruction, values, arrays)


def run(
    program: Program,
    wanted: Iterable[int],
    values: Values,
    known: Mapping[int, Array] | None = None,
) -> list[Any]:
    """The arrays after the instructions that the wanted ones depend on, where some of these may be known."""
    if known:
        return _run_on(program, wanted, values, known)
    return _run(program, tuple(sorted(set(wanted))), values)


@with_kept_traces
def _run(program: Program, wanted: tuple[int, ...], values: Values) -> list[Any]:
    return _run_on(program, wanted, values, {})


def _run_on(
    program: Program, wanted: Iterable[int], values: Values, known: Mapping[int, Array]
) -> list[Any]:
    arrays = _known(program, values)
    for number, array in known.items():
        arrays[number] = array
    for i in program.needed(wanted, known):
        with jax.named_scope(f"{INSTRUCTION}{i}"):
            _fill(program, arrays, i, execute(program.instructions[i], values, arrays))
    return arrays


def _known(program: Program, values: Values) -> list[Any]:
    """The arrays before the first instruction: states, inputs with their signs, a zero, discrete variables."""
    signs = program.input_signs
    arrays: list[Any] = [None] * len(program.nodes)
    arrays[STATES] = values.x
    arrays[INPUTS] = values.u if (signs == 1).all() else values.u * signs
    arrays[ZERO] = jnp.zeros((), values.x.dtype)
    start = program.discrete_start
    arrays[DISCRETE] = jnp.asarray(start, values.x.dtype) if values.d is None else values.d
    return arrays


def _fill(program: Program, arrays: list[Any], i: int, results: list[Array]) -> None:
    first = program.first[i]
    arrays[first : first + len(results)] = results


def rates_from(
    program: Program, values: Values, arrays: Sequence[Any]
) -> Float[Array, " n_states"]:
    """Derivatives of the states, from the arrays that they are read in."""
    if program.state_rates is None:
        return jnp.zeros_like(values.x)
    found = jnp.broadcast_to(read_elements(program.state_rates, arrays), values.x.shape)
    found = found.astype(jnp.result_type(values.x, values.packed.values))  # of a constant as well
    signs = program.rate_signs
    return found if (signs == 1).all() else found * jnp.asarray(signs, found.dtype)


def _compute(formula: ArrayFormula, values: Values, arrays: Arrays) -> list[Array]:
    return [compute(formula, values.packed, arrays, values.t)]


def _compute_together(instruction: UnlikeFormulas, values: Values, arrays: Arrays) -> list[Array]:
    numbers = values.packed.values
    given = (jnp.zeros((), numbers.dtype), jnp.asarray(values.t, numbers.dtype))
    constants = jnp.asarray(instruction.constants, numbers.dtype)
    own = [*arrays[: instruction.first], numbers, *given, constants]
    for operation in instruction.operations:
        own.append(compute(operation, values.packed, own))
    return [jnp.broadcast_to(read_elements(instruction.values, own), (instruction.size,))]


def _accumulate(instruction: Accumulate, values: Values, arrays: Arrays) -> list[Array]:
    return [add_up(instruction, read_elements(instruction.values, arrays))]


_EXECUTE: dict[type, Callable[[Any, Values, Arrays], list[Array]]] = {
    ArrayFormula: _compute,
    UnlikeFormulas: _compute_together,
    Accumulate: _accumulate,
    SolveTornLoop: solve_torn_loops,
    SolveSparseLoop: solve_sparse_loop,
}

_RESIDUALS: dict[type, Callable[[Any, Values, Arrays, list[Array]], list[Array]]] = {
    SolveTornLoop: matched_residuals_of_torn_loops,
    SolveSparseLoop: matched_residuals_of_sparse_loop,
}
