"""Names as FMI's naming convention "structured" wants them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import count

_PART = r"[A-Za-z_][A-Za-z_0-9]*(?:\[\d+(?:,\d+)*\])?"
_IDENTIFIER = rf"{_PART}(?:\.{_PART})*"
LEGAL = re.compile(rf"{_IDENTIFIER}|der\({_IDENTIFIER}\)")


def legal(name: str) -> str:
    """A name as FMI allows it: as it is, or in quotes.

    ``cell[1][2].v`` becomes ``cell[1,2].v``; in quotes, letters beyond ASCII become their numbers, as in ``#3b1``.
    """
    name = name.replace("][", ",")
    return name if LEGAL.fullmatch(name) else quoted(name)


def quoted(name: str) -> str:
    """A name in quotes, which may hold almost any sign."""
    plain = name.replace("\\", "/").replace("'", "`").replace('"', "`")
    return "'" + "".join(c if " " <= c <= "~" else f"#{ord(c):x}" for c in plain) + "'"


def unused(candidates: Sequence[str], used: set[str]) -> str:
    """The first name that is not in use, or the last one in quotes with a number; it is in use from now on."""
    more = (quoted(f"{candidates[-1].strip(chr(39))} {k}") for k in count(2))
    name = next(n for names in (candidates, more) for n in names if n not in used)
    used.add(name)
    return name


def element(name: str, index: Sequence[int]) -> str:
    """An element of an array, counted from 1: ``weights[1,2,3]`` is that of ``weights[1]`` at ``2,3``."""
    numbers = ",".join(str(i + 1) for i in index)
    return f"{name[:-1]},{numbers}]" if name.endswith("]") else f"{name}[{numbers}]"


def leaf(name: str, module: str) -> str:
    """An array of a network, with its layers counted from 1: ``nn.net.weights[0]`` is ``nn.net.weights[1]``.

    Arguments:
        name: the array's. module: the name of its network, with which it begins.
    """
    rest = re.sub(r"\['(\w+)'\]", r".\1", name[len(module) :])
    return module + re.sub(r"\[(\d+)\]", lambda m: f"[{int(m[1]) + 1}]", rest)
