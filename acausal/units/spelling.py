"""The spelling of units: text such as ``"N.m/rad"`` or ``"W/(m2.K)"`` as a product of powers of symbols.

This is Modelica's notation. Also read are ``*`` and ``·`` for ``.``, ``^`` or ``**`` before an exponent, exponents as
superscripts, and ``°C``.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache

UnitFactors = tuple[tuple[str, Fraction], ...]
"""Symbols and their exponents, in the order of the text."""

TOKEN = re.compile(
    r"\s*(?:(?P<symbol>[^\W\d_]+(?:_[^\W\d_]+)*|[%°])"
    r"(?:(?P<power>[+-]?\d+)|\s*(?:\^|\*\*)\s*(?P<exact>[+-]?\d+(?:\.\d+)?))?"
    r"|(?P<op>[1./*()]))"
)


LONGEST = 200
"""No unit has more letters."""

PLAIN = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻·⋅", "0123456789-..")
"""Superscripts and raised dots in plain letters."""


class SpellingError(ValueError):
    """The text is not a product of powers of symbols."""


@cache
def factors_of(text: str) -> UnitFactors:
    """The factors of a unit; none for ``"1"``.

    Raises:
        SpellingError: for text of another form, an empty one among them.
    """
    if len(text) > LONGEST:
        raise SpellingError(text)
    reader = _Reader(text.translate(PLAIN).replace("°C", "degC").replace("°F", "degF"))
    found = reader.product()
    if reader.tokens:
        raise SpellingError(text)
    return found


class _Reader:
    """Recursive descent over the tokens of one unit."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens: list[re.Match[str]] = []
        at = 0
        while at < len(text.rstrip()):
            match = TOKEN.match(text, at)
            if match is None:
                raise SpellingError(text)
            self.tokens.append(match)
            at = match.end()
        self.tokens.reverse()

    def product(self) -> UnitFactors:
        """Factors with ``.``, ``*`` or ``/`` between them, from the left."""
        found = self._factor()
        while self.tokens and (op := self.tokens[-1]["op"]) in (".", "*", "/"):
            self.tokens.pop()
            right = self._factor()
            found += tuple((s, -power) for s, power in right) if op == "/" else right
        return found

    def _factor(self) -> UnitFactors:
        token = self.tokens.pop() if self.tokens else None
        if token is None:
            raise SpellingError(self.text)
        if token["symbol"]:
            return ((token["symbol"], Fraction(token["power"] or token["exact"] or 1)),)
        if token["op"] == "1":
            return ()
        if token["op"] == "(":
            found = self.product()
            if self.tokens and self.tokens.pop()["op"] == ")":
                return found
        raise SpellingError(self.text)
