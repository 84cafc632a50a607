"""Names of version 0.1 still serve, with a warning; so do files of parameters."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.data.params_file import KIND
from acausal.data.tensors import named_arrays, write_arrays

NAMES = {
    "Passage": "DryFrictionFactor",
    "Potential": "EnergyLaw",
    "Rounder": "WithMinCurvature",
    "Steeper": "WithMinSlope",
}


@pytest.mark.parametrize("old", NAMES)
def test_old_names_warn(old: str) -> None:
    with pytest.warns(DeprecationWarning, match=rf"networks\.{old} is called {NAMES[old]} now"):
        found = getattr(ac.networks, old)
    assert found is getattr(ac.networks, NAMES[old])


def test_a_name_that_never_was() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'Passages'"):
        getattr(ac.networks, "Passages")  # noqa: B009


@pytest.mark.parametrize("kind", ["Passive", "ThroughZero"])
def test_the_factor_by_its_old_name(kind: str) -> None:
    make: Any = getattr(ac.networks, kind)
    factor = ac.networks.DryFrictionFactor(2.0)
    with pytest.warns(DeprecationWarning, match=r"passage=\.\.\. is called factor"):
        law = make(ac.MLP(key=0), passage=factor)
    assert law.factor is factor
    with pytest.warns(DeprecationWarning, match="'passage' is called 'factor'"):
        assert law.passage is factor
    assert float(law(0.3)) == float(make(ac.MLP(key=0), factor)(0.3))


def test_the_coefficients_of_a_signal_by_their_old_name() -> None:
    signal = ac.Signal(np.arange(5.0), np.arange(5.0) % 2, "band-limited")
    with pytest.warns(DeprecationWarning, match=r"Signal\.bends is called Signal\.coefficients"):
        assert signal.bends is signal.coefficients


def test_files_with_old_names_are_read(tmp_path: Any) -> None:
    like = {
        "damper.net": ac.networks.Law(passive=True)(0),
        "table": ac.Signal(np.arange(5.0), np.arange(5.0) % 2, "band-limited"),
    }
    stored = named_arrays(like)
    assert "damper.net.net.factor.height" in stored
    stored["damper.net.net.factor.height"] = np.asarray(0.7)
    renamed = {".factor.": ".passage.", ".coefficients": ".bends"}
    before = dict(stored)
    for new, old in renamed.items():
        before = {n.replace(new, old): a for n, a in before.items()}
    assert len(before.keys() - stored.keys()) == 3
    write_arrays(tmp_path / "old.safetensors", before, {"kind": KIND, "settings": {}})
    found = ac.load_params(tmp_path / "old.safetensors", like)
    assert float(found["damper.net"].net.factor.height) == 0.7
    np.testing.assert_array_equal(
        found["table"].coefficients, jnp.asarray(stored["table.coefficients"])
    )
