"""Gradients through events, compared with central differences: fixed and adaptive steps, reverse and forward mode."""

from __future__ import annotations

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import Array

import acausal as ac
from tests.gradients.hybrid_models import HYBRIDS
from tests.gradients.paths import QUICK, central
from tests.support.slow import in_turn

BAR = 1e-5
"""The largest error of a component, relative to itself."""

SMALL = 1e-3
"""Of the largest component: smaller ones are compared with this instead."""

DEAR = (
    "arc",
    "averages",
    "clutch",
    "elastic gap",
    "free wheel",
    "held inputs",
    "rectifier",
    "stick-slip",
    "stop",
)
"""Models whose gradients take longest to compile: with all combinations only."""

TIGHT = {"rtol": 1e-11, "atol": 1e-13, "solver": "tsit5"}


def _along(rng: np.random.Generator, leaf: Any) -> Any:
    """A direction of a network's weights."""
    is_weight = isinstance(leaf, Array | np.ndarray) and jnp.issubdtype(leaf.dtype, jnp.inexact)
    return jnp.asarray(rng.standard_normal(leaf.shape)) if is_weight else None


class Subject:
    """A compiled model, and what is moved: a number for each parameter, initial value and input."""

    def __init__(self, name: str) -> None:
        self.name, self.case = name, HYBRIDS[name]
        case = self.case
        self.system = ac.compile(case.make())
        self.base = self.system.parameters(0)
        self.moved = tuple(name for end in case.moved for name in self._ending(end))
        rng = np.random.default_rng(1)
        networks = {n: v for n, v in self.base.items() if n not in self.system.layout.names}
        self.direction = {n: jax.tree.map(partial(_along, rng), v) for n, v in networks.items()}
        samples = [f"{n}({t})" for n, (times, _) in case.held.items() for t in times]
        constant = (*self.moved, *case.x0, *case.inputs)
        self.names = (*constant, *samples, *(["networks"] if networks else []))

    def _ending(self, end: str) -> list[str]:
        found = [n for n in self.base if n == end or n.endswith(f".{end}")]
        assert found, f"no parameter {end} among {list(self.base)}"
        return found[:1]

    def run(self, shift: Any, **steps: Any) -> ac.Solution:
        """A simulation; each number is moved by a fraction of itself (of 1 where it is 0)."""
        case = self.case
        given = [(n, self.base[n]) for n in self.moved]
        given += [*case.x0.items(), *case.inputs.items()]
        values = [(n, v + s * (abs(v) or 1.0)) for (n, v), s in zip(given, shift, strict=False)]
        n, m, end = len(self.moved), len(self.moved) + len(case.x0), len(values)
        signals: dict[str, ac.Signal] = {}
        for name, (times, interpolation) in case.held.items():
            own = 1 + np.sin(3 * np.arange(len(times))) + shift[end : end + len(times)]
            signals[name], end = ac.Signal(times, own, interpolation), end + len(times)  # pyright: ignore[reportArgumentType]
        networks = {
            name: jax.tree.map(
                lambda w, d: w if d is None else w + shift[-1] * d,
                self.base[name],
                way,
                is_leaf=lambda a: a is None,
            )
            for name, way in self.direction.items()
        }
        return ac.simulate(
            self.system,
            (0.0, case.end),
            saveat=[case.end * s for s in case.saved],
            params=self.base | networks | dict(values[:n]),
            x0=dict(values[n:m]) or None,
            inputs={**dict(values[m:]), **signals} or None,
            **steps,
        )

    def steps(self, kind: str) -> dict[str, Any]:
        """Options of the simulation."""
        if kind != "fixed":
            return TIGHT | ({} if kind == "adaptive" else {"solver": kind})
        return {"dt": self.case.end / self.case.steps, "solver": "rk4"}


def compare(subject: Subject, kind: str, record_property: Any, *, forward: bool = True) -> None:
    """Reverse mode, and forward mode where it is wanted, beside differences."""
    steps, zero = subject.steps(kind), jnp.zeros(len(subject.names))

    def values(shift: Array) -> Array:
        return subject.run(shift, **steps).x.ravel()

    def loss(shift: Array, weights: Array) -> tuple[Array, Array]:
        found = values(shift)
        return weights @ found, found

    reverse = jax.jit(jax.grad(loss, has_aux=True), compiler_options=QUICK)
    at_zero = np.asarray(reverse(zero, jnp.zeros(jax.eval_shape(values, zero).shape))[1])
    scale = np.maximum(np.abs(at_zero), 1e-3 * np.abs(at_zero).max())
    weights = jnp.asarray(np.random.default_rng(2).uniform(0.5, 1.5, len(scale)) / scale)
    found = {"reverse": np.asarray(reverse(zero, weights)[0])}
    if forward:
        along = jax.jit(lambda d: jax.jvp(values, (zero,), (d,))[1], compiler_options=QUICK)
        found["forward"] = np.array([weights @ along(one) for one in jnp.eye(len(zero))])
    wanted = central(lambda s: float(weights @ reverse(jnp.asarray(s), weights)[1]), len(zero))
    size = np.maximum(np.abs(wanted), SMALL * np.abs(wanted).max())
    for mode, gradient in found.items():
        error = float((np.abs(gradient - wanted) / size).max())
        record_property("gradient", (f"events, {kind}, {mode}", error, subject.name))
        table = [
            f"{n}: {g:.9g} beside {w:.9g}"
            for n, g, w in zip(subject.names, gradient, wanted, strict=True)
        ]
        assert error < BAR, f"{kind}, {mode}, {error:.1e}:\n" + "\n".join(table)


def kind_of(name: str) -> str:
    """One kind of steps of a model: they alternate from model to model."""
    kinds = HYBRIDS[name].kinds
    return kinds[list(HYBRIDS).index(name) % len(kinds)]


@pytest.mark.cases(slow=2)
@pytest.mark.parametrize("name", in_turn(HYBRIDS, 1, machines=DEAR))
def test_gradients(name: str, record_property: Any) -> None:
    """Each model in reverse mode, and every third in forward mode, in one kind of steps."""
    subject = Subject(name)
    run = subject.run(np.zeros(len(subject.names)), **subject.steps(kind_of(name)))
    assert len(run.events) >= subject.case.events
    forward = list(HYBRIDS).index(name) % 3 == 0
    compare(subject, kind_of(name), record_property, forward=forward)


@pytest.mark.machines
@pytest.mark.parametrize(
    ("name", "kind"), [(n, kind) for n, case in HYBRIDS.items() for kind in case.kinds]
)
def test_gradients_in_all_steps(name: str, kind: str, record_property: Any) -> None:
    compare(Subject(name), kind, record_property)
