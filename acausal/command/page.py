"""``acausal page``: a model as a page for the browser."""

from __future__ import annotations

from argparse import Namespace

import acausal as ac
from acausal.command.arguments import Parsers, add_command, add_model
from acausal.command.model import system_of, title_of
from acausal.command.output import CommandOutput


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "page",
        run,
        "write a page about a model",
        "Write a page about a model: one file, index.html, that opens without a server.",
        """
        acausal page oscillator.json out
        acausal page vehicle:QuarterVehicle out && xdg-open out/index.html
        """,
    )
    add_model(parser)
    parser.add_argument("folder", help="where index.html is written")


def run(args: Namespace, out: CommandOutput) -> None:
    """Write the page."""
    system = system_of(args)
    file = str(ac.page(system, args.folder))
    out.wrote([file])
    out.result({"model": title_of(system), "files": [file]})
