"""``acausal predict``: predict records with a trained model."""

from __future__ import annotations

import math
from argparse import Namespace
from pathlib import Path
from typing import Any

import acausal as ac
from acausal.command.arguments import (
    Parsers,
    add_by_name,
    add_command,
    add_model,
    add_parameters,
    add_reading,
    file_name,
    need_unread,
    number_by_name,
    read_records,
)
from acausal.command.fit import add_training, keywords_of
from acausal.command.model import parameters_of, system_of, title_of
from acausal.command.output import CommandOutput, number
from acausal.errors import listing


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "predict",
        run,
        "predict records with a trained model",
        "Predict records with a trained model: errors, bands and what leaves the training's range. The files of the "
        "training tell how certain the model is: it is taken up at the given parameters, for one more update.",
        """
        acausal predict oscillator.json new.csv --training run.csv --targets mass.s \\
          -o modifiers='["spring.c"]' --params Oscillator-trained.safetensors
        acausal predict vehicle:QuarterVehicle new/*.csv --training runs/*.csv --targets body.a \\
          --options options.toml --params trained.safetensors --report out --out predicted
        """,
    )
    add_model(parser)
    parser.add_argument("data", nargs="+", help="files of data to predict; targets may be missing")
    parser.add_argument(
        "--training", nargs="+", required=True, metavar="FILE", help="files that the model was trained on"
    )  # fmt: skip
    add_training(parser)
    add_parameters(parser)
    words = "the initial value of a state, by default found from the targets"
    add_by_name(parser, "--x0", text=words, read=number_by_name)
    results = parser.add_argument_group("results")
    results.add_argument("--out", metavar="FOLDER", help="write every record's bands as CSV")
    results.add_argument("--report", metavar="FOLDER", help="write a page about the predictions")
    add_reading(parser)


def run(args: Namespace, out: CommandOutput) -> None:
    """Predict, print the errors, and write files."""
    system = system_of(args)
    data, training = read_records(args.data, args), read_records(args.training, args)
    into = _files(args, list(data) if isinstance(data, dict) else ["record"])
    keywords: dict[str, Any] = {
        **keywords_of(args),
        "strategy": "whole_record",
        "epochs": 1,
        "progress": False,
    }
    params = parameters_of(args, system)
    known = ac.fit(system, training, args.targets, params=params, seed=args.seed, **keywords)
    found = known.predict(data, x0=dict(args.x0) or "auto")
    title, files = title_of(system), list[str]()
    files += [str(found[name].to_csv(file)) for name, file in into.items()]
    if args.report is not None:
        files.append(str(found.report(args.report, title)))
    out.title(f"{title}: {listing(found)} predicted")
    rows = [
        (name, n, number(p.rms[n]), p.units[n], number(p.normalized[n]), number(p.inside[n]))
        for name, p in found.items()
        for n in p.targets
    ]
    out.table(("record", "target", "rms error", "unit", "normalized", "within band"), rows)
    for p in found.values():
        for remark in p.remarks:
            out.warn(remark)
    out.wrote(files)
    out.result(
        {
            "model": title,
            "records": {
                name: {n: None if math.isnan(e) else e for n, e in p.rms.items()}
                for name, p in found.items()
            },
            "outside": {name: p.outside for name, p in found.items() if p.outside},
            "files": files,
        }
    )


def _files(args: Namespace, names: list[str]) -> dict[str, Path]:
    """By record, the file of its bands; none if they are not asked for.

    Raises:
        DataError: if two of them are one, or one is read.
    """
    if args.out is None:
        return {}
    files = {name: Path(args.out, file_name(name, ".csv")) for name in names}
    if len(set(files.values())) < len(files):
        raise ac.DataError(
            f"--out: two of the records {listing(names)} have the same name as files; predict them in turn."
        )
    for file in files.values():
        need_unread(file, args, "folder by --out")
    return files
