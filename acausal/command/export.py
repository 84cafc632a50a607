"""``acausal export``: a model for other tools."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import acausal as ac
from acausal.command.arguments import (
    Parsers,
    add_command,
    add_model,
    add_parameters,
    need_unread,
)
from acausal.command.exit_codes import UsageError
from acausal.command.model import parameters_of, system_of, title_of
from acausal.command.output import CommandOutput
from acausal.errors import listing
from acausal.files import need_path


@dataclass(frozen=True)
class ExportForm:
    """A form of export.

    Attributes:
        endings: of files. options: of the command that go with it.
    """

    endings: tuple[str, ...]
    options: tuple[str, ...]


def add(parsers: Parsers) -> None:
    """The command's arguments."""
    parser = add_command(
        parsers,
        "export",
        run,
        "write FMU, C, ONNX, StableHLO or Modelica",
        "Export a model, or a network in it: as FMU, C, ONNX, StableHLO or Modelica, by the ending of the file.",
        """
        acausal export oscillator.json oscillator.fmu
        acausal export vehicle:QuarterVehicle out/vehicle.c --params trained.safetensors
        acausal export vehicle:QuarterVehicle spring.onnx --network spring_nn.net --batch N
        acausal export oscillator.json out --form c
        """,
    )
    add_model(parser)
    endings = "; ".join(f"{name}: {' '.join(f.endings)}" for name, f in FORMS.items())
    parser.add_argument("path", help=f"where it is written ({endings})")
    parser.add_argument("--form", choices=list(FORMS), help="by default that of the path's ending")
    add_parameters(parser)
    own = parser.add_argument_group("options of some forms")
    for option, arguments in OPTIONS.items():
        forms = [name for name, form in FORMS.items() if option in form.options]
        described: dict[str, Any] = {"help": f"{arguments['help']} ({', '.join(forms)})"}
        own.add_argument(f"--{option}", **(arguments | described))


def run(args: Namespace, out: CommandOutput) -> None:
    """Write the file."""
    name = args.form or _form_of(args.path)
    form = FORMS[name]
    given = {o: getattr(args, o) for o in OPTIONS if getattr(args, o) not in (None, False)}
    for option in given:
        if option not in form.options:
            raise UsageError(f"--{option} does not go with the form {name}.")
    need_unread(args.path, args, "path")
    system = system_of(args)
    params = parameters_of(args, system)
    path = need_path(args.path, "export")
    if name == "c" and path.suffix in form.endings:
        path, given["name"] = path.parent, path.stem
    files = getattr(ac.export, name)(system, path, params, **given)
    written = [str(file) for file in (files if isinstance(files, tuple) else (files,))]
    out.wrote(written)
    out.result({"model": title_of(system), "form": name, "files": written})


def _form_of(path: str) -> str:
    """The form that the ending of a path means.

    Raises:
        UsageError: for an unknown ending.
    """
    ending = Path(path).suffix
    for name, form in FORMS.items():
        if ending in form.endings:
            return name
    known = [ending for form in FORMS.values() for ending in form.endings]
    raise UsageError(f"'{path}' has no known ending; give {listing(known)}, or --form.")


GRAPH = ("outputs", "network", "batch", "dtype")

FORMS = {
    "fmu": ExportForm((".fmu",), ("outputs", "solver", "step", "fmi")),
    "c": ExportForm((".c", ".h"), ("outputs", "solver", "dtype")),
    "onnx": ExportForm((".onnx",), GRAPH),
    "stablehlo": ExportForm((".mlir", ".mlirbc", ".jax"), GRAPH),
    "modelica": ExportForm((".mo",), ("selfcontained",)),
}
"""Forms by the names of functions of `acausal.export`."""

OPTIONS: dict[str, dict[str, Any]] = {
    "outputs": {"nargs": "+", "metavar": "NAME", "help": "variables to compute"},
    "network": {"metavar": "NAME", "help": "write this network alone"},
    "batch": {"metavar": "NAME", "help": "the name of a leading dimension of the inputs"},
    "dtype": {"choices": ("float64", "float32"), "help": "precision"},
    "solver": {"metavar": "NAME", "help": "of fixed steps, such as rk4 or implicit_euler"},
    "step": {"type": float, "metavar": "S", "help": "longest step in seconds"},
    "fmi": {"choices": ("2.0", "3.0"), "help": "version of the standard"},
    "selfcontained": {"action": "store_true", "help": "write the library's classes, too"},
}
"""Options of some forms, as argparse takes them."""
