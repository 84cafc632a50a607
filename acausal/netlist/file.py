"""JSON netlists as files: read within limits, and written. The reader gives the text its meaning."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, cast

from acausal.errors import ModelError, shortened

MAX_BYTES = 100_000_000
MAX_NESTING = 100
MAX_DIGITS = 400
MODEL_KEYS = (
    "model",
    "parameters",
    "connectors",
    "components",
    "connections",
    "initial_equations",
)
EXPERIMENT_KEYS = ("start_time", "stop_time", "compare", "unparsed", "description")
"""Keys of a document that are kept, but are not part of the model."""


class NetlistError(ModelError):
    """A netlist file is malformed; the message begins with the place in it."""


def read(path: Path) -> dict[str, Any]:
    """The document of a file.

    Raises:
        NetlistError: if it cannot be read, is not JSON, is too large or too deep, or holds a name twice in one object
            or a number that is not finite.
    """
    where = path.name
    try:
        if path.stat().st_size > MAX_BYTES:
            raise NetlistError(f"{where}: larger than {MAX_BYTES // 1_000_000} MB")
        document = json.loads(
            path.read_text(encoding="utf-8"),
            object_pairs_hook=_unique,
            parse_constant=_refuse,
            parse_float=_float,
            parse_int=_int,
        )
    except OSError as error:
        raise NetlistError(f"{path}: cannot be read ({error.strerror})") from None
    except UnicodeDecodeError:
        raise NetlistError(f"{where}: not a text file in UTF-8") from None
    except RecursionError:
        raise NetlistError(f"{where}: nested more than {MAX_NESTING} deep") from None
    except json.JSONDecodeError as error:
        place = f"{where}, line {error.lineno}, column {error.colno}"
        raise NetlistError(f"{place}: not JSON ({error.msg})") from None
    except ValueError as error:
        raise NetlistError(f"{where}: {error}") from None
    if _deeper(document, MAX_NESTING):
        raise NetlistError(f"{where}: nested more than {MAX_NESTING} deep")
    if not isinstance(document, dict):
        raise NetlistError(f"{where}: a model is an object {{...}}, not {kind(document)}")
    return cast(dict[str, Any], document)


def write(document: Mapping[str, Any], path: Path) -> None:
    """Write a document.

    Raises:
        NetlistError: if the file cannot be written.
    """
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
    try:
        path.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise NetlistError(f"{path}: cannot be written ({error.strerror})") from None


def within(where: str, action: Callable[[], Any]) -> Any:
    """Run an action; an error about the model begins with the place in the file."""
    try:
        return action()
    except NetlistError:
        raise
    except ModelError as error:
        raise NetlistError(f"{where}: {error}") from None


def as_object(document: Mapping[str, Any], key: str, where: str) -> Mapping[str, Any]:
    """The section of that name, an object; empty where there is none."""
    value = document.get(key, {})
    if not isinstance(value, Mapping):
        raise NetlistError(f"{where}: '{key}' is an object {{name: ...}}, not {kind(value)}")
    return cast(Mapping[str, Any], value)


def as_list(document: Mapping[str, Any], key: str, where: str) -> list[Any]:
    """The section of that name, a list; empty where there is none."""
    value = document.get(key, [])
    if not isinstance(value, list):
        raise NetlistError(f"{where}: '{key}' is a list, not {kind(value)}")
    return cast(list[Any], value)


def kind(value: Any) -> str:
    """What a JSON value is, for a message."""
    match value:
        case dict():
            return "an object"
        case list():
            return "a list"
        case str():
            return f"the text '{shortened(value, 40)}'"
        case None:
            return "nothing"
        case bool():
            return str(value).lower()
        case _:
            return shortened(repr(value), 40)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        seen: set[str] = set()
        for name, _ in pairs:
            if name in seen:
                raise ValueError(f"'{shortened(name)}' occurs twice in one object")
            seen.add(name)
    return found


def _refuse(name: str) -> Any:
    raise ValueError(f"{name} is not a finite number")


def _float(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{shortened(text, 40)} is not a finite number")
    return value


def _int(text: str) -> int | float:
    if len(text) > MAX_DIGITS:
        raise ValueError(f"{shortened(text, 40)} is too large, with {len(text)} digits")
    value = int(text)
    return value if abs(value) <= 2**53 else _float(text)


def _deeper(document: Any, limit: int) -> bool:
    """Whether objects and lists are nested deeper than a limit."""
    level: list[Any] = [document]
    for _ in range(limit + 1):
        containers = [v for v in level if isinstance(v, dict | list)]
        if not containers:
            return False
        level = [v for c in containers for v in (c.values() if isinstance(c, dict) else c)]
    return True
