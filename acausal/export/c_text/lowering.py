"""Lower: the operations of a traced function become statements of C, one rule an operation."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from acausal.errors import ExportError
from acausal.export.c_text.arrays import CArray, Index, constant, linear, stored
from acausal.export.c_text.expressions import Expr, Read, add, integer, variable
from acausal.export.c_text.statements import Assign, Buffer, Comment, Declare, For, Statement
from acausal.export.traced import Atom, TracedBlock, TracedConstant, TracedOperation, TracedValue

SMALL = 64
"""Most elements of an array that is kept on the stack; larger ones lie in the model's memory."""

UNROLLED = 4
"""Most elements of an array that is written without a loop."""

LONG = 24
"""Operations in an expression above which it is kept, to stay readable."""


@dataclass
class Workspace:
    """What a function needs beside its arguments.

    Attributes:
        work: arrays that are too large for the stack. tables: constant arrays. prelude: helper functions.
        describe: what comments say of an operation's origin; nothing, if that is empty.
    """

    work: list[Buffer] = field(default_factory=list[Buffer])
    tables: list[Buffer] = field(default_factory=list[Buffer])
    prelude: set[str] = field(default_factory=set[str])
    count: int = 0
    describe: Callable[[str], str] = str

    def name(self, letter: str) -> str:
        """A new name."""
        self.count += 1
        return f"{letter}{self.count}"

    def table(self, array: np.ndarray) -> Buffer:
        """A constant buffer with these values."""
        kind = TracedConstant(array).kind
        values = array.reshape(-1)
        for known in self.tables:
            if known.kind == kind and np.array_equal(np.asarray(known.table), values):
                return known
        buffer = Buffer(self.name("table"), kind, values.size, values.tolist())
        self.tables.append(buffer)
        return buffer


Rule: TypeAlias = "Callable[[Lowering, TracedOperation, list[CArray]], list[CArray]]"
"""How an operation is written: its results from its arguments."""


@dataclass(frozen=True)
class Rules:
    """What is known of operations, by name.

    Attributes:
        table: how they are written. joined: those that take arrays in parts.
        read_often: those that read an element more than once.
    """

    table: Mapping[str, Rule]
    joined: frozenset[str]
    read_often: frozenset[str]


class Lowering:
    """Lowers one block, and those within it.

    Attributes:
        rules: of operations. memory: shared by all blocks of a function.
        statements: those of the block that is being written.
    """

    def __init__(self, rules: Rules, memory: Workspace, statements: list[Statement]) -> None:
        self.rules = rules
        self.memory = memory
        self.statements = statements
        self.arrays: dict[TracedValue, CArray] = {}
        self.uses: Counter[Atom] = Counter()
        self.depth = 0

    # -- operations ----------------------------------------------------------------------------------

    def lower(self, block: TracedBlock, arguments: Sequence[CArray]) -> list[CArray]:
        """Write the operations of a block for these arguments; gives its results."""
        self.uses.update(a for o in block.operations for a in o.inputs)
        self.uses.update(block.outputs)
        self.arrays.update(zip(block.inputs, arguments, strict=True))
        origin = ""
        for operation in block.operations:
            if operation.origin and operation.origin != origin:
                origin = operation.origin
                if words := self.memory.describe(origin):
                    self.emit(Comment(words))
            self._operation(operation)
        return [self.joined(a) for a in block.outputs]

    def _operation(self, operation: TracedOperation) -> None:
        rules = self.rules
        if operation.name not in rules.table:
            raise ExportError(
                f"C: the operation '{operation.name}' has no C"
                + (f" (in {words})" if (words := self.memory.describe(operation.origin)) else "")
                + "; write the law with other functions of jax.numpy."
            )
        largest = max((o.size for o in operation.outputs), default=0)
        arguments: list[CArray] = []
        for atom in operation.inputs:
            array = self.joined(atom) if operation.name in rules.joined else self.plain(atom)
            if operation.name in rules.read_often or (
                array.size < largest and operation.name not in rules.joined
            ):
                array = self.kept(atom)
            arguments.append(array)
        for value, array in zip(
            operation.outputs, rules.table[operation.name](self, operation, arguments), strict=True
        ):
            self.arrays[value] = array
            if array.cost and (self.uses[value] > 1 or array.cost > LONG):
                self.kept(value)

    # -- arrays --------------------------------------------------------------------------------------

    def joined(self, atom: Atom) -> CArray:
        """An array, perhaps still in parts."""
        if isinstance(atom, TracedConstant):
            return constant(atom.array, self.memory.table)
        return self.arrays[atom]

    def plain(self, atom: Atom) -> CArray:
        """An array each of whose elements has an expression."""
        array = self.joined(atom)
        return self.kept(atom) if array.parts is not None else array

    def kept(self, atom: Atom) -> CArray:
        """An array that costs nothing to read."""
        array = self.joined(atom)
        if array.cost == 0 and array.parts is None:
            return array
        array = self.keep(array)
        if isinstance(atom, TracedValue):
            self.arrays[atom] = array
        return array

    def keep(self, array: CArray) -> CArray:
        """The same array, stored."""
        if array.size == 1 and array.parts is None:
            name = self.memory.name("v")
            value = array.at(tuple(integer(0) for _ in array.shape))
            self.emit(Assign(Read(name, None, array.kind), value, declares=True))
            return stored(Buffer(name, array.kind, None), array.shape)
        buffer = self.new(array.shape, array.kind)
        self.store(array, buffer)
        return stored(buffer, array.shape)

    def new(self, shape: Sequence[int], kind: str) -> Buffer:
        """A buffer for an array that is about to be written."""
        size = int(np.prod(shape, dtype=np.int64))
        buffer = Buffer(self.memory.name("v"), kind, max(size, 1))
        if size <= SMALL:
            self.emit(Declare(buffer))
        else:
            self.memory.work.append(buffer)
        return buffer

    def store(self, array: CArray, buffer: Buffer, offset: int = 0) -> None:
        """Write an array into a buffer, row by row from ``offset`` on."""
        self._store(array, buffer, array.shape, tuple(integer(0) for _ in array.shape), offset)

    def _store(
        self, array: CArray, buffer: Buffer, shape: tuple[int, ...], first: Index, offset: int
    ) -> None:
        if array.parts is not None:
            axis, parts = array.parts
            for start, part in parts:
                moved = (*first[:axis], add(first[axis], integer(start)), *first[axis + 1 :])
                self._store(part, buffer, shape, moved, offset)
            return
        for index in self.over(array.shape):
            place = linear(tuple(add(i, f) for i, f in zip(index, first, strict=True)), shape)
            self.write(buffer, add(place, integer(offset)), array.at(index))

    # -- statements ----------------------------------------------------------------------------------

    def emit(self, statement: Statement) -> None:
        """Append a statement to the block that is being written."""
        self.statements.append(statement)

    def write(self, buffer: Buffer, place: Expr, value: Expr, op: str = "=") -> None:
        """Assign an element of a buffer, or a single number."""
        target = Read(buffer.name, None if buffer.size is None else place, buffer.kind)
        self.emit(Assign(target, value, op=op))

    def over(self, shape: Sequence[int]) -> Iterator[Index]:
        """Loops over all indices of a shape: the body of the ``for`` that reads this is written within them.

        Few elements are written one by one.
        """
        if int(np.prod(shape, dtype=np.int64)) <= UNROLLED:
            for place in np.ndindex(*shape):
                yield tuple(integer(i) for i in place)
            return
        loops: list[For] = []
        index: list[Expr] = []
        for length in shape:
            if length == 1:
                index.append(integer(0))
                continue
            loops.append(For(f"i{self.depth + len(loops)}", length))
            index.append(variable(loops[-1].index))
        for outer, loop in pairwise(loops):
            outer.body.append(loop)
        self.emit(loops[0])
        self.depth += len(loops)
        with self.within(loops[-1].body):
            yield tuple(index)
        self.depth -= len(loops)

    @contextmanager
    def within(self, statements: list[Statement]) -> Generator[None]:
        """Write into another block for a while."""
        outer, self.statements = self.statements, statements
        yield
        self.statements = outer
