"""Old module paths work for one release, and warn."""

import importlib
import re
import subprocess
import sys

import pytest

from acausal._moved import MOVED

EVERYDAY = {
    "acausal.bands": ["DEGREE", "bow"],
    "acausal.expressions": ["parse", "parse_equation"],
    "acausal.formula": ["TERMS", "Formula"],
    "acausal.library": ["Library"],
    "acausal.plot": ["band", "guides", "learned", "losses", "modifiers", "TRUTH"],
    "acausal.report": ["Page", "write_json"],
    "acausal.training.regularizers": ["Context", "SmallCorrection", "ZeroCrossing"],
}
"""What users may have imported from the old paths."""


@pytest.mark.parametrize(("old", "name"), [(m, n) for m, names in EVERYDAY.items() for n in names])
def test_an_old_path_works_and_names_the_new_one(old, name):
    module = importlib.import_module(old)
    new = re.escape(MOVED[old].module)
    with pytest.warns(DeprecationWarning, match=rf"^{old}\.{name} has moved: use {new}\.\w+;"):
        assert getattr(module, name) is not None


def test_all_old_paths_are_tried():
    assert EVERYDAY.keys() == MOVED.keys()


def test_a_renamed_function_is_the_same_however_it_is_imported():
    from acausal import plot
    from acausal.reporting import plot_band

    new_name = r"acausal\.plot\.band .* acausal\.reporting\.plot_band"
    with pytest.warns(DeprecationWarning, match=new_name):
        from acausal.plot import band
    with pytest.warns(DeprecationWarning, match=new_name) as warned:
        assert plot.band is band is plot_band
    assert warned[0].filename == __file__


def test_an_unknown_name_is_an_error():
    plot = importlib.import_module("acausal.plot")
    with pytest.raises(AttributeError, match="has no attribute 'lerned'"):
        _ = plot.lerned
    with pytest.raises(ModuleNotFoundError, match=r"acausal\.plots"):
        importlib.import_module("acausal.plots")


def test_importing_acausal_imports_nothing_of_it():
    code = (
        "import sys, acausal; print([m for m in sys.modules if m.startswith('acausal.reporting')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
