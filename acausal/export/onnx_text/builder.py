"""A graph of ONNX nodes that grows node by node."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any, TypeAlias

import numpy as np
from jax.extend.core import ClosedJaxpr
from onnx import NodeProto, TensorProto, helper, numpy_helper

from acausal._jax import Equation, name_of
from acausal.errors import DataError

WHOLE = np.iinfo(np.int64).max
"""As the end of a slice: up to the last element."""


@dataclass(frozen=True)
class Tensor:
    """What a node computes: its name, sizes (the leading one may be symbolic) and type."""

    name: str
    shape: tuple[Any, ...]
    dtype: np.dtype[Any]


Value: TypeAlias = np.ndarray | Tensor
"""A value that is known when the graph is made, or a tensor of it."""


@dataclass
class OnnxGraph:
    """Nodes, and constants that they share with the graphs of loops inside.

    Attributes:
        real: the type of all floating-point numbers.
        batch: a tensor whose first size is the symbolic one, if there is one.
        nodes, constants, names, known: what has been added so far.
    """

    real: np.dtype[Any]
    batch: str | None = None
    nodes: list[NodeProto] = field(default_factory=list)
    constants: list[TensorProto] = field(default_factory=list)
    names: count[int] = field(default_factory=count)
    known: dict[tuple[Any, ...], str] = field(default_factory=dict)

    def inner(self) -> OnnxGraph:
        """A graph of a loop's body; its constants are those of this graph."""
        return OnnxGraph(self.real, self.batch, [], self.constants, self.names, self.known)

    def dtype(self, dtype: Any) -> np.dtype[Any]:
        """The type that stands for one of JAX."""
        found = np.dtype(dtype)
        return self.real if found.kind == "f" else found

    def kind(self, dtype: Any) -> int:
        """ONNX's number of a type."""
        return helper.np_dtype_to_tensor_dtype(self.dtype(dtype))

    def fresh(self) -> str:
        """A new name."""
        return f"v{next(self.names)}"

    def add(self, operation: str, *inputs: str, **attributes: Any) -> str:
        """A node with one output."""
        (name,) = self.add_several(operation, *inputs, outputs=1, **attributes)
        return name

    def add_several(
        self, operation: str, *inputs: str, outputs: int, **attributes: Any
    ) -> list[str]:
        """A node with several outputs."""
        names = [self.fresh() for _ in range(outputs)]
        self.nodes.append(helper.make_node(operation, list(inputs), names, **attributes))
        return names

    def constant(self, value: Any, dtype: Any = None) -> str:
        """The name of a constant; equal ones stand once."""
        array = np.asarray(value, dtype)
        with np.errstate(over="ignore"):
            array = np.asarray(array, self.dtype(array.dtype), order="C")
        key = (array.dtype.str, array.shape, array.tobytes())
        if key not in self.known:
            self.known[key] = self.fresh().replace("v", "c")
            self.constants.append(numpy_helper.from_array(array, self.known[key]))
        return self.known[key]

    def integers(self, *values: int) -> str:
        """A constant vector of whole numbers."""
        return self.constant(np.asarray(values, np.int64).reshape(len(values)))

    def number(self, value: float) -> str:
        """A constant floating-point number."""
        return self.constant(float(value), float)

    def read(self, value: Value) -> str:
        """The name of a value."""
        return value.name if isinstance(value, Tensor) else self.constant(value)

    def sizes(self, shape: Sequence[Any]) -> str:
        """A vector of sizes; one of them may be symbolic."""
        if all(isinstance(n, int | np.integer) for n in shape):
            return self.integers(*map(int, shape))
        parts = [
            self.integers(int(n)) if isinstance(n, int | np.integer) else self._symbolic(n)
            for n in shape
        ]
        return self.add("Concat", *parts, axis=0)

    def _symbolic(self, size: Any) -> str:
        if self.batch is None or not str(size).isidentifier():
            raise DataError(
                f"export.onnx: an array has the size '{size}', which depends on that of the batch; "
                "export without batch=..."
            )
        return self.add("Shape", self.batch, start=0, end=1)

    def cast(self, name: str, dtype: Any) -> str:
        """A tensor in another type."""
        return self.add("Cast", name, to=self.kind(dtype))


Lowers: TypeAlias = "Callable[[OnnxGraph, ClosedJaxpr, Sequence[Value]], list[Value]]"
"""Adds the nodes of a jaxpr to a graph: from the values of its arguments to those of its results."""


@dataclass(frozen=True)
class Site:
    """An operation at its place, as the rules of the table see it.

    Attributes:
        graph: to which the nodes are added. equation: the operation. values: its arguments.
        lower: adds jaxprs that the operation calls.
    """

    graph: OnnxGraph
    equation: Equation
    values: tuple[Value, ...]
    lower: Lowers

    @property
    def names(self) -> list[str]:
        """Names of the arguments."""
        return [self.graph.read(v) for v in self.values]

    @property
    def params(self) -> dict[str, Any]:
        """The operation's parameters."""
        return self.equation.params

    @property
    def shapes(self) -> list[tuple[Any, ...]]:
        """Sizes of the arguments."""
        return [v.shape for v in self.values]

    @property
    def kind(self) -> str:
        """Kind of the first argument's type: ``f``, ``i``, ``u`` or ``b``."""
        return self.values[0].dtype.kind

    def refuse(self, why: str = "") -> DataError:
        """The error for an operation that has no counterpart."""
        detail = f" {why}" if why else ""
        return DataError(
            f"export.onnx: the operation '{name_of(self.equation)}'{detail} has no counterpart in ONNX; "
            "write the network without it, or export StableHLO"
        )


Rule: TypeAlias = Callable[[Site], Sequence[str | Value]]
"""The names (or values) of the results of an operation."""


def results(equation: Equation, found: Sequence[str | Value]) -> list[Value]:
    """The results of an operation with their sizes and types."""
    values: list[Value] = []
    for var, name in zip(equation.outvars, found, strict=True):
        aval: Any = var.aval
        new = Tensor(name, aval.shape, np.dtype(aval.dtype)) if isinstance(name, str) else name
        values.append(new)
    return values
