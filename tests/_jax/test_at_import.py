"""JAX's settings, made when JAX is imported."""

import subprocess
import sys

import pytest

from tests.support.paths import ROOT


@pytest.mark.cases(fast=1)
@pytest.mark.parametrize(
    "imports",
    [
        "import acausal, jax",
        "import jax, acausal",
        "import acausal, jax.numpy",
        "import acausal; acausal.simulate",
        "import acausal, importlib; importlib.reload(acausal)",
    ],
)
def test_double_precision_whoever_comes_first(imports: str) -> None:
    code = f"{imports}\nimport jax\nprint(jax.config.jax_enable_x64, jax.__spec__.loader.name)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "True jax\n"


def test_jax_waits_until_it_is_used() -> None:
    code = "import sys, acausal; print('jax' in sys.modules, 'jaxlib' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "False False\n"
