"""Tokens of Modelica text, each with its place; and the error that shows a place."""

from __future__ import annotations

import re
from bisect import bisect_left
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from acausal.netlist import MAX_BYTES, Grammar, NetlistError

SPACE = r"(?:[\s\ufeff]+|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/)*"
TOKEN = re.compile(
    rf"{SPACE}("
    r"[A-Za-z_][A-Za-z0-9_]*"
    r"|(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
    r"|:=|<=|>=|==|<>|\.[-+*/^]|/(?!\*)|[-+*^()\[\]{},;:=<>.]"
    r'|"(?:[^"\\]|\\.)*"'
    r"|'(?:[^'\\]|\\.)*')",
    re.ASCII | re.DOTALL,
)
REST = re.compile(rf"{SPACE}\Z")
KEYWORDS = frozenset((
    "algorithm", "and", "annotation", "block", "break", "class", "connect", "connector", "constant",
    "constrainedby", "der", "discrete", "each", "else", "elseif", "elsewhen", "encapsulated", "end",
    "enumeration", "equation", "expandable", "extends", "external", "false", "final", "flow", "for",
    "function", "if", "import", "impure", "in", "initial", "inner", "input", "loop", "model", "not",
    "operator", "or", "outer", "output", "package", "parameter", "partial", "protected", "public",
    "pure", "record", "redeclare", "replaceable", "return", "stream", "then", "true", "type", "when",
    "while", "within",
))  # fmt: skip


PREDEFINED = frozenset(("Real", "Integer", "Boolean", "String", "Clock", "ExternalObject"))


class ModelicaError(NetlistError):
    """Modelica text is wrong, or says what is not supported; the message begins with file, line and column."""


class NumbersNeededError(ModelicaError):
    """What Modelica text computes becomes no expression that is small enough; of numbers it could be computed."""


@dataclass(frozen=True, eq=False)
class Source:
    """The text of one file, with its name and, where it is known, its folder."""

    name: str
    text: str
    folder: Path | None = None

    @cached_property
    def _ends(self) -> list[int]:
        return [found.start() for found in re.finditer("\n", self.text)]

    def place(self, at: int) -> str:
        """The line of a place, for messages."""
        return f"line {bisect_left(self._ends, at) + 1} of {self.name}"

    def wrong(self, at: int, reason: str, length: int | None = None) -> ModelicaError:
        """The error at a place, with the line and what is meant underlined."""
        at = min(at, len(self.text))
        begin = self.text.rfind("\n", 0, at) + 1
        line = self.text[begin:].partition("\n")[0].rstrip()
        if length is None:
            found = TOKEN.match(self.text, at)
            length = found.end() - at if found else 1
        column, number = at - begin, self.text.count("\n", 0, at) + 1
        first = max(0, column - 60)
        shown = line[first : first + 100].replace("\t", " ")
        mark = "^" * max(1, min(length, len(shown) - (column - first)))
        return ModelicaError(
            f"{self.name}, line {number}, column {column + 1}: {reason}\n"
            f"    {shown}\n    {' ' * (column - first)}{mark}"
        )


def read_source(path: Path) -> Source:
    """The text of a file.

    Raises:
        ModelicaError: if it cannot be read, is too large, or is not text.
    """
    try:
        if path.stat().st_size > MAX_BYTES:
            raise ModelicaError(f"{path.name}: larger than {MAX_BYTES // 1_000_000} MB")
        return Source(path.name, path.read_text(encoding="utf-8-sig"), path.resolve().parent)
    except OSError as error:
        raise ModelicaError(f"{path}: cannot be read ({error.strerror})") from None
    except UnicodeDecodeError:
        raise ModelicaError(f"{path.name}: not a text file in UTF-8; save it as one") from None


def unquoted(text: str) -> str:
    """A name in quotes as a name of Python's where it is one; ``'{U+03C9}'`` stands for a letter as in an export."""
    word = re.sub(r"\{U\+([0-9A-F]{4,6})\}", lambda found: chr(int(found[1], 16)), text[1:-1])
    return word if word.isidentifier() and word not in KEYWORDS | PREDEFINED else text


class Tokens(Grammar):
    """The tokens of a text, and how far they are read.

    Attributes:
        texts, starts: of each token; the last is the end, with an empty text.
    """

    end = "the end of the file"

    def __init__(self, source: Source) -> None:
        self.source = source
        self.texts: list[str] = []
        self.starts: list[int] = []
        text, end = source.text, 0
        for found in iter(TOKEN.scanner(text).match, None):  # pyright: ignore[reportAttributeAccessIssue]
            self.texts.append(found[1])
            self.starts.append(found.start(1))
            end = found.end()
        rest = REST.match(text, end)
        if rest is None:
            at = re.compile(SPACE).match(text, end).end()  # pyright: ignore[reportOptionalMemberAccess]
            what = {'"': "this text has no end", "/": "this comment has no end"}.get(text[at])
            raise source.wrong(at, what or f"'{text[at]}' is not allowed in Modelica", 1)
        self.texts.append("")
        self.starts.append(len(text.rstrip()))

    @property
    def at(self) -> int:
        """Where the next token begins."""
        return self.starts[self.position]

    def identifier(self) -> str:
        """Read a name that is no keyword.

        Raises:
            ModelicaError: if something else is next.
        """
        text = self.texts[self.position]
        if not (text[:1].isalpha() or (text[:1] in ("_", "'") and text)) or text in KEYWORDS:
            raise self.wrong(f"a name expected, {self.found} found")
        self.position += 1
        return unquoted(text) if text[0] == "'" else text

    def wrong(self, reason: str) -> ModelicaError:
        """The error at the next token."""
        return self.source.wrong(self.at, reason, len(self.peek))
