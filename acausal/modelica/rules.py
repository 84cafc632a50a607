"""What the language forbids of whole classes: sections where none may be, unlike bases, and unlike replacements.

Each rule has the section of the specification, Modelica 3.6.
"""

from __future__ import annotations

from typing import Any

from acausal.modelica.meanings import Predefined
from acausal.modelica.syntax import ClassDefinition, Declared, Extends
from acausal.modelica.tokens import PREDEFINED, ModelicaError

WITHOUT_EQUATIONS = ("record", "connector", "type", "package", "function")
APART = ("function", "package")
"""Kinds that extend only each other, and that nothing else extends."""


def check_sections(node: Any) -> None:
    """Refuse equations and algorithms in classes that have none (section 4.7)."""
    definition: ClassDefinition = node.definition
    kind, name = definition.kind, definition.name
    stated = bool(definition.equations or definition.initial_equations)
    if kind != "function":
        stated |= bool(definition.algorithms or definition.initial_algorithms)
    if kind in WITHOUT_EQUATIONS and stated:
        what = "equations" if kind == "function" else "equations or algorithms"
        raise node.refused(f"'{name}' is a {kind}, which has no {what}")


def check_function(node: Any) -> None:
    """Refuse a function of several algorithms, or with a public variable that is no argument (section 12.2)."""
    view = node.view()
    if sum(kind == "algorithms" for kind, _, _ in view.sections) > 1:
        raise node.refused(f"'{node.definition.name}' has several algorithms; a function has one")
    for entry in view.entries.values():
        prefixes = entry.declared.prefixes
        if not (prefixes.causality or prefixes.protected or prefixes.variability):
            raise entry.wrong(
                f"'{entry.declared.name}' of a function is input, output or protected"
            )


def check_base(node: Any, clause: Extends, base: Any) -> None:
    """Refuse a function or a package as the base of another kind (section 7.1.3)."""
    kinds = [node.definition.kind, base.definition.kind]
    if kinds[0] != kinds[1] and any(k in APART for k in kinds) and "class" not in kinds:
        words = " extends a ".join(kinds)
        reason = f"a {words}, which the language forbids; declare both as one kind"
        raise node.wrong(clause.base.at, reason, len(clause.base.text))


def check_same(node: Any, element: Declared, known: Declared) -> None:
    """Refuse a component of another predefined type than the inherited one of its name (section 7.1)."""
    types = [known.type.text, element.type.text]
    if types[0] != types[1] and all(t in PREDEFINED for t in types):
        raise node.wrong(
            element.at, f"'{element.name}' is inherited, as {types[0]}", len(element.name)
        )


def check_replacement(name: str, new: Any, old: Any, wrong: Any) -> None:
    """Refuse a class, or the class of a component, that lacks what its constraint has (section 7.3.2).

    Arguments:
        new, old: what replaces it, and its constraint: classes of the text or predefined types; others pass.
        wrong: makes the error.
    """
    reason = unlike(new, old)
    if reason:
        raise wrong(f"this cannot replace '{name}': {reason}")


def unlike(new: Any, old: Any) -> str:
    """Why a class is no subtype of another one; nothing where it is, or where that is not known."""
    types = [_predefined(c) for c in (new, old)]
    if all(types) and types[0] != types[1]:
        return f"it is a {types[0]}, not a {types[1]}"
    try:
        views = [None if isinstance(c, Predefined) else c.view() for c in (new, old)]
    except (AttributeError, ModelicaError):
        return ""
    if views[0] is None or views[1] is None or views[0].natives:
        return ""
    for member, entry in views[1].entries.items():
        if member not in views[0].entries and not entry.declared.prefixes.protected:
            return f"it has no '{member}', which '{old.definition.name}' has"
    return ""


def _predefined(cls: Any) -> str:
    """The predefined type that a class is; nothing for others."""
    found = cls
    if not isinstance(cls, Predefined):
        try:
            found = cls.view().predefined
        except (AttributeError, ModelicaError):
            return ""
    return found.name if found is not None and found.name in PREDEFINED else ""
