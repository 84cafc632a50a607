"""Neural elements of planar mechanisms and vehicles: a bushing and a tyre.

For a joint with learned friction, let a flange drive it (``planar.Revolute(useFlange=True)``), and connect that to a
`BearingFriction`, or by a `Resistance` to the joint's ``support``.
"""

from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.planar import shapes
from acausal.components.planar.conventions import turned
from acausal.components.planar.interfaces import PartialTwoFrames
from acausal.components.planar.vehicle import PartialSlippingWheel

from .interfaces import PartialLaw, PartialNetwork


class Bushing(PartialNetwork, PartialTwoFrames):
    """A neural bushing: an elastic and damping joint between two frames, as of rubber.

    The displacements ``u`` are those of ``frame_b`` along the axes of ``frame_a``, and its angle [m, m, rad]. Efforts
    ``e`` at ``frame_b`` are the gradient of an energy ``E = net(u)`` and of a dissipation ``D = loss(der(u))``:
    ``e_i = dE/du_i + dD/d(der(u_i))`` [N, N, N.m]. So the stiffness is symmetric, and what is lost, ``lossPower``, is
    never negative, for all weights; nothing is lost while nothing moves. ``passive``, ``convex``, ``odd`` and
    ``floor`` are those of the energy, as of a `MultiportCompliance`.

    ``input_scale`` is the magnitude of the displacements, ``rate_scale`` that of their rates, one number or one for
    each; ``output_scale`` and ``loss_scale`` are those of the first effort, elastic and damping.
    """

    ICON = icons.network("bush")

    odd = ac.Option(False, doc="the same from both sides")
    passive = ac.Option(False, doc="the energy is never negative, and zero at zero")
    convex = ac.Option(False, doc="the energy is convex")
    floor = ac.Option(0.0, doc="least curvature of a convex energy, relative to that of the scales")
    rate_scale = ac.Option(1.0, doc="magnitude of the rates, one number or one for each")
    loss_scale = ac.Option(1.0, doc="magnitude of the first damping effort")
    promises = ("odd", "passive", "convex", "floor")
    loss = ac.Module(
        "_fresh_loss", doc="the dissipation, half of what is lost where it is quadratic"
    )
    u = ac.Variable(shape=3, doc="displacements along x and y of frame_a, and angle")
    v = ac.Variable(shape=3, doc="their rates")
    e = ac.Variable(shape=3, doc="forces along x and y of frame_a, and torque, at frame_b")
    E = ac.Variable(unit="J", doc="stored energy")
    lossPower = ac.Variable(unit="W", doc="power that is lost")

    def _spec(self) -> Callable[[Any], Any]:
        return ac.networks.Energy(
            inputs=3,
            passive=self.passive,
            convex=self.convex,
            odd=self.odd,
            floor=self.floor,
            **self._sizes,
        )

    def _fresh_loss(self, key: Any) -> Any:
        """A dissipation with fresh weights: convex, with its least value where nothing moves."""
        scale = self.rate_scale
        sizes: dict[str, Any] = {
            **self._sizes,
            "input_scale": tuple(scale) if isinstance(scale, list | tuple) else scale,
            "output_scale": self.loss_scale,
        }
        return ac.networks.Energy(inputs=3, passive=True, convex=True, **sizes)(key)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        away = b.x - a.x, b.y - a.y
        for u, value in zip(self.u, (*turned(-a.phi, *away), b.phi - a.phi), strict=True):
            yield ac.Eq(u, value)
        energy, loss = self.net(*self.u), self.loss(*self.v)
        yield ac.Eq(self.E, energy)
        damping = [loss.diff(v) for v in self.v]
        for u, v, e, damp in zip(self.u, self.v, self.e, damping, strict=True):
            yield ac.Eq(v, ac.der(u))
            yield ac.Eq(e, energy.diff(u) + damp)
        yield ac.Eq(self.lossPower, sum(v * damp for v, damp in zip(self.v, damping, strict=True)))
        force = turned(a.phi, self.e[0], self.e[1])
        yield ac.Eq(b.fx, force[0])
        yield ac.Eq(b.fy, force[1])
        yield ac.Eq(b.t, self.e[2])
        yield ac.Eq(a.fx + b.fx, 0)
        yield ac.Eq(a.fy + b.fy, 0)
        yield ac.Eq(a.t + b.t + away[0] * b.fy - away[1] * b.fx, 0)

    def shapes(self) -> Iterator[ac.Shape]:
        yield shapes.between(self.frame_a, self.frame_b, shapes.SPRING_DAMPER)


class Tyre(PartialLaw, PartialSlippingWheel):
    """A wheel whose friction is learned: ``f = fN net(slip)`` against the speed of the contact.

    ``slip`` is the contact's speed over that of the rim, ``v_slip/max(|radius w_roll|, v_small)``. With ``loads=True``
    the load is an input, ``net(slip, fN)``. The force is against the slip in every direction, so that it is odd, and
    ``passive``, the default, makes it brake for all weights; with ``extrapolation="saturating"``, the default, it stays
    bounded. The load is ``fN = max(0, N + dynamicLoad)`` [N]. ``input_scale`` and ``output_scale`` are magnitudes of
    slip and friction coefficient.
    """

    ICON = icons.network("tyre")

    passive = ac.Option(True, doc="the force is never along the slip")
    extrapolation = ac.Option(
        "saturating",
        choices=(None, "saturating", "linear", "cubic"),
        doc="how the law goes on beyond the limits",
    )
    input_scale = ac.Option(
        0.1, doc="magnitude of the slip, and of the load where that is an input"
    )
    output_scale = ac.Option(1.0, doc="magnitude of the friction coefficient")
    promises = (*PartialLaw.promises, "passive")
    loads = ac.Option(False, doc="whether the law depends on the load")
    N = ac.Parameter(unit="N", doc="normal force without dynamicLoad")
    v_small = ac.Parameter(0.1, unit="m/s", min=0, doc="least speed of the rim that slip is over")
    dynamicLoad = ac.Input(unit="N", doc="load in addition to N")
    fN = ac.Variable(unit="N", doc="normal force")
    slip = ac.Variable(unit="1", doc="speed of the contact over that of the rim")

    @property
    def secondary(self) -> tuple[str, ...]:
        """Further inputs of the law."""
        return ("fN",) if self.loads else ()

    def _spec(self) -> Callable[[Any], Any]:
        return ac.networks.Law(passive=self.passive, **self._sizes)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        rim = ac.maximum(ac.Abs(self.radius * self.w_roll), self.v_small)
        yield ac.Eq(self.slip, self.v_slip / rim)
        yield ac.Eq(self.fN, ac.maximum(0, self.N + self.dynamicLoad))
        yield ac.Eq(self.f, self.fN * self._law(self.slip))
