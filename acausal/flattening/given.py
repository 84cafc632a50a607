"""Discrete variables that are given from outside, as measured, instead of found at events: they become inputs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from acausal.errors import DeclarationError, nearest, shown
from acausal.flattening.connections import zeros
from acausal.flattening.equation_group import UpdateGroup
from acausal.flattening.flat_model import FlatModel
from acausal.flattening.origin import is_hidden
from acausal.flattening.template import Integers
from acausal.modeling import names_in

Group = TypeVar("Group", bound=UpdateGroup)


def with_inputs(model: FlatModel, names: Sequence[str]) -> FlatModel:
    """The model with some discrete variables as inputs.

    What gave them is left out, and so are conditions that nothing else needs.

    Raises:
        DeclarationError: for a name that is not a discrete variable that equations give.
    """
    if isinstance(names, str):
        raise DeclarationError(
            f"inputs={shown(names)} is one name; give a list: inputs=[{names!r}]"
        )
    names = names_in(names, "inputs")
    if not names:
        return model
    given = np.asarray([_given(model, name) for name in dict.fromkeys(names)], dtype=np.int64)
    events = replace(model.events, updates=tuple(_without(model.events.updates, given)))
    idle = np.zeros(0, np.int64)
    while True:
        targets = [*(g.targets for g in events.guards), *(g.targets for g in events.updates)]
        known = np.concatenate([idle, *targets])
        read = [model.groups, model.initial, [g.group for g in events.all]]
        needed = np.concatenate([idle[:0], *(g.variables.ravel() for some in read for g in some)])
        unread = [
            v
            for v in np.setdiff1d(known, [*needed, *idle]).tolist()
            if is_hidden(model.layout.variable(v))
        ]
        if not unread:
            break
        idle = np.append(idle, unread)
        events = replace(
            events,
            guards=tuple(_without(events.guards, idle)),
            updates=tuple(_without(events.updates, idle)),
        )
    return replace(
        model,
        events=events,
        groups=(*model.groups, *zeros(idle, "a condition that nothing needs")),
        inputs=np.concatenate([model.inputs, given]),
        given=np.concatenate([given, idle]),
    )


def _given(model: FlatModel, name: str) -> int:
    """The number of a discrete variable that equations give."""
    targets = np.concatenate([np.zeros(0, np.int64), *(g.targets for g in model.events.updates)])
    index = model.layout.find_variable(name)
    if index is not None and index in targets:
        return index
    known = [n for n in map(model.layout.variable, targets.tolist()) if not is_hidden(n)]
    if index is not None and index in model.inputs:
        raise DeclarationError(f"inputs: '{name}' is an input already; leave it out")
    if not known:
        raise DeclarationError(f"inputs: the model has no discrete variables, so '{name}' is none")
    raise DeclarationError(
        f"inputs: '{name}' is not a discrete variable that an equation of the model gives: {nearest(name, known)}"
    )


def _without(groups: Iterable[Group], targets: Integers) -> Iterator[Group]:
    """The groups without the instances that give some variables."""
    for group in groups:
        kept = ~np.isin(group.targets, targets)
        if kept.all():
            yield group
        elif kept.any():
            yield replace(group, group=group.group.rows(kept), targets=group.targets[kept])
