"""The step of an observer in C and as StableHLO, against the observer itself."""

from __future__ import annotations

import ctypes
from pathlib import Path

import jax
import numpy as np
import pytest
from jax import export as jax_export

import acausal as ac
from examples.qvm.model import with_networks
from tests.support.exported_c import compile_c

ACCESS = """
#include "seen.h"
#include <stdlib.h>
seen *make(void) { seen *m = malloc(sizeof(seen)); seen_init(m); return m; }
int one_step(seen *m, double t, double u, const double *y) {
    m->t = t; m->u[0] = u; m->y[0] = y[0]; m->y[1] = y[1]; return seen_step(m);
}
double *mean_of(seen *m) { return m->mean; }
double *covariance_of(seen *m) { return m->covariance; }
double *values_of(seen *m) { return m->values; }
"""

Rows = list[tuple[float, float, np.ndarray]]

SENSORS = {"body.a": 0.2, "wheel.a": 1.0}


@pytest.fixture(scope="module")
def vehicle() -> ac.System:
    return ac.compile(with_networks())


def seen(system: ac.System, method: str) -> ac.Observer:
    deviations = {n: 0.1 if n.endswith(".v") else 0.005 for n in system.states}
    return ac.observer(
        system, SENSORS, {"body.v": 0.1, "body.m": 0.5}, 0.002, method=method, states=deviations,
        parameters={"body.m": 10.0},
    )  # fmt: skip


@pytest.fixture(scope="module")
def rows(vehicle: ac.System) -> Rows:
    """Time, input and measurements at times that are not even; some measurements are missing."""
    rng, t = np.random.default_rng(0), np.cumsum(np.tile([0.002, 0.003, 0.005], 60))
    u = 0.5 * np.sin(20 * t)
    run = ac.simulate(vehicle, (t[0], t[-1]), saveat=t, inputs={"road.v_ref": (t, u)})
    y = np.stack([run[n] + r * rng.standard_normal(len(t)) for n, r in SENSORS.items()], axis=1)
    y[::3, 0], y[1::4, 1] = np.nan, np.nan
    return list(zip(t.tolist(), u.tolist(), y, strict=True))


@pytest.mark.parametrize("method", ["ekf", "ukf"])
def test_a_run_in_c_is_that_of_the_observer(
    vehicle: ac.System, rows: Rows, tmp_path: Path, method: str
):
    observer = seen(vehicle, method)
    header, source = ac.export.c(observer, tmp_path, name="seen", outputs=["body.a"])
    assert "alloc(" not in source.read_text()
    assert "body.v in m/s" in header.read_text()
    access = tmp_path / "access.c"
    access.write_text(ACCESS)
    compile_c([source, access], tmp_path / "seen.so", f"-I{tmp_path}")
    library = ctypes.CDLL(str(tmp_path / "seen.so"))
    library.make.restype = ctypes.c_void_p
    m = ctypes.c_void_p(library.make())

    def view(field: str, shape: tuple[int, ...]) -> np.ndarray:
        function = getattr(library, f"{field}_of")
        function.restype = ctypes.POINTER(ctypes.c_double)
        return np.ctypeslib.as_array(function(m), shape=shape)

    def step(t: float, u: float, y: np.ndarray) -> int:
        pointer = np.ascontiguousarray(y).ctypes.data_as(ctypes.c_void_p)
        return library.one_step(m, ctypes.c_double(t), ctypes.c_double(u), pointer)

    for t, u, y in rows:
        observer.step(t, np.array([u]), dict(zip(SENSORS, y, strict=True)))
        assert step(t, u, y) == 0
    n = len(observer.mean)
    np.testing.assert_allclose(view("mean", (n,)), observer.mean, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(
        view("covariance", (n, n)), observer.covariance, rtol=1e-12, atol=1e-14
    )
    assert view("values", (1,))[0] == pytest.approx(observer["body.a"], rel=1e-11)
    assert step(9.0, 0.0, np.full(2, np.inf)) == 1
    np.testing.assert_allclose(view("mean", (n,)), observer.mean, rtol=1e-12, atol=1e-14)


def test_stablehlo_has_the_same_step(vehicle: ac.System, rows: Rows, tmp_path: Path):
    observer = seen(vehicle, "ekf")
    path = ac.export.stablehlo(observer, tmp_path / "seen.jax", derivatives=0)
    step = jax.jit(jax_export.deserialize(bytearray(path.read_bytes())).call)
    start = observer.step_of_arrays.start
    memory = tuple(start)
    for t, u, y in rows[:20]:
        observer.step(t, np.array([u]), dict(zip(SENSORS, y, strict=True)))
        memory = step(t, np.array([u]), y, *memory)
    np.testing.assert_allclose(memory[2], observer.mean, rtol=1e-12, atol=1e-14)


def test_what_an_observer_has_already_is_refused(vehicle: ac.System, tmp_path: Path):
    observer = seen(vehicle, "ekf")
    with pytest.raises(ac.DataError, match=r"export\.c: an observer has its own parameters"):
        ac.export.c(observer, tmp_path, solver="euler")
    with pytest.raises(ac.DataError, match="of an observer only outputs can be named"):
        ac.export.stablehlo(observer, tmp_path / "seen.mlir", parameters=True)
