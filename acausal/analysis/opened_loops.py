"""Loops opened at connections, by name: loop transfer, sensitivity and complementary sensitivity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Float

from acausal.analysis.linearization import Linearization, Where, linearize, point_of
from acausal.errors import need_compiled
from acausal.modeling import names_in

if TYPE_CHECKING:
    from acausal.system import Params, System


@dataclass(frozen=True, eq=False)
class OpenLoop:
    """What a model does to signals that are added at analysis points, near a point of operation.

    A point is a signal that a connection feeds. With the connection open, ``output = G input``: ``input`` enters at the
    point, and ``output`` is what would have fed it.

    Attributes:
        opened: ``G``, the model with open connections.
    """

    opened: Linearization

    @property
    def transfer(self) -> Linearization:
        """The loop transfer ``L = -G`` of negative feedback: the loop is stable as its Nyquist curve goes round -1."""
        return replace(self.opened, C=-self.opened.C, D=-self.opened.D)

    @property
    def sensitivity(self) -> Linearization:
        """``S = (I + L)^-1``: from what is added at the point to the signal there."""
        A, B, C, D = self.opened
        direct = jnp.linalg.inv(jnp.eye(len(D)) - D)
        return replace(
            self.opened, A=A + B @ direct @ C, B=B @ direct, C=direct @ C, D=direct,
            outputs=self.opened.inputs,
        )  # fmt: skip

    @property
    def complementary(self) -> Linearization:
        """``T = I - S = (I + L)^-1 L``: from what is added at the point to what feeds it, with the other sign."""
        S = self.sensitivity
        return replace(S, C=-S.C, D=jnp.eye(len(S.D)) - S.D, outputs=self.opened.outputs)


def open_loop(
    system: System,
    points: str | Sequence[str],
    x: Where = None,
    *,
    inputs: Mapping[str, Any] | Float[ArrayLike, " n_inputs"] | None = None,
    params: Params | None = None,
    t: float | None = None,
) -> OpenLoop:
    """Open signal connections and linearize the model there; the model stays as it is.

    Arguments:
        system: a compiled model.
        points: input signals of components, each fed by a connection, such as ``"motor.tau_ref"``.
        x, inputs, params, t: where, as of `linearize`: a point of the closed loop.

    Raises:
        DeclarationError: for a point that no connection feeds.
        DataError: if ``x`` or ``inputs`` do not fit the model.
        ModelError: for a model that is not compiled.
    """
    need_compiled(system, "open_loop")
    points = names_in(points, "points")
    opened, sources = system.opened(points)
    names = (*opened.states, *opened.inputs)
    at = point_of(system, x, inputs, params, t)
    known = dict(zip(names, system.read(names, at), strict=True))
    found = linearize(
        opened,
        {n: known[n] for n in opened.states},
        inputs={n: known[n] for n in opened.inputs},
        outputs=sources,
        params=at.packed,
        t=float(np.asarray(at.t)),
    )
    columns = jnp.array([opened.inputs.index(name) for name in points])
    return OpenLoop(replace(found, B=found.B[:, columns], D=found.D[:, columns], inputs=points))
