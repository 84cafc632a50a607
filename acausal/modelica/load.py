"""Read Modelica text: a file becomes a model, a package a namespace of Python whose classes are attributes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from acausal import netlist
from acausal.errors import ModelError, listing, nearest, need_flag, shown
from acausal.files import need_path, need_paths
from acausal.jobs import collection_paused
from acausal.modelica.build import class_of
from acausal.modelica.classes import ClassNode
from acausal.modelica.connectors import connector_class
from acausal.modelica.functions import Interpreter
from acausal.modelica.meanings import PATH_HINT, Native, Value
from acausal.modelica.operators import Frame
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
            not partial, nor nested in another model. A netlist is one model.
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
    is_netlist = file.suffix != ".mo" and not file.is_dir()
    if is_netlist and model is not None:
        raise ModelError(f"{file.name} is a netlist, which is one model; leave out '{model}'")
    allowed, known = Budget() if budget is None else budget, netlist.libraries_of(libraries)
    folders = need_paths(path, "load", ModelError)
    native = need_flag(allow_native, "load: allow_native", ModelError)
    with collection_paused(), spending(allowed, file.parent if native else None):
        if is_netlist:
            found = netlist.read_model(file, known)
        else:
            tree = Tree(known, folders)
            found = class_of(_wanted(file, tree, _added(tree, file), model))()
            netlist.check_sizes(found)
    found._node.budget = allowed
    return found


def _added(tree: Tree, file: Path) -> list[ClassNode]:
    """The classes of a file, or of a package that is a folder."""
    return tree.add(file / "package.mo" if file.is_dir() else file)


def _wanted(file: Path, tree: Tree, nodes: list[ClassNode], name: str | None) -> ClassNode:
    """The class that is meant."""
    found = tree.resolve(name) if name is not None else None
    if isinstance(found, Native):
        found = tree.text(found.name)
    if not isinstance(found, ClassNode):
        models = [inner for node in nodes for inner in node.models()]
        if name is None:
            outer = [m for m in models if not m.is_nested]
            if not outer:
                raise ModelicaError(
                    f"{file.name}: there is no model in it that is neither partial nor nested in another"
                )
            return outer[-1]
        same = [m for m in models if m.full.endswith(f".{name}")]
        if len(same) != 1:
            known = [m.full for m in models]
            hint = nearest(name, known) if len(known) > 6 else f"it has {listing(known)}"
            raise ModelicaError(f"{file.name}: there is no model '{name}'; {hint}")
        return same[0]
    return found


class ModelicaPackage:
    """A package of Modelica text, or the classes of a file: packages, classes and constants are attributes.

    Attributes are read when they are asked for; `dir` lists them.
    """

    def __init__(self, name: str, members: dict[str, ClassNode], node: ClassNode | None) -> None:
        self._name, self._members, self._node = name, members, node

    def __getattr__(self, name: str) -> Any:
        """A package, the Python class of a model, block, record or connector, or the value of a constant.

        Raises:
            AttributeError: if there is none of this name.
            ModelError: if it is wrong, or nothing that Python can use, such as a function.
        """
        if name.startswith("__"):
            raise AttributeError(name)
        found = self._members.get(name)
        if found is None and self._node is not None:
            if name in self._node.view().entries:
                return Interpreter(Frame(self._node)).constant(self._node, name)
            found = self._node.member(name)
        if found is None:
            raise AttributeError(f"{self._name} has no '{name}'; {nearest(name, self.__dir__())}")
        if isinstance(found, Native | Value):
            return found.cls if isinstance(found, Native) else found.value
        kind = found.definition.kind
        if kind == "package":
            return package_of(found)
        return connector_class(found) if kind == "connector" else class_of(found)

    def __dir__(self) -> list[str]:
        node = self._node
        return [*self._members] if node is None else [*node.names(), *node.view().entries]

    def __repr__(self) -> str:
        return f"{self._name}: {', '.join(self.__dir__())}"


def package_of(node: ClassNode) -> ModelicaPackage:
    """The namespace of a package."""
    return ModelicaPackage(node.full, {}, node)


def import_modelica(
    source: str | Path,
    *,
    libraries: Sequence[ModuleType] = (),
    path: Sequence[str | Path] = (),
) -> ModelicaPackage:
    """The classes of a Modelica package, for use in Python: ``lib = ac.import_modelica("Lib"); lib.Parts.Damper(d=2)``.

    They are classes of components and connectors like all others: make them, connect them, extend them.

    Arguments:
        source: a folder with a ``package.mo``, a file ``….mo``, or the name of a package in one of the folders of
            ``path`` or of ``MODELICAPATH``. A file that holds one package is this package; another one is a namespace
            of its classes.
        libraries: further libraries of components besides the installed ones, see `acausal.netlist.library`.
        path: folders with further packages of Modelica text, before those in ``MODELICAPATH``.

    Returns:
        A namespace; packages within are namespaces, too.

    Raises:
        ModelError: for text that cannot be read or is wrong; a class is looked at when it is asked for.
    """
    file = need_path(source, "import_modelica", ModelError)
    tree = Tree(netlist.libraries_of(libraries), need_paths(path, "import_modelica", ModelError))
    if not file.exists() and file.suffix != ".mo":
        found = tree.resolve(file.name)
        if not isinstance(found, ClassNode):
            raise ModelicaError(f"there is no package '{source}'; {PATH_HINT}")
        nodes = [found]
    else:
        nodes = _added(tree, file)
    if len(nodes) == 1 and nodes[0].definition.kind == "package":
        return package_of(nodes[0])
    return ModelicaPackage(file.name, {node.definition.name: node for node in nodes}, None)
