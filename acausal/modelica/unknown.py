"""What to say of a name that means nothing where it stands."""

from __future__ import annotations

from typing import Any

from acausal.errors import nearest, shortened
from acausal.modelica.meanings import refused_package
from acausal.modelica.syntax import DottedName
from acausal.netlist import find_class

PATH_HINT = "give the folder that has it by path=[...] or in MODELICAPATH"


def unknown_name(node: Any, name: DottedName, what: str) -> str:
    """Why a name means nothing in a class, and what may help.

    Arguments:
        node: the class, a `acausal.modelica.classes.ClassNode`. what: it should be.
    """
    packages = [clause.package for clause in node.imports if clause.everything]
    names = [name.text, *(f"{package}.{name.text}" for package in packages)]
    if reason := next(filter(None, map(refused_package, names)), ""):
        return reason
    return f"there is no {what} '{shortened(name.text)}'; {_hint(node, name)}"


def _hint(node: Any, name: DottedName) -> str:
    words = [w for w in name.words if w]
    if hasattr(node.tree.root(words[0]) or node, "definition"):
        known = [*node.classes, *getattr(node.parent, "classes", ())]
        return f"{nearest(words[-1], known)} {PATH_HINT}" if known else PATH_HINT
    try:
        find_class(node.tree.libraries, name.text)
        return PATH_HINT
    except KeyError as error:
        return f"{error.args[0].rstrip('.')}; {PATH_HINT}"
