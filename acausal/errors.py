"""Exceptions: one class per stage, so that a caller can tell a wrong model from wrong data.

Every message says what is wrong, where (dotted names, at most a dozen), and how to fix it.
"""

import operator
import re
import sys
import warnings
from collections.abc import Callable, Collection, Iterable, Sequence
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

LIBRARY = str(Path(__file__).parent)


class AcausalError(Exception):
    """Base of every error that acausal raises on purpose."""


class ModelError(AcausalError):
    """A model is wrong: its declaration, its connections or its equations."""


class DeclarationError(ModelError):
    """A component is declared or modified wrongly."""


class ConnectionError(ModelError):  # noqa: A001 (the field's word; reached as ac.ConnectionError)
    """A connection joins connectors that do not fit each other."""


class UnitError(ModelError):
    """A text is not a unit, or the two sides of an equation have different dimensions."""


class StructureError(ModelError):
    """The equations do not determine the unknowns."""


class InitializationError(ModelError):
    """No consistent initial values were found."""


class DataError(AcausalError):
    """Measured data or inputs are incomplete, malformed or belong to another model."""


class SimulationError(AcausalError):
    """A simulation did not reach its end."""


class StepLimitError(SimulationError):
    """An adaptive simulation used up its steps."""


class ExportError(AcausalError):
    """A model cannot be written in the form that is asked for."""


class TrainingError(AcausalError):
    """A training could not start or could not go on."""


def reason(error: OSError) -> str:
    """The operating system's reason for an error, for a message."""
    return error.strerror or str(error)


def shortened(text: object, limit: int = 80) -> str:
    """A text of at most `limit` characters for a message; a name that a user gives may be anything."""
    text = str(text).encode(errors="backslashreplace").decode()  # halves of surrogate pairs
    return text if len(text) <= limit else text[: limit - 3] + "..."


def shown(value: object, limit: int = 80) -> str:
    """A wrong value for a message: as Python writes it, but on one line of at most `limit` characters.

    Of a title above indented lines, as components have, it is the title.
    """
    text = repr(value)
    title, _, more = text.partition("\n  ")
    is_title = more and re.fullmatch(r"\w[\w' .,\[\]]*", title)
    return shortened(" ".join((title if is_title else text).split()), limit)


def percent(share: float) -> str:
    """A share for a message: in percent, with two digits; from 100 % on without decimals."""
    return f"{100 * share:.2g} %" if abs(share) < 0.995 else f"{100 * share:.0f} %"


def listing(names: Iterable[object], limit: int = 12) -> str:
    """Join names for a message: quoted, at most `limit`, the rest counted."""
    quoted = [f"'{shortened(name)}'" for name in names]
    shown = ", ".join(quoted[:limit])
    return shown if len(quoted) <= limit else f"{shown} and {len(quoted) - limit} more"


def cut_short(things: Sequence[T], most: int, line: Callable[[T], str] = str) -> list[str]:
    """A line for each of the first things, and a last one that counts the others."""
    more = [f"... and {len(things) - most} more"] if len(things) > most else []
    return [*map(line, things[:most]), *more]


def like(name: object, known: Iterable[str], share: float = 0.6) -> str | None:
    """The known name that has at least this share of a name's letters, in order and of either case, if there is one."""
    alike = {candidate.casefold(): candidate for candidate in known}
    close = get_close_matches(str(name)[:200].casefold(), alike, n=1, cutoff=share)
    return alike[close[0]] if close else None


def nearest(name: object, known: Iterable[str]) -> str:
    """A clause that names the nearest known name, or the known ones where none is near."""
    candidates = list(map(str, known))
    if close := like(name, candidates):
        return f"did you mean '{close}'?"
    if not candidates:
        return "there are none to choose from."
    return f"known are {listing(candidates)}."


def known_name(
    name: object,
    known: Collection[str],
    refusal: str,
    error: type[AcausalError] = DataError,
    then: str = ":",
) -> str:
    """A name that is known, as such.

    Arguments:
        name: what the user gave. known: the names.
        refusal: such as ``"there is no record"``. then: what follows the name there, before the nearest known one.

    Raises:
        AcausalError: of the class ``error``, for any other name, and for what is no name.
    """
    if isinstance(name, str) and name in known:
        return name
    # NumPy writes its texts otherwise.
    wrong = str(name) if isinstance(name, str) else name
    raise error(f"{refusal} {shown(wrong)}{then} {nearest(name, known)}")


def need_compiled(system: object, function: str) -> None:
    """Refuse a model, or its class, where its compiled system is needed.

    Raises:
        ModelError: for anything that has no vector field.
    """
    if isinstance(system, type) or not hasattr(system, "vector_field"):
        kind = system.__name__ if isinstance(system, type) else type(system).__name__
        raise ModelError(
            f"{function} needs a compiled model, got {kind}: system = ac.compile(model), then "
            f"ac.{function}(system, ...)"
        )


def is_whole(value: object) -> bool:
    """Whether a value is a whole number of up to 64 bits, of Python, NumPy or JAX; truth values are none."""
    try:
        number = operator.index(value)  # pyright: ignore[reportArgumentType]
    except TypeError:
        return False
    return not isinstance(value, bool) and abs(number) < 2**63


def need_whole(
    given: Any, argument: str, error: type[AcausalError] = DataError, least: int | None = None
) -> int:
    """A whole number as Python's; every public function checks its numbers of something here.

    Arguments:
        given: what the user gave.
        argument: its name, for the message.
        error: the class of the error.
        least: the least number that makes sense.

    Raises:
        AcausalError: of the class ``error``, for what is not such a number.
    """
    if is_whole(given) and (least is None or operator.index(given) >= least):
        return operator.index(given)
    enough = "" if least is None else f", {least} or more"
    raise error(f"{argument}={shown(given)}; give a whole number{enough}.")


def need_package(name: str, what: str, extra: str, error: type[AcausalError] = DataError) -> Any:
    """An optional package, or a module of it, that an extra of acausal installs.

    Raises:
        AcausalError: of the class ``error``, where it is not installed, with the command that installs it.
    """
    package = name.partition(".")[0]
    try:
        return import_module(name)
    except ImportError as missing:
        if missing.name and missing.name.partition(".")[0] != package:
            raise
        raise error(f"{what} needs {package}: pip install 'acausal[{extra}]'.") from None


def need_flag(given: Any, argument: str, error: type[AcausalError] = DataError) -> bool:
    """A truth value, of Python or NumPy, as Python's.

    Raises:
        AcausalError: of the class ``error``, for anything else.
    """
    import numpy as np

    if isinstance(given, bool | np.bool_):
        return bool(given)
    raise error(f"{argument}={shown(given)}; give True or False.")


def need_text(given: Any, argument: str, error: type[AcausalError] = DataError) -> str:
    """A text as such.

    Raises:
        AcausalError: of the class ``error``, for anything else.
    """
    if isinstance(given, str):
        return given
    raise error(f"{argument}={shown(given)} is not a text.")


def warn(text: str) -> None:
    """Warn the first caller outside the library."""
    frame, level = sys._getframe(1), 2
    while frame is not None and frame.f_code.co_filename.startswith(LIBRARY):
        frame, level = frame.f_back, level + 1
    warnings.warn(text, stacklevel=level)
