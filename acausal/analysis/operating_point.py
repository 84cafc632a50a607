"""`operating_point`: the states at which a model rests under given inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float

from acausal._jax import check_time, known
from acausal.codegen import Values
from acausal.errors import InitializationError, known_name, need_compiled
from acausal.initialization import Initialization
from acausal.modeling import ByName, names_in

if TYPE_CHECKING:
    from acausal.system import Params, System

AT_REST = 1e-4
"""A state rests if it moves by less than this part of its nominal value in a second."""


@dataclass(frozen=True, eq=False, repr=False)
class OperatingPoint(ByName):
    """A point at which a model rests. ``point["motor.i"]`` is any variable of the model there.

    Attributes:
        values: time, states, inputs and parameters.
        system: the model.
        found: how each state was found.
    """

    values: Values
    system: System
    found: Initialization = field(repr=False)

    @property
    def x(self) -> Float[Array, " n_states"]:
        """States."""
        return self.values.x

    @property
    def u(self) -> Float[Array, " n_inputs"]:
        """Inputs."""
        return self.values.u

    @property
    def time(self) -> float:
        """The time [s]."""
        return float(np.asarray(self.values.t))

    @property
    def names(self) -> tuple[str, ...]:
        """The names that can be asked for."""
        return tuple(dict.fromkeys((*self.system.variables, *self.system.inputs)))

    def unit(self, name: str) -> str:
        """Unit of a variable, in Modelica's spelling."""
        return self.system.unit(name)

    def to_dict(self, names: Sequence[str] | None = None) -> dict[str, float]:
        """Variables (by default all) as numbers, by name."""
        names = self.names if names is None else names_in(names)
        return dict(zip(names, np.asarray(self._side_by_side(names)).tolist(), strict=True))

    def _column(self, name: str) -> Float[Array, ""]:
        return self._side_by_side((name,))[0]

    def _side_by_side(self, names: tuple[str, ...]) -> Float[Array, " n_names"]:
        for name in names:
            known_name(name, self.names, "The model has no variable")
        return self.system.read(names, self.values)

    def __repr__(self) -> str:
        rows = [*zip(self.system.states, self.x, strict=True)]
        rows += zip(self.system.inputs, self.u, strict=True)
        width = max((len(name) for name, _ in rows), default=0)
        lines = [f"  {n:<{width}}  {float(v): .6g} {self.unit(n)}".rstrip() for n, v in rows]
        return "\n".join([f"OperatingPoint at t = {self.time:g} s", *lines])


def operating_point(
    system: System,
    *,
    inputs: Mapping[str, Any] | Float[ArrayLike, " n_inputs"] | None = None,
    params: Params | None = None,
    x0: Mapping[str, ArrayLike] | None = None,
    steady: bool | Sequence[str] = True,
    t: float = 0.0,
) -> OperatingPoint:
    """The point at which a model rests under constant inputs.

    Where several states are at rest, such as the positions of a free mass, those nearest to the starts are taken.

    Arguments:
        system: a compiled model.
        inputs: by name, numbers or functions of time (the rest zero), or all as an array; by default zero.
        params: parameters, by default the model's own.
        x0: states that are given, by name: the others are at rest with them, and these may move.
        steady: whether all states that ``x0`` does not give are at rest, or the names of those that are: the speeds of
            a motor that turns, and not its angles. A fixed start stays as it is, and must be one of rest.
        t: the time [s].

    Raises:
        DataError: if an argument does not fit the model.
        InitializationError: if there is no such point; it names the fixed starts at which the model does not rest.
        ModelError: for a model that is not compiled.
    """
    need_compiled(system, "operating_point")
    check_time(t)
    packed, u = system.pack(params), system.inputs_at(t, inputs)
    system.check(packed)
    system.warn_of_sampled("operating_point")
    found = system.initialize(packed, x0, inputs=u, t0=t, steady=steady)
    begun = system.initializer.discrete_starts(packed, x0)
    at = system.modes(system.values(t, found.x, u, packed)._replace(d=begun), ticks=False)
    if system.events is not None:
        given = {} if x0 is None else system.initializer.by_state(x0)
        resting = system.states if steady is True else names_in(steady or (), "steady")
        _need_rest(system, at, [n for n in resting if n not in given])
    return OperatingPoint(at, system, found)


def _need_rest(system: System, at: Values, resting: Sequence[str]) -> None:
    """Refuse a point at which conditions have changed, so that it is no rest any more.

    Raises:
        InitializationError: that names the state which moves most.
    """
    places = [system.states.index(name) for name in resting]
    found = known(system.rates(at)) if places else None
    if found is None:
        return
    rates = np.asarray(found)[places]
    moves = np.abs(rates) / np.asarray(system.nominal)[places]
    if np.max(moves) > AT_REST:
        i = int(np.argmax(moves))
        raise InitializationError(
            "No rest was found: where the equations of the start rest, conditions change, such as that of a friction "
            f"that yields, and '{resting[i]}' moves by {rates[i]:.3g} {system.unit(resting[i])} per second. Give "
            "starts nearer to the rest (ac.Start in the components), or simulate until the model rests."
        )
