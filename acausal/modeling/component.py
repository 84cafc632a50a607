"""Connectors and components: the tree that a user builds and joins with `Component.connect`."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast

import numpy as np
import sympy as sp

from acausal.errors import ConnectionError, DeclarationError, nearest
from acausal.modeling.connector import Connector, check_name
from acausal.modeling.declarations import (
    STATE_SELECT,
    Declaration,
    DependentParameter,
    Eq,
    InitialParameter,
    Input,
    Module,
    ModuleReference,
    Option,
    Output,
    Parameter,
    Reference,
    Start,
    Variable,
    elements,
)
from acausal.modeling.modifiers import is_open, start_of, value_of

Signal = Reference
"""A causal input or output, as an endpoint of a connection."""


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
        "_bindings",
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

    DISCRETE: ClassVar[tuple[str, ...]] = ()
    """Discrete variables of the Modelica class that this class does without; files may give their starts."""

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
    _bindings: list[Eq]

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
            _bindings=[],
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
                    declared_as = value._name if isinstance(value, Connector) else value.name
                    check_name(base, name, declared_as, _is_taken)
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
                    names = [endpoint_label(s[0]) if s else "an empty vector" for s in (a, b)]
                    raise ConnectionError(
                        f"{names[0]} and its fellows are {len(a)} signals, {names[1]} and its {len(b)}"
                    )
                for x, y in zip(a, b, strict=True):
                    self.connect(x, y)
            elif isinstance(a, Sequence):
                raise _unlike_sizes(a, b)
            elif isinstance(b, Sequence):
                raise _unlike_sizes(b, a)
            else:
                self._join(a, b)

    def modify(self, **modifiers: Any) -> None:
        """Set parameters, options, modules and starts by name, as the constructor does."""
        for name, value in modifiers.items():
            declaration = self._declaration(name)
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
            value = elements(self, name, declared, self._shape(name, declared))
        self.__dict__[name] = value
        return value

    def _declaration(self, name: str) -> Declaration | Connector | None:
        return self._dynamic.get(name) or self._declared.get(name)

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
        for name, declared in {**self._declared, **self._dynamic}.items():
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
                    self._restart(f"{name}.{key}", start_of(f"{where}.{key}", start))
            case Option():
                if declaration.choices is not None and value not in declaration.choices:
                    choices = ", ".join(map(repr, declaration.choices))
                    raise DeclarationError(f"{where}={value!r} is none of {choices}")
                if isinstance(declaration.default, bool) and not isinstance(value, bool):
                    raise DeclarationError(f"{where}={value!r}: True or False is needed")
                self._options[name] = value
            case Variable():
                self._restart(name, start_of(where, value))
            case Module():
                if not callable(value) and not isinstance(value, ModuleReference):
                    raise DeclarationError(
                        f"{where} needs a module or a function key -> module, got {value!r}"
                    )
                self._modifiers[name] = value
            case Parameter() if is_open(value):
                self._leave_open(name, declaration, value)
            case Parameter():
                self._modifiers[name] = value_of(where, declaration, value)
                if declaration.shape is not None:  # its size may have changed
                    self.__dict__.pop(name, None)
                    if name in self._dynamic:
                        self._read(declaration)
            case _:
                raise DeclarationError(f"{where} cannot be modified")

    def _leave_open(self, name: str, declared: Parameter, value: Start | sp.Expr) -> None:
        """Make a variable of a parameter that is found at the initial time, or follows from such ones."""
        given = {"unit": declared.unit, "doc": declared.doc}
        self.__dict__.pop(name, None)
        if isinstance(value, Start):
            guess = declared.default if value.value is None else value.value
            object.__setattr__(self, name, self._add(name, InitialParameter(0.0, **given)))
            self._restart(name, start_of(f"{self._label()}.{name}", Start(guess, fixed=False)))
        else:
            object.__setattr__(self, name, self._add(name, DependentParameter(**given)))
            owner = next(r.owner for r in value.free_symbols if isinstance(r, Reference))
            owner._bindings.append(Eq(getattr(self, name), value))
            self._modifiers[name] = value

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
                    f"{endpoint_label(end)} is not a connector; connect({endpoint_label(a)}, {endpoint_label(b)})"
                )
        if isinstance(a, Connector) != isinstance(b, Connector):
            raise ConnectionError(
                f"unlike connectors: {endpoint_label(a)} and {endpoint_label(b)}; one is a signal"
            )
        if a is b:
            raise ConnectionError(f"{endpoint_label(a)} is connected to itself")
        if isinstance(a, Connector) and a.kind() != b.kind():
            raise ConnectionError(
                f"unlike connectors: {endpoint_label(a)} and {endpoint_label(b)} carry {_carried(a)} "
                f"and {_carried(b)}; "
                "only connectors of one domain can be joined"
            )
        self._connections.append((a, b))


def _is_taken(name: str) -> bool:
    return name in _OWN or hasattr(Component, name)


def _is_list_of_parts(value: Any) -> bool:
    if not isinstance(value, list | tuple) or not value:
        return False
    parts = cast(Sequence[Any], value)
    return all(
        isinstance(v, Component | Connector | Declaration) or _is_list_of_parts(v) for v in parts
    )


def _is_signal(value: Any) -> bool:
    return isinstance(value, Reference) and isinstance(value.declaration, Input | Output)


def _condition(when: str) -> str:
    return f"{when.removeprefix('not ')}={not when.startswith('not ')}"


def _unlike_sizes(vector: Sequence[Any], single: Any) -> ConnectionError:
    names = f"{endpoint_label(vector[0])} is" if vector else "an empty vector has no"
    return ConnectionError(
        f"{names} an element of a vector of {len(vector)}, {endpoint_label(single)} is single; connect one element"
    )


def _carried(connector: Connector) -> str:
    """The variables of a connector with their units, for a message."""
    return ", ".join(f"{name} [{d.unit or '1'}]" for name, d in connector.declarations.items())


def endpoint_label(end: Any) -> str:
    """What messages call an end of a connection."""
    if isinstance(end, Reference):
        path = end.owner._path()
        return f"{path}.{end.path}" if path else end.path
    return repr(end)
