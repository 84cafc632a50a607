"""Expressions of C: small trees of operators, printed with the fewest parentheses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

PRECEDENCE = {
    "?:": 1, "||": 2, "&&": 3, "==": 5, "!=": 5, "<": 6, "<=": 6, ">": 6, ">=": 6,
    "+": 8, "-": 8, "*": 9, "/": 9, "%": 9, "neg": 10, "!": 10, "cast": 10,
}  # fmt: skip
ATOM = 12
COMPARISONS = frozenset({"==", "!=", "<", "<=", ">", ">=", "&&", "||", "!"})


@dataclass(frozen=True, slots=True)
class Number:
    """A literal."""

    value: float | int | bool
    kind: str


@dataclass(frozen=True, slots=True)
class Read:
    """An element of an array, or a variable (``index`` is None)."""

    name: str
    index: Expr | None
    kind: str


@dataclass(frozen=True, slots=True)
class Apply:
    """An operator, a function of C's library or of the prelude, applied to arguments."""

    op: str
    args: tuple[Expr, ...]
    kind: str


Expr: TypeAlias = Number | Read | Apply


def integer(value: int) -> Number:
    """A whole number."""
    return Number(int(value), "int")


def variable(name: str, kind: str = "int") -> Read:
    """A variable."""
    return Read(name, None, kind)


def add(a: Expr, b: Expr) -> Expr:
    """The sum of two whole numbers, simplified."""
    if isinstance(a, Number) and isinstance(b, Number):
        return integer(int(a.value + b.value))
    if isinstance(a, Number):
        return b if a.value == 0 else add(b, a)
    if isinstance(b, Number):
        if b.value == 0:
            return a
        if isinstance(a, Apply) and a.op == "+" and isinstance(a.args[1], Number):
            return add(a.args[0], integer(int(a.args[1].value + b.value)))
        if b.value < 0:
            return Apply("-", (a, integer(int(-b.value))), "int")
    return Apply("+", (a, b), "int")


def times(a: Expr, factor: int) -> Expr:
    """A whole number times a known one, simplified."""
    if isinstance(a, Number):
        return integer(int(a.value * factor))
    if factor == 1:
        return a
    if factor == 0:
        return integer(0)
    if isinstance(a, Apply) and a.op == "+" and isinstance(a.args[1], Number):
        return add(times(a.args[0], factor), integer(int(a.args[1].value) * factor))
    return Apply("*", (integer(factor), a), "int")


def quotient(a: Expr, divisor: int) -> Expr:
    """A whole number over a known one, rounded down (it is not negative)."""
    if isinstance(a, Number):
        return integer(int(a.value) // divisor)
    return a if divisor == 1 else Apply("/", (a, integer(divisor)), "int")


def remainder(a: Expr, divisor: int) -> Expr:
    """What remains of a whole number that is not negative."""
    if isinstance(a, Number):
        return integer(int(a.value) % divisor)
    return integer(0) if divisor == 1 else Apply("%", (a, integer(divisor)), "int")


def convert(a: Expr, kind: str) -> Expr:
    """The same number as another kind."""
    if a.kind == kind or (a.kind == "bool" and kind == "int"):
        return a
    if isinstance(a, Number):
        value = {"real": float, "int": int, "bool": bool}[kind](a.value)
        return Number(value, kind)
    if kind == "bool":
        return Apply("!=", (a, Number(0.0, "real") if a.kind == "real" else integer(0)), "bool")
    return Apply("cast", (a,), kind)


def select(condition: Expr, yes: Expr, no: Expr) -> Expr:
    """One of two numbers."""
    if isinstance(condition, Number):
        return yes if condition.value else no
    return Apply("?:", (condition, yes, no), yes.kind)


def reads(expression: Expr) -> set[str]:
    """The names of all that an expression reads."""
    found: set[str] = set()
    stack: list[Expr] = [expression]
    while stack:
        node = stack.pop()
        match node:
            case Read(name, index):
                found.add(name)
                if index is not None:
                    stack.append(index)
            case Apply(_, args):
                stack.extend(args)
            case Number():
                pass
    return found


def literal(value: float | int | bool, kind: str) -> str:
    """A number as C writes it."""
    if kind != "real":
        return str(int(value))
    number = float(value)
    if number != number:
        return "NAN"
    if number in (float("inf"), float("-inf")):
        return "INFINITY" if number > 0 else "-INFINITY"
    text = repr(number)
    return f"R({text})" if "." in text or "e" in text else f"R({text}.0)"


def text(expression: Expr) -> str:
    """An expression as C."""
    return _text(expression, 0)


def _text(node: Expr, outer: int) -> str:
    match node:
        case Number(value, kind):
            written = literal(value, kind)
            return f"({written})" if written.startswith("-") and outer > 8 else written
        case Read(name, index):
            return name if index is None else f"{name}[{_text(index, 0)}]"
        case Apply(op, args):
            written, level = _apply(op, args, node.kind)
            return f"({written})" if level <= outer else written


def _apply(op: str, args: tuple[Expr, ...], kind: str) -> tuple[str, int]:
    level = PRECEDENCE.get(op, ATOM)
    if op == "?:":
        condition, yes, no = args
        return f"{_text(condition, 3)} ? {_text(yes, level)} : {_text(no, 0)}", level
    if op in ("neg", "!", "cast"):
        before = {"neg": "-", "!": "!", "cast": f"({kind})"}[op]
        return f"{before}{_text(args[0], level)}", level
    if op in PRECEDENCE:
        near, far = _around(op, level)
        left, right = args
        if op in ("&&", "||"):  # compilers ask for parentheses around one within the other
            near, far = (level - 1 if _is(a, op) else 4 for a in args)
        return f"{_text(left, near)} {op} {_text(right, far)}", level
    return f"{op}({', '.join(_text(a, 0) for a in args)})", ATOM


def _around(op: str, level: int) -> tuple[int, int]:
    """Up to which precedence the left and the right argument need parentheses."""
    return (7, 7) if op in COMPARISONS else (level - 1, level)


def _is(node: Expr, op: str) -> bool:
    return isinstance(node, Apply) and node.op == op
