"""Classes of the text: what their names mean, and what they inherit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from acausal.errors import nearest
from acausal.modelica.grammar import parse
from acausal.modelica.meanings import (
    PATH_HINT,
    Imported,
    Native,
    Predefined,
    Prefix,
    is_icon,
    unknown_name,
)
from acausal.modelica.rules import check_base, check_same, check_sections
from acausal.modelica.syntax import (
    ClassDefinition,
    Declared,
    DottedName,
    Extends,
    Import,
    ModificationArgument,
)
from acausal.modelica.tokens import PREDEFINED, ModelicaError, Source, read_source
from acausal.modelica.views import ClassView, Entry


class ClassNode:
    """One class in the tree.

    Attributes:
        parent: the class or package around it.
        folder: of a package that is a folder; other files there are its classes.
        unwatched: statements of which a warning was given. checked: what was found right, see `statements.check`.
    """

    def __init__(
        self,
        definition: ClassDefinition,
        parent: ClassNode | Prefix | None,
        tree: Any,
        folder: Path | None = None,
    ) -> None:
        self.definition, self.parent, self.tree, self.folder = definition, parent, tree, folder
        self.children: dict[str, Any] = {}
        self.python: type | None = None
        self.unwatched: set[int] = set()
        self.checked: set[Any] = set()
        self._viewed = False
        self._bases: dict[int, Any] = {}
        self._searching: set[str] = set()

    def __deepcopy__(self, memo: Any) -> ClassNode:
        return self

    @cached_property
    def full(self) -> str:
        """The full name."""
        above = "" if self.parent is None else f"{self.parent.full}."
        return above + self.definition.name

    @property
    def source(self) -> Source:
        """The file."""
        return self.definition.source

    def wrong(self, at: int, reason: str, length: int | None = None) -> ModelicaError:
        """The error at a place in the file."""
        return self.source.wrong(at, reason, length)

    def refused(self, reason: str) -> ModelicaError:
        """The error at its name."""
        return self.wrong(self.definition.at, reason, len(self.definition.name))

    def twice(self, element: ClassDefinition | Declared) -> ModelicaError:
        """The error for an element whose name another one has."""
        return self.wrong(element.at, f"'{element.name}' is declared twice", len(element.name))

    # -- names ---------------------------------------------------------------------------------------

    @cached_property
    def classes(self) -> dict[str, ClassDefinition]:
        """The classes that its text defines, by name."""
        found: dict[str, ClassDefinition] = {}
        for element in self.definition.elements:
            if isinstance(element, ClassDefinition):
                if element.name in found:
                    raise self.twice(element)
                found[element.name] = element
        return found

    def own(self, name: str) -> Any:
        """A class that is defined here, or that a library has under this name."""
        if name not in self.children:
            self.children[name] = self._own(name)
        return self.children[name]

    def _own(self, name: str) -> Any:
        if self.definition.kind == "package":
            full = f"{self.full}.{name}"
            found = self.tree.native(full) or self.text(name)
            if found is None and self.tree.has_package(full):
                return Prefix(full)  # another version of the library has its text
            return found
        return self.text(name)

    def text(self, name: str) -> ClassNode | None:
        """A class that is defined here, even where a library has one of its name."""
        if name in self.classes:
            found = self.classes[name]
            if found.prefixes.outer:
                reason = f"'{name}' is an outer class, which is not supported; make it replaceable"
                raise self.wrong(found.at, reason, len(name))
            return ClassNode(found, self, self.tree)
        if self.folder is not None:
            for file in (self.folder / f"{name}.mo", self.folder / name / "package.mo"):
                if file.is_file():
                    _, definitions = parse(read_source(file))
                    inner = file.parent if file.name == "package.mo" else None
                    return ClassNode(definitions[0], self, self.tree, inner)
        return None

    def member(self, name: str) -> Any:
        """A class that is defined here or inherited; None if there is none."""
        found = self.own(name)
        if found is not None:
            return found
        if name in self._searching:
            return None
        self._searching.add(name)
        try:
            for extends in self.extends:
                for argument in extends.modifier.arguments:
                    if argument.name == name and isinstance(argument.redeclared, ClassDefinition):
                        new = ClassNode(argument.redeclared, self, self.tree)
                        return self.children.setdefault(f"{name} at {argument.at}", new)
                base = self.base(extends, quiet=True)
                found = self.tree.inside(base, name)
                if found is not None and not self._is_guess(found):
                    return self._inherited_class(name, found)
        finally:
            self._searching.discard(name)
        return None

    def _is_guess(self, found: Any) -> bool:
        """Whether this may be a package whose text is not given, or no name at all."""
        return isinstance(found, Prefix) and not self.tree.has_package(found.full)

    def with_classes(self, classes: Mapping[str, Any]) -> ClassNode:
        """The same class with other classes in the place of replaceable ones; the same for the same classes."""
        if not classes:
            return self
        key = f"with {', '.join(f'{name} at {id(cls)}' for name, cls in classes.items())}"
        if key not in self.children:
            found = ClassNode(self.definition, self.parent, self.tree, self.folder)
            found.children |= classes
            found.redeclares = True
            self.children[key] = found
        return self.children[key]

    @cached_property
    def redeclares(self) -> bool:
        """Whether names mean something else here than in its bases, so that what it inherits is looked up here."""
        arguments = [a for clause in self.extends for a in clause.modifier.arguments]
        classes = any(isinstance(a.redeclared, ClassDefinition) for a in arguments)
        own = any(element.prefixes.redeclare for element in self.classes.values())
        return classes or own or self.definition.kind == "package"

    def _scope(self, base: ClassNode) -> ClassNode:
        """Where names in what is inherited from a base are looked up."""
        if not self.redeclares:
            return base
        return self.children.setdefault(f"scope of {id(base)}", Inherited(base, self))

    def _inherited_class(self, name: str, found: Any) -> Any:
        """A class that a base defines, as one of this class."""
        parent = found.parent if isinstance(found, ClassNode) else None
        if not isinstance(parent, ClassNode) or not self.redeclares:
            return found
        scope = self._scope(parent)
        known = self.children
        return known.setdefault(
            f"inherited {name}", ClassNode(found.definition, scope, self.tree, found.folder)
        )

    @cached_property
    def extends(self) -> list[Extends]:
        """The clauses that name its bases."""
        return [e for e in self.definition.elements if isinstance(e, Extends)]

    @cached_property
    def imports(self) -> list[Import]:
        """Its imports."""
        return [e for e in self.definition.elements if isinstance(e, Import)]

    def base(self, extends: Extends, quiet: bool = False) -> Any:
        """The class that a clause names."""
        if self.definition.extends_inherited and extends is self.extends[0]:
            above = self.parent
            for clause in above.extends if isinstance(above, ClassNode) else ():
                assert isinstance(above, ClassNode)
                found = self.tree.inside(above.base(clause), self.definition.name)
                if isinstance(found, ClassNode) and not found.definition.prefixes.replaceable:
                    raise self.refused(f"'{self.definition.name}' is not replaceable in the base")
                if found is not None:
                    return above._inherited_class(f"{self.definition.name} of the base", found)
        if id(extends) in self._bases:
            return self._bases[id(extends)]
        found, rest = self.lookup(extends.base.words, of_base=True)
        if found is None or rest:
            found, rest = self.lookup(extends.base.words)
        if found is None or rest:
            if quiet:
                return None
            raise self.unknown(extends.base)
        self._bases[id(extends)] = found
        return found

    def lookup(self, words: Sequence[str], *, of_base: bool = False) -> tuple[Any, Sequence[str]]:
        """What a name means here: what is found by its first words, and the words that are left.

        A base (``of_base``) is not looked for in what is inherited.
        """
        if words[0] == "":
            found = self.tree.root(words[1])
            rest = words[2:]
        else:
            found = self._first(words[0], of_base)
            rest = words[1:]
        while found is not None and rest:
            inner = self.tree.inside(found, rest[0])
            if inner is None:
                break
            found, rest = inner, rest[1:]
        return found, rest

    def _first(self, word: str, of_base: bool) -> Any:
        node: Any = self
        if word in PREDEFINED:
            return Predefined(word)
        while node is not None:
            if isinstance(node, Prefix):
                found = self.tree.inside(node, word)
                if found is not None:
                    return found
                above = node.full.rpartition(".")[0]
                node = self.tree.resolve(above) if above else None
                continue
            if node.definition.name == word and node is not self and node.parent is None:
                return node
            found = None
            if not node.definition.short:
                found = node.own(word) if of_base and node is self else node.member(word)
            if found is None:
                found = node.imported(word)
            if found is not None:
                return found
            node = None if node.definition.encapsulated else node.parent
        return self.tree.root(word)

    def imported(self, word: str) -> Any:
        """What an import gives that name."""
        for clause in self.imports:
            if word in clause.names:
                found = self.tree.resolve(clause.names[word])
                if found is None:
                    owner, _, last = clause.names[word].rpartition(".")
                    package = self.tree.resolve(owner) if owner else None
                    if isinstance(package, ClassNode) and package.has_value(last):
                        return Imported(package, last)
                    raise self.wrong(clause.at, f"there is no '{clause.names[word]}'; {PATH_HINT}")
                return found
        for clause in self.imports:
            if clause.everything:
                package = self.tree.resolve(clause.package)
                found = self.tree.inside(package, word)
                if self._is_guess(found):
                    found = None
                if found is None and isinstance(package, ClassNode) and package.has_value(word):
                    found = Imported(package, word)
                if found is not None:
                    return found
        return None

    def has_value(self, name: str) -> bool:
        """Whether this is a constant of a package, or a value of an enumeration."""
        return name in self.view().entries or name in self.literals

    @cached_property
    def literals(self) -> dict[str, str]:
        """The values of an enumeration by name, each with its text."""
        short = self.definition.short
        base = self.base(self.extends[0], quiet=True) if short and self.extends else None
        return self.definition.literals or (base.literals if isinstance(base, ClassNode) else {})

    def unknown(self, name: DottedName, what: str = "class") -> ModelicaError:
        """The error for a name that means nothing here."""
        return self.wrong(name.at, unknown_name(self, name, what), len(name.text))

    # -- inheritance -----------------------------------------------------------------------------------

    def view(self) -> ClassView:
        """The class with what it inherits.

        Raises:
            ModelicaError: for a base that is not there, or a class that extends itself.
        """
        return self._view

    @cached_property
    def _view(self) -> ClassView:
        if self._viewed:
            raise self.refused(f"'{self.definition.name}' extends itself")
        self._viewed = True
        check_sections(self)
        view, short = ClassView(), self.definition.short
        if self.definition.literals is not None:
            view.predefined = Predefined(self.full)
        for element in self.definition.elements:
            match element:
                case Extends():
                    self._inherit(view, element)
                case Declared():
                    known = view.entries.get(element.name)
                    if known is not None and known.node is self:
                        raise self.twice(element)
                    if known is not None and not element.prefixes.redeclare:
                        check_same(self, element, known.declared)
                    modifiers = known.modifiers if known and not element.prefixes.redeclare else []
                    view.entries[element.name] = Entry(element, self, list(modifiers))
                case ClassDefinition() if element.prefixes.redeclare:
                    view.classes[element.name] = element, self
                case _:
                    pass
        if short is not None:
            view.subscripts = [*((s, self) for s in short.subscripts), *view.subscripts]
            view.causality = short.causality or view.causality
            view.connection = short.connection or view.connection
        definition = self.definition
        for kind in ("initial_equations", "equations"):
            if statements := getattr(definition, kind):
                view.sections.append((kind, statements, self))
        for kind in ("initial_algorithms", "algorithms"):
            view.sections += [(kind, statements, self) for statements in getattr(definition, kind)]
        self._viewed = False
        return view

    def _inherit(self, view: ClassView, clause: Extends) -> None:
        base = self.base(clause)
        arguments: list[tuple[ModificationArgument, ClassNode]] = [
            (a, self) for a in clause.modifier.arguments
        ]
        match base:
            case Predefined():
                view.predefined = base
                view.attributes = [*arguments, *view.attributes]
                return
            case Native() if (text := self._with_all(base, arguments)) is not None:
                base = text
            case Native():
                view.natives.append((base, arguments))
                return
            case Prefix() if is_icon(base.full):
                return
            case Prefix() if any(lib.is_enumeration(base.full) for lib in self.tree.libraries):
                view.predefined = Predefined(base.full)
                return
            case ClassNode():
                pass
            case Prefix():
                raise self.unknown(clause.base)
            case _:
                raise self.wrong(
                    clause.base.at,
                    f"'{clause.base.text}' is not a class to extend",
                    len(clause.base.text),
                )
        check_base(self, clause, base)
        inherited = base.view() if not self.redeclares else base.view().within(self._scope)
        of_native = [
            p for p in arguments if p[0].name not in inherited.entries and p[0].redeclared is None
        ]
        view.natives += [(native, [*of_native, *given]) for native, given in inherited.natives]
        if inherited.predefined is not None:
            view.predefined = inherited.predefined
            view.attributes = [*view.attributes, *arguments, *inherited.attributes]
            view.causality, view.connection = inherited.causality, inherited.connection
            view.subscripts = list(inherited.subscripts)
            return
        for name, entry in inherited.entries.items():
            own = [pair for pair in arguments if pair[0].name.partition(".")[0] == name]
            if name not in view.entries:
                view.entries[name] = Entry(entry.declared, entry.node, [*own, *entry.modifiers])
        view.classes |= inherited.classes
        for argument, _ in arguments:
            if argument.redeclared is not None and isinstance(argument.redeclared, ClassDefinition):
                view.classes[argument.name] = argument, self
                continue
            unknown = argument.name.partition(".")[0] not in inherited.entries
            if unknown and not inherited.natives and base.member(argument.name) is None:
                hint = nearest(argument.name, inherited.entries)
                reason = f"'{base.definition.name}' has no '{argument.name}'; {hint}"
                raise self.wrong(argument.at, reason, len(argument.name))
        known = {id(stated) for _, stated, _ in view.sections}  # of a base on two ways once
        view.sections += [one for one in inherited.sections if id(one[1]) not in known]

    def _with_all(
        self, base: Native, arguments: list[tuple[ModificationArgument, ClassNode]]
    ) -> ClassNode | None:
        """The text of a library's class that has members which the class here lacks, where there is one.

        Of an interface all members count, of others those that are modified.
        """
        if ".Interfaces." not in base.name:
            return self.tree.text_with(base, [a.name.partition(".")[0] for a, _ in arguments])
        text = self.tree.text(base.name)
        return self.tree.text_with(base, text.view().entries) if text else None

    def names(self) -> list[str]:
        """Names of its classes, also of those that it inherits from the text."""
        bases = [self.base(clause, quiet=True) for clause in self.extends]
        inherited = [name for base in bases if isinstance(base, ClassNode) for name in base.names()]
        return [*dict.fromkeys((*self.classes, *self.files, *inherited))]

    @property
    def is_nested(self) -> bool:
        """Whether a class that is no package defines it."""
        return isinstance(self.parent, ClassNode) and self.parent.definition.kind != "package"

    def models(self) -> Iterator[ClassNode]:
        """The models in it that can be compiled, itself included, in order."""
        if self.definition.kind in ("model", "block", "class") and not self.definition.partial:
            yield self
        names = [e.name for e in self.definition.elements if isinstance(e, ClassDefinition)]
        for name in dict.fromkeys((*names, *self.files)):
            inner = self.own(name)
            if isinstance(inner, ClassNode) and inner.definition.kind not in ("function", "record"):
                yield from inner.models()

    @cached_property
    def files(self) -> list[str]:
        """Names of the classes that are files of its folder, in the order of ``package.order``."""
        if self.folder is None:
            return []
        found = [p.stem for p in sorted(self.folder.glob("*.mo")) if p.name != "package.mo"]
        found += [p.parent.name for p in sorted(self.folder.glob("*/package.mo"))]
        order = self.folder / "package.order"
        stated = order.read_text(encoding="utf-8").split("\n") if order.is_file() else []
        first = [name.strip() for name in stated if name.strip() in found]
        return list(dict.fromkeys((*first, *found)))


class Inherited(ClassNode):
    """A class as the place of what another one inherits from it: names mean there what they mean in the heir."""

    def __init__(self, base: ClassNode, heir: ClassNode) -> None:
        super().__init__(base.definition, base.parent, base.tree, base.folder)
        self.heir = heir

    def member(self, name: str) -> Any:
        """A class of the heir."""
        return self.heir.member(name)

    def view(self) -> ClassView:
        """The heir with what it inherits."""
        return self.heir.view()
