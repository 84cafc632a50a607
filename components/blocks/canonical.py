"""Linear systems written as equations."""

from collections.abc import Iterator
from typing import Any

import acausal as ac


def dot(a: Any, b: Any) -> Any:
    """Sum of the products of two sequences of one length.

    Added up in pairs: term by term, every term would copy all before it.
    """
    terms = [x * y for x, y in zip(a, b, strict=True)]
    while len(terms) > 1:
        terms = [sum(terms[i : i + 2]) for i in range(0, len(terms), 2)]
    return sum(terms)


def canonical_form(u: Any, y: Any, x: Any, b: Any, a: Any) -> Iterator[ac.Eq]:
    """A transfer function ``b(s)/a(s)`` from ``u`` to ``y`` with states ``x`` in controller canonical form.

    Arguments:
        u, y, x: input, output and states, one fewer than ``a`` has elements.
        b, a: coefficients, highest power first; ``b`` has no more than ``a``.
    """
    b = (*[0] * (len(a) - len(b)), *b)
    d = b[0] / a[0]
    if len(x):
        yield ac.Eq(ac.der(x[0]), (u - dot(a[1:], x)) / a[0])
    for after, before in zip(x[1:], x[:-1], strict=True):
        yield ac.Eq(ac.der(after), before)
    residues = [bi - d * ai for ai, bi in zip(a[1:], b[1:], strict=True)]
    yield ac.Eq(y, dot(residues, x) + d * u)
