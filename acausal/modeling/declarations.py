"""The declarations of a component: parameters, variables, signals, options and modules.

A declaration is a class attribute. Read on an instance it becomes a reference (`acausal.modeling.symbols`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Self, overload

import numpy as np

from acausal.errors import DeclarationError, is_whole, need_flag, need_text, shown
from acausal.modeling.written import call_text

StateSelect = Literal["never", "avoid", "default", "prefer", "always"]
STATE_SELECT: tuple[StateSelect, ...] = ("never", "avoid", "default", "prefer", "always")
TearSelect = Literal["never", "avoid", "default", "prefer", "always"]
TEAR_SELECT: tuple[TearSelect, ...] = ("never", "avoid", "default", "prefer", "always")
Kind = Literal["real", "bool", "int"]
KINDS: tuple[Kind, ...] = ("real", "bool", "int")


def is_of_kind(value: float, kind: str) -> bool:
    """Whether a number is one that a variable of this kind may have."""
    return kind == "real" or (value in (0.0, 1.0) if kind == "bool" else value.is_integer())


DeclaredShape = int | str | tuple[int | str, ...] | None


@dataclass(frozen=True, repr=False)
class Start:
    """Start value and attributes of a variable, given as its modifier.

    Arguments:
        value: the start value (a number or an expression of parameters); ``None`` keeps the declared one.
        fixed: whether the value must hold at the initial time (else it is a guess).
        nominal: the variable's typical magnitude.
        state: how much the variable is preferred as a state (`StateSelect`).
    """

    value: Any = None
    fixed: bool | None = None
    nominal: float | None = None
    state: StateSelect | None = None

    def __repr__(self) -> str:
        return call_text(self)

    def __post_init__(self) -> None:
        state: Any = self.state
        if state is not None and not (isinstance(state, str) and state in STATE_SELECT):
            raise DeclarationError(f"state={shown(state)} must be one of {', '.join(STATE_SELECT)}")
        if self.fixed is not None:
            need_flag(self.fixed, "fixed", DeclarationError)
        if self.nominal is not None and not is_number(self.nominal):
            raise DeclarationError(f"nominal={shown(self.nominal)} must be a number")


class Declaration:
    """Base of everything that a component declares as a class attribute.

    ``unit`` is in Modelica's spelling, ``"N.m/rad"``; a pure number has ``"1"``, and ``""`` fits everything.
    ``when`` names an option: the declaration exists only where that option is true (a leading ``not ``
    inverts it). ``shape`` makes a vector or a matrix; its sizes are integers, names of attributes,
    or ``":"`` for parameters that take the size of their value.
    """

    name: str = ""
    _class: type | None = None

    def __init__(
        self, *, unit: str = "", shape: DeclaredShape = None, when: str | None = None, doc: str = ""
    ) -> None:
        for name, text in {"when": "" if when is None else when, "doc": doc}.items():
            need_text(text, name, DeclarationError)
        self.unit, self.when, self.doc = unit, when, doc
        self.shape: tuple[int | str, ...] | None = (
            shape if shape is None or isinstance(shape, tuple) else (shape,)
        )

    def __set_name__(self, owner: type, name: str) -> None:
        self._class, self.name = owner, name

    def __reduce_ex__(self, protocol: Any) -> Any:
        """What a class declares is pickled by name, as the class is; only what an instance declares is copied."""
        if self._class is None:
            return super().__reduce_ex__(protocol)
        return _declared_in, (self._class, self.name)

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: type) -> Any: ...
    def __get__(self, instance: Any, owner: type) -> Any:
        return self if instance is None else instance._read(self)

    if TYPE_CHECKING:  # at run time `Component.__setattr__` does it

        def __set__(self, instance: Any, value: Any) -> None:
            """A modifier: ``resistor.R = 100.0``."""

    def __repr__(self) -> str:
        return call_text(self)


def _declared_in(owner: type, name: str) -> Declaration:
    known = vars(owner)
    return known[name] if name in known else known[f"{name}_"]  # a name that its class needs itself


class Parameter(Declaration):
    """A constant of a component: a number, or an expression of the enclosing component's parameters.

    Without ``default`` the value must be given where the component is made. A parameter that is left at a default of
    zero is folded out of the equations. To keep it adjustable, set it explicitly (0.0 will do).
    """

    def __init__(
        self,
        default: Any = None,
        *,
        unit: str = "",
        min: float | None = None,  # noqa: A002 (Modelica's name)
        max: float | None = None,  # noqa: A002
        shape: DeclaredShape = None,
        when: str | None = None,
        doc: str = "",
    ) -> None:
        super().__init__(unit=unit, shape=shape, when=when, doc=doc)
        self.default, self.min, self.max = default, min, max


class Variable(Declaration):
    """An unknown of time. ``start``, ``fixed``, ``nominal``, ``state`` as in `Start`.

    The start of an array is a number for all of its elements, or one for each: ``start=[1.0, 2.0]``.
    Each may name another attribute of the component instead: ``start="y_start"`` a parameter,
    ``state="stateSelect"``, ``fixed="T0fixed"`` or ``nominal="s_nominal"`` an option.

    ``tear`` says how much the variable is preferred as a tearing variable, where it is part of an algebraic loop: if it
    is guessed, the loop's other unknowns follow one by one. ``"prefer"`` is torn before, ``"avoid"`` after all
    others; ``"always"`` is torn in any case, ``"never"`` only if the loop cannot be solved without.
    """

    def __init__(
        self,
        *,
        unit: str = "",
        start: Any = 0.0,
        fixed: bool | str = False,
        nominal: float | str = 1.0,
        state: StateSelect | str = "default",
        tear: TearSelect = "default",
        shape: DeclaredShape = None,
        when: str | None = None,
        doc: str = "",
    ) -> None:
        super().__init__(unit=unit, shape=shape, when=when, doc=doc)
        if not isinstance(tear, str) or tear not in TEAR_SELECT:
            raise DeclarationError(f"tear={shown(tear)} must be one of {', '.join(TEAR_SELECT)}")
        need_text(state, f"{type(self).__name__}: state", DeclarationError)
        self.start, self.fixed, self.nominal, self.state = in_tuples(start), fixed, nominal, state
        self.tear = tear


class Discrete(Variable):
    """An unknown that changes at events only, and keeps its value between them.

    It is given by ``ac.Eq(variable, expression)``, which holds at every event, or inside of `When`.

    Arguments:
        start: the value before the first event.
        kind: ``"real"``, ``"bool"`` (1 or 0) or ``"int"``; only a real one has derivatives.
    """

    meaning: Any = None
    """Of a hidden one, the expression whose value it is."""

    def __init__(
        self,
        start: Any = 0.0,
        *,
        kind: Kind = "real",
        unit: str = "",
        shape: DeclaredShape = None,
        when: str | None = None,
        doc: str = "",
    ) -> None:
        if not isinstance(kind, str) or kind not in KINDS:
            raise DeclarationError(f"kind={shown(kind)} must be one of {', '.join(KINDS)}")
        start = float(start) if isinstance(start, bool) else start
        super().__init__(unit=unit, start=start, fixed=False, shape=shape, when=when, doc=doc)
        self.kind = kind


class InitialParameter(Variable):
    """A parameter that the initial conditions determine (Modelica's ``fixed=false``).

    It is a variable with a derivative of zero; ``start`` is the guess. A library's parameter becomes one by
    ``ac.Start(guess, fixed=False)`` as its value.
    """

    def __init__(
        self,
        start: Any = 0.0,
        *,
        unit: str = "",
        shape: DeclaredShape = None,
        nominal: float | str = 1.0,
        doc: str = "",
    ) -> None:
        super().__init__(
            unit=unit, start=start, shape=shape, nominal=nominal, state="prefer", doc=doc
        )


class DependentParameter(Variable):
    """A parameter bound to an expression of `InitialParameter`s."""


class Potential(Variable):
    """A connector's across variable: equal at all connectors of a node."""


class Flow(Variable):
    """A connector's through variable, positive into the component: sums to zero at a node."""


class Input(Variable):
    """A causal signal that enters; left unconnected it becomes an input of the model.

    Arguments:
        kind: ``"real"``, ``"bool"`` (1 or 0) or ``"int"``.
        default: what it is as an input of the model where nothing is given for it; a tuple for each of several.
        held: whether, as an input of the model, it is held from sample to sample unless a record says otherwise;
            ``None``: where it is not real.
        others: as of `Variable`.
    """

    def __init__(
        self,
        *,
        kind: Kind = "real",
        default: Any = None,
        held: bool | None = None,
        **others: Any,
    ) -> None:
        if not isinstance(kind, str) or kind not in KINDS:
            raise DeclarationError(f"kind={shown(kind)} must be one of {', '.join(KINDS)}")
        if default is not None and not _are_numbers(default):
            raise DeclarationError(
                f"default={shown(default)} must be a number, or a tuple of numbers"
            )
        super().__init__(**others)
        if held is not None:
            need_flag(held, "held", DeclarationError)
        self.kind, self.default, self.held = kind, default, held

    @property
    def is_held(self) -> bool:
        """Whether, as an input of the model, it is held from sample to sample."""
        return self.kind != "real" if self.held is None else self.held


def in_tuples(value: Any) -> Any:
    """Values of an array's elements as tuples; what else there is as it is."""
    value = value.tolist() if getattr(value, "ndim", 0) else value
    return tuple(map(in_tuples, value)) if isinstance(value, list | tuple) else value


def is_number(value: Any) -> bool:
    """Whether a value, which is no text, can be read as a finite number."""
    try:
        return not isinstance(value, str | bytes) and math.isfinite(float(value))
    except (TypeError, ValueError, OverflowError):
        return False


def _are_numbers(value: Any) -> bool:
    try:
        return np.asarray(value).dtype.kind in "biuf"
    except (TypeError, ValueError):  # of a ragged tuple, or of one of JAX's keys
        return False


class Output(Variable):
    """A causal signal that leaves."""


class DiscreteOutput(Discrete, Output):
    """An output that changes at events only."""


class Option(Declaration):
    """A structural choice, fixed when the component is made: it may change equations and connectors.

    ``choices`` are all that it can be; of a whole number ``min`` is the least.
    """

    def __init__(
        self,
        default: Any,
        *,
        choices: tuple[Any, ...] | None = None,
        min: int | None = None,  # noqa: A002 (Modelica's name)
        doc: str = "",
    ) -> None:
        super().__init__(doc=doc)
        if not isinstance(choices, tuple | list | None):
            raise DeclarationError(f"choices={shown(choices)} must be a tuple")
        if not (min is None or (is_whole(min) and is_whole(default))):
            raise DeclarationError(f"min={shown(min)} is for options that are whole numbers")
        self.default, self.choices, self.min = default, choices, min


class Module(Declaration):
    """A callable parameter: a neural network, a table, any equinox module from scalars to a scalar.

    The value is the module itself, or a function ``key -> module``, so that every call of
    ``system.parameters(key)`` has new weights. The default may also be the name of a method of the component
    that is such a function. In equations it is called: ``self.net(self.v)``.

    ``unit`` is the unit of its result, ``takes`` has those of its arguments; an empty one fits everything. ``data``
    says that it holds what is known, such as a table: drawings tint what is learned.
    """

    def __init__(
        self,
        default: Callable[..., Any] | str | None = None,
        *,
        unit: str = "",
        takes: tuple[str, ...] = (),
        data: bool = False,
        doc: str = "",
    ) -> None:
        super().__init__(unit=unit, doc=doc)
        if not (isinstance(takes, tuple | list) and all(isinstance(u, str) for u in takes)):
            raise DeclarationError(f"takes={shown(takes)} must be a tuple of units")
        need_flag(data, "data", DeclarationError)
        self.default, self.takes, self.data = default, takes, data


def element_name(name: str, index: Iterable[int]) -> str:
    """The name of an element as in Modelica, ``A[1,2]``, by its place counted from 0; of a scalar its own name."""
    numbers = ",".join(str(i + 1) for i in index)
    return f"{name}[{numbers}]" if numbers else name


def element_names(name: str, shape: tuple[int, ...] | None) -> list[str]:
    """Names of a variable's elements, row by row."""
    return [element_name(name, index) for index in np.ndindex(*(shape or ()))]
