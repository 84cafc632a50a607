"""Case distinctions: what is chosen, and that sympy does not simplify what it need not."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
import sympy as sp

import acausal as ac


def level(x: Any) -> Any:
    return ac.where(x > 2, 1, ac.where(x < -2, -1, x / 4))


@pytest.mark.parametrize(
    "condition",
    [
        lambda x, y: level(x) > level(y),
        lambda x, y: (level(x) <= 0.25) & ~(level(x) + level(y) < 0),
        lambda x, y: level(level(x) * 8) >= y,
    ],
)
def test_case_distinctions_are_compared_case_by_case(
    condition: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    x, y = sp.symbols("x y", real=True)
    places = list(itertools.product((-3, -1, 0, 1, 3), repeat=2))
    wanted = [int(bool(sp.sympify(condition(*map(sp.Integer, at))))) for at in places]
    monkeypatch.setattr(
        "sympy.functions.elementary.piecewise.piecewise_fold", lambda *_: pytest.fail("simplifies")
    )
    chosen = ac.where(condition(x, y), 1, 0)
    assert not any(c.has(sp.Piecewise) for _, c in chosen.args)
    assert [chosen.xreplace({x: sp.Integer(a), y: sp.Integer(b)}) for a, b in places] == wanted
    assert {0, 1} == set(wanted)
