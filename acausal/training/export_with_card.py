"""Write a trained model for other tools, with a model card beside it."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from acausal.errors import DataError, nearest, user_level
from acausal.files import need_path, new_file, write_files
from acausal.training.model_card import facts, markdown
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Confidence

Writer = Callable[[TrainedModel, Path, dict[str, Any]], tuple[Path, ...]]


def export_with_card(
    fit: TrainedModel,
    path: str | Path,
    confidence: Confidence | None,
    notes: Mapping[str, object] | None,
    overwrite: bool,
    options: Mapping[str, Any],
) -> Path:
    """Write one file and its card; arguments as of `Fit.export`.

    Raises:
        DataError: for an unknown ending, a file that exists, or as the function for this form does.
    """
    target = need_path(path, "fit.export")
    if target.suffix not in _WRITERS:
        raise DataError(
            f"fit.export: there is no form '{target.suffix}'; {nearest(target.suffix, _WRITERS)}"
        )
    cards = [target.with_name(target.name + ending) for ending in (".md", ".json")]
    for card in (target, *cards):
        new_file(card, "fit.export", overwrite, need_folder=False)
    if late := [*fit.delays.items(), *fit.lags.items()]:
        told = ", ".join(f"'{name}' by {seconds:.4g} s" for name, seconds in late)
        warnings.warn(
            f"fit.export: delays and lags lie outside the model, so '{target.name}' does not have them; where it is "
            f"used, delay {told}.",
            stacklevel=user_level(),
        )
    function, write = _WRITERS[target.suffix]
    files = write(fit, target, {**options, "overwrite": overwrite})
    found = facts(fit, files, function, {**options}, confidence, notes or {})
    write_files({cards[0]: markdown(found), cards[1]: json.dumps(found, indent=2) + "\n"})
    return target


def _with_ranges(fit: TrainedModel, options: dict[str, Any]) -> dict[str, Any]:
    return {"ranges": fit.ranges, **options}


def _fmu(fit: TrainedModel, path: Path, options: dict[str, Any]) -> tuple[Path, ...]:
    from acausal.export import fmu

    return (fmu(fit.system, path, fit.params, **_with_ranges(fit, options)),)


def _c(fit: TrainedModel, path: Path, options: dict[str, Any]) -> tuple[Path, ...]:
    from acausal.export import c

    own: dict[str, Any] = {"name": path.stem, **_with_ranges(fit, options)}
    return c(fit.system, path.parent, fit.params, **own)[::-1]


def _onnx(fit: TrainedModel, path: Path, options: dict[str, Any]) -> tuple[Path, ...]:
    from acausal.export import onnx

    return (onnx(fit.system, path, fit.params, **options),)


def _stablehlo(fit: TrainedModel, path: Path, options: dict[str, Any]) -> tuple[Path, ...]:
    from acausal.export import stablehlo

    return (stablehlo(fit.system, path, fit.params, **options),)


def _modelica(fit: TrainedModel, path: Path, options: dict[str, Any]) -> tuple[Path, ...]:
    from acausal.export import modelica

    return (modelica(fit.system, path, fit.params, **options),)


_WRITERS: dict[str, tuple[str, Writer]] = {
    ".fmu": ("fmu", _fmu),
    ".c": ("c", _c),
    ".onnx": ("onnx", _onnx),
    ".jax": ("stablehlo", _stablehlo),
    ".mlir": ("stablehlo", _stablehlo),
    ".mlirbc": ("stablehlo", _stablehlo),
    ".mo": ("modelica", _modelica),
}
"""By the ending of the path, the function of `acausal.export` and how it is called."""
