"""``acausal show``: what is in a model?"""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import acausal as ac
from acausal.command.arguments import Parsers, add_command, add_model, add_parameters
from acausal.command.model import networks_and_tables, parameters_of, system_of, title_of
from acausal.command.output import CommandOutput, number
from acausal.errors import shown

MOST = 40
"""Rows of a section that are shown without ``--all``."""

Row = dict[str, Any]
"""One entry of a section: values by the names of its columns."""


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "show",
        run,
        "what is in a model?",
        "Show a model: its states with their start values, inputs, parameters, networks and equations.",
        """
        acausal show oscillator.json
        acausal show vehicle:QuarterVehicle --only equations
        acausal show vehicle:QuarterVehicle --only parameters --json
        """,
    )
    add_model(parser)
    add_parameters(parser)
    parser.add_argument(
        "--only",
        nargs="+",
        choices=list(SECTIONS),
        metavar="SECTION",
        help=f"some of: {', '.join(SECTIONS)}; by default all but variables",
    )
    parser.add_argument("--all", action="store_true", help=f"show more than {MOST} rows a section")


def run(args: Namespace, out: CommandOutput) -> None:
    """Print the sections."""
    system = system_of(args)
    params = parameters_of(args, system)
    chosen = args.only or [name for name in SECTIONS if name != "variables"]
    found = {name: SECTIONS[name](system, params) for name in chosen}
    out.title(title_of(system))
    for name, rows in found.items():
        if rows or args.only:
            out.title(f"{name} ({len(rows)})")
            _print(rows, None if args.all else MOST, out)
    out.result({"model": title_of(system), **found})


def _print(rows: Sequence[Row], most: int | None, out: CommandOutput) -> None:
    texts = [[_text(value) for value in row.values()] for row in rows[:most]]
    if texts and len(rows[0]) == 1:
        for (text,) in texts:
            out.say(f"  {text}")
    elif texts:
        out.table(list(rows[0]), texts)
    if len(texts) < len(rows):
        out.say(f"  and {len(rows) - len(texts)} more: --all shows them")


def _text(value: Any) -> str:
    return number(value) if isinstance(value, float) else str(value)


def _states(system: ac.System, params: dict[str, Any]) -> list[Row]:
    start = system.initialize(params)
    return [
        {"name": name, "start": float(value), "unit": system.unit(name), "how": role}
        for name, value, role in zip(start.states, start.x, start.roles, strict=True)
    ]


def _with_units(system: ac.System, names: Iterable[str]) -> list[Row]:
    return [{"name": name, "unit": system.unit(name)} for name in names]


def _parameters(system: ac.System, params: dict[str, Any]) -> list[Row]:
    return [
        {"name": name, "value": float(params[name]), "unit": system.unit(name)}
        for name in system.layout.names
    ]


def _networks(system: ac.System, params: dict[str, Any]) -> list[Row]:
    names, _ = networks_and_tables(system, params)
    return [{"name": name, "network": shown(params[name], 100)} for name in names]


def _tables(system: ac.System, params: dict[str, Any]) -> list[Row]:
    _, names = networks_and_tables(system, params)
    return [{"name": name, "table": shown(params[name], 100)} for name in names]


def _equations(system: ac.System, params: dict[str, Any]) -> list[Row]:
    n = len(system.states)
    left = [f"der({name})" for name in system.states]
    left += [str(equation.lhs) for equation in system.equations[n:]]
    return [
        {"equation": f"{name} = {equation.rhs}"}
        for name, equation in zip(left, system.equations, strict=True)
    ]


SECTIONS: dict[str, Callable[[ac.System, dict[str, Any]], list[Row]]] = {
    "states": _states,
    "inputs": lambda system, _: _with_units(system, system.inputs),
    "parameters": _parameters,
    "networks": _networks,
    "tables": _tables,
    "discrete": lambda system, _: [{"name": name} for name in system.discrete],
    "equations": _equations,
    "variables": lambda system, _: _with_units(system, system.variables),
}
"""What can be shown, in this order."""
