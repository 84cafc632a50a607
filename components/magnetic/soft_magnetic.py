"""Soft magnetic materials, as records that flux tubes take by their option ``material``.

The relative permeability at the flux density ``B`` is approximately
``1 + (mu_i - 1 + c_a b)/(1 + c_b b + b**n)`` with ``b = |B/B_myMax|`` (Roschke). The coefficients are those of
`Modelica.Magnetic.FluxTubes.Material.SoftMagnetic`.
"""

from dataclasses import dataclass

_SOFT = "Modelica.Magnetic.FluxTubes.Material.SoftMagnetic"
__modelica__ = f"{_SOFT}.Steel"


@dataclass(frozen=True)
class BaseData:
    """Coefficients of a soft magnetic material; any of them can be given: ``M350_50A(mu_i=1300.0)``.

    Arguments:
        mu_i: relative permeability at ``B = 0``.
        B_myMax: flux density at the greatest permeability [T].
        c_a, c_b, n: coefficients of the approximation.
    """

    __modelica__ = None

    mu_i: float = 1.0
    B_myMax: float = 1.0
    c_a: float = 1.0
    c_b: float = 1.0
    n: float = 1.0


@dataclass(frozen=True)
class M330_50A(BaseData):  # noqa: N801 (Modelica's name)
    """Electric sheet M330-50A at 50 Hz, a core after machining."""

    __modelica__ = f"{_SOFT}.ElectricSheet"

    mu_i: float = 500.0
    B_myMax: float = 0.7
    c_a: float = 24000.0
    c_b: float = 9.38
    n: float = 9.6


@dataclass(frozen=True)
class M350_50A(BaseData):  # noqa: N801 (Modelica's name)
    """Electric sheet M350-50A at 50 Hz, a strip."""

    __modelica__ = f"{_SOFT}.ElectricSheet"

    mu_i: float = 1210.0
    B_myMax: float = 1.16
    c_a: float = 24630.0
    c_b: float = 2.44
    n: float = 14.0


@dataclass(frozen=True)
class M530_50A(BaseData):  # noqa: N801 (Modelica's name)
    """Electric sheet M530-50A at 50 Hz, a strip."""

    __modelica__ = f"{_SOFT}.ElectricSheet"

    mu_i: float = 2120.0
    B_myMax: float = 1.25
    c_a: float = 12400.0
    c_b: float = 1.6
    n: float = 13.5


@dataclass(frozen=True)
class M700_100A(BaseData):  # noqa: N801 (Modelica's name)
    """Electric sheet M700-100A at 50 Hz, a strip."""

    __modelica__ = f"{_SOFT}.ElectricSheet"

    mu_i: float = 1120.0
    B_myMax: float = 1.2
    c_a: float = 20750.0
    c_b: float = 3.55
    n: float = 13.15


@dataclass(frozen=True)
class M940_100A(BaseData):  # noqa: N801 (Modelica's name)
    """Electric sheet M940-100A at 50 Hz, a strip."""

    __modelica__ = f"{_SOFT}.ElectricSheet"

    mu_i: float = 680.0
    B_myMax: float = 1.26
    c_a: float = 17760.0
    c_b: float = 3.13
    n: float = 13.9


@dataclass(frozen=True)
class Vacoflux50(BaseData):
    """VACOFLUX 50 (50 % CoFe)."""

    __modelica__ = f"{_SOFT}.CobaltIron"

    mu_i: float = 3850.0
    B_myMax: float = 1.75
    c_a: float = 11790.0
    c_b: float = 2.63
    n: float = 15.02


@dataclass(frozen=True)
class MuMetall(BaseData):
    """MUMETALL (77 % NiFe)."""

    __modelica__ = f"{_SOFT}.NickelIron"

    mu_i: float = 27300.0
    B_myMax: float = 0.46
    c_a: float = 1037500.0
    c_b: float = 3.67
    n: float = 10.0


@dataclass(frozen=True)
class Permenorm3601K3(BaseData):
    """PERMENORM 3601 K3 (36 % NiFe)."""

    __modelica__ = f"{_SOFT}.NickelIron"

    mu_i: float = 3000.0
    B_myMax: float = 0.67
    c_a: float = 50000.0
    c_b: float = 2.39
    n: float = 9.3


@dataclass(frozen=True)
class RFe80(BaseData):
    """Pure iron RFe80 (Hyperm 0)."""

    __modelica__ = f"{_SOFT}.PureIron"

    mu_i: float = 123.0
    B_myMax: float = 1.27
    c_a: float = 44410.0
    c_b: float = 6.4
    n: float = 10.0


@dataclass(frozen=True)
class VacoferS2(BaseData):
    """Pure iron VACOFER S2 (99.95 % Fe)."""

    __modelica__ = f"{_SOFT}.PureIron"

    mu_i: float = 2666.0
    B_myMax: float = 1.15
    c_a: float = 187000.0
    c_b: float = 4.24
    n: float = 19.0


@dataclass(frozen=True)
class AISI_1008(BaseData):  # noqa: N801 (Modelica's name)
    """Steel AISI 1008 (1.0204)."""

    mu_i: float = 200.0
    B_myMax: float = 1.17
    c_a: float = 8100.0
    c_b: float = 2.59
    n: float = 10.0


@dataclass(frozen=True)
class AISI_12L14(BaseData):  # noqa: N801 (Modelica's name)
    """Steel AISI 12L14 (1.0718)."""

    mu_i: float = 10.0
    B_myMax: float = 0.94
    c_a: float = 5900.0
    c_b: float = 4.19
    n: float = 6.4


@dataclass(frozen=True)
class DC01(BaseData):
    """Steel DC01 (1.0330)."""

    mu_i: float = 5.0
    B_myMax: float = 1.1
    c_a: float = 6450.0
    c_b: float = 3.65
    n: float = 7.7


@dataclass(frozen=True)
class DC03(BaseData):
    """Steel DC03 (1.0347)."""

    mu_i: float = 0.0
    B_myMax: float = 1.05
    c_a: float = 27790.0
    c_b: float = 16.0
    n: float = 10.4


@dataclass(frozen=True)
class X6Cr17(BaseData):
    """Steel X6Cr17 (1.4016)."""

    mu_i: float = 274.0
    B_myMax: float = 1.1
    c_a: float = 970.0
    c_b: float = 1.2
    n: float = 8.3


@dataclass(frozen=True)
class Steel_9SMnPb28(BaseData):  # noqa: N801 (Modelica's name)
    """Steel 9SMnPb28 (1.0718)."""

    mu_i: float = 400.0
    B_myMax: float = 1.488
    c_a: float = 1200.0
    c_b: float = 3.0
    n: float = 12.5


@dataclass(frozen=True)
class Steel_9SMn28K(BaseData):  # noqa: N801 (Modelica's name)
    """Steel 9SMn28K (1.0715)."""

    mu_i: float = 500.0
    B_myMax: float = 1.036
    c_a: float = 43414.0
    c_b: float = 35.8
    n: float = 14.0
