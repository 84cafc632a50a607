"""The open-circuit voltage: where charge meets the electrical circuit."""

from collections.abc import Callable, Iterator
from typing import Any

import acausal as ac
from acausal.components import icons
from acausal.components.electrical.interfaces import OnePort

from .interfaces import ChargePort, PartialThermal

__modelica__ = None


class OpenCircuitVoltage(OnePort, PartialThermal):
    """A voltage that rises with the charge at the surface: ``v = U(surface.soc, T)``, for all weights.

    ``U(soc, T) = net(soc) + (T - T_ref) entropy(soc)``. The current ``i`` into the pin ``p`` charges what is connected
    to ``surface``. With the mean state of charge ``soc``, a signal, the heat is that of D. Bernardi et al. (A general
    energy balance for battery systems, J. Electrochem. Soc. 132, 1985): ``LossPower = i (v - U(soc, T))``, what
    diffusion loses, and ``i T entropy(soc)``, which is reversible and may be negative. The rest of the power is stored.

    Arguments:
        net: the curve at T_ref, by default a monotone network.
        entropy: its derivative by the temperature, by default a small free one; it promises nothing.
        modifiers: options and parameters.
    """

    ICON = icons.CELL

    width = ac.Option(12, doc="neurons of the networks' hidden layers")
    U_nominal = ac.Parameter(3.7, unit="V", doc="voltage that the curve is added to")
    net = ac.Module("_fresh", unit="V", takes=("1",), doc="voltage at T_ref above U_nominal")
    entropy = ac.Module("_fresh_entropy", unit="V/K", takes=("1",), doc="derivative by temperature")
    surface = ChargePort()
    soc = ac.Input(unit="1", doc="mean state of charge")
    soc_surface = ac.Output(unit="1", doc="state of charge at the surface")
    U_mean = ac.Variable(unit="V", nominal=4.0, doc="open-circuit voltage at the mean")

    def _fresh(self, key: Any) -> Any:
        spec: Callable[[Any], Any] = ac.networks.Law(
            monotone=True, width=self.width, depth=1, activation="tanh", start=0.5, input_scale=0.5
        )
        return spec(key)

    def _fresh_entropy(self, key: Any) -> Any:
        scales: dict[str, Any] = {"input_scale": 0.5, "output_scale": 1e-3, "last_layer": 0.05}
        return ac.MLP(1, max(self.width // 2, 1), 1, "tanh", **scales, key=key)

    def _voltage(self, soc: Any) -> Any:
        """The open-circuit voltage at a state of charge."""
        return self.U_nominal + self.net(soc) + (self.T_heatPort - self.T_ref) * self.entropy(soc)

    def equations(self) -> Iterator[ac.Eq]:
        yield from super().equations()
        yield ac.Eq(self.soc_surface, self.surface.soc)
        yield ac.Eq(self.surface.i, -self.i)
        yield ac.Eq(self.v, self._voltage(self.surface.soc))
        yield ac.Eq(self.U_mean, self._voltage(self.soc))
        reversible = self.i * self.T_heatPort * self.entropy(self.soc)
        yield ac.Eq(self.LossPower, self.i * (self.v - self.U_mean) + reversible)
