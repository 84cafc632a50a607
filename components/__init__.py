"""Component library: one package per domain, with the names of the Modelica Standard Library 4.1.0.

| package | Modelica |
|---|---|
| `translational` | `Modelica.Mechanics.Translational` |
| `rotational` | `Modelica.Mechanics.Rotational` |
| `blocks` | `Modelica.Blocks` |
| `thermal` | `Modelica.Thermal.HeatTransfer` |
| `fluid` | `Modelica.Thermal.FluidHeatFlow` |
| `neural` | none: two-ports of any domain whose law is a network |

The library is written as a user writes one: it knows the rest of the package only as
``import acausal as ac``.
"""
