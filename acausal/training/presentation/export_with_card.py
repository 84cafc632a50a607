"""Write a trained model for other tools, with a model card beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import acausal.export as export
from acausal.errors import DataError, known_name, shown, warn
from acausal.files import file_to_write, json_text, need_path, write_files
from acausal.modeling import by_name
from acausal.training.presentation.model_card import facts, markdown
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Confidence

FORMS = {
    ".fmu": "fmu",
    ".c": "c",
    ".onnx": "onnx",
    ".jax": "stablehlo",
    ".mlir": "stablehlo",
    ".mlirbc": "stablehlo",
    ".mo": "modelica",
}
"""By the ending of the path, the function of `acausal.export`."""

WITH_RANGES = ("fmu", "c")
"""Forms that tell when a network leaves its range."""


def export_with_card(
    fit: TrainedModel,
    path: str | Path,
    confidence: Confidence | None,
    notes: Mapping[str, object] | None,
    options: Mapping[str, Any],
) -> Path:
    """Write one file and its card; arguments as of `Fit.export`.

    Raises:
        DataError: for an unknown ending, what is no path of a file, or as the function for this form does.
    """
    target = need_path(path, "fit.export")
    known_name(target.suffix, FORMS, "fit.export: there is no form", then=";")
    cards = [target.with_name(target.name + ending) for ending in (".md", ".json")]
    for card in (target, *cards):
        file_to_write(card, "fit.export", need_folder=False)
    if late := [*fit.delays.items(), *fit.lags.items()]:
        told = ", ".join(f"'{name}' by {seconds:.4g} s" for name, seconds in late)
        warn(
            f"fit.export: delays and lags lie outside the model, so '{target.name}' does not have them; where it is "
            f"used, delay {told}."
        )
    if not isinstance(confidence, Confidence | None):
        raise DataError(
            f"fit.export: confidence={shown(confidence)}; give that of fit.confidence()."
        )
    further = by_name(notes, "fit.export: notes", "lines by title")
    function = FORMS[target.suffix]
    own = {**({"ranges": fit.ranges} if function in WITH_RANGES else {}), **options}
    write: Any = getattr(export, function)
    if function == "c":
        own = {"name": target.stem, **own}
        files = write(fit.system, target.parent, fit.params, **own)[::-1]
    else:
        files = (write(fit.system, target, fit.params, **own),)
    found = facts(fit, files, function, {**options}, confidence, further)
    write_files({cards[0]: markdown(found), cards[1]: json_text(found, 2)})
    return target
