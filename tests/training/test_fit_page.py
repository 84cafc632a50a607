"""The page of a training of a model with events; see test_confidence, test_records and others, too."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from tests.support.hybrid_training import Convection, Zone, learned_losses


@pytest.mark.slow
def test_trajectories_of_a_model_with_events_are_those_of_the_training():
    times = np.linspace(0, 60, 301)
    truth = ac.simulate(ac.compile(Zone(Convection())), (0, 60), saveat=times)
    data = ac.Data(times, {"zone.T": np.asarray(truth["zone.T"])})
    fit = ac.fit(
        ac.compile(Zone(learned_losses())), data, ["zone.T"], x0="model", strategy="whole_record",
        epochs=3, progress=False,
    )  # fmt: skip
    content = fit.page_content()
    (zone,) = (card for card in content.cards if card.path == "zone")
    plots = [b for s in zone.sections if s.title == "Trajectories" for b in s.blocks]
    (temperature,) = (b for b in plots if getattr(b, "ylabel", "") == "T [K]")
    before, after = temperature.curves
    assert (before.label, after.label) == ("before", "after")
    expected = np.interp(after.x, times, fit.predicted[:, 0])
    np.testing.assert_allclose(after.y, expected, atol=1e-3)
