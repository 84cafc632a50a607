"""Records from files: measured data and inputs."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from functools import partial
from typing import Any

import acausal as ac
from acausal.command.arguments import add_by_name, text_by_name
from acausal.errors import shown


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
