"""What of a trained model may change, and by how much as far as nothing else is known."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from acausal.networks import law_at, output_scale
from acausal.training.objective.problem import Problem
from acausal.training.objective.trainable import Trainable
from acausal.training.uncertainty.bumps import Bumped, Network, bumped_law, with_changes
from acausal.training.uncertainty.tangents import Move, law_directions

LEVELS = np.linspace(0.0, 1.0, 41)
"""Quantiles of a law's argument at which its deviation is taken."""


@dataclass(frozen=True, eq=False)
class Changes:
    """Directions in which a trained model may change, as numbers whose standard deviations are 1 without data.

    First come the bumps of all laws and the trained parameters, which all records have in common; then what each record
    has for itself; then the directions along the networks' own weights, which say what a law can take of a parameter or
    a start.

    Attributes:
        problem: what was trained. trainable: its result. params: its parameters and networks.
        seen: by network, the arguments it was called with over the records.
        bumped: by network, its law with bumps.
        heights: deviations of all bumps. of_parameters: of trained parameters. of_record: of what each record has.
        along: by network, how many directions its weights have, and the network moved along them.
    """

    problem: Problem
    trainable: Trainable
    params: dict[str, Any]
    seen: dict[str, Float[np.ndarray, "n_calls n_arguments"]]
    bumped: dict[str, Bumped]
    heights: Float[np.ndarray, " n_bumps"]
    of_parameters: Float[np.ndarray, " n_parameters"]
    of_record: Float[np.ndarray, " n_own"]
    along: dict[str, tuple[int, Move | None]]

    @property
    def deviations(self) -> Float[np.ndarray, " n_common"]:
        """Of what all records have in common."""
        return np.concatenate([self.heights, self.of_parameters])

    @property
    def scale(self) -> Float[np.ndarray, " n"]:
        """Deviations in all directions."""
        directions = sum(n for n, _ in self.along.values())
        return np.concatenate([self.deviations, self.of_record, np.ones(directions)])

    @property
    def parameters(self) -> slice:
        """The places of trained parameters."""
        return slice(len(self.heights), len(self.heights) + len(self.of_parameters))

    @property
    def common(self) -> slice:
        """The places of what all records have in common."""
        return slice(0, self.parameters.stop)

    @property
    def own(self) -> slice:
        """The places of what each record has for itself."""
        return slice(self.common.stop, self.common.stop + len(self.of_record))

    @property
    def places_along(self) -> dict[str, slice]:
        """By network, the places of the directions along its weights."""
        ends = np.cumsum([self.own.stop, *(n for n, _ in self.along.values())]).tolist()
        pairs = zip(self.along, itertools.pairwise(ends), strict=True)
        return {name: slice(*pair) for name, pair in pairs}

    def __call__(self, z: Float[Array, " n"]) -> tuple[Trainable, dict[str, Any]]:
        """What is trained, and parameters and networks, after changes."""
        moves, places = jnp.asarray(self.scale) * z, self.places_along
        laws: dict[str, Any] = {
            name: law if move is None else replace(law, net=move(moves[places[name]]))
            for (name, law), (_, move) in zip(self.bumped.items(), self.along.values(), strict=True)
        }
        new = with_changes(self.problem, self.params, laws, moves[self.common])
        return _moved(self.problem, self.trainable, moves[self.own]), new


def changes(
    problem: Problem,
    trainable: Trainable,
    seen: dict[str, Float[np.ndarray, "n_calls n_arguments"]],
) -> Changes:
    """What may change in a trained model; arguments as of `confidence`."""
    params, laws = problem.assemble(trainable), problem.networks
    bumped = {n: bumped_law(params[n], seen[n]) for n in laws}
    heights = [np.full(len(bumped[n].heights), _size(params[n], seen[n])) for n in laws]
    begins = any(a is not None for a in (trainable.starts, trainable.states))
    alone = not (problem.modifiers.names or begins)  # then there is nothing that a law could take
    return Changes(
        problem,
        trainable,
        params,
        seen,
        bumped,
        np.concatenate([*heights, np.zeros(0)]),
        _prior(problem, params),
        _own_deviations(problem, trainable),
        {n: (0, None) if alone else law_directions(params[n], seen[n]) for n in laws},
    )


def _size(network: Network, seen: Float[np.ndarray, "n_calls n_arguments"]) -> float:
    """How much a law may change, as far as nothing else is known: by its scale, or by its own deviation."""
    law = np.asarray(law_at(network, np.quantile(seen[:, 0], LEVELS), seen[:, 1:].mean(axis=0)))
    return max(output_scale(network), float(np.std(law)))


def _prior(problem: Problem, params: dict[str, Any]) -> Float[np.ndarray, " n_parameters"]:
    """The prior standard deviations of parameters: from where they began or ended, whichever is larger."""
    rows = zip(
        problem.modifiers.names, problem.modifiers.kinds, problem.modifiers.values, strict=True
    )
    return np.array(
        [max(kind.prior_deviation(float(v)) for v in (start, params[n])) for n, kind, start in rows]
    )


def _own_deviations(problem: Problem, trainable: Trainable) -> Float[np.ndarray, " n_own"]:
    """The prior standard deviations of what each record has for itself: its parameters, and a trained initial state."""
    found = (trainable.states, trainable.starts)
    states = sum(a.shape[1] for a in found if a is not None)
    return np.concatenate([np.asarray(problem.per_record.scale), np.ones(states)])


def _moved(problem: Problem, trainable: Trainable, own: Float[Array, " n_own"]) -> Trainable:
    """The same with other parameters and initial states of each record: the same change for all records.

    A record's predictions depend on its own alone, so that one direction gives the derivatives for all records.
    """
    names, scale = problem.per_record.names, problem.per_record.scale
    per_record = {n: trainable.per_record[n] + own[i] / scale[i] for i, n in enumerate(names)}
    states, starts = trainable.states, trainable.starts
    moves = own[len(names) :]
    if starts is not None:
        starts, moves = starts + moves[: starts.shape[1]], moves[starts.shape[1] :]
    if states is not None and problem.shooting is not None:
        all_first = len(states) == problem.records.count
        first = jnp.arange(len(states)) if all_first else problem.shooting.first
        states = states.at[first].add(moves)
    return replace(trainable, per_record=per_record, states=states, starts=starts)
