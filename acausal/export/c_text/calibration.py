"""Split a block: what depends on parameters alone is computed once, when they change."""

from __future__ import annotations

from collections.abc import Collection

from acausal.export.traced import Atom, TracedBlock, TracedConstant, TracedOperation, TracedValue

VIEWS = frozenset({"slice", "squeeze", "reshape", "broadcast_in_dim", "split", "expand_dims"})
"""Operations that only say where numbers lie: they are not worth an array of their own."""


def split(
    block: TracedBlock, parameters: Collection[TracedValue]
) -> tuple[TracedBlock, TracedBlock]:
    """Two blocks with the same meaning: one for the parameters alone, one for the rest.

    Arguments:
        block: all operations.
        parameters: those of its inputs that change seldom.

    Returns:
        The first takes the parameters and gives some values; the second takes the block's inputs and these values.
    """
    fixed: set[Atom] = set(parameters)
    operations: list[TracedOperation] = []
    early: list[TracedOperation] = []
    for operation in (o for each in block.operations for o in _turned(each, fixed)):
        operations.append(operation)
        if all(isinstance(a, TracedConstant) or a in fixed for a in operation.inputs):
            fixed.update(operation.outputs)
            early.append(operation)
    producer = {o: operation for operation in early for o in operation.outputs}
    late = {id(o) for o in operations} - {id(o) for o in early}
    crossing: dict[TracedValue, None] = {}
    again: set[int] = set()

    def need(atom: Atom) -> None:
        """Make a value available after the split."""
        if not isinstance(atom, TracedValue) or atom not in producer:
            return
        operation = producer[atom]
        if operation.name not in VIEWS and atom.kind == "real":
            crossing[atom] = None
        elif id(operation) not in again:
            again.add(id(operation))
            for below in operation.inputs:
                need(below)

    for operation in operations:
        if id(operation) in late:
            for atom in operation.inputs:
                need(atom)
    for atom in block.outputs:
        need(atom)
    rest = tuple(o for o in operations if id(o) in late or id(o) in again)
    known = tuple(crossing)
    inputs = tuple(i for i in block.inputs if i in set(parameters))
    return (
        TracedBlock(inputs, tuple(early), ()).part(known),
        TracedBlock((*block.inputs, *known), rest, block.outputs),
    )


def _turned(operation: TracedOperation, fixed: Collection[Atom]) -> list[TracedOperation]:
    """A matrix of parameters times a vector: turned once, so that the sums run along memory."""
    if operation.name != "dot_general" or operation.inputs[0] not in fixed:
        return [operation]
    (ca, cb), (ba, bb) = operation.params["dimension_numbers"]
    matrix, vector = operation.inputs
    if (ba, bb) != ((), ()) or ca != (1,) or len(matrix.shape) != 2 or len(vector.shape) != 1:
        return [operation]
    if 1 in matrix.shape:
        return [operation]
    turned = TracedValue((matrix.shape[1], matrix.shape[0]), matrix.kind)
    turn = TracedOperation(
        "transpose", (matrix,), (turned,), {"permutation": (1, 0)}, operation.origin
    )
    params = {**operation.params, "dimension_numbers": (((0,), cb), ((), ()))}
    return [
        turn,
        TracedOperation(
            operation.name, (turned, vector), operation.outputs, params, operation.origin
        ),
    ]
