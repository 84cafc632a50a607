"""Components of classes that Modelica text defines: one Python class for each, with the equations of the text."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, cast

import numpy as np
import sympy as sp

from acausal.errors import DeclarationError, nearest, shortened
from acausal.modelica import statements
from acausal.modelica.classes import ClassNode
from acausal.modelica.connectors import connector
from acausal.modelica.expandable import expand
from acausal.modelica.functions import Interpreter
from acausal.modelica.library_parts import make_part, modify_part
from acausal.modelica.meanings import Native
from acausal.modelica.modifications import (
    Bound,
    Given,
    Index,
    Modification,
    fields_of,
    given_in,
    modification,
    redeclared_class,
)
from acausal.modelica.operators import Frame, number_or_truth
from acausal.modelica.outer import inner_of
from acausal.modelica.overconstrained import ConnectionGraph, Edge
from acausal.modelica.rules import check_replacement
from acausal.modelica.syntax import ClassDefinition, LiteralConstant, ModificationSyntax
from acausal.modelica.types import Type, is_component, type_of_declared
from acausal.modelica.values import ABSENT, FoundOnce, Record, as_array, of
from acausal.modelica.variables import declare, sizes_of
from acausal.modelica.views import Entry
from acausal.modeling import (
    Component,
    Connector,
    Discrete,
    DiscreteOutput,
    Output,
    Reference,
    Variable,
    charge,
    element_name,
)

MAX_DEPTH = 60


class ModelicaModel(Component):
    """A component whose class is Modelica text.

    Arguments:
        given: modifiers from outside. above: the component that it is a part of.
        modifiers: by name, values for parameters, as for every component.
    """

    _class: ClassVar[ClassNode] = cast(ClassNode, None)
    _build: Build
    _units_bind: ClassVar[bool] = False
    """Units are attributes in Modelica, which need not agree."""

    def __init__(
        self,
        /,
        *,
        _given: Sequence[Given] = (),
        _above: Build | None = None,
        _variability: str = "",
        _name: str = "",
        **modifiers: Any,
    ) -> None:
        own = [
            Given(
                name,
                ModificationSyntax([], LiteralConstant(value, 0)),
                Frame(self._class),
                self._class.definition.at,
            )
            for name, value in modifiers.items()
            if name in self._class.view().entries and isinstance(value, int | float | str | list)
        ]
        build = Build(self, self._class, [*own, *_given], _above)
        build.variability, build.name = _variability, _name
        self.__dict__["_build"] = build
        build.make(super().__init__)
        self.modify(**{n: v for n, v in modifiers.items() if n not in {g.name for g in own}})

    @property
    def document(self) -> dict[str, Any]:
        """The times of the experiment that the text states."""
        names = {"StartTime": "start_time", "StopTime": "stop_time"}
        stated = self._class.definition.experiment
        frame = Frame(self._class)
        return {names[k]: Interpreter(frame).value(v) for k, v in stated.items() if k in names}

    def modify(self, /, **modifiers: Any) -> None:
        """Set parameters, options, modules and starts by name, as the constructor does.

        Raises:
            DeclarationError: for a value by which what was decided when the text was read would be another.
        """
        known = self._node.modifiers
        saved = dict(known)
        super().modify(**modifiers)
        try:
            for name in modifiers:
                self._need_its_structure(name)
        except DeclarationError:
            known.clear()
            known.update(saved)
            raise

    def _need_its_structure(self, name: str) -> None:
        for text, (expression, before) in self._build.deciding.get(name, {}).items():
            if (now := number_or_truth(expression, f"'{name}'", {})) != before:
                how = f"ac.import_modelica(...).{type(self).__name__}({name}=...)"
                raise DeclarationError(
                    f"'{name}' decided a structure when the text was read: '{shortened(text)}' was {before} and "
                    f"would be {now}; give it when the component is made: {how}"
                )

    def equations(self) -> Iterator[Any]:
        """The equations of the text, and those of variables that are given a value."""
        yield from super().equations()
        yield from statements.equations(self._build)

    def initial_equations(self) -> Iterator[Any]:
        """The initial equations of the text."""
        yield from super().initial_equations()
        yield from statements.initial_equations(self._build)


def class_of(node: ClassNode) -> type[ModelicaModel]:
    """The Python class of a class.

    Raises:
        ModelicaError: for a class that is no model.
    """
    if node.python is None:
        kind, view = node.definition.kind, node.view()
        if kind not in ("model", "block", "class", "record"):
            raise node.refused(f"'{node.definition.name}' is a {kind}, not a model")
        natives = [n.cls for n, _ in view.natives if is_component(n.cls)]
        if len(natives) < len(view.natives):
            raise node.refused(
                f"'{node.definition.name}' extends a signal or a connector, and has more"
            )
        bases = [
            b
            for i, b in enumerate(natives)
            if not any(issubclass(c, b) for c in (*natives[:i], *natives[i + 1 :]) if c is not b)
            and b not in natives[:i]
        ]
        attributes = {"_class": node, "__module__": __name__, "__doc__": node.definition.comment}
        attributes |= _discrete_outputs(node, bases)
        node.python = type(node.definition.name, (ModelicaModel, *bases), attributes)
    return node.python


def _discrete_outputs(node: ClassNode, bases: list[type[Component]]) -> dict[str, Variable]:
    """The outputs that a class has of classes of libraries, and that its ``when`` gives values."""
    found: dict[str, Variable] = {}
    for name in statements.assigned_at_events(node):
        declared = next((b._declared[name] for b in bases if name in b._declared), None)
        if isinstance(declared, Output) and not isinstance(declared, Discrete):
            kept = {key: getattr(declared, key) for key in ("unit", "shape", "when", "doc")}
            found[name] = DiscreteOutput(**kept)
    return found


class Build:
    """How one component is made of its class, and what its expressions refer to.

    Attributes:
        given: modifiers from outside. above: of the component that it is a part of.
        made: values of names that are no declarations: constants, and parameters that decide a structure.
        types: name -> ``Real``, ``Integer``, ``Boolean``, ``String`` or an enumeration.
        absent: components that their condition leaves out.
        classes: replaceable classes that are redeclared.
        bindings: part, variable and the expression that it equals.
        parts_of_text: its parts whose classes are Modelica text.
        name: of the component in the one around it.
        variability: ``parameter`` or ``constant`` of a record that is declared so.
        connected: whether all connections of the model have been made.
        outer: variables of components around it, and what stands for each here.
        given_inwards: variables of parts that equal one of this component, and that one.
        graph: of the redundant records of a whole model. edges: those of its connections that are made here.
        decided: expressions of parameters that decided what there is, and their values.
        deciding: parameter of this component -> those of them that it is part of, here or elsewhere.
        fixed: of arrays of which some elements alone are fixed at the start, which.
        performs: whether it calls functions of the text or asserts something, which depends on values.
        bound_inputs: inputs that have a value, and are no signals therefore.
        kept: arrays of its variables by name, and what arrays of parts are given, by `id` of the expression.
        counted: how often connectors are connected, by owner and name; not by what `statements.check` adds.
    """

    def __init__(
        self, component: ModelicaModel, node: ClassNode, given: Sequence[Given], above: Build | None
    ) -> None:
        self.component, self.node, self.given, self.above = component, node, list(given), above
        self.made: dict[str, Any] = {}
        self.types: dict[str, str] = {}
        self.absent: set[str] = set()
        self.classes: dict[str, Any] = {}
        self.bindings: list[tuple[Component, str, Bound]] = []
        self.variability, self.name, self.connected = "", "", False
        self.outer: dict[Reference, Reference] = {}
        self.given_inwards: list[tuple[Reference, Reference]] = []
        self.decided: dict[str, float] = {}
        self.deciding: dict[str, dict[str, tuple[sp.Basic, float]]] = {}
        self.counted: dict[Any, int] = {}
        self.fixed: dict[str, Any] = {}
        self.parts_of_text: list[ModelicaModel] = []
        self._making: dict[str, None] = {}
        self.later: list[Callable[[], None]] = []
        self.graph, self.edges = ConnectionGraph(), list[Edge]()
        self.kept, self.bound_inputs, self.performs = FoundOnce(), set[str](), False

    @property
    def entries(self) -> dict[str, Entry]:
        """The components of the class."""
        return self.node.view().entries

    @property
    def names(self) -> Mapping[str, Any]:
        """Components of the class, and what it inherits from a library."""
        children: dict[str, Any] = self.component._node.children
        return ChainMap(self.entries, children, self.component._declared)  # pyright: ignore[reportArgumentType]

    def frame(self, node: ClassNode) -> Frame:
        """Where expressions of a class that it consists of are looked up."""
        return Frame(node, self)

    # -- making ----------------------------------------------------------------------------------------

    def make(self, base: Any) -> None:
        """Begin with the component; ``base`` is the constructor of the classes of libraries that it extends.

        A part is completed when all others have begun, so that modifiers can name members of each other.
        """
        definition = self.node.definition
        if definition.partial:
            self._refuse(
                f"'{definition.name}' is partial; extend it, or redeclare it by a complete class"
            )
        if self._depth > MAX_DEPTH:
            self._refuse(
                f"parts within parts more than {MAX_DEPTH} deep; does '{definition.name}' contain itself?"
            )
        self._redeclare()
        view = self.node.view()
        native = [
            *(g for g in self.given if g.name not in view.entries and g.name not in self.classes),
            *(g for _, own in view.natives for g in given_in(own, self.frame)),
        ]
        if view.natives:
            make_part(type(self.component), native, base)
        elif native:
            raise native[0].wrong(
                f"{definition.name} has no '{native[0].name}'; {nearest(native[0].name, list(view.entries))}"
            )
        else:
            base()
        self.later.insert(0, lambda: modify_part(self, self.component, native))
        if self.above is None:
            self.complete()

    def complete(self) -> None:
        """Make all members that no expression has asked for, connect them, and read what they state."""
        self._make_all()
        expand(self)
        self._connect_all()
        self.graph.cut()
        self._finish()

    def _make_all(self) -> None:
        for name in self.entries:
            self.member(name)
        for part in self.parts_of_text:
            part._build._make_all()
        for modify in self.later:
            modify()
        self._in_order()

    def _connect_all(self) -> None:
        statements.connect(self)
        for part in self.parts_of_text:
            part._build._connect_all()
        self.connected = True

    def _finish(self) -> None:
        for part in self.parts_of_text:
            part._build._finish()
        statements.check(self)
        note_form(self)
        self.given, self.later = [], []

    def _refuse(self, reason: str) -> None:
        if self.above is not None and self.given:
            raise self.given[0].wrong(reason)
        raise self.node.refused(reason)

    @property
    def path(self) -> str:
        """The name of the component with those of the components around it, the model's first."""
        if self.above is None:
            return self.node.definition.name
        return f"{self.above.path}.{self.name}"

    @property
    def _depth(self) -> int:
        return 0 if self.above is None else self.above._depth + 1

    def _redeclare(self) -> None:
        """The classes that stand for replaceable ones."""
        view = self.node.view()
        for one in self.given[::-1]:
            if isinstance(one.redeclared, ClassDefinition):
                own = self.node.member(one.name)
                if own is None:
                    raise one.wrong(f"{self.node.definition.name} has no class '{one.name}'")
                if isinstance(own, ClassNode) and not own.definition.prefixes.replaceable:
                    raise one.wrong(f"'{one.name}' is not replaceable")
                found = redeclared_class(one.redeclared, one.frame)
                if isinstance(own, ClassNode):
                    constraint = own.definition.constraint
                    old = own if constraint is None else own.lookup(constraint.base.words)[0]
                    check_replacement(one.name, found, old, one.wrong)
                self.classes[one.name] = found
        for name, (element, node) in view.classes.items():
            definition = element if isinstance(element, ClassDefinition) else element.redeclared
            assert isinstance(definition, ClassDefinition)
            self.classes.setdefault(name, redeclared_class(definition, self.frame(node)))
        self.node = self.node.with_classes(self.classes)

    def member(self, name: str) -> Any:
        """A component, which is made if it is needed for the first time: its value, references, part or connector.

        Raises:
            ModelicaError: if it depends on itself, or cannot be made.
        """
        if name in self.made:
            return self.made[name]
        if name in self.absent:
            return ABSENT
        entry = self.entries.get(name)
        if entry is None or name in vars(self.component):
            return of(self.component, name)
        if name in self._making:
            circle = " -> ".join([*self._making, name])
            raise entry.wrong(f"{circle}: each depends on the next")
        self._making[name] = None
        try:
            with entry.place():
                self._make(name, entry)
        finally:
            self._making.pop(name, None)
        return self.member(name)

    def _make(self, name: str, entry: Entry) -> None:
        declared, frame = entry.declared, self.frame(entry.node)
        if declared.prefixes.outer:
            self.made[name] = inner_of(self, name, entry)
            if not declared.prefixes.inner:
                return
        given = [*self.given, *given_in(entry.modifiers, self.frame)]
        mod = modification(declared, given, frame)
        if declared.condition is not None:
            interpreter = Interpreter(frame)
            holds = interpreter.truth(interpreter.value(declared.condition))
            if not interpreter.known(holds, "the condition of a component"):
                self.absent.add(name)
                return
        if mod.redeclared is not None:
            declared, frame = mod.redeclared.redeclared, mod.redeclared.frame
        found = type_of_declared(frame, declared)
        if mod.redeclared is not None:
            own = entry.declared
            kind = own.type if own.constraint is None else own.constraint.base
            old, rest = entry.node.lookup(kind.words)
            new, left = frame.find(declared.type.words)
            if not rest and not left:
                check_replacement(name, new, old, mod.redeclared.wrong)
        if found.is_connector and self._needs_causality(entry, found):
            raise entry.wrong(f"'{name}' of a block is input or output")
        sizes = found.sizes(declared.subscripts or entry.declared.subscripts, frame)
        if found.predefined:
            declare(self, name, entry, found, mod, sizes)
        else:
            known = sizes_of(entry, mod.value, sizes)
            value = self.parts(name, entry, found, mod, known)
            self.assign(name, entry, value)

    @staticmethod
    def _needs_causality(entry: Entry, found: Type) -> bool:
        """Whether this is a public connector that a block declares without a causality (section 4.7)."""
        declared = entry.declared
        public = entry.node.definition.kind == "block" and not declared.prefixes.protected
        if found.node is None or found.node.definition.expandable or not public:
            return False
        inner = [e.declared.prefixes.causality for e in found.node.view().entries.values()]
        return not any((declared.prefixes.causality, found.causality, *inner))

    def assign(self, name: str, entry: Entry, value: Any) -> None:
        """Give the component an attribute.

        What belongs to a connector, consists of several, or has a name that Python cannot use is kept here.
        """
        own = hasattr(type(self.component), name) and name not in self.component._declared
        with entry.place():
            if _is_composite(value):
                self.made[name] = value
            elif "." in name or name[0] == "'" or own:
                many = isinstance(value, list)
                add: Any = self.component._add_all if many else self.component._add
                self.made[name] = as_array(add(name, value))
                if own:  # reading a declaration has put it where a method was
                    vars(self.component).pop(name, None)
            else:
                self.component._claim(name)
                setattr(self.component, name, value)

    # -- parts -------------------------------------------------------------------------------------------

    def parts(
        self, name: str, entry: Entry, found: Type, mod: Modification, sizes: list[int]
    ) -> Any:
        """A part or connector, or nested lists of them."""

        def nested(index: Index) -> Any:
            if len(index) < len(sizes):
                size = sizes[len(index)]
                return [nested((*index, (i, size))) for i in range(size)]
            inner = [g.element(index) for g in mod.inner]
            value = mod.value and mod.value.element(index)
            part = self._part(element_name(name, [i for i, _ in index]), entry, found, inner, value)
            if not index and isinstance(part, Component):
                part._node.placement = entry.declared.placement
            return part

        return nested(())

    def _part(
        self, name: str, entry: Entry, found: Type, inner: list[Given], value: Bound | None
    ) -> Any:
        node = found.node
        is_value = node is not None and (node.definition.kind == "record" or found.causality)
        if value is not None and not is_value:
            raise value.wrong(f"'{entry.declared.name}' is a part, which has no value")
        if value is not None and node is not None:
            inner += fields_of(node, value)
        if found.is_connector:
            return connector(self, name, found, inner)
        if node is None:
            if not is_component(found.native):
                raise entry.node.wrong(entry.declared.type.at, "this is not a class of components")
            # the text of a library's class, where it is given a member which the class here lacks
            tree, native = entry.node.tree, Native(found.native, found.full)
            is_replaced = any(g.redeclared is not None for g in inner)
            names = [g.name for g in inner]
            node = tree.text(found.full) if is_replaced else tree.text_with(native, names)
        if node is None:
            part = make_part(found.native, inner)
            self.later.append(lambda: modify_part(self, part, inner))
            return part
        charge("components", 1, entry.declared.name)
        variability = entry.declared.prefixes.variability or self.variability
        part = class_of(node)(_given=inner, _above=self, _variability=variability, _name=name)
        self.parts_of_text.append(part)
        return part

    # -- the record of the component -----------------------------------------------------------------------

    def _in_order(self) -> None:
        """Keep parts and declarations in the order of the text."""
        node = self.component._node
        position = {name: i for i, name in enumerate(self.entries)}

        def place(name: str) -> int:
            return position.get(name.partition("[")[0], -1)

        node.children = dict(sorted(node.children.items(), key=lambda item: place(item[0])))
        own = sorted(node.own_declarations.items(), key=lambda item: place(item[0]))
        node.own_declarations = dict(own)


def _is_composite(value: Any) -> bool:
    """Whether this is a connector of connectors, or a list of such."""
    return isinstance(value, Record) or (isinstance(value, list) and any(map(_is_composite, value)))


def note_form(build: Any) -> None:
    """Make all that decides the equations a constant, so that components with other equations have another form."""
    constants = build.component._node.constants
    for name, value in build.made.items():
        constants[f"value of {name}"] = _plain(value)
    constants["absent"] = tuple(sorted(build.absent))
    constants["classes"] = tuple((n, str(id(c))) for n, c in build.classes.items())
    constants["given inwards"] = tuple(str(id(a)) for a, _ in build.given_inwards)
    constants["cut"] = tuple(edge.cut for edge in build.edges)
    constants["decided"] = tuple(build.decided.items())
    constants["bindings"] = tuple(
        (name, str(id(bound.expression)), bound.index) for _, name, bound in build.bindings
    )


def _plain(value: Any) -> Any:
    """A value as something that can be compared."""
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, Record):
        return [(name, _plain(v)) for name, v in value.fields.items()]
    if isinstance(value, list):
        return [_plain(v) for v in value]
    if isinstance(value, Connector | Reference):
        return None
    return value if isinstance(value, bool | int | float | str) else str(id(value))
