"""Reading scattered elements in the cheapest way."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from acausal.codegen.gather import MAX_RUNS, IndexRuns, Interleaved, One, Take, gather
from acausal.codegen.reading import read_elements

ARRAYS = [jnp.arange(10.0), jnp.arange(100.0, 120.0), jnp.array(7.0), jnp.arange(5.0) * 10]
SIZES = [10, 20, 1, 5]
places = st.lists(
    st.sampled_from([(s, i) for s, n in enumerate(SIZES) for i in range(n)]),
    min_size=1,
    max_size=40,
)


def read(pairs):
    source, index = (np.array(c) for c in zip(*pairs, strict=True))
    return gather(source, index, SIZES)


def expected(pairs):
    return [float(jnp.atleast_1d(ARRAYS[s])[i]) for s, i in pairs]


@pytest.mark.slow
@settings(max_examples=25)
@given(places)
def test_elements_are_read_whatever_their_order(pairs):
    found = read(pairs)
    value = np.asarray(read_elements(found, ARRAYS))
    if isinstance(found, One):
        assert value.shape == ()
        value = np.broadcast_to(value, len(pairs))
    assert value.tolist() == expected(pairs)
    assert set(found.sources) == {s for s, _ in pairs}


@pytest.mark.parametrize(
    ("pairs", "kind"),
    [
        ([(0, 3)] * 4, One),
        ([(2, 0)], One),
        ([(0, i) for i in range(10)], IndexRuns),
        ([(1, i) for i in range(0, 20, 3)], IndexRuns),
        ([(0, 1), (0, 2), (1, 5), (1, 7)], IndexRuns),
        ([(s, i) for i in range(10) for s in (0, 1)], Interleaved),
        ([(0, i) if s else (1, 19 - i) for i in range(10) for s in (1, 0)], Take),
        ([(1, (7 * i * i + 3 * i) % 20) for i in range(20)], Take),
    ],
)
def test_the_cheapest_way_is_taken(pairs, kind):
    found = read(pairs)
    assert isinstance(found, kind)
    assert np.broadcast_to(
        np.asarray(read_elements(found, ARRAYS)), len(pairs)
    ).tolist() == expected(pairs)


def test_a_whole_array_is_not_copied():
    found = read([(0, i) for i in range(10)])
    assert read_elements(found, ARRAYS) is ARRAYS[0]


def test_nothing_to_read():
    nothing = np.empty(0, dtype=np.int64)
    assert read_elements(gather(nothing, nothing, SIZES), ARRAYS).shape == (0,)


def test_runs_are_bounded():
    found = read([(0, i) for i in (5, 3, 1, 4, 2, 0, 9, 7, 8, 6, 1, 5, 2, 9)])
    assert isinstance(found, Take)
    assert MAX_RUNS < 14


def test_components_in_turn_are_differentiated_without_a_scatter():
    found = read([(s, i) for i in range(10) for s in (0, 1)])
    program = jax.make_jaxpr(jax.grad(lambda a: jnp.sum(read_elements(found, a) ** 2)))(ARRAYS[:2])
    assert "scatter" not in str(program)
    assert "gather" not in str(program)
