"""Heat transfer (`Modelica.Thermal.HeatTransfer`): so far its connectors and the optional heat port."""

from .interfaces import (
    HeatPort,
    HeatPort_a,
    HeatPort_b,
    PartialElementaryConditionalHeatPort,
    PartialElementaryConditionalHeatPortWithoutT,
)

__all__ = [
    "HeatPort",
    "HeatPort_a",
    "HeatPort_b",
    "PartialElementaryConditionalHeatPort",
    "PartialElementaryConditionalHeatPortWithoutT",
]
