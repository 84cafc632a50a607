"""Flatten: the component tree becomes integer-numbered variables and instances of equation templates."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from functools import cached_property
from typing import Any, cast

import numpy as np
import sympy as sp

from acausal.component import Component, Connector, element_names
from acausal.connections import connection_groups, connection_sets, model_inputs
from acausal.errors import DeclarationError, nearest
from acausal.functions import COMPUTABLE
from acausal.symbols import (
    STATE_SELECT,
    Declaration,
    Eq,
    Module,
    ModuleReference,
    Option,
    Parameter,
    Reference,
    Start,
    Variable,
    der,
    references,
    time,
)
from acausal.template import Binding, EquationGroup, Integers, Template, slot


@dataclass(frozen=True)
class Form:
    """What all instances of one class with the same structural choices share: their local names.

    Attributes:
        variables, parameters, modules: local path and declaration, in order of declaration.
        connectors: local name -> (class, index of its first variable).
        prototype: the first instance met; its equations stand for all.
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
class Layout:
    """Where every component's variables, parameters and modules lie in the flat numbering.

    ``variable_base[i]`` is the index of component i's first variable; the arrays have one more entry, the total.
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
        """``id(component)`` -> its number."""
        return {id(c): i for i, c in enumerate(self.components)}

    @cached_property
    def number(self) -> dict[str, int]:
        """Dotted path of a component -> its number."""
        return {path: i for i, path in enumerate(self.paths)}

    def form(self, component: int) -> Form:
        """Form of a component."""
        return self.forms[self.form_of[component]]

    def variable(self, index: int) -> str:
        """Dotted name of a variable."""
        return self._name(index, self.variable_base, "variables")

    def parameter(self, index: int) -> str:
        """Dotted name of a parameter."""
        return self._name(index, self.parameter_base, "parameters")

    def module(self, index: int) -> str:
        """Dotted name of a module."""
        return self._name(index, self.module_base, "modules")

    def variable_declaration(self, index: int) -> Variable:
        """Declaration of a variable."""
        component = int(np.searchsorted(self.variable_base, index, side="right")) - 1
        return self.form(component).variables[index - int(self.variable_base[component])][1]

    def parameter_declaration(self, index: int) -> Parameter:
        """Declaration of a parameter."""
        component = int(np.searchsorted(self.parameter_base, index, side="right")) - 1
        return self.form(component).parameters[index - int(self.parameter_base[component])][1]

    def find_variable(self, name: str) -> int | None:
        """Index of the variable of that dotted name, or None."""
        for cut in [*[i for i, c in enumerate(name) if c == "."][::-1], -1]:
            component = self.number.get(name[: max(cut, 0)])
            if component is not None:
                local = self.form(component).variable_index.get(name[cut + 1 :])
                if local is not None:
                    return int(self.variable_base[component]) + local
        return None

    def _name(self, index: int, base: Integers, kind: str) -> str:
        component = int(np.searchsorted(base, index, side="right")) - 1
        local = getattr(self.form(component), kind)[index - int(base[component])][0]
        path = self.paths[component]
        return f"{path}.{local}" if path else local


@dataclass(frozen=True)
class FlatModel:
    """A model without hierarchy: numbered variables, and equations as instances of templates.

    Attributes:
        name: class name of the model.
        layout: names of everything.
        groups: all equations, those of connections among them; ``initial``: equations at the initial time.
        inputs: indices of the variables that are the model's inputs.
        start, fixed, nominal, state: (n_variables,) attributes; ``state`` counts from 0 "never" to 4 "always",
            plus 0.5 where the model's author, not the library, asked for it.
        start_given: (n_variables,) whether somebody gave the start as a modifier.
        starts: start values that are expressions of parameters.
        value: (n_parameters,) values (nan where bound); ``bindings``: the bound ones.
        folded: (n_parameters,) parameters left at a default of zero.
        module_values: value or factory of every module; an int refers to another module.
    """

    name: str
    layout: Layout
    groups: tuple[EquationGroup, ...]
    initial: tuple[EquationGroup, ...]
    inputs: Integers
    start: np.ndarray
    fixed: np.ndarray
    nominal: np.ndarray
    state: np.ndarray
    start_given: np.ndarray
    starts: tuple[Binding, ...]
    value: np.ndarray
    bindings: tuple[Binding, ...]
    folded: np.ndarray
    module_values: tuple[Any, ...]

    @property
    def n_variables(self) -> int:
        """Number of variables."""
        return int(self.layout.variable_base[-1])

    @property
    def n_equations(self) -> int:
        """Number of equations, those of connections among them."""
        return sum(len(g) for g in self.groups)


def flatten(model: Component) -> FlatModel:
    """Number the variables of a component tree and instantiate its equations.

    Raises:
        DeclarationError: for a parameter without a value, or an equation that uses what is not in the model.
        ConnectionError: for connections that cannot be made.
    """
    layout = _lay_out(model)
    equations, initial = _instantiate(layout)
    sets = connection_sets(layout)
    start, fixed, nominal, state, given, starts = _variable_attributes(layout)
    value, bindings, folded = _parameter_values(layout)
    return FlatModel(
        name=type(model).__name__,
        layout=layout,
        groups=(*equations, *connection_groups(layout, sets)),
        initial=initial,
        inputs=model_inputs(layout, sets),
        start=start,
        fixed=fixed,
        nominal=nominal,
        state=state,
        start_given=given,
        starts=starts,
        value=value,
        bindings=bindings,
        folded=folded,
        module_values=_module_values(layout),
    )


# -- layout -----------------------------------------------------------------------------------------


def _lay_out(model: Component) -> Layout:
    components: list[Component] = []
    paths: list[str] = []
    stack: list[tuple[Component, str]] = [(model, "")]
    while stack:
        component, path = stack.pop()
        components.append(component)
        paths.append(path)
        if component._pending:
            part = next(iter(component._pending))
            raise DeclarationError(
                f"{component._label()} has no '{part}': {nearest(part, [*component._declared, *component._children])}"
            )
        prefix = f"{path}." if path else ""
        stack.extend(
            (child, prefix + name) for name, child in reversed(component._children.items())
        )

    forms: list[Form] = []
    known: dict[Hashable, int] = {}
    form_of = np.empty(len(components), dtype=np.int64)
    number: dict[int, int] = {}
    for i in range(len(components) - 1, -1, -1):  # children before parents
        component = components[i]
        children = tuple((n, number[id(c)]) for n, c in component._children.items())
        key = _structure(component), children
        if key not in known:
            known[key] = len(forms)
            forms.append(_form(component))
        form_of[i] = number[id(component)] = known[key]

    def base(sizes: list[int]) -> Integers:
        return np.concatenate([[0], np.cumsum(np.asarray(sizes, dtype=np.int64)[form_of])])

    return Layout(
        components=tuple(components),
        paths=tuple(paths),
        forms=tuple(forms),
        form_of=form_of,
        variable_base=base([len(f.variables) for f in forms]),
        parameter_base=base([len(f.parameters) for f in forms]),
        module_base=base([len(f.modules) for f in forms]),
    )


def _structure(component: Component) -> Hashable:
    """What decides a component's declarations and equations, besides its parts."""
    cls = type(component)
    for name, value in component._constants.items():
        if _holds_parts(value):
            raise DeclarationError(
                f"{component._label()}.{name} holds components that are not part of the model; "
                "assign them as attributes, or as one list that is complete"
            )
    options = tuple((k, _frozen(v)) for k, v in sorted(component._options.items()))
    constants = tuple((k, _frozen(v)) for k, v in sorted(component._constants.items()))
    dynamic = tuple((k, type(v), *_attributes(v)) for k, v in component._dynamic.items())
    sizes = tuple(
        (k, np.shape(v)) for k, v in component._modifiers.items() if isinstance(v, np.ndarray)
    )
    return cls, options, constants, dynamic, sizes


def _attributes(declared: Declaration | Connector) -> tuple[Hashable, ...]:
    """What a declaration says, whichever instance made it."""
    if isinstance(declared, Connector):
        return (declared._when,)
    return tuple((k, _frozen(v)) for k, v in sorted(vars(declared).items()))


def _holds_parts(value: Any) -> bool:
    if isinstance(value, Mapping):
        return _holds_parts(list(value.values()))
    if isinstance(value, list | tuple | set | frozenset):
        return any(
            (isinstance(v, Component) and v._parent is None) or _holds_parts(v) for v in value
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
    for name, declared in component._declarations():
        match declared:
            case Connector():
                connectors[name] = (type(declared), len(variables))
                variables += [(f"{name}.{key}", d) for key, d in declared.declarations.items()]
            case Variable():
                variables += [(path, declared) for path in _paths(component, name, declared)]
            case Parameter():
                parameters += [(path, declared) for path in _paths(component, name, declared)]
            case Module():
                modules.append((name, declared))
            case Option():
                pass
            case _:
                raise DeclarationError(
                    f"{component._label()}.{name}: a bare Declaration declares nothing"
                )
    return Form(component, tuple(variables), tuple(parameters), tuple(modules), connectors)


def _paths(component: Component, name: str, declaration: Declaration) -> list[str]:
    return element_names(name, component._shape(name, declaration))


# -- equations ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Slots:
    """Where a template's slots are found, seen from the component that states the equation.

    Each entry is the chain of part names to the owner (empty: the component itself) and the local index there.
    """

    variables: tuple[tuple[tuple[str, ...], int], ...]
    parameters: tuple[tuple[tuple[str, ...], int], ...]
    modules: tuple[tuple[tuple[str, ...], int], ...]


def _instantiate(layout: Layout) -> tuple[tuple[EquationGroup, ...], tuple[EquationGroup, ...]]:
    equations: list[EquationGroup] = []
    initial: list[EquationGroup] = []
    members = _members(layout)
    for number, form in enumerate(layout.forms):
        for found, stated in (
            (equations, form.prototype.equations),
            (initial, form.prototype.initial_equations),
        ):
            for equation in _stated(form.prototype, stated):
                template, slots = _template(layout, form, equation)
                found.append(_fill(layout, template, slots, members[number]))
    order = np.argsort([g.components[0] for g in equations], kind="stable")
    return tuple(equations[i] for i in order), tuple(initial)


def _stated(component: Component, equations: Callable[[], Iterable[Eq]]) -> list[Eq]:
    try:
        return list(equations())
    except (TypeError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        raise DeclarationError(
            f"{component._label()}: its equations cannot be read ({reason}). Yield ac.Eq(left, right) from the "
            "method, and use ac.sin, ac.where, ... for what depends on variables, not math, numpy or if"
        ) from error


def _members(layout: Layout) -> list[Integers]:
    """For every form, the components that have it."""
    order = np.argsort(layout.form_of, kind="stable")
    bounds = np.searchsorted(layout.form_of[order], np.arange(len(layout.forms) + 1))
    return [order[a:b] for a, b in itertools.pairwise(bounds)]


def _template(layout: Layout, form: Form, equation: Eq) -> tuple[Template, _Slots]:
    owner = form.prototype
    if not isinstance(equation, Eq):
        raise DeclarationError(
            f"{owner._label()}: equations() yields {equation!r}; yield ac.Eq(left, right)"
        )
    where = f"{type(owner).__name__}: {equation}"
    residual: Any = _without_der(equation.lhs - equation.rhs, where)
    if residual.has(sp.nan, sp.oo, -sp.oo, sp.zoo, sp.I):
        raise DeclarationError(f"{where}: all numbers in an equation must be real and finite")
    for call in residual.atoms(sp.Function):
        if not isinstance(call, COMPUTABLE):
            raise DeclarationError(
                f"{where}: '{call.func}' cannot be computed; use the functions that acausal exports"
            )
    names: dict[sp.Symbol, sp.Symbol] = {}
    variables: dict[sp.Symbol, tuple[int, tuple[tuple[str, ...], int]]] = {}
    parameters: dict[sp.Symbol, tuple[tuple[str, ...], int]] = {}
    modules: dict[sp.Symbol, tuple[tuple[str, ...], int]] = {}
    for symbol in _symbols(residual):
        if symbol == time:
            continue
        reference, order = (
            (symbol.reference, symbol.order) if isinstance(symbol, _Derived) else (symbol, 0)
        )
        if not isinstance(reference, Reference):
            raise DeclarationError(f"{where}: '{reference}' is not declared")
        chain = _chain(owner, reference, where)
        local = layout.form(layout.position[id(reference.owner)])
        named = slot(".".join((*chain, reference.path)), order)
        names[symbol] = named
        match reference.declaration:
            case Variable():
                variables[named] = order, (chain, local.variable_index[reference.path])
            case Module():
                modules[named] = chain, local.module_index[reference.path]
            case _:
                parameters[named] = chain, local.parameter_index[reference.path]
    template = Template(
        residual=residual.xreplace(names),
        variables=tuple(variables),
        orders=tuple(order for order, _ in variables.values()),
        parameters=tuple(parameters),
        modules=tuple(modules),
        origin=where,
    )
    slots = _Slots(
        tuple(w for _, w in variables.values()), tuple(parameters.values()), tuple(modules.values())
    )
    return template, slots


class _Derived(sp.Symbol):
    """A reference, ``order`` times differentiated, while an equation is being turned into a template."""

    reference: sp.Symbol
    order: int

    def __new__(cls, reference: sp.Symbol, order: int) -> _Derived:
        self = super().__new__(cls, f"der{order}({reference.name})", real=True)
        self.reference, self.order = reference, order
        return self


def _without_der(expression: Any, where: str) -> Any:
    """Replace every ``der`` by derivative symbols, differentiating what stands inside."""
    replaced = {d: _total(_without_der(d.args[0], where)) for d in expression.atoms(der)}
    return expression.xreplace(replaced) if replaced else expression


def _total(expression: sp.Expr) -> sp.Expr:
    """Total time derivative of an expression of references."""
    terms = [expression.diff(time)]
    for symbol in _symbols(expression):
        if isinstance(symbol, _Derived):
            terms.append(expression.diff(symbol) * _Derived(symbol.reference, symbol.order + 1))
        elif isinstance(symbol, Reference) and isinstance(symbol.declaration, Variable):
            terms.append(expression.diff(symbol) * _Derived(symbol, 1))
    return sp.Add(*terms)


def _symbols(expression: sp.Expr) -> list[sp.Symbol]:
    """Free symbols in order of appearance."""
    seen: dict[sp.Symbol, None] = {}
    for node in sp.preorder_traversal(expression):
        if isinstance(node, sp.Symbol):
            seen.setdefault(node)
    return sorted(seen, key=lambda s: _age(s))


def _age(symbol: sp.Symbol) -> tuple[int, int]:
    """Order of creation: sympy's own order of arguments would depend on names."""
    reference = symbol.reference if isinstance(symbol, _Derived) else symbol
    serial = int(reference.name.rpartition("#")[2]) if isinstance(reference, Reference) else -1
    return serial, symbol.order if isinstance(symbol, _Derived) else 0


def _chain(owner: Component, reference: Reference, where: str) -> tuple[str, ...]:
    names: list[str] = []
    component: Component | None = reference.owner
    while component is not None and component is not owner:
        names.append(component._name)
        component = component._parent
    if component is None:
        raise DeclarationError(
            f"{where}: '{reference.path}' belongs to {reference.owner._label()}, which is not part of "
            f"{owner._label()}; assign it to an attribute, or connect instead"
        )
    return tuple(reversed(names))


def _fill(layout: Layout, template: Template, slots: _Slots, members: Integers) -> EquationGroup:
    def indices(entries: tuple[tuple[tuple[str, ...], int], ...], base: Integers) -> Integers:
        columns = [base[_owners(layout, members, chain)] + local for chain, local in entries]
        return np.stack(columns, axis=1) if columns else np.empty((len(members), 0), dtype=np.int64)

    return EquationGroup(
        template=template,
        variables=indices(slots.variables, layout.variable_base),
        parameters=indices(slots.parameters, layout.parameter_base),
        modules=indices(slots.modules, layout.module_base),
        components=members,
    )


def _owners(layout: Layout, members: Integers, chain: tuple[str, ...]) -> Integers:
    if not chain:
        return members
    owners: list[int] = []
    for member in members:
        component = layout.components[member]
        for name in chain:
            component = component._children[name]
        owners.append(layout.position[id(component)])
    return np.asarray(owners, dtype=np.int64)


# -- attributes ---------------------------------------------------------------------------------------


def _tiled(
    layout: Layout, base: Integers, local: Iterable[Sequence[Any]], dtype: Any
) -> np.ndarray:
    """Spread per-form local values over all instances."""
    flat = np.empty(int(base[-1]), dtype=dtype)
    for members, values in zip(_members(layout), local, strict=True):
        if len(values):
            flat[base[members][:, None] + np.arange(len(values))] = np.asarray(values, dtype=dtype)
    return flat


def _variable_attributes(layout: Layout) -> tuple[Any, ...]:
    base = layout.variable_base

    def declared(attribute: str, dtype: Any) -> np.ndarray:
        local = [
            [form.prototype._attribute(d, attribute) for _, d in form.variables]
            for form in layout.forms
        ]
        return _tiled(
            layout,
            base,
            [[0.0 if isinstance(v, sp.Expr | tuple) else v for v in row] for row in local],
            dtype,
        )

    start, fixed, nominal = (
        declared("start", float),
        declared("fixed", bool),
        declared("nominal", float),
    )
    rank = [[_rank(form.prototype, d) for _, d in form.variables] for form in layout.forms]
    state = _tiled(layout, base, rank, float)
    given = np.zeros(len(start), dtype=bool)
    starts: list[Binding] = []
    named = [
        [(i, path, d) for i, (path, d) in enumerate(f.variables) if isinstance(d.start, str)]
        for f in layout.forms
    ]
    for number, component in enumerate(layout.components):
        for index, path, d in named[layout.form_of[number]]:
            if component._modifiers.get(d.name, Start()).value is not None:
                continue
            variable = int(base[number]) + index
            given[variable] = d.start in component._modifiers
            starts.append(
                _binding(
                    layout, variable, _start_element(getattr(component, d.start), path, d.name)
                )
            )
        if not component._modifiers:
            continue
        form = layout.form(number)
        for name, modifier in component._modifiers.items():
            if not isinstance(modifier, Start):
                continue
            for index in _indices(form, name):
                variable = int(base[number]) + index
                if modifier.fixed is not None:
                    fixed[variable] = modifier.fixed
                if modifier.nominal is not None:
                    nominal[variable] = modifier.nominal
                if modifier.state is not None:
                    state[variable] = STATE_SELECT.index(modifier.state) + 0.5
                if modifier.value is not None:
                    given[variable] = True
                    value = _start_element(modifier.value, form.variables[index][0], name)
                    if isinstance(value, sp.Expr) and not value.is_number:
                        starts.append(_binding(layout, variable, value))
                    else:
                        start[variable] = float(value)
    return start, fixed, nominal, state, given, tuple(starts)


def _rank(prototype: Component, variable: Variable) -> float:
    """How much a variable is wanted as a state; half a rank more where its option was set by hand."""
    by_hand = variable.state in prototype._options
    return STATE_SELECT.index(prototype._attribute(variable, "state")) + 0.5 * by_hand


def _indices(form: Form, name: str) -> Iterator[int]:
    """Local indices of a variable, all elements of a vector among them."""
    if name in form.variable_index:
        yield form.variable_index[name]
    else:
        yield from (i for path, i in form.variable_index.items() if path.startswith(f"{name}["))


def _start_element(value: Any, path: str, name: str) -> Any:
    if path == name or not isinstance(value, list | tuple | np.ndarray):
        return value
    element: Any = value
    try:
        for i in path[len(name) + 1 : -1].split(","):
            element = element[int(i) - 1]
    except (IndexError, TypeError):
        raise DeclarationError(f"the start of '{name}' has no element for {path}") from None
    return element


def _parameter_values(layout: Layout) -> tuple[np.ndarray, tuple[Binding, ...], np.ndarray]:
    base = layout.parameter_base
    local = [[_default(form, path, d) for path, d in form.parameters] for form in layout.forms]
    value = _tiled(layout, base, local, float)
    folded = value == 0.0
    bindings: list[Binding] = []
    for number, component in enumerate(layout.components):
        form = layout.form(number)
        for name, given in component._modifiers.items():
            if isinstance(given, Start) or name in form.module_index:
                continue
            declared = cast(Declaration, component._declared.get(name) or component._dynamic[name])
            shape = component._shape(name, declared)
            values = np.asarray(given, dtype=object)
            if values.shape not in ((), shape):
                raise DeclarationError(
                    f"{component._label()}.{name} needs {_sizes(shape)} values, got {_sizes(values.shape)}"
                )
            elements = np.broadcast_to(values, shape or ()).flat
            for path, element in zip(element_names(name, shape), elements, strict=True):
                if path not in form.parameter_index:
                    continue  # the options left no use for it
                index = int(base[number]) + form.parameter_index[path]
                folded[index] = False
                if isinstance(element, sp.Expr) and not element.is_number:
                    value[index] = np.nan
                    bindings.append(_binding(layout, index, element))
                else:
                    value[index] = float(element)
    bindings += _default_bindings(layout, value, {b.target for b in bindings})
    bound = {b.target for b in bindings}
    missing = [int(i) for i in np.flatnonzero(np.isnan(value)) if int(i) not in bound]
    if missing:
        names = [layout.parameter(i) for i in missing[:12]]
        local_name = names[0].rpartition(".")[2]
        raise DeclarationError(
            f"parameter without a value: {', '.join(repr(n) for n in names)}; "
            f"give it where the component is made ({local_name}=...)"
        )
    return value, tuple(bindings), folded


def _sizes(shape: tuple[int, ...] | None) -> str:
    return " by ".join(str(n) for n in shape or (1,))


def _default(form: Form, path: str, declaration: Parameter) -> float:
    default = declaration.default
    if default is None or callable(default) or isinstance(default, str):
        return np.nan
    if declaration.shape is not None and declaration.name in form.prototype._modifiers:
        return np.nan  # all instances of the form have such an array of their own
    if declaration.shape is not None:
        index = tuple(int(i) - 1 for i in path[path.rindex("[") + 1 : -1].split(","))
        default = np.broadcast_to(
            np.asarray(default, dtype=float),
            form.prototype._shape(declaration.name, declaration) or (),
        )[index]
    return float(default)


def _default_bindings(layout: Layout, value: np.ndarray, bound: set[int]) -> list[Binding]:
    """Defaults that are functions of the component: ``Parameter(lambda self: 2 * self.m)``."""
    bindings: list[Binding] = []
    for number, members in enumerate(_members(layout)):
        computed = [
            (i, d)
            for i, (_, d) in enumerate(layout.forms[number].parameters)
            if callable(d.default)
        ]
        for member in members if computed else ():
            component = layout.components[member]
            for i, declaration in computed:
                index = int(layout.parameter_base[member]) + i
                if not np.isnan(value[index]) or index in bound:
                    continue
                default = declaration.default(component)
                if isinstance(default, sp.Expr) and not default.is_number:
                    bindings.append(_binding(layout, index, default))
                else:
                    value[index] = float(default)
    return bindings


def _binding(layout: Layout, target: int, expression: sp.Expr) -> Binding:
    symbols: list[sp.Symbol] = []
    arguments: list[int] = []
    names: dict[sp.Symbol, sp.Symbol] = {}
    for reference in references(expression):
        number = layout.position.get(id(reference.owner))
        if number is None:
            raise DeclarationError(
                f"a value refers to '{reference.path}' of {reference.owner._label()}, which is not part of the model"
            )
        names[reference] = sp.Symbol(f"p{len(symbols)}", real=True)
        symbols.append(names[reference])
        index = layout.form(number).parameter_index[reference.path]
        arguments.append(int(layout.parameter_base[number]) + index)
    named: Any = expression.xreplace(names)
    return Binding(target, named, tuple(symbols), tuple(arguments))


def _module_values(layout: Layout) -> tuple[Any, ...]:
    values: list[Any] = []
    for number, component in enumerate(layout.components):
        for name, declaration in layout.form(number).modules:
            value = component._modifiers.get(name, declaration.default)
            if value is None:
                raise DeclarationError(
                    f"{component._label()} has no module '{name}'; give {name}=..."
                )
            if isinstance(value, str):
                value = getattr(component, value)
            if isinstance(value, ModuleReference):  # a module of an enclosing component
                owner = layout.position[id(value.symbol.owner)]
                value = (
                    int(layout.module_base[owner])
                    + layout.form(owner).module_index[value.symbol.path]
                )
            values.append(value)
    return tuple(values)
