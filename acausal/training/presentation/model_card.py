"""The model card of a trained model: facts for programs, and the same as a text for people."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import numpy as np

from acausal.analysis import labels
from acausal.errors import shown
from acausal.files import finite
from acausal.networks import promises_of
from acausal.training.record_fit import RecordFit
from acausal.training.trained_model import TrainedModel
from acausal.training.uncertainty.confidence import Confidence

if TYPE_CHECKING:
    from acausal.system import System

PACKAGES = ("acausal", "jax", "diffrax", "equinox", "optax", "sympy", "numpy")
"""Packages whose versions a card names."""


def facts(
    fit: TrainedModel,
    files: Sequence[Path],
    function: str,
    options: Mapping[str, Any],
    confidence: Confidence | None,
    notes: Mapping[str, object],
) -> dict[str, Any]:
    """What a card says, as JSON can hold it; what is no finite number is None.

    Arguments:
        files: that were written. function: of `acausal.export`; ``options``: given to it.
        confidence: of the fit, if it was asked for. notes: of the user.
    """
    system = fit.system
    flags = {"fmu": "outside_training_range", "c": f"{files[0].stem}_outside"}
    return finite(
        {
            "model": type(system.model).__name__,
            "written": datetime.now(UTC).strftime("%Y-%m-%d"),
            "files": [_file(path) for path in files],
            "export": {"function": f"acausal.export.{function}", "options": {n: shown(v) for n, v in options.items()}},
            "flag": flags.get(function) if fit.ranges and options.get("ranges", True) else None,
            "states": {n: system.unit(n) for n in system.states},
            "inputs": {n: system.unit(n) for n in system.inputs},
            "notes": {n: _plain(v) for n, v in notes.items()},
            "data": {
                "trained on": [_record(system, r) for r in fit.records.values()],
                "held out": [_record(system, r) for r in fit.held_out.values()],
            },
            "training": {
                **fit.settings,
                "updates done": fit.history.epochs,
                "best after update": fit.best_epoch,
                "seconds": fit.seconds,
                "ended by the user": fit.interrupted,
                "divergences": len(fit.history.divergences),
            },
            "losses": {
                "before training": fit.loss_before,
                "after training": fit.loss,
                "over what is held out": fit.validation_loss,
            },
            "errors": {n: {"rms": e, "unit": system.unit(n)} for n, e in fit.rms.items()},
            "networks": {n: _network(fit, n, confidence) for n in fit.seen},
            "parameters": {n: _parameter(fit, n, confidence) for n in fit.modifiers},
            "beside the model": {"delays": fit.delays, "lags": fit.lags},
            "by record": {n: r.parameters for n, r in fit.records.items() if r.parameters},
            "confidence": None if confidence is None else confidence.summary(),
            "versions": {"python": platform.python_version(), **dict(_versions())},
        }
    )  # fmt: skip


def _plain(value: object) -> object:
    """A number or a text as it is; anything else as Python writes it."""
    number = value.item() if isinstance(value, np.generic) else value
    return number if isinstance(number, float | int | str) else shown(number)


def _file(path: Path) -> dict[str, Any]:
    content = path.read_bytes()
    return {"name": path.name, "bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}


def _record(system: System, record: RecordFit) -> dict[str, Any]:
    measured = np.isfinite(record.measured).sum(axis=0).tolist()
    steps = np.diff(record.time)
    return {
        "name": record.name,
        "samples": len(record.time),
        "from": float(record.time[0]),
        "to": float(record.time[-1]),
        "sample time": float(np.median(steps)) if len(steps) else None,
        "targets": {
            n: {"unit": system.unit(n), "samples": int(count)}
            for n, count in zip(record.targets, measured, strict=True)
        },
        "inputs": {n: system.unit(n) for n in record.inputs},
        "rms error": record.rms,
    }


def _network(fit: TrainedModel, name: str, confidence: Confidence | None) -> dict[str, Any]:
    found, statistics = labels(fit.system, name, fit.system.pack(fit.params)), fit.seen[name]
    leaves = jax.tree.leaves(eqx.filter(fit.params[name], eqx.is_inexact_array))
    bounds = fit.ranges.get(name)
    band = None if confidence is None else confidence.laws.get(name)
    return {
        "arguments": [
            {
                "name": found.arguments[i] if i < len(found.arguments) else f"argument {i + 1}",
                "low": None if bounds is None else bounds[i][0],
                "high": None if bounds is None else bounds[i][1],
                "mean": float(statistics.mean[i]),
                "sigma": float(statistics.sigma[i]),
            }
            for i in range(len(statistics.mean))
        ],
        "result": found.result,
        "promises": list(promises_of(fit.params[name])),
        "weights": sum(int(np.size(leaf)) for leaf in leaves),
        "factor": found.factor,
        "one sigma": None if band is None else abs(found.factor) * float(np.median(band.sigma)),
    }


def _parameter(fit: TrainedModel, name: str, confidence: Confidence | None) -> dict[str, Any]:
    return {
        "value": float(fit.problem.assemble(fit.trained)[name]),
        "unit": fit.problem.unit(name),
        "change": fit.modifiers[name],
        "one sigma": None if confidence is None else confidence.parameters.get(name),
    }


def _versions() -> Iterator[tuple[str, str]]:
    for package in PACKAGES:
        try:
            yield package, version(package)
        except PackageNotFoundError:
            continue


# -- the text ------------------------------------------------------------------------------------------


def markdown(card: Mapping[str, Any]) -> str:
    """The card as a text, from `facts`."""
    return "\n\n".join(_parts(card)) + "\n"


def _parts(card: Mapping[str, Any]) -> Iterator[str]:
    yield f"# Model card: {card['model']}"
    names = ", ".join(f"`{f['name']}`" for f in card["files"])
    yield f"{names}, written by `{card['export']['function']}` on {card['written']}."
    yield _table(
        ("file", "bytes", "SHA-256"), ((f["name"], f["bytes"], f["sha256"]) for f in card["files"])
    )
    if card["export"]["options"]:
        yield (
            "Options: "
            + ", ".join(f"`{n}={v}`" for n, v in card["export"]["options"].items())
            + "."
        )
    if card["notes"]:
        yield _table(("", ""), card["notes"].items())
    yield from _inside(card)
    yield "## Data"
    for title, records in card["data"].items():
        if records:
            yield f"{title.capitalize()}:"
            yield _table(("record", "samples", "from [s]", "to [s]", "sample time [s]", "targets", "inputs"),
                         map(_record_row, records))  # fmt: skip
    yield "## Training"
    yield _table(("", ""), card["training"].items())
    yield "## Losses"
    rows = [(n, v) for n, v in card["losses"].items() if not (v is None and "held out" in n)]
    yield _table(
        ("loss", ""), ((n, "infinite: the model diverges" if v is None else v) for n, v in rows)
    )
    yield _table(
        ("target", "root mean square error"),
        ((n, f"{_short(e['rms'])} {e['unit']}") for n, e in card["errors"].items()),
    )
    yield "## How sure"
    if card["confidence"] is None:
        yield "Not computed; `fit.export(..., confidence=fit.confidence())` adds it."
    else:
        yield "\n".join(f"- {sentence}" for sentence in card["confidence"])
    yield "## Versions"
    yield ", ".join(f"{n} {v}" for n, v in card["versions"].items())


def _inside(card: Mapping[str, Any]) -> Iterator[str]:
    """What the model has, and what of it was learned."""
    yield "## Model"
    for kind in ("states", "inputs"):
        if card[kind]:
            yield f"{kind.capitalize()}: " + _quantities(card[kind]) + "."
    if card["networks"]:
        yield "## Learned laws"
        yield (
            "Outside of the range that its argument had in training a law is a guess. One sigma: the median of the "
            "law's standard deviation."
            + (
                f" `{card['flag']}` tells when an argument has left its range."
                if card["flag"]
                else ""
            )
        )
        header = (
            "network",
            "argument",
            "lowest",
            "highest",
            "law",
            "one sigma",
            "weights",
            "promises",
        )
        yield _table(header, (row for n, net in card["networks"].items() for row in _laws(n, net)))
    if card["parameters"]:
        yield "## Trained parameters"
        yield "Changes and one sigma are relative, or in the parameter's unit for one with a shift or bounds."
        rows = (
            (n, f"{_short(p['value'])} {p['unit']}", _short(p["change"]), _short(p["one sigma"]))
            for n, p in card["parameters"].items()
        )
        yield _table(("parameter", "value", "change", "one sigma"), rows)

    late = [
        (kind[:-1], n, v) for kind, of in card["beside the model"].items() for n, v in of.items()
    ]
    if late:
        yield "## Delays and lags"
        yield "They lie between the model and its measurements: the file does not have them."
        yield _table(("", "of", "seconds"), late)
    if card["by record"]:
        yield "## Parameters that differ between records"
        names = list(next(iter(card["by record"].values())))
        shared = ", ".join(f"`{n}`" for n in names)
        yield f"The file has common values of {shared}; those of the records are:"
        rows = ((record, *(own[n] for n in names)) for record, own in card["by record"].items())
        yield _table(("record", *names), rows)


def _laws(name: str, net: Mapping[str, Any]) -> Iterator[tuple[Any, ...]]:
    """A row for each argument; what belongs to the whole network is in the first."""
    promises = "; ".join(net["promises"]) or "none"
    rest: tuple[Any, ...] = (net["result"], net["one sigma"], net["weights"], promises)
    for i, argument in enumerate(net["arguments"]):
        own = (argument["name"], argument["low"], argument["high"])
        yield (name if i == 0 else "", *own, *(rest if i == 0 else ("",) * len(rest)))


def _record_row(record: Mapping[str, Any]) -> tuple[Any, ...]:
    targets = ", ".join(
        f"{_quantity(n, t['unit'])} ({t['samples']})" for n, t in record["targets"].items()
    )
    times = (record["from"], record["to"], record["sample time"])
    return record["name"], record["samples"], *times, targets, _quantities(record["inputs"])


def _quantities(units: Mapping[str, str], most: int = 20) -> str:
    texts = [_quantity(n, unit) for n, unit in units.items()]
    return ", ".join(texts[:most]) + (f" and {len(texts) - most} more" if len(texts) > most else "")


def _quantity(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _table(header: Sequence[str], rows: Any) -> str:
    written = [[_short(cell).replace("|", "\\|") for cell in row] for row in rows]
    lines = [list(header), ["---"] * len(header), *written]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _short(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.5g}" if isinstance(value, float) else str(value)
