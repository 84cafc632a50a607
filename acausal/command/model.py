"""The model that a command is about: from a file, such as an FMU, or from a Python module."""

from __future__ import annotations

import sys
import traceback
from argparse import Namespace
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import acausal as ac
from acausal.errors import LIBRARY, nearest, shown


def system_of(args: Namespace, text: str | None = None) -> ac.System:
    """The compiled model of a command's arguments ``model`` (or another text), ``library`` and ``replace``.

    Raises:
        ac.ModelError: where there is no such model, or it is wrong.
    """
    libraries = [_module(library) for library in args.library]
    options: dict[str, Any] = {"libraries": libraries, "allow_native": args.allow_native}
    model = model_of(args.model if text is None else text, options)
    for path, name in args.replace:
        whole = model.model if isinstance(model, ac.System) else model
        model = whole.replace(path, _part(name, args.library))
    return model if isinstance(model, ac.System) else ac.compile(model)


def title_of(system: ac.System) -> str:
    """What the model is called: in its file, or as its class."""
    return system.model._node.title or type(system.model).__name__


def model_of(text: str, options: dict[str, Any]) -> ac.Component | ac.System:
    """A model by its file, ``file.mo:Package.Model`` or ``module:Class``; an FMU runs native code that it brings along.

    The options are those of `ac.load`.

    Raises:
        ac.ModelError: where there is none.
    """
    module, colon, name = text.rpartition(":")
    if colon and Path(module).suffix == ".mo":
        return ac.load(module, name, **options)
    if colon and not Path(text).exists():
        return _made(text, _module(module), name)
    if Path(text).suffix == ".py":
        raise ac.ModelError(f"'{text}' is a Python file; name the class in it, too: {text}:Class")
    if Path(text).suffix == ".fmu":
        return ac.FMU(text)
    return ac.load(text, **options)


def parameters_of(args: Namespace, system: ac.System) -> dict[str, Any]:
    """The model's parameters, with those of ``params`` and ``set`` in their places.

    Raises:
        DataError: for a file that does not fit, or an unknown name.
    """
    params = system.parameters() if args.params is None else ac.load_params(args.params, system)
    params |= dict(args.set)
    system.pack(params)
    return params


def networks_and_tables(system: ac.System, params: dict[str, Any]) -> tuple[list[str], list[str]]:
    """Names of the functions among the parameters: those that can be trained, and tables and others that are given."""
    from acausal.networks import networks

    names, trainable = system.layout.module_names, networks(params)
    return [n for n in names if n in trainable], [n for n in names if n not in trainable]


def _part(name: str, libraries: list[str]) -> ac.Component:
    """A part by its class: ``neural.Resistance``, a name of Modelica's, or ``module:Class``."""
    from acausal.netlist import Library, installed  # help starts without it

    module, colon, word = name.rpartition(":")
    if colon:
        made = _made(name, _module(module), word)
        return made.model if isinstance(made, ac.System) else made
    known = [*(Library(_module(library)) for library in libraries), *installed()]
    paths = [(library, f"{library.module.__name__}.{name}") for library in known]
    for library, path in [*((library, name) for library in known), *paths]:
        found = library.find(path)
        if isinstance(found, type) and issubclass(found, ac.Component):
            return _run(name, f"{name}()", found)
    raise ac.ModelError(
        f"--replace: there is no class '{name}'; name one of the library, such as neural.Resistance, or module:Class"
    )


def _made(text: str, module: ModuleType, name: str) -> ac.Component | ac.System:
    """The model that a class or a function makes, or that a module has."""
    found = getattr(module, name, None)
    if found is None:
        known = [n for n, thing in vars(module).items() if _makes(thing, module)]
        raise ac.ModelError(f"{text}: {module.__name__} has no '{name}': {nearest(name, known)}")
    is_model = isinstance(found, ac.Component | ac.System)
    model = _run(text, f"{name}()", found) if callable(found) and not is_model else found
    if not isinstance(model, ac.Component | ac.System):
        raise ac.ModelError(
            f"{text} is {shown(model, 40)}, not a model; name a class of components."
        )
    return model


def _makes(thing: object, module: ModuleType) -> bool:
    """Whether a thing in a module may be meant as a model."""
    if isinstance(thing, FunctionType):
        return thing.__module__ == module.__name__ and not thing.__name__.startswith("_")
    return isinstance(thing, ac.Component) or (
        isinstance(thing, type) and issubclass(thing, ac.Component)
    )


def _module(name: str) -> ModuleType:
    """A module by its name or file; the present folder is searched first."""
    path = Path(name)
    is_file = path.suffix == ".py"
    folder, name = (path.parent, path.stem) if is_file else (Path(), name)
    if is_file and not path.is_file():
        raise ac.ModelError(f"there is no file '{path}'.")
    if str(folder.absolute()) not in sys.path:
        sys.path.insert(0, str(folder.absolute()))
    try:
        return _run(name, f"import {name}", lambda: import_module(name))
    except ModuleNotFoundError as error:
        raise ac.ModelError(
            f"there is no module '{error.name}'; start acausal in the folder that has it, or install it."
        ) from None


def _run(text: str, what: str, action: Callable[[], Any]) -> Any:
    """What a user's code returns; an error in it becomes a sentence with its place.

    Raises:
        ac.ModelError: for any error but acausal's own, which say enough, and modules that are not there.
    """
    try:
        return action()
    except (ac.AcausalError, ModuleNotFoundError):
        raise
    except Exception as error:  # an exception of the user's own code
        frames = traceback.extract_tb(error.__traceback__)[1:]
        own = [f for f in frames if not f.filename.startswith(("<", LIBRARY))]
        place = f" ({Path(own[-1].filename).name}, line {own[-1].lineno})" if own else ""
        reason = " ".join(str(error).split())
        raise ac.ModelError(
            f"{text}: {what} fails{place}: {type(error).__name__}: {reason}"
        ) from None
