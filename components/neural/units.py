"""Units of what a domain's connectors carry, and of products of them."""

import acausal as ac


def across_unit(connector: type[ac.Connector]) -> str:
    """Unit of the difference of two potentials."""
    potential = connector.declarations[connector.potential()].unit
    return connector.across_unit or potential


def flow_unit(connector: type[ac.Connector]) -> str:
    """Unit of the flow."""
    return connector.declarations[connector.flow()].unit


def product_unit(*units: str) -> str:
    """The product of units, in Modelica's spelling."""
    return ".".join(f"({u})" if "/" in u else u for u in units if u)


def per_second(unit: str) -> str:
    """A unit per second, if there is one."""
    return f"{unit}/s" if unit else ""
