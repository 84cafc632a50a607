"""Layout: the numbers of all components, variables, parameters and modules of a component tree."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from typing import Any, TypeVar, cast

import numpy as np

from acausal.errors import DeclarationError, nearest
from acausal.flattening.leaves_caches import LeavesCaches
from acausal.flattening.reading import equations_of, read_statements
from acausal.flattening.silent import deciding, silent_parameters
from acausal.flattening.stated import Stated, asks_for_events, with_events
from acausal.flattening.template import Integers
from acausal.modeling import (
    Assert,
    Component,
    Connector,
    Declaration,
    Module,
    Option,
    Parameter,
    Reference,
    Variable,
    charge,
    element_names,
    full_name,
    owner_and_name,
)

Numbers = np.ndarray[Any, np.dtype[np.float64]]
Flags = np.ndarray[Any, np.dtype[np.bool_]]
T = TypeVar("T", bound=np.generic)


@dataclass(frozen=True)
class Form(LeavesCaches):
    """The local names that all instances of one class with the same structural choices share.

    Attributes:
        variables, parameters, modules: local path and declaration, in order of declaration.
        connectors: local name -> (class, index of its first variable).
        prototype: one of the instances; its equations are those of all.
    """

    prototype: Component
    variables: tuple[tuple[str, Variable], ...]
    parameters: tuple[tuple[str, Parameter], ...]
    modules: tuple[tuple[str, Module], ...]
    connectors: dict[str, tuple[type[Connector], int]]

    @cached_property
    def variable_index(self) -> dict[str, int]:
        """Local path of a variable -> its local index."""
        return {path: i for i, (path, _) in enumerate(self.variables)}

    @cached_property
    def parameter_index(self) -> dict[str, int]:
        """Local path of a parameter -> its local index."""
        return {path: i for i, (path, _) in enumerate(self.parameters)}

    @cached_property
    def module_index(self) -> dict[str, int]:
        """Local path of a module -> its local index."""
        return {path: i for i, (path, _) in enumerate(self.modules)}


@dataclass(frozen=True)
class Layout(LeavesCaches):
    """The components of a model and the numbers of everything that they declare.

    Attributes:
        components, paths: every component, parents before children, and its dotted path.
        forms: the distinct forms; ``form_of[i]`` is the index of component i's form.
        variable_base: ``variable_base[i]`` is the index of component i's first variable; the last entry is the total.
        parameter_base, module_base: likewise.
    """

    components: tuple[Component, ...]
    paths: tuple[str, ...]
    forms: tuple[Form, ...]
    form_of: Integers
    variable_base: Integers
    parameter_base: Integers
    module_base: Integers

    @cached_property
    def position(self) -> dict[int, int]:
        """``id`` of a component's node -> the component's number."""
        return {id(c._node): i for i, c in enumerate(self.components)}

    @cached_property
    def number(self) -> dict[str, int]:
        """Dotted path of a component -> its number."""
        return {path: i for i, path in enumerate(self.paths)}

    def form(self, component: int) -> Form:
        """Form of a component."""
        return self.forms[self.form_of[component]]

    def variable(self, index: int) -> str:
        """Dotted name of a variable."""
        return self._name(*self._variable(index))

    def parameter(self, index: int) -> str:
        """Dotted name of a parameter."""
        return self._name(*self._parameter(index))

    def module(self, index: int) -> str:
        """Dotted name of a module."""
        component, local = _located(index, self.module_base)
        return self._name(component, self.form(component).modules[local])

    def variable_declaration(self, index: int) -> Variable:
        """Declaration of a variable."""
        return self._variable(index)[1][1]

    def parameter_declaration(self, index: int) -> Parameter:
        """Declaration of a parameter."""
        return self._parameter(index)[1][1]

    def find_variable(self, name: str) -> int | None:
        """Index of the variable of that dotted name, or None."""
        return self._find(name, self.variable_base, lambda form: form.variable_index)

    def find_parameter(self, name: str) -> int | None:
        """Index of the parameter of that dotted name, or None."""
        return self._find(name, self.parameter_base, lambda form: form.parameter_index)

    def _find(
        self, name: str, base: Integers, indices: Callable[[Form], Mapping[str, int]]
    ) -> int | None:
        for cut in [*[i for i, c in enumerate(name) if c == "."][::-1], -1]:
            component = self.number.get(name[: max(cut, 0)])
            if component is not None:
                local = indices(self.form(component)).get(name[cut + 1 :])
                if local is not None:
                    return int(base[component]) + local
        return None

    def _variable(self, index: int) -> tuple[int, tuple[str, Variable]]:
        """Component, local path and declaration of a variable."""
        component, local = _located(index, self.variable_base)
        return component, self.form(component).variables[local]

    def _parameter(self, index: int) -> tuple[int, tuple[str, Parameter]]:
        """Component, local path and declaration of a parameter."""
        component, local = _located(index, self.parameter_base)
        return component, self.form(component).parameters[local]

    def _name(self, component: int, declared: tuple[str, Declaration]) -> str:
        return full_name(self.paths[component], declared[0])


def lay_out(model: Component, *, watch: bool = False) -> tuple[Layout, tuple[Stated, ...]]:
    """Number the components of a tree and everything that they declare.

    Arguments:
        model: the tree.
        watch: whether conditions that are events in models with others are events in any case.

    Returns:
        The layout, and what the components of each form state: watched conditions are variables, too.
    """
    components: list[Component] = []
    paths: list[str] = []
    stack: list[tuple[Component, str]] = [(model, "")]
    while stack:
        component, path = stack.pop()
        components.append(component)
        paths.append(path)
        node = component._node
        for part in node.early_modifiers:  # of parts that were never made
            names = [*node.class_declarations, *node.children]
            raise DeclarationError(f"{node.label} has no '{part}': {nearest(part, names)}")
        prefix = f"{path}." if path else ""
        stack.extend((child, prefix + name) for name, child in reversed(node.children.items()))

    forms: list[Form] = []
    known: dict[Hashable, int] = {}
    form_of = np.empty(len(components), dtype=np.int64)
    number: dict[int, int] = {}
    for i in range(len(components) - 1, -1, -1):  # children before parents
        component = components[i]
        node = component._node
        children = tuple((n, number[id(c._node)]) for n, c in node.children.items())
        key = _structure(component), children
        if key not in known:
            known[key] = len(forms)
            forms.append(_form(component))
        form_of[i] = number[id(node)] = known[key]
        form = forms[known[key]]
        charge("elements", len(form.variables) + len(form.parameters), node)

    connected = _connected_signals(components, number)
    forms, statements = _with_statements(forms, number, connected, watch)

    def base(sizes: list[int]) -> Integers:
        return np.concatenate([[0], np.cumsum(np.asarray(sizes, dtype=np.int64)[form_of])])

    layout = Layout(
        components=tuple(components),
        paths=tuple(paths),
        forms=tuple(forms),
        form_of=form_of,
        variable_base=base([len(f.variables) for f in forms]),
        parameter_base=base([len(f.parameters) for f in forms]),
        module_base=base([len(f.modules) for f in forms]),
    )
    return layout, statements


def _connected_signals(
    components: Sequence[Component], number: Mapping[int, int]
) -> Iterator[tuple[Hashable, Hashable]]:
    """Pairs of signals that are connected, each by the form of its owner and its name there."""
    for component in components:
        for ends in component._node.connections:
            if not isinstance(ends[0], Connector):
                (a, first), (b, second) = map(owner_and_name, ends)
                yield (number.get(id(a)), first), (number.get(id(b)), second)


def _with_statements(
    forms: list[Form],
    number: Mapping[int, int],
    connected: Iterable[tuple[Hashable, Hashable]],
    watch: bool,
) -> tuple[list[Form], tuple[Stated, ...]]:
    """The forms with the hidden variables of their events, and what they state.

    Arguments:
        number: that of the form of each component, by the identity of its node. connected: signals.
    """

    def variable(symbol: Any) -> Hashable:
        is_own = isinstance(symbol, Reference) and id(symbol.owner) in number
        return (number[id(symbol.owner)], symbol.path) if is_own else symbol

    read: list[list[Any]] = []
    asserted: list[tuple[Assert, ...]] = []
    for form in forms:
        own = read_statements(form.prototype, lambda p=form.prototype: equations_of(p), 1)
        asserted.append(tuple(one for one in own if isinstance(one, Assert)))
        read.append([one for one in own if not isinstance(one, Assert)])
    pairs = list(zip(forms, read, strict=True))
    watched = watch or any(
        asks_for_events((v for _, v in form.variables), stated) for form, stated in pairs
    )
    every = itertools.chain.from_iterable(read)
    decide = deciding(every, variable, connected) if watched else set[int]()
    statements = [
        replace(
            with_events(form.prototype, stated, decide) if watched else Stated(tuple(stated)),
            silent=silent_parameters(form.prototype, stated, decide, with_events=watched),
            assertions=must_hold,
        )
        for (form, stated), must_hold in zip(pairs, asserted, strict=True)
    ]
    if not watched:
        return forms, tuple(statements)
    extended = [
        replace(form, variables=(*form.variables, *stated.hidden))
        for form, stated in zip(forms, statements, strict=True)
    ]
    return extended, tuple(statements)


def _located(index: int, base: Integers) -> tuple[int, int]:
    """The component that a number belongs to, and the local index there."""
    component = int(np.searchsorted(base, index, side="right")) - 1
    return component, index - int(base[component])


def members_of_forms(layout: Layout) -> list[Integers]:
    """For every form, the components that have it."""
    order = np.argsort(layout.form_of, kind="stable")
    bounds = np.searchsorted(layout.form_of[order], np.arange(len(layout.forms) + 1))
    return [order[a:b] for a, b in itertools.pairwise(bounds)]


def tiled(
    layout: Layout, base: Integers, local: Iterable[Sequence[Any]], dtype: type[T]
) -> np.ndarray[Any, np.dtype[T]]:
    """Spread values from the forms to all their instances.

    Arguments:
        base: for each component, the index of its first value in the result; one more entry, the total.
        local: for each form, its values.
    """
    flat = np.empty(int(base[-1]), dtype=dtype)
    for members, values in zip(members_of_forms(layout), local, strict=True):
        if len(values):
            flat[base[members][:, None] + np.arange(len(values))] = np.asarray(values, dtype=dtype)
    return flat


def _structure(component: Component) -> Hashable:
    """Everything, besides its parts, that decides a component's declarations and equations."""
    node = component._node
    for name, value in node.constants.items():
        if _holds_parts(value):
            raise DeclarationError(
                f"{node.label}.{name} holds components that are not part of the model; "
                "assign them as attributes, or as one list that is complete"
            )
    options = tuple((k, _frozen(v)) for k, v in sorted(node.options.items()))
    constants = tuple((k, _frozen(v)) for k, v in sorted(node.constants.items()))
    own = tuple((k, type(v), *_attributes(v)) for k, v in node.own_declarations.items())
    sizes = tuple((k, np.shape(v)) for k, v in node.modifiers.items() if isinstance(v, np.ndarray))
    bindings = tuple(id(equation) for equation in node.bindings)
    return type(component), options, constants, own, sizes, bindings


def _attributes(declared: Declaration | Connector) -> tuple[Hashable, ...]:
    """The attributes of a declaration that decide the form; they do not depend on the instance that made it."""
    if isinstance(declared, Connector):
        return (declared._when,)
    return tuple((k, _frozen(v)) for k, v in sorted(vars(declared).items()))


def _holds_parts(value: Any) -> bool:
    if isinstance(value, Mapping):
        return _holds_parts(list(value.values()))
    if isinstance(value, list | tuple | set | frozenset):
        return any(
            (isinstance(v, Component) and v._node.parent is None) or _holds_parts(v) for v in value
        )
    return False


def _frozen(value: Any) -> Hashable:
    if value is None or isinstance(value, bool | int | float | str):
        return type(value).__name__, value
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, list | tuple):
        return tuple(_frozen(v) for v in cast(Sequence[Any], value))
    if is_dataclass(value) and not isinstance(value, type):
        return type(value), *(_frozen(getattr(value, f.name)) for f in fields(value))
    return id(value)


def _form(component: Component) -> Form:
    variables: list[tuple[str, Variable]] = []
    parameters: list[tuple[str, Parameter]] = []
    modules: list[tuple[str, Module]] = []
    connectors: dict[str, tuple[type[Connector], int]] = {}
    for name, declared in component._node.declarations():
        match declared:
            case Connector():
                connectors[name] = (type(declared), len(variables))
                variables += [(f"{name}.{key}", d) for key, d in declared.declarations.items()]
            case Variable():
                variables += [(path, declared) for path in element_paths(component, name, declared)]
            case Parameter():
                parameters += [
                    (path, declared) for path in element_paths(component, name, declared)
                ]
            case Module():
                modules.append((name, declared))
            case Option():
                pass
            case _:
                raise DeclarationError(
                    f"{component._node.label}.{name}: a bare Declaration declares nothing"
                )
    return Form(component, tuple(variables), tuple(parameters), tuple(modules), connectors)


def element_paths(component: Component, name: str, declaration: Declaration) -> list[str]:
    """Local paths of a declaration: one, or one for every element of a vector or matrix."""
    return element_names(name, component._node.shape(name, declaration))


def declared(layout: Layout, role: type) -> Integers:
    """Indices of all variables declared as ``role``, in order."""
    local = [[isinstance(v, role) for _, v in form.variables] for form in layout.forms]
    return np.flatnonzero(tiled(layout, layout.variable_base, local, np.bool_))
