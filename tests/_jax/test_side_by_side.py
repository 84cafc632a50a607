"""Loops of instances side by side: each ends by itself, and what they collect is not copied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

from acausal._jax import cond_any, one_by_one, while_any

ROOM = 7
"""Passes that there is room for; a number that no other array of the tests has as its length."""


def halvings(x: Any) -> tuple[Any, Any]:
    """What a number becomes by halving it until it is below one, and how often that takes."""

    def goes_on(state: tuple[Any, Any, Any]) -> Any:
        return state[1] >= 1

    def halve(state: tuple[Any, Any, Any], runs: Any) -> tuple[Any, Any, Any]:
        found, x, k = state
        found = found.at[jnp.where(runs, k, ROOM)].set(x / 2, mode="drop")
        return found, jnp.where(runs, x / 2, x), k + runs

    found, _, k = while_any(goes_on, halve, (jnp.zeros(ROOM), x, jnp.asarray(0)))
    return found, k


def expected(x: float) -> tuple[np.ndarray, int]:
    found, k = np.zeros(ROOM), 0
    while x >= 1:
        x = found[k] = x / 2
        k += 1
    return found, k


NUMBERS = np.array([[0.5, 1.0, 7.0], [100.0, 3.0, 2.0]])


def test_each_instance_ends_by_itself() -> None:
    one = jax.jit(halvings)(NUMBERS[1, 0])
    np.testing.assert_array_equal(one[0], expected(100.0)[0])
    for mapped, numbers in (
        (jax.vmap(halvings), NUMBERS[1]),
        (jax.vmap(jax.vmap(halvings)), NUMBERS),
    ):
        found, counts = jax.jit(mapped)(numbers)
        for i in np.ndindex(numbers.shape):
            array, count = expected(numbers[i])
            np.testing.assert_array_equal(found[i], array)
            assert counts[i] == count


def test_what_a_loop_collects_is_not_chosen_after_each_pass() -> None:
    def chosen(function: Callable[[Any], Any]) -> bool:
        text = jax.jit(jax.vmap(function)).lower(NUMBERS[1]).as_text()
        return f"tensor<3x{ROOM}xi1>, tensor<3x{ROOM}xf64>" in text

    def plain(x: Any) -> Any:
        start = jnp.zeros(ROOM), x, 0
        body = lambda s: (s[0].at[s[2]].set(s[1] / 2), s[1] / 2, s[2] + 1)  # noqa: E731
        return lax.while_loop(lambda s: s[1] >= 1, body, start)[0]

    assert chosen(plain)
    assert not chosen(lambda x: halvings(x)[0])


def test_derivatives_in_forward_mode() -> None:
    value, rate = jax.jvp(lambda x: halvings(x)[0], (6.0,), (1.0,))
    np.testing.assert_array_equal(value[:4], [3, 1.5, 0.75, 0])
    np.testing.assert_array_equal(rate[:4], [0.5, 0.25, 0.125, 0])
    np.testing.assert_array_equal(
        jax.vmap(jax.jacfwd(lambda x: halvings(x)[0]))(6.0 * jnp.ones(2)), [rate, rate]
    )


@pytest.mark.parametrize("mapped", [False, True])
def test_a_branch_is_for_those_that_need_it(mapped: bool) -> None:
    def root(x: Any) -> Any:
        return cond_any(x > 0, lambda: jnp.sqrt(x), lambda: x)

    numbers = np.array([4.0, -1.0, 9.0])
    found = jax.vmap(root)(numbers) if mapped else [root(x) for x in numbers]
    np.testing.assert_array_equal(found, [2, -1, 3])
    rate = lambda x: jax.jvp(root, (x,), (1.0,))[1]  # noqa: E731
    rates = jax.vmap(rate)(numbers) if mapped else [rate(x) for x in numbers]
    np.testing.assert_allclose(rates, [1 / 4, 1, 1 / 6])


def test_one_by_one_gives_what_side_by_side_gives() -> None:
    def scaled(values: tuple[Any, Any], by: Any) -> dict[str, Any]:
        return {"found": halvings(values[0] * by)[0], "same": values[1]}

    one = one_by_one(scaled)
    for axes in (((0, None), None), ((0, 0), 0), ((None, None), 0)):
        shaped = [NUMBERS[1] if axis == 0 else jnp.asarray(5.0) for axis in (*axes[0], axes[1])]
        found, expected = (
            jax.vmap(f, in_axes=axes)((shaped[0], shaped[1]), shaped[2]) for f in (one, scaled)
        )
        jax.tree.map(np.testing.assert_array_equal, found, expected)
