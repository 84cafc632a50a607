"""Options of a training as text: from a file, or typed one by one."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import acausal as ac
from acausal.errors import listing, nearest, reason, shown

NAMED = (
    *("Bounded", "Shift", "Delay", "Lag"),
    *("Huber", "Student", "Likelihood"),
    *("DampingRatio", "FrequencyRange", "SmallCorrection", "Stability", "ZeroCrossing"),
)
"""Classes of `acausal` that a file may name: ``{"Bounded": {"low": 1.0, "high": 3.0}}``."""

NOT_IN_FILES = ("optimizer", "observers", "devices", "prior", "progress")
"""Options that only Python can give, or that do not matter here."""


def read_options(path: str) -> dict[str, Any]:
    """The options of a JSON or TOML file.

    Raises:
        ac.TrainingError: for a file that cannot be read, or that is neither.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
        options = tomllib.loads(text) if Path(path).suffix == ".toml" else json.loads(text)
    except OSError as error:
        raise ac.TrainingError(f"'{path}' cannot be read: {reason(error)}.") from None
    except (ValueError, RecursionError) as error:  # neither JSON, TOML nor UTF-8
        raise ac.TrainingError(f"'{path}' cannot be read: {error}.") from None
    if not isinstance(options, dict):
        raise ac.TrainingError(f"'{path}' holds {shown(options)}; options are an object by name.")
    return cast(dict[str, Any], options)


def as_keywords(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options as `acausal.fit` takes them.

    Raises:
        ac.TrainingError: for an unknown option, or a value that cannot be given as text.
    """
    from acausal.training import FitOptions

    known = [n for n in FitOptions.__dataclass_fields__ if n not in NOT_IN_FILES]
    for name in options:
        if name in NOT_IN_FILES:
            raise ac.TrainingError(f"The option '{name}' can be given in Python only.")
        if name not in known:
            raise ac.TrainingError(f"There is no option '{name}': {nearest(name, known)}")
    keywords = {name: _value(value, name) for name, value in options.items()}
    FitOptions.of("fit", keywords)
    return keywords


def _value(value: Any, where: str) -> Any:
    """The same with the things that `NAMED` classes make."""
    if isinstance(value, list):
        return [_value(inner, where) for inner in cast(list[Any], value)]
    if not isinstance(value, dict):
        return value
    given = cast(dict[str, Any], value)
    name = next(iter(given), "")
    if len(given) == 1 and name[:1].isupper() and isinstance(given[name], dict):
        return _made(name, given[name], where)
    return {key: _value(inner, f"{where}.{key}") for key, inner in given.items()}


def _made(name: str, arguments: dict[str, Any], where: str) -> Any:
    if name not in NAMED:
        raise ac.TrainingError(f"{where}: there is no '{name}'; known are {listing(NAMED)}.")
    try:
        return getattr(ac, name)(**{n: _value(v, where) for n, v in arguments.items()})
    except ac.AcausalError:
        raise
    except (TypeError, ValueError) as error:  # an argument that it does not have
        raise ac.TrainingError(f"{where}: {name} cannot be made: {error}.") from None
