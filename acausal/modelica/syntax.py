"""The syntax tree of Modelica text. Every node has its offset in the text, ``at``."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, TypeAlias

from acausal.modelica.tokens import Source
from acausal.modeling import Placement


@dataclass(slots=True, eq=False)
class LiteralConstant:
    """A number, truth value or text."""

    value: Any
    at: int


@dataclass(slots=True, eq=False)
class DottedName:
    """A reference such as ``a.b[2].c``: words, and the subscripts of those that have some."""

    words: tuple[str, ...]
    subscripts: dict[int, list[Expression]]
    at: int

    @property
    def text(self) -> str:
        """The words with dots."""
        return ".".join(self.words)


@dataclass(slots=True, eq=False)
class FunctionCall:
    """A function applied; ``partial`` for ``function f(...)`` as an argument."""

    function: DottedName
    arguments: list[Expression]
    named: dict[str, Expression]
    at: int
    partial: bool = False


@dataclass(slots=True, eq=False)
class OperatorExpression:
    """An operator and what it is applied to, one or two."""

    operator: str
    operands: tuple[Expression, ...]
    at: int


@dataclass(slots=True, eq=False)
class Choice:
    """``if ... then ... else``: conditions with values, and the last value."""

    branches: list[tuple[Expression, Expression]]
    otherwise: Expression
    at: int


@dataclass(slots=True, eq=False)
class ArrayConstructor:
    """``{a, b}``."""

    items: list[Expression]
    at: int


@dataclass(slots=True, eq=False)
class MatrixConstructor:
    """``[a, b; c, d]``."""

    rows: list[list[Expression]]
    at: int


@dataclass(slots=True, eq=False)
class RangeExpression:
    """``first:step:last``."""

    first: Expression
    step: Expression | None
    last: Expression
    at: int


@dataclass(slots=True, eq=False)
class Comprehension:
    """``value for i in range``: argument of a reduction or of an array."""

    value: Expression
    iterators: list[tuple[str, Expression | None]]
    at: int


@dataclass(slots=True, eq=False)
class Several:
    """``(a, , b)``: results of a function; None where one is left out."""

    items: list[Expression | None]
    at: int


@dataclass(slots=True, eq=False)
class Whole:
    """``:``, a subscript, or a size that is left open."""

    at: int


@dataclass(slots=True, eq=False)
class EndSubscript:
    """``end`` in a subscript."""

    at: int


Expression: TypeAlias = (
    LiteralConstant
    | DottedName
    | FunctionCall
    | OperatorExpression
    | Choice
    | ArrayConstructor
    | MatrixConstructor
    | RangeExpression
    | Comprehension
    | Several
    | Whole
    | EndSubscript
)


# -- modifiers -----------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class ModificationSyntax:
    """``(a=1, b(start=2)) = value``."""

    arguments: list[ModificationArgument] = field(default_factory=list)
    value: Expression | None = None


@dataclass(slots=True, eq=False)
class ModificationArgument:
    """One argument of a modifier: a name with a modifier of its own, or a declaration that replaces one."""

    name: str
    modifier: ModificationSyntax
    at: int
    each: bool = False
    final: bool = False
    redeclared: Element | None = None


# -- elements ------------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class Import:
    """``import D = A.B``, ``import A.B``, ``import A.{B, C}``, ``import A.*``: the names, and what they mean."""

    package: str
    names: dict[str, str]
    everything: bool
    at: int


@dataclass(slots=True, eq=False)
class Extends:
    """``extends Base(modifiers)``."""

    base: DottedName
    modifier: ModificationSyntax
    at: int


@dataclass(slots=True, eq=False)
class Prefixes:
    """What stands in front of an element."""

    final: bool = False
    inner: bool = False
    outer: bool = False
    redeclare: bool = False
    replaceable: bool = False
    protected: bool = False
    connection: str = ""
    """``flow``, ``stream`` or nothing."""
    variability: str = ""
    """``parameter``, ``constant``, ``discrete`` or nothing."""
    causality: str = ""
    """``input``, ``output`` or nothing."""


@dataclass(slots=True, eq=False)
class Declared:
    """One component."""

    name: str
    type: DottedName
    subscripts: list[Expression]
    modifier: ModificationSyntax
    condition: Expression | None
    prefixes: Prefixes
    comment: str
    at: int
    constraint: Extends | None = None
    placement: Placement | None = None


@dataclass(slots=True, eq=False)
class ClassDefinition:
    """A class.

    Attributes:
        kind: ``model``, ``package``, ``function`` and so on.
        elements: imports, bases, components and classes, in their order.
        literals: of an enumeration, by name as it is written, with its quotes.
        short: of a short class, what it is made of.
        experiment: the arguments of its annotation of that name.
    """

    name: str
    kind: str
    source: Source
    at: int
    prefixes: Prefixes = field(default_factory=Prefixes)
    partial: bool = False
    expandable: bool = False
    encapsulated: bool = False
    extends_inherited: bool = False
    comment: str = ""
    elements: list[Import | Extends | Declared | ClassDefinition] = field(default_factory=list)
    short: ShortClass | None = None
    literals: dict[str, str] | None = None
    equations: list[Statement] = field(default_factory=list)
    initial_equations: list[Statement] = field(default_factory=list)
    algorithms: list[list[Statement]] = field(default_factory=list)
    initial_algorithms: list[list[Statement]] = field(default_factory=list)
    external: str | None = None
    experiment: dict[str, Expression] = field(default_factory=dict)
    constraint: Extends | None = None


@dataclass(slots=True, eq=False)
class ShortClass:
    """``= input Base[n](modifiers)``."""

    base: DottedName
    subscripts: list[Expression]
    modifier: ModificationSyntax
    causality: str
    connection: str


Element: TypeAlias = Import | Extends | Declared | ClassDefinition

# -- equations and statements ----------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class EquationStatement:
    """``left = right``, or in an algorithm ``left := right``."""

    left: Expression
    right: Expression
    at: int


@dataclass(slots=True, eq=False)
class Branches:
    """``if`` or ``when``."""

    word: str
    branches: list[Branch]
    at: int


@dataclass(slots=True, eq=False)
class Loop:
    """``for``; with a condition in the place of iterators ``while``."""

    iterators: list[tuple[str, Expression | None]]
    condition: Expression | None
    body: list[Statement]
    at: int


@dataclass(slots=True, eq=False)
class Connect:
    """``connect(a, b)``."""

    ends: tuple[DottedName, DottedName]
    at: int


@dataclass(slots=True, eq=False)
class Do:
    """A call that stands alone, such as ``assert(...)``; or ``break`` and ``return``."""

    call: FunctionCall
    at: int


Statement: TypeAlias = EquationStatement | Branches | Loop | Connect | Do

Branch: TypeAlias = tuple[Expression | None, list[Statement]]
"""A condition, and what applies where it is the first that holds; None for ``else``."""
