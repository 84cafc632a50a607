"""Equations as MathML, with names as an engineer writes them: ``flange_b.f`` is an f with the index flange_b."""

from __future__ import annotations

import html
import itertools
import unicodedata
from typing import Any, cast

import sympy as sp
from sympy.printing.mathml import MathMLPresentationPrinter

from acausal.modeling import ModuleCall, der, primes

DIGITS = 6
"""Significant digits of numbers."""


def mathml(lhs: Any, rhs: Any) -> str:
    """An equation between two expressions, as one element."""
    printer: Any = _Printer({"mul_symbol": "⁢"})
    printer.literal = _alike({_path(s) for side in (lhs, rhs) for s in side.free_symbols})
    row = printer.dom.createElement("mrow")
    row.appendChild(printer._print(_readable(lhs)))
    row.appendChild(printer.text("mo", "="))
    row.appendChild(printer._print(_readable(rhs)))
    written = row.toxml().replace("<mo>-</mo>", "<mo>\u2212</mo>")
    return f'<math display="block">{written}</math>'


def _readable(expression: Any) -> Any:
    """Floats with a few digits, and whole ones without a point."""
    short = {
        f: sp.Integer(int(f)) if f == int(f) and abs(f) < 1e6 else sp.Float(f, DIGITS)
        for f in expression.atoms(sp.Float)
    }
    return expression.xreplace(short) if short else expression


def _path(symbol: Any) -> str:
    return getattr(symbol, "path", symbol.name)


def _parts(path: str) -> tuple[str, str]:
    """A name's letter, its last part up to the first underscore, and its index: the rest, and whose it is."""
    *owners, last = path.split(".")
    base, _, index = last.partition("_")
    if not base or not (index or owners):
        base, index = last, ""
    return base, ", ".join(filter(None, (index, ".".join(owners))))


def _alike(paths: set[str]) -> frozenset[str]:
    """The dotted names that would look like others, as ``heatPort.T`` beside ``T_heatPort``: they are spelled out."""
    looks = sorted((_parts(path), path) for path in paths)
    pairs = itertools.pairwise(looks)
    return frozenset(
        p for (a, one), (b, other) in pairs if a == b for p in (one, other) if "." in p
    )


class _Printer(MathMLPresentationPrinter):
    """Names with indices, time derivatives with dots, networks as functions."""

    dom: Any
    literal: frozenset[str] = frozenset()

    def text(self, tag: str, content: str) -> Any:
        element = self.dom.createElement(tag)
        element.appendChild(
            self.dom.createTextNode(html.escape(content))
        )  # sympy writes it as it is
        return element

    def name(self, path: str, dotted: bool = False) -> Any:
        """A name: its last part up to the first underscore, with a dot if it is a derivative; the rest is the index."""
        base, below = (path, "") if path in self.literal else _parts(path)
        letter = self.text("mi", _letter(base))
        if dotted:
            letter = self._dotted(letter)
        if not below:
            return letter
        element = self.dom.createElement("msub")
        element.appendChild(letter)
        element.appendChild(self.text("mtext", below))
        return element

    def _print_Symbol(self, sym: Any, style: str = "plain") -> Any:
        name = _path(sym)
        if name.startswith("der(") and name.endswith(")"):
            return self.name(name[4:-1], dotted=True)
        return self.name("t" if name == "time" else name)

    def _dotted(self, inner: Any) -> Any:
        over = self.dom.createElement("mover")
        over.appendChild(inner)
        over.appendChild(self.text("mo", "\u02d9"))
        return over

    def _print_Derivative(self, e: Any) -> Any:
        return self._derivative(e.expr)

    def _derivative(self, inner: Any) -> Any:
        if inner.is_Symbol:
            return self.name(_path(inner), dotted=True)
        return self._called(self.text("mi", "der"), (inner,))

    def _called(self, head: Any, arguments: Any) -> Any:
        row = self.dom.createElement("mrow")
        row.appendChild(head)
        row.appendChild(self.text("mo", "("))
        for i, argument in enumerate(arguments):
            if i:
                row.appendChild(self.text("mo", ","))
            row.appendChild(self._print(argument))
        row.appendChild(self.text("mo", ")"))
        return row

    def _print_Function(self, e: Any) -> Any:
        match e:
            case der():
                return self._derivative(e.args[0])
            case ModuleCall():
                module, orders, *arguments = cast(tuple[Any, ...], e.args)
                head = self.name(getattr(module, "path", str(module)) + primes(orders))
                return self._called(head, arguments)
            case _ if isinstance(e, sp.core.function.AppliedUndef) or type(e).__module__.startswith(
                "acausal"
            ):
                return self._called(self.name(e.func.__name__), e.args)
            case _:
                return super()._print_Function(e)

    _print_AppliedUndef = _print_Function


def _letter(name: str) -> str:
    """A Greek letter for its name, in Unicode's spelling; any other name as it is."""
    case = "CAPITAL" if name[:1].isupper() else "SMALL"
    spelled = "LAMDA" if name.lower() == "lambda" else name.upper()
    try:
        return unicodedata.lookup(f"GREEK {case} LETTER {spelled}")
    except KeyError:
        return name
