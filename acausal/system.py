"""The facade: `compile` a model, hold the `System`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeGuard

import jax
import jax.numpy as jnp
import numpy as np
import sympy as sp
from jax.typing import ArrayLike
from jaxtyping import Array, Float
from numpy.typing import ArrayLike as Numbers

from acausal._jax import check_time, floating, is_real, need_double_precision
from acausal.by_name import names_in
from acausal.caches import LeavesCaches
from acausal.codegen import (
    Field,
    Packed,
    ParameterLayout,
    Program,
    StateJacobian,
    Values,
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
from acausal.errors import DataError, ModelError, nearest, shown
from acausal.flattening import FlatModel, flatten
from acausal.initialization import Initialization, Initializer, initializer
from acausal.modeling import Budget, Component
from acausal.structure import ReducedModel, reduce
from acausal.units import check_dimensions

Params = Mapping[str, Any] | Packed


def compile(  # noqa: A001 (the field's word; reached as ac.compile)
    model: Component, *, check_units: bool = True, budget: Budget | None = None
) -> System:
    """Derive the differential equations of a model and turn them into array code.

    Arguments:
        model: the component tree; inputs that nothing feeds become the system's inputs.
        check_units: whether to refuse a model whose equations, values or connections mix different units. A
            variable, parameter or network without a unit fits everything.
        budget: how large the model may become. By default that with which its file was loaded; a model in Python may
            have a hundred times as much: 10 million components, 100 million equations.

    Raises:
        UnitError: if an equation adds, compares or equates different dimensions, or a unit is not valid.
        ModelError: if the model is not declared or connected correctly, or is singular; the message names the place.
    """
    if isinstance(model, type) and issubclass(model, Component):
        raise ModelError(f"compile needs a model, not a class: ac.compile({model.__name__}())")
    if not isinstance(model, Component):
        raise ModelError(f"compile needs a Component, got {type(model).__name__}")
    need_double_precision()
    flat = flatten(model, budget)
    if check_units:
        check_dimensions(flat)
    reduced = reduce(flat)
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
        """Names of the states, in the order of ``x``."""
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
    def variables(self) -> tuple[str, ...]:
        """Dotted names of all variables."""
        return tuple(self.flat.layout.variable(i) for i in range(self.flat.n_variables))

    @cached_property
    def equations(self) -> tuple[sp.Equality, ...]:
        """The explicit differential equations as sympy, ``Derivative(state, time) = ...`` in the order of `states`.

        Symbols bear dotted names; networks are functions named by their parameter. Unknowns of nonlinear
        loops keep their names, and the loops' equations follow at the end.
        """
        return explicit_equations(self.program, self.layout, self.reduced.name)

    @cached_property
    def nominal(self) -> Float[np.ndarray, " n_states"]:
        """Typical magnitudes of the states, in the order of ``x``: the attribute ``nominal``, 1 by default."""
        return np.abs(self.initializer.conditions.nominal)

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
        key = 0 if key is None else key
        if _is_seed(key):
            key = jax.random.key(key)
        if not _is_key(key):
            raise DataError(
                f"key={shown(key)} is no key; give a whole number, or jax.random.key(0)."
            )
        return default_parameters(self.layout, key)

    def pack(self, params: Params | None = None) -> Packed:
        """Parameters as few arrays, bound ones computed; worth doing once before a loop.

        Raises:
            DataError: for an unknown name or a missing module.
        """
        need_double_precision()
        if params is None:
            params = self.parameters()
        return pack(self.layout, params)

    def vector_field(
        self, t: ArrayLike, x: ArrayLike, u: ArrayLike | None, params: Params
    ) -> Float[Array, " n_states"]:
        """Derivatives of the states.

        Arguments:
            t: time [s]. x: states, shape (n_states,). u: inputs, shape (n_inputs,), or None if there are none.
            params: from `parameters` or `pack`.

        Returns:
            dx/dt, shape (n_states,).
        """
        return self.rates(self.values(t, x, u, params))

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
        y = self.read(names, self.values(t, x, u, params))
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
        return self.rates_and_read(names, self.values(t, x, u, params))

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

    def field(self, t: ArrayLike, u: Array, packed: Packed) -> Field:
        """`rates` as a function of the states alone, shape (n_states,), for `state_jacobian`."""
        return Field(self.program, t, u, packed)

    def read(self, names: Sequence[str], values: Values) -> Float[Array, " n_names"]:
        """Variables by dotted name, shape (len(names),)."""
        nodes, signs = self._find_all(names)
        y = read(self.program, nodes, values)
        return y if (signs == 1).all() else y * signs

    def rates_and_read(
        self, names: Sequence[str], values: Values
    ) -> tuple[Float[Array, " n_states"], Float[Array, " n_names"]]:
        """Both; shared values are computed once."""
        nodes, signs = self._find_all(names)
        dx, y = rates_and_read(self.program, nodes, values)
        return dx, y if (signs == 1).all() else y * signs

    def explain_nonfinite(
        self, values: Values, names: str | Sequence[str] | None = None
    ) -> str | None:
        """A sentence on the first equation that has no finite value at a point, or None.

        Arguments:
            values: the point, from `values`.
            names: the variables whose equations are looked at; by default the derivatives of the states.
        """
        nodes = None if names is None else self._find_all(names)[0]
        return explain_nonfinite(self.program, values, self.reduced.name, nodes)

    def initial_state(
        self,
        params: Params | None = None,
        x0: Mapping[str, Numbers] | Numbers | None = None,
        u0: Mapping[str, Numbers] | Numbers | None = None,
        t0: float = 0.0,
        *,
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
    ) -> Float[Array, " n_states"]:
        """Consistent initial states, shape (n_states,); gradients go through.

        States that the conditions leave open stay as near to their starts as they allow, in nominal values;
        `initialize` lists these states.

        Arguments:
            x0: states by name (the rest from the model's starts), or all of them as an array.
            u0: inputs at the initial time, by name (the rest zero) or all of them as an array; by default zero.
            steady: whether all states without a fixed start or a value in ``x0`` are to be at rest, or the names
                of those that are.
            least_squares: whether contradictory conditions are met in the least-squares sense, with fixed
                starts and rates in nominal values, and initial equations unscaled.

        Raises:
            DataError: if ``x0``, ``u0``, ``t0`` or ``steady`` does not fit.
            InitializationError: if the conditions contradict each other.
        """
        check_time(t0, "t0")
        packed, u = self.pack(params), self.input_values(u0, "u0")
        return self.initializer(packed, x0, u, t0, steady, least_squares)

    def initialize(
        self,
        params: Params | None = None,
        x0: Mapping[str, Numbers] | None = None,
        u0: Mapping[str, Numbers] | Numbers | None = None,
        t0: float = 0.0,
        *,
        steady: bool | Sequence[str] = False,
        least_squares: bool = False,
    ) -> Initialization:
        """`initial_state` with a report: where each state's value comes from, and the residuals of the conditions.

        Arguments and errors as in `initial_state`.
        """
        check_time(t0, "t0")
        packed, u = self.pack(params), self.input_values(u0, "u0")
        return self.initializer.report(packed, x0, u, t0, steady, least_squares)

    def input_values(
        self, u: Mapping[str, Numbers] | Numbers | None = None, argument: str = "u"
    ) -> Float[Array, " n_inputs"]:
        """Inputs as an array, shape (n_inputs,), from a mapping by name (the rest zero), an array or None.

        Arguments:
            u: the inputs.
            argument: its name in messages.

        Raises:
            DataError: for a name that is not an input, an array of another length, or what is not a number.
        """
        if u is None or isinstance(u, Mapping):
            given = dict(u or {})
            for name in given:
                if name not in self.inputs:
                    raise DataError(
                        f"{argument}: '{name}' is not an input; {nearest(name, self.inputs)}"
                    )
            numbers: Any = [given.get(name, 0.0) for name in self.inputs]
        else:
            numbers = u
        if not is_real(numbers):
            raise DataError(f"{argument}={shown(u)} are not inputs at one time; give real numbers.")
        values = jnp.asarray(numbers, dtype=float)
        if values.shape != (len(self.inputs),):
            raise DataError(
                f"{argument} has shape {values.shape}; the model has the inputs ({', '.join(self.inputs)})"
            )
        return values

    # -- inside --------------------------------------------------------------------------------------

    def _find(self, name: str) -> tuple[int, int]:
        """Node and sign of a variable or a known derivative."""
        inner, order = name, 0
        while inner.startswith("der(") and inner.endswith(")"):
            inner, order = inner[4:-1], order + 1
        index = self.flat.layout.find_variable(inner)
        if index is None:
            hint = nearest(inner, self.variables)
            if "[0]" in inner:
                hint = (
                    f"elements are counted from 1, as in Modelica: '{inner.replace('[0]', '[1]')}'?"
                )
            raise ModelError(f"the model has no variable '{inner}'; {hint}")
        found = self.reduced.resolve_derivative(index, order)
        if found is None:
            raise ModelError(f"the model does not differentiate '{name.removeprefix('der(')[:-1]}'")
        return found

    def _find_all(self, names: str | Sequence[str]) -> tuple[list[int], np.ndarray]:
        """Nodes and signs of variables and known derivatives."""
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

    def _repr_latex_(self) -> str:
        rows = [f"{sp.latex(e.lhs)} &= {sp.latex(e.rhs)}" for e in self.equations]
        return "$$\\begin{aligned}" + " \\\\ ".join(rows) + "\\end{aligned}$$"


def _is_seed(value: object) -> TypeGuard[int]:
    """Whether this is a whole number of at most 64 bits."""
    return isinstance(value, int | np.integer) and abs(int(value)) < 2**63


def _is_key(value: object) -> TypeGuard[Array]:
    """Whether this is one key of JAX, of the new kind or of the old one."""
    dtype, shape = getattr(value, "dtype", None), getattr(value, "shape", None)
    if dtype is None:
        return False
    is_new = jnp.issubdtype(dtype, jax.dtypes.prng_key)
    return shape == () if is_new else bool(dtype == np.uint32) and shape == (2,)
