"""The motion of a mechanism: the shapes of a model's components, placed along a trajectory."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Float

from acausal.codegen import Packed, evaluate, read_parameters
from acausal.errors import DataError, known_name
from acausal.modeling import Parameter, Reference, Shape, full_name

if TYPE_CHECKING:
    from acausal.reporting import Animation, Moving
    from acausal.system import System

FRAMES = 900
"""At most so many points of a trajectory are drawn; between them, the page interpolates."""

Numbers = Float[np.ndarray, " n"]


def has_shapes(system: System) -> bool:
    """Whether any component of a model can be drawn where it is."""
    return any(True for part in system.flat.layout.components for _ in part.shapes())


def animation(
    system: System,
    packed: Packed,
    t: Numbers,
    read: Callable[[Sequence[str]], Mapping[str, Numbers]],
    *,
    trace: str | None,
    caption: str,
) -> Animation:
    """The shapes of all components along a trajectory; ``trace``, ``caption`` and errors as of `Solution.animation`.

    ``read`` gives variables at its times by name.
    """
    from acausal.reporting import Animation, Moving

    layout = system.flat.layout
    found = [
        (i, path, shape)
        for i, (path, part) in enumerate(zip(layout.paths, layout.components, strict=True))
        for shape in part.shapes()
    ]
    if not found:
        raise DataError(
            f"animation: no component of {system.flat.name} has a shape; define the method 'shapes' of "
            "its class, or build the mechanism from the package planar."
        )
    ways = list(dict.fromkeys(path for _, path, shape in found if shape.traced))
    if trace is not None:
        known_name(trace, ways, "animation:", then=" has no way to trace:")
    variables, parameters = _read_by(system, [(i, shape) for i, _, shape in found])
    columns = read(list(dict.fromkeys(variables.values())))
    numbers = np.array(list(parameters.values()), int)
    given = np.asarray(read_parameters(system.layout.gather(numbers), packed))
    values: dict[Any, Any] = {symbol: columns[name] for symbol, name in variables.items()}
    values |= zip(parameters, np.broadcast_to(given, numbers.shape), strict=True)
    rows = np.unique(np.linspace(0, len(t) - 1, min(len(t), FRAMES)).round().astype(int))

    def over_time(expression: Any) -> Numbers:
        value = evaluate(expression, values) if hasattr(expression, "free_symbols") else expression
        column = np.broadcast_to(np.asarray(value, float), t.shape)[rows]
        column = np.where(np.isfinite(column), column, 0.0)
        return column[:1] if np.ptp(column) == 0.0 else column

    moving = [
        Moving(
            path,
            shape.path,
            over_time(shape.x),
            over_time(shape.y),
            np.unwrap(over_time(shape.phi)),
            *(None if size is None else over_time(size) for size in shape.size),
            extent=shape.extent,
            filled=shape.filled,
            traced=shape.traced,
        )
        for _, path, shape in found
    ]
    moving.sort(
        key=lambda one: (not one.filled, one.along is None)
    )  # pins lie on rods, rods on bodies
    chosen = trace or max(ways, key=lambda name: _farthest(name, moving), default="")
    return Animation(caption, t[rows], tuple(moving), chosen)


def _farthest(name: str, moving: list[Moving]) -> float:
    """How far apart the places of a point are."""
    return max(
        float(np.hypot(np.ptp(m.x), np.ptp(m.y))) for m in moving if m.name == name and m.traced
    )


def _read_by(
    system: System, shapes: Sequence[tuple[int, Shape]]
) -> tuple[dict[Reference, str], dict[Reference, int]]:
    """What the shapes of components, by their numbers, depend on: names of variables and numbers of parameters."""
    layout = system.flat.layout
    variables: dict[Reference, str] = {}
    parameters: dict[Reference, int] = {}
    for i, shape in shapes:
        local = {name: k for k, (name, _) in enumerate(layout.form(i).parameters)}
        for given in (shape.x, shape.y, shape.phi, *shape.size):
            for symbol in getattr(given, "free_symbols", ()):
                if isinstance(symbol.declaration, Parameter):
                    parameters[symbol] = int(layout.parameter_base[i]) + local[symbol.path]
                else:
                    variables[symbol] = full_name(layout.paths[i], symbol.path)
    return variables, parameters
