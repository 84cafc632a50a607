"""A session in a terminal, as pages show it: what is typed after ``$``, and what is printed."""

from __future__ import annotations

import io
import shlex
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

from acausal.command import main


@dataclass(frozen=True)
class Typed:
    """A line that is typed, the text that it writes into a file (``<<END``), and what is shown below it."""

    words: tuple[str, ...]
    document: str
    shown: str


def typed(text: str) -> Iterator[Typed]:
    """The commands of a block."""
    lines = iter(text.splitlines())
    command: list[str] = []
    document: list[str] = []
    shown: list[str] = []
    for line in lines:
        if not line.startswith("$ "):
            shown.append(line)
            continue
        if command:
            yield Typed(tuple(command), "\n".join(document), "\n".join(shown))
        document, shown = [], []
        while line.endswith("\\"):
            line = line[:-1] + next(lines)
        command = shlex.split(line[2:])
        if command[-1].startswith("<<"):
            document = list(iter(lines.__next__, command.pop().removeprefix("<<")))
    if command:
        yield Typed(tuple(command), "\n".join(document), "\n".join(shown))


class Console:
    """Runs what is typed in the present folder: ``acausal``, ``cat`` and ``echo $?``."""

    code = 0

    def run(self, one: Typed) -> str:
        """What is printed, errors included."""
        with redirect_stdout(io.StringIO()) as printed, redirect_stderr(printed):
            match one.words:
                case ("acausal", *words):
                    self.code = main(words)
                case ("cat", ">", file):
                    Path(file).write_text(one.document + "\n", encoding="utf-8")
                case ("cat", file):
                    printed.write(Path(file).read_text(encoding="utf-8"))
                case ("echo", "$?"):
                    printed.write(f"{self.code}\n")
                case _:
                    raise ValueError(f"a page types {shlex.join(one.words)}, which no test runs")
        return printed.getvalue()
