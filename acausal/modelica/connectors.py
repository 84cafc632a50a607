"""Connectors that Modelica text defines: one Python class each, and those that consist of connectors and signals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

from acausal.modelica.classes import ClassNode, Entry, View
from acausal.modelica.functions import Interpreter
from acausal.modelica.library_parts import modify_connector
from acausal.modelica.modifications import Bound, Given, given_by, modification
from acausal.modelica.operators import Frame
from acausal.modelica.types import Type, attributes_of, type_of_declared
from acausal.modelica.values import Record, as_array
from acausal.modelica.variables import declare
from acausal.modeling import Connector, Flow, Potential, Variable


def connector(build: Any, name: str, found: Type, inner: list[Given]) -> Any:
    """A connector of a component; one that has signals, parameters or connectors in it is a record of them.

    Their names are paths, such as ``plug.pin[1]``, so that each belongs to the component itself.
    """
    node = found.node
    if node is not None and node.python is None and _is_composite(node):
        return _composite(build, name, node, inner)
    build.later.append(lambda: modify_connector(build, name, inner))
    return found.native() if node is None else connector_class(node)()


def _is_composite(node: ClassNode) -> bool:
    """Whether a connector consists of more than potentials and flows."""
    return any(not _is_plain(entry) for entry in node.view().entries.values())


def _is_plain(entry: Entry) -> bool:
    prefixes, found = entry.declared.prefixes, type_of_declared(Frame(entry.node), entry.declared)
    causal = prefixes.causality or found.causality or prefixes.variability
    return found.predefined == "Real" and found.native is None and not causal


def _composite(build: Any, name: str, node: ClassNode, given: list[Given]) -> Record:
    fields: dict[str, Any] = {}
    entries = node.view().entries
    plain = {n: e for n, e in entries.items() if _is_plain(e)}
    others = [(n, e) for n, e in entries.items() if n not in plain]
    for word, entry in sorted(others, key=lambda item: not item[1].declared.prefixes.variability):
        declared, frame = entry.declared, Frame(entry.node, None, fields)
        modifiers = [g for a, n in entry.modifiers for g in given_by([a], Frame(n, None, fields))]
        mod = modification(declared, [*given, *modifiers], frame)
        found, path = type_of_declared(frame, declared), f"{name}.{word}"
        sizes = [(s, frame) for s in declared.subscripts]
        sizes += [(s, Frame(n)) for s, n in found.subscripts]
        if found.predefined:
            prefixes = declared.prefixes
            if not (prefixes.causality or found.causality or prefixes.variability or found.native):
                raise entry.wrong(f"a {found.predefined} in a connector is an input or output")
            declare(build, path, entry, found, mod, sizes)
        else:
            parts = build.parts(path, entry, found, mod, [build.size(*s) for s in sizes])
            build.assign(path, entry, parts)
        fields[word] = build.made[path]
    if plain:
        fields[""] = build.component._node.declare(name, _class(node, plain, fields)())
        fields |= {n: as_array(getattr(fields[""], n)) for n in plain}
    return Record(fields)


def connector_class(node: ClassNode) -> type[Connector]:
    """The Python class of a connector.

    Raises:
        ModelicaError: for a connector that is not made of potentials and flows.
    """
    if node.python is None:
        node.python = _class(node, node.view().entries, {})
    return cast("type[Connector]", node.python)


def _class(node: ClassNode, entries: Mapping[str, Entry], known: dict[str, Any]) -> type[Connector]:
    """The class of the potentials and flows of a connector; ``known`` has values of its parameters."""
    view = node.view()
    bases = tuple(n.cls for n, _ in view.natives) or (Connector,)
    declared = {name: _variable(entry, known) for name, entry in entries.items()}
    if node.definition.expandable:
        raise node.refused("expandable connectors are not supported")
    _check(node, view, declared)
    return type(node.definition.name, bases, {**declared, "__module__": __name__})


def _check(node: ClassNode, view: View, declared: dict[str, Variable]) -> None:
    flows = sum(isinstance(v, Flow) for v in declared.values())
    if not declared and not view.natives:
        raise node.refused("a connector without variables is not supported")
    if not view.natives and flows != len(declared) - flows:
        reason = f"a connector has as many flow variables as others, not {flows} and {len(declared) - flows}"
        raise node.refused(reason)


def _variable(entry: Entry, known: dict[str, Any]) -> Variable:
    """A potential or flow."""
    declared, frame = entry.declared, Frame(entry.node, None, known)
    found = type_of_declared(frame, declared)
    prefixes = declared.prefixes
    if prefixes.connection == "stream":
        raise entry.wrong("a stream variable in a connector is not supported")
    sizes = [
        *((s, frame) for s in declared.subscripts),
        *((s, Frame(n)) for s, n in found.subscripts),
    ]
    shape = tuple(Interpreter(f).whole(Interpreter(f).value(s), "a size") for s, f in sizes)
    given = [g for a, n in entry.modifiers for g in given_by([a], Frame(n))]
    stated = attributes_of(found, modification(declared, given, frame).inner)
    unit = stated.get("unit", "")
    kind = Flow if prefixes.connection == "flow" else Potential
    return kind(
        unit=unit.value() if isinstance(unit, Bound) else unit,
        shape=shape or None,
        doc=declared.comment,
    )
