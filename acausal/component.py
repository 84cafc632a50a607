"""Connectors and components: the tree that a user builds and joins with `Component.connect`."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast

import numpy as np
import sympy as sp

from acausal.errors import ConnectionError, DeclarationError, nearest
from acausal.symbols import (
    STATE_SELECT,
    Declaration,
    Eq,
    Flow,
    Input,
    Module,
    ModuleReference,
    Option,
    Output,
    Parameter,
    Potential,
    Reference,
    Start,
    Variable,
)

Signal = Reference
"""A causal input or output, as an endpoint of a connection."""


class Connector:
    """A set of variables through which a component meets others; one class per domain.

    Subclasses declare `Potential` and `Flow` variables, and may say how a two-port of the domain names
    its parts, so that generic elements fit in:

    Attributes:
        pair: names of a two-port's two connectors.
        across: name of the difference of the potentials, ``through`` of the flow between them.
        across_unit: unit of the difference, where it differs from the potential's.
        rate: name of the derivative of ``across`` in domains whose potential is a position, else ``None``.
        second_minus_first: whether ``across`` is the second potential minus the first (as in mechanics) or
            the first minus the second.
    """

    pair: ClassVar[tuple[str, str]] = ("port_a", "port_b")
    across: ClassVar[str] = "across"
    through: ClassVar[str] = "through"
    across_unit: ClassVar[str | None] = None
    rate: ClassVar[str | None] = None
    second_minus_first: ClassVar[bool] = False

    declarations: ClassVar[dict[str, Variable]] = {}

    def __init__(self, *, when: str | None = None) -> None:
        self._when = when
        self._name = ""
        self._owner: Component | None = None
        self._references: dict[str, Any] = {}
        if not self.declarations:
            raise DeclarationError(f"connector class {type(self).__name__} declares no variables")

    def __init_subclass__(cls) -> None:
        declarations = dict(cls.declarations)
        for name, value in vars(cls).items():
            if isinstance(value, Input | Output) or (
                isinstance(value, Declaration | Connector) and not isinstance(value, Variable)
            ):
                raise DeclarationError(
                    f"{cls.__name__}.{name}: a connector is made of Potential, Flow and Variable; "
                    f"declare the {type(value).__name__} in the component"
                )
            if isinstance(value, Variable):
                sizes = value.shape or ()
                if not all(isinstance(n, int) for n in sizes):
                    raise DeclarationError(
                        f"{cls.__name__}.{name}: the sizes of a connector's variables are integers"
                    )
                _check_name(cls, name, value.name)
                names = element_names(name, cast(tuple[int, ...] | None, value.shape))
                declarations |= dict.fromkeys(names, value)
        cls.declarations = declarations

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: Any, owner: type) -> Self:
        return self if instance is None else cast(Self, instance._read(self))

    def _bind(self, owner: Component, name: str) -> Self:
        bound = type(self)(when=self._when)
        bound._owner, bound._name = owner, name
        return bound

    def _read(self, declaration: Declaration) -> Any:
        if self._owner is None:
            raise DeclarationError(
                f"connector class {type(self).__name__} is used outside of a component"
            )
        name = declaration.name
        if name not in self._references:
            shape = cast(tuple[int, ...] | None, declaration.shape)
            path = f"{self._name}.{name}"
            self._references[name] = _elements(self._owner, path, declaration, shape)
        return self._references[name]

    @classmethod
    def kind(cls) -> tuple[tuple[str, type, str], ...]:
        """What must agree for two connectors to be joined: names, roles and units of their variables."""
        return tuple((n, _role(d), d.unit) for n, d in cls.declarations.items())

    @classmethod
    def potential(cls) -> str:
        """Name of the (only or first) potential."""
        return next(n for n, d in cls.declarations.items() if isinstance(d, Potential))

    @classmethod
    def flow(cls) -> str:
        """Name of the (only or first) flow."""
        return next(n for n, d in cls.declarations.items() if isinstance(d, Flow))

    @classmethod
    def carried(cls, enters: Self, leaves: Self) -> Iterable[Eq]:
        """How a two-port passes on what its flow carries: equations, in domains with further potentials and flows."""
        return ()

    def __repr__(self) -> str:
        where = f"{self._owner._path()}." if self._owner is not None and self._owner._path() else ""
        return f"{where}{self._name} ({type(self).__name__})"


def _role(declaration: Variable) -> type:
    return next(r for r in (Potential, Flow, Input, Output, Variable) if isinstance(declaration, r))


_OWN = frozenset(
    {
        "_parent",
        "_name",
        "_modifiers",
        "_options",
        "_children",
        "_dynamic",
        "_constants",
        "_pending",
        "_connections",
    }
)
"""What the framework keeps in a component; all other attributes are the author's."""

Endpoint = Connector | Signal
Connection = tuple[Endpoint, Endpoint]


class Component:
    """A part of a model: its declarations are class attributes, its parts instance attributes.

    A leaf states its relations in `equations`; a composite assigns components to attributes (or lists of
    components) in ``__init__`` and joins them with `connect`; one class may do both.

    Arguments:
        modifiers: by name, a value for a parameter, option or module; an `Start` for a variable;
            a mapping of modifiers for a part.

    Raises:
        DeclarationError: for an unknown name, a value of the wrong kind or outside an option's choices.
    """

    _declared: ClassVar[dict[str, Declaration | Connector]] = {}

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Parts that ``__init__`` assigns under computed names."""

    _parent: Component | None
    _name: str
    _modifiers: dict[str, Any]
    _options: dict[str, Any]
    _children: dict[str, Component]
    _dynamic: dict[str, Declaration | Connector]
    _constants: dict[str, Any]
    _pending: dict[str, Mapping[str, Any]]
    _connections: list[Connection]

    def __new__(cls, *args: Any, **kwargs: Any) -> Self:
        """An empty component; nothing depends on a subclass calling ``super().__init__``."""
        self = super().__new__(cls)
        self.__dict__.update(
            _parent=None,
            _name="",
            _modifiers={},
            _options={},
            _children={},
            _dynamic={},
            _constants={},
            _pending={},
            _connections=[],
        )
        return self

    def __init__(self, **modifiers: Any) -> None:
        self.modify(**modifiers)

    def __init_subclass__(cls) -> None:
        declared: dict[str, Declaration | Connector] = {}
        for base in reversed(cls.__mro__):
            for name, value in vars(base).items():
                if isinstance(value, Component):
                    raise DeclarationError(
                        f"{base.__name__}.{name}: a part is made in __init__ (self.{name} = ...), "
                        "so that every model gets its own"
                    )
                if isinstance(value, Declaration | Connector):
                    _check_name(
                        base, name, value._name if isinstance(value, Connector) else value.name
                    )
                    declared[name] = value
                elif name in declared:
                    del declared[name]
        cls._declared = declared

    # -- what a subclass states ------------------------------------------------------------------

    def equations(self) -> Iterable[Eq]:
        """The component's equations; a subclass extends its base's by ``yield from super().equations()``."""
        return ()

    def initial_equations(self) -> Iterable[Eq]:
        """Equations that hold at the initial time only."""
        return ()

    # -- what a user calls -----------------------------------------------------------------------

    def connect(self, *endpoints: Endpoint | Sequence[Endpoint]) -> None:
        """Join two or more connectors (or signals, or equally long lists of them) in one node.

        Potentials become equal, flows sum to zero; of signals exactly one is the source.

        Raises:
            ConnectionError: if they are of unlike kind, are the same, or are not connectors.
        """
        if len(endpoints) < 2:
            raise ConnectionError(f"connect needs at least two connectors, got {len(endpoints)}")
        for a, b in itertools.pairwise(endpoints):
            if isinstance(a, Sequence) and isinstance(b, Sequence):
                if len(a) != len(b):
                    names = [_label(s[0]) if s else "an empty vector" for s in (a, b)]
                    raise ConnectionError(
                        f"{names[0]} and its fellows are {len(a)} signals, {names[1]} and its {len(b)}"
                    )
                for x, y in zip(a, b, strict=True):
                    self.connect(x, y)
            else:
                self._join(a, b)

    def modify(self, **modifiers: Any) -> None:
        """Set parameters, options, modules and starts by name, as the constructor does."""
        for name, value in modifiers.items():
            declaration = self._declared.get(name) or self._dynamic.get(name)
            if declaration is not None:
                self._modify(name, declaration, value)
            elif name in self._children and isinstance(value, Mapping):
                self._children[name].modify(**value)
            elif isinstance(value, Mapping) and not hasattr(type(self), name):
                self._pending[name] = cast(Mapping[str, Any], value)
            else:
                known = [*self._declared, *self._children]
                raise DeclarationError(f"{self._label()} has no '{name}': {nearest(name, known)}")

    # -- declarations read on an instance -------------------------------------------------------------

    def _read(self, declared: Declaration | Connector) -> Any:
        name = declared._name if isinstance(declared, Connector) else declared.name
        if isinstance(declared, Option):
            return self._options.get(name, declared.default)
        when = declared._when if isinstance(declared, Connector) else declared.when
        if when is not None and not self._exists(when):
            raise DeclarationError(f"{self._label()}.{name} exists only with {_condition(when)}")
        if isinstance(declared, Connector):
            value: Any = declared._bind(self, name)
        elif isinstance(declared, Module):
            value = ModuleReference(Reference(self, name, declared))
        else:
            value = _elements(self, name, declared, self._shape(name, declared))
        self.__dict__[name] = value
        return value

    def _exists(self, when: str) -> bool:
        inverted, name = when.startswith("not "), when.removeprefix("not ")
        return bool(getattr(self, name)) is not inverted

    def _shape(self, name: str, declaration: Declaration) -> tuple[int, ...] | None:
        if declaration.shape is None:
            return None
        if ":" in declaration.shape:
            value = self._modifiers.get(name, cast(Parameter, declaration).default)
            if value is None:
                raise DeclarationError(
                    f"{self._label()} has no value for '{name}'; give {name}=[...]"
                )
            shape = np.shape(np.asarray(value, dtype=object))
            if len(shape) != len(declaration.shape):
                raise DeclarationError(
                    f"{self._label()}.{name} needs {len(declaration.shape)} dimension(s), got {len(shape)}"
                )
            return shape
        return tuple(int(getattr(self, n)) if isinstance(n, str) else n for n in declaration.shape)

    def _declarations(self) -> Iterator[tuple[str, Declaration | Connector]]:
        """Every declaration that exists with this instance's options."""
        for name, declared in (*self._declared.items(), *self._dynamic.items()):
            when = declared._when if isinstance(declared, Connector) else declared.when
            if when is None or self._exists(when):
                yield name, declared

    # -- attributes --------------------------------------------------------------------------------

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _OWN:
            object.__setattr__(self, name, value)
        elif name in self._declared:
            self.modify(**{name: value})
        elif isinstance(value, Component | Connector | Declaration):
            self._claim(name)
            object.__setattr__(self, name, self._add(name, value))
        elif _is_list_of_parts(value):
            self._claim(name)
            object.__setattr__(self, name, self._add_all(name, value))
        else:
            if name not in self._constants:
                self._claim(name, anew=hasattr(Component, name))
            self._constants[name] = value
            object.__setattr__(self, name, value)

    def _claim(self, name: str, anew: bool = True) -> None:
        """Make sure that a name is free; one that is not ``anew`` may stand for a default of the class."""
        if not name.isidentifier():
            raise DeclarationError(
                f"'{name}' is no name for a part: letters, digits and underscores only"
            )
        if name == "time":
            raise DeclarationError("'time' is the time; choose another name")
        if name in self.__dict__:
            raise DeclarationError(f"{self._label()} has a '{name}' already; choose another name")
        if anew and hasattr(type(self), name):
            raise DeclarationError(
                f"'{name}' is an attribute of class {type(self).__name__}; choose another name"
            )

    def _add_all(self, name: str, parts: Sequence[Any], *index: int) -> list[Any]:
        """Parts of a list, and of lists in it, named as Modelica does: ``parts[1]``, ``parts[2,1]``."""
        added: list[Any] = []
        for i, part in enumerate(parts, start=1):
            if isinstance(part, list | tuple):
                added.append(self._add_all(name, cast(Sequence[Any], part), *index, i))
            else:
                added.append(self._add(f"{name}[{','.join(map(str, (*index, i)))}]", part))
        return added

    def _add(self, name: str, part: Component | Connector | Declaration) -> Any:
        if isinstance(part, Component):
            if part._parent is not None:
                raise DeclarationError(
                    f"'{name}': this {type(part).__name__} is already '{part._path()}'; make a second one"
                )
            if part is self or part in self._ancestors():
                raise DeclarationError(f"'{name}': a component cannot contain itself")
            part._parent, part._name = self, name
            self._children[name] = part
            part.modify(**self._pending.pop(name, {}))
            return part
        self._dynamic[name] = part
        if isinstance(part, Connector):
            return part._bind(self, name)
        part.name = name
        return self._read(part)

    def _ancestors(self) -> Iterator[Component]:
        ancestor = self._parent
        while ancestor is not None:
            yield ancestor
            ancestor = ancestor._parent

    def _path(self) -> str:
        names = [self._name, *(a._name for a in self._ancestors())]
        return ".".join(n for n in reversed(names) if n)

    def _label(self) -> str:
        path = self._path()
        return f"{type(self).__name__} '{path}'" if path else type(self).__name__

    def __repr__(self) -> str:
        return f"<{self._label()}>"

    # -- modifiers ---------------------------------------------------------------------------------

    def _modify(self, name: str, declaration: Declaration | Connector, value: Any) -> None:
        where = f"{self._label()}.{name}"
        match declaration:
            case Connector():
                if not isinstance(value, Mapping):
                    raise DeclarationError(
                        f"{where} is a connector; modify its variables by a mapping"
                    )
                for key, start in cast(Mapping[str, Any], value).items():
                    if key not in declaration.declarations:
                        raise DeclarationError(
                            f"{where} has no '{key}': {nearest(key, declaration.declarations)}"
                        )
                    self._restart(f"{name}.{key}", _start(f"{where}.{key}", start))
            case Option():
                if declaration.choices is not None and value not in declaration.choices:
                    choices = ", ".join(map(repr, declaration.choices))
                    raise DeclarationError(f"{where}={value!r} is none of {choices}")
                if isinstance(declaration.default, bool) and not isinstance(value, bool):
                    raise DeclarationError(f"{where}={value!r}: True or False is needed")
                self._options[name] = value
            case Variable():
                self._restart(name, _start(where, value))
            case Module():
                if not callable(value) and not isinstance(value, ModuleReference):
                    raise DeclarationError(
                        f"{where} needs a module or a function key -> module, got {value!r}"
                    )
                self._modifiers[name] = value
            case Parameter():
                self._modifiers[name] = _value(where, declaration, value)
                if declaration.shape is not None:  # its size may have changed
                    self.__dict__.pop(name, None)
                    if name in self._dynamic:
                        self._read(declaration)
            case _:
                raise DeclarationError(f"{where} cannot be modified")

    def _restart(self, name: str, start: Start) -> None:
        """Give a variable's attributes; what an earlier modifier gave and this one leaves open stays."""
        earlier = self._modifiers.get(name, Start())
        self._modifiers[name] = Start(
            **{
                f.name: v if (v := getattr(start, f.name)) is not None else getattr(earlier, f.name)
                for f in fields(Start)
            }
        )

    def _attribute(self, variable: Variable, attribute: str) -> Any:
        """A declared attribute of a variable, looked up where the declaration gives the name of another one."""
        value = getattr(variable, attribute)
        return (
            getattr(self, value) if isinstance(value, str) and value not in STATE_SELECT else value
        )

    # -- connections -------------------------------------------------------------------------------

    def _join(self, a: Any, b: Any) -> None:
        for end in (a, b):
            if not (isinstance(end, Connector) or _is_signal(end)):
                raise ConnectionError(
                    f"{_label(end)} is not a connector; connect({_label(a)}, {_label(b)})"
                )
        if isinstance(a, Connector) != isinstance(b, Connector):
            raise ConnectionError(
                f"unlike connectors: {_label(a)} and {_label(b)}; one is a signal"
            )
        if a is b:
            raise ConnectionError(f"{_label(a)} is connected to itself")
        if isinstance(a, Connector) and a.kind() != b.kind():
            raise ConnectionError(
                f"unlike connectors: {_label(a)} and {_label(b)}; only connectors of one domain can be joined"
            )
        self._connections.append((a, b))


def element_names(name: str, shape: tuple[int, ...] | None) -> list[str]:
    """Names of a variable's elements as in Modelica, ``y[1]``, ``A[1,2]``; of a scalar its own name."""
    if shape is None:
        return [name]
    return [f"{name}[{','.join(str(i + 1) for i in index)}]" for index in np.ndindex(*shape)]


def _elements(
    owner: Component, name: str, declaration: Declaration, shape: tuple[int, ...] | None
) -> Any:
    """A reference, or nested tuples of references."""
    references = iter([Reference(owner, path, declaration) for path in element_names(name, shape)])

    def nested(sizes: tuple[int, ...]) -> Any:
        return tuple(nested(sizes[1:]) for _ in range(sizes[0])) if sizes else next(references)

    return nested(shape or ())


def _is_list_of_parts(value: Any) -> bool:
    if not isinstance(value, list | tuple) or not value:
        return False
    parts = cast(Sequence[Any], value)
    return all(
        isinstance(v, Component | Connector | Declaration) or _is_list_of_parts(v) for v in parts
    )


def _check_name(cls: type, name: str, declared: str) -> None:
    """A declaration's name must be its own, and may not hide what the framework needs."""
    if declared != name:
        raise DeclarationError(
            f"{cls.__name__}: '{name}' and '{declared}' are one declaration; make a second one"
        )
    if name == "time":
        raise DeclarationError(f"{cls.__name__}: 'time' is the time; choose another name")
    if name in _OWN or hasattr(Component, name):
        raise DeclarationError(
            f"{cls.__name__}: '{name}' is an attribute of every component; choose another name"
        )


def _is_signal(value: Any) -> bool:
    return isinstance(value, Reference) and isinstance(value.declaration, Input | Output)


def _start(where: str, value: Any) -> Start:
    if isinstance(value, Start):
        for element in np.ravel(np.asarray(value.value, dtype=object)):
            _check_start(where, element)
        return value
    if isinstance(value, Mapping):
        try:
            return _start(where, Start(**value))
        except TypeError:
            raise DeclarationError(
                f"{where}: a start has value, fixed, nominal and state"
            ) from None
    raise DeclarationError(f"{where} is a variable; give its start as ac.Start({value!r})")


def _check_start(where: str, value: Any) -> None:
    """A start is a finite number or an expression of parameters."""
    if value is None:
        return
    if isinstance(value, sp.Expr) and not value.is_number:
        if all(
            isinstance(r, Reference) and isinstance(r.declaration, Parameter)
            for r in value.free_symbols
        ):
            return
        raise DeclarationError(f"{where}: only parameters may stand in a start, got {value}")
    if isinstance(value, str) or not _is_finite(value):
        raise DeclarationError(f"{where}: a start is a finite number, got {value!r}")


def _is_finite(value: Any) -> bool:
    try:
        return math.isfinite(float(value))
    except (TypeError, ValueError):
        return False


def _value(where: str, declaration: Parameter, value: Any) -> Any:
    if declaration.shape is not None:
        return _values(where, declaration, value)
    return _number(where, declaration, value)


def _values(where: str, declaration: Parameter, value: Any) -> np.ndarray:
    """A vector or matrix of values; its size is checked when the sizes are settled."""
    values = np.asarray(value, dtype=object)
    checked = [_number(f"{where}[{i}]", declaration, v) for i, v in enumerate(values.flat, start=1)]
    result = np.empty(values.size, dtype=object)
    result[:] = checked
    return result.reshape(values.shape)


def _number(where: str, declaration: Parameter, value: Any) -> Any:
    if isinstance(value, sp.Expr) and not value.is_number:
        foreign = [r for r in value.free_symbols if not isinstance(r, Reference)]
        unsteady = [
            r
            for r in value.free_symbols
            if isinstance(r, Reference) and not isinstance(r.declaration, Parameter)
        ]
        if foreign or unsteady:
            raise DeclarationError(
                f"{where} = {value}: only parameters may stand in a parameter's value"
            )
        return value
    try:
        number = float("" if isinstance(value, str | bool) else value)
    except (TypeError, ValueError):
        raise DeclarationError(
            f"{where}={value!r}: a number or an expression of parameters is needed"
        ) from None
    if not math.isfinite(number):
        raise DeclarationError(f"{where}={number}: a finite number is needed")
    low, high = declaration.min, declaration.max
    if (low is not None and number < low) or (high is not None and number > high):
        bound = f"at least {low:g}" if low is not None and number < low else f"at most {high:g}"
        raise DeclarationError(
            f"{where}={number:g} is out of range: {bound} {declaration.unit}".rstrip()
        )
    return number


def _condition(when: str) -> str:
    return f"{when.removeprefix('not ')}={not when.startswith('not ')}"


def _label(end: Any) -> str:
    if isinstance(end, Reference):
        path = end.owner._path()
        return f"{path}.{end.path}" if path else end.path
    return repr(end)
