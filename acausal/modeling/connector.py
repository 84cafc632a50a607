"""Connectors: the variables through which components meet, one class per domain."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast

from acausal.errors import DeclarationError, nearest
from acausal.modeling.budget import charge
from acausal.modeling.declarations import (
    Declaration,
    Flow,
    Input,
    Output,
    Potential,
    Variable,
    element_names,
)
from acausal.modeling.documentation import DocumentationOf
from acausal.modeling.names import full_name
from acausal.modeling.symbols import Eq, Owner, refer


class Connector:
    """A set of variables through which a component meets others; one class per domain.

    Subclasses declare `Potential` and `Flow` variables. They can also give the names of a two-port of their domain,
    which generic elements use:

    Attributes:
        pair: names of a two-port's two connectors.
        across: name of the difference of the potentials, ``through`` of the flow between them.
        across_unit: unit of the difference, where it differs from the potential's.
        rate: name of the derivative of ``across`` in domains whose potential is a position, else ``None``.
        second_minus_first: whether ``across`` is the second potential minus the first (as in mechanics) or
            the first minus the second.
        power: whether the difference, or its rate where there is one, times the flow is a power.
        COLOR: of its wires in diagrams, such as ``"#3b82c4"``; it must be seen on white and on black.
    """

    pair: ClassVar[tuple[str, str]] = ("port_a", "port_b")
    across: ClassVar[str] = "across"
    through: ClassVar[str] = "through"
    across_unit: ClassVar[str | None] = None
    rate: ClassVar[str | None] = None
    second_minus_first: ClassVar[bool] = False
    power: ClassVar[bool] = True
    COLOR: ClassVar[str] = "#7d8590"

    declarations: ClassVar[dict[str, Variable]] = {}

    def __init__(self, *, when: str | None = None) -> None:
        charge("elements", len(self.declarations), type(self).__name__)
        self._when = when
        self._name = ""
        self._owner: Owner | None = None
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
                check_name(cls, name, value.name, lambda n: hasattr(Connector, n))
                names = element_names(name, cast(tuple[int, ...] | None, value.shape))
                declarations |= dict.fromkeys(names, value)
        cls.declarations = declarations
        text = vars(cls).get("__doc__")
        if isinstance(text, str):
            cls.__doc__ = DocumentationOf(text)  # pyright: ignore[reportAttributeAccessIssue]

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: Any, owner: type) -> Self:
        return self if instance is None else cast(Self, instance._read(self))

    def _bind(self, owner: Owner, name: str) -> Self:
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
            self._references[name] = refer(self._owner, path, declaration, shape)
        return self._references[name]

    @classmethod
    def kind(cls) -> tuple[tuple[str, type, str], ...]:
        """Names, roles and units of the variables: two connectors can be joined if these agree."""
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
        """Equations for further potentials and flows of a two-port, in domains that have them."""
        return ()

    if not TYPE_CHECKING:  # so that type checkers go on to refuse misspelled attributes

        def __getattr__(self, name: str) -> Any:
            """Refuse a name that the connector lacks."""
            if name.startswith("_") or hasattr(type(self), name):
                return object.__getattribute__(self, name)
            reason = f"{self!r} has no '{name}': {nearest(name, self.declarations)}"
            raise AttributeError(reason, name=name)

    def __repr__(self) -> str:
        path = "" if self._owner is None else self._owner.path
        return f"{full_name(path, self._name)} ({type(self).__name__})"


def _role(declaration: Variable) -> type:
    return next(r for r in (Potential, Flow, Input, Output, Variable) if isinstance(declaration, r))


def check_name(cls: type, name: str, declared: str, taken: Callable[[str], bool]) -> None:
    """A declaration's name must be its own, and may not hide what the framework needs (``taken``)."""
    if declared != name:
        raise DeclarationError(
            f"{cls.__name__}: '{name}' and '{declared}' are one declaration; make a second one"
        )
    if name == "time":
        raise DeclarationError(f"{cls.__name__}: 'time' is the time; choose another name")
    if taken(name):
        raise DeclarationError(
            f"{cls.__name__}: '{name}' is an attribute of every component; choose another name"
        )
