"""Devices that share batches find what one device finds."""

import os
import socket
import subprocess
import sys

import jax
import numpy as np
import pytest

import acausal as ac
from tests.support.distributed import trained, weights
from tests.support.paths import ROOT


@pytest.fixture(scope="module")
def alone():
    """The same trainings on one device: with records in memory, and read when needed."""
    return np.stack([weights(trained(None)), weights(trained(None, streamed=True))])


@pytest.mark.cases(slow=1)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("processes", "devices"),
    [
        pytest.param(1, 2, id="two devices"),
        pytest.param(2, 1, id="two processes", marks=pytest.mark.slow),
    ],
)
def test_the_same_weights(processes, devices, alone, tmp_path):
    free = (
        socket.socket()
    )  # kept, so that no other program gets the port; the coordinator shares it
    free.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
    free.bind(("127.0.0.1", 0))
    address = f"127.0.0.1:{free.getsockname()[1]}"
    flags = f"--xla_force_host_platform_device_count={devices}"
    target = tmp_path / "weights.npy"
    started = [
        subprocess.Popen(
            [
                sys.executable,
                "-m",
                "tests.support.distributed",
                target,
                address,
                str(processes),
                str(i),
            ],
            cwd=ROOT,
            env={**os.environ, "XLA_FLAGS": flags, "JAX_PLATFORMS": "cpu"},
            stderr=subprocess.PIPE,
            text=True,
        )
        for i in range(processes)
    ]
    with free:
        errors = [process.communicate(timeout=240)[1] for process in started]
    assert not any(process.returncode for process in started), errors
    np.testing.assert_allclose(np.load(target), alone, rtol=0, atol=1e-10)


def test_unequal_shares_are_refused():
    with pytest.raises(ac.TrainingError, match="batch of 4 has no equal shares for 3 devices"):
        trained(3 * jax.devices()[:1])
    with pytest.raises(ac.TrainingError, match=r"devices=.* name one twice; give each once"):
        trained(2 * jax.devices()[:1])
