"""What an ``outer`` component stands for: the ``inner`` one of its name in a model around it."""

from __future__ import annotations

from typing import Any

from acausal.modelica.views import Entry
from acausal.modeling import Discrete, Input, Parameter, Reference, Variable


def inner_of(build: Any, name: str, entry: Entry) -> Any:
    """What an ``outer`` component stands for: the ``inner`` one of that name in a model around this one."""
    above = build.above
    while above is not None:
        known = above.entries.get(name)
        if known is not None and known.declared.prefixes.inner:
            found = above.member(
                name
            )  # of one that is outer, too, what its class means by the name
            return getattr(above.component, name) if known.declared.prefixes.outer else found
        above = above.above
    raise entry.wrong(
        f"there is no 'inner {entry.declared.type.text} {name}' around this; declare it in the model"
    )


def inwards(build: Any, symbol: Any) -> Any:
    """What stands here for a variable or parameter of an ``outer`` component: it gets its value from there."""
    node: Any = build.component._node
    if not isinstance(symbol, Reference) or symbol.owner.route_from(node) is not None:
        return symbol
    if symbol not in build.outer:
        owner: Any = symbol.owner
        name, declared = f"{owner.name}.{symbol.path}", symbol.declaration
        kind: Any = Parameter if isinstance(declared, Parameter) else Variable
        given: Any = {"unit": declared.unit}
        if isinstance(declared, Discrete | Input) and declared.kind != "real":
            kind, given["kind"] = Discrete, declared.kind
        build.outer[symbol] = node.declare(name, kind(**given))
        if kind is Parameter:
            build.component.modify(**{name: symbol})
        else:
            around(build, symbol.owner).given_inwards.append((build.outer[symbol], symbol))
    return build.outer[symbol]


def around(build: Any, *owners: Any) -> Any:
    """The build of the innermost component that all owners are, or are parts of; this one, if it may be."""
    found = build
    while found.above is not None and any(
        owner.route_from(found.component._node) is None for owner in owners
    ):
        found = found.above
    return found
