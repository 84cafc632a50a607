"""Rules of products of matrices."""

from __future__ import annotations

import string
from collections.abc import Sequence

from acausal.export.graph.builder import Graph, Rule, Site, Tensor, Value


def _dot(site: Site) -> list[str]:
    """``Gemm`` of matrices, which turns them itself, ``MatMul`` with vectors, else ``Einsum``."""
    g, (one, two) = site.graph, site.values
    (left, right), (batch, _) = site.params["dimension_numbers"]
    ranks = [len(shape) for shape in site.shapes]
    if not len(batch) and len(left) == 1 and max(ranks) <= 2:
        turned = left[0] != ranks[0] - 1, right[0] != 0
        if ranks == [2, 2]:
            a, b = site.names
            return [g.add("Gemm", a, b, transA=int(turned[0]), transB=int(turned[1]))]
        a = _turned(g, one) if turned[0] else g.read(one)
        b = _turned(g, two) if turned[1] else g.read(two)
        return [g.add("MatMul", a, b)]
    return _einsum(site, ranks)


def _turned(g: Graph, matrix: Value) -> str:
    """A matrix with its axes exchanged, now if it is known."""
    if isinstance(matrix, Tensor):
        return g.add("Transpose", matrix.name, perm=[1, 0])
    return g.constant(matrix.T)


def _einsum(site: Site, ranks: Sequence[int]) -> list[str]:
    (left, right), (batch_left, batch_right) = site.params["dimension_numbers"]
    letters = iter(string.ascii_letters)
    one, two = [""] * ranks[0], [""] * ranks[1]
    shared = list(zip(batch_left, batch_right, strict=True))
    for i, j in [*shared, *zip(left, right, strict=True)]:
        one[i] = two[j] = next(letters)
    one = [letter or next(letters) for letter in one]
    two = [letter or next(letters) for letter in two]
    out = [one[i] for i in batch_left]
    out += [c for i, c in enumerate(one) if i not in (*batch_left, *left)]
    out += [c for j, c in enumerate(two) if j not in (*batch_right, *right)]
    return [
        site.graph.add(
            "Einsum", *site.names, equation=f"{''.join(one)},{''.join(two)}->{''.join(out)}"
        )
    ]


RULES: dict[str, Rule] = {"dot_general": _dot}
"""By operation, how its nodes are made."""
