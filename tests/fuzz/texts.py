"""Wrong Modelica text: classes after the chapters of the specification, with some tokens changed by chance."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import acausal as ac

from .outcome import Mutant

FOLDER = Path(__file__).parents[1] / "modelica"
TEXT = (FOLDER / "Chapters.mo").read_text()
PACKAGES = dict(re.findall(r"^(  package (\w+).*?^  end \2;\n)", TEXT, re.MULTILINE | re.DOTALL))
SHOWN = re.findall(r'^  "(\w+\.\w+)"', (FOLDER / "Chapters.json").read_text(), re.MULTILINE)
TOKEN = re.compile(r'"[^"]*"|[A-Za-z_]\w*|[\d.]+(?:e-?\d+)?|<=|>=|<>|:=|==|\.[*/^+-]|\S')
PIECES = (
    "",
    "(",
    ")",
    "{",
    "]",
    ";",
    ",",
    "=",
    ":=",
    ":",
    "end",
    "if",
    "then",
    "when",
    "loop",
    '"text"',
    "'",
    "/*",
)
MARKS = frozenset('(){}[];,.:"' + "'")
LIKE = {
    "word": (
        *("time", "true", "x", "n", "k", "y", "nothing", "Modelica", "Real", "Integer", "Boolean", "String", "Clock"),
        *("der", "pre", "edge", "sample", "sum", "size", "fill", "max", "delay", "cross", "previous", "reinit"),
        *("parameter", "constant", "discrete", "input", "output", "flow", "final", "inner", "outer", "replaceable"),
        *("model", "block", "record", "connector", "function", "package", "extends", "equation", "algorithm"),
    ),
    "number": ("0", "-1", "1.5", "1e308", "1e-300", "99999999999", "1000000", "{1, 2}", "time", "x", "true", '"text"'),
    "sign": ("+", "-", "*", "/", "^", ".*", "<", "==", "and", "or", "=", ":"),
}  # fmt: skip
"""What stands for a token, by its kind; other tokens of the text do, too."""


def kind_of(token: str) -> str:
    return (
        "word"
        if token[0].isalpha() or token[0] == "_"
        else "number"
        if token[0].isdigit()
        else "sign"
    )


def instead(rng: random.Random, old: str, others: list[str]) -> str:
    """A text for a token: mostly one of its kind."""
    alike = [o for o in others if kind_of(o) == kind_of(old)]
    return rng.choice(
        (rng.choice(alike), rng.choice(alike), rng.choice(LIKE[kind_of(old)]), rng.choice(LIKE[kind_of(old)]),
         rng.choice(PIECES))
    )  # fmt: skip


def mutant(seed: int, folder: Path) -> Mutant:
    """The wrong text of a seed: tokens of one class replaced, a line removed or doubled."""
    rng = random.Random(f"text {seed}")
    shown = SHOWN[seed % len(SHOWN)]
    package = next(text for text, name in PACKAGES.items() if name == shown.partition(".")[0])
    lines = package.split("\n")
    begin = next(
        i for i, s in enumerate(lines) if re.search(rf"\bmodel {shown.partition('.')[2]}\b", s)
    )
    end = next(
        i
        for i, s in enumerate(lines)
        if f"end {shown.partition('.')[2]};" in s or (i == begin and s.endswith(";"))
    )
    near = len("\n".join(lines[:begin])), len("\n".join(lines[: max(end, begin) + 1]))
    spans = [
        m.span()
        for m in TOKEN.finditer(package)
        if near[0] <= m.start() < near[1] and m[0] not in MARKS
    ]
    others = [package[a:b] for a, b in spans]
    changed, details = package, list[str]()
    for a, b in sorted(rng.sample(spans, min(len(spans), rng.choice((1, 1, 2)))), reverse=True):
        new = instead(rng, package[a:b], others)
        changed = f"{changed[:a]}{new}{changed[b:]}"
        details.append(f"{package[a:b]} -> {new} in '{package[max(0, a - 30) : b + 30]!r}'")
    if rng.random() < 0.2:
        line = rng.choice([s for s in changed.split("\n") if s.endswith(";") and "end " not in s])
        changed = changed.replace(line, rng.choice(("", f"{line}\n{line}")), 1)
        details.append(f"'{line.strip()}' removed or doubled")

    def make() -> Any:
        path = folder / "text.mo"
        path.write_text(TEXT.replace(package, changed), encoding="utf-8")
        return ac.compile(ac.load(path, f"Chapters.{shown}"), check_units=False)

    return Mutant(seed, "text", shown, "; ".join(details), ("",), False, make)
