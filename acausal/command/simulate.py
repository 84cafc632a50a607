"""``acausal simulate``: run a model and write what it does."""

from __future__ import annotations

import io
import sys
from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING, Any

import acausal as ac
from acausal.command.arguments import (
    Parsers,
    add_by_name,
    add_command,
    add_model,
    add_parameters,
    add_reading,
    need_unread,
    number_by_name,
    read_record,
)
from acausal.command.exit_codes import UsageError
from acausal.command.model import parameters_of, system_of, title_of
from acausal.command.output import CommandOutput, number
from acausal.errors import known_name
from acausal.files import csv_text, need_path, write_files

if TYPE_CHECKING:
    import numpy as np

MOST_POINTS = 10_000_000
"""Points that may be saved; more are a slip, and fill the memory."""


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "simulate",
        run,
        "run a model; write CSV and plots",
        "Simulate a model. The result is a table of what its variables did; --out writes all values as CSV.",
        """
        acausal simulate oscillator.json --stop 10 --out run.csv
        acausal simulate oscillator.json --stop 10 --names mass.s 'spring.*' --plot run.png
        acausal simulate vehicle:QuarterVehicle --inputs road.csv --dt 0.001 --params trained.safetensors
        acausal simulate oscillator.json --stop 10 --out - | head
        """,
    )
    add_model(parser)
    add_parameters(parser)
    _add_times(parser)
    words = "a constant input, such as road.v_ref=0.1"
    add_by_name(parser, "--input", text=words, read=number_by_name)
    parser.add_argument("--inputs", metavar="FILE", help="a file of data with inputs over time")
    add_by_name(parser, "--x0", text="the initial value of a state", read=number_by_name)
    results = parser.add_argument_group("results")
    results.add_argument(
        "--names",
        nargs="+",
        metavar="NAME",
        help="variables, or patterns: 'spring.*' those of spring, '**.v' all velocities; by default states and inputs",
    )
    results.add_argument(
        "--out", metavar="FILE", help="write the variables as CSV; - to the output"
    )
    results.add_argument("--plot", metavar="FILE", help="draw them: .png, .svg or .pdf")
    add_reading(parser)


def _add_times(parser: ArgumentParser) -> None:
    times = parser.add_argument_group("times and steps")
    times.add_argument("--start", type=float, metavar="S", help="start in seconds (0)")
    times.add_argument(
        "--stop", type=float, metavar="S", help="end in seconds; by default that of file or inputs"
    )
    times.add_argument(
        "--dt", type=float, metavar="S", help="fixed step; adaptive steps without it"
    )
    times.add_argument("--points", type=int, metavar="N", help="save so many equal points")
    times.add_argument("--solver", default="auto", help="auto, bdf, tsit5, heun, euler, ...")
    times.add_argument("--rtol", type=float, default=1e-6, help="relative tolerance (1e-6)")
    times.add_argument(
        "--atol", type=float, help="absolute tolerance (1e-8; finer for states that stay small)"
    )


def run(args: Namespace, out: CommandOutput) -> None:
    """Simulate, print a summary, and write files."""
    if args.out == "-" and args.json:
        raise UsageError("--out - and --json both write to the standard output; give --out a file.")
    need_unread(args.out, args, "file by --out")
    need_unread(args.plot, args, "file by --plot")
    system = system_of(args)
    record = None if args.inputs is None else read_record(args.inputs, args)
    names = _names(args.names, system)
    start, stop = _span(args, system, record)
    solution = ac.simulate(
        system,
        (start, stop),
        dt=args.dt,
        saveat=_points(args.points, start, stop),
        inputs=_inputs(dict(args.input), record, system),
        params=parameters_of(args, system),
        x0=dict(args.x0) or None,
        solver=args.solver,
        rtol=args.rtol,
        atol=args.atol,
    )
    files = _write(args, solution, names)
    columns = solution.to_dict(names)
    if args.out != "-":
        _summary(out, title_of(system), solution, columns, files)
    time = columns.pop("time").tolist()
    out.result(
        {
            "model": title_of(system),
            "time": time,
            "variables": {
                n: {"unit": system.unit(n), "values": v.tolist()} for n, v in columns.items()
            },
            "events": [{"time": e.t, "condition": e.condition} for e in solution.events],
            "files": files,
        }
    )


def _span(args: Namespace, system: ac.System, record: ac.Data | None) -> tuple[float, float]:
    """Start and end: as given, as in the model's file, or as the inputs reach."""
    document: dict[str, Any] = getattr(system.model, "document", {})
    given = args.start, args.stop
    kept = document.get("start_time"), document.get("stop_time")
    reach = (0.0, None) if record is None else (float(record.time[0]), float(record.time[-1]))
    start, stop = (
        next((v for v in values if v is not None), None)
        for values in zip(given, kept, reach, strict=True)
    )
    if stop is None:
        raise ac.DataError("The simulation has no end: give --stop in seconds.")
    return float(start or 0.0), float(stop)


def _points(points: int | None, start: float, stop: float) -> np.ndarray | None:
    if points is None:
        return None
    if not 2 <= points <= MOST_POINTS:
        raise ac.DataError(f"--points {points} is not from 2 to {MOST_POINTS:_}.")
    import numpy as np

    return np.linspace(start, stop, points)


def _inputs(
    constants: dict[str, float], record: ac.Data | None, system: ac.System
) -> ac.Data | dict[str, Any]:
    """Inputs over time from a record, and constants in the places of some of them."""
    if record is None or not constants:
        return constants if record is None else record
    known = [n for n in record.names if n in system.inputs and n not in constants]
    measured = record.select(known).for_system(system)
    return {**{n: measured.samples(n) for n in known}, **constants}


def _names(patterns: list[str] | None, system: ac.System) -> list[str]:
    """The variables that names or patterns stand for; an unknown one is refused before anything is computed."""
    if patterns is None:
        return [*system.states, *system.inputs]
    from acausal.modeling import names_matching  # so that help imports no sympy

    known = tuple(dict.fromkeys((*system.variables, *system.inputs)))
    names = names_matching(patterns, known)
    for name in names:
        known_name(name, known, "The model has no variable")
    return list(names)


def _write(args: Namespace, solution: ac.Solution, names: list[str]) -> list[str]:
    """Write the files that are asked for; their paths."""
    files: list[str] = []
    if args.out == "-":
        _print_csv(solution, names)
    elif args.out is not None:
        solution.to_csv(args.out, names)
        files.append(args.out)
    if args.plot is not None:
        _plot(solution, names, args.plot)
        files.append(args.plot)
    return files


def _print_csv(solution: ac.Solution, names: list[str]) -> None:
    columns = solution.to_dict(names).items()
    text = csv_text({f"{n} [{solution.unit(n)}]": column for n, column in columns})
    sys.stdout.write(text.replace("\r\n", "\n"))


def _summary(
    out: CommandOutput,
    title: str,
    solution: ac.Solution,
    columns: dict[str, np.ndarray],
    files: list[str],
) -> None:
    """A line for each variable: where it began and ended, and how far it went."""
    time = columns["time"]
    happened = f", {len(solution.events)} events" if solution.events else ""
    out.title(f"{title}: {len(time)} points from {time[0]:g} to {time[-1]:g} s{happened}")
    rows = [
        (n, solution.system.unit(n), *map(number, (v[0], v[-1], v.min(), v.max())))
        for n, v in columns.items()
        if n != "time"
    ]
    if rows:
        out.table(("name", "unit", "start", "end", "lowest", "highest"), rows)
    out.wrote(files)


def _plot(solution: ac.Solution, names: list[str], path: str) -> None:
    file = need_path(path, "--plot")
    figure = solution.plot(*names)
    picture = io.BytesIO()
    try:
        figure.savefig(picture, format=file.suffix[1:] or None)
    except ValueError as error:  # an ending that matplotlib does not know
        raise ac.DataError(f"'{path}' cannot be written: {error}.") from None
    write_files({file: picture.getvalue()})
