"""`main`: read the words of a command, run it, and say in one sentence what went wrong."""

from __future__ import annotations

import logging
import os
import sys
import warnings
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from typing import TextIO

import acausal as ac
from acausal.command import check, export, fit, new, page, predict, show, simulate
from acausal.command.exit_codes import BROKEN_PIPE, EXIT_CODES, USAGE, UsageError
from acausal.command.output import CommandOutput

COMMANDS = (check, show, simulate, fit, predict, export, page, new)


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command.

    Arguments:
        argv: its words, without the program's name; by default those of the process.

    Returns:
        The exit code, one of `EXIT_CODES`.
    """
    parser = _parser()
    try:
        args = parser.parse_args(argv)
    except SystemExit as end:  # help, the version, or a word that it does not know
        return int(end.code or 0)
    if not hasattr(args, "run"):
        parser.print_help(sys.stderr)
        return USAGE
    return _run(args)


def _parser() -> ArgumentParser:
    codes = "\n".join(f"  {code:>3}  {meaning}" for code, meaning in EXIT_CODES.items())
    parser = ArgumentParser(
        prog="acausal",
        description="Models of physical components: check, show, simulate, train and export them.",
        epilog=f"`acausal COMMAND --help` has the arguments and examples of a command.\n\nexit codes:\n{codes}",
        formatter_class=RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"acausal {ac.__version__}")
    parsers = parser.add_subparsers(title="commands", metavar="COMMAND")
    for command in COMMANDS:
        command.add(parsers)
    return parser


def _run(args: Namespace) -> int:
    out = CommandOutput(args.json)
    try:
        with _warnings_to(out), logging_to_stderr(args.verbose):
            code = args.run(args, out)
        sys.stdout.flush()
        return code or 0
    except (UsageError, ac.AcausalError, KeyboardInterrupt) as error:
        return out.fail(error)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE


@contextmanager
def _warnings_to(out: CommandOutput) -> Generator[None]:
    """Let warnings be sentences without the place in the library."""

    def show_warning(
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        out.warn(str(message))

    with warnings.catch_warnings():
        warnings.simplefilter("default", UserWarning)
        warnings.showwarning = show_warning
        yield


LEVELS = {0: logging.WARNING, 1: logging.INFO}
"""Levels by how often ``-v`` was given; more gives all."""


@contextmanager
def logging_to_stderr(verbose: int) -> Generator[None]:
    """Show what the logger ``acausal`` is told, while a command runs."""
    logger, handler = logging.getLogger("acausal"), logging.StreamHandler()
    handler.setFormatter(logging.Formatter("%(relativeCreated)7.0f ms  %(name)s: %(message)s"))
    before = logger.level
    logger.setLevel(LEVELS.get(verbose, logging.DEBUG))
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.setLevel(before)
