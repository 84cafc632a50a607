"""Tokens of an expression in a file: numbers, names, texts and operators, read one after the other."""

from __future__ import annotations

import re

from acausal.errors import DeclarationError, shortened

MAX_LENGTH = 10_000
"""Characters up to which an expression is read."""

TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*(?:\[\d+(?:,\s*\d+)*\])?(?:\.(?:[A-Za-z_]\w*|'[^'\\.]*')(?:\[\d+(?:,\s*\d+)*\])?)*)"
    r'|(?P<text>"[^"\\]*")'
    r"|(?P<op><=|>=|==|<>|[-+*/^(){}\[\],;=<>]))"
)
KEYWORDS = ("if", "then", "elseif", "else", "and", "or", "not", "when", "elsewhen")


class ExpressionError(DeclarationError):
    """An expression in a file is malformed; the message holds the expression and the place in it."""


class TokenStream:
    """The tokens of one text, and how far they are read."""

    def __init__(self, text: str) -> None:
        if len(text) > MAX_LENGTH:
            raise ExpressionError(
                f"an expression of {len(text)} characters; at most {MAX_LENGTH} are read"
            )
        self.text = text
        self.tokens = self._tokens()
        self.position = 0

    def wrong(self, reason: str) -> ExpressionError:
        """The error, with the text and the reason."""
        return ExpressionError(f"'{shortened(self.text)}': {reason}")

    def peek(self) -> str:
        """The text of the next token; empty at the end."""
        return self.tokens[self.position][1] if self.position < len(self.tokens) else ""

    def advance(self) -> str:
        """The text of the next token, which is then read."""
        self.position += 1
        return self.tokens[self.position - 1][1]

    def take(self, expected: str) -> None:
        """Read one operator.

        Raises:
            ExpressionError: if another token is next.
        """
        if self.peek() != expected:
            found = f"'{self.peek()}'" if self.peek() else "the end"
            raise self.wrong(f"'{expected}' expected, {found} found")
        self.position += 1

    def expect_end(self) -> None:
        """Make sure that nothing follows.

        Raises:
            ExpressionError: if something does.
        """
        if self.position < len(self.tokens):
            raise self.wrong(f"'{shortened(self.peek())}' is not expected there")

    def _tokens(self) -> list[tuple[str, str]]:
        """Kind and text of every token."""
        found: list[tuple[str, str]] = []
        at, text = 0, self.text.rstrip()
        while at < len(text):
            match = TOKEN.match(text, at)
            if match is None:
                raise self.wrong(
                    f"'{text[at:].strip()[:1]}' is not allowed; numbers, names, + - * / ^ and parentheses are"
                )
            kind = str(match.lastgroup)
            found.append(("op" if match[kind] in KEYWORDS else kind, match[kind]))
            at = match.end()
        return found
