"""Thousands of wrong models and calls, made by chance: each is refused in one clear sentence, or turns out to be sound.

Every mutant follows from its kind and seed alone. To see one by itself, with its traceback::

    python -m tests.fuzz calls 17
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import jax
import pytest

from . import calls, interface, models, netlists, texts
from .outcome import GOOD, Mutant, Outcome, outcome, table

MAKERS: dict[str, tuple[Callable[[int, Path], Mutant], int]] = {
    "netlists": (netlists.mutant, 400),
    "models": (lambda seed, folder: models.mutant(seed), 350),
    "calls": (calls.mutant, len(calls.ALL)),
    "interface": (interface.mutant, 6000),
    "texts": (texts.mutant, 1000),
}
"""By kind: what makes the mutant of a seed, and how many there are. The slow tests try one in twenty-four of them."""


@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.parametrize(
    "every", [pytest.param(24, marks=pytest.mark.slow), pytest.param(1, marks=pytest.mark.machines)]
)
def test_wrong_models_get_a_sentence(
    name: str, every: int, tmp_path: Path, record_property: Any
) -> None:
    make, n = MAKERS[name]
    found: list[Outcome] = []
    for seed in range(0, n, every):
        found.append(outcome(make(seed, tmp_path)))
        if len(found) % 100 == 0:
            jax.clear_caches()  # a long run must not fill the memory
    lines = table(found)
    record_property("mutants", (name, lines))
    bad = [str(o) for o in found if o.sort not in GOOD]
    assert not bad, "\n".join([*lines, *bad])


def test_a_mutant_is_made_from_its_seed_alone(tmp_path: Path) -> None:
    for make, _ in MAKERS.values():
        for seed in (3, 17, 40):
            one, again = make(seed, tmp_path), make(seed, tmp_path)
            assert (one.domain, one.kind, one.detail) == (again.domain, again.kind, again.detail)


def test_mutants_are_various(tmp_path: Path) -> None:
    made = [make(seed, tmp_path) for make, n in MAKERS.values() for seed in range(n)]
    assert len(made) >= 1000
    assert len({m.kind for m in made}) > 80
    assert len({m.domain for m in made}) == 13
    assert len({(m.domain, m.kind, m.detail) for m in made}) > 900
