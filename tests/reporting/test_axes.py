"""Drawing where matplotlib is not installed."""

from __future__ import annotations

import subprocess
import sys

import pytest

import acausal as ac
from acausal.reporting import plot_over_time
from acausal.reporting.plot import new_axes
from tests.support.paths import ROOT


@pytest.fixture
def without_matplotlib(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.pyplot"):
        monkeypatch.setitem(sys.modules, name, None)


@pytest.mark.usefixtures("without_matplotlib")
@pytest.mark.parametrize(
    "draw",
    [
        lambda: plot_over_time([0.0, 1.0], {"y": [1.0, 2.0]}, {"y": "m"}),
        lambda: new_axes((3, 2)),
    ],
    ids=["over time", "axes"],
)
def test_a_drawing_says_what_to_install(draw) -> None:
    with pytest.raises(ac.AcausalError, match=r"needs matplotlib: pip install 'acausal\[plot\]'"):
        draw()


@pytest.mark.slow
def test_the_kernel_works_without_what_is_optional() -> None:
    """A model is compiled, simulated and fitted where no extra is installed."""
    script = """
import sys
for name in ("graphlay", "matplotlib", "pandas", "tensorboardX", "PIL"):
    sys.modules[name] = None
import numpy as np, acausal as ac
from tests.support.oscillator import plain
system = plain()
print(ac.simulate(system, (0, 0.3), dt=0.1, inputs={n: 0.0 for n in system.inputs}).x.shape)
"""
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("(4, ")
