"""Models as data: JSON netlists of components, connections and parameters, read and written.

A class is named as in the Modelica Standard Library or by its Python path within a library; only classes of
registered libraries can be reached. Expressions go through `acausal.netlist.parser`. A file cannot run code.

```json
{
  "model": "Oscillator",
  "parameters": {"c": 100.0},
  "components": {
    "fixed": {"class": "Modelica.Mechanics.Translational.Components.Fixed"},
    "spring": {"class": "Modelica.Mechanics.Translational.Components.Spring", "with": {"c": "2*c"}},
    "mass": {"class": "acausal.components.translational.Mass", "with": {"m": 1.0, "s": {"start": 0.1, "fixed": true}}}
  },
  "connections": [["fixed.flange", "spring.flange_a"], ["spring.flange_b", "mass.flange_a"]],
  "initial_equations": ["mass.v = 0"]
}
```

`netlist.schema.json` beside this module describes the format.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from acausal.errors import ModelError, shown
from acausal.files import need_path
from acausal.modeling import BudgetError, Component, Declaration
from acausal.netlist import file as netlist_file
from acausal.netlist.file import within
from acausal.netlist.library import Library, installed
from acausal.netlist.model import Netlist
from acausal.netlist.reader import build
from acausal.netlist.writer import Writer


def read_model(path: Path, libraries: tuple[Library, ...]) -> Netlist:
    """A model from a JSON netlist.

    Raises:
        ModelError: in one sentence, with the line or field, for a file that cannot be read, a class or name
            that does not exist, an expression that is malformed, a model that is larger than its budget.
    """
    document = netlist_file.read(path)
    model = within(path.name, lambda: build(document, path.name, libraries))
    within(path.name, lambda: check_sizes(model))
    return model


def save(model: Component, path: str | Path, libraries: Sequence[ModuleType] = ()) -> None:
    """Write a model as a JSON netlist; `load` gives the same model back.

    Parts whose class is in a library are written by its name; other composites as subsystems. Entries that were read
    from a file and not changed are written as they were.

    Arguments:
        model: a composite: parts, parameters, connections. Its class may not state equations of its own.
        path: the file.
        libraries: further libraries of components besides the installed ones, see `acausal.netlist.library`.

    Raises:
        ModelError: for a part of no library, or a value that a file cannot hold (a user's network).
    """
    if not isinstance(model, Component):
        raise ModelError(f"save needs a Component, got {type(model).__name__}")
    path = need_path(path, "save", ModelError)
    netlist_file.write(Writer(libraries_of(libraries)).model(model), path)


def check_sizes(model: Component) -> None:
    """Refuse vectors that are too large now, not when their elements are first read."""
    nodes = [model._node]
    while nodes:
        node = nodes.pop()
        nodes += [child._node for child in node.children.values()]
        for name, declared in {**node.class_declarations, **node.own_declarations}.items():
            if isinstance(declared, Declaration) and declared.shape is not None:
                try:
                    node.shape(name, declared)
                except BudgetError:
                    raise
                except (
                    Exception
                ):  # no size yet: the value that it follows from is missing, or wrong
                    continue


def libraries_of(modules: Sequence[ModuleType]) -> tuple[Library, ...]:
    """The installed libraries, and further modules as libraries.

    Raises:
        ModelError: for what is not a list of modules.
    """
    given: Any = modules
    for module in given if isinstance(given, Sequence) else [None]:
        if not isinstance(module, ModuleType):
            wrong = given if module is None else module
            raise ModelError(f"libraries=[...] lists modules, got {shown(wrong)}")
    return (*installed(), *(Library(module) for module in modules))
