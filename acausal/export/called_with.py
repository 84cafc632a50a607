"""What a model calls a network with."""

from __future__ import annotations

from typing import Any

from acausal.modeling import Component, ModuleCall, Reference


def called_with(
    model: Component, network: str
) -> tuple[tuple[str, ...], str, dict[str, str]] | None:
    """Names of the arguments and of the result of a network, and their units, from the first equation that calls it.

    Arguments:
        network: its name in the model, such as ``"spring_nn.net"``.

    Returns:
        ``(inputs, output, units)``; an argument that is an expression is ``x1``, ``x2``; a result within one is ``y``.
        None where no equation of its own component calls it.
    """
    owner, _, name = network.rpartition(".")
    part = _part(model, owner)
    if part is None:
        return None
    units: dict[str, str] = {}

    def named(expression: Any, otherwise: str) -> str:
        if not isinstance(expression, Reference):
            return otherwise
        prefix = expression.owner.path
        full = f"{prefix}.{expression.path}" if prefix else expression.path
        units[full] = expression.declaration.unit
        return full

    for equation in part.equations():
        for left, right in (_sides(equation), _sides(equation)[::-1]):
            for call in _calls(right, name):
                arguments = call.args[2:]
                if len(arguments) == 1:
                    inputs = (named(arguments[0], "x"),)
                else:
                    inputs = tuple(named(a, f"x{i}") for i, a in enumerate(arguments, start=1))
                output = named(left, "y") if call == right else "y"
                return inputs, output, units
    return None


def _sides(equation: Any) -> tuple[Any, Any]:
    return getattr(equation, "lhs", None), getattr(equation, "rhs", None)


def _calls(expression: Any, name: str) -> list[Any]:
    """Calls of a network, that without other operations around it first."""
    if not hasattr(expression, "atoms"):
        return []
    calls = [c for c in expression.atoms(ModuleCall) if getattr(c.args[0], "path", "") == name]
    return sorted(calls, key=lambda c: (c != expression, str(c)))


def _part(model: Component, path: str) -> Component | None:
    for part in _below(model):
        if part._node.path == path:
            return part
    return None


def _below(model: Component) -> list[Component]:
    parts = [model]
    for part in parts:
        parts += part._node.children.values()
    return parts
