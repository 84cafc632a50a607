"""Arguments that several commands share, how their texts are read, and the records from files that they name."""

from __future__ import annotations

import json
import math
import re
from argparse import (
    ArgumentParser,
    ArgumentTypeError,
    Namespace,
    RawDescriptionHelpFormatter,
    _ActionsContainer,  # pyright: ignore[reportPrivateUsage] (argparse has no public names for these)
    _SubParsersAction,  # pyright: ignore[reportPrivateUsage]
)
from collections.abc import Callable
from functools import partial
from glob import iglob
from pathlib import Path
from textwrap import dedent, fill
from typing import Any, TypeAlias

import acausal as ac
from acausal.command.output import CommandOutput
from acausal.errors import shown

Parsers: TypeAlias = "_SubParsersAction[ArgumentParser]"
Run: TypeAlias = Callable[[Namespace, CommandOutput], int | None]
"""What runs a command; it returns an exit code, or None if all is well."""

MODEL = "a JSON file, or module:Class, or file.py:Class; a function that makes a model will do, too"


def add_command(
    parsers: Parsers, name: str, run: Run, short: str, summary: str, examples: str
) -> ArgumentParser:
    """A command with a short and a longer summary, examples, and the arguments that all commands have."""
    parser = parsers.add_parser(
        name,
        help=short,
        description=fill(summary, 78),
        epilog=f"examples:\n{dedent(examples).strip()}".replace("\n", "\n  "),
        formatter_class=RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.set_defaults(run=run)
    parser.add_argument("--json", action="store_true", help="print the result as one JSON document")
    parser.add_argument(
        "-v",
        "--verbose",
        action="count",
        default=0,
        help="tell what is done; twice for more",
    )
    return parser


def add_by_name(
    parser: _ActionsContainer,
    *flags: str,
    text: str,
    read: Callable[[str], tuple[str, Any]],
    metavar: str = "NAME=VALUE",
) -> None:
    """An argument that gives a value to a name and can be repeated, with its help and what reads it."""
    parser.add_argument(
        *flags,
        action="append",
        default=[],
        type=read,
        metavar=metavar,
        help=f"{text}; can be repeated",
    )


def add_model(parser: ArgumentParser, several: str | None = None) -> None:
    """The model (or ``several``), and libraries that its file needs."""
    parser.add_argument("model", help=MODEL, nargs=several)
    parser.add_argument(
        "--library",
        action="append",
        default=[],
        metavar="MODULE",
        help="a library of components that the model's file names; can be repeated",
    )
    words = "parts of the model's file may run native code, FMUs; only for files from people whom you trust"
    parser.add_argument("--allow-native", action="store_true", help=words)
    words = "another part in the place of one, such as suspension.damper=neural.Resistance"
    read = partial(text_by_name, form="PART=CLASS")
    add_by_name(parser, "--replace", text=words, read=read, metavar="PART=CLASS")


READ = ("model", "data", "training", "inputs", "params", "options")
"""Arguments that name files which a command reads."""


def need_unread(path: str | Path | None, args: Namespace, remedy: str) -> None:
    """Refuse to write to a file that the command reads.

    Raises:
        DataError: with the argument to change.
    """
    if path is None or not Path(path).is_file():
        return
    given = [vars(args).get(name) or [] for name in READ]
    for text in (t for g in given for t in ([g] if isinstance(g, str) else g)):
        found = iglob(text)  # noqa: PTH207 (a pattern may be absolute)
        for file in map(Path, (text, text.rpartition(":")[0], *found)):
            if file.is_file() and file.samefile(path):
                raise ac.DataError(f"'{path}' is read by this command; give another {remedy}.")


def file_name(text: str, ending: str) -> str:
    """The name of a file in one folder, whatever a model or record is called."""
    return re.sub(r"[^\w.-]", "_", text) + ending


def add_parameters(parser: ArgumentParser) -> None:
    """Values of parameters, from a file and one by one."""
    parser.add_argument(
        "--params",
        metavar="FILE",
        help="parameters and networks from a file, as `acausal fit` and ac.save_params write it",
    )
    words = "the value of a parameter, such as mass.m=2.5"
    add_by_name(parser, "--set", text=words, read=number_by_name)


def text_by_name(text: str, form: str = "NAME=VALUE") -> tuple[str, str]:
    """``damper=neural.Resistance`` as a name and a text.

    Raises:
        ArgumentTypeError: for a text without a name, an equals sign, or what follows it.
    """
    name, _, value = text.partition("=")
    if not name or not value:
        raise ArgumentTypeError(f"'{text}' is not {form}")
    return name, value


def number_by_name(text: str) -> tuple[str, float]:
    """``mass.m=2.5`` as a name and a number.

    Raises:
        ArgumentTypeError: for anything else.
    """
    name, value = text_by_name(text)
    try:
        number = float(value)
        if math.isinf(number) and "inf" not in value.lower():  # too large
            raise ValueError
        return name, number
    except ValueError:
        raise ArgumentTypeError(f"'{text}' is not NAME=NUMBER, such as mass.m=2.5") from None


def value_by_name(text: str) -> tuple[str, Any]:
    """``epochs=300`` as a name and a value: JSON, or else the text itself.

    Raises:
        ArgumentTypeError: for a text without a name and an equals sign.
    """
    name, value = text_by_name(text)
    try:
        return name, json.loads(value)
    except json.JSONDecodeError:
        return name, value


def add_reading(parser: ArgumentParser) -> None:
    """How files of data are read."""
    group = parser.add_argument_group("how data are read")
    group.add_argument("--time", metavar="COLUMN", help="the column with the times ('time')")
    group.add_argument(
        "--group", metavar="COLUMN", help="the column that says which run a row belongs to"
    )
    group.add_argument("--columns", nargs="+", metavar="NAME", help="read these columns alone")
    words = "the model's variable that a column is, such as 'ch 7=mass.a'"
    read = partial(text_by_name, form="COLUMN=NAME")
    add_by_name(group, "--rename", text=words, read=read, metavar="COLUMN=NAME")
    group.add_argument(
        "--missing",
        choices=("refuse", "nan"),
        default="refuse",
        help="whether an empty cell is a mistake (refuse) or a missing sample (nan)",
    )


def read_records(paths: list[str], args: Namespace) -> ac.Data | dict[str, ac.Data]:
    """One record, or several by the names of their files.

    Raises:
        ac.DataError: for a file that cannot be read, or whose ending is not known.
    """
    options: dict[str, Any] = {"missing": args.missing}
    options |= {"columns": args.columns} if args.columns else {}
    options |= {"group": args.group} if args.group else {}
    options |= {"rename": dict(args.rename)} if args.rename else {}
    if args.time is not None:
        options["time"] = args.time
    return ac.Data.from_files(paths[0] if len(paths) == 1 else paths, **options)


def read_record(path: str, args: Namespace) -> ac.Data:
    """The only record of a file.

    Raises:
        ac.DataError: as `read_records`, and for a pattern.
    """
    found = read_records([path], args)
    if isinstance(found, dict):
        raise ac.DataError(f"{shown(path)} are several files; give one.")
    return found
