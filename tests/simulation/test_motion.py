"""Mechanisms in motion: shapes are placed along a trajectory, to scale, and a notebook shows the last frame."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import acausal as ac
from acausal.components import planar, translational as tl
from acausal.reporting import still


class Bob(planar.Body):
    """A body that is drawn as a box."""

    side = ac.Parameter(0.2, unit="m")

    def shapes(self) -> Iterator[ac.Shape]:
        yield from super().shapes()
        frame = self.frame_a
        yield ac.Shape("M-1 -1H1V1H-1Z", frame.x, frame.y, size=(self.side / 2, self.side))


class Swing(ac.Component):
    """A weight on a rod."""

    def __init__(self) -> None:
        super().__init__()
        self.wall, self.joint = planar.Fixed(), planar.Revolute(phi=ac.Start(1.0, fixed=True))
        self.rod, self.body = planar.FixedTranslation(r=(0.0, -2.0)), Bob(m=2.0, I=0.01)
        self.connect(self.wall.frame, self.joint.frame_a)
        self.connect(self.joint.frame_b, self.rod.frame_a)
        self.connect(self.rod.frame_b, self.body.frame_a)


@pytest.fixture(scope="module")
def swung() -> ac.Solution:
    return ac.simulate(ac.compile(Swing()), 3.0, dt=0.002, solver="rk4")


def test_shapes_are_placed_along_the_trajectory_to_scale(swung: ac.Solution) -> None:
    found = swung.animation()
    shapes = {(s.name, i): s for i, s in enumerate(found.shapes)}
    assert {name for name, _ in shapes} == {"wall", "joint", "rod", "body"}
    disc, box = (s for s in found.shapes if s.name == "body")
    assert disc.along == pytest.approx(np.sqrt(2 * 0.01 / 2.0))
    assert disc.filled
    assert (box.along, box.across) == (pytest.approx(0.1), pytest.approx(0.2))
    rod = next(s for s in found.shapes if s.name == "rod")
    assert rod.along == pytest.approx(2.0)
    assert rod.across is None
    assert found.trace == "body"
    assert len(found.time) == len(disc.x) == 900
    angle = np.interp(found.time, np.asarray(swung.t), np.asarray(swung["joint.phi"]))
    np.testing.assert_allclose(disc.x, 2.0 * np.sin(angle), atol=1e-9)
    np.testing.assert_allclose(rod.phi, angle - np.pi / 2, atol=1e-9)


def test_a_notebook_shows_the_last_frame(swung: ac.Solution) -> None:
    text = still(swung.animation())
    body = next(s for s in swung.animation().shapes if s.name == "body")
    assert f"translate({body.x[-1]:.6g} {body.y[-1]:.6g})" in text
    assert "0.5 m" in text
    assert 'class="moving' in swung._repr_html_()


def test_what_cannot_be_shown_is_named(swung: ac.Solution) -> None:
    with pytest.raises(ac.DataError, match="'rod' has no way to trace"):
        swung.animation(trace="rod")
    free = ac.simulate(ac.compile(tl.Mass(m=1.0)), 1.0, dt=0.5)
    with pytest.raises(ac.DataError, match="no component of Mass has a shape"):
        free.animation()
    assert 'class="moving' not in free._repr_html_()


def test_a_path_that_is_no_path_is_refused() -> None:
    with pytest.raises(ac.DeclarationError, match="SVG path data"):
        ac.Shape('M0 0"/><script>', 0.0, 0.0)
