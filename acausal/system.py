"""The facade: `compile` a model, hold the `System`."""

from __future__ import annotations

import logging
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Float
from numpy.typing import ArrayLike as Numbers

from acausal._jax import (
    array,
    as_key,
    check_time,
    floating,
    is_real,
    need_double_precision,
    traced,
)
from acausal.codegen import (
    Field,
    Packed,
    ParameterLayout,
    Program,
    StateJacobian,
    Values,
    check_assertions,
    default_parameters,
    explain_nonfinite,
    explicit_equations,
    generate,
    lay_out_parameters,
    pack,
    rates,
    rates_and_read,
    read,
)
from acausal.errors import (
    DataError,
    DeclarationError,
    ModelError,
    known_name,
    listing,
    nearest,
    need_flag,
    shown,
    warn,
)
from acausal.events import Edges, Events, before_events, generate_events, start_of
from acausal.flattening import (
    FlatModel,
    LeavesCaches,
    flatten,
    is_hidden,
    opened,
    unconnected,
    with_inputs,
)
from acausal.initialization import Initialization, Initializer, initializer, overview
from acausal.jobs import collection_paused
from acausal.modeling import (
    Budget,
    Component,
    Discrete,
    Input,
    Name,
    Option,
    antiderivatives,
    by_element,
    names_in,
)
from acausal.structure import ReducedModel, parameter_values, reduce, with_loop_guesses
from acausal.units import check_dimensions

if TYPE_CHECKING:
    from pandas import DataFrame

    from acausal.reporting import Formulas, PlainTable

Params = Mapping[str, Any] | Packed

LOGGER = logging.getLogger(__name__)

TAKE_A_SYSTEM = (
    *("simulate", "sweep", "sliders", "fit", "ensemble", "cross_validate", "estimate", "observer"),
    *("linearize", "operating_point", "open_loop", "diagram", "page", "save"),
)
"""Functions of the package that one may look for among the methods."""


def compile(  # noqa: A001 (the field's word; reached as ac.compile)
    model: Component,
    *,
    inputs: Sequence[str] = (),
    check_units: bool = True,
    budget: Budget | None = None,
    events: bool = False,
) -> System:
    """Derive the differential equations of a model and turn them into array code.

    Arguments:
        model: the component tree; inputs that nothing feeds become the system's inputs.
        inputs: discrete variables that are given instead of found at events, such as measured modes. They become
            inputs of the system, held from sample to sample; what would have given them is left out.
        check_units: whether to refuse a model whose equations, values or connections mix different units. A
            variable, parameter or network without a unit fits everything.
        budget: how large the model may become. By default that with which its file was loaded; a model in Python may
            have a hundred times as much: 10 million components, 100 million equations.
        events: whether steps end where conditions with ``events=None`` change, those of the library's sources for
            example, also in a model without other events: `Solution.events` then lists them.

    Raises:
        UnitError: if an equation adds, compares or equates different dimensions, or a unit is not valid.
        ModelError: if the model is not declared or connected correctly, or is singular; the message names the place.

    Warns:
        UserWarning: of a parameter whose gradient is zero, because it acts through the condition of an `acausal.where`
            alone that is not an event, but makes a value jump.
    """
    if isinstance(model, type) and issubclass(model, Component):
        raise ModelError(f"compile needs a model, not a class: ac.compile({model.__name__}())")
    if not isinstance(model, Component):
        raise ModelError(f"compile needs a Component, got {type(model).__name__}")
    check_units = need_flag(check_units, "compile: check_units", ModelError)
    events = need_flag(events, "compile: events", ModelError)
    need_double_precision()
    began = time.perf_counter()
    with collection_paused():
        flat = with_inputs(flatten(model, budget, watch=events), inputs)
        _warn_of_silent(flat)
        if check_units:
            check_dimensions(flat)
        if flat.assertions:
            check_assertions(flat, parameter_values(flat), DeclarationError)
        found = _derived(model, flat)
    size = f"{flat.n_equations} equations, {len(found.reduced.states)} states"
    LOGGER.info("compiled %s in %.3g s: %s", flat.name, time.perf_counter() - began, size)
    return found


def _derived(model: Component, flat: FlatModel) -> System:
    """The system of a flat model."""
    reduced = with_loop_guesses(reduce(flat))
    parameters = lay_out_parameters(flat)
    program = generate(reduced, parameters)
    return System(
        model, flat, reduced, parameters, program, initializer(reduced, program, parameters)
    )


@dataclass(frozen=True, eq=False, repr=False)
class System(LeavesCaches):
    """A compiled model: ``dx/dt = vector_field(t, x, u, params)`` and any variable by `observe`.

    All functions are pure and can be jitted, differentiated and vmapped. A system can be copied, pickled and sent to
    other processes, and so can its solutions and fits.

    Attributes:
        model: the component tree it came from.
        flat, reduced, layout, program, initializer: the results of the stages, for inspection.
    """

    model: Component
    flat: FlatModel
    reduced: ReducedModel
    layout: ParameterLayout
    program: Program
    initializer: Initializer

    # -- names ---------------------------------------------------------------------------------------

    @cached_property
    def states(self) -> tuple[str, ...]:
        """Names of the states, in the order of ``x``.

        Angles that the loops of a linkage compute come last: they only say which of several solutions is meant.
        """
        return self.initializer.names

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs, in the order of ``u``.

        A ``der(...)`` is the derivative of an input that the model differentiates.
        """
        names = [self.reduced.name(int(i)) for i in self.reduced.inputs]
        return tuple(
            "der(" * order + names[i] + ")" * order for i, order in self.reduced.input_orders
        )

    @cached_property
    def outputs(self) -> tuple[str, ...]:
        """Names of the output signals that nothing takes: those of sensors, and those that the model declares."""
        return tuple(map(self.flat.layout.variable, self.flat.outputs.tolist()))

    @cached_property
    def unconnected(self) -> tuple[str, ...]:
        """Names of the connectors of parts that nothing is connected to: no flow goes through them."""
        return unconnected(self.flat.layout)

    @cached_property
    def held_inputs(self) -> frozenset[str]:
        """Names of inputs that are held from sample to sample.

        Truth values, whole numbers, modes, or so declared; and what a discrete variable follows by an equation.
        """
        declared = map(self.flat.layout.variable_declaration, self.flat.inputs.tolist())
        pairs = zip(self.flat.inputs.tolist(), declared, strict=True)
        held = [
            v for v, d in pairs if isinstance(d, Discrete) or (isinstance(d, Input) and d.is_held)
        ]
        return self.followed_inputs | frozenset(map(self.flat.layout.variable, held))

    @cached_property
    def followed_inputs(self) -> frozenset[str]:
        """Names of inputs that a discrete variable follows by an equation, not at an instant that a condition gives."""
        nodes = self.reduced.aliases.representative[self.flat.inputs]
        followed = self.flat.inputs[np.isin(nodes, self.reduced.followed)]
        return frozenset(map(self.flat.layout.variable, followed.tolist()))

    @property
    def input_defaults(self) -> Mapping[str, float]:
        """By name, what inputs are where nothing is given for them: of FMUs their start values."""
        return self.flat.input_defaults

    def is_mode(self, name: str) -> bool:
        """Whether a variable is a truth value or a whole number that changes at events only."""
        index = self.flat.layout.find_variable(name)
        declared = None if index is None else self.flat.layout.variable_declaration(index)
        return isinstance(declared, Discrete) and declared.kind != "real"

    @cached_property
    def remembered(self) -> tuple[str, ...]:
        """Names of the discrete variables whose value before an event decides on that after it."""
        names = map(self.flat.layout.variable, self.flat.remembered.tolist())
        return tuple(n for n in names if not is_hidden(n))

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """Dotted names of all variables."""
        names = map(self.flat.layout.variable, range(self.flat.n_variables))
        if not len(self.flat.discrete) and not len(self.flat.given):
            return tuple(names)
        return tuple(n for n in names if not is_hidden(n))

    @cached_property
    def discrete(self) -> dict[str, tuple[int, int]]:
        """Names of the discrete variables, with their places in a solution's ``d``, and signs there."""
        places = {int(node): i for i, node in enumerate(self.reduced.discrete)}
        found: dict[str, tuple[int, int]] = {}
        for index in np.sort(self.flat.discrete).tolist():
            name = self.flat.layout.variable(index)
            if not is_hidden(name):
                node, sign = self.reduced.resolve(index)
                found[name] = places[node], sign
        return found

    @cached_property
    def wholes(self) -> dict[str, str]:
        """Names of the discrete variables that are whole numbers, or 1 or 0, with their kinds."""
        layout = self.flat.layout
        places = {n: layout.find_variable(n) for n in self.discrete}
        declared = {n: layout.variable_declaration(i) for n, i in places.items() if i is not None}
        kinds = {n: getattr(one, "kind", "real") for n, one in declared.items()}
        return {n: kind for n, kind in kinds.items() if kind != "real"}

    def describe_discrete(self, place: int) -> str:
        """A discrete variable by its place in ``d``: its name, or the condition or clock that it stands for."""
        node = int(self.reduced.discrete[place])
        name = self.reduced.name(node)
        if not is_hidden(name):
            return name
        assert self.events is not None
        return self.events.describe(place) or name

    def warn_of_sampled(self, what: str) -> None:
        """Warn where sampled variables are held in what is derived from the model at one instant."""
        places = () if self.events is None else self.events.sampled
        names = [self.describe_discrete(place) for place in places]
        if names:
            changes, held = ("changes", "is") if len(names) == 1 else ("change", "are")
            warn(
                f"{what}: {listing(names, 6)} {changes} at the instants of clocks, and {held} held here as at the "
                "start: nothing of that law is in it. Make them inputs (ac.compile(model, inputs=[...])), or simulate."
            )

    def is_discrete(self, name: str) -> bool:
        """Whether a variable changes at events only: a discrete one, or one that equals such."""
        return bool(len(self.reduced.discrete)) and self._find(name)[0] in self.reduced.discrete

    @cached_property
    def equations(self) -> Formulas:
        """The explicit differential equations as sympy, ``Derivative(state, time) = ...`` in the order of `states`.

        Symbols have dotted names; networks are functions named by their parameter. Unknowns of nonlinear
        loops keep their names, and the loops' equations follow at the end. The tuple shows as formulas.
        """
        from acausal.reporting import Formulas

        return Formulas(explicit_equations(self.program, self.layout, self.reduced.name))

    @cached_property
    def nominal(self) -> Float[np.ndarray, " n_states"]:
        """Typical magnitudes of the states, in the order of ``x``: the attribute ``nominal``, 1 by default."""
        return np.abs(self.initializer.conditions.nominal)

    @cached_property
    def events(self) -> Events | None:
        """What holds at events; None for a model without."""
        return generate_events(self.reduced, self.program, self.layout)

    @cached_property
    def edges(self) -> Edges:
        """The times, known ahead, at which the derivatives of the states, or conditions, jump or bend."""
        guards = () if self.events is None else self.events.guards
        return Edges(self.program, tuple(g.formula for g in guards if not g.timed))

    @cached_property
    def state_jacobian(self) -> StateJacobian:
        """The pattern of ``d(dx/dt)/dx``, how to compute its entries, and how to solve equations with them."""
        return StateJacobian.of(self.reduced, self.program)

    def unit(self, name: str) -> str:
        """Unit of a variable or parameter; of a derivative, the unit per second."""
        (name,) = names_in([name])
        if name.startswith("der(") and name.endswith(")"):
            unit = self.unit(name[4:-1])
            return f"({unit})/s" if "/" in unit else f"{unit}/s" if unit else ""
        index = self.flat.layout.find_variable(name)
        if index is not None:
            return self.flat.layout.variable_declaration(index).unit
        if name in self.layout.names:
            position = self.layout.names.index(name)
            return self.flat.layout.parameter_declaration(int(self.layout.free[position])).unit
        raise ModelError(f"the model has no '{name}'; {nearest(name, self.variables)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._top_names]

    if not TYPE_CHECKING:  # so that type checkers go on to refuse misspelled attributes

        def __getattr__(self, name: str) -> Name:
            """A dotted name with completion: ``system.motor.i`` is the text ``"motor.i"``."""
            if name.startswith("_") or "flat" not in self.__dict__:
                raise AttributeError(name)
            if name not in self._top_names:
                attributes = [n for n in dir(self) if not n.startswith("_")]
                hint = nearest(name, attributes)
                if name in TAKE_A_SYSTEM:
                    hint = f"call ac.{name}(system, ...)."
                raise AttributeError(f"A System has no '{name}'; {hint}")
            known = (*self.variables, *self.layout.names, *self.layout.module_names)
            return Name(name, (n for n in known if n.startswith(name)))

    @cached_property
    def _top_names(self) -> tuple[str, ...]:
        """First words of the dotted names: the model's parts, and what it declares itself."""
        node = self.model._node
        parts = (name.partition("[")[0] for name in node.children)
        own = (name for name, declared in node.declarations() if not isinstance(declared, Option))
        return tuple(dict.fromkeys([*parts, *own]))

    def table(self, params: Params | None = None) -> DataFrame | PlainTable:
        """Parameters, networks, states, discrete variables, inputs and outputs, with a row for each.

        Columns are ``kind``, ``value``, ``unit``, ``doc``, ``start`` and ``origin``: for a parameter whether it was
        given or has its default, or the expression that it is bound to; for a state whether its start is fixed or a
        guess. A parameter that is left at a default of zero is folded out of the equations.

        Arguments:
            params: the values to show; by default the model's own.

        Returns:
            A pandas DataFrame, indexed by name; without pandas a `PlainTable`, which prints the same.
        """
        from acausal.reporting import PlainTable

        given = self.parameters() if params is None else params
        return PlainTable(overview(self.initializer, given, self.outputs)).as_data_frame()

    # -- values --------------------------------------------------------------------------------------

    def parameters(self, key: Array | int | None = None) -> dict[str, Any]:
        """The model's parameters as a flat dict: numbers by dotted name, and modules.

        Arguments:
            key: a jax PRNG key (or an integer seed) for fresh weights of networks; 0 by default.

        Raises:
            DataError: for what is neither.
        """
        if key is None and not self.layout.module_names:
            return default_parameters(self.layout, None)  # to make a key takes a moment
        return default_parameters(self.layout, as_key(0 if key is None else key))

    def pack(self, params: Params | None = None) -> Packed:
        """Parameters as few arrays, bound ones computed; worth doing once before a loop.

        Raises:
            DataError: for an unknown name, or a value that does not fit.
        """
        need_double_precision()
        if params is None:
            params = self.parameters()
        return pack(self.layout, params)

    def check(self, packed: Packed) -> None:
        """Refuse values of parameters for which an assertion of the model does not hold, or warn, as it says.

        Raises:
            DataError: for the first of them.
        """
        if not self.flat.assertions or traced(packed.values):
            return
        values = np.asarray(packed.values)
        if values.ndim == 1 and values.tobytes() != self._allowed:
            check_assertions(self.flat, self.layout.by_number(values), DataError)
            vars(self)["_allowed"] = values.tobytes()

    @cached_property
    def _allowed(self) -> bytes:
        """The last values of parameters for which the assertions of the model hold."""
        return b""

    def vector_field(
        self, t: ArrayLike, x: ArrayLike, u: ArrayLike | None, params: Params
    ) -> Float[Array, " n_states"]:
        """Derivatives of the states; discrete variables are those that a simulation would begin with there.

        Arguments:
            t: time [s]. x: states, shape (n_states,). u: inputs, shape (n_inputs,), or None if there are none.
            params: from `parameters` or `pack`.

        Returns:
            dx/dt, shape (n_states,).
        """
        return self.rates(self.in_modes(self.values(t, x, u, params)))

    def observe(
        self,
        name: str | Sequence[str],
        t: ArrayLike,
        x: ArrayLike,
        u: ArrayLike | None,
        params: Params,
    ) -> Float[Array, ""] | Float[Array, " n_names"]:
        """One variable (a scalar) or several (an array, in the order asked), by dotted name.

        ``der(name)`` gives a derivative that the model knows.
        """
        names = names_in(name)
        y = self.read(names, self.in_modes(self.values(t, x, u, params)))
        return y[0] if isinstance(name, str) else y

    def vector_field_and_observe(
        self,
        names: Sequence[str],
        t: ArrayLike,
        x: ArrayLike,
        u: ArrayLike | None,
        params: Params,
    ) -> tuple[Float[Array, " n_states"], Float[Array, " n_names"]]:
        """Derivatives of the states and some variables at once: ``(dx, y)``.

        Shared values are computed and differentiated only once. In the gradient of a loss this is twice as fast as
        `vector_field` and `observe`.
        """
        return self.rates_and_read(names, self.in_modes(self.values(t, x, u, params)))

    # -- the same with values in one record, for simulation and training ------------------------------

    def values(self, t: ArrayLike, x: ArrayLike, u: ArrayLike | None, params: Params) -> Values:
        """The values at which a model is evaluated, in one record; arguments as for `vector_field`.

        Raises:
            DataError: for what is not a time, not real numbers or of another shape, or parameters that do not fit.
        """
        check_time(t)
        x, u = self._check_shapes(x, u)
        return Values(t, x, u, self.pack(params))

    def rates(self, values: Values) -> Float[Array, " n_states"]:
        """Derivatives of the states, shape (n_states,)."""
        return rates(self.program, values)

    def field(
        self, t: ArrayLike, u: Array, packed: Packed, d: Float[Array, " n_discrete"] | None = None
    ) -> Field:
        """`rates` as a function of the states alone, shape (n_states,), for `state_jacobian`."""
        return Field(self.program, t, u, packed, d)

    def read(self, names: Sequence[str], values: Values) -> Float[Array, " n_names"]:
        """Variables by dotted name, shape (len(names),)."""
        nodes, signs = self.nodes_of(names)
        y = read(self.program, nodes, values)
        return y if (signs == 1).all() else y * signs

    def rates_and_read(
        self, names: Sequence[str], values: Values
    ) -> tuple[Float[Array, " n_states"], Float[Array, " n_names"]]:
        """Both; shared values are computed once."""
        nodes, signs = self.nodes_of(names)
        dx, y = rates_and_read(self.program, nodes, values)
        return dx, y if (signs == 1).all() else y * signs

    def closed(self, values: Values) -> Float[Array, " n_states"]:
        """The states, of which the angles of closed linkages, which come last, are as the others have it.

        Those angles only say which solution is meant; where they are NaN or missing, their start values say it.
        """
        return self.initializer.closed(values)

    def explain_nonfinite(
        self,
        values: Values,
        names: str | Sequence[str] | None = None,
        *,
        conditions: bool = False,
    ) -> str | None:
        """A sentence on the first equation that has no finite value at a point, or None.

        Arguments:
            values: the point, from `values`.
            names: the variables whose equations are looked at; by default the derivatives of the states.
            conditions: whether what conditions of events read is looked at, too.
        """
        nodes = None if names is None else self.nodes_of(names)[0]
        guards = self.events.guards if conditions and self.events is not None else ()
        read = self.program.in_copy((s for g in guards for s in g.formula.sources), 0)
        return explain_nonfinite(self.program, values, self.reduced.name, nodes, read)

    def initial_state(
        self,
        params: Params | None = None,
        x0: Mapping[str, Numbers] | Numbers | Literal["steady"] | None = None,
        inputs: Mapping[str, Any] | Numbers | None = None,
        t0: float = 0.0,
        *,
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
    ) -> Float[Array, " n_states"]:
        """Consistent initial states, shape (n_states,); gradients go through.

        States that the conditions leave open stay as near to their starts as they allow, in nominal values;
        `initialize` lists these states.

        Arguments:
            x0: states by name (the rest from the model's starts), or all of them as an array, which may leave out the
                angles of closed loops at its end. ``"steady"`` is the same as ``steady=True``.
            inputs: the inputs at that time, by name (the rest zero) as numbers or functions of time, or all of them as
                an array of numbers; by default zero.
            t0: the initial time [s].
            steady: whether all states without a value in ``x0`` are to be at rest, or the names of those that are. A
                fixed start stays as it is, and must be one of rest.
            least_squares: whether contradictory conditions are met in the least-squares sense, with fixed
                starts and rates in nominal values, and initial equations unscaled.

        Raises:
            DataError: if ``x0``, ``inputs``, ``t0`` or ``steady`` does not fit.
            InitializationError: if the conditions contradict each other.
        """
        check_time(t0, "t0")
        packed, u = self.pack(params), self.inputs_at(t0, inputs)
        x0, steady = (None, True) if isinstance(x0, str) and x0 == "steady" else (x0, steady)
        return self._begun(packed, x0, u, t0, steady, least_squares)[0]

    def _begun(
        self, packed: Packed, x0: Any, u: Array, t0: float, steady: Any, least_squares: bool
    ) -> tuple[Float[Array, " n_states"], Float[Array, " n_discrete"] | None]:
        """Initial states, and the discrete variables with which they are found; None where these do not matter."""

        def state(d: Array | None) -> Array:
            return self.initializer(packed, x0, u, t0, steady, least_squares, d=d)

        if self.events is None or not self.initializer.solves(x0, steady, least_squares):
            return state(None), None
        start = self.blank(packed, t0, u, x0)
        return before_events(self.events, start, state, self.describe_discrete)

    def start_values(
        self,
        packed: Packed,
        x0: Mapping[str, Numbers] | Numbers | None,
        u0: Float[Array, " n_inputs"],
        t0: float,
        *,
        steady: bool = False,
    ) -> Values:
        """The values at the start of a simulation, behind the events that happen there."""

        def state(d: Array | None) -> Array:
            return self.initializer(packed, x0, u0, t0, steady, d=d)

        if self.events is None:
            return self.values(t0, state(None), u0, packed)
        at = self.blank(packed, t0, u0, x0)
        return start_of(self.events, at, state, self.describe_discrete)._replace(t=t0)

    def blank(
        self,
        packed: Packed,
        t0: float,
        u0: ArrayLike | None = None,
        x0: Mapping[str, Numbers] | Numbers | None = None,
    ) -> Values:
        """The values at a time before states are found: these and discrete variables have their starts."""
        u = array(np.zeros(len(self.inputs))) if u0 is None else u0
        at = self.values(array(t0), self.initializer.starts(packed, x0), u, packed)
        return at._replace(d=self.initializer.discrete_starts(packed, x0))

    def watching(self) -> System:
        """The model in which the library's conditions at which values jump are events: their instants have derivatives.

        `acausal.simulate` and `acausal.fit` ask for it where derivatives may be wanted; else the model is simulated as
        it is, which is faster. Of conditions that a user's class keeps literal it warns.
        """
        unseen = self.flat.unseen
        literal = [one.sentence(name) for name, one in unseen.items() if not one.asked]
        if literal and not self._has_warned:
            vars(self)["_has_warned"] = True
            warn(literal[0])
        return self._watched if len(literal) < len(unseen) else self

    @cached_property
    def _has_warned(self) -> bool:
        return False

    @cached_property
    def _watched(self) -> System:
        given = [self.flat.layout.variable(int(i)) for i in self.flat.given]
        names = [name for name in given if not is_hidden(name)]
        found = compile(self.model, inputs=names, check_units=False, events=True)
        return self if found.events is None or found.states != self.states else found

    def opened(self, points: Sequence[str]) -> tuple[System, tuple[str, ...]]:
        """The system in which some signals are inputs, as the connections that feed them are open; and what fed them.

        Raises:
            DeclarationError: for a name of what no connection feeds.
        """
        flat, sources = opened(self.flat, points)
        return _derived(self.model, flat), sources

    def modes(self, values: Values, *, ticks: bool = True) -> Values:
        """The same values with the discrete variables that agree with them, found from these or from their own starts.

        States that jump at once have done so; what is due now, such as a clock's tick, has happened if it ``ticks``.
        """
        if self.events is None:
            return values
        t, x, d = jnp.asarray(values.t, values.x.dtype), values.x, values.d
        d = self.initializer.discrete_starts(values.packed) if d is None else d
        assert d is not None
        start = values._replace(t=t, d=d.astype(x.dtype))
        return start_of(self.events, start, lambda d: x, self.describe_discrete, ticks=ticks)

    def in_modes(self, values: Values) -> Values:
        """The same values with these discrete variables; states stay as they are, even if they jump at once."""
        return values._replace(d=self.modes(values).d)

    def initialize(
        self,
        params: Params | None = None,
        x0: Mapping[str, Numbers] | Literal["steady"] | None = None,
        inputs: Mapping[str, Any] | Numbers | None = None,
        t0: float = 0.0,
        *,
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
    ) -> Initialization:
        """`initial_state` with a report: where each state's value comes from, and the residuals of the conditions.

        Arguments and errors as in `initial_state`.
        """
        check_time(t0, "t0")
        packed, u = self.pack(params), self.inputs_at(t0, inputs)
        x0, steady = (None, True) if isinstance(x0, str) and x0 == "steady" else (x0, steady)
        d = self._begun(packed, x0, u, t0, steady, least_squares)[1]
        return self.initializer.report(packed, x0, u, t0, steady, least_squares, d)

    def inputs_at(
        self, t: float, inputs: Mapping[str, Any] | Numbers | None
    ) -> Float[Array, " n_inputs"]:
        """The inputs at one time as an array, shape (n_inputs,), however a user gives them.

        Arguments:
            t: the time, at which functions are evaluated [s].
            inputs: by name, numbers or functions of time (the rest zero), or an array; or None.

        Raises:
            DataError: as `input_values`.
        """
        given: Any = inputs
        if isinstance(given, Mapping):
            given = {
                n: v(t) if callable(v) and not isinstance(v, type) else v for n, v in given.items()
            }
        return self.input_values(given, "inputs")

    def input_values(
        self, u: Mapping[str, Numbers] | Numbers | None = None, argument: str = "u"
    ) -> Float[Array, " n_inputs"]:
        """Inputs as an array, shape (n_inputs,), from a mapping by name, an array or None.

        The rest of a mapping are `input_defaults`, or zero.

        Arguments:
            u: the inputs.
            argument: its name in messages.

        Raises:
            DataError: for a name that is not an input, an array of another length, or what is not a number.
        """
        if u is None or isinstance(u, Mapping):
            given = by_element(u or {}, self.inputs, argument)
            for name in given:
                known_name(name, self.inputs, f"{argument}:", then=" is not an input;")
            numbers: Any = [given.get(n, self.input_defaults.get(n, 0.0)) for n in self.inputs]
        else:
            numbers = u
        if not is_real(numbers):
            raise DataError(f"{argument}={shown(u)} are not inputs at one time; give real numbers.")
        values = array(numbers)
        if values.shape != (len(self.inputs),):
            raise DataError(
                f"{argument} has shape {values.shape}; the model has the inputs ({', '.join(self.inputs)})"
            )
        return values

    # -- inside --------------------------------------------------------------------------------------

    def _find(self, name: str) -> tuple[int, int]:
        """Node and sign of a variable or a known derivative."""
        *derivatives, inner = antiderivatives(name)
        index = self.flat.layout.find_variable(inner)
        if index is None:
            hint = nearest(inner, self.variables)
            if "[0]" in inner:
                hint = (
                    f"elements are counted from 1, as in Modelica: '{inner.replace('[0]', '[1]')}'?"
                )
            raise ModelError(f"the model has no variable '{inner}'; {hint}")
        found = self.reduced.resolve_derivative(index, len(derivatives))
        if found is None:
            raise ModelError(f"the model does not differentiate '{name.removeprefix('der(')[:-1]}'")
        return found

    def nodes_of(self, names: str | Sequence[str]) -> tuple[list[int], np.ndarray]:
        """Nodes of variables and known derivatives in the flat model, and their signs relative to these."""
        found = [self._find(name) for name in names_in(names)]
        return [node for node, _ in found], np.asarray([sign for _, sign in found])

    def _check_shapes(self, x: ArrayLike, u: ArrayLike | None) -> tuple[Array, Array]:
        for argument, given in (("x", x), ("u", u)):
            if not (is_real(given) or (given is u is None)):
                raise DataError(f"{argument}={shown(given)} are not real numbers.")
        x = floating(x)
        u = jnp.zeros(0, x.dtype) if u is None else floating(u)
        if x.shape != (len(self.reduced.states),):
            raise DataError(f"x has shape {x.shape}; the model has {len(self.states)} states")
        if u.shape != (len(self.reduced.inputs),):
            raise DataError(
                f"u has shape {u.shape}; the model has the inputs ({', '.join(self.inputs)})"
            )
        return x, u

    def __repr__(self) -> str:
        rows = [
            ("states", self.states),
            ("inputs", self.inputs),
            ("parameters", self.layout.names),
            ("modules", self.layout.module_names),
        ]
        counts = f"{self.flat.n_equations} equations, {len(self.reduced.states)} states"
        lines = [f"System of {self.flat.name} ({counts})"]
        for title, names in rows:
            shown = ", ".join(names[:8]) + (f", ... ({len(names)})" if len(names) > 8 else "")
            lines.append(f"  {title:<10} {shown or '-'}")
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        from acausal.reporting import MOST_EQUATIONS, Quantity, system_view

        def described(name: str, value: float | None) -> Quantity:
            index = self.flat.layout.find_variable(name)
            doc = "" if index is None else self.flat.layout.variable_declaration(index).doc
            return Quantity(name, self.unit(name), value, doc)

        computed = {binding.target for binding in self.flat.starts}
        starts = [
            sign * float(self.flat.start[v])
            if v < self.flat.n_variables and v not in computed
            else None
            for v, sign in self.initializer.conditions.start_of
        ]
        declared = map(self.flat.layout.parameter_declaration, self.layout.free.tolist())
        values = self.flat.value[self.layout.free].tolist()
        quantities = {
            "States": list(map(described, self.states, starts)),
            "Inputs": [described(name, None) for name in self.inputs],
            "Parameters": [
                Quantity(name, d.unit, value, d.doc)
                for name, d, value in zip(self.layout.names, declared, values, strict=True)
            ],
            "Networks and tables": [
                Quantity(name, "", None, "") for name in self.layout.module_names
            ],
        }
        about = f"{self.flat.n_equations} equations, {len(self.states)} states"
        few = len(self.states) <= MOST_EQUATIONS
        return system_view(
            self.model,
            f"System of {self.flat.name}",
            about,
            self.equations if few else (),
            quantities,
        )

    def _repr_latex_(self) -> str | None:
        from acausal.reporting import MOST_EQUATIONS, equations_as_latex

        return None if len(self.states) > MOST_EQUATIONS else equations_as_latex(self.equations)


def _warn_of_silent(flat: FlatModel) -> None:
    """Of parameters without a gradient; of those in equal components, the first."""
    named: set[int] = set()
    for name, one in flat.silent.items():
        if not one.asked and id(one) not in named:
            named.add(id(one))
            warn(one.sentence(name))
