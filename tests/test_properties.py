"""Random networks through the whole pipeline: refused or well posed, true to their equations, the same in any order.

The examples are the same in every run; ``--hypothesis-profile=search --hypothesis-seed=1`` tries others.
"""

from __future__ import annotations

import itertools
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st

import acausal as ac
from acausal.flattening.flat_model import flatten
from acausal.structure import TornLoop
from tests.support import pencil
from tests.support.interpret import in_numpy
from tests.support.networks import FLOW, KINDS, Element, Network, networks
from tests.support.oracle import flat_residuals, trajectory
from tests.support.slow import some_slow

TOLERANCE = 1e-8
ILL_CONDITIONED = 1e6


def compiled(network: Network) -> ac.System:
    """The network's system; an example that is ill posed is passed over."""
    try:
        return ac.compile(network.make())
    except ac.ModelError:
        assume(False)
        raise


@dataclass(frozen=True)
class Snapshot:
    """A system at a random point: values and derivatives of all its variables.

    Attributes:
        values: ``values[n]`` are the n-th derivatives, in the order of ``system.variables``.
        rates: what the system itself gives for ``der(variable)``, where it knows it.
        residuals: of all flat equations, by group; ``scale``: the largest of the values.
    """

    system: ac.System
    values: list[Any]
    rates: dict[str, float]
    residuals: list[Any]
    scale: float

    @staticmethod
    def of(system: ac.System, t: float, x: Any, u: Any) -> Snapshot:
        packed = system.pack()
        differentiated = tuple(filter(partial(is_differentiated, system), system.variables))
        stated = [n for g in system.flat.groups for n in g.template.orders]
        highest = max([1, *stated, *(order for _, order in system.reduced.input_orders)])

        def everything(t: Any, x: Any, u: Any) -> tuple[Any, Any, Any]:
            values = trajectory(system, packed, t, x, u, highest)
            rates = system.observe([f"der({n})" for n in differentiated], t, x, u, packed)
            return values, rates, flat_residuals(system, packed, t, values)

        found = in_numpy(everything, t, x, u)(t, x, u)
        values, rates, residuals = found[: highest + 1], found[highest + 1], found[highest + 2 :]
        scale = np.max([1.0, *(np.abs(v).max(initial=0.0) for v in values)])
        named = dict(zip(differentiated, rates.tolist(), strict=True))
        return Snapshot(system, values, named, residuals, float(scale))

    @staticmethod
    def anywhere(system: ac.System, seed: int) -> Snapshot:
        """At random states and inputs; where the values are huge the model is nearly singular, and passed over."""
        rng = np.random.default_rng(seed)
        x, u = (rng.uniform(0.2, 1.0, len(names)) for names in (system.states, system.inputs))
        found = Snapshot.of(system, rng.uniform(0.1, 0.9), x, u)
        assert np.isfinite(found.scale) or nonlinear(system)
        assume(found.scale < ILL_CONDITIONED)
        return found

    def __call__(self, name: str, order: int = 0) -> float:
        """The value of a variable, or of its derivative in time."""
        index = self.system.flat.layout.find_variable(name)
        assert index is not None, name
        return float(self.values[order][index])


def nonlinear(system: ac.System) -> bool:
    """Whether a loop is nonlinear, so that it may have no solution at some states."""
    return any(isinstance(s, TornLoop) and not s.shape.is_linear for s in system.reduced.steps)


def is_differentiated(system: ac.System, name: str) -> bool:
    """Whether the system knows ``der(name)``."""
    index = system.flat.layout.find_variable(name)
    assert index is not None
    return bool(system.reduced.derivative[system.reduced.resolve(index)[0]] >= 0)


# -- properties: each is checked for a network and some number to draw points and orders from --------------------


def it_is_refused_exactly_if_it_is_ill_posed(network: Network, seed: int) -> None:
    flat = flatten(network.make())
    expected = pencil.degree(flat)
    if expected is not None:
        assert len(ac.compile(network.make()).states) == expected
    else:
        with pytest.raises(ac.ModelError, match="|".join(f"'{e.name}" for e in network.elements)):
            ac.compile(network.make())


def it_obeys_the_equations_it_was_made_from(network: Network, seed: int) -> None:
    found = Snapshot.anywhere(compiled(network), seed)
    for group, rest in zip(found.system.flat.groups, found.residuals, strict=True):
        assert np.abs(rest).max(initial=0.0) <= TOLERANCE * found.scale, group.origins[0]
    for name, rate in found.rates.items():
        assert abs(rate - found(name, 1)) <= TOLERANCE * found.scale, f"der({name})"


def power_is_conserved(network: Network, seed: int) -> None:
    found = Snapshot.anywhere(compiled(network), seed)
    powers = {e.name: power_into(e, found) for e in network.elements}
    scale = TOLERANCE * max(1.0, *(abs(p) for parts in powers.values() for p in parts))
    assert abs(sum(sum(parts) for parts in powers.values())) <= scale, powers
    for element in network.elements:
        law = KINDS[element.kind].power
        if law is not None:
            expected = law(lambda name, order=0, e=element: read(e, found, name, order))
            assert abs(sum(powers[element.name]) - expected) <= scale, element


def power_into(element: Element, found: Snapshot) -> list[float]:
    """What flows in through each of its connectors."""
    parts: list[float] = []
    for end, domain in zip(KINDS[element.kind].ends, KINDS[element.kind].where, strict=True):
        potential, flow = (f"{element.name}.{end}.{name}" for name in FLOW[domain])
        effort = 1.0 if domain == "h" else found(potential, 0 if domain == "e" else 1)
        parts.append(found(flow) * effort)
    return parts


def read(element: Element, found: Snapshot, name: str, order: int) -> float:
    """A parameter or a variable of an element."""
    if name in element.modifiers:
        return float(element.modifiers[name])
    return found(f"{element.name}.{name}", order)


def order_and_direction_change_nothing(network: Network, seed: int) -> None:
    one = Snapshot.anywhere(compiled(network), seed)
    symmetric = [e.name for e in network.elements if KINDS[e.kind].turned is not None]
    turned = np.random.default_rng(seed).permutation(symmetric)[::2].tolist()
    system = ac.compile(network.shuffled(seed).turned(turned).make())
    there = {e.name: e for e in network.elements if e.name in turned}

    def same(name: str, order: int) -> float:
        """The value in the network as it was of a variable of the other."""
        if name.startswith("der("):
            return same(name[4:-1], order + 1)
        own, _, rest = name.partition(".")
        if own not in there:
            return one(name, order)
        kind = KINDS[there[own].kind]
        head, dot, tail = rest.partition(".")
        if head in kind.ends:
            return one(f"{own}.{kind.ends[1 - kind.ends.index(head)]}{dot}{tail}", order)
        return one(name, order) * (-1 if rest in (kind.turned or ()) else 1)

    rng = np.random.default_rng(seed)
    rng.uniform(0.2, 1.0, len(one.system.states) + len(one.system.inputs))
    t = rng.uniform(0.1, 0.9)
    x, u = ([same(name, 0) for name in names] for names in (system.states, system.inputs))
    other = Snapshot.of(system, t, np.asarray(x), np.asarray(u))
    for order, name in itertools.product((0, 1), system.variables):
        assert abs(other(name, order) - same(name, order)) <= TOLERANCE * one.scale, name


def gradients_agree_with_differences(network: Network, seed: int) -> None:
    system = compiled(network)
    names = system.layout.names
    assume(names and system.states)
    rng = np.random.default_rng(seed)
    x, u, weight = (
        rng.uniform(0.2, 1.0, len(n)) for n in (system.states, system.inputs, system.states)
    )
    params = system.parameters()
    at = np.asarray([float(params[n]) for n in names])
    along = rng.uniform(-1.0, 1.0, len(at)) * np.maximum(np.abs(at), 0.1)

    def weighted(p: Any) -> Any:
        given = {**params, **dict(zip(names, p, strict=True))}
        return jnp.sum(jnp.asarray(weight) * system.vector_field(0.3, x, u, given))

    value, gradient = in_numpy(jax.value_and_grad(weighted), at)(at)
    plain = in_numpy(weighted, at)
    h = 1e-5
    near = [plain(at + k * h * along)[0] for k in (-2, -1, 1, 2)]
    assume(abs(value) < ILL_CONDITIONED and max(map(abs, near)) < ILL_CONDITIONED)
    difference = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * h)
    scale = np.abs(gradient * along).sum() + abs(value) + 1.0
    assert abs(gradient @ along - difference) <= 1e-6 * scale


def a_file_holds_the_whole_network(network: Network, seed: int) -> None:
    system = compiled(network)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "network.json"
        ac.save(system.model, path)
        again = ac.compile(ac.load(path))
    assert again.states == system.states
    assert again.inputs == system.inputs
    assert again.parameters() == system.parameters()
    rng = np.random.default_rng(seed)
    x, u = (rng.uniform(0.2, 1.0, len(names)) for names in (system.states, system.inputs))
    rates = [
        in_numpy(s.vector_field, 0.3, x, u, s.pack())(0.3, x, u, s.pack())[0]
        for s in (system, again)
    ]
    assert rates[0].tobytes() == rates[1].tobytes()


PROPERTIES = (
    it_is_refused_exactly_if_it_is_ill_posed,
    it_obeys_the_equations_it_was_made_from,
    power_is_conserved,
    order_and_direction_change_nothing,
    gradients_agree_with_differences,
    a_file_holds_the_whole_network,
)
QUIET = tuple(HealthCheck)
GRADIENTS = [gradients_agree_with_differences]


@pytest.mark.cases(fast=1)
@pytest.mark.parametrize("holds", some_slow(PROPERTIES, GRADIENTS), ids=lambda p: p.__name__)
@settings(suppress_health_check=QUIET)
@given(network=networks(8, 4), seed=st.integers(0, 2**16))
def test_of_small_networks(holds: Any, network: Network, seed: int) -> None:
    holds(network, seed)


@pytest.mark.cases(slow=1)
@pytest.mark.parametrize(
    "holds", some_slow(PROPERTIES, PROPERTIES, GRADIENTS), ids=lambda p: p.__name__
)
@settings(suppress_health_check=QUIET)
@given(network=networks(30, 10), seed=st.integers(0, 2**16))
def test_of_larger_networks(holds: Any, network: Network, seed: int) -> None:
    holds(network, seed)
