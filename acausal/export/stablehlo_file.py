"""Networks and right-hand sides as StableHLO, the portable form of what JAX compiles."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import jax
from jax import export as jax_export
from jax.typing import DTypeLike

from acausal._jax import need_double_precision, precision
from acausal.analysis import Observer
from acausal.errors import DataError, known_name, need_package, shown
from acausal.export.target import Target, arguments, target_of
from acausal.files import file_to_write, write_files
from acausal.modeling import names_in
from acausal.system import System

ENDINGS = (".mlir", ".mlirbc", ".jax")
"""Endings of files: StableHLO as text, as portable bytes, and with JAX's record of shapes and derivatives."""

PLATFORMS = ("cpu", "cuda", "rocm", "tpu")
"""What files can be compiled for."""


def stablehlo(
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
    derivatives: int = 1,
    platforms: Sequence[str] = ("cpu",),
) -> Path:
    """Write a network, or the right-hand side of a model, as StableHLO.

    The ending of the path chooses the form. ``.jax`` is for JAX alone:
    ``jax.export.deserialize(bytearray(path.read_bytes())).call(t, x, u)`` gives a tuple and can be differentiated.
    ``.mlir`` is text and ``.mlirbc`` its versioned bytes, for XLA, IREE or TensorFlow. Arguments and results are those
    of `onnx`, in the same order.

    Arguments:
        model, params, network, inputs, outputs, units, parameters, batch, dtype: as of `onnx`. With ``parameters`` all
            of them must be given in a call.
        path: the file, ``….jax``, ``….mlir`` or ``….mlirbc``.
        derivatives: how often a ``.jax`` can be differentiated.
        platforms: for which it is compiled: ``"cpu"``, ``"cuda"``, ``"rocm"``, ``"tpu"``.

    Returns:
        The path.

    Raises:
        DataError: in one sentence, for an unknown name or ending, what is no path of a file, an operation that
            calls Python or a library, or if the package flatbuffers is not installed.
    """
    need_double_precision()
    real = precision(dtype)
    file = file_to_write(path, "export.stablehlo")
    if file.suffix not in ENDINGS:
        raise DataError(
            f"export.stablehlo: the ending '{file.suffix}' is no form; end the path in {', '.join(ENDINGS)}"
        )
    if file.suffix == ".jax":
        need_package("flatbuffers", "export.stablehlo", "export")
    if not (isinstance(derivatives, int) and derivatives >= 0):
        raise DataError(
            f"export.stablehlo: derivatives={shown(derivatives)} is how often; give 0, 1 or 2"
        )
    compiled_for = names_in(platforms, "export.stablehlo: platforms")
    for platform in compiled_for:
        known_name(platform, PLATFORMS, "export.stablehlo: there is no platform")
    target = target_of(model, params, network, inputs, outputs, units, parameters, "stablehlo")
    call = target.call if batch is None else target.batch()
    shapes = [jax.ShapeDtypeStruct(s.shape, real) for s in arguments(target, batch, "stablehlo")]

    def in_precision(*arrays: jax.Array) -> tuple[jax.Array, ...]:
        return tuple(result.astype(real) for result in call(*arrays))

    try:
        exported = jax_export.export(
            jax.jit(in_precision, keep_unused=True), platforms=compiled_for
        )(*shapes)
        write_files({file: _content(exported, file.suffix, target, derivatives)})
    except (ValueError, NotImplementedError, TypeError) as error:
        reason = str(error).splitlines()[0]
        raise DataError(
            f"export.stablehlo: JAX cannot export it ({reason}); "
            "write the network without host callbacks and foreign calls"
        ) from None
    return file


def _content(
    exported: jax_export.Exported, form: str, target: Target, derivatives: int
) -> str | bytes:
    if form == ".jax":
        return bytes(exported.serialize(vjp_order=derivatives))
    if form == ".mlirbc":
        return exported.mlir_module_serialized
    ports = [("argument", target.inputs), ("result", target.outputs)]
    lines = [
        f"// {kind} {i}: {p.name}: {json.dumps(p.elements)} in {json.dumps(p.units)}"
        for kind, several in ports
        for i, p in enumerate(several)
    ]
    return "\n".join([f"// {target.title}", *lines, _without_places(exported.mlir_module())])


def _without_places(text: str) -> str:
    """The text of a module without the lines of Python that its operations come from, and the paths of these."""
    kept = [line for line in text.splitlines() if not line.startswith("#loc")]
    return re.sub(r" loc\(#loc\d*\)", "", "\n".join(kept)) + "\n"
