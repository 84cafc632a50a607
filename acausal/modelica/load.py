"""Load: a file becomes a model; what its ending says decides how it is read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from acausal import netlist
from acausal.errors import ModelError, listing, nearest, need_flag, shown
from acausal.files import need_path, need_paths
from acausal.jobs import collection_paused
from acausal.modelica.build import class_of
from acausal.modelica.classes import ClassNode
from acausal.modelica.meanings import Native
from acausal.modelica.tokens import ModelicaError
from acausal.modelica.tree import Tree
from acausal.modeling import Budget, Component, spending


def load(
    file: str | Path,
    model: str | None = None,
    *,
    libraries: Sequence[ModuleType] = (),
    path: Sequence[str | Path] = (),
    budget: Budget | None = None,
    allow_native: bool = False,
) -> Component:
    """Read a model from Modelica text, ``….mo``, or from a JSON netlist.

    Arguments:
        file: the file; of a package that is a folder the folder, or its ``package.mo``.
        model: name of a class in the file, such as ``"Package.Model"``; by default the last model of the file that is
            not partial. A netlist is one model.
        libraries: further libraries of components besides the installed ones, see `acausal.netlist.library`.
        path: folders with further packages of Modelica text, before those in ``MODELICAPATH``.
        budget: how large the model may become, here and when it is compiled; by default ``ac.Budget()``.
        allow_native: whether the model may have parts that run native code, FMUs; their paths are relative to the file.

    Returns:
        The model, a `Component` with the parts of the file.

    Raises:
        ModelError: for a file that cannot be read, is wrong, or states what is not supported; with its place.
    """
    file = need_path(file, "load", ModelError)
    if not isinstance(model, str | None):
        raise ModelError(
            f"load(file, model) takes the name of a model, not {shown(model)}; libraries=[...] lists modules"
        )
    folders = need_paths(path, "load", ModelError)
    if file.suffix != ".mo" and not file.is_dir():
        if model is not None:
            raise ModelError(f"{file.name} is a netlist, which is one model; leave out '{model}'")
        return netlist.load(file, libraries, budget=budget, allow_native=allow_native)
    allowed = Budget() if budget is None else budget
    tree = Tree(netlist.libraries_of(libraries), folders)
    native = need_flag(allow_native, "load: allow_native", ModelError)
    with collection_paused(), spending(allowed, file.parent if native else None):
        nodes = tree.add(file / "package.mo" if file.is_dir() else file)
        found = class_of(_wanted(file, tree, nodes, model))()
        netlist.check_sizes(found)
    found._node.budget = allowed
    return found


def _wanted(file: Path, tree: Tree, nodes: list[ClassNode], name: str | None) -> ClassNode:
    """The class that is meant."""
    found = tree.resolve(name) if name is not None else None
    if isinstance(found, Native):
        found = tree.text(found.name)
    if not isinstance(found, ClassNode):
        models = [inner for node in nodes for inner in node.models()]
        if name is None:
            if not models:
                raise ModelicaError(f"{file.name}: there is no model in it that is not partial")
            return models[-1]
        same = [m for m in models if m.full.endswith(f".{name}")]
        if len(same) != 1:
            known = [m.full for m in models]
            hint = nearest(name, known) if len(known) > 6 else f"it has {listing(known)}"
            raise ModelicaError(f"{file.name}: there is no model '{name}'; {hint}")
        return same[0]
    return found
