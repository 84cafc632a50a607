"""A neural element with a memory: friction that yields, magnetisation, backlash."""

from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import icons

from .interfaces import PartialNetwork, PartialTwoPort
from .units import across_unit, flow_unit, per_second, product_unit

_LEAST = 0.1
"""Least rate of forgetting: the memory ``z`` stays within ±10."""


class Hysteresis(PartialTwoPort, PartialNetwork):
    """A neural hysteresis with an internal state ``z``, after Bouc and Wen; passive for all weights.

    With the rate ``r`` (``v_rel = der(s_rel)`` where the potential is a position, the difference itself elsewhere)
    and the scales ``x_c = input_scale``, ``f_c = output_scale``::

        x_c der(z) = r - |r| z g(z sign(r))
        f = f_c W'(z)

    ``W`` is a convex network, least at zero, named ``net``; ``g`` a positive one, named ``memory``. Both are pure
    numbers. Bouc and Wen have ``W' = z`` and ``g = |z|^(n-1) (beta + gamma sign(z r))``.

    **Passive.** The storage function is ``E = f_c x_c W(z) >= 0``, for ``W(0) = 0`` is its least value. Its rate is
    ``der(E) = f_c W'(z) x_c der(z) = f r - f |r| z g``. So the power is ``f r = der(E) + lossPower`` with
    ``lossPower = f |r| z g``, and that is not negative: ``f`` has the sign of ``z``, as ``W`` is convex and least
    at zero, and ``g > 0``. What is taken out over any time is at most what was stored, ``E(0)``.

    **Bounded.** ``g`` is at least 0.1, so ``|z|`` falls where it is above 10 and something moves: the memory stays
    within ±10 once it is there, whatever the motion.

    The element starts without memory, ``z = 0``. It has neither stiffness nor damping of its own: connect a spring or
    a damper in parallel.

    Arguments:
        connector: connector class of the domain, which names everything (`PartialTwoPort`).
        modifiers: options of both networks: ``input_scale`` is the motion after which the element yields,
            ``output_scale`` the force then. ``odd=True`` makes it the same in both directions. ``net`` and ``memory``
            may be networks of your own; what is proved above is then for them to keep.
    """

    ICON = icons.network("hyst")

    input_scale = ac.Option(1.0, doc="magnitude of the inputs, one number or one for each")
    output_scale = ac.Option(1.0, doc="magnitude of the output")
    odd = ac.Option(False, doc="the same in both directions")
    memory = ac.Module("_fresh_memory", doc="how fast the memory fades")
    z = ac.Variable(state="prefer", doc="what the element remembers")
    promises = ("odd",)

    def _declare(self) -> None:
        super()._declare()
        kind = self.connector
        across, flow = across_unit(kind), flow_unit(kind)
        if kind.rate is not None:
            setattr(self, kind.rate, ac.Variable(unit=per_second(across), doc="rate"))
        rate = per_second(across) if kind.rate is not None else across
        self.E = ac.Variable(unit=product_unit(flow, rate, "s"), doc="stored energy")
        self.lossPower = ac.Variable(unit=product_unit(flow, rate), doc="power that is lost")

    def _spec(self) -> Callable[[Any], Any]:
        sizes: dict[str, Any] = {**self._sizes, "input_scale": 1.0, "output_scale": 1.0}
        return ac.networks.Energy(convex=True, passive=True, odd=self.odd, **sizes)

    def _fresh_memory(self, key: Any) -> Any:
        """How fast the memory fades, as a positive network: of ``z sign(r)``, and of ``sign(r)`` if not odd."""
        net = ac.MLP(1 if self.odd else 2, self.width, self.depth, "tanh", key=key)
        return ac.networks.Positive(net, _LEAST)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        rate = self._across
        if self.connector.rate is not None:
            rate = getattr(self, self.connector.rate)
            yield ac.Eq(rate, ac.der(self._across))
        z, direction = self.z, ac.sign(rate)
        fading = z * self.memory(z * direction, *(() if self.odd else (direction,)))
        energy = self.net(z)
        yield ac.Eq(self.input_scale * ac.der(z), rate - ac.Abs(rate) * fading)
        yield ac.Eq(self._through, self.output_scale * energy.diff(z))
        yield ac.Eq(self.E, self.output_scale * self.input_scale * energy)
        yield ac.Eq(self.lossPower, self._through * ac.Abs(rate) * fading)
