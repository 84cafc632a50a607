"""Networks and right-hand sides as ONNX files."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from jax.typing import DTypeLike

from acausal._jax import need_double_precision, precision
from acausal.analysis import Observer
from acausal.errors import need_package
from acausal.export.target import Target, target_of, traced
from acausal.files import file_to_write, write_files
from acausal.system import System


def onnx(
    model: System | Observer | Callable[..., Any],
    path: str | Path,
    params: Mapping[str, Any] | None = None,
    *,
    network: str | None = None,
    inputs: Sequence[str] | None = None,
    outputs: Sequence[str] = (),
    units: Mapping[str, str] | None = None,
    parameters: bool = False,
    batch: str | None = None,
    dtype: DTypeLike = "float64",
) -> Path:
    """Write a network, or the right-hand side of a model, as an ONNX file.

    A network is a function of its arguments in physical units: scales and promises are part of the graph. Of a model
    the file has inputs ``t``, ``x``, ``u`` (and ``d``, the discrete variables, if there are any), and results
    ``der(x)`` and ``y``; what has no elements is left out. The file's ``metadata_props`` have the names and units of
    all elements.

    Arguments:
        model: a compiled system; a network: a module that is called with scalars; or an observer, whose step takes
            ``t``, ``u``, ``y`` and what it remembers: its results ``t_after``, ``u_after``, ``mean_after`` and
            ``covariance_after`` are the next step's ``t_before``, ``u_before``, ``mean`` and ``covariance``.
        path: the file, usually ``….onnx``.
        params: of the system; by default its own.
        network: the name of a network among ``params``, to write it alone.
        inputs: names of a network's arguments; by default those of the equation in which the system calls it, else
            ``x`` or ``x1``, ``x2``, ...
        outputs: names of the variables in ``y``; of a network the name of its result.
        units: of a network's inputs and output, by name; those of the system where it knows them.
        parameters: whether the system's parameters, and the weights of its networks, are inputs, too; their values
            are the defaults.
        batch: the name of a leading dimension of all inputs but parameters, such as ``"N"``; by default there is none.
        dtype: ``"float64"`` or ``"float32"``. What is computed iteratively needs double precision.

    Returns:
        The path.

    Raises:
        DataError: in one sentence, for an operation that has no counterpart in ONNX, an unknown name, what is no
            path of a file, or if the package onnx is not installed.
    """
    need_double_precision()
    real = precision(dtype)
    file = file_to_write(path, "export.onnx")
    need_package("onnx", "export.onnx", "export")
    from acausal.export.onnx_text import model_of

    target = target_of(model, params, network, inputs, outputs, units, parameters, "onnx")
    target = _with_names_apart(target)
    closed = traced(target, batch, "onnx")
    names = [p.name for p in target.inputs], [p.name for p in target.outputs]
    defaults = {p.name: p.default for p in target.inputs if p.default is not None}
    message = model_of(closed, names, defaults, real, target.title, notes(target))
    write_files({file: message.SerializeToString()})
    return file


def _with_names_apart(target: Target) -> Target:
    """What is both given and a result, as what an observer remembers, has two names in a graph."""
    given = {p.name for p in target.inputs}
    results = [
        replace(p, name=f"{p.name.removesuffix('_before')}_after") if p.name in given else p
        for p in target.outputs
    ]
    return replace(target, outputs=tuple(results))


def notes(target: Target) -> dict[str, str]:
    """Names and units of the elements of each input and result, as JSON."""
    return {
        f"acausal.{p.name}": json.dumps({"names": p.elements, "units": p.units})
        for p in (*target.inputs, *target.outputs)
        if p.default is None
    }
