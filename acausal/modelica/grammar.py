"""The grammar of classes, equations and algorithms: Modelica text becomes a syntax tree."""

from __future__ import annotations

from dataclasses import replace

from acausal.modelica.expressions import Expressions
from acausal.modelica.placing import placement
from acausal.modelica.syntax import (
    Branch,
    Branches,
    ClassDefinition,
    Connect,
    Declared,
    Do,
    DottedName,
    Element,
    EquationStatement,
    Extends,
    FunctionCall,
    Import,
    Loop,
    ModificationArgument,
    ModificationSyntax,
    Prefixes,
    ShortClass,
    Statement,
)
from acausal.modelica.tokens import Source

KINDS = frozenset(
    ("class", "model", "record", "block", "connector", "type", "package", "function", "operator")
)
CLASS_PREFIXES = KINDS | {"partial", "expandable", "encapsulated", "pure", "impure"}
ENDS = frozenset((
    "public", "protected", "equation", "algorithm", "initial", "external", "annotation", "end", "else", "elseif",
    "elsewhen", "",
))  # fmt: skip
"""What ends the statements of a section or a branch; but `INITIAL` begins one."""
INITIAL = ["initial", "("]


def parse(source: Source) -> tuple[str, list[ClassDefinition]]:
    """The package that a file is within (empty if none), and its classes.

    Raises:
        ModelicaError: with the place, for text that is not Modelica.
    """
    return _Reader(source).file()


class _Reader(Expressions):
    """Recursive descent over the tokens of one file."""

    def file(self) -> tuple[str, list[ClassDefinition]]:
        within = ""
        if self.accept("within"):
            within = "" if self.peek == ";" else self.dotted().text
            self.take(";")
        classes: list[ClassDefinition] = []
        while self.peek:
            self.accept("final")
            classes.append(self.class_definition(Prefixes()))
            self.take(";")
        if not classes:
            raise self.wrong("a class expected, the end of the file found")
        return within, classes

    # -- classes -----------------------------------------------------------------------------------

    def class_definition(self, prefixes: Prefixes) -> ClassDefinition:
        self.deeper()
        encapsulated = self.accept("encapsulated")
        words: list[str] = []
        while self.peek in CLASS_PREFIXES:
            words.append(self.advance())
        if not any(word in KINDS for word in words):
            raise self.wrong(f"a class such as 'model' or 'package' expected, {self.found} found")
        kind = words[-1]
        inherited, at = self.accept("extends"), self.at
        found = ClassDefinition(
            self.identifier(),
            kind if words[-2:] != ["operator", "record"] else "record",
            self.source,
            at,
            prefixes,
            partial="partial" in words,
            expandable="expandable" in words,
            encapsulated=encapsulated,
            extends_inherited=inherited,
        )
        if inherited:
            arguments = self.class_modification() if self.peek == "(" else []
            found.elements.append(
                Extends(DottedName((found.name,), {}, at), ModificationSyntax(arguments), at)
            )
        if not inherited and self.accept("="):
            self._short(found)
        else:
            found.comment = self.string_comment()
            self._composition(found)
            self.take("end")
            if self.peek not in (found.name, f"'{found.name}'"):
                raise self.wrong(f"'end {found.name}' expected, 'end {self.peek}' found")
            self.position += 1
        self.depth -= 1
        return found

    def _short(self, found: ClassDefinition) -> None:
        at = self.at
        if self.accept("enumeration"):
            self.take("(")
            found.literals = {}
            if not self.accept(":"):
                while self.peek != ")":
                    name = self.identifier()
                    if name in found.literals:
                        self.position -= 1
                        raise self.wrong(f"'{name}' is in this enumeration already")
                    found.literals[name] = self.texts[self.position - 1]
                    self.comment(found)
                    if not self.accept(","):
                        break
            self.take(")")
        elif self.accept("der"):
            self.take("(")
            self.dotted()
            while self.accept(","):
                self.identifier()
            self.take(")")
            found.external = "a derivative"
        else:
            causality = connection = ""
            while self.peek in ("input", "output", "flow", "stream"):
                word = self.advance()
                if word in ("input", "output"):
                    causality = word
                else:
                    connection = word
            base = self.dotted()
            subscripts = self.subscripts() if self.peek == "[" else []
            arguments = self.class_modification() if self.peek == "(" else []
            found.short = ShortClass(
                base, subscripts, ModificationSyntax(arguments), causality, connection
            )
            found.elements.append(Extends(base, found.short.modifier, at))
        self.comment(found)

    def _composition(self, found: ClassDefinition) -> None:
        protected = False
        while self.peek != "end":
            word = self.peek
            if word in ("public", "protected"):
                protected = self.advance() == "protected"
            elif word == "annotation":
                self.annotation(found)
                self.take(";")
            elif word == "external":
                self._external(found)
            elif word in ("equation", "algorithm") or (
                word == "initial" and self.texts[self.position + 1] in ("equation", "algorithm")
            ):
                initial = self.accept("initial")
                if self.advance() == "equation":
                    into = found.initial_equations if initial else found.equations
                    into += self.statements(is_equation=True)
                else:
                    sections = found.initial_algorithms if initial else found.algorithms
                    sections.append(self.statements(is_equation=False))
            elif not word:
                raise self.wrong(f"'end {found.name}' expected, the end of the file found")
            else:
                found.elements += self.element(protected)
                self.take(";")

    def _external(self, found: ClassDefinition) -> None:
        self.take("external")
        if self.peek.startswith('"'):
            self.text()
        found.external = "C"
        if self.peek not in (";", "annotation"):
            name = self.reference()
            if self.accept("="):
                name = self.reference()
            found.external = name.text
            self.call(name)
        if self.peek == "annotation":
            self.annotation(found)
        self.take(";")

    # -- elements ----------------------------------------------------------------------------------

    def element(self, protected: bool) -> list[Element]:
        if self.peek == "import":
            return [self._import()]
        if self.peek == "extends":
            return [self._extends()]
        prefixes = Prefixes(protected=protected)
        while (word := self.peek) in ("redeclare", "final", "inner", "outer", "replaceable"):
            setattr(prefixes, word, True)
            self.position += 1
        return self._class_or_components(prefixes)

    def _class_or_components(self, prefixes: Prefixes, single: bool = False) -> list[Element]:
        found: list[Element] = []
        if self.peek in CLASS_PREFIXES:
            found.append(self.class_definition(prefixes))
        else:
            found += self._components(prefixes, single)
        at = self.at
        if self.accept("constrainedby"):
            base = self.dotted()
            arguments = self.class_modification() if self.peek == "(" else []
            for element in found:
                assert isinstance(element, ClassDefinition | Declared)
                element.constraint = Extends(base, ModificationSyntax(arguments), at)
            self.comment()
        return found

    def _import(self) -> Import:
        at = self.at
        self.take("import")
        if self.texts[self.position + 1] == "=":
            alias = self.identifier()
            self.take("=")
            name = self.dotted().text
            self.comment()
            return Import(name, {alias: name}, False, at)
        words = [self.identifier()]
        names: dict[str, str] = {}
        everything = False
        while self.peek in (".", ".*"):
            if self.advance() == ".*" or self.accept("*"):
                everything = True
                break
            if self.accept("{"):
                while True:
                    name = self.identifier()
                    names[name] = ".".join((*words, name))
                    if not self.accept(","):
                        break
                self.take("}")
                break
            words.append(self.identifier())
        package = ".".join(words)
        if not names and not everything:
            names = {words[-1]: package}
        self.comment()
        return Import(package, names, everything, at)

    def _extends(self) -> Extends:
        at = self.at
        self.take("extends")
        base = self.dotted()
        arguments = self.class_modification() if self.peek == "(" else []
        if self.peek == "annotation":
            self.annotation()
        return Extends(base, ModificationSyntax(arguments), at)

    def _components(self, prefixes: Prefixes, single: bool) -> list[Element]:
        while (word := self.peek) in (
            "flow", "stream", "parameter", "constant", "discrete", "input", "output",
        ):  # fmt: skip
            if word in ("flow", "stream"):
                prefixes.connection = word
            elif word in ("input", "output"):
                prefixes.causality = word
            else:
                prefixes.variability = word
            self.position += 1
        kind = self.dotted()
        common = self.subscripts() if self.peek == "[" else []
        found: list[Element] = []
        while True:
            at = self.at
            name = self.identifier()
            own = self.subscripts() if self.peek == "[" else []
            modifier = self.modifier()
            condition = self.expression() if self.accept("if") else None
            comment, begin = self.string_comment(), self.position
            if self.peek == "annotation":
                self.annotation()
            spot = placement("".join(self.texts[begin : self.position]))
            whole = Declared(
                name, kind, own + common, modifier, condition, replace(prefixes), comment, at
            )
            found.append(replace(whole, placement=spot))
            if single or not self.accept(","):
                return found

    # -- modifiers ---------------------------------------------------------------------------------

    def modifier(self) -> ModificationSyntax:
        """What may stand behind a name: ``(...)``, ``= value``, both or nothing."""
        arguments = self.class_modification() if self.peek == "(" else []
        value = None
        if self.accept("=") or self.accept(":="):
            value = self.expression() if self.peek != "break" else None
            if value is None:
                self.position += 1
        return ModificationSyntax(arguments, value)

    def class_modification(self) -> list[ModificationArgument]:
        self.deeper()
        self.take("(")
        found: list[ModificationArgument] = []
        while self.peek != ")":
            here = self.position
            found.append(self._modifier_argument())
            if found[-1].name in [other.name for other in found[:-1]]:
                self.position = here
                raise self.wrong(f"'{found[-1].name}' is modified twice")
            if not self.accept(","):
                break
        self.take(")")
        self.depth -= 1
        return found

    def _modifier_argument(self) -> ModificationArgument:
        at, redeclare = self.at, self.accept("redeclare")
        each = self.accept("each")
        final = self.accept("final")
        replaceable = self.accept("replaceable")
        if redeclare or replaceable:
            prefixes = Prefixes(redeclare=redeclare, replaceable=replaceable, final=final)
            element = self._class_or_components(prefixes, single=True)[0]
            assert isinstance(element, ClassDefinition | Declared)
            return ModificationArgument(
                element.name, ModificationSyntax(), at, each, final, element
            )
        name, at = self.dotted().text, self.at if each or final else at
        modifier = self.modifier()
        self.string_comment()
        return ModificationArgument(name, modifier, at, each, final)

    # -- comments ------------------------------------------------------------------------------------

    def string_comment(self) -> str:
        found = ""
        if self.peek.startswith('"'):
            found = self.text()
            while self.accept("+"):
                found += self.text()
        return found

    def comment(self, into: ClassDefinition | None = None) -> str:
        found = self.string_comment()
        if self.peek == "annotation":
            self.annotation(into)
        return found

    def annotation(self, into: ClassDefinition | None = None) -> None:
        """Read over an annotation; that of a class keeps its experiment."""
        self.take("annotation")
        begin, level, texts = self.position, 0, self.texts
        if self.peek != "(":
            raise self.wrong(f"'(' expected, {self.found} found")
        while True:
            text = texts[self.position]
            if text == "(":
                level += 1
            elif text == ")":
                level -= 1
                if not level:
                    break
            elif text == "experiment" and level == 1 and into and texts[self.position + 1] == "(":
                end = self.position
                self.position += 1
                for argument in self.class_modification():
                    if argument.modifier.value is not None:
                        into.experiment[argument.name] = argument.modifier.value
                self.position = end
            elif not text:
                self.position = begin
                raise self.wrong("this annotation has no end")
            self.position += 1
        self.position += 1

    # -- equations and statements --------------------------------------------------------------------

    def statements(self, is_equation: bool) -> list[Statement]:
        """Up to a keyword that begins something else."""
        self.deeper()
        found: list[Statement] = []
        while self.peek not in ENDS or self.texts[self.position : self.position + 2] == INITIAL:
            found.append(self._statement(is_equation))
            self.take(";")
        self.depth -= 1
        return found

    def _statement(self, is_equation: bool) -> Statement:
        at, word = self.at, self.peek
        found: Statement
        if word in ("if", "when"):
            found = self._branches(word, is_equation)
        elif word in ("for", "while"):
            found = self._loop(word, is_equation)
        elif word == "connect" and is_equation:
            self.position += 1
            self.take("(")
            first = self.reference()
            self.take(",")
            second = self.reference()
            self.take(")")
            found = Connect((first, second), at)
        elif word in ("break", "return"):
            self.position += 1
            found = Do(FunctionCall(DottedName((word,), {}, at), [], {}, at), at)
        else:
            found = self._simple(is_equation, at)
        self.comment()
        return found

    def _simple(self, is_equation: bool, at: int) -> Statement:
        left = self.expression()
        sign = "=" if is_equation else ":="
        if self.peek == sign:
            self.position += 1
            return EquationStatement(left, self.expression(), at)
        if isinstance(left, FunctionCall):
            return Do(left, at)
        raise self.wrong(f"'{sign}' expected, {self.found} found")

    def _branches(self, word: str, is_equation: bool) -> Statement:
        at, branches = self.at, list[Branch]()
        self.position += 1
        while True:
            condition = self.expression()
            self.take("then")
            branches.append((condition, self.statements(is_equation)))
            if not self.accept(f"else{word}"):
                break
        if word == "if" and self.accept("else"):
            branches.append((None, self.statements(is_equation)))
        self.take("end")
        self.take(word)
        return Branches(word, branches, at)

    def _loop(self, word: str, is_equation: bool) -> Statement:
        at = self.at
        self.position += 1
        iterators = self.iterators() if word == "for" else []
        condition = self.expression() if word == "while" else None
        self.take("loop")
        body = self.statements(is_equation)
        self.take("end")
        self.take(word)
        return Loop(iterators, condition, body, at)
