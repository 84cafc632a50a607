"""A Modelica library's models, one by one: how many are loaded, compiled and simulated, and why others are not.

    python -m benchmarks.library Modelica --examples --only "Modelica[.](Blocks|Electrical)"

A model is simulated for the time of its annotation ``experiment``, else for a second; its inputs are 1.
"""

from __future__ import annotations

import argparse
import json
import re
import warnings
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import suppress
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from acausal.modelica import parse, read_source
from acausal.modelica.syntax import ClassDefinition, Extends

COLUMNS = ("simulated", "compiled", "refused", "late", "broken")
"""Simulated to the end; compiled, and the simulation fails with a sentence; refused before; slow; another error."""


def names(folder: Path, examples: bool) -> Iterator[str]:
    """The full names of models that are not partial; of examples only those that have an experiment."""

    def within(definition: ClassDefinition, above: str) -> Iterator[str]:
        name = f"{above}.{definition.name}" if above else definition.name
        bases = [e.base.text for e in definition.elements if isinstance(e, Extends)]
        example = definition.experiment or any(b.endswith("Icons.Example") for b in bases)
        model = definition.kind in ("model", "block", "class") and not definition.partial
        if model and (example or not examples):
            yield name
        for element in definition.elements:
            if isinstance(element, ClassDefinition):
                yield from within(element, name)

    for file in sorted(folder.rglob("*.mo")) if folder.is_dir() else [folder]:
        package, definitions = parse(read_source(file))
        for definition in definitions:
            yield from within(definition, package)


def outcome(folder: Path, name: str, path: list[Path]) -> tuple[str, str]:
    """A column of the table for a model, and the error."""
    import acausal as ac

    done = "refused"
    try:
        model: Any = ac.load(folder, name, path=path)
        system = ac.compile(model)
        done = "compiled"
        stated = dict(model.document)
        times = stated.get("start_time", 0.0), stated.get("stop_time", 1.0)
        ac.simulate(system, times, inputs=dict.fromkeys(system.inputs, 1.0))
    except ac.AcausalError as error:
        return done, str(error)
    except Exception as error:  # what has no sentence is counted, too
        return "broken", f"{type(error).__name__}: {error}"
    return "simulated", ""


def serve(connection: Any, folder: Path, path: list[Path]) -> None:
    """Answer for each model that is asked for."""
    warnings.simplefilter("ignore")
    with suppress(EOFError):
        while True:
            connection.send(outcome(folder, connection.recv(), path))


def outcomes(
    folder: Path, todo: list[str], path: list[Path], limit: float
) -> Iterator[tuple[str, str, str]]:
    """Name, column and error of each model; a process that is late gives way to a new one."""
    context = get_context("spawn")
    worker: Any = None
    here: Any = None
    for name in todo:
        if worker is None:
            here, there = context.Pipe()
            worker = context.Process(target=serve, args=(there, folder, path), daemon=True)
            worker.start()
            there.close()
        column, error = "late", f"more than {limit:g} s"
        try:
            here.send(name)
            answered = here.poll(limit)
            if answered:
                column, error = here.recv()
        except (EOFError, OSError):
            answered, column, error = False, "broken", "the process has ended"
        if not answered:
            worker.kill()
            worker.join()
            worker = None
        yield name, column, error


def main() -> None:
    """Try all models, print a table, and a line of JSON at the end."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path, help="of the package, or a file")
    parser.add_argument("--path", type=Path, action="append", default=[], help="further packages")
    parser.add_argument("--examples", action="store_true", help="only models with an experiment")
    parser.add_argument("--only", default="", help="a regular expression for the names")
    parser.add_argument("--limit", type=float, default=120, help="seconds for each model")
    options = parser.parse_args()
    folder = options.folder
    todo = [n for n in names(folder, options.examples) if re.search(options.only, n)]
    count: defaultdict[str, Counter[str]] = defaultdict(Counter)
    errors: dict[str, list[str]] = {}
    for name, column, error in outcomes(folder, todo, options.path, options.limit):
        package = ".".join(name.split(".")[:3][: name.count(".")])
        count[package][column] += 1
        count["all"][column] += 1
        if column != "simulated":
            errors[name] = [column, error]
    table = Table("models of", *COLUMNS)
    for package in sorted(count, key=lambda p: (p == "all", p)):
        table.add_row(package, *(str(count[package][c]) for c in COLUMNS))
    Console().print(table)
    print(json.dumps({"all": count["all"], "errors": errors}))


if __name__ == "__main__":
    main()
