"""A program is data: what it needs, fills and says can be read without JAX."""

import subprocess
import sys

import numpy as np
import pytest

import acausal as ac
from acausal.codegen.gather import gather
from acausal.codegen.instructions import ArrayFormula, SolveTornLoop
from acausal.components import translational as tl
from examples.qvm.model import with_networks
from tests.support.parts import Equations


@pytest.fixture(scope="module")
def vehicle():
    return ac.compile(with_networks())


def names(system, instruction_number):
    program = system.program
    first = program.first[instruction_number]
    outputs = program.instructions[instruction_number].outputs
    return [
        system.reduced.name(int(n)) for a in range(first, first + outputs) for n in program.nodes[a]
    ]


def test_only_what_a_value_depends_on_is_needed(vehicle):
    program = vehicle.program
    (node,) = (vehicle.reduced.resolve(vehicle.flat.layout.find_variable("suspension.f"))[0],)
    needed = program.needed(program.gather([node]).sources)
    found = {name for i in needed for name in names(vehicle, i)}
    assert found >= {"suspension.f", "suspension.s_rel", "suspension.v_rel"}
    assert not any("_nn" in name for name in found)


def test_every_array_is_filled_once_and_before_it_is_read(vehicle):
    program = vehicle.program
    filled = {0, 1, 2, 3}
    for first, instruction in zip(program.first, program.instructions, strict=True):
        assert instruction.sources <= filled
        new = set(range(first, first + instruction.outputs))
        assert not new & filled
        filled |= new
    assert filled == set(range(len(program.nodes)))
    assert set(program.filled_by) == filled - {0, 1, 2, 3}


def test_instructions_count_formulas_not_components():
    class Chain(ac.Component):
        def __init__(self, n):
            super().__init__()
            self.wall, below = tl.Fixed(), None
            self.mass = [tl.Mass(m=1.0) for _ in range(n)]
            self.leg = [tl.Spring(c=1.0) for _ in range(n)]
            below = self.wall.flange
            for leg, mass in zip(self.leg, self.mass, strict=True):
                self.connect(below, leg.flange_a)
                self.connect(leg.flange_b, mass.flange_a)
                below = mass.flange_b

    few, many = (ac.compile(Chain(n)).program for n in (10, 50))
    assert len(few.instructions) == len(many.instructions)
    assert max(i.size for i in many.instructions) == 49


def test_a_torn_loop_says_what_is_guessed_what_follows_and_what_is_left():
    loop = Equations(
        "x y z w",
        lambda s: [
            ac.Eq(ac.der(s.x), s.y),
            ac.Eq(s.y, s.z + s.x),
            ac.Eq(s.z, 2 * s.w),
            ac.Eq(s.w + s.w**3, -s.y),
        ],
    )
    system = ac.compile(loop)
    (solve,) = (i for i in system.program.instructions if isinstance(i, SolveTornLoop))
    assert not solve.is_linear
    assert sorted((*solve.tears, *(unknown for unknown, _ in solve.assigned))) == [0, 1, 2]
    assert len(solve.residuals) == len(solve.tears) == 1
    assert len(solve.equations) == solve.outputs == 3
    assert [[str(o) for o in own] for own in solve.origins] == [["Equations: w**3 + w = -y"]]


@pytest.mark.parametrize("n", [1, 2, 7, 40])
def test_positions_are_those_that_were_gathered(n):
    rng = np.random.default_rng(n)
    sizes = [n, 2 * n, 3]
    source = rng.integers(0, 3, n)
    index = np.asarray([rng.integers(0, sizes[s]) for s in source])
    for some in (slice(None), slice(0, 1)):
        wanted = source[some], index[some]
        found = gather(*wanted, sizes).positions(sizes)
        np.testing.assert_array_equal(np.broadcast_arrays(*found, wanted[0])[0], wanted[0])
        np.testing.assert_array_equal(np.broadcast_arrays(found[1], wanted[1])[0], wanted[1])
    interleaved = np.arange(2 * n).reshape(2, n).T.ravel()
    found = gather(np.ones(2 * n, dtype=int), interleaved, sizes).positions(sizes)
    np.testing.assert_array_equal(np.broadcast_to(found[1], 2 * n), interleaved)


def test_expressions_are_sympy(vehicle):
    explicit = [i for i in vehicle.program.instructions if isinstance(i, ArrayFormula)]
    assert any("c*s_rel" in i.text for i in explicit)


def test_the_program_needs_no_jax():
    # the files themselves: front doors import everything
    code = """
import importlib, sys, types
for name in ("acausal", "acausal.codegen"):
    package = sys.modules[name] = types.ModuleType(name)
    package.__path__ = [name.replace(".", "/")]
for name in ("equations", "gather", "generator", "instructions", "parameters", "program"):
    importlib.import_module(f"acausal.codegen.{name}")
print([m for m in ("jax", "equinox", "optimistix") if m in sys.modules])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
