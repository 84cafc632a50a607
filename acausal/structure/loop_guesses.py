"""Loop guesses: further states from which Newton's method starts, so that a closed linkage keeps its assembly.

The angles of a closed linkage have several solutions, and a motion goes on with those nearest to the ones of the moment
before. So every tearing variable ``z`` of such a loop whose derivative is known has a state ``g`` that starts at the
solution and moves with it: ``der(g) = der(z) + |der(z)| (z - g) / nominal``. Nothing else depends on ``g``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.flattening import Integers, Template
from acausal.structure.algebraic_loops import TornLoop
from acausal.structure.blocks import Assignment
from acausal.structure.equations import matrix
from acausal.structure.projected_states import following
from acausal.structure.reduced_model import ReducedModel


def with_loop_guesses(reduced: ReducedModel) -> ReducedModel:
    """The model with a guess, behind its own states, of every tearing variable with a derivative in a loop of angles.

    All other loops start from start values.
    """
    loops = [s for s in reduced.steps if isinstance(s, TornLoop) and s.shape.is_periodic]
    known: list[tuple[int, int, int]] = []
    for tears in (s.unknowns[:, tear].tolist() for s in loops for tear in s.shape.torn.tears):
        rates = [reduced.resolve_derivative(z, 1) for z in tears if z < reduced.model.n_variables]
        if len(rates) == len(tears) and all(rates):
            known += [(z, *rate) for z, rate in zip(tears, rates, strict=True) if rate]
    if not known:
        return reduced
    solved, derivatives, signs = np.asarray(known, dtype=np.int64).T
    n, count = len(reduced.derivative), len(solved)
    guesses, rates = n + np.arange(count), n + count + np.arange(count)
    nothing, plus = np.full(count, -1, dtype=np.int64), np.ones(count, dtype=np.int64)
    rows: dict[Template, list[list[int]]] = {}
    for row in zip(
        rates, derivatives, solved, guesses, signs, reduced.nominal(solved), strict=True
    ):
        *nodes, sign, nominal = row
        rows.setdefault(following(int(sign), float(nominal)), []).append(list(map(int, nodes)))
    return replace(
        reduced,
        states=np.concatenate([reduced.states, guesses]),
        rates=np.concatenate([reduced.rates, rates]),
        rate_signs=np.concatenate([reduced.rate_signs, plus]),
        guessed=solved,
        base=np.concatenate([reduced.base, nothing, guesses]),
        derivative=np.concatenate([reduced.derivative, rates, nothing]),
        derivative_sign=np.concatenate([reduced.derivative_sign, plus, plus]),
        steps=(*reduced.steps, *(_assignment(*pair) for pair in rows.items())),
    )


def _assignment(template: Template, rows: list[list[int]]) -> Assignment:
    nothing: Integers = np.zeros((len(rows), 0), dtype=np.int64)
    return Assignment(template, 0, matrix(rows), nothing, nothing)
