"""The page of a training of a model with events; see test_confidence, test_records and others, too."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.reporting import Plot, Text
from acausal.training.presentation.page_records import record_blocks
from acausal.training.record_fit import RecordFit
from acausal.training.trained_model import out_of_range
from tests.support.hybrid_training import Convection, Zone, learned_losses


@pytest.mark.machines
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


T = np.linspace(0.0, 10.0, 101)


def followed(name: str, predicted: Any, scale: float = 1.0, force: float = 2.0) -> RecordFit:
    """A record of a sine under a force of some strength, and a prediction."""
    y = scale * np.sin(T)
    return RecordFit(
        name, ("mass.s",), T, y[:, None], np.asarray(predicted)[:, None], {"push.f": force * y}, np.ones(1), {}, {},
        {"damper.net": 2 * np.asarray(predicted)[:, None]},
    )  # fmt: skip


def trained_on(*records: RecordFit) -> Any:
    units = {"mass.s": "m", "push.f": "N"}
    return SimpleNamespace(
        system=SimpleNamespace(unit=units.__getitem__),
        arguments={},
        problem=SimpleNamespace(targets=("mass.s",)),
        records={r.name: r for r in records},
    )


def plots_of(after: RecordFit, before: RecordFit) -> list[Plot]:
    fit = trained_on(after)
    found = record_blocks(fit, fit.records, {after.name: before})
    return [block for block in found if isinstance(block, Plot)]


def test_a_curve_that_runs_away_leaves_the_plot():
    """It is never drawn where it is not, as a sensor at its end would be."""
    growing = np.exp(T) * np.sin(T)
    above, below = plots_of(followed("a", np.sin(T) + 0.01), followed("a", growing))
    (drawn,) = (c for c in above.curves if c.role == "before")
    known = np.isfinite(drawn.y)
    np.testing.assert_array_equal(drawn.y[known], np.interp(drawn.x[known], T, growing))
    assert np.isnan(drawn.y).any()
    assert above.limits is not None
    low, high = above.limits
    assert -4.2 < low < -3.0
    assert 3.0 < high < 4.2
    assert "before training it reaches from" in below.caption
    assert f"{growing.min():.4g} to {growing.max():.4g} m." in below.caption
    assert below.limits is not None


def test_a_model_that_diverges_before_training_is_drawn_up_to_there():
    broken = np.where(T < 3, np.sin(T), np.inf)
    above, below = plots_of(followed("a", np.sin(T)), followed("a", broken))
    (drawn,) = (c for c in above.curves if c.role == "before")
    assert drawn.x[np.isfinite(drawn.y)].max() < 3
    assert "before training the model diverges" in below.caption


def test_what_stays_near_needs_no_limits():
    above, below = plots_of(followed("a", np.sin(T)), followed("a", 1.5 * np.sin(T)))
    assert above.limits is None
    assert "reaches" not in below.caption


def test_a_record_outside_of_the_trainings_range_says_so():
    fit = trained_on(followed("a", np.sin(T)), followed("b", np.sin(T), scale=0.5))
    inside, outside = followed("c", np.sin(T)), followed("d", np.sin(T), force=3.0)
    assert out_of_range(inside, fit) == ""
    said = out_of_range(outside, fit)
    assert "'d' is outside of the training's range: 'push.f' is from" in said
    assert "N (in training" in said
    assert "mass.s" not in said
    assert "net" not in said
    beyond = out_of_range(followed("e", 3 + np.sin(T)), fit)
    assert (
        "'e' is outside of the training's range: the argument of 'damper.net' is from 4 to"
        in beyond
    )
    told = {r.name: out_of_range(r, fit) for r in (inside, outside)}
    blocks = list(record_blocks(fit, {"c": inside, "d": outside}, {}, "held out, ", told))
    at = blocks.index(Text(said))
    shown = blocks[at + 2]
    assert isinstance(shown, Plot)
    assert "'d'" in shown.caption
    assert sum(isinstance(b, Text) for b in blocks) == 1


def test_only_what_is_held_out_of_a_record_counts():
    """The first half of it was trained on."""
    fit = trained_on(followed("a", np.sin(T)))
    larger = followed("a", np.sin(T), force=3.0)
    larger.measured[np.abs(larger.inputs["push.f"]) > 2.0] = np.nan
    assert out_of_range(larger, fit) == ""
