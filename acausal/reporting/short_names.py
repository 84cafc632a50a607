"""Short names for formulas: ``body.m`` is m with the subscript "body", and plain m where no other part has one."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations, pairwise

from acausal.modeling import antiderivatives

_LETTERS = """alpha beta gamma delta epsilon zeta eta theta kappa lambda lamda mu nu xi rho sigma tau phi chi psi omega
pi Gamma Delta Theta Lambda Sigma Phi Psi Omega"""

GREEK = {
    name: unicodedata.lookup(
        f"GREEK {'SMALL' if name.islower() else 'CAPITAL'} LETTER {name.replace('mb', 'm')}"
    )
    for name in _LETTERS.split()
}
"""Greek letters by the names that variables have."""

_LAST = re.compile(r"(?P<word>.*?)(?P<places>(?:\[[^\[\]]*\])*)(?P<primes>(?:'\d*)*)", re.DOTALL)


@dataclass(frozen=True, order=True)
class Short:
    """A name as a formula shows it.

    Attributes:
        base: the letter or word.
        subscript: below it; may be empty.
        dots: how many time derivatives are meant.
        primes: marks of derivatives by an argument, as for networks.
    """

    base: str
    subscript: str = ""
    dots: int = 0
    primes: str = ""

    @classmethod
    def of(cls, name: str, *below: str) -> Short:
        """A name without dots, such as ``v_rel`` or ``T[2]``, with further subscripts."""
        *dots, name = antiderivatives(name)
        found = _LAST.fullmatch(name.lstrip("_") or name)
        assert found is not None
        word, _, rest = found["word"].partition("_")
        places = found["places"].strip("[]").replace("][", ",")
        subscripts = [s for s in (rest.strip("_").replace("_", " "), places, *below) if s]
        return cls(GREEK.get(word, word), ", ".join(subscripts), len(dots), found["primes"])

    def differentiated(self) -> Short:
        """Its time derivative."""
        return replace(self, dots=self.dots + 1)

    @property
    def text(self) -> str:
        """In one line of text: ``v_rel``."""
        end = f"_{self.subscript}" if self.subscript else ""
        return "".join([self.base, "\u0307" * self.dots, self.primes, end])

    @property
    def latex(self) -> str:
        """As LaTeX."""
        base = self.base if len(self.base) == 1 else rf"\mathrm{{{_escaped(self.base)}}}"
        if self.dots:
            base = rf"\{'d' * min(self.dots, 4)}ot{{{base}}}"
        below = _escaped(self.subscript).replace(" ", r"\,")
        return f"{base}{_marks(self.primes)}" + (rf"_{{\mathrm{{{below}}}}}" if below else "")


def shorten(names: Iterable[str]) -> dict[str, Short]:
    """A short name for each of several dotted names; no two look alike.

    What tells a variable from others of its name becomes a subscript: the nearest part of its path that does, more
    parts where one is not enough.
    """
    full = list(dict.fromkeys(names))
    taken: dict[Short, str] = {}
    levels = {name: list(_candidates(name)) for name in full}
    wanted: dict[Short, set[str]] = {}
    for name, candidates in levels.items():
        for short in candidates:
            wanted.setdefault(short, set()).add(name)
    for name, candidates in levels.items():
        alone = (s for s in candidates if len(wanted[s]) == 1 and s not in taken)
        chosen = next(alone, Short(name))
        taken[chosen] = name
    return {name: short for short, name in taken.items()}


def with_owners(paths: Iterable[str]) -> Callable[[str], Short]:
    """How names are written that always say whose they are: ``heatPort.T`` is T with the index heatPort.

    Of names that are written together, what would look like others, beside ``T_heatPort``, is spelled out.
    """
    looks = sorted((_with_owner(path), path) for path in paths)
    alike = {p for (a, one), (b, other) in pairwise(looks) if a == b for p in (one, other)}
    spelled = {path for path in alike if "." in path}
    return lambda path: Short(path) if path in spelled else _with_owner(path)


def _with_owner(path: str) -> Short:
    """A name's letter, its last part up to the first underscore, and its index: the rest, and whose it is."""
    *dots, path = antiderivatives(path)
    *owners, last = ("t" if path == "time" else path).split(".")
    word, prime, rest = last.partition("'")
    base, _, index = word.partition("_")
    if not base or not (index or owners):
        base, index = word, ""
    below = ", ".join(filter(None, (index, ".".join(owners))))
    return Short(GREEK.get(base, base), below, len(dots), prime + rest)


def _candidates(name: str) -> Iterator[Short]:
    """Short names of growing length: without a path, with one part of it, with two and so on."""
    *dots, inner = antiderivatives(name)
    *path, last = inner.split(".")
    plain = replace(Short.of(last), dots=len(dots))
    parts = [p.replace("_", " ").replace("[", " ").replace("]", "") for p in reversed(path)]
    for count in range(min(len(parts), 2) + 1):
        for chosen in combinations(parts, count):
            below = [*filter(None, [plain.subscript]), *reversed(chosen)]
            yield replace(plain, subscript=", ".join(below))
    below = [*filter(None, [plain.subscript]), *reversed(parts)]
    yield replace(plain, subscript=", ".join(below))


def _escaped(text: str) -> str:
    return re.sub(r"([_#$%&{}])", r"\\\1", text)


def _marks(primes: str) -> str:
    """Primes as LaTeX: ``'`` by the first argument, a number by another."""
    found = re.findall(r"'(\d*)", primes)
    return "".join(rf"^{{\prime {n}}}" if n else "'" for n in found)
