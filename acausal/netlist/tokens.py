"""Tokens of an expression in a file: numbers, names, texts and operators."""

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


def tokens_of(text: str) -> tuple[list[str], list[str]]:
    """Kinds and texts of the tokens of an expression; the last one is the end, with an empty text.

    Raises:
        ExpressionError: for a text that is too long, or a sign that no expression has.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(
            f"an expression of {len(text)} characters; at most {MAX_LENGTH} are read"
        )
    kinds: list[str] = []
    texts: list[str] = []
    at, end = 0, len(text.rstrip())
    while at < end:
        match = TOKEN.match(text, at, end)
        if match is None:
            sign = text[at:].strip()[:1]
            raise ExpressionError(
                f"'{shortened(text)}': '{sign}' is not allowed; numbers, names, + - * / ^ and parentheses are"
            )
        kind = str(match.lastgroup)
        kinds.append("op" if match[kind] in KEYWORDS else kind)
        texts.append(match[kind])
        at = match.end()
    return [*kinds, ""], [*texts, ""]
