"""A component tree as a package of Modelica: one class for each structure, one block for each network."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import sympy as sp

from acausal.errors import DataError, ModelError
from acausal.export.modelica_text.declared import (
    Flat,
    connector_class,
    is_integer,
    names_in_class,
    names_in_tree,
    numbered,
    spelled,
    unused,
)
from acausal.export.modelica_text.discrete import is_discrete, stated
from acausal.export.modelica_text.expressions import AtEvents, Names, Printer, equation, instants
from acausal.export.modelica_text.network import block_class
from acausal.export.modelica_text.spelling import (
    array,
    class_name,
    comment,
    dotted,
    identifier,
    modifiers,
    number,
    unit,
)
from acausal.modeling import (
    Component,
    Connector,
    Discrete,
    Eq,
    InitialParameter,
    Input,
    Output,
    Parameter,
    Start,
    Tick,
    Variable,
    When,
    each,
    full_name,
    owner_and_name,
    references,
)
from acausal.netlist import lies_within


@dataclass
class Package:
    """The classes that have been written so far.

    Attributes:
        networks: by dotted name. standard: Modelica's name and modifiers of a part that the standard library has, or
            None. connector: its name of a connector, by class and name, or None. texts: of the classes, by name.
        elements: names that no class may have. named: see `names`, by the identity of a component's node.
    """

    networks: Mapping[str, Any]
    standard: Callable[[Component, str], tuple[str, Flat] | None]
    connector: Callable[[type, str], str | None]
    texts: dict[str, str] = field(default_factory=dict)
    blocks: dict[tuple[int, tuple[int, ...]], str] = field(default_factory=dict)
    elements: set[str] = field(default_factory=set)
    named: dict[int, tuple[dict[str, str], dict[str, str], set[str]]] = field(default_factory=dict)

    def names(self, node: Any) -> tuple[dict[str, str], dict[str, str], set[str]]:
        """Names of a component's parts and discrete outputs, and all that are taken; see `names_in_class`."""
        if id(node) not in self.named:
            self.named[id(node)] = names_in_class(node)
        return self.named[id(node)]

    def way(self, node: Any, route: Sequence[str]) -> list[str]:
        """The names on the way from a component down to a part of it."""
        found: list[str] = []
        for name in route:
            found.append(self.names(node)[0][name])
            node = node.children[name]._node
        return found

    def add(self, wanted: str, write: Callable[[str], str]) -> str:
        """The name of a class; classes of equal text are one."""
        for name in numbered(class_name(wanted)):
            if (
                name not in self.elements
                and self.texts.setdefault(name, text := write(name)) == text
            ):
                return name
        raise AssertionError

    def port(self, kind: type[Connector], name: str) -> str:
        """The class of a connector."""
        return self.connector(kind, name) or self.add(
            kind.__name__, lambda n: connector_class(n, kind)
        )

    def signal(self, declared: Input | Output) -> str:
        """The class of a signal."""
        role = Input if isinstance(declared, Input) else Output
        word = role.__name__.lower()
        own = f"Real{role.__name__}"
        return self.connector(role, "") or self.add(own, lambda n: f"connector {n} = {word} Real;")

    def network(self, name: str, orders: tuple[int, ...]) -> str:
        """The block of a network, or of a derivative of it.

        Raises:
            DataError: that names the network, if it has no counterpart in Modelica.
        """
        module = self.networks[name]
        key = (id(module), orders)
        if key not in self.blocks:
            suffix = "_d" + "".join(map(str, orders)) if any(orders) else ""
            wanted = f"{name[0].upper()}{name[1:]}{suffix}"
            try:
                self.blocks[key] = self.add(wanted, lambda n: block_class(n, module, orders))
            except DataError as error:
                raise DataError(f"export.modelica: '{name}': {error}") from None
        return self.blocks[key]

    def model(self, component: Component, wanted: str, inputs: Sequence[str] | None = None) -> str:
        """The class of a component; of the whole model with its open inputs."""
        return self.add(wanted, lambda name: ClassWriter(self, component, inputs).text(name))


class ClassWriter:
    """Writes the class of one component."""

    def __init__(
        self, package: Package, component: Component, inputs: Sequence[str] | None = None
    ) -> None:
        self.package, self.component, self.inputs = package, component, inputs or ()
        self.node = component._node
        self.taken = set(package.names(self.node)[2])
        self.calls: dict[tuple[str, str], str] = {}
        self.added: dict[
            str, tuple[str, str]
        ] = {}  # variables by what they are, and their declarations
        self.final: set[str] = set()  # parameters whose value the equations have taken in
        self.feeds: list[str] = []
        self.printing = Names(self.path, self._call, self._variable, self._tick)
        self.counts = any(map(_is_mixed, each(component.equations())))
        self.printer = Printer(self.printing)
        self.given: Flat = {}  # what was set in the whole model itself: no class around it says so
        if inputs is not None:
            for name, value in self.node.modifiers.items():
                self.given |= self._modifier(component, name, value, tuple(name.split(".")))

    def text(self, name: str) -> str:
        """The whole class."""
        doc = (type(self.component).__doc__ or "").strip().split("\n")[0].replace("`", "")
        parts = self._parts()
        label = self.node.label
        stated_here = stated(
            [self._without_zeros(e) for e in each(self.component.equations())], label
        )
        lines_of = partial(equation, self.printing, indent="  ")
        flow = [line for e in stated_here for line in lines_of(e)]
        declared = [line for n, d in self.node.declarations() for line in self._declaration(n, d)]
        start = [line for e in each(self.component.initial_equations()) for line in lines_of(e)]
        self.feeds += [f"{identifier(y)} = {identifier(d)};" for y, d in self._held.items()]
        pairs = [f"connect({self._end(a)}, {self._end(b)});" for a, b in self.node.connections]
        for given in self.inputs:
            own = unused(class_name(given), self.taken)
            role = self.package.signal(Input())
            declared.append(f"{role} {own};")
            target = self._input(given.split("."))
            pairs.append(
                f"connect({own}, {target});" if given.count(".") == 1 else f"{target} = {own};"
            )
        blocks = [f"{kind} {own};" for (kind, _), own in self.calls.items()]
        blocks += [declaration for _, declaration in self.added.values()]
        lines = [f"model {name}{comment(doc)}", *(f"  {line}" for line in [*declared, *parts])]
        if blocks:
            lines += ["protected", *(f"  {line}" for line in blocks)]
        if start:
            lines += ["initial equation", *start]
        if flow or self.feeds or pairs:
            lines += ["equation", *flow, *(f"  {line}" for line in [*self.feeds, *pairs])]
        return "\n".join([*lines, f"end {name};"])

    # -- names and values ----------------------------------------------------------------------------

    def path(self, reference: Any) -> str:
        """The name of a reference, seen from the class."""
        route = reference.owner.route_from(self.node)
        if route is None:
            raise ModelError(
                f"export.modelica: {self.node.label} refers to '{reference.path}' of another component; "
                "give it by a parameter or a connector"
            )
        of_library = route and self.package.standard(self.component, route[0])
        held = {} if of_library else self.package.names(reference.owner)[1]
        name, bracket, index = reference.path.partition("[")
        local = held.get(name, spelled(reference.owner, name)) + bracket + index
        return dotted([*self.package.way(self.node, route), *local.split(".")])

    def _without_zeros(self, stated: Any) -> Any:
        """Without derivatives whose factor is a parameter that is left at zero, as acausal folds it."""
        if not isinstance(stated, Eq) or not (found := _derivatives(stated)):
            return stated
        for r in [r for side in (stated.lhs, stated.rhs) for r in references(side)]:
            default: Any = getattr(r.declaration, "default", None)
            is_zero = r.owner is self.node and np.ndim(default) == 0 and default == 0
            if is_zero and r.path not in self.node.modifiers:
                folded = Eq(*(s.xreplace({r: sp.S.Zero}) for s in (stated.lhs, stated.rhs)))
                if _derivatives(folded) < found:
                    self.final.add(r.path)
                    stated, found = folded, _derivatives(folded)
        return stated

    @property
    def _held(self) -> dict[str, str]:
        return self.package.names(self.node)[1]

    def _variable(self, text: str) -> str:
        """A variable that equals a text."""
        if text not in self.added:
            name = unused("part", self.taken)
            self.added[text] = name, f"Real {name};"
            self.feeds.append(f"{name} = {text};")
        return self.added[text][0]

    def _tick(self, tick: Tick) -> str:
        """The condition of an instant after the start.

        It is counted, not sampled, if it begins where a variable says or shares a when-clause with other conditions:
        rumoca has one clock for all that a when-clause assigns.
        """
        start, period = self.printer.print(tick.start), self.printer.print(tick.period)
        if not (self.counts or any(is_discrete(r) for r in references(tick.start))):
            return f"sample({start}, {period})"
        text = f"instant {start}, {period}"
        if text not in self.added:
            name = unused("instant", self.taken)
            self.added[text] = (
                name,
                f'Integer {name} "number of the next instant {start} + k*{period}";',
            )
            first = f"max(0, integer((time - ({start}))/({period})) + 1)"
            self.feeds += [
                f"when initial() then {name} = {first};",
                f"elsewhen time >= {start} + pre({name})*{period} then {name} = pre({name}) + 1;",
                "end when;",
            ]
        return f"time >= {start} + pre({self.added[text][0]})*{period}"

    def _end(self, end: Any) -> str:
        owner, local = owner_and_name(end)
        route = None if owner is None else owner.route_from(self.node)
        if route is None:
            raise ModelError(
                f"export.modelica: {self.node.label} connects '{local}', which is not part of it"
            )
        return dotted([*self.package.way(self.node, route), *spelled(owner, local).split(".")])

    def _input(self, path: Sequence[str]) -> str:
        """An input's name by its path."""
        parts, node = 0, self.node
        while path[parts] in node.children:
            node = node.children[path[parts]]._node
            parts += 1
        local = spelled(node, ".".join(path[parts:]))
        return dotted([*self.package.way(self.node, path[:parts]), *local.split(".")])

    def value(self, given: Any, shape: tuple[int, ...] | None = None) -> str:
        """The text of a value; one number for a whole array of a shape fills it."""
        if shape and np.ndim(given) == 0:
            return f"fill({', '.join([self.value(given), *map(str, shape)])})"
        if isinstance(given, np.ndarray) and given.ndim == 0:
            given = given.item()
        if isinstance(given, list | tuple | np.ndarray):
            return array(np.asarray(given, dtype=object), self.value)
        return self.printer.print(given) if isinstance(given, sp.Basic) else number(given)

    def _call(self, call: Any, written: Callable[[Any], str]) -> str:
        """A network that is applied: an instance of its block, with equations for its inputs."""
        module, orders, *arguments = call.args
        full = full_name(module.owner.path, module.path)
        kind = self.package.network(full, tuple(map(int, orders)))
        texts = list(map(written, arguments))
        key = (kind, "; ".join(texts))
        if key not in self.calls:
            own = self.calls[key] = unused(f"net_{len(self.calls) + 1}", self.taken)
            names = ["x"] if len(texts) == 1 else [f"x{i + 1}" for i in range(len(texts))]
            self.feeds += [f"{own}.{n} = {t};" for n, t in zip(names, texts, strict=True)]
        return f"{self.calls[key]}.y"

    # -- declarations --------------------------------------------------------------------------------

    def _declaration(self, name: str, declared: Any) -> list[str]:
        given = {place[1:]: v for place, v in self.given.items() if place[0] == name}
        if isinstance(declared, Connector):
            kind = self.package.port(type(declared), name)
            return [f"{kind} {identifier(name)}{modifiers(given)};"]
        if not isinstance(declared, Parameter | Variable):
            return []
        shape = self.node.shape(name, declared)
        size = f"[{', '.join(map(str, shape))}]" if shape else ""
        each = "each " if shape else ""
        attributes = {f"{each}{key}": v for key, v in unit(declared.unit).items()}
        if isinstance(declared, Parameter):
            for key, bound in (("min", declared.min), ("max", declared.max)):
                if bound is not None:
                    attributes[f"{each}{key}"] = number(bound)
            default = declared.default
            if callable(default) and not isinstance(default, sp.Basic):
                default = default(self.component)
            value = given.pop((), None if default is None else self.value(default, shape))
            kind = "final parameter Real" if name in self.final else "parameter Real"
        else:
            if is_integer(declared):
                attributes = {}
            attributes |= self._attributes(declared, each)
            kind, value = self._kind(declared), given.pop((), None)
        flat: Flat = {(key,): v for key, v in attributes.items()}
        for (key,), text in given.items():
            flat.pop((f"each {key}",), None)
            flat[key,] = text
        binding = "" if value is None else f" = {value}"
        about = f"{binding}{comment(declared.doc)};"
        signal: list[str] = []
        if name in self._held:
            signal, name = (
                [f"{self.package.signal(Output())} {identifier(name)}{size};"],
                self._held[name],
            )
        word = identifier(spelled(self.node, name))
        return [*signal, f"{kind} {word}{size}{modifiers(flat)}{about}"]

    def _kind(self, declared: Variable) -> str:
        match declared:
            case InitialParameter():
                return "parameter Real"
            case Discrete():
                return "Integer" if is_integer(declared) else "discrete Real"
            case Input() | Output():
                return self.package.signal(declared)
            case _:
                return "Real"

    def _attributes(self, declared: Variable, each: str) -> dict[str, str]:
        """Start, fixed, nominal and priority, each perhaps that of another attribute of the component."""

        def value_of(given: Any) -> Any:
            return getattr(self.component, given) if isinstance(given, str) else given

        found: dict[str, str] = {}
        start, fixed, nominal = map(value_of, (declared.start, declared.fixed, declared.nominal))
        state = declared.state
        if state not in ("never", "avoid", "default", "prefer", "always"):
            state = value_of(state)
        if isinstance(start, sp.Basic | list | tuple | np.ndarray) or start != 0 or fixed:
            bare = isinstance(start, list | tuple | np.ndarray)
            found["start" if bare else f"{each}start"] = self._start(declared, start)
        if isinstance(declared, InitialParameter):
            return {**found, "fixed": "false"}
        if isinstance(declared, Discrete) and not fixed:
            fixed = True  # the value before the first event
        if fixed:
            found[f"{each}fixed"] = "true"
        if nominal != 1:
            found[f"{each}nominal"] = self.value(nominal)
        if state != "default":
            found[f"{each}stateSelect"] = f"StateSelect.{state}"
        return found

    def _start(self, declared: Variable, given: Any, shape: tuple[int, ...] | None = None) -> str:
        """A start value, whole where the variable is."""
        if is_integer(declared) and isinstance(given, sp.Basic):
            return AtEvents(self.printing).whole(given)
        return self.value(given, shape)

    # -- parts ---------------------------------------------------------------------------------------

    def _parts(self) -> list[str]:
        return [self._part(name, part) for name, part in self.node.children.items()]

    def _part(self, name: str, part: Component) -> str:
        known = self.package.standard(self.component, name)
        if known is not None:
            kind, flat = known
        else:
            kind = self.package.model(part, part._node.title or type(part).__name__)
            flat = self._own(part, ())
        return f"{kind} {identifier(self.package.way(self.node, [name])[0])}{modifiers(flat)};"

    def _own(self, part: Component, path: tuple[str, ...]) -> Flat:
        """Modifiers of a part, and those of parts within it whose values refer to this class."""
        found: Flat = {}
        top = self.component._node.children[path[0]] if path else part
        for name, value in part._node.modifiers.items():
            given = value.value if isinstance(value, Start) else value
            if not lies_within(self.component, given) or (path and lies_within(top, given)):
                continue
            first, *rest = spelled(part._node, name).split(".")
            held = self.package.names(part._node)[1]
            place = (*self.package.way(top._node, path[1:]), held.get(first, first), *rest)
            found |= self._modifier(part, name, value, place)
        own = path or (part._node.name,)
        for name, child in part._node.children.items():
            found |= self._own(child, (*own, name))
        return found

    def _modifier(self, part: Component, name: str, value: Any, place: tuple[str, ...]) -> Flat:
        every = dict(part._node.declarations())
        declared = every.get(name, every.get(name.partition(".")[0]))
        if not isinstance(
            declared, Parameter | Variable
        ):  # also what the options of the part leave out
            return {}
        shape = part._node.shape(name, declared)
        if not isinstance(value, Start):
            return {place: self.value(value, shape)}
        found: Flat = {}
        if value.value is not None:
            start = (
                self.value if isinstance(declared, Parameter) else partial(self._start, declared)
            )
            found[*place, "start"] = start(value.value, shape)
        if value.nominal is not None:
            found[*place, "nominal"] = self.value(value.nominal, shape)
        each = "each " if shape else ""
        if value.fixed is not None:
            found[*place, f"{each}fixed"] = "true" if value.fixed else "false"
        if value.state is not None:
            found[*place, f"{each}stateSelect"] = f"StateSelect.{value.state}"
        return found


def _is_mixed(stated: Any) -> bool:
    """Whether a when-clause has both instants that are known and other conditions."""
    if not isinstance(stated, When):
        return False
    every = [c for link in stated.chain() for given in link.conditions for c in instants(given)]
    return 0 < sum(c.has(Tick) for c in every) < len(every)


def _derivatives(stated: Eq) -> int:
    """How many derivatives an equation has."""
    sides = (stated.lhs, stated.rhs)
    return sum(type(f).__name__ == "der" for side in sides for f in side.atoms(sp.Function))


def package_of(
    model: Component, title: str, about: str, package: Package, inputs: Sequence[str]
) -> str:
    """The text of a package, with a description, whose last class is the model; open inputs have dotted names."""
    package.elements |= names_in_tree(model)
    open_inputs = [name for name in inputs if "." in name and not name.startswith("der(")]
    package.model(model, model._node.title or type(model).__name__, open_inputs)
    indented = ["  " + line for text in package.texts.values() for line in [*text.split("\n"), ""]]
    lines = [f"package {title}{comment(about)}", *indented, f"end {title};", ""]
    return "\n".join(line.rstrip() for line in lines)
