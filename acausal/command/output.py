"""What commands print: tables and sentences for people, JSON for programs."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from textwrap import indent
from typing import Any, TextIO

from acausal.command.exit_codes import kind_of
from acausal.files import json_text


@dataclass(frozen=True)
class CommandOutput:
    """Where a command's results go: with colors and lines in a terminal, plain in a pipe or file.

    Attributes:
        as_json: whether the result is one JSON document, and nothing else, on the standard output.
        warnings: sentences of warnings up to now.
    """

    as_json: bool = False
    warnings: list[str] = field(default_factory=list[str])

    def say(self, text: str = "") -> None:
        """A line for people."""
        if not self.as_json:
            sys.stdout.write(f"{text}\n")

    def wrote(self, files: Iterable[object]) -> None:
        """The files that a command has written, a line each."""
        for file in files:
            self.say(f"wrote {file}")

    def title(self, text: str) -> None:
        """A line that begins a section."""
        if not self.as_json:
            self._styled(sys.stdout, "", text, "bold")

    def table(self, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
        """Rows of texts below a header."""
        if self.as_json:
            return
        if sys.stdout.isatty():
            _rich_table(header, rows)
        else:
            from acausal.reporting import aligned  # so that help imports no sympy

            sys.stdout.write(indent(aligned([header, *rows]), "  ") + "\n")

    def result(self, document: Mapping[str, Any]) -> None:
        """The result for programs, with the warnings."""
        if self.as_json:
            sys.stdout.write(json_text({**document, "warnings": self.warnings}))

    def warn(self, sentence: str) -> None:
        """A warning, on the standard error."""
        self.warnings.append(sentence)
        self._styled(sys.stderr, "warning: ", sentence, "yellow")

    def fail(self, error: Exception | KeyboardInterrupt, place: str = "") -> int:
        """An error, on the standard error; for programs on the standard output, too. Returns the exit code."""
        code, kind = kind_of(error)
        sentence = place + (str(error) or kind)
        self._styled(sys.stderr, "error: ", sentence, "bold red")
        if self.as_json:
            told = {"kind": kind, "message": sentence, "exit_code": code}
            sys.stdout.write(json_text({"error": told, "warnings": self.warnings}))
        return code

    def _styled(self, stream: TextIO, label: str, text: str, style: str) -> None:
        if stream.isatty():
            from rich.console import Console
            from rich.text import Text

            line = Text.assemble((label, style), text) if label else Text(text, style)
            Console(file=stream).print(line, soft_wrap=True)
        else:
            stream.write(f"{label}{text}\n")


def number(value: Any) -> str:
    """A number for people: six digits."""
    return f"{float(value):.6g}"


def _rich_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(*header, box=SIMPLE_HEAD, header_style="dim", pad_edge=False)
    for row in rows:
        table.add_row(*map(Text, row))
    Console().print(table)
