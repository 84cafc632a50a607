"""Materials with hysteresis: coefficients of Everett's function, and limiting loops as tables.

The coefficients are those of `Modelica.Magnetic.FluxTubes.Material.HysteresisEverettParameter`.
"""

from dataclasses import dataclass

__modelica__ = None

Rows = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Everett:
    """Coefficients of the Everett function (Yamaguchi, Ueda and Yamamoto 1989).

    Arguments:
        Hsat: the loop is closed from this field strength on [A/m].
        M, r, q, p1, p2: saturation, share and slope [m/A] of the steep part, sharpness of the loop [m/A].
        Hc: coercivity [A/m].
        K: slope in saturation over mu_0.
        sigma: conductivity [S/m].
    """

    Hsat: float = 100.0
    M: float = 0.95
    r: float = 0.55
    q: float = 0.24
    p1: float = 0.12
    p2: float = 0.8
    Hc: float = 7.4
    K: float = 1.0
    sigma: float = 1.0


EVERETT: dict[str, Everett] = {
    "BaseData": Everett(),
    "M270_50A": Everett(650, 0.98089, 0.42933, 0.027285, 0.48567, 0.000549, 24.4948, 50, 1.72e6),
    "M330_50A": Everett(650, 0.967, 0.50256, 0.039964, 0.18807, 0.000781, 42.2283, 50, 2.2e6),
    "M400_50A": Everett(700, 0.96642, 0.44216, 0.027763, 0.29943, 0.000757, 43.2967, 50, 2.22e6),
    "M400_50AP": Everett(600, 1.0013, 0.42687, 0.034302, 0.31794, 0.000759, 36.204, 50, 2.22e6),
    "M800_65A": Everett(700, 1.1461, 0.1607, 0.012965, 0.18349, 0.000425, 100.0602, 50, 3.27e6),
    "Vacodur50": Everett(800, 1.002, 1.0835, 0.052305, 0.79581, 0.00898, 133.5884, 160, 2.38e6),
    "Vacoflux17": Everett(1000, 0.91959, 0.72807, 0.015757, 0.016407, 0.001049, 98.0842, 110, 2.56e6),
}  # fmt: skip
"""Materials by name."""


@dataclass(frozen=True)
class LoopTable:
    """A limiting hysteresis loop by two tables of field strength [A/m] and polarization [T], and a conductivity [S/m].

    Arguments:
        tabris, tabfal: rising and falling branch, rows in ascending order of the field strength.
        sigma: conductivity.
    """

    tabris: Rows
    tabfal: Rows
    sigma: float = 1e7
