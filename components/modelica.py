"""How the library's names follow the Modelica Standard Library 4.1.0, and what a package exports.

A module's ``__modelica__`` is the package of Modelica that has its classes, under the same names; or a tuple of several
packages. A class for which this is not so has its own ``__modelica__``: None if Modelica has no such class.
"""

import sys

import acausal as ac

MODELICA: dict[str, str] = {
    "Modelica.Mechanics.Rotational": "rotational",
    "Modelica.Mechanics.Translational": "translational",
    "Modelica.Electrical.Analog": "electrical",
    "Modelica.Electrical.Digital": "digital",
    "Modelica.Thermal.HeatTransfer": "thermal",
    "Modelica.Thermal.FluidHeatFlow": "fluid",
    "Modelica.Magnetic.FluxTubes": "magnetic",
    "Modelica.Blocks": "blocks",
    "PlanarMechanics": "planar",
    "Modelica.Mechanics.MultiBody": "planar",
    "MB": "planar",
}
"""Package of Modelica, or the name under which a library imports it -> package below `acausal.components`."""

RENAMED: dict[str, str] = {
    "Modelica.Blocks.Sources.Clock": "Modelica.Blocks.Sources.ContinuousClock",
    "Modelica.Blocks.Tables.CombiTable1D": "Modelica.Blocks.Tables.CombiTable1Dv",
    "Modelica.Blocks.Tables.CombiTable2D": "Modelica.Blocks.Tables.CombiTable2Ds",
    "Modelica.Electrical.Analog.Basic.EMF": "Modelica.Electrical.Analog.Basic.RotationalEMF",
    "Modelica.Thermal.FluidHeatFlow.Components.IsolatedPipe": "Modelica.Thermal.FluidHeatFlow.Components.Pipe",
}
"""Name of a class in version 3.2.3 -> its name since 4.0.0."""

NOT_COVERED: dict[str, str] = {
    "Modelica.Mechanics.Rotational.Interfaces": "InternalSupport",
    "Modelica.Mechanics.Translational.Interfaces": (
        "InternalSupport PartialOneFlangeAndSupport PartialTwoFlangesAndSupport"
    ),
    "Modelica.Electrical.Analog.Lines": "TLine TLine1 TLine2 TLine3",
    "Modelica.Electrical.Analog.Interfaces": (
        "PartialConditionalHeatPort AbsoluteSensor RelativeSensor"
    ),
    "Modelica.Electrical.Digital.Delay": "TransportDelay InertialDelaySensitiveVector",
    "Modelica.Magnetic.FluxTubes.Shapes.HysteresisAndMagnets": ("GenericHystPreisachEverett"),
    "Modelica.Magnetic.FluxTubes.Interfaces": "ConditionalHeatPort",
}
"""Package of Modelica -> names of the classes that are not here; those that are here say so themselves."""

ALSO_CALLED: dict[str, str] = {
    "electrical.RotationalEMF": "Modelica.Electrical.Analog.Basic.EMF dc motor machine generator",
    "electrical.TranslationalEMF": "linear motor voice coil loudspeaker",
    "electrical.IdealizedOpAmpLimited": "Modelica.Electrical.Analog.Ideal.IdealizedOpAmpLimted",
    "electrical.SineVoltage": "freqHz AC source",
    "electrical.SineCurrent": "freqHz AC source",
    "electrical.PulseVoltage": "pwm square wave",
    "electrical.PulseCurrent": "pwm square wave",
    "electrical.ConstantVoltage": "dc source battery",
    "blocks.Sine": "freqHz",
    "blocks.Pulse": "pwm duty cycle square wave",
    "blocks.Hysteresis": "thermostat two-point controller",
    "blocks.OnOffController": "thermostat two-point bang-bang",
}
"""What users and earlier versions of Modelica call classes, by their path below `acausal.components`."""

ENUMERATIONS: tuple[str, ...] = (
    "AnalogFilter",
    "AssertionLevel",
    "Extrapolation",
    "FilterType",
    "ImpulseApproximation",
    "Init",
    "L",
    "LimiterHomotopy",
    "Logic",
    "Regularization",
    "ResolveInFrameA",
    "ResolveInFrameAB",
    "ResolveInFrameB",
    "RotationTypes",
    "SimpleController",
    "Smoothness",
    "StateSelect",
    "TimeEvents",
    "VariableLimiterHomotopy",
)
"""Types whose values are written as a text, the last word of their name: ``Types.Init.SteadyState``."""


def export(package: str, *modules: str) -> None:
    """Make a package's classes and ``modules`` its public names, and list Modelica's names of them.

    A package imports its modules by ``*``: so a class is named where it is defined and nowhere else, and type checkers
    and editors see it. At run time ``*`` also brings what those modules import, such as ``ac``; that is dropped here.
    """
    this = sys.modules[package]
    domains = [m for m, place in MODELICA.items() if place == package.rpartition(".")[2]]
    public, names = list(modules), dict[str, str]()
    for name, value in list(vars(this).items()):
        if name.startswith("_") or value is sys.modules.get(f"{package}.{name}"):
            continue
        homes = [h for h in _homes(value) if any(f"{h}.".startswith(f"{d}.") for d in domains)]
        if homes or (isinstance(value, type) and value.__module__.startswith(f"{package}.")):
            public.append(name)
            names |= {f"{home}.{name}": name for home in homes}
        else:
            delattr(this, name)
    for module in modules:
        inner = vars(this)[module]
        own = [n for n, v in vars(inner).items() if getattr(v, "__module__", "") == inner.__name__]
        inner.__all__ = [name for name in own if not name.startswith("_")]
        for name in inner.__all__:
            for home in _homes(vars(inner)[name]):
                names.setdefault(f"{home}.{name}", f"{module}.{name}")
    public.sort()
    vars(this).update(__all__=public, __dir__=lambda: public, MODELICA_NAMES=names)


def _homes(value: object) -> tuple[str, ...]:
    """Modelica's packages that have a class."""
    if not isinstance(value, type):
        return ()
    if value in (ac.Input, ac.Output):
        return ("Modelica.Blocks.Interfaces",)
    module = sys.modules[value.__module__]
    stated = vars(value).get("__modelica__", vars(module).get("__modelica__"))
    return (stated,) if isinstance(stated, str) else stated or ()
