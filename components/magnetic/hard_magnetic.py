"""Hard magnetic materials, as records that permanent magnets take by their option ``mat``.

Exemplary values, those of `Modelica.Magnetic.FluxTubes.Material.HardMagnetic`.
"""

from dataclasses import dataclass

from acausal.components import nature

__modelica__ = "Modelica.Magnetic.FluxTubes.Material.HardMagnetic"


@dataclass(frozen=True)
class BaseData:
    """Data of a hard magnetic material; any of them can be given: ``NdFeB(T_op=353.15)``.

    Arguments:
        H_cBRef: coercivity at ``T_ref`` [A/m].
        B_rRef: remanence at ``T_ref`` [T].
        T_ref: reference temperature [K].
        alpha_Br: temperature coefficient of the remanence [1/K].
        T_op: operating temperature [K].
    """

    __modelica__ = None

    H_cBRef: float = 1.0
    B_rRef: float = 1.0
    T_ref: float = 293.15
    alpha_Br: float = 0.0
    T_op: float = 293.15

    @property
    def B_r(self) -> float:
        """Remanence at the operating temperature [T]."""
        return self.B_rRef * (1 + self.alpha_Br * (self.T_op - self.T_ref))

    @property
    def H_cB(self) -> float:
        """Coercivity at the operating temperature [A/m]."""
        return self.H_cBRef * (1 + self.alpha_Br * (self.T_op - self.T_ref))

    @property
    def mu_r(self) -> float:
        """Relative permeability."""
        return self.B_r / (nature.mu_0 * self.H_cB)


@dataclass(frozen=True)
class HardFerrite(BaseData):
    """Sintered hard ferrite."""

    H_cBRef: float = 170000.0
    B_rRef: float = 0.38
    alpha_Br: float = -0.002


@dataclass(frozen=True)
class NdFeB(BaseData):
    """Sintered NdFeB."""

    H_cBRef: float = 900000.0
    B_rRef: float = 1.2
    alpha_Br: float = -0.001


@dataclass(frozen=True)
class Sm2Co17(BaseData):
    """Sintered Sm2Co17."""

    H_cBRef: float = 750000.0
    B_rRef: float = 1.02
    alpha_Br: float = -0.0003


@dataclass(frozen=True)
class SmCo5(BaseData):
    """Sintered SmCo5."""

    H_cBRef: float = 720000.0
    B_rRef: float = 0.95
    alpha_Br: float = -0.0004


@dataclass(frozen=True)
class PlasticHardFerrite(BaseData):
    """Plastic-bonded hard ferrite."""

    H_cBRef: float = 130000.0
    B_rRef: float = 0.21
    alpha_Br: float = -0.002


@dataclass(frozen=True)
class PlasticNdFeB(BaseData):
    """Plastic-bonded NdFeB."""

    H_cBRef: float = 400000.0
    B_rRef: float = 0.58
    alpha_Br: float = -0.001


@dataclass(frozen=True)
class PlasticSmCo(BaseData):
    """Plastic-bonded Sm-Co."""

    H_cBRef: float = 385000.0
    B_rRef: float = 0.57
    alpha_Br: float = -0.0004
