"""Settings for all tests, made before JAX or matplotlib are imported."""

import os

import hypothesis

os.environ.setdefault("JAX_PLATFORMS", "cpu")
os.environ.setdefault("MPLBACKEND", "Agg")

# The same examples in every run, and no deadline: the first one compiles.
hypothesis.settings.register_profile("acausal", deadline=None, derandomize=True)
hypothesis.settings.load_profile("acausal")
