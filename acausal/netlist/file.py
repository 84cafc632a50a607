"""JSON netlists as files: read within limits, and written. The reader gives the text its meaning."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, cast

from acausal.errors import ModelError, nearest, shortened
from acausal.files import write_files

MAX_BYTES = 100_000_000
MAX_NESTING = 100
MAX_DIGITS = 400
MODEL_KEYS = (
    "model",
    "parameters",
    "connectors",
    "variables",
    "components",
    "connections",
    "equations",
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
    unfit = _Unfit()
    try:
        if path.stat().st_size > MAX_BYTES:
            raise NetlistError(f"{where}: larger than {MAX_BYTES // 1_000_000} MB")
        document = json.loads(
            path.read_text(encoding="utf-8-sig"),
            object_pairs_hook=_unique,
            parse_constant=unfit.constant,
            parse_float=unfit.float,
            parse_int=unfit.int,
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
    for number, reason in unfit.numbers[:1]:
        raise NetlistError(f"{where}: {_place(document, number)}{reason}")
    if not isinstance(document, dict):
        raise NetlistError(f"{where}: a model is an object {{...}}, not {kind(document)}")
    return cast(dict[str, Any], document)


def write(document: Mapping[str, Any], path: Path) -> None:
    """Write a document.

    Raises:
        NetlistError: if the file cannot be written.
    """
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
    write_files({path: text + "\n"}, NetlistError)


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


def need_keys(given: Iterable[str], known: Sequence[str], where: str, what: str = "key") -> None:
    """Refuse a key, or an attribute, that is not known; the message names the nearest one."""
    for key in given:
        if key not in known:
            raise NetlistError(f"{where}: unknown {what} '{shortened(key)}'; {nearest(key, known)}")


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


class _Unfit:
    """Reads numbers, and keeps those that are not finite until the document shows where they are.

    Attributes:
        numbers: what was read in their place, an object that is nowhere else; and why they are refused.
    """

    def __init__(self) -> None:
        self.numbers: list[tuple[Any, str]] = []

    def constant(self, name: str) -> Any:
        return self._kept(f"{name} is not a finite number")

    def float(self, text: str) -> Any:
        value = float(text)
        return (
            value
            if math.isfinite(value)
            else self._kept(f"{shortened(text, 40)} is not a finite number")
        )

    def int(self, text: str) -> Any:
        if len(text) > MAX_DIGITS:
            return self._kept(f"{shortened(text, 40)} is too large, with {len(text)} digits")
        value = int(text)
        return value if abs(value) <= 2**53 else self.float(text)

    def _kept(self, reason: str) -> Any:
        self.numbers.append((object(), reason))
        return self.numbers[-1][0]


def _place(document: Any, sought: Any) -> str:
    """Where a value stands in a document, such as ``components.mass.with.m: ``."""
    waiting: list[tuple[str, Any]] = [("", document)]
    while waiting:
        place, value = waiting.pop()
        if value is sought:
            return f"{place}: " if place else ""
        if isinstance(value, dict):
            waiting += [(f"{place}.{shortened(k)}".lstrip("."), v) for k, v in value.items()]
        elif isinstance(value, list):
            waiting += [(f"{place}[{i}]", v) for i, v in enumerate(value)]
    return ""


def _deeper(document: Any, limit: int) -> bool:
    """Whether objects and lists are nested deeper than a limit."""
    level: list[Any] = [document]
    for _ in range(limit + 1):
        containers = [v for v in level if isinstance(v, dict | list)]
        if not containers:
            return False
        level = [v for c in containers for v in (c.values() if isinstance(c, dict) else c)]
    return True
