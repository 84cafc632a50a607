"""``acausal check``: is a model right?"""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

import acausal as ac
from acausal.command.arguments import Parsers, add_command, add_model, add_parameters
from acausal.command.model import networks_and_tables, parameters_of, system_of, title_of
from acausal.command.output import CommandOutput


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "check",
        run,
        "is a model right?",
        "Check models: their declarations, connections, units, structure and initial values. All are checked; the exit "
        "code is that of the first that is wrong. With --json each has a document on a line of its own.",
        """
        acausal check oscillator.json
        acausal check models/*.json
        acausal check vehicle:QuarterVehicle --json
        """,
    )
    add_model(parser, several="+")
    add_parameters(parser)


def run(args: Namespace, out: CommandOutput) -> int:
    """Check each model; the exit code of the first that is wrong."""
    codes: list[int] = []
    for text in args.model:
        try:
            _check(text, args, out)
        except ac.AcausalError as error:
            named = len(args.model) == 1 or str(error).startswith((text, Path(text).name))
            codes.append(out.fail(error, "" if named else f"{text}: "))
        out.warnings.clear()
    return codes[0] if codes else 0


def _check(text: str, args: Namespace, out: CommandOutput) -> None:
    """Compile a model and find its initial values."""
    system = system_of(args, text)
    params = parameters_of(args, system)
    start = system.initialize(params)
    networks, tables = networks_and_tables(system, params)
    counts = {
        "equation": system.flat.n_equations,
        "state": len(system.states),
        "input": len(system.inputs),
        "parameter": len(system.layout.names),
        "network": len(networks),
    }
    counts |= {"table": len(tables)} if tables else {}
    events = system.events is not None
    listed = ", ".join(f"{n} {what}" if n == 1 else f"{n} {what}s" for what, n in counts.items())
    out.say(f"{title_of(system)} is right: {listed}" + ", events" * events)
    if system.unconnected:
        out.say(
            f"  nothing is connected to {', '.join(system.unconnected)}: no flow goes through them"
        )
    roles = zip(start.states, start.roles, strict=True)
    out.result(
        {
            "model": title_of(system),
            "ok": True,
            "equations": counts["equation"],
            "states": list(system.states),
            "inputs": list(system.inputs),
            "parameters": list(system.layout.names),
            "networks": networks,
            "tables": tables,
            "events": events,
            "unconnected": list(system.unconnected),
            "open_starts": [name for name, role in roles if role in ("chosen", "start")],
        }
    )
