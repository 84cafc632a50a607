"""The states at which records start, as the user gives them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Literal, TypeGuard, cast

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Bool, Float, Int

from acausal._jax import array, is_number, traced
from acausal.codegen import Packed, Values
from acausal.data import Data
from acausal.errors import DataError, known_name, listing, nearest, shown
from acausal.modeling import is_of_kind

if TYPE_CHECKING:
    from acausal.system import System

OfRecord = Literal["auto", "data", "model", "steady", "fit"] | Mapping[str, float]
"""Measured or as the model starts, and found within what is known of that; as measured; as the model starts; at rest;
trained; or values by name that replace the measured ones."""

InitialState = OfRecord | Mapping[str, OfRecord]
"""The same for all records, or by record."""

KINDS = ("data", "model", "steady", "fit", "auto")
GIVEN, MODEL, STEADY, FIT = range(4)


class FirstStates(eqx.Module):
    """The states at which R records start, where they are not trained.

    Attributes:
        kind: of every record.
        given: states that do not depend on parameters; NaN for others.
        kinds: those that occur.
        discrete: what discrete variables begin with, NaN for those that begin as the model starts; None if all do.
        shown: which of these values the first samples have shown; None if ``discrete`` is.
    """

    kind: Int[Array, " R"]
    given: Float[Array, "R n_states"]
    kinds: tuple[int, ...] = eqx.field(static=True)
    discrete: Float[Array, "R n_discrete"] | None = None
    shown: Bool[Array, "R n_discrete"] | None = None

    def from_model(self) -> FirstStates:
        """The same with the model's start in the place of states that are trained."""
        kind = jnp.where(self.kind == FIT, MODEL, self.kind)
        kinds = tuple(sorted({*self.kinds, MODEL} - {FIT}))
        return FirstStates(kind, self.given, kinds, self.discrete, self.shown)

    def discrete_starts(
        self, system: System, packed: Packed
    ) -> Float[Array, "R n_discrete"] | None:
        """What discrete variables begin with; ``packed`` as of a call. None if all begin as the model starts."""
        if self.discrete is None:
            return None
        starts: Any = jax.vmap(
            lambda own: system.initializer.discrete_starts(Packed(own, packed.modules))
        )(packed.values)
        return jnp.where(jnp.isnan(self.discrete), starts, self.discrete)

    def __call__(
        self,
        system: System,
        packed: Packed,
        t: Float[Array, " R"],
        u: Float[Array, "R n_inputs"],
    ) -> Float[Array, "R n_states"]:
        """The states; ``packed`` has values for each record, shape (R, n_parameters)."""
        states = self.given
        for kind in (MODEL, STEADY):
            if kind not in self.kinds:
                continue
            is_steady = kind == STEADY

            def one(
                own: tuple[Array, Array, Array], is_steady: bool = is_steady
            ) -> Float[Array, " n_states"]:
                values, u, t = own
                start: Any = t
                return system.initial_state(
                    Packed(values, packed.modules), None, u, start, steady=is_steady
                )

            rows = packed.values, u, t
            if len(self.kind) == 1 or not traced(rows):  # one by one, so that each is checked
                found = jnp.stack([one(row) for row in zip(*rows, strict=True)])
            else:
                found = lax.map(one, rows)
            known = jnp.where(jnp.isnan(self.given), found, self.given)
            states = jnp.where((self.kind == kind)[:, None], known, states)
        if system.reduced.exact.all():
            return states

        def closed(t: Array, x: Array, u: Array, p: Array) -> Float[Array, " n_states"]:
            return system.closed(Values(t, x, u, Packed(p, packed.modules)))

        return jax.vmap(closed)(t, states, u, packed.values)


def first_states(
    system: System, data: Mapping[str, Data], x0: InitialState, *, trained: bool = True
) -> FirstStates:
    """The states at which records start as ``x0`` says.

    Arguments:
        system: the model.
        data: records by name.
        x0: the choice.
        trained: whether they are records of the training; else those in the place of trained ones are as measured, and
            as the model starts where they are not.

    Raises:
        DataError: for another word, a name that is neither a state nor a record, a value that is not a number, or a
            state that is not in the data where ``x0`` says so.
    """
    starts = [
        _start(system, d, of, trained=trained)
        for d, of in zip(data.values(), by_record(data, x0), strict=True)
    ]
    kinds, states, discrete = zip(*starts, strict=True)
    modes, shown = array(discrete), jnp.zeros((len(data), len(system.reduced.discrete)), bool)
    modes, shown = (None, None) if np.isnan(discrete).all() else (modes, shown)
    return FirstStates(array(kinds, int), array(states), tuple(sorted({*kinds})), modes, shown)


def differs(records: Iterable[str], x0: InitialState) -> TypeGuard[Mapping[str, OfRecord]]:
    """Whether a choice is one by record.

    Raises:
        DataError: for what is no choice at all.
    """
    if isinstance(x0, str):
        return False
    if not isinstance(x0, Mapping):
        raise DataError(f"x0={shown(x0)}; give values by name, or one of {listing(KINDS)}.")
    return any(isinstance(v, Mapping) for v in x0.values()) or any(n in x0 for n in records)


def check_records(x0: InitialState, known: Iterable[str]) -> None:
    """Check the names of records.

    Raises:
        DataError: for a name that is not a record.
    """
    known = list(known)
    if differs(known, x0):
        for name in x0:
            known_name(name, known, "x0: there is no record")


def by_record(records: Mapping[str, Data], x0: InitialState) -> list[OfRecord]:
    """The choice for each record.

    Raises:
        DataError: for a record that has none.
    """
    if not differs(records, x0):
        return [cast(OfRecord, x0)] * len(records)
    own = cast(Mapping[str, OfRecord], x0)
    if missing := [n for n in records if n not in own]:
        raise DataError(f"x0 says nothing about the records {listing(missing)}.")
    return [own[n] for n in records]


def _measured_modes(system: System, data: Data) -> Float[np.ndarray, " n_discrete"]:
    """The first values of the discrete variables that events remember; NaN for what is not measured, or not whole."""
    found = np.full(len(system.reduced.discrete), np.nan)
    for name in system.remembered:
        if name in data.signals:
            place, sign = system.discrete[name]
            value, kind = float(data[name][0]), system.wholes.get(name, "real")
            found[place] = sign * value if is_of_kind(value, kind) else np.nan
    return found


def _start(
    system: System, data: Data, x0: OfRecord, *, trained: bool
) -> tuple[int, Float[np.ndarray, " n_states"], Float[np.ndarray, " n_discrete"]]:
    """How a record starts, and what is known of its states and discrete variables without parameters; NaN elsewhere."""
    measured = np.array([data[n][0] if n in data.signals else np.nan for n in system.states], float)
    discrete = _measured_modes(system, data)
    if isinstance(x0, str) and x0 not in ("data", "auto"):
        if x0 not in KINDS:
            raise DataError(f"x0='{x0}' is not an initial state: {nearest(x0, KINDS)}")
        if x0 == "fit" and not trained:
            return MODEL, measured, discrete
        if x0 != "fit":
            discrete[:] = np.nan
        return KINDS.index(x0), np.full(len(system.states), np.nan), discrete
    given, modes = system.initializer.given({} if isinstance(x0, str) else x0)
    discrete[[*modes]] = [*modes.values()]
    for name, value in given.items():
        if not is_number(value):
            raise DataError(f"x0: '{name}' is {shown(value)}; give a finite number.")
    state = np.array([given.get(n, v) for n, v in zip(system.states, measured, strict=True)], float)
    pairs = list(zip(system.states, state, strict=True))[: system.reduced.n_independent]
    unknown = [n for n, v in pairs if np.isnan(v)]
    if unknown and x0 != "data":
        return MODEL, state, discrete
    if unknown:
        raise DataError(
            f"The data lack {listing(unknown)}, with which the record starts: "
            f"leave out x0='data' to have them found, or give x0={{'{unknown[0]}': ...}}."
        )
    return GIVEN, state, discrete
