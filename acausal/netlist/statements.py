"""Equations of a file, with events: ``n = pre(n) + 1``, and ``when h < 0 then reinit(v, -e*pre(v)) end when``.

Modelica's syntax: ``pre``, ``edge``, ``change``, ``initial()``, ``sample(start, period)``, ``when`` ... ``then`` ...
``elsewhen`` ... ``end when``, ``reinit``. The conditions of ``if`` are events, but not within ``noEvent(...)``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from acausal.modeling import (
    Eq,
    Reinit,
    When,
    change,
    condition,
    edge,
    initial,
    pre,
    sample,
)
from acausal.netlist.parser import Lookup, Reader

EVENT_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "pre": pre,
    "edge": edge,
    "change": change,
    "initial": initial,
    "sample": sample,
}


def parse_statement(text: str, lookup: Lookup) -> Eq | When:
    """An equation ``left = right``, or what happens at an event; names as for `parser.parse`.

    Raises:
        ExpressionError: one sentence that says where the text is wrong.
    """
    reader = _Statements(text, lookup)
    found = reader.when() if reader.peek == "when" else reader.equation()
    reader.expect_end()
    return found


class _Statements(Reader):
    """Expressions whose conditions are events, equations, and what happens at events."""

    events = True

    def equation(self) -> Eq:
        """Both sides of ``left = right``."""
        left = self.expression()
        self.take("=")
        return Eq(left, self.expression())

    def when(self) -> When:
        """A chain from ``when`` to ``end when``."""
        links: list[tuple[Any, list[Any]]] = []
        while self.peek in ("when", "elsewhen"):
            self.advance()
            conditions = self.expression()
            self.take("then")
            links.append((conditions, self._statements()))
        for word in ("end", "when"):
            self.take(word)
        self.accept(";")
        chain: When | None = None
        for conditions, statements in reversed(links):
            some = conditions if isinstance(conditions, list) else [conditions]
            truths = tuple(self.truth(c) for c in some)  # pyright: ignore[reportUnknownVariableType, reportUnknownArgumentType]
            chain = When(truths, *statements, otherwise=chain)
        assert chain is not None
        return chain

    def _statements(self) -> list[Any]:
        found: list[Any] = []
        while self.peek not in ("elsewhen", "end", ""):
            found.append(self._statement())
            if not self.accept(";"):
                break
        if not found:
            raise self.wrong("nothing stands behind 'then'")
        return found

    def _statement(self) -> Eq | Reinit:
        if not self.accept("reinit"):
            return self.equation()
        self.take("(")
        state = self.expression()
        self.take(",")
        value = self.expression()
        self.take(")")
        return Reinit(state, value)

    def truth(self, value: Any) -> Any:
        """A condition; a variable that is 1 or 0 is one, too."""
        if isinstance(value, sp.Symbol):
            return condition(value, "a condition")
        return super().truth(value)

    def function(self, name: str) -> Callable[..., Any] | None:
        """A function of expressions, or of events."""
        return EVENT_FUNCTIONS.get(name) or super().function(name)

    def call(self, name: str) -> Any:
        """The value of a call; in ``noEvent(...)`` conditions are evaluated as they stand."""
        if name != "noEvent":
            return super().call(name)
        before, self.events = self.events, False
        self.take("(")
        value = self.expression()
        self.take(")")
        self.events = before
        return value
