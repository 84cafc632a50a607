"""``acausal fit``: train a model on measured data."""

from __future__ import annotations

import json
import math
import tomllib
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

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
    read_records,
    value_by_name,
)
from acausal.command.model import parameters_of, system_of, title_of
from acausal.command.output import CommandOutput, number
from acausal.errors import known_name, listing, reason, shown


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "fit",
        run,
        "train a model on measured data",
        "Train the networks and parameters of a model on measured data. The trained parameters go into a file, "
        "which the other commands take as --params.",
        """
        acausal fit oscillator.json run.csv --targets mass.s -o modifiers='["spring.c"]' -o strategy=gauss_newton
        acausal fit vehicle:QuarterVehicle runs/*.csv --targets body.a wheel.a --options options.toml --report out

        options.toml has the keywords of ac.fit, for example:
          strategy = ["equation_error", "whole_record"]
          validation = 0.2
          modifiers = { "tyre.c" = 0.3, "body.m" = { Bounded = { low = 300.0, high = 400.0 } } }
        """,
    )
    add_model(parser)
    parser.add_argument("data", nargs="+", help="files of data: CSV, Parquet, MATLAB or MDF")
    add_training(parser)
    add_parameters(parser)
    results = parser.add_argument_group("results")
    results.add_argument(
        "--out", metavar="FILE", help="the trained parameters; by default MODEL-trained.safetensors"
    )
    results.add_argument("--report", metavar="FOLDER", help="write a page about the training")
    add_reading(parser)


def add_training(parser: ArgumentParser) -> None:
    """How a model is trained: targets, and keywords of `acausal.fit`."""
    parser.add_argument(
        "--targets", nargs="+", required=True, metavar="NAME", help="the variables to fit"
    )
    parser.add_argument("--options", metavar="FILE", help="keywords of ac.fit, as JSON or TOML")
    words = "one of them, such as epochs=300 or strategy=whole_record"
    add_by_name(parser, "-o", "--option", text=words, read=value_by_name)
    parser.add_argument("--seed", type=int, default=0, help="of networks and sequences (0)")


def keywords_of(args: Namespace) -> dict[str, Any]:
    """The keywords of `acausal.fit` that a user gives."""
    given = {} if args.options is None else read_options(args.options)
    return as_keywords({**given, **dict(args.option)})


def run(args: Namespace, out: CommandOutput) -> None:
    """Train, print what has changed, and write the parameters."""
    keywords = keywords_of(args)
    system = system_of(args)
    title = title_of(system)
    path = Path(file_name(title, "-trained.safetensors") if args.out is None else args.out)
    need_unread(path, args, "file by --out")
    data = read_records(args.data, args)
    start = parameters_of(args, system) if args.params is not None or args.set else None
    keywords["progress"] = not args.json
    done = ac.fit(system, data, args.targets, params=start, seed=args.seed, **keywords)
    ac.save_params(done.params, path)
    files = [str(path)]
    if args.report is not None:
        files.append(str(done.report(args.report, title)))
    _show(done, title, files, out)
    out.result({"model": title, **_facts(done), "files": files})


def _show(done: ac.Fit, title: str, files: list[str], out: CommandOutput) -> None:
    end = ", interrupted" if done.interrupted else ""
    trained = ", ".join((*done.seen, *done.modifiers))
    out.title(
        f"{title}: {trained} trained in {done.seconds:.3g} s, {done.history.epochs} updates{end}"
    )
    rows = [("loss over all data", number(done.loss_before), number(done.loss))]
    if done.validation_loss is not None:
        before = done.history.validation_loss[0, 1]
        rows.append(("loss over what is held out", number(before), number(done.validation_loss)))
    before = done.problem.assemble(done.problem.start())
    after = done.problem.assemble(done.trained)
    rows += [(n, number(before[n]), number(after[n])) for n in done.modifiers]
    out.table(("", "before", "after"), rows)
    rows = [(n, number(error), done.system.unit(n)) for n, error in done.rms.items()]
    out.table(("target", "rms error", "unit"), rows)
    for sentence in () if done.verdict is None else done.verdict.sentences:
        out.say(sentence)
    out.wrote(files)


def _facts(done: ac.Fit) -> dict[str, Any]:
    """The result for programs."""
    params = done.problem.assemble(done.trained)
    return {
        "targets": list(done.rms),
        "networks": list(done.seen),
        "parameters": {n: float(params[n]) for n in done.modifiers},
        "changes": done.modifiers,
        "loss_before": done.loss_before,
        "loss": done.loss,
        "validation_loss": done.validation_loss,
        "rms": {n: None if math.isnan(error) else error for n, error in done.rms.items()},
        "records": list(done.records),
        "best_epoch": done.best_epoch,
        "epochs": done.history.epochs,
        "good": None if done.verdict is None else done.verdict.good,
        "verdict": [] if done.verdict is None else list(done.verdict.sentences),
        "seconds": done.seconds,
        "interrupted": done.interrupted,
    }


NAMED = (
    *("Bounded", "Shift", "Delay", "Lag"),
    *("Huber", "Student", "Likelihood"),
    *("DampingRatio", "FrequencyRange", "SmallCorrection", "Stability", "ZeroCrossing"),
)
"""Classes of `acausal` that a file may name: ``{"Bounded": {"low": 1.0, "high": 3.0}}``."""

NOT_IN_FILES = ("optimizer", "observers", "devices", "prior", "progress")
"""Options that only Python can give, or that do not matter here."""


def read_options(path: str) -> dict[str, Any]:
    """The options of a JSON or TOML file.

    Raises:
        ac.DataError: for a file that cannot be read, or that is neither.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
        options = tomllib.loads(text) if Path(path).suffix == ".toml" else json.loads(text)
    except OSError as error:
        raise ac.DataError(f"'{path}' cannot be read: {reason(error)}.") from None
    except (ValueError, RecursionError) as error:  # neither JSON, TOML nor UTF-8
        raise ac.DataError(f"'{path}' cannot be read: {error}.") from None
    if not isinstance(options, dict):
        raise ac.DataError(f"'{path}' holds {shown(options)}; options are an object by name.")
    return cast(dict[str, Any], options)


def as_keywords(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options as `acausal.fit` takes them.

    Raises:
        ac.TrainingError: for an unknown option, or a value that cannot be given as text.
    """
    from acausal.training import FitOptions

    known = [n for n in FitOptions.__dataclass_fields__ if n not in NOT_IN_FILES]
    for name in options:
        if name in NOT_IN_FILES:
            raise ac.TrainingError(f"The option '{name}' can be given in Python only.")
        known_name(name, known, "There is no option", ac.TrainingError)
    keywords = {name: _value(value, name) for name, value in options.items()}
    FitOptions.of("fit", keywords)
    return keywords


def _value(value: Any, where: str) -> Any:
    """The same with the things that `NAMED` classes make."""
    if isinstance(value, list):
        return [_value(inner, where) for inner in cast(list[Any], value)]
    if not isinstance(value, dict):
        return value
    given = cast(dict[str, Any], value)
    name = next(iter(given), "")
    if len(given) == 1 and name[:1].isupper() and isinstance(given[name], dict):
        return _made(name, given[name], where)
    return {key: _value(inner, f"{where}.{key}") for key, inner in given.items()}


def _made(name: str, arguments: dict[str, Any], where: str) -> Any:
    if name not in NAMED:
        raise ac.TrainingError(f"{where}: there is no '{name}'; known are {listing(NAMED)}.")
    try:
        return getattr(ac, name)(**{n: _value(v, where) for n, v in arguments.items()})
    except ac.AcausalError:
        raise
    except (TypeError, ValueError) as error:  # an argument that it does not have
        raise ac.TrainingError(f"{where}: {name} cannot be made: {error}.") from None
