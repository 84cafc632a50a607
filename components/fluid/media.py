"""Media: constant properties of fluids, as records that components take by their option ``medium``."""

from dataclasses import dataclass

__modelica__ = "Modelica.Thermal.FluidHeatFlow.Media"


@dataclass(frozen=True)
class Medium:
    """Constant properties of a fluid; any of them can be given: ``Water(rho=990.0)``.

    Arguments:
        rho: density [kg/m3].
        cp: specific heat capacity at constant pressure [J/(kg.K)].
        cv: specific heat capacity at constant volume [J/(kg.K)].
        lambda_: thermal conductivity [W/(m.K)]; Modelica's ``lambda``, a keyword of Python.
        nu: kinematic viscosity [m2/s].
    """

    rho: float = 1.0
    cp: float = 1.0
    cv: float = 1.0
    lambda_: float = 1.0
    nu: float = 1.0


@dataclass(frozen=True)
class Air_30degC(Medium):  # noqa: N801 (Modelica's name)
    """Air at 30 °C and 1 bar."""

    rho: float = 1.149
    cp: float = 1007.0
    cv: float = 720.0
    lambda_: float = 0.0264
    nu: float = 16.3e-6


@dataclass(frozen=True)
class Air_70degC(Medium):  # noqa: N801
    """Air at 70 °C and 1 bar."""

    rho: float = 1.015
    cp: float = 1010.0
    cv: float = 723.0
    lambda_: float = 0.0293
    nu: float = 20.3e-6


@dataclass(frozen=True)
class Water_10degC(Medium):  # noqa: N801
    """Water at 10 °C and 1 bar."""

    rho: float = 999.7
    cp: float = 4192.0
    cv: float = 4192.0
    lambda_: float = 0.588
    nu: float = 1.307e-6


@dataclass(frozen=True)
class Water(Medium):
    """Water at 30 °C and 1 bar."""

    rho: float = 995.6
    cp: float = 4177.0
    cv: float = 4177.0
    lambda_: float = 0.615
    nu: float = 0.8e-6


@dataclass(frozen=True)
class Water_90degC(Medium):  # noqa: N801
    """Water at 90 °C and 1 bar."""

    rho: float = 965.3
    cp: float = 4205.0
    cv: float = 4205.0
    lambda_: float = 0.676
    nu: float = 0.347e-6


@dataclass(frozen=True)
class Gylcol20_20degC(Medium):  # noqa: N801 (and Modelica's spelling)
    """Glycol and water, 20 to 80, at 20 °C and 1 bar: does not freeze above -8 °C."""

    rho: float = 1028.0
    cp: float = 3910.0
    cv: float = 3910.0
    lambda_: float = 0.523
    nu: float = 1.69e-6


@dataclass(frozen=True)
class Gylcol50_20degC(Medium):  # noqa: N801
    """Glycol and water in equal parts at 20 °C and 1 bar: does not freeze above -40 °C."""

    rho: float = 1078.0
    cp: float = 3300.0
    cv: float = 3300.0
    lambda_: float = 0.405
    nu: float = 3.98e-6


@dataclass(frozen=True)
class MineralOil(Medium):
    """Mineral oil at 60 °C and 1 bar."""

    rho: float = 868.0
    cp: float = 2010.0
    cv: float = 2010.0
    lambda_: float = 0.14
    nu: float = 81.8e-6
