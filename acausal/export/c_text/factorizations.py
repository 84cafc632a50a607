"""Rules: factors of matrices."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal.errors import ExportError
from acausal.export.c_text.arrays import CArray, stored
from acausal.export.c_text.expressions import integer
from acausal.export.c_text.lowering import Lowering
from acausal.export.c_text.statements import Call
from acausal.export.traced import TracedOperation


def _svd(low: Lowering, operation: TracedOperation, args: list[CArray]) -> list[CArray]:
    """Singular values and both factors of one matrix, as the least steps of initialization need them."""
    (matrix,) = args
    if len(operation.outputs) != 3 or len(matrix.shape) != 2 or operation.params["full_matrices"]:
        raise ExportError(
            "C: 'svd' of several matrices, or without its factors, has no C; take it of one matrix."
        )
    rows, columns = matrix.shape
    values, left, right = buffers = [low.new(o.shape, o.kind) for o in operation.outputs]
    low.store(matrix, right if columns > rows else left)
    low.memory.prelude.add("svd")
    names = (values.name, left.name, right.name)
    low.emit(Call("svd", (*names, integer(rows), integer(columns))))
    return [stored(b, o.shape) for b, o in zip(buffers, operation.outputs, strict=True)]


RULES: Mapping[str, Any] = {"svd": _svd}
