"""Which parameters and networks act through switches, whose derivatives are zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

if TYPE_CHECKING:
    from acausal.system import System

STEPS = (sp.sign, sp.floor, sp.ceiling, sp.Heaviside)
"""Functions whose derivative is zero wherever it exists."""


def in_switches(system: System) -> set[str]:
    """The parameters and networks that decide a case (``where``, ``if``) or stand in a function with steps."""
    flat, layout = system.flat, system.flat.layout
    parameters, modules = set[int](), set[int]()
    for group in flat.equations(initial=True):
        switches = group.template.residual.atoms(Relational, *STEPS)
        deciding = set[sp.Basic]().union(*(s.free_symbols for s in switches))
        for slots, rows, found in (
            (group.template.parameters, group.parameters, parameters),
            (group.template.modules, group.modules, modules),
        ):
            for column, symbol in enumerate(slots):
                if symbol in deciding:
                    found.update(rows[:, column].tolist())
    waiting = {b.target: b.arguments for b in flat.bindings}
    reached = list(parameters)
    while reached:  # what they are bound to
        arguments = set(waiting.pop(reached.pop(), ())) - parameters
        parameters |= arguments
        reached += arguments
    owners = system.layout.chosen(np.asarray(sorted(modules), dtype=np.int64))
    return {layout.parameter(i) for i in parameters} | {layout.module(i) for i in owners}
