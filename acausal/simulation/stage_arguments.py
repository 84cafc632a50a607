"""The arguments that diffrax passes to a root finder. No other file depends on how its solvers write these equations.

diffrax calls a root finder with arguments that it does not document. `tests/simulation/test_stage_arguments.py` fails
when diffrax changes them; simulations still work then, with tolerances that apply to the stage's unknown.
"""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float, PyTree

KEPT = "init_state"
"""The option by which diffrax hands a state of the root finder on to the next stage."""


class Stage(NamedTuple):
    """The state of the model at a stage of an implicit step.

    Attributes:
        state: the state, shape (n_states,).
        per_unit: how much it changes with the stage's unknown, element by element.
    """

    state: Float[Array, " n_states"]
    per_unit: Float[Array, " n_states"]


def stage_of(unknown: Float[Array, " n_states"], args: PyTree) -> Stage:
    """The state of the model at a stage; the unknown itself if the arguments are not as expected.

    Arguments:
        unknown: of the stage: a derivative, a derivative times the step, or (implicit Euler) the change over the step.
        args: the arguments of the stage's equations in diffrax.
    """
    ones = jnp.ones_like(unknown)
    match args:
        case (_, diagonal, _, product, _, partial, _, control) if callable(product):
            per_unit = diagonal * product(ones, control)  # the unknown is a derivative
        case (_, diagonal, product, _, partial, _, _) if callable(product):
            per_unit = diagonal * ones  # a derivative times the step
        case (product, _, partial, _, _) if callable(product):
            per_unit = ones  # the change over an implicit Euler step
        case _:
            return Stage(unknown, ones)
    if not jnp.shape(partial) == jnp.shape(per_unit) == unknown.shape:
        return Stage(unknown, ones)
    return Stage(partial + per_unit * unknown, per_unit)
