"""Flux tubes with hysteresis: the flux density over a given field against SciPy's integration of Tellinen's law."""

import itertools
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal.components import blocks, magnetic as mag
from acausal.components.magnetic.hysteresis_data import EVERETT

MU_0 = 4e-7 * np.pi
FIELD = [[0, 0], [1, 300], [2, -100], [3, 50], [4, 40]]
H0 = np.arctanh(0.5)


def soft(h: Any, side: int) -> Any:
    """A branch of the limiting loop of the default soft material, without its slope in saturation."""
    return 1.8 * np.tanh(h * H0 / 120 + side * H0) + side * 1.8 / 2000


def tellinen(branch: Any, ts: Any) -> Any:
    """The flux density at times, for the field `FIELD`."""
    b = (branch(0.0, 1) + branch(0.0, -1)) / 2
    found: list[float] = []
    points = np.asarray(FIELD, dtype=float)
    for (t0, h0), (t1, h1) in itertools.pairwise(points):
        side = -1 if h1 > h0 else 1

        def slope(h: float, b: Any, side: int = side) -> Any:
            rising, falling = (branch(h, s) + MU_0 * h for s in (-1, 1))
            k = (falling - b if side < 0 else b - rising) / (falling - rising)
            step = 1e-3
            return k * (branch(h + step, side) - branch(h - step, side)) / (2 * step) + MU_0

        inside = ts[(ts > t0) & (ts <= t1)]
        at = h0 + (h1 - h0) * (inside - t0) / (t1 - t0)
        run = solve_ivp(slope, (h0, h1), [b], t_eval=at, rtol=1e-10, atol=1e-12)
        found += run.y[0].tolist()
        b = run.y[0, -1]
    return np.array(found)


class Tubes(ac.Component):
    """Tubes of different kinds in one field."""

    def __init__(self, **tubes: ac.Component) -> None:
        super().__init__()
        self.table = blocks.TimeTable(table=FIELD)
        self.source = mag.SignalMagneticPotentialDifference()
        self.ground = mag.Ground()
        self.connect(self.table.y, self.source.V_m)
        self.connect(self.source.port_n, self.ground.port)
        for name, tube in tubes.items():
            setattr(self, name, tube)
            self.connect(tube.port_p, self.source.port_p)
            self.connect(tube.port_n, self.source.port_n)


@pytest.mark.slow
def test_flux_density_follows_tellinens_law() -> None:
    tube = mag.GenericHystTellinenSoft(l=1.0, MagRel=ac.Start(0.0, fixed=True))
    ts = np.linspace(0, 4, 41)[1:]
    found = ac.simulate(ac.compile(Tubes(tube=tube)), (0, 4), saveat=ts)
    np.testing.assert_allclose(found["tube.B"], tellinen(soft, ts), atol=1e-6)
    loss = np.asarray(found["tube.LossPowerStat"])
    assert loss.max() > 0 > loss.min()
    assert found["tube.asc"][ts == 0.5] == 1
    assert found["tube.asc"][ts == 1.5] == 0


def branches(tube: Any, h: float) -> tuple[float, ...]:
    """Polarization on both branches of the limiting loop at a field strength."""
    return tuple(float(b.subs({tube.Hstat: h}).evalf()) for b in tube._branches()[:2])


def test_everetts_loop_is_symmetric_closes_and_has_its_coercivity() -> None:
    material = EVERETT["M330_50A"]
    tube = mag.GenericHystTellinenEverett(mat=material)
    for h in (-300.0, 0.0, 42.0, 200.0):
        rising, falling = branches(tube, h)
        assert falling > rising
        assert branches(tube, -h) == pytest.approx((-falling, -rising), abs=1e-12)
    top = branches(tube, material.Hsat)
    assert top[0] == pytest.approx(top[1], abs=1e-12)
    assert 1.2 < top[0] < 1.6
    assert branches(tube, 25.0)[0] < 0 < branches(tube, material.Hc)[0]


def test_a_magnet_starts_magnetized_and_crosses_zero_at_its_coercivity() -> None:
    magnet = mag.GenericHystTellinenPermanentMagnet()
    rising, falling, _ = magnet._branches()  # pyright: ignore[reportPrivateUsage]
    given: Any = {magnet.H: 5e5, magnet.Br: 1.2, magnet.Hc: 5e5, magnet.M: 2e-5, magnet.K: 1.0}
    field = MU_0 * 5e5
    assert float(rising.subs(given).evalf()) == pytest.approx(-field, abs=1e-9)
    assert float(falling.subs(given | {magnet.H: -5e5}).evalf()) == pytest.approx(field, abs=1e-9)
    start = mag.GenericHystTellinenPermanentMagnet.MagRel
    assert (start.start, start.fixed) == (-1.0, True)


def test_a_table_needs_a_material() -> None:
    with pytest.raises(ac.DeclarationError, match=r"needs mat=hysteresis_data.LoopTable"):
        ac.compile(Tubes(tube=mag.GenericHystTellinenTable())).parameters()
