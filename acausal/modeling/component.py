"""Components: the tree that a user builds, and connects with `Component.connect`."""

from __future__ import annotations

import copy
import itertools
from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from typing import Any, ClassVar, Self, cast

from acausal.errors import ConnectionError, DeclarationError, like, nearest, need_text, shown
from acausal.modeling.budget import charge
from acausal.modeling.connector import Connector, check_name
from acausal.modeling.declarations import Declaration, element_name, is_number
from acausal.modeling.documentation import (
    DocumentationOf,
    SignatureOf,
    check_positional,
)
from acausal.modeling.endpoints import Endpoint, check_lengths, check_pair, is_vector
from acausal.modeling.icon import Icon, Shape
from acausal.modeling.modifiers import record_modifier
from acausal.modeling.node import Node
from acausal.modeling.replacing import replace_part
from acausal.modeling.summary import summary
from acausal.modeling.symbols import Eq

SLIP = 0.8
"""A name with this share of the letters of a parameter's is taken for a slip of it."""


class Component:
    """A part of a model: its declarations are class attributes, its parts instance attributes.

    A leaf states its relations in `equations`; a composite assigns components to attributes (or lists of
    components) in ``__init__`` and joins them with `connect`; one class may do both.

    Arguments:
        modifiers: by name, a value for a parameter, option or module; a `Start` for a variable;
            a mapping of modifiers for a part.

    Raises:
        DeclarationError: for an unknown name, a value of the wrong kind or outside an option's choices.
    """

    UNUSED: ClassVar[tuple[str, ...]] = ()
    """What the Modelica class has and this class lacks, as it changes no result; files may modify it."""

    OUTER: ClassVar[Mapping[str, str]] = {}
    """Parameters that a file need not give: by name, the value in the nearest enclosing model, ``planarWorld.g``."""

    ICON: ClassVar[Icon | None] = None
    """How diagrams show it; a class without one is a box with the class's name."""

    _units_bind: ClassVar[bool] = True
    """Whether unlike units are refused; otherwise there is a warning."""

    _declared: ClassVar[dict[str, Declaration | Connector]] = {}

    __signature__ = SignatureOf()
    """What can be given where a component is made, for `help` and editors."""

    _node: Node[Component]
    """The component's record; all other attributes belong to the class's author."""

    def __new__(cls, *args: Any, **kwargs: Any) -> Self:
        """An empty component; nothing depends on a subclass calling ``super().__init__``."""
        check_positional(cls, args)
        charge("components", 1, cls.__name__)
        self = super().__new__(cls)
        self.__dict__["_node"] = Node(self, cls._declared)
        return self

    def __init__(self, /, **modifiers: Any) -> None:
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
                    _refuse_hidden_connector(base, name, declared.get(name), value)
                    declared[name] = value
                elif name in declared:
                    _refuse_hidden_connector(base, name, declared[name], value)
                    del declared[name]
        cls._declared = declared
        text = vars(cls).get("__doc__")
        if isinstance(text, str):
            cls.__doc__ = DocumentationOf(text)  # pyright: ignore[reportAttributeAccessIssue]

    # -- for subclasses --------------------------------------------------------------------------

    def equations(self) -> Iterable[Eq]:
        """The component's equations; a subclass extends its base's by ``yield from super().equations()``."""
        return ()

    def initial_equations(self) -> Iterable[Eq]:
        """Equations that hold at the initial time only."""
        return ()

    def shapes(self) -> Iterable[Shape]:
        """What the component looks like in an animation of the mechanism; nothing by default."""
        return ()

    # -- for users -------------------------------------------------------------------------------

    def connect(self, *endpoints: Endpoint | Sequence[Endpoint]) -> None:
        """Connect two or more connectors (or signals, or equally long lists of them) in one node.

        Potentials become equal, flows sum to zero; of signals exactly one is the source.

        Raises:
            ConnectionError: if they are of unlike kind, are the same, or are not connectors.
        """
        if len(endpoints) < 2:
            raise ConnectionError(f"connect needs at least two connectors, got {len(endpoints)}")
        for a, b in itertools.pairwise(endpoints):
            if is_vector(a) or is_vector(b):
                check_lengths(a, b)
                for x, y in zip(
                    cast(Sequence[Endpoint], a), cast(Sequence[Endpoint], b), strict=True
                ):
                    self.connect(x, y)
            else:
                check_pair(a, b)
                charge("equations", 1, self._node)
                self._node.connections.append((cast(Endpoint, a), cast(Endpoint, b)))

    def modify(self, /, **modifiers: Any) -> None:
        """Set parameters, options, modules and starts by name, as the constructor does."""
        node = self._node
        for name, value in modifiers.items():
            declared = node.declaration(name)
            if declared is not None:
                record_modifier(node, name, declared, value)
            elif name in node.children and isinstance(value, Mapping):
                node.children[name].modify(**value)
            elif isinstance(value, Mapping) and not hasattr(type(self), name):
                node.early_modifiers[name] = cast(Mapping[str, Any], value)
            else:
                known = [*self._declared, *node.own_declarations, *node.children]
                raise DeclarationError(f"{node.label} has no '{name}': {nearest(name, known)}")

    def is_given(self, name: str) -> bool:
        """Whether the model around gives a variable its value, so that an equation for it by default is left out."""
        return f"given {name}" in self._node.constants

    def replace(self, path: str, part: Component) -> Self:
        """A copy of the model with another part in the place of one, and the same connections.

        A trained law for a damper of a finished model: ``model.replace("suspension.damper", neural.Resistance())``.

        Arguments:
            path: of the part that goes, such as ``"suspension.damper"`` or ``"wheel[2].tyre"``.
            part: in its place; it has the connectors and signals that are connected. Its values are its own.

        Raises:
            DeclarationError: if there is no such part, the new one is in a model already, or a value elsewhere depends
                on the one that goes.
            ConnectionError: if the new part lacks what is connected, or it is of another kind.
        """
        if not isinstance(part, Component):
            raise DeclarationError(
                f"replace: {shown(part)} is not a component, such as {type(self).__name__}()."
            )
        need_text(path, "replace: path", DeclarationError)
        model = copy.deepcopy(self)
        replace_part(model._node, path, part._node)
        return model

    # -- attributes ------------------------------------------------------------------------------

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._declared:
            self.modify(**{name: value})
        elif isinstance(value, Component | Connector | Declaration):
            self._claim(name)
            object.__setattr__(self, name, self._add(name, value))
        elif _is_list_of_parts(value):
            self._claim(name)
            object.__setattr__(self, name, self._add_all(name, value))
        else:
            if name not in self._node.constants:
                self._claim(name, is_new=hasattr(Component, name))
                if self._node.parent is not None and is_number(value):
                    self._refuse_slip(name)
            self._node.constants[name] = value
            object.__setattr__(self, name, value)

    def __delattr__(self, name: str) -> None:
        node = self._node
        if any(part == name or part.startswith(f"{name}[") for part in node.children):
            raise DeclarationError(
                f"{node.label}.{name} cannot be removed, as others may be connected to it: make the model without it, "
                "or give another part in its place (replace)."
            )
        object.__delattr__(self, name)
        node.constants.pop(name, None)

    def _refuse_slip(self, name: str) -> None:
        """Refuse a number under a name that is like a parameter's, and of nothing: it would be ignored."""
        known = [*self._declared, *self._node.own_declarations]
        if name.startswith("_") or hasattr(type(self), name):
            return
        of_library = type(self).__module__.startswith("acausal.components.")
        if of_library or like(name, known, SLIP):
            raise DeclarationError(f"{self._node.label} has no '{name}': {nearest(name, known)}")

    def _claim(self, name: str, is_new: bool = True) -> None:
        """Make sure that a name is free; unless ``is_new``, it may be that of a default of the class."""
        if not name.isidentifier():
            raise DeclarationError(
                f"'{name}' is not a name for a part: letters, digits and underscores only"
            )
        if name == "time":
            raise DeclarationError("'time' is the time; choose another name")
        if name in self.__dict__:
            raise DeclarationError(
                f"{self._node.label} has a '{name}' already; choose another name"
            )
        if is_new and hasattr(type(self), name):
            stated = name in ("equations", "initial_equations")
            raise DeclarationError(
                f"'{name}' is an attribute of class {type(self).__name__}; "
                + (
                    f"define it: def {name}(self): yield ac.Eq(...)"
                    if stated
                    else "choose another name"
                )
            )

    def _add_all(self, name: str, parts: Sequence[Any], *index: int) -> list[Any]:
        """Parts of a list, and of lists in it, named as Modelica does: ``parts[1]``, ``parts[2,1]``."""
        added: list[Any] = []
        for i, part in enumerate(parts):
            if isinstance(part, list | tuple):
                added.append(self._add_all(name, cast(Sequence[Any], part), *index, i))
            else:
                added.append(self._add(element_name(name, (*index, i)), part))
        return added

    def _add(self, name: str, part: Component | Connector | Declaration) -> Any:
        if not isinstance(part, Component):
            return self._node.declare(name, part)
        above, below = self._node, part._node
        if below.parent is not None:
            raise DeclarationError(
                f"'{name}': this {type(part).__name__} is already '{below.path}'; make a second one"
            )
        if below is above or below in above.ancestors():
            raise DeclarationError(f"'{name}': a component cannot contain itself")
        below.parent, below.name = above, name
        above.children[name] = part
        part.modify(**above.early_modifiers.pop(name, {}))
        return part

    def __getattr__(self, name: str) -> Any:
        """Refuse a name that the component lacks; type checkers accept parts that ``__init__`` assigns."""
        if name.startswith("_") or hasattr(type(self), name):  # a property's own error
            return object.__getattribute__(self, name)
        known = [n for n in (*self._declared, *vars(self), *dir(self)) if not n.startswith("_")]
        reason = f"{self._node.label} has no '{name}': {nearest(name, dict.fromkeys(known))}"
        raise AttributeError(reason, name=name)  # with its name, so that Python adds no guess

    def __copy__(self) -> Self:
        """A component of its own, with parts of its own: as `copy.deepcopy`."""
        return copy.deepcopy(self)

    def _read(self, declared: Declaration | Connector) -> Any:
        """Called by the declarations of the class when they are read on an instance."""
        return self._node.read(declared)

    def __repr__(self) -> str:
        return summary(self._node)

    def _repr_html_(self) -> str:
        # Views lie in a room above, which draws; only a notebook asks for them.
        return import_module("acausal.reporting").component_view(self)


def _is_taken(name: str) -> bool:
    return name == "_node" or hasattr(Component, name)


def _refuse_hidden_connector(cls: type, name: str, hidden: Any, value: Any) -> None:
    if isinstance(hidden, Connector) and not isinstance(value, Connector):
        kind = type(value).__name__
        raise DeclarationError(
            f"{cls.__name__}.{name}: this {kind} would hide the connector '{name}' that the class inherits; "
            "choose another name"
        )


def _is_list_of_parts(value: Any) -> bool:
    if not isinstance(value, list | tuple) or not value:
        return False
    parts = cast(Sequence[Any], value)
    return all(
        isinstance(v, Component | Connector | Declaration) or _is_list_of_parts(v) for v in parts
    )
